/* export-julia.c -- exports a scene to Julia: a module of functions for OrdinaryDiffEq. */
#include "show/export-language.h"

static const char system_text[] = {
#include "show/export-julia.inc"
};

/* Functions in Julia that give nan where they have no real value; written before the exported function. */
#define REAL_FUNCTIONS \
    "?g \n" \
    "?g # nan where there is no real value, as in a branch that is not taken.\n" \
    "?g real_sqrt(x) = x < 0 ? oftype(float(x), NaN) : sqrt(x)\n" \
    "?g real_log(x) = x < 0 ? oftype(float(x), NaN) : log(x)\n" \
    "?g real_pow(x, y) = x < 0 && !isinteger(y) ? oftype(float(x), NaN) : x^y\n" \
    "?g real_asin(x) = abs(x) > 1 ? oftype(float(x), NaN) : asin(x)\n" \
    "?g real_acos(x) = abs(x) > 1 ? oftype(float(x), NaN) : acos(x)\n" \
    "?g real_acosh(x) = x < 1 ? oftype(float(x), NaN) : acosh(x)\n" \
    "?g real_atanh(x) = abs(x) > 1 ? oftype(float(x), NaN) : atanh(x)\n"

static const char table_functions[] = {
#include "show/export-julia-tables.inc"
};

static const char knot_function[] = {
#include "show/export-julia-knots.inc"
};

static const char value_text[] =
    "$origin$\n"
    "#\n"
    "# Written by qdot.\n"
    "?f erf(x) = ccall((:erf, Base.Math.libm), Float64, (Float64,), x)\n"
    "?f erfc(x) = ccall((:erfc, Base.Math.libm), Float64, (Float64,), x)\n"
    REAL_FUNCTIONS
    "?t $tables$\n"
    "\n"
    "function $name$($arguments$)\n"
    "    $code$\n"
    "end\n";

static const char values_text[] =
    "$origin$\n"
    "#\n"
    "# Written by qdot.\n"
    "?f erf(x) = ccall((:erf, Base.Math.libm), Float64, (Float64,), x)\n"
    "?f erfc(x) = ccall((:erfc, Base.Math.libm), Float64, (Float64,), x)\n"
    REAL_FUNCTIONS
    "?t $tables$\n"
    "\n"
    "function $name$($arguments$)\n"
    "    out = zeros($shape$)\n"
    "    $code$\n"
    "    return out\n"
    "end\n";

const qdot_export_language qdot_export_julia = {
    .comment = "#",
    .reserved =
        " baremodule begin break catch const continue do else elseif end export false finally for function "
        "global if import in isa let local macro module outer quote return struct true try type using where "
        "while mutable Base I T NaN pi im asin acos acosh atanh log sqrt float zeros eltype oftype typeof "
        "promote_type isinteger ORDERS SETS EFFECTS STEPS STAYS MOVES NODES STAGES FIFTH THIRD CURVE stage step "
        "within watch place lowest choose decide cross signs check Parameters START SPAN TOLERANCE COORDINATES "
        "MULTIPLIERS EVENTS WAYS STOPS equations accelerations derivative jacobian energy residuals events "
        "effect bordered t state p M f A gamma acc lambda R J occurs df out event side u level switches sides "
        "project velocity velocities find_piece knot_of entry_of ",
    .nan = "NaN",
    .number = "%s = %s",
    .truth = "%s = %s",
    .state = "state[%zu]",
    .acceleration = "acc[%zu]",
    .multiplier = "lambda[%zu]",
    .parameter = "p.%s",
    .side = "side[%zu]",
    .check = "isnan(p.%s) && return \"the parameter %s has no value\"",
    .row_begin = "[",
    .row_end = "],",
    .line_end = "",
    .element = "%s[%zu]",
    .entry = "%s[%zu, %zu]",
    .first = 1,
    .vector_shape = "%zu",
    .matrix_shape = "%zu, %zu",
    .result = "return %s",
    .separator = ", ",
    .declared = "%s::Float64 = %s # %s",
    .no_argument = "",
    .argument = "%s",
    .argument_value = "%s=%s",
    .effect_begin = "if event == %zu\n",
    .effect_end = "end\n",
    .operation =
        {
#define X(op, c, python, julia, ...) [QDOT_OP_##op] = julia,
#include "show/export-languages.def"
        },
    .table_begin = "const %s = [\n    ",
    .table_end = "\n]\n",
    .table_functions = table_functions,
    .knot_function = knot_function,
    .system = system_text,
    .value = value_text,
    .values = values_text,
};
