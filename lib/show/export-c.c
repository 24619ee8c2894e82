/* export-c.c -- exports a scene to C: functions of a motion, and a small main program to try them. */
#include "show/export-language.h"

static const char system_text[] = {
#include "show/export-c.inc"
};

static const char motion_text[] = {
#include "show/export-c-motion.inc"
};

static const char table_functions[] = {
#include "show/export-c-tables.inc"
};

static const char knot_function[] = {
#include "show/export-c-knots.inc"
};

static const char value_text[] =
    "/* $name$ -- written by qdot.\n"
    " *\n"
    "$origin$\n"
    " */\n"
    "#include <math.h>\n"
    "?t $tables$\n"
    "\n"
    "double $name$($arguments$);\n"
    "\n"
    "double\n"
    "$name$($arguments$)\n"
    "{\n"
    "    $code$\n"
    "}\n";

static const char values_text[] =
    "/* $name$ -- written by qdot: out [$size$].\n"
    " *\n"
    "$origin$\n"
    " */\n"
    "#include <math.h>\n"
    "#include <string.h>\n"
    "?t $tables$\n"
    "\n"
    "void $name$($arguments,$double *out);\n"
    "\n"
    "void\n"
    "$name$($arguments,$double *out)\n"
    "{\n"
    "    memset(out, 0, $size$ * sizeof *out);\n"
    "    $code$\n"
    "}\n";

const qdot_export_language qdot_export_c = {
    .comment = " *",
    .reserved =
        " auto break case char const continue default do else enum extern float for goto if inline int long "
        "register restrict return short signed sizeof static struct switch typedef union unsigned void volatile "
        "while main memset memcpy memmove NULL NAN INFINITY HUGE_VAL M_PI M_E t state p M f A gamma acc lambda R "
        "K solved occurs df J out unused solve step system_of abs tan log2 log10 expm1 cbrt hypot round trunc "
        "ceil fmod j0 j1 jn y0 y1 yn tgamma lgamma ldexp frexp modf nan fma linux unix side own u level motion velocity velocities find_piece knot_of entry_of settle ",
    .nan = "NAN",
    .number = "const double %s = %s;",
    .truth = "const int %s = %s;",
    .state = "state[%zu]",
    .acceleration = "acc[%zu]",
    .multiplier = "lambda[%zu]",
    .parameter = "p->%s",
    .side = "side[%zu]",
    .check = "if (isnan(p->%s))\n        return \"the parameter %s has no value\";",
    .row_begin = "{ ",
    .row_end = " },",
    .line_end = "",
    .element = "%s[%zu]",
    .entry = NULL,
    .vector_shape = "%zu",
    .matrix_shape = "%zu * %zu",
    .result = "return %s;",
    .separator = ", ",
    .declared = ".%s = %s, /* %s */",
    .no_argument = "void",
    .argument = "double %s",
    .argument_value = "double %s /* %s */",
    .effect_begin = "if (event == %zu) {\n",
    .effect_end = "}\n",
    .operation =
        {
#define X(op, c, ...) [QDOT_OP_##op] = c,
#include "show/export-languages.def"
        },
    .table_begin = "static const double %s[] = {\n    ",
    .table_end = "\n};\n",
    .table_functions = table_functions,
    .knot_function = knot_function,
    .system = system_text,
    .motion = motion_text,
    .value = value_text,
    .values = values_text,
};
