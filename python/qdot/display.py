"""What a notebook shows of the answers of a session.

`qdot.System.display` answers with JSON objects: formulas, numbers, rows of tables, runs, checks, figures,
pages. `outputs` turns them into outputs in Jupyter's forms, each a MIME bundle with at least
`text/plain`, so that a terminal shows what a browser does. Nothing here needs a session or a network.
"""

from __future__ import annotations

import base64
import html
import mimetypes
import os
import re
import unicodedata
from dataclasses import dataclass, field
from typing import Any, Dict, Iterable, Iterator, List, Optional, Sequence, Tuple

from .notation import bound_text, latex_name, number_text, unicode_formula, unicode_name

__all__ = ["Output", "outputs", "error_lines", "page_html", "progress_bundle"]

Answer = Dict[str, Any]


@dataclass
class Output:
    """One output below a cell.

    Attributes
    ----------
    kind
        "display" (`data` is a MIME bundle), "stdout" or "stderr" (`data["text/plain"]` is the text) or
        "error" (the same; `answer` holds line, column, message and hint).
    """

    kind: str
    data: Dict[str, str]
    answer: Optional[Answer] = field(default=None, repr=False)

    @property
    def text(self) -> str:
        """The output where there is only text."""
        return self.data["text/plain"]


def outputs(
    answers: Iterable[Answer], source: str = "", name: str = "", folder: str = "."
) -> List[Output]:
    """The outputs for the answers to the statements `source`, in their order.

    Parameters
    ----------
    answers
        The objects, as `System.display` returns them.
    source
        The statements, of which an error shows its line.
    name
        What errors call the source: ``In[5]``.
    folder
        Where paths of written files begin.
    """
    shown: List[Output] = []
    first: Answer = {}
    for group in _grouped(answers):
        last, first = first, group[0]
        if first["kind"] in _TABLES or len(group) > 1:
            shown.append(_TABLES.get(first["kind"], _list_of_numbers)(group))
        elif first["kind"] == "error":
            text = "\n".join(error_lines(first, source, name))
            shown.append(Output("error", {"text/plain": text}, first))
        else:
            if first["kind"] == "text" and _belongs_to_formula(first, last):
                _append_words(shown[-1], first["text"])
                continue
            for output in _SINGLE.get(first["kind"], _unknown)(first, folder):
                if output.kind in ("stdout", "stderr") and shown and shown[-1].kind == output.kind:
                    shown[-1].data["text/plain"] += output.text
                else:
                    shown.append(output)
    return shown


def _grouped(answers: Iterable[Answer]) -> Iterator[List[Answer]]:
    """The answers, those together that make one table."""
    group: List[Answer] = []
    for answer in answers:
        if group and not _belongs(answer, group):
            yield group
            group = []
        group.append(answer)
        if answer["kind"] not in ("columns", "row", "unit", "number", "numbers"):
            yield group
            group = []
    if group:
        yield group


def _belongs(answer: Answer, group: List[Answer]) -> bool:
    """Whether the answer is a further row of the table that the group is."""
    last = group[-1]
    if answer["kind"] in ("number", "numbers"):
        same = answer.get("statement") == last.get("statement")
        return bool(same and last["kind"] in ("number", "numbers"))
    if answer["kind"] != "row":
        return bool(answer["kind"] == last["kind"] == "unit")
    if last["kind"] == "columns":
        return answer.get("name") in (None, last.get("name"))
    return (
        last["kind"] == "row"
        and answer.get("name") == last.get("name")
        and ("type" in answer) == ("type" in last)
        and len(answer["values"]) == len(last["values"])
    )


# --- formulas and numbers ---------------------------------------------------------------


def _display(plain: str, **more: str) -> Output:
    data = {"text/plain": plain}
    data.update({mime.replace("_", "/", 1).replace("_", "+"): text for mime, text in more.items()})
    return Output("display", data)


