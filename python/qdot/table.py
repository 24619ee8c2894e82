"""Tables and numbers: what sweeps, fits and the like answer with."""

from __future__ import annotations

import html
from ctypes import c_void_p
from typing import TYPE_CHECKING, Any, Dict, Iterator, List, Mapping, Optional, Sequence

from .library import Library

if TYPE_CHECKING:
    import numpy
    import numpy.typing

    Array = numpy.typing.NDArray[Any]


class Table:
    """Columns of numbers, with their errors.

    ``table["x"]`` is a column as an array; a number that there is not, is NaN.

    Attributes
    ----------
    name : str
    columns : list of str
        Where rows of a sweep failed, there is a column "reason" of texts.
    units : dict
        The unit of a column, where it has one.

    Examples
    --------
    >>> import qdot
    >>> s = qdot.System("coord x; particle p mass 1 at (x, 0); potential x^2/2")
    >>> table = s.sweep("x = [1, 2, 3] run 0..1 : max(x'^2, 0..1) as speeds")
    >>> table.columns
    ['x', "max(x'^2, 0..1)"]
    >>> table["x"]
    array([1., 2., 3.])
    >>> bool((table.errors("max(x'^2, 0..1)") < 1e-10).all())
    True
    """

    def __init__(
        self,
        name: str,
        columns: Mapping[str, Array],
        errors: Mapping[str, Array],
        units: Optional[Mapping[str, str]] = None,
    ) -> None:
        self.name = name
        self.columns = list(columns)
        self.units = dict(units or {})
        self._values = dict(columns)
        self._errors = dict(errors)

    def __getitem__(self, column: str) -> Array:
        return self._values[self._known(column)]

    def errors(self, column: str) -> Array:
        """Return the errors of a column, absolute, estimated; NaN: unknown."""
        return self._errors[self._known(column)]

    def _known(self, column: str) -> str:
        if column not in self._values:
            raise KeyError(f"no column {column!r}: {', '.join(self.columns)}")
        return column

    def __len__(self) -> int:
        return len(self._values[self.columns[0]]) if self.columns else 0

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def keys(self) -> List[str]:
        """Return the names of the columns, so that ``dict(table)`` has all of it."""
        return list(self.columns)

    def to_dataframe(self, errors: bool = False) -> Any:
        """Return a DataFrame of pandas; `errors`: whether a column "error of NAME" follows each."""
        import pandas

        data = {}
        for column in self.columns:
            data[column] = self._values[column]
            if errors and column in self._errors:
                data[f"error of {column}"] = self._errors[column]
        return pandas.DataFrame(data)

    def __repr__(self) -> str:
        return f"<qdot.Table {self.name}: {', '.join(self.columns)}; {len(self)} rows>"

    def _repr_html_(self) -> str:
        head = "".join(f"<th>{html.escape(column)}</th>" for column in self.columns)
        shown = range(len(self)) if len(self) <= 60 else [*range(30), -1, *range(len(self) - 30, len(self))]
        rows = "".join(self._html_row(i) for i in shown)
        return f"<table><caption>{html.escape(self.name)}</caption><tr>{head}</tr>{rows}</table>"

    def _html_row(self, i: int) -> str:
        if i < 0:
            return f'<tr><td colspan="{len(self.columns)}">… {len(self) - 60} more rows</td></tr>'
        pairs = [(self._values[name][i], self._errors.get(name)) for name in self.columns]
        texts = [shown(value, None if errors is None else errors[i]) for value, errors in pairs]
        cells = "".join(f"<td>{html.escape(text)}</td>" for text in texts)
        return f"<tr>{cells}</tr>"


class Numbers(Mapping[str, Any]):
    """Numbers by name, with their errors: what `fit`, `find`, `sensitivity` answer with.

    Attributes
    ----------
    errors : dict
        The errors, absolute; NaN: unknown.

    Examples
    --------
    >>> import qdot
    >>> s = qdot.System("coord x; particle p mass 1 at (x, 0); potential x^2/2; start x = 1")
    >>> found = s.numbers("find x = 1 such that value(x, pi) = -2")
    >>> round(found["x"], 9), found.errors["x"] < 1e-9
    (2.0, True)
    """

    def __init__(self, values: Mapping[str, Any], errors: Mapping[str, float]) -> None:
        self._values = dict(values)
        self.errors = dict(errors)

    def __getitem__(self, name: str) -> Any:
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def to_dataframe(self) -> Any:
        """Return a DataFrame of pandas with columns "value" and "error"."""
        import pandas

        names = list(self._values)
        data = {"value": list(self._values.values()), "error": [self.errors[n] for n in names]}
        return pandas.DataFrame(data, index=names)

    def __repr__(self) -> str:
        parts = [f"{name} = {shown(x, self.errors[name])}" for name, x in self._values.items()]
        return f"<qdot.{type(self).__name__}: {', '.join(parts)}>"

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><th>{html.escape(name)}</th><td>{html.escape(shown(x, self.errors[name]))}</td></tr>"
            for name, x in self._values.items()
        )
        return f"<table>{rows}</table>"


