"""Tab completion in cells that begin with `%%qdot` and in lines `%qdot ...`: words of the language."""

from __future__ import annotations

import re
from typing import Any, Callable, Iterator, List, Optional, Tuple

from .errors import Error
from .system import System

__all__ = ["complete", "install"]

_MAGIC = re.compile(r"\s*%%?qdot(?=\s)")
# the option that is being typed, and the name in it
_WORD = re.compile(r"\s(?P<option>-i|--input|-o|--output|--system)(?:\s+|=)(?:\S*[,='\"])?(?P<name>\S*)$")
_DASH = re.compile(r"\s(?P<name>-[-a-z]*)$")

#: Where the word begins that is being typed, and the words that may stand there.
Found = Tuple[int, List[str]]
Look = Callable[[str], Tuple[System, str]]


def complete(text: str, cursor: int, shell: Any, look: Look) -> Optional[Found]:
    """Return what may stand in a cell before the cursor; None: that is not for qdot to say.

    Parameters
    ----------
    text, cursor
        The cell, and how many of its characters stand before the cursor.
    shell
        IPython's, with the variables of Python.
    look
        look(line) returns the system for which a line behind `%qdot` is, and what stands behind its options.
    """
    cell = _MAGIC.match(text)
    if cell is not None and "%%" in cell[0]:
        end = text.find("\n", cell.end())
        if 0 <= end < cursor:
            return _statement(text, end + 1, cursor, look(text[cell.end() : end])[0])
    begin = text.rfind("\n", 0, cursor) + 1
    magic = _MAGIC.match(text, begin)
    if magic is None or cursor <= magic.end():
        return None
    before = text[magic.end() : cursor]
    word = _WORD.search(before) or _DASH.search(before)
    if word is None:
        system, rest = look(before)
        return _statement(text, magic.end() + len(before.rstrip()) - len(rest), cursor, system)
    option, place = word.groupdict().get("option"), magic.end() + word.start("name")
    if option in ("-o", "--output"):
        return _statement(text, place, cursor, look(before)[0])
    names = ["-i", "-o", "--system"] if option is None else _variables(shell, option == "--system")
    return place, sorted(name for name in names if name.startswith(word["name"]))


def _statement(text: str, begin: int, cursor: int, system: System) -> Found:
    """Return what may stand before the cursor in statements, which begin at a character of the cell."""
    end = text.find("\n", cursor) if "%%" not in text[:begin] else -1
    try:
        start, words = system.complete(text[begin:] if end < 0 else text[begin:end], cursor - begin)
    except Error:  # no text of the language
        return cursor, []
    return begin + start, words


def _variables(shell: Any, of_systems: bool) -> Iterator[str]:
    for name, value in shell.user_ns.items():
        if isinstance(value, System) if of_systems else not name.startswith("_"):
            yield name


def install(shell: Any, look: Look) -> None:
    """Have IPython ask `complete` first; once for a shell."""
    from IPython.core.completer import Completion

    completer = shell.Completer
    others = getattr(completer.completions, "qdot_others", completer.completions)

    def completions(text: str, offset: int) -> Iterator[Any]:
        found = complete(text, offset, shell, look)
        if found is None:
            yield from others(text, offset)
            return
        for word in found[1]:
            yield Completion(found[0], offset, word, type="qdot", _origin="qdot")

    completions.qdot_others = others  # type: ignore[attr-defined]
    completer.completions = completions
