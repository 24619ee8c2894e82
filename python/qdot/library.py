"""The shared library libqdot: where it is, and its functions with their types.

It is loaded when it is first needed, and looked for, in this order, at

1. the path in the environment variable QDOT_LIBRARY,
2. the build of the source tree in which this package lies (build/.libs),
3. the place that `make install` wrote beside this file (_where.py),
4. where the loader looks, and `ctypes.util.find_library`,
5. lib/ beside the folder of the program `qdot` and of the Python interpreter, /usr/local/lib.
"""

from __future__ import annotations

import ctypes
import ctypes.util
import importlib
import os
import shutil
import sys
import threading
from ctypes import POINTER, c_char_p, c_double, c_int, c_size_t, c_ubyte, c_void_p
from pathlib import Path
from typing import Any, Callable, Dict, Iterator, List, Optional, Tuple

from .errors import InvalidError, error_of

#: The version of the interface in the name of the library.
ABI = 0

_text_out = POINTER(c_void_p)
_sizes = POINTER(c_size_t)
_numbers = POINTER(c_double)

#: void (*)(void *data, const char *what, double done, double left)
ProgressHook = ctypes.CFUNCTYPE(None, c_void_p, c_char_p, c_double, c_double)


class Summary(ctypes.Structure):
    """qdot_motion_summary."""

    _fields_ = [
        *((name, c_double) for name in ("start", "end", "tolerance", "error", "horizon")),
        *((name, c_double) for name in ("energy_drift", "constraint_drift", "cpu")),
        *((name, c_size_t) for name in ("steps", "rejected", "evaluations")),
        *((name, c_char_p) for name in ("method", "reason", "doubt")),
    ]


# name: (what it returns, its arguments), as qdot.h declares them
_FUNCTIONS: Dict[str, Tuple[Any, List[Any]]] = {
    "qdot_result_text": (c_char_p, [c_int]),
    "qdot_version": (c_char_p, []),
    "qdot_string_free": (None, [c_void_p]),
    "qdot_system_new": (c_int, [POINTER(c_void_p)]),
    "qdot_system_free": (None, [c_void_p]),
    "qdot_system_error": (c_char_p, [c_void_p]),
    "qdot_system_notices": (c_char_p, [c_void_p]),
    "qdot_system_declare": (c_int, [c_void_p, c_char_p]),
    "qdot_system_ask": (c_int, [c_void_p, c_char_p, c_int, _text_out]),
    "qdot_system_derive": (c_int, [c_void_p, c_char_p, c_int, _text_out]),
    "qdot_system_decide": (c_int, [c_void_p, c_char_p, POINTER(c_int)]),
    "qdot_system_number": (c_int, [c_void_p, c_char_p, _numbers, _numbers]),
    "qdot_system_run": (c_int, [c_void_p, c_char_p, POINTER(c_void_p)]),
    "qdot_system_motion": (c_int, [c_void_p, c_char_p, POINTER(c_void_p)]),
    "qdot_motion_free": (None, [c_void_p]),
    "qdot_motion_system": (c_void_p, [c_void_p]),
    "qdot_motion_summarize": (c_int, [c_void_p, POINTER(Summary), c_size_t]),
    "qdot_motion_coordinates": (c_size_t, [c_void_p]),
    "qdot_motion_coordinate": (c_char_p, [c_void_p, c_size_t]),
    "qdot_motion_end": (c_int, [c_void_p, c_size_t, _numbers, _numbers]),
    "qdot_motion_values": (
        c_int,
        [c_void_p, c_char_p, c_size_t, c_void_p, c_size_t, c_void_p, c_void_p],
    ),
    "qdot_motion_over": (
        c_int,
        [c_void_p, c_int, c_char_p, c_double, c_double, _numbers, _numbers],
    ),
    "qdot_motion_steps": (_numbers, [c_void_p, _sizes]),
    "qdot_motion_events": (c_int, [c_void_p, _sizes]),
    "qdot_motion_event": (
        c_int,
        [c_void_p, c_size_t, POINTER(c_char_p), _numbers, _numbers, POINTER(c_int)],
    ),
    "qdot_motion_conserved": (c_size_t, [c_void_p]),
    "qdot_motion_drift": (c_int, [c_void_p, c_size_t, POINTER(c_char_p), _numbers, _numbers]),
    "qdot_system_interrupt": (None, [c_void_p]),
    "qdot_system_keep_undo": (None, [c_void_p, c_int]),
    "qdot_system_source": (c_int, [c_void_p, c_char_p]),
    "qdot_system_progress": (c_int, [c_void_p, ProgressHook, c_void_p]),
    "qdot_system_complete": (c_int, [c_void_p, c_char_p, c_size_t, _sizes, _text_out]),
    "qdot_system_explain": (c_int, [c_void_p, c_char_p, c_size_t, c_int, _text_out]),
    "qdot_text_unfinished": (c_int, [c_char_p]),
    "qdot_system_highlight": (c_int, [c_void_p, c_char_p, c_size_t, POINTER(c_ubyte)]),
    "qdot_system_compile": (c_int, [c_void_p, c_char_p, c_char_p, POINTER(c_void_p)]),
    "qdot_function_inputs": (c_size_t, [c_void_p]),
    "qdot_function_outputs": (c_size_t, [c_void_p]),
    "qdot_function_values": (c_int, [c_void_p, c_size_t, c_void_p, c_void_p]),
    "qdot_function_free": (None, [c_void_p]),
    "qdot_system_table": (c_int, [c_void_p, c_char_p, POINTER(c_void_p)]),
    "qdot_table_rows": (c_size_t, [c_void_p]),
    "qdot_table_columns": (c_size_t, [c_void_p]),
    "qdot_table_column_name": (c_char_p, [c_void_p, c_size_t]),
    "qdot_table_column_unit": (c_char_p, [c_void_p, c_size_t]),
    "qdot_table_numbers": (_numbers, [c_void_p, c_size_t]),
    "qdot_table_errors": (_numbers, [c_void_p, c_size_t]),
    "qdot_table_cell": (c_char_p, [c_void_p, c_size_t, c_size_t]),
    "qdot_table_free": (None, [c_void_p]),
    "qdot_display_style": (c_char_p, []),
    "qdot_number_write": (c_int, [c_double, c_double, _text_out]),
}

