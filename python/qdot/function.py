"""Functions: formulas compiled for arrays of many values."""

from __future__ import annotations

import os
from ctypes import byref, c_void_p
from typing import TYPE_CHECKING, Any, Sequence, Tuple

from .arrays import floats
from .errors import InvalidError
from .figures import shortened
from .library import utf8
from .session import Session

if TYPE_CHECKING:
    import numpy
    import numpy.typing

#: How many points one call of the library gets: between two calls Ctrl-C is heard.
_POINTS = 1 << 20


class Function:
    """A formula of given arguments, compiled; `Formula.lambdify` makes it.

    Called with a number or an array for each argument, which are broadcast, it returns an array of their
    shape; the components of a vector, list or matrix come in front of it. NaN: undefined there.

    Attributes
    ----------
    arguments : tuple of str
    shape : tuple of int
        Of one value: () for a scalar, (3,) for a vector in space, (2, 2) for a matrix.
    """

    def __init__(
        self, session: Session, text: str, arguments: Sequence[str], shape: Tuple[int, ...]
    ) -> None:
        self._library = session.library
        self._process = session.process
        self._handle = c_void_p()
        self.arguments = tuple(arguments)
        self.text = text

        def body() -> None:
            session.check(
                session.library.qdot_system_compile(
                    session.handle, utf8(text), utf8(", ".join(arguments)), byref(self._handle)
                )
            )

        session.call(body)
        session.keep(self, session.library.qdot_function_free, self._handle)
        if self._library.qdot_function_inputs(self._handle) != len(self.arguments):
            names = ", ".join(repr(name) for name in self.arguments)
            raise InvalidError(f"{names}: each argument is a text of its own: lambdify(\"x\", \"y\")")
        outputs = self._library.qdot_function_outputs(self._handle)
        size = 1
        for n in shape:
            size *= n
        self.shape = shape if size == outputs else (outputs,)  # lists of vectors are flat

    def __call__(self, *values: numpy.typing.ArrayLike) -> Any:
        import numpy

        if self._process != os.getpid():
            raise RuntimeError("this function belongs to the process from which this one was forked")
        if len(values) != len(self.arguments):
            raise TypeError(
                f"values of {', '.join(self.arguments)} are wanted: "
                f"{len(self.arguments)}, not {len(values)}"
            )
        arrays = numpy.broadcast_arrays(
            *(floats(v, f"values of {name}") for name, v in zip(self.arguments, values))
        )
        shape = arrays[0].shape if arrays else ()
        n = arrays[0].size if arrays else 1
        inputs = numpy.empty((n, len(arrays)))
        for i, array in enumerate(arrays):
            inputs[:, i] = array.ravel()
        outputs = numpy.empty((n, self._library.qdot_function_outputs(self._handle)))
        for first in range(0, n, _POINTS):
            some = slice(first, min(first + _POINTS, n))
            self._library.check(
                self._library.qdot_function_values(
                    self._handle,
                    some.stop - some.start,
                    inputs[some].ctypes.data,
                    outputs[some].ctypes.data,
                ),
                None,
            )
        return outputs.T.reshape(self.shape + shape)[()]

    def __copy__(self) -> Function:
        return self  # what the library holds is freed once

    def __deepcopy__(self, copied: Any) -> Function:
        return self

    def __reduce__(self) -> Any:
        raise TypeError("a qdot.Function cannot be pickled: send its text and arguments")

    def __repr__(self) -> str:
        return f"<qdot.Function of {', '.join(self.arguments)}: {shortened(self.text)}>"


def named(argument: Any) -> str:
    """Return the name of what varies: a text, or a symbol, coordinate or velocity of SymPy.

    >>> from qdot.function import named
    >>> named("theta'")
    "theta'"
    """
    if isinstance(argument, str):
        return argument
    order = 0
    if getattr(argument, "is_Derivative", False):
        order, argument = argument.derivative_count, argument.expr
    if getattr(argument, "is_Function", False):
        argument = argument.func
    elif not getattr(argument, "is_Symbol", False):
        raise TypeError(f"a name is a text or a symbol of SymPy, not {type(argument).__name__}")
    return str(argument) + "'" * order