def _typeset(latex: str) -> str:
    """LaTeX that stands at the left, with fractions as large as in a displayed formula."""
    return r"$\displaystyle " + latex + "$"


def _formula(answer: Answer, folder: str) -> List[Output]:
    name, plain = answer.get("name"), unicode_formula(answer["plain"])
    if name is not None and name != answer["plain"]:
        # an equation has no further "name =" before it: the name is what it is of
        separator = ":" if _is_relation(answer["plain"]) else " ="
        plain = unicode_name(name) + separator + " " + plain
    latex = answer["typeset"]["latex"] if "typeset" in answer else answer["latex"]
    return [_display(plain, text_latex=_typeset(latex))]


def _is_relation(plain: str) -> bool:
    """Whether the formula is an equation or an inequality: a sign of relation outside all brackets."""
    depth = 0
    for c in plain:
        depth += (c in "([{") - (c in ")]}")
        if depth == 0 and c in "=<>":
            return True
    return False


def _latex_number(text: str) -> str:
    """A number with its error, as `number_text` writes it, in LaTeX."""
    text, _, unit = text.partition(" [")
    parts = []
    for part in text.split(" ± "):
        mantissa, mark, exponent = part.partition("e") if part != "unknown" else (part, "", "")
        if mark:
            mantissa += r" \times 10^{" + exponent + "}"
        parts.append(r"\text{unknown}" if part == "unknown" else mantissa)
    latex = r" \pm ".join(parts)
    return latex + (_latex_unit(unit[:-1]) if unit else "")


def _latex_unit(unit: str) -> str:
    return (
        r"\ \left[\mathrm{"
        + re.sub(r"\^(-?[0-9]+)", r"^{\1}", unit).replace("*", r"\,")
        + r"}\right]"
    )


def _list_of_numbers(group: List[Answer]) -> Output:
    """The numbers that one statement answers, such as the unknowns of a fit, as a table."""
    # beside degrees of freedom errors are standard errors, and chi^2 and covariances are without one
    fit = any(answer["name"] == "degrees of freedom" for answer in group)
    rows = []
    for answer in group:
        values, errors, units = _values(answer)
        if fit and all(error is None for error in errors):
            numbers = [f"{value:.3g}" for value in values]
        else:
            numbers = [number_text(*entry, statistical=fit) for entry in zip(values, errors, units)]
        rows.append((_name(answer), ", ".join(numbers)))
    plain = "\n".join(f"{name} = {text}" for name, text in rows)
    cells = [[html.escape(cell) for cell in row] for row in rows]
    return _display(plain, text_html=_html_table([], cells, left=(0, 1)))


def _values(answer: Answer) -> Tuple[List[Any], List[Optional[float]], List[Optional[str]]]:
    """The numbers of an answer, their errors and units."""
    values = answer["values"] if answer["kind"] == "numbers" else [answer["value"]]
    errors = answer.get("errors") or [answer.get("error", 0.0)] * len(values)
    return values, errors, answer.get("units") or [answer.get("unit")] * len(values)


def _name(answer: Answer) -> str:
    return unicode_formula(answer["name"])


def _number(answer: Answer, folder: str) -> List[Output]:
    numbers = [number_text(*entry) for entry in zip(*_values(answer))]
    latex = latex_name(answer["name"]) + " = "
    return [
        _display(
            _name(answer) + " = " + ", ".join(numbers),
            text_latex=_typeset(latex + r",\quad ".join(map(_latex_number, numbers))),
        )
    ]


def _belongs_to_formula(text: Answer, last: Answer) -> bool:
    """Whether the text says more of the formula before it in a few words, as "stable" of an equilibrium."""
    same = last.get("kind") == "expr" and last.get("name") == text.get("name")
    return same and not re.search(r"[\n\\^_{}#$%&:]", text["text"].rstrip("\n"))


def _append_words(formula: Output, words: str) -> None:
    formula.data["text/plain"] += ", " + words.rstrip("\n")
    formula.data["text/latex"] = (
        formula.data["text/latex"][:-1] + r",\quad \text{" + words.rstrip("\n") + "}$"
    )


