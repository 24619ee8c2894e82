"""What a notebook shows of the answers of a session.

`qdot.System.display` answers with JSON objects, in which the library has worded, rounded and typeset what a
person reads: "text", "html", "typeset". `outputs` places these in Jupyter's forms, each a MIME bundle with at
least `text/plain`, so that a terminal shows what a browser does. Nothing here needs a session or a network.
"""

from __future__ import annotations

import base64
import html
import mimetypes
import os
import unicodedata
from dataclasses import dataclass, field
from typing import Any, Dict, Iterable, Iterator, List, Optional, Sequence

from .library import load

__all__ = ["Output", "outputs", "page_part", "page_html", "progress_bundle"]

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


def outputs(answers: Iterable[Answer], folder: str = ".") -> List[Output]:
    """The outputs for the answers, in their order.

    Parameters
    ----------
    answers
        The objects, as `System.display` returns them.
    folder
        Where paths of written files begin.
    """
    shown: List[Output] = []
    for group in _grouped(answers):
        for output in _outputs_of(group, folder):
            last = shown[-1] if shown else None
            if last and output.kind == last.kind and output.kind in ("stdout", "stderr"):
                last.data["text/plain"] += output.text
            else:
                shown.append(output)
    return shown


_ROWS = ("columns", "row", "unit")
_NUMBERS = ("number", "numbers")


def _grouped(answers: Iterable[Answer]) -> Iterator[List[Answer]]:
    """The answers, those together that stand in one table or below each other."""
    group: List[Answer] = []
    for answer in answers:
        if group and not _belongs(answer, group[-1]):
            yield group
            group = []
        group.append(answer)
    if group:
        yield group


def _belongs(answer: Answer, last: Answer) -> bool:
    """Whether the answer is shown together with the one before it."""
    kind, before = answer["kind"], last["kind"]
    if kind in _NUMBERS:
        return before in _NUMBERS and answer.get("statement") == last.get("statement")
    if kind == before == "text":
        return _has_formulas(answer) and _has_formulas(last)
    return kind == before == "unit" or (kind == "row" and before in ("columns", "row"))


def _has_formulas(answer: Answer) -> bool:
    return "<math" in answer.get("html", "")


def _outputs_of(group: List[Answer], folder: str) -> List[Output]:
    answer, kind = group[0], group[0]["kind"]
    if kind in _ROWS:
        return [_table(group)]
    if len(group) > 1:
        return [_display("\n".join(a["text"] for a in group), "".join(a["html"] for a in group))]
    if kind in _OF_FILES:
        return _OF_FILES[kind](answer, folder)
    if kind == "done":
        return []
    text = answer.get("text", str(answer))
    if kind == "error":
        return [Output("error", {"text/plain": text}, answer)]
    if "typeset" in answer:
        latex = rf"$\displaystyle {answer['typeset']['latex']}$"  # with fractions of full size
        return [Output("display", {"text/plain": text, "text/latex": latex})]
    if kind == "notice":
        return [Output("stderr", {"text/plain": text + "\n"})]
    if "html" not in answer or (kind == "text" and not _has_formulas(answer)):
        return [Output("stdout", {"text/plain": text + "\n"})]
    return [_display(text, answer["html"])]


def page_part(part: str) -> str:
    """A part of a page as an element that looks the same on every page."""
    return f'<div class="qdot" style="overflow-x:auto"><style>{load().style()}</style>{part}</div>'


def _display(text: str, part: str) -> Output:
    return Output("display", {"text/plain": text, "text/html": page_part(part)})


# --- tables -----------------------------------------------------------------------------

# A longer table shows its first and last rows.
_ROWS_SHOWN = 16


def _table(group: List[Answer]) -> Output:
    columns = [answer for answer in group if answer["kind"] == "columns"]
    rows = [answer for answer in group if answer["kind"] != "columns"]
    name = str(columns[0].get("name") or "") if columns else ""
    lines = [answer["cells"] for answer in columns + rows]
    parts = [answer["html"] for answer in columns + rows]
    foot = []
    if len(rows) > _ROWS_SHOWN:
        foot = [f"{len(rows)} rows"]
        first, last = len(columns) + _ROWS_SHOWN // 2, len(lines) - _ROWS_SHOWN // 2
        width = len(lines[-1])
        lines = lines[:first] + [["⋮"] * width] + lines[last:]
        parts = parts[:first] + ["<tr>" + "<td>⋮</td>" * width + "</tr>\n"] + parts[last:]
    caption = name if name != "table" else ""
    page = f"<caption>{html.escape(caption)}</caption>" if caption else ""
    page = f"<table>{page}{''.join(parts)}</table>" + "".join(f"<p>{line}</p>" for line in foot)
    text = ([caption + ":"] if caption else []) + [_text_table(lines)] + foot
    return _display("\n".join(text), page)


def _text_table(lines: Sequence[Sequence[str]]) -> str:
    """The cells in columns of equal width: numbers at the right, words at the left."""
    count = max(map(len, lines), default=0)
    columns = [[line[i] for line in lines if i < len(line)] for i in range(count)]
    widths = [max(map(_width, column)) for column in columns]
    left = [not any(cell[:1] in "0123456789-–" for cell in column) for column in columns]

    def pad(i: int, cell: str) -> str:
        space = " " * (widths[i] - _width(cell))
        return cell + space if left[i] else space + cell

    return "\n".join("  ".join(pad(i, cell) for i, cell in enumerate(line)).rstrip() for line in lines)


def _width(text: str) -> int:
    """How many columns a terminal needs for the text."""
    return sum(not unicodedata.combining(c) for c in text)


# --- figures, pages and files --------------------------------------------------------------


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


def _page_output(page: str, name: str) -> Output:
    return Output("display", {"text/plain": f"[{name}]", "text/html": page_html(page, name)})


def _page(answer: Answer, folder: str) -> List[Output]:
    name = answer.get("name") or "page"
    return [_page_output(answer["data"], name)]


# A larger file is named and not shown: the notebook would hold it whole.
_LARGEST_SHOWN = 8 << 20


def _file(answer: Answer, folder: str) -> List[Output]:
    path = answer["path"]
    wrote = Output("stdout", {"text/plain": answer["text"] + "\n"})
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
        return [wrote, _page_output(data.decode("utf-8", "replace"), path)]
    if mime == "image/svg+xml":
        return [wrote, _picture(mime, data.decode("utf-8", "replace"), path)]
    if mime in ("image/png", "image/jpeg", "image/gif", "image/webp"):
        return [wrote, _picture(mime, data, path)]
    return [wrote]


_OF_FILES = {"figure": _figure, "page": _page, "file": _file}


# --- progress ---------------------------------------------------------------------------


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
