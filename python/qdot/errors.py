"""Exceptions and warnings: what the library says of a call, with its place and its hint."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Dict, Optional, Type

if TYPE_CHECKING:
    from .motion import Motion

_FIRST_LINE = re.compile(r"(?P<call>.*?):(?P<line>\d+):(?P<column>\d+): error: (?P<message>.*)")
_FUNCTION = re.compile(r"\bqdot_(system|motion|function)_(\w+)")
_HINT = re.compile(r"^ *hint: (.*)", re.MULTILINE | re.DOTALL)


class Notice(UserWarning):
    """What should be known of a call although it succeeded."""


class Error(Exception):
    """A call of the library that failed.

    `str` of it is what the library says: the message with its place, the line of the text, a caret
    below the place and, where there is one, a hint.

    Attributes
    ----------
    code : int
        The qdot_result; the classes below stand for one each.
    text : str
        Everything that the library says, lines as they are printed.
    message : str
        What is wrong, without its place.
    file : str or None
        The file, or the call (`declare`, `derive`, ...) whose text is to blame.
    line, column : int or None
        The place in that text, counted from 1.
    source : str or None
        The line of the text.
    hint : str or None
        What would help.
    motion : Motion or None
        The motion so far, where a run failed or was interrupted on its way.
    answers : str or None
        The answers of the statements that were carried out before the one that failed.

    Examples
    --------
    >>> import qdot
    >>> try:
    ...     qdot.System("param m = 1; set n = 2")
    ... except qdot.Error as error:
    ...     print(error)
    ...     print(error.line, error.column, error.hint)
    declare:1:18: error: there is no parameter `n`
      param m = 1; set n = 2
                       ^
      hint: write param n = 2
    1 18 write param n = 2
    """

    code = -1

    def __init__(self, text: str = "", code: Optional[int] = None) -> None:
        super().__init__(text)
        if code is not None:
            self.code = code
        self.text = text.rstrip("\n")
        self.message = self.text
        self.file: Optional[str] = None
        self.line: Optional[int] = None
        self.column: Optional[int] = None
        self.source: Optional[str] = None
        self.hint: Optional[str] = None
        self.motion: Optional[Motion] = None
        self.answers: Optional[str] = None
        lines = self.text.split("\n")
        first = _FIRST_LINE.match(lines[0])
        if first is not None:
            self.file, self.message = first["call"], first["message"]
            self.line, self.column = int(first["line"]), int(first["column"])
            self.source = lines[1][2:] if len(lines) > 1 else None
        hint = _HINT.search(self.text)
        if hint is not None:
            self.hint = hint[1]

    def __str__(self) -> str:
        return self.text


class InvalidError(Error, ValueError):
    """An argument that makes no sense."""

    code = 1


class LanguageError(Error):
    """A text that is not in the language."""

    code = 2


class UnknownNameError(Error, LookupError):
    """A name that is unknown, or taken."""

    code = 3


class KindError(Error, TypeError):
    """A vector where a number belongs, or wrong dimensions."""

    code = 4


class DomainError(Error, ValueError):
    """A value that is undefined: 1/0, log 0, a time outside the motion."""

    code = 5


class UnsetError(Error):
    """A parameter or function without a value."""

    code = 6


class SingularError(Error, ArithmeticError):
    """A matrix without an inverse."""

    code = 7


class LimitError(Error):
    """Larger than a stated limit of work or size."""

    code = 8


class FailedError(Error, ArithmeticError):
    """A numerical method gave up; `motion` is the motion so far."""

    code = 9


class NotBuiltError(Error, NotImplementedError):
    """A word of the language that this version does not carry out."""

    code = 10


class FileError(Error, OSError):
    """A file or pipe cannot be read or written."""

    code = 11


class OutOfMemoryError(Error, MemoryError):
    """No memory."""

    code = 12


class Interrupted(Error):
    """Interrupted by `System.interrupt`; Ctrl-C in the main thread raises KeyboardInterrupt."""

    code = 13


_CLASSES: Dict[int, Type[Error]] = {
    kind.code: kind
    for kind in (
        InvalidError,
        LanguageError,
        UnknownNameError,
        KindError,
        DomainError,
        UnsetError,
        SingularError,
        LimitError,
        FailedError,
        NotBuiltError,
        FileError,
        OutOfMemoryError,
        Interrupted,
    )
}


def error_of(code: int, text: str) -> Error:
    """Return the exception that stands for a qdot_result; functions of C are named as methods.

    >>> from qdot.errors import error_of
    >>> print(error_of(4, "hint: qdot_system_number, or qdot_motion_values for many"))
    hint: System.number, or Motion.values for many
    """
    text = _FUNCTION.sub(lambda found: f"{found[1].capitalize()}.{found[2]}", text)
    return _CLASSES.get(code, Error)(text, code)
