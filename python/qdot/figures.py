"""Figures, animations and reports: what a notebook shows and a browser opens."""

from __future__ import annotations

import html
import os
from typing import Union

from .errors import InvalidError


class Figure:
    """A figure as SVG; a notebook shows it.

    Attributes
    ----------
    svg : str
        The whole file.
    name : str
        What is drawn.
    """

    def __init__(self, svg: str, name: str = "") -> None:
        self.svg = svg
        self.name = name

    def save(self, path: Union[str, os.PathLike[str]]) -> None:
        """Write the figure to a file .svg; the statement `plot ... to "FILE"` also writes .png and .pdf."""
        _write(path, self.svg, ".svg")

    def _repr_svg_(self) -> str:
        return self.svg

    def __repr__(self) -> str:
        return f"<qdot.{type(self).__name__}: {shortened(self.name)}>"


class Page:
    """A page of HTML that needs no other file and no network.

    A notebook shows it in a frame, so that its scripts and styles are its own.

    Attributes
    ----------
    html : str
        The whole file.
    name : str
        What is shown.
    height : int
        Height of the frame in a notebook, in pixels.
    """

    height = 600

    def __init__(self, html: str, name: str = "") -> None:
        self.html = html
        self.name = name

    def save(self, path: Union[str, os.PathLike[str]]) -> None:
        """Write the page to a file .html."""
        _write(path, self.html, ".html")

    def _repr_html_(self) -> str:
        return (
            f'<iframe srcdoc="{html.escape(self.html)}" title="{html.escape(self.name)}" '
            f'style="width:100%;height:{self.height}px;border:0"></iframe>'
        )

    def __repr__(self) -> str:
        return f"<qdot.{type(self).__name__}: {shortened(self.name)}>"


class Animation(Page):
    """A motion that plays."""


class Report(Page):
    """The derivation of a scene with its figures."""


def shortened(text: str, length: int = 80) -> str:
    """Return the beginning and the end of a long text.

    >>> from qdot.figures import shortened
    >>> shortened("0123456789abcdef", 9)
    '01234...f'
    """
    if len(text) <= length:
        return text
    return text[: length * 2 // 3 - 1] + "..." + text[len(text) - length // 3 + 2 :]


def _write(path: Union[str, os.PathLike[str]], text: str, ending: str) -> None:
    name = os.fsdecode(path)
    if not name.lower().endswith(ending):
        raise InvalidError(f"the name of the file, {name!r}, does not end in {ending}")
    with open(name, "w", encoding="utf-8") as file:
        file.write(text)
