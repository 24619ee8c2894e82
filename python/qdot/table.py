"""Tables and numbers: what sweeps, fits and the like answer with."""

from __future__ import annotations

import html
from ctypes import c_void_p
from typing import TYPE_CHECKING, Any, Dict, Iterator, List, Mapping, Optional, Sequence

from .display import page_part
from .library import Library, load

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
        if self._known(column) not in self._errors:
            raise KeyError(f"column {column!r} has texts, which have no errors")
        return self._errors[column]

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

    _ipython_key_completions_ = keys  # what Tab offers behind table["

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
        heads = [name + (f" [{self.units[name]}]" if name in self.units else "") for name in self.columns]
        n = len(self)
        shown = range(n) if n <= 60 else [*range(30), *range(n - 30, n)]
        rows = [_html_row("td", [self._cell(name, i) for name in self.columns]) for i in shown]
        if n > 60:
            rows.insert(30, f'<tr><td colspan="{len(heads)}">… {n - 60} more rows</td></tr>')
        caption = f"<caption>{html.escape(self.name)}</caption>"
        return page_part(f"<table>{caption}{_html_row('th', heads)}{''.join(rows)}</table>")

    def _cell(self, name: str, i: int) -> str:
        """Return a number with as many digits as its error leaves, or a text."""
        value, errors = self._values[name][i], self._errors.get(name)
        if not isinstance(value, float):
            return str(value)
        if value != value:
            return "–"
        return load().number_text(value, 0.0 if errors is None or errors[i] is None else float(errors[i]))


def _html_row(tag: str, cells: Sequence[str]) -> str:
    return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"


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

    def __init__(
        self, values: Mapping[str, Any], errors: Mapping[str, float], answers: Sequence[Mapping[str, Any]]
    ) -> None:
        self._values = dict(values)
        self.errors = dict(errors)
        self._answers = list(answers)  # how the library writes the numbers

    def __getitem__(self, name: str) -> Any:
        if name not in self._values:
            raise KeyError(f"no number {name!r}: {', '.join(self._values)}")
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def _ipython_key_completions_(self) -> List[str]:
        return list(self._values)

    def to_dataframe(self) -> Any:
        """Return a DataFrame of pandas with columns "value" and "error"."""
        import pandas

        names = list(self._values)
        data = {"value": list(self._values.values()), "error": [self.errors[n] for n in names]}
        return pandas.DataFrame(data, index=names)

    def __repr__(self) -> str:
        return f"<qdot.{type(self).__name__}: {', '.join(answer['text'] for answer in self._answers)}>"

    def _repr_html_(self) -> str:
        return page_part("".join(answer["html"] for answer in self._answers))


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
        answers: Sequence[Mapping[str, Any]],
    ) -> None:
        super().__init__(values, errors, answers)
        self.chi2: float = more.get("chi^2", float("nan"))
        self.degrees_of_freedom = int(more.get("degrees of freedom", 0))
        self.covariance: Array = _array(covariance)


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
    units = {name: unit for name, unit in zip(names, head.get("units") or []) if unit}
    return Table(head.get("name") or "table", columns, errors, units)


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
    numbers = [answer for answer in answers if answer["kind"] == "number"]
    for answer in numbers:
        value, error = answer["value"], answer.get("error")
        values[answer["name"]] = complex(*value) if isinstance(value, list) else value
        errors[answer["name"]] = float("nan") if error is None else error
    return Numbers(values, errors, numbers)


def fit_of(answers: Sequence[Mapping[str, Any]]) -> Fit:
    """Return what `fit` has found."""
    found = numbers_of(answers)
    rows = [answer["values"] for answer in answers if answer["kind"] == "numbers"]
    names = list(found)[: len(rows)]
    values = {name: found[name] for name in names}
    more = {name: found[name] for name in found if name not in values}
    numbers = [answer for answer in answers if answer["kind"] == "number" and answer["name"] in values]
    return Fit(values, {name: found.errors[name] for name in names}, more, rows, numbers)
