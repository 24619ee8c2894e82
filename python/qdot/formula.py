"""Formulas: what `System.derive` returns, in several notations, for SymPy, and compiled."""

from __future__ import annotations

import json
from ctypes import byref, c_void_p
from typing import (
    TYPE_CHECKING,
    Any,
    FrozenSet,
    Iterator,
    List,
    Mapping,
    Optional,
    Tuple,
    Union,
    overload,
)

from .errors import Error, LimitError
from .figures import shortened
from .library import LATEX, MATHML, PLAIN, TREE, UNICODE, utf8
from .session import Session

if TYPE_CHECKING:
    from .function import Function


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
            text = self._expression if same else self._language()
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
        return f"Formula({shortened(self.plain, 1000)!r})"  # `str` has all of it

    def __eq__(self, other: object) -> bool:
        """Whether both are written alike; `System.check` decides whether they are equal."""
        return isinstance(other, Formula) and self.plain == other.plain

    def __hash__(self) -> int:
        return hash(self.plain)

    def __len__(self) -> int:
        return len(self._rows())

    def __bool__(self) -> bool:
        return True

    def __iter__(self) -> Iterator[Formula]:
        return (Formula(self._session, row) for row in self._rows())

    @overload
    def __getitem__(self, i: int) -> Formula: ...

    @overload
    def __getitem__(self, i: slice) -> List[Formula]: ...

    def __getitem__(self, i: Union[int, slice]) -> Union[Formula, List[Formula]]:
        """Return a member of a list as a formula of its own; of a slice, a list of them."""
        rows = self._rows()[i]
        if isinstance(rows, list):
            return [Formula(self._session, row) for row in rows]
        return Formula(self._session, rows)

    def __copy__(self) -> Formula:
        return self

    def __deepcopy__(self, copied: Any) -> Formula:
        return self

    def __reduce__(self) -> Any:
        raise TypeError("a qdot.Formula cannot be pickled: send str of it")

    def _rows(self) -> List[str]:
        """Return the members of a list, or the formula as the only one, in the language."""
        return self.plain.split("\n") if self.plain else []

    def _language(self) -> str:
        """Return the formula as it stands in a text of the language."""
        rows = self._rows()
        return rows[0] if len(rows) == 1 else "[" + ", ".join(rows) + "]"

    def _repr_latex_(self) -> str:
        rows = self.latex.split("\n")
        if len(rows) == 1:
            return f"$\\displaystyle {rows[0]}$"
        body = " \\\\\n".join(rows)
        return f"$$\\begin{{gathered}}\n{body}\n\\end{{gathered}}$$"

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> Any:
        return {"text/plain": self.unicode, "text/latex": self._repr_latex_()}

    def tree(self) -> Any:
        """Return the formula as nested lists in prefix form, numbers and names as strings.

        `qdot.h` describes it under QDOT_NOTATION_TREE.

        Examples
        --------
        >>> import qdot
        >>> qdot.System("coord x").derive("2*x'^2/3").tree()
        ['*', ['/', '2', '3'], ['^', ["'", 'x', 1], '2']]
        """
        try:
            return json.loads(self._in(TREE))
        except RecursionError:
            raise _too_deep() from None

    def sympy(self, symbols: Optional[Mapping[str, Any]] = None) -> Any:
        """Return the formula as an expression of SymPy, exact.

        Coordinates and what else moves are functions of ``t``, as `dynamicsymbols` of
        `sympy.physics.mechanics` makes them, velocities their derivatives, parameters symbols without
        assumptions. Vectors and matrices are matrices, a list is a list of Python.

        Parameters
        ----------
        symbols : mapping, optional
            What stands for a name: ``{"m": sympy.Symbol("m", positive=True)}``.

        Examples
        --------
        >>> import qdot
        >>> s = qdot.System("param m; coord x; particle p mass m at (x, 0)")
        >>> s.derive("T").sympy()
        m*Derivative(x(t), t)**2/2
        """
        from .tree import to_sympy

        try:
            return to_sympy(self.tree(), self._moving(), symbols)
        except RecursionError:
            raise _too_deep() from None

    def _moving(self) -> FrozenSet[str]:
        """Return the names in the formula whose derivatives by time are not 0."""
        from .tree import names_of

        moving = set()
        for name in names_of(self.tree()):
            try:
                if name != "t" and _derive(self._session, f"ddt({name})", PLAIN) != "0":
                    moving.add(name)
            except Error:  # a name that is none of this system any more
                pass
        return frozenset(moving)

    def lambdify(self, *arguments: Any) -> Function:
        """Compile the formula to a function of arrays.

        Parameters
        ----------
        *arguments : str, or symbol, function or derivative of SymPy
            What varies: "theta", "theta'", "t", "m", "p[theta]". A parameter that is not among them has its
            present value.

        Returns
        -------
        Function
            Called with a number or an array for each argument, which are broadcast, it returns an array of
            their shape; components of a vector, list or matrix come in front of it.

        Examples
        --------
        >>> import numpy, qdot
        >>> f = qdot.System("param a = 2; coord x, y").derive("a*sin(x)*y").lambdify("x", "y")
        >>> f(numpy.pi/2, numpy.array([1.0, 2.0]))
        array([2., 4.])
        """
        from .function import Function, named

        shape: Tuple[int, ...] = ()
        if self._in(TREE).startswith(('["matrix"', '["list"', '["vector"')):
            tree = self.tree()
            shape = (len(tree) - 1, len(tree[1])) if tree[0] == "matrix" else (len(tree) - 1,)
        return Function(self._session, self._language(), [named(a) for a in arguments], shape)


def _too_deep() -> LimitError:
    return LimitError(
        "the formula is nested more deeply than Python can follow: sys.setrecursionlimit sets how deeply"
    )


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
