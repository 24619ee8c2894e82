"""Formulas: what `System.derive` returns, in several notations."""

from __future__ import annotations

from ctypes import byref, c_void_p
from typing import Any, Iterator

from .library import LATEX, MATHML, PLAIN, UNICODE, utf8
from .session import Session


class Formula:
    """A formula, or a list of formulas such as the equations of motion.

    `str` of it is the language itself; `unicode`, `latex` and `mathml` are other notations. A notebook
    shows it typeset.

    Examples
    --------
    >>> import qdot
    >>> s = qdot.System("param m; coord r, phi; particle p mass m at (r*cos(phi), r*sin(phi))")
    >>> s.derive("T")
    Formula("1/2*m*(r'^2 + r^2*phi'^2)")
    >>> print(s.derive("phi'^2").unicode)
    φ̇²
    >>> s.derive("p[phi]").latex
    'm r^{2} \\\\dot{\\\\phi}'
    >>> len(s.derive("eom"))
    2
    """

    def __init__(self, session: Session, expression: str) -> None:
        self._session = session
        self._expression = expression
        self._changes = session.changes
        self._written = {PLAIN: _derive(session, expression, PLAIN)}

    def _in(self, notation: int) -> str:
        if notation not in self._written:
            # what has changed since may have changed the meaning of the expression, not of its value
            same = self._changes == self._session.changes
            text = self._expression if same else _language(self)
            self._written[notation] = _derive(self._session, text, notation)
        return self._written[notation]

    @property
    def plain(self) -> str:
        """The formula in the language itself."""
        return self._in(PLAIN)

    @property
    def unicode(self) -> str:
        """The formula on a line, as a terminal shows it."""
        return self._in(UNICODE)

    @property
    def latex(self) -> str:
        """The formula as LaTeX for mathematics, without dollars; members of a list on lines."""
        return self._in(LATEX)

    @property
    def mathml(self) -> str:
        """The formula as MathML: elements <math>, one for each member of a list."""
        rows = self._in(MATHML).split("\n")
        head = '<math xmlns="http://www.w3.org/1998/Math/MathML" display="block">'
        return "\n".join(f"{head}{row}</math>" for row in rows)

    def __str__(self) -> str:
        return self.plain

    def __repr__(self) -> str:
        return f"Formula({self.plain!r})"

    def __eq__(self, other: object) -> bool:
        """Whether both are written alike; `System.check` decides whether they are equal."""
        return isinstance(other, Formula) and self.plain == other.plain

    def __hash__(self) -> int:
        return hash(self.plain)

    def __len__(self) -> int:
        return len(self.plain.split("\n"))

    def __bool__(self) -> bool:
        return True

    def __iter__(self) -> Iterator[Formula]:
        return (self[i] for i in range(len(self)))

    def __getitem__(self, i: int) -> Formula:
        """Return a member of a list as a formula of its own."""
        return Formula(self._session, self.plain.split("\n")[i])

    def _repr_latex_(self) -> str:
        rows = self.latex.split("\n")
        if len(rows) == 1:
            return f"$\\displaystyle {rows[0]}$"
        body = " \\\\\n".join(rows)
        return f"$$\\begin{{gathered}}\n{body}\n\\end{{gathered}}$$"

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> Any:
        return {"text/plain": self.unicode, "text/latex": self._repr_latex_()}


def _language(formula: Formula) -> str:
    rows = formula.plain.split("\n")
    return rows[0] if len(rows) == 1 else "[" + ", ".join(rows) + "]"


def _derive(session: Session, expression: str, notation: int) -> str:
    text = c_void_p()

    def body() -> str:
        session.check(
            session.library.qdot_system_derive(
                session.handle, utf8(expression), notation, byref(text)
            )
        )
        return session.library.take_text(text)

    return session.call(body)