PLAIN, UNICODE, LATEX, MATHML, JSON, DISPLAY, TREE = range(7)

#: The notations by name.
NOTATIONS: Dict[str, int] = {
    "plain": PLAIN,
    "unicode": UNICODE,
    "latex": LATEX,
    "mathml": MATHML,
    "json": JSON,
}


class Library:
    """The functions of a loaded libqdot, each under its name; `path` is where it was found.

    OSError: it cannot be loaded, or is another library.
    """

    def __init__(self, path: str) -> None:
        self.path = path
        self.process = os.getpid()
        library = ctypes.CDLL(path)
        if not hasattr(library, "qdot_version"):
            raise OSError(f"{path}: this is no libqdot")
        for name, (returned, arguments) in _FUNCTIONS.items():
            try:
                function = getattr(library, name)
            except AttributeError:
                setattr(self, name, _absent(name, path))
                continue
            function.restype, function.argtypes = returned, arguments
            setattr(self, name, function)
        self.version: str = self.qdot_version().decode()

    def __getattr__(self, name: str) -> Any:
        raise AttributeError(f"libqdot has no function {name}")

    def has(self, name: str) -> bool:
        """Whether the library has this function; older ones lack those that came later."""
        return not hasattr(getattr(self, name), "qdot_absent")

    def take_text(self, text: c_void_p) -> str:
        """Return a string that the library gave away, and free it."""
        if not text:
            return ""
        taken = ctypes.string_at(text).decode()
        self.qdot_string_free(text)
        return taken

    def style(self) -> str:
        """Return the CSS for the parts of pages in answers."""
        return str(self.qdot_display_style().decode())

    def number_text(self, value: float, error: float) -> str:
        """Return a number with its error as answers have it: 1.25 ± 3e-13; 0: exact, NaN: unknown."""
        text = c_void_p()
        self.check(self.qdot_number_write(value, error, ctypes.byref(text)), None)
        return self.take_text(text)

    def check(self, result: int, system: Optional[c_void_p]) -> None:
        """Raise what the last call on the system did wrong."""
        if result != 0:
            text = self.qdot_system_error(system) or self.qdot_result_text(result)
            raise error_of(result, text.decode())


