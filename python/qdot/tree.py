"""Formulas as trees: what QDOT_NOTATION_TREE writes, as expressions of SymPy."""

from __future__ import annotations

import decimal
import re
from typing import AbstractSet, Any, Callable, Dict, FrozenSet, List, Mapping, Optional, Set

from .errors import InvalidError

_INTEGER = re.compile(r"-?[0-9]+$")
_NUMBER = re.compile(r"-?[0-9]+(\.[0-9]+)?([eE][-+]?[0-9]+)?$")


def names_of(tree: Any) -> List[str]:
    """Return the names that stand in a tree, sorted; heads of calls are none.

    >>> from qdot.tree import names_of
    >>> names_of(["*", ["/", "1", "2"], "m", ["^", ["'", "x", 1], "2"]])
    ['m', 'x']
    """
    found: Set[str] = set()
    waiting = [tree]
    while waiting:
        part = waiting.pop()
        if not isinstance(part, list):
            if not _NUMBER.match(part) and part not in _CONSTANTS:
                found.add(part)
        elif part[0] == "matrix":
            waiting.extend(member for row in part[1:] for member in row)
        elif part[0] not in ("p", "d", "delta", "unit"):
            waiting.extend(part[_OPERANDS.get(part[0], 1):_ENDS.get(part[0])])
    return sorted(found)


def to_sympy(
    tree: Any, moving: AbstractSet[str], symbols: Optional[Mapping[str, Any]] = None
) -> Any:
    """Return a tree as an expression of SymPy.

    Parameters
    ----------
    tree : list or str
    moving : set of str
        The names that are functions of t: coordinates and the like.
    symbols : mapping, optional
        What stands for a name instead of the symbol or function of that name.
    """
    return _Reader(moving, symbols or {}).read(tree, frozenset())


def of_sympy(expression: Any) -> str:
    """Return an expression of SymPy in the language: functions of t as coordinates, slopes as velocities.

    >>> import sympy
    >>> from qdot.tree import of_sympy
    >>> t = sympy.Symbol("t")
    >>> theta = sympy.Function("theta")(t)
    >>> of_sympy(theta.diff(t)**2*sympy.Rational(1, 2) + sympy.E)
    "theta'**2/2 + exp(1)"
    """
    from sympy import oo, zoo, nan, I
    from sympy.printing.str import StrPrinter

    class Printer(StrPrinter):  # type: ignore[misc]
        def _print_Exp1(self, e: Any) -> str:
            return "exp(1)"

        def _print_Abs(self, e: Any) -> str:
            return f"abs({self._print(e.args[0])})"

        def _print_Function(self, e: Any) -> str:
            if [str(argument) for argument in e.args] == ["t"] and hasattr(e.func, "name"):
                return str(e.func.name)
            return str(super()._print_Function(e))

        def _print_Derivative(self, e: Any) -> str:
            return f"{self._print(e.expr)}{chr(39) * int(e.derivative_count)}"

    for none in (oo, -oo, zoo, nan, I):
        if expression.has(none):
            raise InvalidError(f"{expression} is no value")
    return str(Printer().doprint(expression))


_CONSTANTS = {"pi": "pi", "infinity": "oo", "true": "true", "false": "false"}

# where what stands for numbers begins and ends, if that is not behind the head and at the end
_OPERANDS = {"apply": 2, "D": 3}
_ENDS = {"'": 2}

# what has another name in SymPy
_FUNCTIONS = {
    "sqrt": "sqrt",
    "abs": "Abs",
    "ceil": "ceiling",
    "min": "Min",
    "max": "Max",
    "mod": "Mod",
    "elliptic_K": "elliptic_k",
    "elliptic_E": "elliptic_e",
    "elliptic_F": "elliptic_f",
    "elliptic_Pi": "elliptic_pi",
}
_SAME = (
    "sin cos tan sec csc cot asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp log erf erfc "
    "sign floor"
).split()
_RELATIONS = {"=": "Eq", "<": "Lt", ">": "Gt", "<=": "Le", ">=": "Ge", "!=": "Ne"}
_LOGIC = {"and": "And", "or": "Or", "not": "Not"}