# --- tables -----------------------------------------------------------------------------

_CELL = ' style="text-align:right;white-space:nowrap;font-variant-numeric:tabular-nums"'
_WORDS = ' style="text-align:left"'

# A longer table shows its first and last rows.
_ROWS_SHOWN = 16


def _html_table(
    head: Sequence[str],
    rows: Sequence[Sequence[str]],
    caption: str = "",
    left: Sequence[int] = (),
    foot: str = "",
) -> str:
    """An HTML table; all texts are HTML already. left: the columns of words."""

    def line(tag: str, cells: Sequence[str]) -> str:
        return (
            "<tr>"
            + "".join(
                f"<{tag}{_WORDS if i in left else _CELL}>{cell}</{tag}>"
                for i, cell in enumerate(cells)
            )
            + "</tr>"
        )

    text = '<div style="overflow-x:auto"><table class="qdot">'
    if caption:
        text += f'<caption style="text-align:left;caption-side:top;white-space:nowrap">{caption}</caption>'
    if head:
        text += "<thead>" + line("th", head) + "</thead>"
    text += "<tbody>" + "".join(line("td", row) for row in rows) + "</tbody></table>"
    return text + (f"<p>{foot}</p>" if foot else "") + "</div>"


def _width(text: str) -> int:
    """How many columns a terminal needs for the text."""
    return sum(not unicodedata.combining(c) for c in text)


def _text_table(
    head: Sequence[str], rows: Sequence[Sequence[str]], left: Sequence[int] = ()
) -> str:
    """The table in columns of equal width."""
    lines = ([head] if head else []) + list(rows)
    widths = [max(_width(line[i]) for line in lines) for i in range(len(lines[0]))] if lines else []

    def pad(i: int, cell: str) -> str:
        space = " " * (widths[i] - _width(cell))
        return cell + space if i in left else space + cell

    return "\n".join(
        "  ".join(pad(i, cell) for i, cell in enumerate(line)).rstrip() for line in lines
    )


def _table(group: List[Answer]) -> Output:
    columns = group[0] if group[0]["kind"] == "columns" else {}
    rows = [answer for answer in group if answer["kind"] == "row"]
    name = str(columns.get("name") or (rows[0].get("name") if rows else None) or "")
    head = list(columns.get("columns") or [])
    units = columns.get("units") or []
    left: List[int] = []
    cells = [_row_cells(row) for row in rows]
    if head:
        head = [
            unicode_name(title) + (f" [{units[i]}]" if i < len(units) and units[i] else "")
            for i, title in enumerate(head)
        ]
    for title, entry in (("type", "type"), ("stable", "stable"), ("status", "status")):
        if entry == "status" and all(row.get("status", "done") == "done" for row in rows):
            continue
        if any(entry in row for row in rows):
            left.append(len(cells[0]))
            head = head + [title] if head else head
            for row, line in zip(rows, cells):
                line.append(_row_word(row, entry))
    left += [
        i
        for i in range(len(cells[0]) if cells else 0)
        if i not in left
        and any(isinstance(row["values"][i], str) for row in rows if i < len(row["values"]))
    ]
    foot = f"{len(rows)} rows" if len(rows) > _ROWS_SHOWN else ""
    if foot:
        half = _ROWS_SHOWN // 2
        cells = cells[:half] + [["⋮"] * len(cells[0])] + cells[-half:]
    caption = "" if name == "table" else name
    plain = "\n".join(
        filter(None, [caption and caption + ":", _text_table(head, cells, left), foot])
    )
    return _display(
        plain,
        text_html=_html_table(
            [html.escape(title) for title in head],
            [[html.escape(cell) for cell in line] for line in cells],
            html.escape(caption),
            left,
            foot,
        ),
    )


