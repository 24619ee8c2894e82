"""Motions: runs of a system, read as NumPy arrays."""

from __future__ import annotations

import ctypes
import dataclasses
import html
from ctypes import byref, c_char_p, c_double, c_int, c_size_t, c_void_p
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
    Union,
    overload,
)

from . import library
from .arrays import floats, number
from .errors import InvalidError, KindError
from .library import language, utf8
from .session import Session

if TYPE_CHECKING:
    import numpy
    import numpy.typing

    from .formula import Formula

    Array = numpy.typing.NDArray[numpy.float64]
    Times = numpy.typing.ArrayLike
    Expression = Union[str, Formula]
    Expressions = Union[Expression, Sequence[Expression]]

#: What `Motion.over` returns, in the order of qdot_over.
_KINDS = ("max", "min", "mean", "drift")


@dataclasses.dataclass(frozen=True)
class Summary:
    """A motion as a whole.

    Attributes
    ----------
    start, end : float
        Times of the first and the last state; the end may be earlier than was asked for.
    tolerance : float
    error : float
        Of the state at the end: the largest of its components relative to max(1, |value|), estimated;
        NaN: unknown.
    horizon : float
        The time after which no digit is reliable; NaN: there is none.
    energy_drift : float
        max |h - h0| / max(1, |h0|), h the energy; NaN: h is not conserved.
    constraint_drift : float
        The largest |f| of the constraints f = 0; NaN: there are none.
    cpu : float
        Seconds of the integration alone.
    steps, rejected, evaluations : int
    method : str
    reason : str or None
        Why the integration ended early.
    doubt : str or None
        Why the error is unknown.
    """

    start: float
    end: float
    tolerance: float
    error: float
    horizon: float
    energy_drift: float
    constraint_drift: float
    cpu: float
    steps: int
    rejected: int
    evaluations: int
    method: str
    reason: Optional[str]
    doubt: Optional[str]


@dataclasses.dataclass(frozen=True)
class Event:
    """An event that occurred: way 1 rising, -1 falling, 0 touched; error NaN: unknown."""

    name: str
    time: float
    error: float
    way: int


@dataclasses.dataclass(frozen=True)
class Conserved:
    """A conserved quantity: its value at the start, and max |e - e0| / max(1, |e0|) over the run."""

    name: str
    start: float
    drift: float


