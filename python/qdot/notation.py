"""Names and numbers as a person reads them, in Unicode, LaTeX and HTML.

The library writes formulas itself. What is left for Python are the plain names and the numbers in the
JSON objects of answers: `theta1'` becomes θ̇₁, a value with its error 1.2345 ± 3e-4.
"""

from __future__ import annotations

import math
import re
import unicodedata
from typing import List, Optional, Union

__all__ = ["unicode_formula", "latex_name", "number_text", "bound_text", "unicode_name"]

_GREEK = dict(
    zip(
        "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi pi rho sigma tau "
        "upsilon phi chi psi omega Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega".split(),
        "αβγδεζηθικλμνξπρστυφχψωΓΔΘΛΞΠΣΥΦΨΩ",
    )
)

_GREEK_WORD = re.compile("(?:" + "|".join(sorted(_GREEK, key=len, reverse=True)) + ")+$")
_GREEK_LETTER = re.compile("|".join(sorted(_GREEK, key=len, reverse=True)))
_NAME = re.compile(r"(?<![A-Za-z0-9_])([A-Za-z]+)([0-9]*)('*)(?![A-Za-z0-9_(])")
_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_DOTS = {0: "", 1: "\u0307", 2: "\u0308", 3: "\u20db"}


def unicode_name(text: str) -> str:
    """The plain name or expression `text` with Greek letters, indices and dots of derivatives.

    >>> unicode_name("theta1'"), unicode_name("lambda[rod]"), unicode_name("value(x2, 5)")
    ('θ̇₁', 'λ[rod]', 'value(x₂, 5)')
    """

    def write(found: "re.Match[str]") -> str:
        letters, digits, primes = found.groups()
        if _GREEK_WORD.match(letters):
            letters = _GREEK_LETTER.sub(lambda letter: _GREEK[letter.group()], letters)
        if len(primes) not in _DOTS:
            return found.group()
        # the dots stand above the last letter, before the index
        return letters + _DOTS[len(primes)] + digits.translate(_SUBSCRIPTS)

    return unicodedata.normalize("NFC", _NAME.sub(write, text))


_SUPERSCRIPTS = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")


def unicode_formula(plain: str) -> str:
    """The plain formula as the program writes it on a terminal; it reads that back.

    >>> unicode_formula("1/2*m*x1'^2 - k*sqrt(theta)").replace("\u202f", " ")
    '½ m ẋ₁² − k √(θ)'
    """
    text = re.sub(r"(?<![\w./^])1/2(?=\*|$| |\))", "½", plain)
    text = re.sub(
        r"\^([0-9]+)(?![0-9./])",
        lambda power: power[1].translate(_SUPERSCRIPTS),
        unicode_name(text),
    )
    text = re.sub(r"(?<![0-9]e)-", "−", text.replace("*", "\u202f"))
    return re.sub(r"\bsqrt\(", "√(", text)


def latex_name(text: str) -> str:
    """The plain name `text` in LaTeX's mathematical mode.

    >>> print(latex_name("theta1'"), latex_name("chi^2"), latex_name("value(speed, 5)"))
    \\dot{\\theta}_{1} \\chi^{2} \\operatorname{value}(\\mathrm{speed},\\ 5)
    """
    return _LATEX_PIECE.sub(_latex_piece, text)


_LATEX_PIECE = re.compile(
    r"([A-Za-z]+)([0-9]*)('{0,3})(?![A-Za-z0-9_])|\w+|\^([0-9]+)|[ *#$%&_{}~^\\]"
)
_LATEX_SIGNS = {" ": r"\ ", "*": r"\,", "^": r"\wedge ", "~": r"\sim ", "\\": r"\backslash "}