def _row_cells(row: Answer) -> List[str]:
    values = row["values"]
    errors = row.get("errors") or [0.0] * len(values)
    return [
        value
        if isinstance(value, str) and not errors[i]
        else "–"
        if value is None
        else number_text(value, errors[i])
        for i, value in enumerate(values)
    ]


def _row_word(row: Answer, entry: str) -> str:
    said = row.get(entry)
    if entry == "status":
        return f"{said}: {row['reason']}" if row.get("reason") else str(said)
    return (
        {True: "stable", False: "unstable", None: "unknown"}.get(said, str(said))
        if entry == "stable"
        else str(said)
    )


def _units(group: List[Answer]) -> Output:
    head = ["name", "dimension", "unit"]
    rows = [
        [unicode_name(a["name"]), a.get("dimension") or "–", a.get("unit") or "–"] for a in group
    ]
    return _display(
        _text_table(head, rows, (0, 1, 2)),
        text_html=_html_table(
            head, [[html.escape(cell) for cell in row] for row in rows], left=(0, 1, 2)
        ),
    )


_TABLES = {"columns": _table, "row": _table, "unit": _units}


# --- runs and checks --------------------------------------------------------------------


def _run(answer: Answer, folder: str) -> List[Output]:
    begin, end = (number_text(t) for t in answer["t"])
    title = f"{answer['name']}: t = {begin}..{end}, method {answer['method']}, "
    title += f"tol {number_text(answer['tol'])}, {answer['status']}"
    title += f": {answer['reason']}" if answer.get("reason") else ""
    facts = _run_facts(answer)
    numbers = [] if answer.get("horizon") is not None else _end_state(answer)
    plain = "\n".join(
        [title]
        + [f"  {what}: {text}" for what, text in facts]
        + (["  end state:"] if numbers else [])
        + [f"    {name} = {text}" for name, text in numbers]
    )
    rows = [[html.escape(name), html.escape(text)] for name, text in numbers + facts]
    return [
        _display(
            plain, text_html=_html_table([], rows, f"<b>{html.escape(title)}</b>", left=(0, 1))
        )
    ]


def _run_facts(answer: Answer) -> List[Tuple[str, str]]:
    """What the report of a run says beside the end state, each with its name."""
    scaled = "scaled_error" in answer
    error = answer.get("scaled_error" if scaled else "error")
    relative = "max(scale, |value|)" if scaled else "max(1, |value|)"
    facts = [
        (
            "error of the end state",
            "unknown" if error is None else f"at most {bound_text(error)} of {relative}",
        )
    ]
    if answer.get("horizon") is not None:
        facts.append(
            (
                "horizon",
                f"t = {number_text(answer['horizon'], 0.005 * abs(answer['horizon'])).split(' ±')[0]}; "
                "no digit of the state beyond it is right",
            )
        )
    drifts = [
        f"{unicode_name(name)} {'unknown' if drift is None else bound_text(abs(drift))}"
        for name, drift in (answer.get("drifts") or {}).items()
    ]
    facts.append(("drift", ", ".join(drifts) or "no conserved quantity is known"))
    if answer.get("constraint_drift") is not None:
        facts.append(("error of constraints", bound_text(answer["constraint_drift"])))
    facts.append(
        (
            "steps",
            f"{answer['steps']}, {answer['rejected']} rejected, {answer['evals']} evaluations",
        )
    )
    facts.append(
        ("CPU time", _seconds(answer["cpu"]) + ", in all " + _seconds(answer["cpu_total"]))
    )
    return facts


def _end_state(answer: Answer) -> List[Tuple[str, str]]:
    """The numbers of the end state, each with its own absolute error where that is known."""
    multipliers = (answer.get("constraints") or {}).get("errors") or {}
    numbers = []
    for name, value in answer["state"].items():
        if value is None:
            text = "unknown"
        elif "scaled_error" in answer and name not in multipliers:
            text = number_text(
                value
            )  # its error is a part of a scale that the answer does not hold
        else:
            error = multipliers.get(name) if name in multipliers else answer.get("error")
            if error is not None and name not in multipliers:
                error *= max(1.0, abs(float(value)))
            text = number_text(
                value, error if error is None else max(error, 2e-16 * abs(float(value)))
            )
        numbers.append((unicode_name(name), text))
    return numbers


