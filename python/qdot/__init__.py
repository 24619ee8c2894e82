"""qdot: Lagrangian mechanics, derived exactly and integrated with known errors.

A `System` holds what has been declared in the language of the program `qdot`; it derives formulas,
decides claims and integrates motions, which are read as NumPy arrays.

>>> import qdot
>>> s = qdot.System('''
...     param m, l, g > 0
...     coord theta
...     particle bob mass m at (l*sin(theta), -l*cos(theta))
...     gravity (0, -g)
...     set m = 1, l = 1, g = 9.81; start theta = 2
... ''')
>>> print(s.derive("eom"))
m*l^2*theta'' = -m*l*g*sin(theta)
>>> motion = s.run("0..10")
>>> round(motion.end["theta"], 9)
0.015728632
"""

from .errors import (
    DomainError,
    Error,
    FailedError,
    FileError,
    Interrupted,
    InvalidError,
    KindError,
    LanguageError,
    LimitError,
    NotBuiltError,
    Notice,
    OutOfMemoryError,
    SingularError,
    UnknownNameError,
    UnsetError,
)
from .figures import Animation, Figure, Page, Report
from .formula import Formula
from .function import Function
from .library import unfinished, version
from .motion import Conserved, Event, Motion, Summary
from .system import System, Truth
from .table import Fit, Numbers, Table

__all__ = [
    "Animation",
    "Conserved",
    "DomainError",
    "Error",
    "Event",
    "FailedError",
    "Figure",
    "FileError",
    "Fit",
    "Formula",
    "Function",
    "Interrupted",
    "InvalidError",
    "KindError",
    "LanguageError",
    "LimitError",
    "Motion",
    "NotBuiltError",
    "Notice",
    "Numbers",
    "OutOfMemoryError",
    "Page",
    "Report",
    "SingularError",
    "Summary",
    "System",
    "Table",
    "Truth",
    "UnknownNameError",
    "UnsetError",
    "unfinished",
    "version",
]


def load_ipython_extension(shell: object) -> None:
    """Make `%qdot` and `%%qdot` known to IPython, for `%load_ext qdot`."""
    from .magic import load

    load(shell)
