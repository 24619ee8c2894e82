"""A lexer for Pygments, by the name `qdot` and for files *.lag: the colours that the prompt shows.

The library colours, so that no word of the language is listed here. It is loaded by the first text, not by
the import of this module: Pygments imports every lexer that is installed when it looks for one.

>>> from qdot.lexer import QdotLexer
>>> [(str(token), part) for token, part in QdotLexer().get_tokens("run 0") if part.strip()]
[('Token.Keyword', 'run'), ('Token.Literal.Number', '0')]
"""

from __future__ import annotations

import re
from ctypes import byref, c_ubyte, c_void_p
from itertools import groupby
from typing import Any, Iterator, Tuple

from pygments.lexer import Lexer
from pygments.token import (
    Comment,
    Error,
    Keyword,
    Name,
    Number,
    Operator,
    Punctuation,
    String,
    Whitespace,
)

from .library import load

# The token of each qdot_lexeme; of PLAIN the parts have their own.
_PLAIN = 0
_TOKENS = (None, Keyword, Name.Builtin, Number, String, Comment.Single, Error)
_PARTS = re.compile(
    r"(?P<blank>\s+)|(?P<name>(?![⁰¹²³⁴-⁹])[^\W\d](?:[^\W⁰¹²³⁴-⁹]|[\u0307\u0308\u20DB])*)"
    r"|(?P<bracket>[()\[\]{},;:])|\.\.|.",
    re.DOTALL,
)
_PART_TOKENS = {"blank": Whitespace, "name": Name, "bracket": Punctuation, None: Operator}


class QdotLexer(Lexer):
    """The language of qdot. Names that a text declares are `Name`, those of the language `Name.Builtin`."""

    name = "qdot"
    aliases = ["qdot"]
    filenames = ["*.lag"]
    mimetypes = ["text/x-qdot"]

    def get_tokens_unprocessed(self, text: str) -> Iterator[Tuple[int, Any, str]]:
        """Yield (index, token, part of the text) for the whole text, in order."""
        start = 0
        for kind, characters in groupby(zip(_kinds(text), text), key=lambda pair: pair[0]):
            part = "".join(character for _, character in characters)
            if kind == _PLAIN:
                for found in _PARTS.finditer(part):
                    yield start + found.start(), _PART_TOKENS[found.lastgroup], found.group()
            else:
                yield start, _TOKENS[kind], part
            start += len(part)


def _kinds(text: str) -> Iterator[int]:
    """Yield the qdot_lexeme of each character."""
    library = load()
    data = text.encode(errors="replace")
    kinds = (c_ubyte * (len(data) + 1))()
    system = c_void_p()
    library.check(library.qdot_system_new(byref(system)), None)
    try:
        library.check(library.qdot_system_highlight(system, data, len(data), kinds), system)
    finally:
        library.qdot_system_free(system)
    # a character's first byte is none of 10xxxxxx
    return (kind for kind, byte in zip(kinds, data) if byte & 0xC0 != 0x80)
