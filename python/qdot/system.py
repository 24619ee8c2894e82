"""A system: what has been declared, and what can be asked of it."""

from __future__ import annotations

import decimal
import enum
import fractions
import json
import numbers
import os
import weakref
from ctypes import byref, c_double, c_int, c_size_t, c_void_p
from types import TracebackType
from typing import (
    TYPE_CHECKING,
    Any,
    Dict,
    List,
    Literal,
    Mapping,
    Optional,
    Sequence,
    Tuple,
    Type,
    Union,
    overload,
)

from .errors import Error, InvalidError
from .figures import Animation, Figure, Report
from .formula import Formula
from .function import named
from .library import DISPLAY, JSON, NOTATIONS, language, utf8
from .session import Hook, Session, warn
from .table import Fit, Numbers, Table, copied, fit_of, numbers_of, table_of
from .tree import of_sympy

if TYPE_CHECKING:
    from .motion import Motion

#: What a parameter or an initial value may be set to: a number or a text of the language.
Value = Union[float, fractions.Fraction, decimal.Decimal, str, Formula, Sequence[Any]]


class Truth(enum.Enum):
    """The answer to a claim.

    PROVED and REFUTED are true and false; UNDECIDED is neither, and `bool` of it is an error.

    Examples
    --------
    >>> import qdot
    >>> s = qdot.System("param a, b > 0")
    >>> s.check("(a + b)^2 == a^2 + 2*a*b + b^2")
    <Truth.PROVED: 'proved'>
    >>> bool(s.check("a == b"))
    False
    """

    PROVED = "proved"
    REFUTED = "refuted"
    UNDECIDED = "undecided"

    def __bool__(self) -> bool:
        if self is Truth.UNDECIDED:
            raise TypeError("undecided is neither true nor false: compare with qdot.Truth")
        return self is Truth.PROVED

    def __str__(self) -> str:
        return self.value


_TRUTHS = (Truth.PROVED, Truth.REFUTED, Truth.UNDECIDED)