class Motion:
    """A run of a system; `System.run` makes it.

    Examples
    --------
    >>> import numpy, qdot
    >>> s = qdot.System("coord x; particle p mass 1 at (x, 0); potential x^2/2; start x = 1")
    >>> motion = s.run("0..10")
    >>> t = numpy.array([0, 1, 10])
    >>> x, v = motion.values(["x", "x'"], t)
    >>> bool(abs(x - numpy.cos(t)).max() < 1e-10)
    True
    >>> x, error = motion.values("x", t, errors=True)
    >>> bool((abs(x - numpy.cos(t)) <= error + 1e-15).all())
    True
    """

    def __init__(self, session: Session, handle: c_void_p) -> None:
        self._session = session
        self._handle = handle
        session.keep(self, session.library.qdot_motion_free, handle)

    # --- values -------------------------------------------------------------------------

    @overload
    def values(
        self, expressions: Expressions, times: Times, errors: Literal[False] = False
    ) -> Array: ...

    @overload
    def values(
        self, expressions: Expressions, times: Times, errors: Literal[True]
    ) -> Tuple[Array, Array]: ...

    @overload
    def values(
        self, expressions: Mapping[str, Expression], times: Times, errors: Literal[False] = False
    ) -> Dict[str, Array]: ...

    @overload
    def values(
        self, expressions: Mapping[str, Expression], times: Times, errors: Literal[True]
    ) -> Tuple[Dict[str, Array], Dict[str, Array]]: ...

    def values(
        self,
        expressions: Union[Expressions, Mapping[str, Expression]],
        times: Times,
        errors: bool = False,
    ) -> Any:
        """Return the values of expressions at times, all by one call of the library.

        Parameters
        ----------
        expressions : str or Formula, a sequence of them, or a mapping of names to them
            Expressions in coordinates, velocities, accelerations, t and parameters, which have the values
            of the run.
        times : array_like
            Times in the run, in any order and shape.
        errors : bool
            Whether to return (values, errors): estimated, absolute; NaN: unknown.

        Returns
        -------
        ndarray or dict
            For a scalar an array with the shape of `times`; for a vector and for a sequence of scalars one
            with an axis more in front, so that ``x, y = motion.values(["x", "y"], times)``; for a mapping
            a dictionary of arrays.
        """
        at = floats(times, "times")
        tables: List[Any]
        if isinstance(expressions, Mapping):
            tables = self._read_by_name(expressions, at, bool(errors))
        else:
            tables = self._read(expressions, at, bool(errors))
        return tuple(tables) if errors else tables[0]

    def _read(self, expressions: Expressions, times: Array, errors: bool) -> List[Array]:
        """Return values and, if they are wanted, errors: arrays with the components in front."""
        if isinstance(expressions, str) or hasattr(expressions, "_language"):
            text = language(expressions)
            tables = self._tables(text, times, None, errors)
            if tables[0].shape[1] == 1 and not _is_list(text):
                return [table.reshape(times.shape) for table in tables]
        else:
            texts = [language(text) for text in expressions]
            tables = self._tables(_list(texts), times, len(texts), errors)
        return [table.T.reshape(table.shape[1], *times.shape) for table in tables]

    def _read_by_name(
        self, expressions: Mapping[str, Expression], times: Array, errors: bool
    ) -> List[Dict[str, Array]]:
        """Return values and, if they are wanted, errors by name: by one call where all are scalars."""
        texts = list(expressions.values())
        try:
            columns = list(zip(*self._read(texts, times, errors)))
        except KindError:
            columns = [tuple(self._read(text, times, errors)) for text in texts]
        return [{name: c[i] for name, c in zip(expressions, columns)} for i in range(1 + errors)]

    def _tables(self, text: str, times: Array, k: Optional[int], errors: bool) -> List[Array]:
        """Return values [n][k] and, if they are wanted, errors; k None: as many as there are components."""
        import numpy

        def body() -> List[Array]:
            n, wanted = times.size, 1 if k is None else k
            while True:
                tables = [numpy.empty((n, wanted)) for _ in range(1 + errors)]
                if wanted == 0:
                    return tables
                try:
                    self._session.check(
                        self._session.library.qdot_motion_values(
                            self._handle,
                            utf8(text),
                            n,
                            times.ctypes.data,
                            wanted,
                            tables[0].ctypes.data,
                            tables[1].ctypes.data if errors else None,
                        )
                    )
                    return tables
                except KindError as error:  # before anything was computed: a vector
                    has = _components(error.message)
                    if k is not None or has is None or has == wanted:
                        raise
                    wanted = has

        return self._session.call(body)

    def max(
        self, expression: Expression, start: Optional[float] = None, end: Optional[float] = None
    ) -> float:
        """Return the largest value of an expression, also between steps, from `start` to `end`."""
        return self.over("max", expression, start, end)[0]

    def min(
        self, expression: Expression, start: Optional[float] = None, end: Optional[float] = None
    ) -> float:
        """Return the least value of an expression, also between steps, from `start` to `end`."""
        return self.over("min", expression, start, end)[0]

    def mean(
        self, expression: Expression, start: Optional[float] = None, end: Optional[float] = None
    ) -> float:
        """Return the mean of an expression over time."""
        return self.over("mean", expression, start, end)[0]

    def drift(
        self, expression: Expression, start: Optional[float] = None, end: Optional[float] = None
    ) -> float:
        """Return max |e - e0| / max(1, |e0|), where e0 is the value of the expression e at `start`.

        Of the two times it is that to which the run comes first.
        """
        return self.over("drift", expression, start, end)[0]

    def over(
        self,
        what: str,
        expression: Expression,
        start: Optional[float] = None,
        end: Optional[float] = None,
    ) -> Tuple[float, float]:
        """Return what `max`, `min`, `mean`, `drift` return, and its error (NaN: unknown).

        Examples
        --------
        >>> import qdot
        >>> s = qdot.System("coord x; particle p mass 1 at (x, 0); potential x^2/2; start x' = 1")
        >>> value, error = s.run("0..10").over("max", "x")
        >>> abs(value - 1) <= error < 1e-10
        True
        """
        session, value, error = self._session, c_double(), c_double()
        if what not in _KINDS:
            raise InvalidError(f"over: {what!r} is none of {', '.join(_KINDS)}")
        kind = _KINDS.index(what)
        summary = self.summary
        first = summary.start if start is None else number(start, "start")
        last = summary.end if end is None else number(end, "end")
        session.call(
            lambda: session.check(
                session.library.qdot_motion_over(
                    self._handle, kind, utf8(expression), first, last, byref(value), byref(error)
                )
            )
        )
        return value.value, error.value

    # --- the run as a whole -------------------------------------------------------------

    @property
    def summary(self) -> Summary:
        """Times, error, method and cost of the run."""
        session, c = self._session, library.Summary()
        session.look(
            lambda: session.check(
                session.library.qdot_motion_summarize(self._handle, byref(c), ctypes.sizeof(c))
            )
        )
        members = {field.name: getattr(c, field.name) for field in dataclasses.fields(Summary)}
        return Summary(
            **{name: m.decode() if isinstance(m, bytes) else m for name, m in members.items()}
        )

    @property
    def coordinates(self) -> List[str]:
        """Names of the coordinates; behind them parameters that events set."""
        c = self._session.library
        return self._session.look(
            lambda: [
                c.qdot_motion_coordinate(self._handle, i).decode()
                for i in range(c.qdot_motion_coordinates(self._handle))
            ]
        )

    @property
    def end(self) -> Dict[str, float]:
        """The state at the end: coordinates and velocities by name."""
        session, names = self._session, self.coordinates
        n = len(names)
        q, v = (c_double * n)(), (c_double * n)()
        session.look(
            lambda: session.check(session.library.qdot_motion_end(self._handle, n, q, v))
        )
        return {**dict(zip(names, q)), **{name + "'": speed for name, speed in zip(names, v)}}

    @property
    def steps(self) -> Array:
        """The times at which the steps of the integration end, in the order of the run."""
        import numpy

        n = c_size_t()

        def body() -> Array:
            times = self._session.library.qdot_motion_steps(self._handle, byref(n))
            if n.value == 0:
                return numpy.empty(0)
            return numpy.ctypeslib.as_array(times, (n.value,)).copy()

        return self._session.look(body)

    @property
    def events(self) -> List[Event]:
        """The events that occurred, in the order of the run."""
        session, c, n = self._session, self._session.library, c_size_t()
        name, t, error, way = c_char_p(), c_double(), c_double(), c_int()

        def body() -> List[Event]:
            found = []
            session.check(c.qdot_motion_events(self._handle, byref(n)))
            for i in range(n.value):
                session.check(
                    c.qdot_motion_event(
                        self._handle, i, byref(name), byref(t), byref(error), byref(way)
                    )
                )
                found.append(Event((name.value or b"").decode(), t.value, error.value, way.value))
            return found

        return session.look(body)

    @property
    def conserved(self) -> List[Conserved]:
        """What is known to be conserved, with its drift.

        >>> import qdot
        >>> s = qdot.System("coord x; particle p mass 1 at (x, 0); potential x^2/2; start x = 1")
        >>> [(q.name, q.start, q.drift < 1e-12) for q in s.run("0..10").conserved]
        [('energy', 0.5, True)]
        """
        session, c = self._session, self._session.library
        name, start, drift = c_char_p(), c_double(), c_double()

        def body() -> List[Conserved]:
            found = []
            for i in range(c.qdot_motion_conserved(self._handle)):
                session.check(
                    c.qdot_motion_drift(self._handle, i, byref(name), byref(start), byref(drift))
                )
                found.append(Conserved((name.value or b"").decode(), start.value, drift.value))
            return found

        return session.look(body)

    def to_dataframe(
        self,
        expressions: Union[None, Expressions, Mapping[str, Expression]] = None,
        times: Optional[Times] = None,
        errors: bool = False,
    ) -> Any:
        """Return values as a DataFrame of pandas whose index is t.

        Parameters
        ----------
        expressions : str, sequence or mapping, optional
            As for `values`; by default coordinates and velocities.
        times : array_like, optional
            By default the ends of the steps.
        errors : bool
            Whether a column "error of NAME" follows each.
        """
        import pandas

        if expressions is None:
            expressions = list(self.end)
        if isinstance(expressions, str) or hasattr(expressions, "_language"):
            expressions = [language(expressions)]
        if not isinstance(expressions, Mapping):
            expressions = {text: text for text in map(language, expressions)}
        at = self.steps if times is None else floats(times, "times").ravel()
        values, off = self.values(expressions, at, errors=True)
        columns = {}
        for name in expressions:
            columns[name] = values[name]
            if errors:
                columns[f"error of {name}"] = off[name]
        return pandas.DataFrame(columns, index=pandas.Index(at, name="t"))

    def __repr__(self) -> str:
        s = self.summary
        ended = f", {s.reason}" if s.reason else ""
        return f"<qdot.Motion: t = {s.start:g}..{s.end:g}, {s.method}, {s.steps} steps{ended}>"

    def _repr_html_(self) -> str:
        s = self.summary
        error = "unknown" + (f": {s.doubt}" if s.doubt else "") if s.error != s.error else f"{s.error:.1g}"
        head = f"t = {s.start:g}..{s.end:g}, {s.method}, {s.steps} steps; error at the end {error}"
        if s.reason:
            head += f"; ended early: {s.reason}"
        rows = "".join(
            f"<tr><th>{html.escape(name)}</th><td>{value:.12g}</td></tr>"
            for name, value in self.end.items()
        )
        return f"<table><caption>{html.escape(head)}</caption>{rows}</table>"

    def __reduce__(self) -> Any:
        raise TypeError("a qdot.Motion cannot be copied or pickled: keep its values")


def _list(texts: Sequence[str]) -> str:
    """Return expressions as a list of the language; a comment ends with its line."""
    return "[" + ", ".join(text + "\n" if "#" in text else text for text in texts) + "]"


def _is_list(text: str) -> bool:
    return text.lstrip().startswith("[")


def _components(message: str) -> Optional[int]:
    """Read how many components an expression has in the library's refusal."""
    words = message.split()
    if words[:3] == ["the", "expression", "has"] and words[3].isdigit():
        return int(words[3])
    return None
