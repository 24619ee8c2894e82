"""formula.py -- formulas of the .lag language: read once, evaluated in 50 digits, over arrays, or by SymPy.

All are real: a power of a negative number with a fractional exponent, a logarithm of a negative
number and a division by zero have no value (nan), also where a complex detour would come back.
"""
import ast, math, re

import mpmath
import numpy as np
import sympy

mp = mpmath.mp
mp.dps = 50
NAN = mpmath.mpf("nan")


class Unreadable(Exception):
    pass


def decimal(m):
    """A decimal number as a quotient: a double would round it."""
    top, below = int(m[1] + m[2]), 10 ** len(m[2])
    power = int(m[3] or 0)
    return f"({top * 10**max(power, 0)}/{below * 10**max(-power, 0)})"


_read = {}


def read(text):
    """The tree of a formula, relation or condition."""
    if text not in _read:
        t = text.strip().replace("^", "**").replace("&", " and ")
        t = re.sub(r"(?<![=<>!])=(?!=)", "==", t)
        t = re.sub(r"(?<![\w.])(\d+)\.(\d+)(?:e([-+]?\d+))?(?![\w.])", decimal, t)
        t = re.sub(r"\bif\(", "If(", t)
        t = re.sub(r"\blambda\b", "lambda_", t)
        try:
            _read[text] = ast.parse(t, mode="eval").body
        except (SyntaxError, ValueError):
            raise Unreadable(text)
    return _read[text]


FUNCTIONS = set("sin cos tan sec csc cot asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp log sqrt abs sign "
                "min max mod floor If".split())


def names(tree):
    tree = read(tree) if isinstance(tree, str) else tree
    return {n.id for n in ast.walk(tree) if isinstance(n, ast.Name)} - FUNCTIONS - {"pi"}


# --- 50 digits ----------------------------------------------------------------------------------

def _mp_power(a, b):
    if mpmath.isnan(a) or mpmath.isnan(b):
        return NAN
    if a == 0:
        return NAN if b < 0 else mpmath.mpf(1 if b == 0 else 0)
    if a < 0 and b != mpmath.floor(b):
        return NAN if a < -_rounding() or b < 0 else mpmath.mpf(0)
    if abs(b) > 10**6 or abs(b * mpmath.log(abs(a))) > 10**6:
        return NAN
    return mpmath.power(a, b)


def _real(f, inside=None):
    def g(*a):
        if any(mpmath.isnan(x) for x in a) or (inside and not inside(*a)):
            return NAN
        y = f(*a)
        return y if isinstance(y, mpmath.mpf) else NAN
    return g


def _rounding():
    """What may stand for an exact zero: sqrt of it is 0, no root of a negative number."""
    return mpmath.mpf(10) ** (10 - mp.dps)


def _within_one(x):
    return abs(x) <= 1 + _rounding()


def _clip(x):
    return max(min(x, mpmath.mpf(1)), mpmath.mpf(-1))


def _tan(x):
    c = mpmath.cos(x)
    return NAN if abs(c) < mpmath.mpf(10) ** (8 - mp.dps) else mpmath.sin(x) / c


def _over(f):
    def g(x):
        d = f(x)
        return NAN if abs(d) < mpmath.mpf(10) ** (8 - mp.dps) else 1 / d
    return g


MP = {
    "sin": _real(mpmath.sin), "cos": _real(mpmath.cos), "tan": _real(_tan),
    "sec": _real(_over(mpmath.cos)), "csc": _real(_over(mpmath.sin)),
    "cot": _real(lambda x: mpmath.cos(x) * _over(mpmath.sin)(x)),
    "asin": _real(lambda x: mpmath.asin(_clip(x)), _within_one),
    "acos": _real(lambda x: mpmath.acos(_clip(x)), _within_one),
    "atan": _real(mpmath.atan), "atan2": _real(mpmath.atan2, lambda y, x: x != 0 or y != 0),
    "sinh": _real(mpmath.sinh), "cosh": _real(mpmath.cosh), "tanh": _real(mpmath.tanh),
    "asinh": _real(mpmath.asinh), "acosh": _real(mpmath.acosh, lambda x: x >= 1),
    "atanh": _real(mpmath.atanh, lambda x: abs(x) < 1),
    "exp": _real(mpmath.exp, lambda x: x < 10**5), "log": _real(mpmath.log, lambda x: x > 0),
    "sqrt": _real(lambda x: mpmath.sqrt(max(x, mpmath.mpf(0))), lambda x: x >= -_rounding()),
    "abs": _real(abs), "sign": _real(mpmath.sign),
    "min": _real(min), "max": _real(max),
    "mod": _real(lambda a, b: a - b * mpmath.floor(a / b), lambda a, b: b != 0),
    "floor": _real(mpmath.floor),
}