class System:
    """A mechanical system in the language of the program `qdot`, which `info qdot` describes.

    Parameters
    ----------
    text : str
        Statements, as for `declare`.

    Notes
    -----
    Units are those of the scene, angles are in radians. Two threads may use two systems at the same
    time; one that uses a system which is computing for another waits. What the library tells beside an
    answer is a warning of the category `Notice`.

    Examples
    --------
    >>> import qdot
    >>> s = qdot.System('''
    ...     param m, l, g > 0
    ...     coord theta
    ...     particle bob mass m at (l*sin(theta), -l*cos(theta))
    ...     gravity (0, -g)
    ... ''')
    >>> print(s.derive("T"))
    1/2*m*l^2*theta'^2
    >>> print(s.derive("eom"))
    m*l^2*theta'' = -m*l*g*sin(theta)
    >>> s.set(m=1, l=1, g=9.81).start({"theta": 2})
    <qdot.System>
    >>> motion = s.run("0..10")
    >>> round(motion.max("theta'"), 6)
    5.271129
    """

    def __init__(self, text: str = "") -> None:
        self._open: Optional[Session] = Session()
        self._computing = weakref.ref(self._open)  # also when it is closed meanwhile
        if text:
            self.declare(text)

    @classmethod
    def from_file(cls, path: Union[str, os.PathLike[str]]) -> System:
        """Return a system with the statements of a file; files that it includes lie beside it."""
        system = cls()
        system.declare(f"include {_quoted(os.fsdecode(path))}")
        return system

    # --- statements ---------------------------------------------------------------------

    def declare(self, text: str) -> System:
        """Carry out statements, without their answers.

        Parameters
        ----------
        text : str
            Statements, separated by new lines or semicolons. The first that fails raises an `Error`;
            those before it stay in effect.

        Returns
        -------
        System
            This system.

        Examples
        --------
        >>> import qdot
        >>> qdot.System().declare("coord x; particle p mass 1 at (x, 0)")
        <qdot.System>
        """
        session = self._session
        session.changes += 1
        session.call(
            lambda: session.check(session.library.qdot_system_declare(session.handle, utf8(text)))
        )
        return self

    def ask(self, text: str, notation: str = "unicode") -> str:
        """Carry out statements and return their answers as the program prints them.

        Parameters
        ----------
        text : str
            Statements.
        notation : {"unicode", "plain", "latex", "mathml", "json"}
            How formulas are written; "json": one object a line.

        Examples
        --------
        >>> import qdot
        >>> s = qdot.System("coord theta; particle p mass 1 at (sin(theta), cos(theta))")
        >>> print(s.ask("T; p[theta]", notation="plain"), end="")
        T = 1/2*theta'^2
        p[theta] = theta'
        """
        return self._answers(text, _notation(notation))

    def display(self, text: str, source: str = "ask") -> List[Dict[str, Any]]:
        """Carry out statements and return their answers as objects, for notebooks and editors.

        The objects are those of the program's option --json. Figures, animations and reports come as
        such: {"kind": "figure", "mime": "image/svg+xml", "data": ...}, {"kind": "page", "mime":
        "text/html", "data": ...}. A statement that fails is no exception here but the last object,
        {"kind": "error", "line": ..., "column": ..., "message": ..., "hint": ...}, and notices are
        objects, too.

        Parameters
        ----------
        text : str
            Statements.
        source : str
            What errors call the text, and the place of what it declares: ``In[5]``.

        Examples
        --------
        >>> import qdot
        >>> [answer["kind"] for answer in qdot.System().display("1/3 + 1/6; nonsense +")]
        ['expr', 'error']
        >>> s = qdot.System()
        >>> s.display("param a", "In[1]")
        []
        >>> s.display("coord a", "In[2]")[0]["message"]
        '`a` was declared before, at In[1]:1'
        """
        try:
            lines = self._answers(text, DISPLAY, noted=False, source=source)
        except Error as error:
            if error.answers is None:
                raise
            lines = error.answers
        return [json.loads(line) for line in lines.splitlines()]

    def set(self, values: Optional[Mapping[str, Value]] = None, **more: Value) -> System:
        """Set parameters to values; names that are no words of Python come in a dictionary.

        A float stands for the decimal number that Python prints for it, and that is exact.

        Examples
        --------
        >>> import qdot
        >>> s = qdot.System("param m, g")
        >>> s.set(m=2, g=9.81).number("m*g")
        19.62
        """
        return self._assign("set", values, more)

    def start(self, values: Optional[Mapping[str, Value]] = None, **more: Value) -> System:
        """Set initial values: ``start({"theta": 2, "theta'": "pi/2"})``."""
        return self._assign("start", values, more)

    # --- formulas, claims, numbers ------------------------------------------------------

    def derive(self, expression: str) -> Formula:
        """Return the value of an expression as a formula: "T", "eom", "H", "diff(L, theta)", ...

        Examples
        --------
        >>> import qdot
        >>> qdot.System("param a; coord x").derive("diff(sin(a*x)^2, x)")
        Formula('a*sin(2*a*x)')
        """
        return Formula(self._session, expression)

    def check(self, claim: str) -> Truth:
        """Decide a claim: "T == 1/2*m*v^2", "conserved energy", "A < B when x > 0".

        Examples
        --------
        >>> import qdot
        >>> qdot.System("coord x").check("sin(x)^2 + cos(x)^2 == 1")
        <Truth.PROVED: 'proved'>
        """
        session, truth = self._session, c_int()
        session.call(
            lambda: session.check(
                session.library.qdot_system_decide(session.handle, utf8(claim), byref(truth))
            )
        )
        return _TRUTHS[truth.value]

    @overload
    def number(self, expression: Union[str, Formula], error: Literal[False] = False) -> float: ...

    @overload
    def number(self, expression: Union[str, Formula], error: Literal[True]) -> Tuple[float, float]: ...

    def number(
        self, expression: Union[str, Formula], error: bool = False
    ) -> Union[float, Tuple[float, float]]:
        """Return the number that an expression is with the present values of parameters.

        Parameters
        ----------
        expression : str or Formula
            A scalar; numbers of runs may stand in it: "value(theta, 3)".
        error : bool
            Whether to return (value, error): what the value may be off by where numbers of a run stand
            in it; 0: exact but for rounding; NaN: unknown.

        Examples
        --------
        >>> import qdot
        >>> s = qdot.System("param l = 1, g = 9.81")
        >>> s.number("2*pi*sqrt(l/g)")
        2.0060666807106475
        """
        session, value, off = self._session, c_double(), c_double()
        session.call(
            lambda: session.check(
                session.library.qdot_system_number(
                    session.handle, utf8(expression), byref(value), byref(off)
                )
            )
        )
        return (value.value, off.value) if error else value.value

    # --- motions and what is made of many -----------------------------------------------

    def run(self, text: str) -> Motion:
        """Integrate: "0..10", "0..10 tol 1e-9 method dop853 with m = 2 as a".

        A run without a name goes with its motion. Where a run fails or is interrupted, `motion` of the
        exception is the motion so far.

        Examples
        --------
        >>> import qdot
        >>> s = qdot.System("coord x; particle p mass 1 at (x, 0); potential x^2/2; start x = 1")
        >>> s.run("0..10").mean("x^2", 0, 10)  # doctest: +ELLIPSIS
        0.5228...
        """
        from .motion import Motion

        session, motion = self._session, c_void_p()

        def body() -> Motion:
            result = session.library.qdot_system_run(session.handle, utf8(text), byref(motion))
            made = Motion(session, motion) if motion else None
            try:
                session.check(result)
            except Error as error:
                error.motion = made
                raise
            assert made is not None
            return made

        session.changes += 1
        return session.call(body)

    def motion(self, name: Optional[str] = None) -> Motion:
        """Return a run that a statement has made, by its name: "a" after "run 0..10 as a", else "run1", ...

        Without a name it is the latest. The system keeps the run when the motion goes.

        Examples
        --------
        >>> import qdot
        >>> s = qdot.System("coord x; particle p mass 1 at (x, 0); start x' = 2; run 0..3 as a")
        >>> s.motion("a").end["x"]
        6.0
        """
        from .motion import Motion

        session, motion = self._session, c_void_p()
        wanted = None if name is None else utf8(name)

        def body() -> Motion:
            session.check(session.library.qdot_system_motion(session.handle, wanted, byref(motion)))
            return Motion(session, motion)

        return session.call(body)

    def sweep(self, text: str) -> Table:
        """Carry out `sweep`: "m = 1..3 step 0.1 run 0..20 : value(theta, 20) as res"."""
        self.declare(f"sweep {language(text)}")
        return self.rows()

    def rows(self, name: Optional[str] = None) -> Table:
        """Return a table that the system has by name.

        Those are made by `sweep`, `poincare`, `continue` ("branches") and `fit` ("residuals"); without a
        name it is the one that was made last.
        """
        session, handle = self._session, c_void_p()
        wanted = None if name is None else utf8(name)

        def body() -> Table:
            session.check(session.library.qdot_system_table(session.handle, wanted, byref(handle)))
            try:
                return copied(session.library, handle, name or "table")
            finally:
                session.library.qdot_table_free(handle)

        return session.call(body)

    def table(self, text: str) -> Table:
        """Return values along the latest run, "theta, theta' every 0.1", or a table of the session by name.

        Examples
        --------
        >>> import qdot
        >>> s = qdot.System("coord x; particle p mass 1 at (x, 0); start x' = 2")
        >>> motion = s.run("0..2 as a")
        >>> s.table("x, x' every 1")["x"]
        array([0., 2., 4.])
        """
        table = table_of(self._objects(f"table {language(text)}"))
        if table is None:
            raise InvalidError(f"table {text}: the answer is no table")
        return table

    def numbers(self, text: str) -> Numbers:
        """Carry out statements that answer with numbers: `find`, `sensitivity`, `lyapunov`, `floquet`, ...

        Of numbers of the same name it is the last one.
        """
        found = numbers_of(self._objects(text))
        if not found:
            raise InvalidError("there are no numbers among the answers; `ask` returns them as a text")
        return found

    def fit(self, text: str) -> Fit:
        """Carry out `fit`: "g, theta to \\"data.csv\\" : t, theta sigma 0.01".

        A file is looked for where the process is.
        """
        return fit_of(self._objects(f"fit {language(text)}"))

    # --- figures and pages --------------------------------------------------------------

    def plot(self, text: str) -> Figure:
        """Draw what may stand behind `plot`: "theta, theta'", "theta' vs theta", a name of a sweep.

        Examples
        --------
        >>> import qdot
        >>> s = qdot.System("coord x; particle p mass 1 at (x, 0); start x' = 2")
        >>> motion = s.run("0..2 as a")
        >>> s.plot("x")  # doctest: +SKIP
        <qdot.Figure: x>
        """
        shown = self._shown(f"plot {language(text)}", "figure")
        return Figure(shown["data"], shown["name"])

    def animate(self, text: str = "") -> Animation:
        """Return the animation of the latest run, or of what may stand behind `animate`."""
        shown = self._shown(f"animate {language(text)}", "page")
        return Animation(shown["data"], shown["name"])

    def report(self, text: str = "") -> Report:
        """Return the report of all that has been asked: the derivation, the runs, their figures."""
        shown = self._shown(f"report {language(text)}", "page")
        return Report(shown["data"], shown["name"])

    # --- what a prompt or an editor asks ------------------------------------------------

    def complete(self, text: str, cursor: Optional[int] = None) -> Tuple[int, List[str]]:
        """Return where the word at the cursor begins, and the words that may stand there.

        Positions count characters of `text`; without a cursor it is at the end.

        Examples
        --------
        >>> import qdot
        >>> qdot.System("coord theta").complete("start the")
        (6, ['theta'])
        """
        session, start, words = self._session, c_size_t(), c_void_p()

        def body() -> str:
            session.check(
                session.library.qdot_system_complete(
                    session.handle, utf8(text), _bytes_before(text, cursor), byref(start), byref(words)
                )
            )
            return session.library.take_text(words)

        found = session.call(body).splitlines()
        return _characters(text, start.value), found

    def explain(self, text: str, cursor: Optional[int] = None) -> Dict[str, Any]:
        """Return what stands at the cursor: help of a word, or formula and dimension of a name.

        The keys that are there of "word", "from", "to", "usage", "text", "formula" (LaTeX), "dimension",
        "example"; an empty dictionary if there is nothing to say. Positions as for `complete`.
        """
        session, explanation = self._session, c_void_p()

        def body() -> str:
            session.check(
                session.library.qdot_system_explain(
                    session.handle, utf8(text), _bytes_before(text, cursor), JSON, byref(explanation)
                )
            )
            return session.library.take_text(explanation)

        found: Dict[str, Any] = json.loads(session.call(body) or "{}")
        for key in "from", "to":
            if key in found:
                found[key] = _characters(text, found[key])
        return found

    def progress(self, hook: Optional[Hook]) -> Optional[Hook]:
        """Have a function called a few times a second while runs, sweeps and the like go on.

        Parameters
        ----------
        hook : callable or None
            Called as ``hook(what, done, left)`` in the computing thread, which need not be that of the
            caller: what is computed ("run"), the part that is done, 0 to 1, and the seconds left by
            estimate, None while it is not known. It cannot ask this system. An exception from it stops
            the computation and is raised by the call that computes. None: no hook any more.

        Returns
        -------
        callable or None
            The hook that there was.
        """
        session = self._session
        if hook is not None and not callable(hook):
            raise TypeError(f"a function is wanted, not {type(hook).__name__}")
        return session.look(lambda: session.hook_set(hook))

    def keep_undo(self, kept: bool = True) -> System:
        """Let `undo` reach back over calls, as it does at the prompt; else it does within its own call.

        That takes 256 MB at most. `run` and the end of its motion are no statements: those before them
        can no longer be undone.

        Examples
        --------
        >>> import qdot
        >>> s = qdot.System().keep_undo().declare("param a = 1").declare("set a = 2").declare("undo")
        >>> s.number("a")
        1.0
        """
        session = self._session

        def body() -> None:
            session.library.qdot_system_keep_undo(session.handle, int(kept))

        session.look(body)
        return self

    def interrupt(self) -> None:
        """Stop the computation that another thread has this system do: `Interrupted` is raised there."""
        session = self._computing()
        if session is not None:
            session.interrupt()

    def close(self) -> None:
        """Let go of what the library holds, but for motions that are still in use."""
        self._open = None

    def __repr__(self) -> str:
        if self._open is None:
            return "<qdot.System: closed>"
        return "<qdot.System>"

    def __enter__(self) -> System:
        return self

    def __exit__(
        self,
        kind: Optional[Type[BaseException]],
        error: Optional[BaseException],
        traceback: Optional[TracebackType],
    ) -> None:
        self.close()

    def __reduce__(self) -> Any:
        raise TypeError("a qdot.System cannot be copied or pickled: send the text of its statements")

    # --- inside -------------------------------------------------------------------------

    @property
    def _session(self) -> Session:
        if self._open is None:
            raise ValueError("the system is closed")
        return self._open

    def _answers(self, text: str, notation: int, noted: bool = True, source: str = "ask") -> str:
        session, answers = self._session, c_void_p()

        def body() -> str:
            session.check(session.library.qdot_system_source(session.handle, utf8(source)))
            result = session.library.qdot_system_ask(
                session.handle, utf8(text), notation, byref(answers)
            )
            given = session.library.take_text(answers)
            try:
                session.check(result)
            except Error as error:
                error.answers = given
                raise
            return given

        session.changes += 1
        return session.call(body, noted)

    def _objects(self, text: str) -> List[Dict[str, Any]]:
        """Return the objects that `display` returns, but raise errors and warn of notices."""
        objects = [json.loads(line) for line in self._answers(text, DISPLAY).splitlines()]
        for answer in objects:
            if answer["kind"] == "notice":
                warn(answer["message"])
        return objects

    def _shown(self, text: str, kind: str) -> Dict[str, Any]:
        for answer in reversed(self._objects(text)):
            if answer["kind"] == kind:
                return answer
        raise InvalidError(f"{text}: there is nothing to show; what it was to write, it has written")

    def _assign(
        self, word: str, values: Optional[Mapping[str, Value]], more: Mapping[str, Value]
    ) -> System:
        all_values = {**(values or {}), **more}
        if all_values:
            parts = [f"{named(name)} = {written(value)}" for name, value in all_values.items()]
            self.declare(f"{word} {', '.join(parts)}")
        return self


