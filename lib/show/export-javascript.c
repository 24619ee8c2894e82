/* export-javascript.c -- exports to JavaScript: a file for Node and for pages, without any library. */
#include "show/export-language.h"

static const char system_text[] = {
#include "show/export-javascript.inc"
};

/* JavaScript has no error functions; they precede the exported function. */
#define ERROR_FUNCTIONS \
    "?f \n" \
    "?f // erf x = 2 e^(-x^2)/sqrt(pi) sum 2^k x^(2k+1)/(2k+1)!!; erfc x, x >= 2, by Laplace's continued fraction.\n" \
    "?f function erf(x) {\n" \
    "?f     let sum = x, term = x;\n" \
    "?f \n" \
    "?f     if (Math.abs(x) >= 2)\n" \
    "?f         return Math.sign(x)*(1 - erfc(Math.abs(x)));\n" \
    "?f     for (let k = 1; Math.abs(term) > 1e-18*Math.abs(sum); k++) {\n" \
    "?f         term *= 2*x*x/(2*k + 1);\n" \
    "?f         sum += term;\n" \
    "?f     }\n" \
    "?f     return 2/Math.sqrt(Math.PI)*Math.exp(-x*x)*sum;\n" \
    "?f }\n" \
    "?f \n" \
    "?f function erfc(x) {\n" \
    "?f     let below = x;\n" \
    "?f \n" \
    "?f     if (!(x >= 2))\n" \
    "?f         return 1 - erf(x);\n" \
    "?f     for (let k = 60; k > 0; k--)\n" \
    "?f         below = x + k/2/below;\n" \
    "?f     return Math.exp(-x*x)/Math.sqrt(Math.PI)/below;\n" \
    "?f }\n"

static const char table_functions[] = {
#include "show/export-javascript-tables.inc"
};

static const char knot_function[] = {
#include "show/export-javascript-knots.inc"
};

static const char value_text[] =
    "$origin$\n"
    "//\n"
    "// Written by qdot.\n"
    "\"use strict\";\n"
    ERROR_FUNCTIONS
    "?t $tables$\n"
    "\n"
    "function $name$($arguments$) {\n"
    "    $code$\n"
    "}\n"
    "\n"
    "if (typeof module !== \"undefined\")\n"
    "    module.exports = $name$;\n";

static const char values_text[] =
    "$origin$\n"
    "//\n"
    "// Written by qdot.\n"
    "\"use strict\";\n"
    ERROR_FUNCTIONS
    "?t $tables$\n"
    "\n"
    "function $name$($arguments$) {\n"
    "    const out = $shape$;\n"
    "    $code$\n"
    "    return out;\n"
    "}\n"
    "\n"
    "if (typeof module !== \"undefined\")\n"
    "    module.exports = $name$;\n";

const qdot_export_language qdot_export_javascript = {
    .comment = "//",
    .reserved =
        " arguments await break case catch class const continue debugger default delete do else enum eval export "
        "extends false finally for function if implements import in instanceof interface let new null package "
        "private protected public return static super switch this throw true try typeof var void while with "
        "yield undefined NaN Infinity Math Number Array Error console module require globalThis parameters "
        "COORDINATES MULTIPLIERS START SPAN TOLERANCE EVENTS WAYS STOPS SETS EFFECTS ORDERS STEPS STAYS MOVES "
        "NODES STAGES FIFTH THIRD CURVE zeros table largest solve switches sides equations bordered "
        "accelerations derivative jacobian energy residuals project events effect combine plus step interpolate "
        "within watch place lowest firstPlace choose decide cross signs check integrate t state p side u level M "
        "f A gamma acc lambda R J mass df occurs event out velocity velocities find_piece knot_of entry_of ",
    .nan = "NaN",
    .number = "const %s = %s;",
    .truth = "const %s = %s;",
    .state = "state[%zu]",
    .acceleration = "acc[%zu]",
    .multiplier = "lambda[%zu]",
    .parameter = "p.%s",
    .side = "side[%zu]",
    .check = "if (Number.isNaN(p.%s))\n        throw new Error(\"the parameter %s has no value\");",
    .row_begin = "[",
    .row_end = "],",
    .line_end = "",
    .element = "%s[%zu]",
    .entry = "%s[%zu][%zu]",
    .vector_shape = "new Array(%zu).fill(0)",
    .matrix_shape = "Array.from({length: %zu}, () => new Array(%zu).fill(0))",
    .result = "return %s;",
    .separator = ", ",
    .declared = "%s: %s, // %s",
    .no_argument = "",
    .argument = "%s",
    .argument_value = "%s = %s",
    .effect_begin = "if (event === %zu) {\n",
    .effect_end = "}\n",
    .operation =
        {
#define X(op, c, python, julia, matlab, javascript, ...) [QDOT_OP_##op] = javascript,
#include "show/export-languages.def"
        },
    .table_begin = "const %s = [\n    ",
    .table_end = "\n];\n",
    .table_functions = table_functions,
    .knot_function = knot_function,
    .system = system_text,
    .value = value_text,
    .values = values_text,
};