def _seconds(s: float) -> str:
    return f"{s * 1e3:.3g} ms" if s < 1 else f"{s:.4g} s"


_MARKS = {"proved": ("✓", "#1a7f37"), "refuted": ("✗", "#cf222e"), "undecided": ("?", "#9a6700")}


def _check(answer: Answer, folder: str) -> List[Output]:
    verdict, claim = answer["verdict"], answer.get("claim") or ""
    mark, colour = _MARKS[verdict]
    if claim.startswith("not "):  # it is the refutation that is expected
        mark, colour = _MARKS[{"proved": "refuted", "refuted": "proved"}.get(verdict, verdict)]
    at = answer.get("at") or {}
    values = answer.get("values") or []
    plain, table = verdict, ""
    if verdict == "refuted" and values:
        point = [(unicode_name(name), number_text(value)) for name, value in at.items()]
        sides = [("left", number_text(values[0])), ("right", number_text(values[1]))]
        plain += " at " + ", ".join(f"{name} = {text}" for name, text in point) if point else ""
        plain += ": " + ", ".join(f"{name} = {text}" for name, text in sides)
        table = _html_table(
            [html.escape(name) for name, _ in point + sides],
            [[html.escape(text) for _, text in point + sides]],
        )
    elif verdict == "undecided":
        digits = answer.get("digits")
        plain += (
            f": equal at random points to {digits} digits, no proof"
            if digits
            else ": no proof, no counterexample"
        )
    words = plain if verdict == "undecided" else verdict + (" at" if table and at else "")
    page = (
        f'<div><span style="color:{colour};font-weight:bold">{mark} {html.escape(words)}</span>'
        f" <code>{html.escape(claim)}</code></div>{table}"
    )
    return [_display(f"{mark} {plain}" + (f"   ({claim})" if claim else ""), text_html=page)]


# --- text, figures, files ---------------------------------------------------------------


def _text(answer: Answer, folder: str) -> List[Output]:
    return [Output("stdout", {"text/plain": answer["text"].rstrip("\n") + "\n"})]


def _notice(answer: Answer, folder: str) -> List[Output]:
    return [Output("stderr", {"text/plain": f"notice: {answer['message']}\n"})]


def _nothing(answer: Answer, folder: str) -> List[Output]:
    return []


def _unknown(answer: Answer, folder: str) -> List[Output]:
    """An answer of a later library: as it is, for nothing may be lost."""
    return [Output("stdout", {"text/plain": f"{answer}\n"})]


def _figure(answer: Answer, folder: str) -> List[Output]:
    return [_picture(answer["mime"], answer["data"], answer.get("name") or "figure")]


def _picture(mime: str, data: Any, name: str) -> Output:
    """A picture; data: the text of an SVG file, bytes of any other."""
    if mime == "image/svg+xml":
        data = data[max(data.find("<svg"), 0) :]
    coded = base64.b64encode(data.encode() if isinstance(data, str) else data).decode("ascii")
    bundle = {"text/plain": f"[{name}]"}
    if mime in ("image/png", "image/jpeg"):
        bundle[mime] = coded
    else:
        # as an element, for nbconvert takes an SVG file apart and does not know GIF
        bundle[
            "text/html"
        ] = f'<img alt="{html.escape(name)}" style="max-width:100%" src="data:{mime};base64,{coded}">'
    if mime == "image/svg+xml":
        bundle[mime] = data  # what is printed is made of it
    return Output("display", bundle)