def written(value: Value) -> str:
    """Return a number, a list of them or a text of the language as the language writes it.

    >>> from qdot.system import written
    >>> written(0.1), written([1, -2.5]), written("pi/2")
    ('0.1', '[1, -2.5]', 'pi/2')
    """
    if isinstance(value, str) or hasattr(value, "_language"):
        return language(value)
    if hasattr(value, "tolist"):  # NumPy's: its numbers as those of Python
        value = value.tolist()
    if isinstance(value, numbers.Rational):
        exact = fractions.Fraction(value)
        if exact.denominator == 1:
            return _digits(exact.numerator)
        return f"({_digits(exact.numerator)}/{_digits(exact.denominator)})"
    if isinstance(value, numbers.Real):
        return _finite(repr(float(value)))
    if isinstance(value, (list, tuple, range)):
        return "[" + ", ".join(written(member) for member in value) + "]"
    if hasattr(value, "free_symbols"):
        return of_sympy(value)
    if hasattr(value, "__float__") and not isinstance(value, complex):  # of more digits than a float
        return _finite(str(value))
    kind = "None" if value is None else type(value).__name__
    raise TypeError(f"a value is a real number, a list of them, a formula or a text, not {kind}")


def _digits(n: int) -> str:
    return str(decimal.Decimal(n))  # `str` of an int refuses long ones


def _finite(text: str) -> str:
    if text.strip("+-").lower() in ("inf", "infinity", "nan", "snan"):
        raise InvalidError(f"{text} is no value")
    return text


def _notation(name: str) -> int:
    if name not in NOTATIONS:
        raise InvalidError(f"there is no notation {name!r}: {', '.join(NOTATIONS)}")
    return NOTATIONS[name]


def _quoted(text: str) -> str:
    if '"' in text or "\n" in text:
        raise InvalidError(f"the language cannot write the name of the file {text!r}")
    return f'"{text}"'


def _bytes_before(text: str, cursor: Optional[int]) -> int:
    return len(text[: len(text) if cursor is None else cursor].encode())


def _characters(text: str, offset: int) -> int:
    return len(text.encode()[:offset].decode(errors="ignore"))
