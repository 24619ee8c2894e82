"""Cells of a notebook: their statements carried out one after the other, with a bar while one takes long."""

from __future__ import annotations

import html
import json
import threading
import time
import uuid
from typing import Callable, Dict, Iterator, Optional

from .display import Output, outputs, progress_bundle
from .library import unfinished
from .system import System

__all__ = ["Progress", "carry_out", "pieces"]

# A computation shorter than this shows no bar; a bar is drawn anew this often. Seconds.
_PATIENCE = 1.0
_REDRAW = 0.2


class Progress:
    """A bar below a cell, drawn anew in its place.

    Parameters
    ----------
    draw
        draw(data, display_id, again) shows the MIME bundle; again: in place of the one with that
        display_id. It is called from the thread that computes.
    """

    def __init__(self, draw: Callable[[Dict[str, str], str, bool], None]) -> None:
        self._draw = draw
        self._lock = threading.Lock()
        self._id = uuid.uuid4().hex
        self._began = time.monotonic()
        self._drawn: Optional[float] = None
        self._what = ""

    def report(self, what: str, done: float, left: Optional[float]) -> None:
        """The part `done` (0 to 1) of a computation is done; `left` seconds remain, None: unknown."""
        now = time.monotonic()
        with self._lock:
            due = self._began + _PATIENCE if self._drawn is None else self._drawn + _REDRAW
            if now >= due:
                self._draw(progress_bundle(what, done, left), self._id, self._drawn is not None)
                self._drawn, self._what = now, what

    def end(self, word: str) -> None:
        """Write how it ended in place of the bar, if there is one."""
        with self._lock:
            if self._drawn is not None:
                text = f"{self._what}: {word} after {time.monotonic() - self._began:.1f} s"
                shown = {"text/plain": text, "text/html": f"<small>{html.escape(text)}</small>"}
                self._draw(shown, self._id, True)
                self._drawn = None


def pieces(code: str) -> Iterator[str]:
    """The whole statements of a cell, each behind as many empty lines as stand before it.

    So a line is answered before the next one begins, and lines in errors are those of the cell. Lines
    that say nothing are left out.

    >>> list(pieces("# two\\nx = (1 +\\n 2)\\n\\nx"))
    ['\\nx = (1 +\\n 2)', '\\n\\n\\n\\nx']
    """
    lines = code.split("\n")
    first = 0
    for last in range(len(lines)):
        piece = "\n".join(lines[first : last + 1])
        if last + 1 < len(lines) and unfinished(piece):
            continue
        if any(line.strip() and not line.lstrip().startswith("#") for line in piece.split("\n")):
            yield "\n" * first + piece
        first = last + 1


def carry_out(system: System, code: str, name: str, progress: Progress) -> Iterator[Output]:
    """Carry out the statements of a cell and yield what is to be shown, as it comes.

    After an output of the kind "error" there are no more. KeyboardInterrupt passes through, behind the
    outputs that there were until then.

    Parameters
    ----------
    system
        What the statements are for.
    code
        The cell.
    name
        What errors call it: ``In[5]``.
    progress
        The bar for what takes long.
    """
    ended = "failed"
    others = system.progress(progress.report)
    try:
        for piece in pieces(code):
            try:
                answers = system.display(piece, name)
            except KeyboardInterrupt as stopped:
                ended = "interrupted"
                so_far = (getattr(stopped, "answers", None) or "").splitlines()
                shown = outputs(map(json.loads, so_far))
                yield from (output for output in shown if output.kind != "error")
                raise
            for output in outputs(answers):
                yield output
                if output.kind == "error":
                    return
        ended = "done"
    finally:
        system.progress(others)
        progress.end(ended)
