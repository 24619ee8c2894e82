"""The magics of `%load_ext qdot`: statements of qdot beside Python cells, variables passed both ways.

    %%qdot -i m,k -o T,x_end=value(x,10)
    coord x
    particle p mass m at (x, 0); potential k*x^2/2
    start x = 1; run 0..10
"""

from __future__ import annotations

import csv
import itertools
import keyword
import os
import re
import sys
import tempfile
from typing import Any, Dict, Iterator, List, Mapping, Optional, Tuple

from IPython.core.error import UsageError
from IPython.core.magic import Magics, line_cell_magic, magics_class

from .cells import Progress, carry_out
from .completion import install as install_completion
from .display import Output
from .errors import Error, KindError, UnknownNameError
from .library import load as load_library
from .system import System, written

__all__ = ["CellError", "Number", "QdotMagics", "load"]


class CellError(Error):
    """A statement of a cell that failed: shown with its line, caret and hint, without Python's traceback."""

    def __init__(self, output: Output) -> None:
        super().__init__(output.text)
        answer = output.answer or {}
        self.message, self.hint = answer.get("message", self.message), answer.get("hint")

    def _render_traceback_(self) -> List[str]:
        head, *rest = self.text.split("\n")
        return [f"\x1b[31m{head}\x1b[0m"] + rest


class Number(float):
    """A number of a session: a float that knows what it may be off by.

    Attributes
    ----------
    error : float
        0: exact but for rounding; NaN: unknown.
    """

    error: float

    def __new__(cls, value: float, error: float = 0.0) -> Number:
        number = super().__new__(cls, value)
        number.error = error
        return number

    def __repr__(self) -> str:
        return load_library().number_text(float(self), self.error)


_USAGE = """usage: %%qdot [-i NAMES] [-o NAMES] [--system NAME]
  -i m,k       variables of Python that the cell uses: numbers become parameters (of a coordinate: its
               start), lists and arrays lists and matrices, formulas named expressions; a table
               (DataFrame, dictionary of columns, structured array) is the file "NAME" in the cell
  -o T,x1=E    what Python gets: formulas, numbers, runs, tables; x1=E gives the expression E the name x1
  --system s   the variable that holds the qdot.System; without it, one for the notebook"""

_OPTION = re.compile(
    r"""\s*(-i|--input|-o|--output|--system)(?:\s+|=)((?:"[^"]*"|'[^']*'|[^\s"'])+)"""
)
_QUOTED = re.compile(r"""("|')(.*?)\1""")