def _latex_piece(found: "re.Match[str]") -> str:
    letters, digits, primes, power = found.groups()
    piece, after = found.group(), found.string[found.end() : found.end() + 1]
    if power:
        return "^{" + power + "}"
    if letters is None:
        escaped = piece.replace("_", r"\_")
        return (
            r"\mathrm{" + escaped + "}"
            if piece.isidentifier()
            else _LATEX_SIGNS.get(piece, "\\" * (piece in "#$%&_{}") + piece)
        )
    if after == "(":
        return r"\operatorname{" + letters + digits + "}" + primes
    if letters in _GREEK:
        letters = "\\" + letters
    elif len(letters) > 1:
        letters = r"\mathrm{" + letters + "}"
    if primes:
        letters = "\\" + "d" * len(primes) + "ot{" + letters + "}"
    return letters + ("_{" + digits + "}" if digits else "")


def bound_text(bound: float) -> str:
    """A positive bound with one digit, rounded up, so that it stays a bound.

    >>> bound_text(1.2e-5), bound_text(0.3), bound_text(0)
    ('2e-5', '0.3', '0')
    """
    if bound == 0:
        return "0"
    mantissa, _, power = f"{bound:.15e}".partition("e")
    digit, exponent = math.ceil(float(mantissa) - 1e-12), int(power)
    if digit == 10:
        digit, exponent = 1, exponent + 1
    return _short(f"{digit}e{exponent}")


def _short(text: str) -> str:
    """A number with an exponent in its shorter form: 3e-1 is 0.3, 1.5e+20 is 1.5e20."""
    mantissa, _, exponent = text.partition("e")
    power = int(exponent or 0)
    if -5 < power < 6:
        digits = len(mantissa.partition(".")[2])
        return f"{float(text):.{max(digits - power, 0)}f}"
    return f"{mantissa}e{power}"


def number_text(
    value: Union[float, str, List[float], None],
    error: Optional[float] = 0.0,
    unit: Optional[str] = None,
    statistical: bool = False,
) -> str:
    """A number as far as it is known, and its error: 1.2345 ± 3e-4.

    Parameters
    ----------
    value
        The number; text of many digits stays as it is; a pair is a complex number, None is unknown.
    error
        What it may be off by; 0: exact but for rounding; None: unknown.
    unit
        Its unit, such as "m/s".
    statistical
        The error is a standard error, written with two digits; else a bound, with one digit rounded up.

    >>> number_text(-1.4107066889415911, 1.07e-13)
    '-1.4107066889416 ± 2e-13'
    >>> number_text(2.5), number_text(0.5, None, "kg"), number_text(3e-15, 1e-3)
    ('2.5', '0.5 ± unknown [kg]', '0 ± 0.001')
    >>> number_text(3.984847822466395, 0.018427, statistical=True)
    '3.985 ± 0.018'
    """
    behind = f" [{unit}]" if unit else ""
    bound = ""
    if value is None:
        return "unknown" + behind
    if error is not None and 0 < error < math.inf:
        bound = _short(f"{error:.1e}") if statistical else bound_text(error)
    if isinstance(value, list):
        real, imaginary = (number_text(part, 0.0) for part in value)
        sign, imaginary = ("-", imaginary[1:]) if imaginary.startswith("-") else ("+", imaginary)
        text = f"{real} {sign} {imaginary}i"
    elif isinstance(value, str):
        text = value
    elif bound:
        place = _exponent(float(bound)) - (1 if statistical else 0)
        if abs(value) < 10.0**place / 2:
            text = "0"
        else:
            digits = max(_exponent(value) - place, 0)
            text = _short(f"{value:.{digits}e}") if digits < 16 else _short_double(value)
    else:
        text = _short_double(value)
    if error is None:
        text += " ± unknown"
    elif error > 0:
        text += " ± " + (bound or "unknown")
    return text + behind


def _exponent(value: float) -> int:
    """The power of ten of the first digit."""
    return int(f"{value:.15e}".partition("e")[2])


def _short_double(value: float) -> str:
    """The double with up to 15 digits, without an exponent where that is short."""
    text = f"{value:.15g}"
    return re.sub(r"e([+-])0*(\d+)", lambda e: "e" + e.group(1).replace("+", "") + e.group(2), text)
