"""The cells that were carried out, of this session and earlier ones, for Jupyter's requests for history."""

from __future__ import annotations

import fnmatch
import json
import os
from typing import List, Optional, Tuple

Entry = Tuple[int, int, str]

# Older cells are forgotten when a session begins.
_KEPT = 1000


def _entry(line: str) -> Optional[Entry]:
    """What stands in a line of the file; None: it was not written to its end."""
    try:
        session, number, text = json.loads(line)
        return int(session), int(number), str(text)
    except (ValueError, TypeError):
        return None


class History:
    """Cells as (session, number of the cell, text); those of earlier sessions are in a file.

    Parameters
    ----------
    path
        The file, one JSON array a line; None, or a place where nothing can be written: only this session.
    """

    def __init__(self, path: Optional[str] = None) -> None:
        self._path = path
        self._entries: List[Entry] = self._read()
        self.session = self._entries[-1][0] + 1 if self._entries else 1

    def _read(self) -> List[Entry]:
        """The last cells of the file, which is cut to them where it has many more."""
        if self._path is None:
            return []
        try:
            with open(self._path, encoding="utf-8", errors="replace") as file:
                lines = file.readlines()
            if len(lines) > 2 * _KEPT:
                shorter = f"{self._path}.{os.getpid()}"
                with open(shorter, "w", encoding="utf-8") as file:
                    file.writelines(lines[-_KEPT:])
                os.replace(shorter, self._path)
        except OSError:
            return []
        return list(filter(None, map(_entry, lines[-_KEPT:])))

    def add(self, number: int, text: str) -> None:
        """Cell `number` of this session was carried out."""
        entry = (self.session, number, text)
        self._entries.append(entry)
        if self._path is None:
            return
        try:
            os.makedirs(os.path.dirname(self._path), exist_ok=True)
            with open(self._path, "a", encoding="utf-8") as file:
                file.write(json.dumps(entry) + "\n")
        except OSError:
            self._path = None

    def tail(self, n: int) -> List[Entry]:
        """The last n cells."""
        return self._entries[-n:] if n > 0 else []

    def range(self, session: int, start: int, stop: Optional[int]) -> List[Entry]:
        """Cells start .. stop - 1 of a session; 0 is this one, -1 the one before."""
        session = session if session > 0 else self.session + session
        return [
            entry
            for entry in self._entries
            if entry[0] == session and start <= entry[1] and (stop is None or entry[1] < stop)
        ]

    def search(self, pattern: str, n: Optional[int] = None, unique: bool = False) -> List[Entry]:
        """The cells that match a pattern with * and ?, the last n of them; unique: each text once."""
        found = [entry for entry in self._entries if fnmatch.fnmatchcase(entry[2], pattern)]
        if unique:
            found = list({entry[2]: entry for entry in found}.values())
        return found[-n:] if n else found
