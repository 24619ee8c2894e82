/* export-matlab.c -- exports to Matlab and Octave: a function file that returns a struct of functions. */
#include "show/export-language.h"

static const char system_text[] = {
#include "show/export-matlab.inc"
};

/* The definitions of nested conditions, which follow a function with if(...). */
#define CHOOSE \
    "?h \n" \
    "?h function x = pick(condition, a, b)\n" \
    "?h     if condition\n" \
    "?h         x = a;\n" \
    "?h     else\n" \
    "?h         x = b;\n" \
    "?h     end\n" \
    "?h end\n"

static const char table_functions[] = {
#include "show/export-matlab-tables.inc"
};

static const char knot_function[] = {
#include "show/export-matlab-knots.inc"
};

static const char value_text[] =
    "function h = $name$($arguments$)\n"
    "% $name$ -- written by qdot, for Matlab and Octave.\n"
    "%\n"
    "$origin$\n"
    "    $code$\n"
    "end\n"
    CHOOSE
    "?t $tables$\n";

static const char values_text[] =
    "function out = $name$($arguments$)\n"
    "% $name$ -- written by qdot, for Matlab and Octave.\n"
    "%\n"
    "$origin$\n"
    "    out = zeros($shape$);\n"
    "    $code$\n"
    "end\n"
    CHOOSE
    "?t $tables$\n";

const qdot_export_language qdot_export_matlab = {
    .comment = "%",
    .exact_name = true,
    .reserved =
        " break case catch classdef continue else elseif end endfunction endif endfor endwhile do until "
        "unwind_protect for function global if otherwise parfor persistent return spmd switch try while i j pi "
        "Inf NaN inf nan eps ans zeros eye isreal error choose struct s steps step method watch first place "
        "lowest value decide cross signs check integrate within interpolate equations accelerations derivative "
        "jacobian energy residuals events effect bordered t state p M f A gamma acc lambda R J df h out event "
        "condition parameters side u level switches sides project velocity velocities find_piece knot_of entry_of ",
    .nan = "NaN",
    .number = "%s = %s;",
    .truth = "%s = %s;",
    .state = "state(%zu)",
    .acceleration = "acc(%zu)",
    .multiplier = "lambda(%zu)",
    .parameter = "p.%s",
    .side = "side(%zu)",
    .check = "if isnan(p.%s), error('the parameter %s has no value'); end",
    .row_begin = "",
    .row_end = "; ...",
    .line_end = " ...",
    .element = "%s(%zu)",
    .entry = "%s(%zu, %zu)",
    .first = 1,
    .vector_shape = "%zu, 1",
    .matrix_shape = "%zu, %zu",
    .result = "h = %s;",
    .separator = ", ",
    .declared = "s.parameters.%s = %s; %% %s",
    .no_argument = "",
    .argument = "%s",
    .argument_value = "%s",
    .effect_begin = "if event == %zu\n",
    .effect_end = "end\n",
    .operation =
        {
#define X(op, c, python, julia, matlab, ...) [QDOT_OP_##op] = matlab,
#include "show/export-languages.def"
        },
    .table_begin = "function x = %s()\n    x = [ ...\n    ",
    .table_end = " ...\n    ];\nend\n\n",
    .table_functions = table_functions,
    .knot_function = knot_function,
    .system = system_text,
    .value = value_text,
    .values = values_text,
};