@magics_class
class QdotMagics(Magics):
    """The magics `%qdot` and `%%qdot`, and the systems that their cells are for."""

    def __init__(self, shell: Any) -> None:
        super().__init__(shell)
        self._system: Optional[System] = None
        self._folder: Optional[tempfile.TemporaryDirectory[str]] = None
        self._cells = itertools.count(1)

    @line_cell_magic
    def qdot(self, line: str, cell: Optional[str] = None) -> None:
        """Carry out statements of qdot: `%qdot STATEMENT`, or a cell that begins with `%%qdot`."""
        options, rest = _options(line)
        if cell is not None and rest:
            raise UsageError(f"`{rest}` is no option\n{_USAGE}")
        if cell is None and not rest and not options["output"]:
            raise UsageError(_USAGE)
        outputs = list(_outputs_wanted(options["output"]))
        system = self._the_system(options["system"])
        code = rest if cell is None else cell
        for name in _names(options["input"]):
            code = self._enter(system, name, code)
        self._carry_out(system, code)
        for name, expression in outputs:
            try:
                self.shell.user_ns[name] = _value(system, expression)
            except Error as error:
                hint = f"; {error.hint}" if error.hint else ""
                raise UsageError(f"-o: `{name}`: {error.message}{hint}") from None

    # --- the system of a cell -----------------------------------------------------------

    def _the_system(self, name: Optional[str]) -> System:
        if name is None:
            if self._system is None:
                self._system = System().keep_undo()
            return self._system
        if not _is_variable(name):
            raise UsageError(f"--system: `{name}` is no name of a variable")
        system = self.shell.user_ns.get(name)
        if system is None:
            system = self.shell.user_ns[name] = System().keep_undo()
        if not isinstance(system, System):
            raise UsageError(
                f"--system: `{name}` holds no qdot.System but a {type(system).__name__}"
            )
        return system

    def look(self, line: str) -> Tuple[System, str]:
        """The system for which a line is, a new one where there is none yet; what is behind the options."""
        options, rest = _options(line)
        name = options["system"]
        system = self._system if name is None else self.shell.user_ns.get(name)
        return system if isinstance(system, System) else System(), rest

    def _carry_out(self, system: System, code: str) -> None:
        publish = self.shell.display_pub.publish
        has_display = hasattr(self.shell, "kernel")  # a terminal draws nothing in its place

        def draw(data: Dict[str, str], display_id: str, again: bool) -> None:
            if has_display:
                publish(data, {}, transient={"display_id": display_id}, update=again)

        name = f"cell {next(self._cells)}"
        for output in carry_out(system, code, name, Progress(draw)):
            if output.kind == "error":
                raise CellError(output)
            if output.kind == "display":
                publish(output.data, {})
            else:
                print(output.text, end="", file=getattr(sys, output.kind))

    # --- from Python --------------------------------------------------------------------

    def _enter(self, system: System, name: str, code: str) -> str:
        """Make the variable known to the session; the cell, with a table's name as that of its file."""
        if name not in self.shell.user_ns:
            raise UsageError(f"-i: there is no variable `{name}`")
        value = self.shell.user_ns[name]
        columns = _columns(value)
        if columns is not None:
            return code.replace(f'"{name}"', f'"{self._file(name, columns)}"')
        if hasattr(value, "tolist"):  # NumPy's
            value = value.tolist()
        if isinstance(value, (list, tuple, range)):
            _declare(system, name, [f"{name} = {_list(name, value)}"])
        elif isinstance(value, (bool, complex)) or not hasattr(value, "__float__"):
            if not hasattr(value, "plain") and not hasattr(value, "free_symbols"):
                kind = type(value).__name__
                raise UsageError(
                    f"-i: `{name}` is a {kind}, neither a number nor a table nor a formula"
                )
            _declare(system, name, [f"{name} = {value}"])
        elif hasattr(value, "free_symbols") and value.free_symbols:
            _declare(system, name, [f"{name} = {value}"])
        else:
            number = _written(name, value)
            _declare(
                system, name, [f"{word} {name} = {number}" for word in ("set", "start", "param")]
            )
        return code

    def _file(self, name: str, columns: Mapping[str, Any]) -> str:
        """The path of a CSV file with the columns, which is there as long as this session."""
        if self._folder is None:
            self._folder = tempfile.TemporaryDirectory(prefix="qdot-")
        path = os.path.join(self._folder.name, name + ".csv")
        try:
            lists = [
                column.tolist() if hasattr(column, "tolist") else list(column)
                for column in columns.values()
            ]
        except TypeError:
            raise UsageError(f"-i: `{name}`: its columns are no lists") from None
        if len({len(column) for column in lists}) > 1:
            raise UsageError(f"-i: the columns of `{name}` have different lengths")
        with open(path, "w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(columns.keys())
            writer.writerows(zip(*lists))
        return path


def _options(line: str) -> Tuple[Dict[str, Optional[str]], str]:
    """The options at the beginning of the line, and what stands behind them."""
    options: Dict[str, Optional[str]] = {"input": None, "output": None, "system": None}
    names = {"-i": "input", "-o": "output"}
    place = 0
    while True:
        found = _OPTION.match(line, place)
        if found is None:
            break
        option = names.get(found[1], found[1].lstrip("-"))
        text = _QUOTED.sub(r"\2", found[2])
        options[option] = text if options[option] is None else f"{options[option]},{text}"
        place = found.end()
    return options, line[place:].strip()


def _names(text: Optional[str]) -> Iterator[str]:
    """The names of a list with commas; commas within brackets are none."""
    depth, begin = 0, 0
    text = (text or "") + ","
    for i, c in enumerate(text):
        depth += (c in "([{") - (c in ")]}")
        if c == "," and depth <= 0:
            if text[begin:i].strip():
                yield text[begin:i].strip()
            begin = i + 1


def _outputs_wanted(text: Optional[str]) -> Iterator[Tuple[str, str]]:
    """The variables that Python gets, each with the expression that is its value."""
    for part in _names(text):
        name, sign, expression = part.partition("=")
        name = name.strip()
        expression = expression.strip() if sign else name
        if not _is_variable(name):
            raise UsageError(f'-o: `{name}` is no name of a variable; write -o "x1={expression or "T"}"')
        if not expression:
            raise UsageError(f'-o: there is no expression for `{name}`; write -o "{name}=T"')
        yield name, expression


def _is_variable(name: str) -> bool:
    return name.isidentifier() and not keyword.iskeyword(name)


def _columns(value: Any) -> Optional[Mapping[str, Any]]:
    """The columns of a table by their names; None: it is no table."""
    names = getattr(getattr(value, "dtype", None), "names", None)  # a structured array
    if names is None and hasattr(value, "columns") and hasattr(value, "iloc"):  # pandas'
        names = list(value.columns)
    if names is None and isinstance(value, Mapping):
        names = list(value)
    return None if names is None else {str(name): value[name] for name in names}


def _list(name: str, value: Any) -> str:
    """A list, or a matrix of lists of one length, as the language writes it."""
    if value and all(isinstance(row, (list, tuple)) for row in value):
        if len({len(row) for row in value}) != 1:
            raise UsageError(f"-i: the rows of `{name}` have different lengths")
        return "[" + "; ".join(_written(name, row)[1:-1] for row in value) + "]"
    return _written(name, value)


def _written(name: str, value: Any) -> str:
    """A number or a list of them as the language writes it."""
    try:
        return written(value)
    except Error as error:
        raise UsageError(f"-i: `{name}`: {error.message}") from None
    except TypeError as error:
        raise UsageError(f"-i: `{name}`: {error}") from None


def _declare(system: System, name: str, statements: List[str]) -> None:
    """Carry out the first of the statements that can be: a parameter is set if there is one, else made."""
    for statement in statements:
        try:
            system.declare(statement)
            return
        except Error as error:
            failed = error
    raise UsageError(f"-i: `{name}`: {failed.message}")


def _value(system: System, expression: str) -> Any:
    """What a name or an expression is in the session: a table, a number, a formula or a run."""
    if re.match(r"run\b", expression):
        return system.run(expression[3:])
    if re.fullmatch(r"\w+(\[\d+\])?", expression):
        try:
            return system.table(expression)
        except Error:
            pass  # there is no table of this name
    try:
        formula = system.derive(expression)
    except KindError:  # numbers of runs stand in it
        return Number(*system.number(expression, error=True))
    except UnknownNameError:
        try:
            return system.motion(expression)
        except UnknownNameError:
            pass  # it is no run's name either
        raise
    if _A_NUMBER.fullmatch(formula.plain):
        return Number(system.number(expression))
    return formula


_A_NUMBER = re.compile(r"-?[\d.]+(e-?\d+)?|-?\d+/\d+")


def load(shell: Any) -> None:
    """Make the magics known to IPython, for `%load_ext qdot`."""
    magics = QdotMagics(shell)
    shell.register_magics(magics)
    install_completion(shell, magics.look)