def language(text: object) -> str:
    """Return a text of the language as it is, a formula as it is written in the language."""
    if isinstance(text, str):
        return text
    written = getattr(text, "_language", None)
    if written is None:
        raise TypeError(f"a text is wanted, not {type(text).__name__}")
    return str(written())


def utf8(text: object) -> bytes:
    """Return a text, or a formula, as the library takes it."""
    text = language(text)
    try:
        data = text.encode()
    except UnicodeEncodeError as error:
        where = f"character {error.start}, {text[error.start]!r}"
        raise InvalidError(f"the text is no Unicode: {where} is half a surrogate pair") from None
    if b"\0" in data:
        raise InvalidError(f"the text holds a NUL: character {text.index(chr(0))}")
    return data


def _absent(name: str, path: str) -> Callable[..., Any]:
    def call(*_: Any) -> Any:
        raise NotImplementedError(f"{path} has no {name}: a newer libqdot is needed")

    call.qdot_absent = True  # type: ignore[attr-defined]
    return call


def _names() -> List[str]:
    if sys.platform == "darwin":
        return [f"libqdot.{ABI}.dylib", "libqdot.dylib"]
    return [f"libqdot.so.{ABI}", "libqdot.so"]


def _installed() -> Optional[str]:
    """Return what `make install` wrote, if it was by it that this package came here."""
    try:
        where = importlib.import_module(__package__ + "._where")
    except ImportError:
        return None
    return str(where.LIBRARY)


def _candidates() -> Iterator[str]:
    tree = Path(__file__).resolve().parents[2]
    if (tree / "configure.ac").exists():
        for folder in tree / "build" / ".libs", tree / ".libs":
            yield from (str(folder / name) for name in _names() if (folder / name).exists())
    installed = _installed()
    if installed is not None:
        yield installed
    yield from _names()
    found = ctypes.util.find_library("qdot")
    if found:
        yield found
    program = shutil.which("qdot")
    prefixes = [sys.prefix, "/usr/local"]
    if program:
        prefixes.insert(0, str(Path(program).resolve().parents[1]))
    for prefix in prefixes:
        for folder in Path(prefix) / "lib", Path(prefix) / "lib64":
            yield from (str(folder / name) for name in _names() if (folder / name).exists())


_library: Optional[Library] = None
_loading = threading.Lock()


def load() -> Library:
    """Return the library, which the first call loads.

    Raises
    ------
    ImportError
        There is no libqdot, or QDOT_LIBRARY names a file that is none.
    RuntimeError
        The process was forked from one that had loaded the library.
    """
    global _library
    if _library is not None:
        if _library.process != os.getpid():
            raise RuntimeError(
                "libqdot was in use in the process from which this one was forked and cannot be used "
                "here: start processes by multiprocessing.get_context('spawn')"
            )
        return _library
    with _loading:
        if _library is None:
            _library = _find()
    return _library


def _find() -> Library:
    given = os.environ.get("QDOT_LIBRARY")
    if given:
        try:
            return Library(given)
        except OSError as error:
            raise ImportError(
                f"QDOT_LIBRARY is set to {given!r}: {error}; set it to the path of libqdot.so, or unset it"
            ) from None
    said = []
    for path in _candidates():
        try:
            return Library(path)
        except OSError as error:
            said.append(str(error))
    raise ImportError(
        "no libqdot is found: install qdot, or set the environment variable QDOT_LIBRARY to the path "
        "of libqdot.so\n  " + "\n  ".join(said)
    )


def version() -> str:
    """Return the version of the loaded library.

    >>> import qdot
    >>> qdot.version().count(".")
    2
    """
    return load().version


def unfinished(text: str) -> bool:
    """Whether more lines belong to the text: an open bracket or block, a backslash at its end.

    >>> import qdot
    >>> qdot.unfinished("x = (1,"), qdot.unfinished("x = (1, 2)")
    (True, False)
    """
    return bool(load().qdot_text_unfinished(utf8(text)))