class Real:
    """Values in mp.dps digits; a condition is True, False or None (has no value)."""
    @staticmethod
    def of(tree, at):
        kind = type(tree)
        if kind is ast.Constant:
            if not isinstance(tree.value, (int, float)):
                raise Unreadable(repr(tree.value))
            return mpmath.mpf(str(tree.value))
        if kind is ast.Name:
            if tree.id == "pi":
                return +mpmath.pi
            if tree.id not in at:
                raise Unreadable(tree.id)
            return at[tree.id]
        if kind is ast.UnaryOp:
            a = Real.of(tree.operand, at)
            if isinstance(tree.op, ast.Not):
                return None if a is None else not a
            return -a if isinstance(tree.op, ast.USub) else a
        if kind is ast.BinOp:
            a, b = Real.of(tree.left, at), Real.of(tree.right, at)
            op = type(tree.op)
            if op is ast.Pow:
                return _mp_power(a, b)
            if op is ast.Div:
                return NAN if b == 0 else a / b
            return a + b if op is ast.Add else a - b if op is ast.Sub else a * b
        if kind is ast.Call and isinstance(tree.func, ast.Name):
            if tree.func.id == "If":
                c = Real.of(tree.args[0], at)
                return NAN if c is None else Real.of(tree.args[1 if c else 2], at)
            if tree.func.id not in MP:
                raise Unreadable(tree.func.id)
            return MP[tree.func.id](*[Real.of(a, at) for a in tree.args])
        if kind is ast.Compare:
            terms = [Real.of(a, at) for a in [tree.left] + tree.comparators]
            if any(mpmath.isnan(x) for x in terms):
                return None
            return all(_compare(type(op), a, b) for op, a, b in zip(tree.ops, terms, terms[1:]))
        if kind is ast.BoolOp:
            parts = [Real.of(a, at) for a in tree.values]
            if isinstance(tree.op, ast.And):
                return False if False in parts else None if None in parts else True
            return True if True in parts else None if None in parts else False
        raise Unreadable(ast.dump(tree)[:80])


def _compare(op, a, b):
    close = abs(a - b) <= mpmath.mpf(10) ** (12 - mp.dps) * (1 + abs(a))
    return {ast.Lt: a < b and not close, ast.Gt: a > b and not close, ast.LtE: a <= b or close,
            ast.GtE: a >= b or close, ast.Eq: close, ast.NotEq: not close}[op]


def value(text, at):
    return Real.of(read(text) if isinstance(text, str) else text, at)


# --- arrays of doubles --------------------------------------------------------------------------

NP = {
    "sin": np.sin, "cos": np.cos, "tan": np.tan, "sec": lambda x: 1 / np.cos(x), "csc": lambda x: 1 / np.sin(x),
    "cot": lambda x: 1 / np.tan(x), "asin": np.arcsin, "acos": np.arccos, "atan": np.arctan, "atan2": np.arctan2,
    "sinh": np.sinh, "cosh": np.cosh, "tanh": np.tanh, "asinh": np.arcsinh, "acosh": np.arccosh,
    "atanh": np.arctanh,
    "exp": np.exp, "log": np.log, "sqrt": np.sqrt, "abs": np.abs, "sign": np.sign, "mod": np.mod, "floor": np.floor,
}


def array(tree, at):
    kind = type(tree)
    if kind is ast.Constant:
        return float(tree.value)
    if kind is ast.Name:
        return math.pi if tree.id == "pi" else at[tree.id]
    if kind is ast.UnaryOp:
        return -array(tree.operand, at) if isinstance(tree.op, ast.USub) else array(tree.operand, at)
    if kind is ast.BinOp:
        a, b, op = array(tree.left, at), array(tree.right, at), type(tree.op)
        if op is ast.Pow:
            return np.power(np.asarray(a, float), b)
        if op is ast.Div:
            return np.divide(a, b)
        return a + b if op is ast.Add else a - b if op is ast.Sub else a * b
    if kind is ast.Call:
        args = [array(a, at) for a in tree.args if not isinstance(a, ast.Compare)]
        f = tree.func.id
        if f in ("min", "max"):
            out = args[0]
            for a in args[1:]:
                out = (np.minimum if f == "min" else np.maximum)(out, a)
            return out
        if f == "If":
            left, right = array(tree.args[0].left, at), array(tree.args[0].comparators[0], at)
            holds = {ast.Lt: np.less, ast.LtE: np.less_equal, ast.Gt: np.greater, ast.GtE: np.greater_equal}
            return np.where(holds[type(tree.args[0].ops[0])](left, right), *args)
        return NP[f](*args)
    raise Unreadable(ast.dump(tree)[:80])


# --- SymPy, for derivatives only ----------------------------------------------------------------

SP = {n: getattr(sympy, n) for n in FUNCTIONS - {"abs", "min", "max", "mod", "If"}}
SP["abs"], SP["min"], SP["max"] = sympy.Abs, sympy.Min, sympy.Max


def symbolic(tree):
    tree = read(tree) if isinstance(tree, str) else tree
    kind = type(tree)
    if kind is ast.Constant:
        return sympy.Rational(str(tree.value))
    if kind is ast.Name:
        return sympy.pi if tree.id == "pi" else sympy.Symbol(tree.id, real=True)
    if kind is ast.UnaryOp:
        return -symbolic(tree.operand) if isinstance(tree.op, ast.USub) else symbolic(tree.operand)
    if kind is ast.BinOp:
        a, b, op = symbolic(tree.left), symbolic(tree.right), type(tree.op)
        if op is ast.Pow:
            return a**b
        return a + b if op is ast.Add else a - b if op is ast.Sub else a * b if op is ast.Mult else a / b
    if kind is ast.Call:
        return SP[tree.func.id](*[symbolic(a) for a in tree.args])
    raise Unreadable(ast.dump(tree)[:80])