class Fit(Numbers):
    """Parameters that fit data best; their errors are standard deviations.

    Attributes
    ----------
    chi2 : float
        The sum of the squares of the residuals over their sigma.
    degrees_of_freedom : int
    covariance : ndarray
        Of the parameters, in their order.
    """

    def __init__(
        self,
        values: Mapping[str, Any],
        errors: Mapping[str, float],
        more: Mapping[str, Any],
        covariance: Sequence[Sequence[float]],
    ) -> None:
        super().__init__(values, errors)
        self.chi2: float = more.get("chi^2", float("nan"))
        self.degrees_of_freedom = int(more.get("degrees of freedom", 0))
        self.covariance: Array = _array(covariance)


def shown(value: Any, error: Any) -> str:
    """Return a number with as many digits as its error leaves.

    >>> from qdot.table import shown
    >>> shown(9.804964259856616, 0.002592760210505143), shown(2.0, 0.0), shown(0.5, float("nan"))
    ('9.8050 ± 0.0026', '2', '0.5')
    """
    if not isinstance(value, float) or value != value:
        return "" if value is None or value != value else str(value)
    if not isinstance(error, float) or not error > 0 or error == float("inf"):
        return f"{value:.12g}"
    from decimal import Decimal

    place = Decimal(f"{error:.1e}").adjusted() - 1
    digits = min(max(0, -place), 400)
    if place > 0 or digits > 15 or abs(value) >= 1e15:
        return f"{value:.15g} ± {error:.2g}"
    return f"{value:.{digits}f} ± {error:.{digits}f}"


def _array(cells: Sequence[Any]) -> Array:
    import numpy

    cells = [float("nan") if cell is None else cell for cell in cells]
    try:
        return numpy.array(cells, dtype=float)
    except (TypeError, ValueError):
        return numpy.array(cells, dtype=object)


# --- out of the objects of the notation DISPLAY -----------------------------------------


def table_of(answers: Sequence[Mapping[str, Any]]) -> Optional[Table]:
    """Return the last table among the answers."""
    head: Optional[Mapping[str, Any]] = None
    rows: List[Mapping[str, Any]] = []
    for answer in answers:
        if answer["kind"] == "columns":
            head, rows = answer, []
        elif answer["kind"] == "row":
            rows.append(answer)
    if head is None:
        return None
    names = head["columns"]
    none = [None] * len(names)
    columns = {name: _array([row["values"][i] for row in rows]) for i, name in enumerate(names)}
    errors = {
        name: _array([(row.get("errors") or none)[i] for row in rows]) for i, name in enumerate(names)
    }
    if any(row.get("reason") for row in rows):
        columns["reason"] = _array([row.get("reason") or "" for row in rows])
    return Table(head.get("name") or "table", columns, errors)


def copied(library: Library, handle: c_void_p, name: str) -> Table:
    """Return a qdot_table as a table of arrays of its own."""
    import numpy

    def numbers(given: Any) -> Any:
        return numpy.ctypeslib.as_array(given, (n,)).copy() if n > 0 else numpy.empty(0)

    n = library.qdot_table_rows(handle)
    columns, errors, units = {}, {}, {}
    for i in range(library.qdot_table_columns(handle)):
        column = library.qdot_table_column_name(handle, i).decode()
        unit = library.qdot_table_column_unit(handle, i).decode()
        if unit:
            units[column] = unit
        if library.qdot_table_numbers(handle, i):
            columns[column] = numbers(library.qdot_table_numbers(handle, i))
            errors[column] = numbers(library.qdot_table_errors(handle, i))
        else:
            cells = [library.qdot_table_cell(handle, i, row).decode() for row in range(n)]
            columns[column] = numpy.array(cells, dtype=object)
    return Table(name, columns, errors, units)


def numbers_of(answers: Sequence[Mapping[str, Any]]) -> Numbers:
    """Return the numbers among the answers."""
    values: Dict[str, Any] = {}
    errors: Dict[str, float] = {}
    for answer in answers:
        if answer["kind"] == "number":
            value, error = answer["value"], answer.get("error")
            values[answer["name"]] = complex(*value) if isinstance(value, list) else value
            errors[answer["name"]] = float("nan") if error is None else error
    return Numbers(values, errors)


def fit_of(answers: Sequence[Mapping[str, Any]]) -> Fit:
    """Return what `fit` has found."""
    found = numbers_of(answers)
    rows = [answer["values"] for answer in answers if answer["kind"] == "numbers"]
    names = list(found)[: len(rows)]
    values = {name: found[name] for name in names}
    more = {name: found[name] for name in found if name not in values}
    return Fit(values, {name: found.errors[name] for name in names}, more, rows)