class _Reader:
    def __init__(self, moving: AbstractSet[str], symbols: Mapping[str, Any]) -> None:
        import sympy

        self.sympy: Any = sympy
        self.moving = moving
        self.symbols = symbols
        self.t = symbols.get("t", self.sympy.Symbol("t"))
        self.heads: Dict[str, Callable[[List[Any], FrozenSet[str]], Any]] = {
            "+": self._each(sympy.Add),
            "*": self._each(sympy.Mul),
            "^": self._each(sympy.Pow),
            "/": self._each(lambda a, b: a / b),
            "-": self._each(lambda a, *b: a - sympy.Add(*b) if b else -a),
            "'": self._velocity,
            "p": self._momentum,
            "d": self._symbol("d{}"),
            "delta": self._symbol("delta {}"),
            "unit": self._symbol("{}"),
            "apply": self._apply,
            "D": self._slope,
            "list": self._list,
            "vector": self._vector,
            "matrix": self._matrix,
            "if": self._if,
            "integral": self._integral,
            "diff": self._diff,
        }
        for word, name in {**_FUNCTIONS, **dict(zip(_SAME, _SAME)), **_LOGIC}.items():
            self.heads[word] = self._each(getattr(sympy, name))
        for word, name in _RELATIONS.items():
            self.heads[word] = self._relation(getattr(sympy, name))

    def read(self, tree: Any, bound: FrozenSet[str]) -> Any:
        """Return what the tree is; `bound`: names that are variables of an integral here."""
        if not isinstance(tree, list):
            return self._leaf(str(tree), bound)
        head, parts = tree[0], tree[1:]
        if head in self.heads:
            return self.heads[head](parts, bound)
        return self.sympy.Function(head)(*self._all(parts, bound))

    def _all(self, parts: List[Any], bound: FrozenSet[str]) -> List[Any]:
        return [self.read(part, bound) for part in parts]

    def _each(self, make: Callable[..., Any]) -> Callable[[List[Any], FrozenSet[str]], Any]:
        return lambda parts, bound: make(*self._all(parts, bound))

    def _leaf(self, name: str, bound: FrozenSet[str]) -> Any:
        if _INTEGER.match(name):
            return self.sympy.Integer(int(decimal.Decimal(name)))  # of any length
        if _NUMBER.match(name):
            return self.sympy.Rational(name)
        if name in _CONSTANTS:
            return getattr(self.sympy, _CONSTANTS[name])
        if name in bound:
            return self.sympy.Symbol(name)
        if name in self.symbols:
            return self.symbols[name]
        if name == "t":
            return self.t
        if name in self.moving:
            return self.sympy.Function(name)(self.t)
        return self.sympy.Symbol(name)

    def _velocity(self, parts: List[Any], bound: FrozenSet[str]) -> Any:
        return self.sympy.Derivative(self._leaf(parts[0], bound), (self.t, int(parts[1])))

    def _momentum(self, parts: List[Any], bound: FrozenSet[str]) -> Any:
        name = f"p[{parts[0]}]"
        return self.symbols.get(name, self.sympy.Function(name)(self.t))

    def _symbol(self, name: str) -> Callable[[List[Any], FrozenSet[str]], Any]:
        return lambda parts, bound: self.sympy.Symbol(name.format(parts[0]))

    def _apply(self, parts: List[Any], bound: FrozenSet[str]) -> Any:
        return self.sympy.Function(parts[0])(*self._all(parts[1:], bound))

    def _slope(self, parts: List[Any], bound: FrozenSet[str]) -> Any:
        orders, name, values = parts[0], parts[1], self._all(parts[2:], bound)
        places = [self.sympy.Dummy(f"xi_{i + 1}") for i in range(len(values))]
        by = [(place, order) for place, order in zip(places, orders) if order > 0]
        slope = self.sympy.Derivative(self.sympy.Function(name)(*places), *by)
        return self.sympy.Subs(slope, places, values)

    def _relation(self, make: Any) -> Callable[[List[Any], FrozenSet[str]], Any]:
        return lambda parts, bound: make(*self._all(parts, bound), evaluate=False)

    def _list(self, parts: List[Any], bound: FrozenSet[str]) -> Any:
        return self._all(parts, bound)

    def _vector(self, parts: List[Any], bound: FrozenSet[str]) -> Any:
        return self.sympy.Matrix(self._all(parts, bound))

    def _matrix(self, parts: List[Any], bound: FrozenSet[str]) -> Any:
        return self.sympy.Matrix([self._all(row, bound) for row in parts])

    def _if(self, parts: List[Any], bound: FrozenSet[str]) -> Any:
        read = self._all(parts, bound)
        pairs = [(read[i + 1], read[i]) for i in range(0, len(read) - 1, 2)]
        return self.sympy.Piecewise(*pairs, (read[-1], True))

    def _integral(self, parts: List[Any], bound: FrozenSet[str]) -> Any:
        variable = parts[1]
        if len(parts) == 2:  # without ends
            by = self._leaf(variable, bound)
            return self.sympy.Integral(self.read(parts[0], bound), by)
        inner = self.read(parts[0], bound | {variable})
        limits = self._all(parts[2:], bound)
        return self.sympy.Integral(inner, (self.sympy.Symbol(variable), *limits))

    def _diff(self, parts: List[Any], bound: FrozenSet[str]) -> Any:
        by = [self.read(part, bound) for part in parts[1:]]
        return self.sympy.Derivative(self.read(parts[0], bound), *by)