def page_html(page: str, name: str = "page") -> str:
    """A whole page as an element of a notebook: it needs no network, no file and no server beside it."""
    return (
        f'<iframe title="{html.escape(name, quote=True)}" srcdoc="{html.escape(page, quote=True)}" '
        'style="width:100%;height:560px;border:1px solid #d5d9de" '
        'onload="try{this.style.height=Math.min(Math.max('
        "this.contentDocument.documentElement.scrollHeight+4,200),720)+'px'}catch(e){}\"></iframe>"
    )


def _page(answer: Answer, folder: str) -> List[Output]:
    name = answer.get("name") or "page"
    return [_display(f"[{name}]", text_html=page_html(answer["data"], name))]


# A larger file is named and not shown: the notebook would hold it whole.
_LARGEST_SHOWN = 8 << 20


def _file(answer: Answer, folder: str) -> List[Output]:
    path = answer["path"]
    wrote = Output("stdout", {"text/plain": f"wrote {path}\n"})
    mime = mimetypes.guess_type(path)[0] or ""
    if not (mime.startswith("image/") or mime == "text/html"):
        return [wrote]
    try:
        whole = os.path.join(folder, path)
        if os.path.getsize(whole) > _LARGEST_SHOWN:
            return [wrote]
        with open(whole, "rb") as file:
            data = file.read()
    except OSError:
        return [wrote]
    if mime == "text/html":
        return [
            wrote,
            _display(f"[{path}]", text_html=page_html(data.decode("utf-8", "replace"), path)),
        ]
    if mime == "image/svg+xml":
        return [wrote, _picture(mime, data.decode("utf-8", "replace"), path)]
    if mime in ("image/png", "image/jpeg", "image/gif", "image/webp"):
        return [wrote, _picture(mime, data, path)]
    return [wrote]


_SINGLE = {
    "expr": _formula,
    "number": _number,
    "numbers": _number,
    "run": _run,
    "check": _check,
    "text": _text,
    "notice": _notice,
    "figure": _figure,
    "page": _page,
    "file": _file,
    "done": _nothing,
}


# --- errors and progress ----------------------------------------------------------------


def error_lines(answer: Answer, source: str = "", name: str = "") -> List[str]:
    """The error as the program prints it: place and message, the line, a caret below the place, a hint."""
    line, column = answer.get("line") or 0, answer.get("column") or 0
    lines = source.split("\n")
    file = answer.get("file") or ""
    own = not file or file in _OWN_NAMES
    place = ":".join(str(part) for part in (name if own else file, line, column) if part)
    text = [f"{place}: error: {answer['message']}" if place else f"error: {answer['message']}"]
    if own and 0 < line <= len(lines):
        text += ["  " + lines[line - 1], "  " + _blanks(lines[line - 1], column) + "^"]
    if answer.get("hint"):
        text.append(f"  hint: {answer['hint']}")
    return text


# What the library calls a text that is no file.
_OWN_NAMES = ("ask", "display", "declare", "-e", "standard input")


def _blanks(line: str, column: int) -> str:
    """What stands before the caret: a blank for each letter, tabulators as they are."""
    before = line[: max(column - 1, 0)]
    return "".join("\t" if c == "\t" else " " for c in before if not unicodedata.combining(c))


def progress_bundle(what: str, done: float, left: Optional[float]) -> Dict[str, str]:
    """A bar for a computation of which the part `done` (0 to 1) is done and `left` seconds remain."""
    share = min(max(done, 0.0), 1.0) if done == done else 0.0
    remains = "" if left is None else f", {_remaining(left)} left"
    filled = round(share * 30)
    return {
        "text/plain": f"{what} [{'#' * filled}{'.' * (30 - filled)}] {share:.0%}{remains}",
        "text/html": f'<div>{html.escape(what)} <progress max="1" value="{share:.4f}" style="width:20em;'
        f'vertical-align:middle"></progress> {share:.0%}{remains}</div>',
    }


def _remaining(seconds: float) -> str:
    if seconds < 99:
        return f"{max(seconds, 0):.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5940 else f"{seconds / 3600:.1f} h"
