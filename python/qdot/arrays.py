"""Real numbers out of what users give: floats, arrays, fractions, numbers of SymPy; texts are none."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy
    import numpy.typing

    Array = numpy.typing.NDArray[numpy.float64]


def floats(values: Any, what: str) -> Array:
    """Return numbers as an array of floats with their shape; what is masked is NaN.

    Raises
    ------
    TypeError
        Something among them is no real number.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from qdot.arrays import floats
    >>> floats([1, Fraction(1, 2)], "times")
    array([1. , 0.5])
    >>> floats(1j, "times")
    Traceback (most recent call last):
    ...
    TypeError: times are real numbers, not complex
    """
    import numpy

    array = numpy.asarray(values)
    if array.dtype.kind == "O":  # fractions, decimals, numbers of SymPy, and what is none
        for member in array.flat:
            if member is None or isinstance(member, (str, bytes)):
                raise _refusal(member, what)
        try:
            array = array.astype(numpy.float64)
        except TypeError:
            raise _refusal(next(iter(array.flat)), what) from None
    elif array.dtype.kind not in "biuf":
        raise TypeError(f"{what} are real numbers, not {_kind(array)}")
    if isinstance(values, numpy.ma.MaskedArray):
        array = numpy.where(values.mask, numpy.nan, array)
    return numpy.asarray(array, dtype=numpy.float64, order="C")


def number(value: Any, what: str) -> float:
    """Return a real number as a float.

    >>> from qdot.arrays import number
    >>> number(3, "start")
    3.0
    """
    if hasattr(value, "__float__") and not isinstance(value, complex):
        try:
            return float(value)
        except (TypeError, OverflowError):
            pass
    raise TypeError(f"{what} is a real number, not {_named(value)}")


def _refusal(member: Any, what: str) -> TypeError:
    return TypeError(f"{what} are real numbers, not {_named(member)}")


def _named(value: Any) -> str:
    return "None" if value is None else type(value).__name__


def _kind(array: Any) -> str:
    kinds = {"c": "complex", "U": "texts", "S": "bytes", "M": "dates", "m": "lengths of time"}
    return kinds.get(array.dtype.kind, str(array.dtype))
