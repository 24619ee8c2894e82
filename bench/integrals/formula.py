"""formula.py -- formulas of the language as functions of mpmath; for judge.py and references.py."""
import re

from mpmath import mp, mpf

SIGNS = re.compile(r"\s*(\d+\.?\d*(?:e-?\d+)?|[A-Za-z_]\w*|<=|>=|[-+*/^(),<>='])")


class Undefined(ValueError):
    """A function has no real value there."""


def real(f):
    def of(*x):
        try:
            y = f(*x)
        except (ValueError, ZeroDivisionError, OverflowError, TypeError):
            raise Undefined
        if isinstance(y, mp.mpc) or not mp.isfinite(y):
            raise Undefined
        return y
    return of


FUNCTIONS = {name: real(getattr(mp, name)) for name in
             "sin cos tan sec csc cot asin acos atan sinh cosh tanh asinh acosh atanh exp log sqrt erf erfc atan2 floor sign".split()}
FUNCTIONS.update(
    abs=abs, max=max, min=min, mod=lambda x, m: x - m * mp.floor(x / m),
    elliptic_K=real(mp.ellipk), elliptic_F=real(mp.ellipf), elliptic_E=real(mp.ellipe), elliptic_Pi=real(mp.ellippi))


class Reader:
    """Recursive descent: a formula as a function of (values, x)."""

    def __init__(self, text):
        self.tokens, at = [], 0
        while at < len(text.rstrip()):
            m = SIGNS.match(text, at)
            if not m:
                raise SyntaxError(text[at:])
            self.tokens.append(m[1])
            at = m.end()
        self.at = 0

    def next(self):
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def take(self, *signs):
        if self.next() in signs and self.next():
            self.at += 1
            return self.tokens[self.at - 1]
        return ""

    def need(self, sign):
        if not self.take(sign):
            raise SyntaxError(f"{sign} expected, {self.next()} found")

    def relation(self):
        left = self.sum()
        sign = self.take("<", ">", "<=", ">=", "=")
        if not sign:
            return left
        right = self.sum()
        test = {"<": lambda p, q: p < q, ">": lambda p, q: p > q, "<=": lambda p, q: p <= q, ">=": lambda p, q: p >= q,
                "=": lambda p, q: p == q}[sign]
        return lambda v, x: test(left(v, x), right(v, x))

    def sum(self):
        total = self.product()
        while sign := self.take("+", "-"):
            left, right = total, self.product()
            total = (lambda p, q: lambda v, x: p(v, x) + q(v, x))(left, right) if sign == "+" else \
                    (lambda p, q: lambda v, x: p(v, x) - q(v, x))(left, right)
        return total

    def product(self):
        total = self.signed()
        while sign := self.take("*", "/"):
            left, right = total, self.signed()
            total = (lambda p, q: lambda v, x: p(v, x) * q(v, x))(left, right) if sign == "*" else \
                    (lambda p, q: lambda v, x: quotient(p(v, x), q(v, x)))(left, right)
        return total

    def signed(self):
        if self.take("-"):
            e = self.signed()
            return lambda v, x: -e(v, x)
        return self.power()

    def power(self):
        base = self.atom()
        if not self.take("^"):
            return base
        exponent = self.signed()
        return lambda v, x: real_power(base(v, x), exponent(v, x))

    def atom(self):
        if self.take("("):
            e = self.relation()
            self.need(")")
            return e
        word = self.take(self.next())
        if word[0].isdigit():
            return lambda v, x: mpf(word)
        if word == "if" or (self.next() == "(" and word in FUNCTIONS):
            self.need("(")
            args = [self.relation()]
            while self.take(","):
                args.append(self.relation())
            self.need(")")
            if word == "if":
                return lambda v, x: args[1](v, x) if args[0](v, x) else args[2](v, x)
            return lambda v, x: FUNCTIONS[word](*[e(v, x) for e in args])
        if word == "f" and self.next() in ("(", "'"):
            while self.take("'"):
                word += "'"
            self.need("(")
            self.need("x")
            self.need(")")
            return lambda v, x: v[word + "(x)"](x)
        if word == "pi":
            return lambda v, x: mp.pi
        return (lambda v, x: x) if word == "x" else (lambda v, x: v[word])


def quotient(p, q):
    if q == 0:
        raise Undefined
    return p / q


def real_power(b, e):
    if b == 0 and e < 0 or b < 0 and e != int(e):
        raise Undefined
    return b ** (int(e) if e == int(e) else e)


def read(text):
    return Reader(text).relation()
