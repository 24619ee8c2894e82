"""The kernel: Jupyter's requests carried out by one `qdot.System`."""

from __future__ import annotations

import os
from typing import Any, Callable, Dict, List, Optional, Tuple

from ipykernel.kernelbase import Kernel

from ..cells import Progress, carry_out, pieces
from ..display import Output
from ..errors import Error
from ..library import unfinished, version
from ..system import System
from .history import History

Send = Callable[[str, Dict[str, Any]], None]


class QdotKernel(Kernel):
    """Cells are statements of the language; what they answer is displayed below them."""

    implementation = "qdot"
    implementation_version = version()
    banner = f"qdot {version()}: write r(q), get the mechanics. `help` shows what can be typed."
    language_info = {
        "name": "qdot",
        "version": version(),
        "mimetype": "text/x-qdot",
        "file_extension": ".lag",
        "pygments_lexer": "qdot",
        # a front end that does not know the mode takes the nearest: # comments, q' is no string
        "codemirror_mode": {"name": "qdot", "mime": "text/x-octave"},
    }

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.system = System().keep_undo()
        self.history = History(_history_path())

    # --- carrying out cells -------------------------------------------------------------

    def do_execute(
        self,
        code: str,
        silent: bool,
        store_history: bool = True,
        user_expressions: Any = None,
        allow_stdin: bool = False,
        **more: Any,
    ) -> Dict[str, Any]:
        send = _send_nothing if silent else self._sender()
        leaves = False
        try:
            if store_history and not silent and code.strip():
                self.history.add(self.execution_count, code)
            code, leaves = _until_quit(code)
            failure = self._carry_out(code, send)
        except KeyboardInterrupt:
            failure = _interrupted()
        except Exception as error:  # a cell is answered whatever happens
            failure = _refusal(error)
        if failure is not None:
            send("error", failure)
            return {"status": "error", "execution_count": self.execution_count, **failure}
        return {
            "status": "ok",
            "execution_count": self.execution_count,
            "payload": [{"source": "ask_exit", "keepkernel": False}] if leaves else [],
            "user_expressions": {},
        }

    def _carry_out(self, code: str, send: Send) -> Optional[Dict[str, Any]]:
        """Carry out a cell and send what it shows; what failed as Jupyter wants it, or None."""

        def draw(data: Dict[str, str], display_id: str, again: bool) -> None:
            message = "update_display_data" if again else "display_data"
            transient = {"display_id": display_id}
            send(message, {"data": data, "metadata": {}, "transient": transient})

        name = f"In[{self.execution_count}]"
        for output in carry_out(self.system, code, name, Progress(draw)):
            if output.kind == "error":
                return _failure(output)
            if output.kind == "display":
                send("display_data", {"data": output.data, "metadata": {}})
            else:
                send("stream", {"name": output.kind, "text": output.text})
        return None

    def _sender(self) -> Send:
        """A function that sends a message for the cell under way, from whatever thread."""
        parent = self.get_parent("shell")

        def send(message: str, content: Dict[str, Any]) -> None:
            topic = self._topic(message)
            self.session.send(self.iopub_socket, message, content, parent=parent, ident=topic)

        return send

    # --- help for who types -------------------------------------------------------------

    def do_complete(self, code: str, cursor_pos: Optional[int]) -> Dict[str, Any]:
        cursor = len(code) if cursor_pos is None else cursor_pos
        try:
            start, words = self.system.complete(code, cursor)
        except Error:  # no text of the language: a NUL
            start, words = cursor, []
        return {
            "status": "ok",
            "matches": list(words),
            "cursor_start": start,
            "cursor_end": cursor,
            "metadata": {},
        }

    def do_inspect(
        self, code: str, cursor_pos: int, detail_level: int = 0, omit_sections: Any = ()
    ) -> Dict[str, Any]:
        try:
            said = self.system.explain(code, cursor_pos)
        except Error:
            said = {}
        if said.get("formula"):  # in LaTeX; a terminal wants it as a line
            try:
                said["unicode"] = self.system.derive(said["word"]).unicode
            except Error:
                pass  # an equation, or what has no value of its own
        data = _explanation(said) if said else {}
        return {"status": "ok", "found": bool(data), "data": data, "metadata": {}}

    def do_is_complete(self, code: str) -> Dict[str, Any]:
        try:
            if not unfinished(code):
                return {"status": "complete"}
        except Error:
            return {"status": "invalid"}
        last = code.rstrip("\n").split("\n")[-1]
        indent = last[: len(last) - len(last.lstrip())]
        return {
            "status": "incomplete",
            "indent": indent + ("    " if last.rstrip().endswith(("{", "(", "[")) else ""),
        }

    def do_history(
        self,
        hist_access_type: str,
        output: bool,
        raw: bool,
        session: Optional[int] = None,
        start: Optional[int] = None,
        stop: Optional[int] = None,
        n: Optional[int] = None,
        pattern: Optional[str] = None,
        unique: bool = False,
    ) -> Dict[str, Any]:
        if hist_access_type == "range":
            found = self.history.range(session or 0, start or 0, stop)
        elif hist_access_type == "search":
            found = self.history.search(pattern or "*", n, unique)
        else:
            found = self.history.tail(n or 0)
        entries: List[Tuple[int, int, Any]] = list(found)
        if output:  # answers are not kept
            entries = [(session, number, (text, None)) for session, number, text in found]
        return {"status": "ok", "history": entries}

    def do_shutdown(self, restart: bool) -> Dict[str, Any]:
        return {"status": "ok", "restart": restart}


