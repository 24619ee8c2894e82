"""The colours of the program: of each file a line, of each of its bytes a letter.

    kinds.py LIBRARY FILE...       as the library has them
    kinds.py --pygments FILE...    as the lexer of the package qdot has them

W a word of a statement, N a name of the language, 0 a number, S a text, C a comment, X wrong, P else.
"""

import ctypes
import sys

LETTERS = "PWN0SCX"  # by qdot_lexeme


def library_kinds(library, data):
    system = ctypes.c_void_p()
    kinds = (ctypes.c_ubyte * (len(data) + 1))()
    if library.qdot_system_new(ctypes.byref(system)) != 0:
        sys.exit("kinds.py: no system")
    if library.qdot_system_highlight(system, data, ctypes.c_size_t(len(data)), kinds) != 0:
        sys.exit("kinds.py: no colours")
    library.qdot_system_free(system)
    return "".join(LETTERS[kind] for kind in kinds[: len(data)])


def pygments_kinds(data):
    from pygments.token import Comment, Error, Keyword, Name, Number, String
    from qdot.lexer import QdotLexer

    letters = ((Keyword, "W"), (Name.Builtin, "N"), (Number, "0"), (String, "S"), (Comment, "C"), (Error, "X"))
    line = ""
    for _, token, part in QdotLexer().get_tokens_unprocessed(data.decode()):
        letter = next((letter for kind, letter in letters if token in kind), "P")
        line += letter * len(part.encode())
    return line


for path in sys.argv[2:]:
    with open(path, "rb") as file:
        data = file.read()
    if sys.argv[1] == "--pygments":
        print(pygments_kinds(data))
    else:
        print(library_kinds(ctypes.CDLL(sys.argv[1]), data))