def _send_nothing(message: str, content: Dict[str, Any]) -> None:
    """What a silent cell sends."""


def _until_quit(code: str) -> Tuple[str, bool]:
    """The cell up to a line `quit`, and whether there is one."""
    for piece in pieces(code):
        if piece.strip() in ("quit", "exit"):
            return "\n".join(code.split("\n")[: len(piece) - len(piece.lstrip("\n"))]), True
    return code, False


def _interrupted() -> Dict[str, Any]:
    said = "the computation was stopped; the session is kept"
    return {
        "ename": "Interrupted",
        "evalue": said,
        "traceback": [f"\x1b[31mInterrupted:\x1b[0m {said}"],
    }


def _refusal(error: Exception) -> Dict[str, Any]:
    """What is wrong with a cell of which nothing can be carried out."""
    kind = "Error" if isinstance(error, Error) else type(error).__name__
    return {
        "ename": kind,
        "evalue": str(error),
        "traceback": [f"\x1b[31merror:\x1b[0m {error}"],
    }


def _failure(output: Output) -> Dict[str, Any]:
    """The error as Jupyter wants it; the traceback is the text with place, line, caret and hint."""
    answer = output.answer or {}
    head, *rest = output.text.split("\n")
    return {
        "ename": "Error",
        "evalue": answer.get("message", output.text),
        "traceback": [f"\x1b[31m{head}\x1b[0m"] + rest,
    }


def _explanation(said: Dict[str, Any]) -> Dict[str, str]:
    """What is said of a word, as plain text and as Markdown with the formula typeset."""
    parts = []  # each as plain text and as Markdown
    usage = said.get("usage") or said.get("word") or ""
    if usage:
        parts.append((usage, f"```\n{usage}\n```"))
    if said.get("text"):
        parts.append((said["text"], said["text"]))
    if said.get("formula"):
        parts.append((said.get("unicode", said["formula"]), rf"$\displaystyle {said['formula']}$"))
    if said.get("dimension"):
        parts.append(2 * (f"dimension: {said['dimension']}",))
    if said.get("example"):
        parts.append((f"example: {said['example']}", f"Example:\n```\n{said['example']}\n```"))
    if not parts:
        return {}
    return {
        "text/plain": "\n".join(plain for plain, _ in parts),
        "text/markdown": "\n\n".join(marked for _, marked in parts),
    }


def _history_path() -> Optional[str]:
    try:
        from jupyter_core.paths import jupyter_data_dir

        return os.path.join(jupyter_data_dir(), "qdot-history.jsonl")
    except ImportError:
        return None
