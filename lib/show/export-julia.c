/* export-julia.c -- Julia: a module of functions, as OrdinaryDiffEq takes them. */
#include "show/export-language.h"

static const char system_text[] =
    "$origin$\n"
    "#\n"
    "?c #     M(q, t) q'' = f(q, q', t) + A^T lambda,   A q'' = gamma,   state = (q, q')\n"
    "!c #     M(q, t) q'' = f(q, q', t),   state = (q, q')\n"
    "#\n"
    "# Written by qdot. To integrate, with OrdinaryDiffEq:\n"
    "#\n"
    "#     include(\"$file$.jl\")\n"
    "#     p = $name$.Parameters()\n"
    "#     problem = ODEProblem($name$.derivative!, $name$.START, $name$.SPAN, p)\n"
    "#     run = solve(problem, Vern9(); reltol=$name$.TOLERANCE, abstol=$name$.TOLERANCE)\n"
    "module $name$\n"
    "using LinearAlgebra\n"
    "?f using SpecialFunctions: erf, erfc\n"
    "?g \n"
    "?g # nan where there is no real value, as in a branch that is not taken.\n"
    "?g real_sqrt(x) = x < 0 ? oftype(float(x), NaN) : sqrt(x)\n"
    "?g real_log(x) = x < 0 ? oftype(float(x), NaN) : log(x)\n"
    "?g real_pow(x, y) = x < 0 && !isinteger(y) ? oftype(float(x), NaN) : x^y\n"
    "?g real_asin(x) = abs(x) > 1 ? oftype(float(x), NaN) : asin(x)\n"
    "?g real_acos(x) = abs(x) > 1 ? oftype(float(x), NaN) : acos(x)\n"
    "?g real_acosh(x) = x < 1 ? oftype(float(x), NaN) : acosh(x)\n"
    "?g real_atanh(x) = abs(x) > 1 ? oftype(float(x), NaN) : atanh(x)\n"
    "\n"
    "\"The values of `set`; NaN: none.\"\n"
    "Base.@kwdef mutable struct Parameters\n"
    "?k     $parameters$\n"
    "end\n"
    "\n"
    "const COORDINATES = [$coordinates$]\n"
    "?c const MULTIPLIERS = [$multipliers$]\n"
    "const START = [$start$]\n"
    "const SPAN = ($t0$, $t1$)\n"
    "const TOLERANCE = $tol$\n"
    "?e const EVENTS = [$event names$]\n"
    "?e const WAYS = [$event ways$] # 1: rising, -1: falling, 0: either\n"
    "?e const STOPS = [$event stops$]\n"
    "\n"
    "!c \"M and f.\"\n"
    "?c \"M, f, A and gamma.\"\n"
    "function equations(t, state, p)\n"
    "    T = float(promote_type(eltype(state), typeof(t)))\n"
    "    M = zeros(T, $n$, $n$)\n"
    "    f = zeros(T, $n$)\n"
    "?c     A = zeros(T, $m$, $n$)\n"
    "?c     gamma = zeros(T, $m$)\n"
    "    $equations$\n"
    "!c     return M, f\n"
    "?c     return M, f, A, gamma\n"
    "end\n"
    "\n"
    "?c bordered(M, A) = [M -A'; A zeros(eltype(M), $m$, $m$)]\n"
    "?c \n"
    "!c \"q''.\"\n"
    "?c \"q'' and the multipliers.\"\n"
    "function accelerations(t, state, p)\n"
    "!c     M, f = equations(t, state, p)\n"
    "!c     return M \\ f\n"
    "?c     M, f, A, gamma = equations(t, state, p)\n"
    "?c     x = bordered(M, A) \\ [f; gamma]\n"
    "?c     return x[1:$n$], x[$n$+1:end]\n"
    "end\n"
    "\n"
    "\"state' = (q', q'').\"\n"
    "!c derivative(state, p, t) = [state[$n$+1:end]; accelerations(t, state, p)]\n"
    "?c derivative(state, p, t) = [state[$n$+1:end]; accelerations(t, state, p)[1]]\n"
    "\n"
    "function derivative!(dy, state, p, t)\n"
    "    dy .= derivative(state, p, t)\n"
    "    return nothing\n"
    "end\n"
    "?j \n"
    "?j \"d(state')/d(state), exact derivatives.\"\n"
    "?j function jacobian(t, state, p)\n"
    "?j !c     M, f = equations(t, state, p)\n"
    "?j !c     acc = M \\ f\n"
    "?j ?c     M, f, A, gamma = equations(t, state, p)\n"
    "?j ?c     M = bordered(M, A)\n"
    "?j ?c     acc = M \\ [f; gamma]\n"
    "?j ?c     lambda = acc[$n$+1:end]\n"
    "?j     R = zeros(eltype(M), $r$, $2n$)\n"
    "?j     $slopes$\n"
    "?j     return [zeros($n$, $n$) I; (M \\ R)[1:$n$, :]]\n"
    "?j end\n"
    "\n"
    "\"The energy, sum p q' - L.\"\n"
    "function energy(t, state, p)\n"
    "    $energy$\n"
    "end\n"
    "?p \n"
    "?p \"What the constraints should be, 0: of positions, of velocities.\"\n"
    "?p function residuals(t, state, p)\n"
    "?p     f = zeros(eltype(state), $f$)\n"
    "?p     df = zeros(eltype(state), $g$)\n"
    "?p     $constraints$\n"
    "?p     return f, df\n"
    "?p end\n"
    "?e \n"
    "?e \"Each event occurs where its number is 0.\"\n"
    "?e function events(t, state, p)\n"
    "?e     occurs = zeros(eltype(state), $e$)\n"
    "?e     $events$\n"
    "?e     return occurs\n"
    "?e end\n"
    "?d \n"
    "?d \"Set in state and p what the event sets.\"\n"
    "?d function effect!(event, t, state, p)\n"
    "?d     $effects$\n"
    "?d     return nothing\n"
    "?d end\n"
    "end # module\n";

/* What a function that holds such operations has before it. */
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

static const char value_text[] =
    "$origin$\n"
    "#\n"
    "# Written by qdot.\n"
    "?f using SpecialFunctions: erf, erfc\n"
    REAL_FUNCTIONS
    "\n"
    "function $name$($arguments$)\n"
    "    $code$\n"
    "end\n";

static const char values_text[] =
    "$origin$\n"
    "#\n"
    "# Written by qdot.\n"
    "?f using SpecialFunctions: erf, erfc\n"
    REAL_FUNCTIONS
    "\n"
    "function $name$($arguments$)\n"
    "    out = zeros($shape$)\n"
    "    $code$\n"
    "    return out\n"
    "end\n";

const qdot_export_syntax qdot_export_julia = {
    .comment = "#",
    .reserved =
        " baremodule begin break catch const continue do else elseif end export false finally for "
        "function global if import in isa let local macro module outer quote return struct true try "
        "type using where while mutable Base I T NaN pi im sin cos asin acos atan sinh cosh tanh asinh "
        "acosh atanh exp log sqrt erf erfc abs sign min max floor float zeros eltype oftype typeof "
        "promote_type isinteger real_sqrt real_log real_pow real_asin real_acos real_acosh real_atanh "
        "Parameters START SPAN TOLERANCE COORDINATES MULTIPLIERS EVENTS WAYS STOPS equations "
        "accelerations derivative jacobian energy residuals events effect bordered t state p M f A gamma acc "
        "lambda R J occurs df out event ",
    .nan = "NaN",
    .number = "%s = %s",
    .truth = "%s = %s",
    .state = "state[%zu]",
    .acceleration = "acc[%zu]",
    .multiplier = "lambda[%zu]",
    .parameter = "p.%s",
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
            [QDOT_OP_SQRT] = "real_sqrt(&a)",
            [QDOT_OP_POW] = "real_pow(&a, &b)",
            [QDOT_OP_SIN] = "sin(&a)",
            [QDOT_OP_COS] = "cos(&a)",
            [QDOT_OP_ASIN] = "real_asin(&a)",
            [QDOT_OP_ACOS] = "real_acos(&a)",
            [QDOT_OP_ATAN] = "atan(&a)",
            [QDOT_OP_ATAN2] = "atan(&a, &b)",
            [QDOT_OP_SINH] = "sinh(&a)",
            [QDOT_OP_COSH] = "cosh(&a)",
            [QDOT_OP_TANH] = "tanh(&a)",
            [QDOT_OP_ASINH] = "asinh(&a)",
            [QDOT_OP_ACOSH] = "real_acosh(&a)",
            [QDOT_OP_ATANH] = "real_atanh(&a)",
            [QDOT_OP_EXP] = "exp(&a)",
            [QDOT_OP_LOG] = "real_log(&a)",
            [QDOT_OP_ERF] = "erf(&a)",
            [QDOT_OP_ERFC] = "erfc(&a)",
            [QDOT_OP_ABS] = "abs(&a)",
            [QDOT_OP_SIGN] = "sign(&a)",
            [QDOT_OP_MIN] = "min(&a, &b)",
            [QDOT_OP_MAX] = "max(&a, &b)",
            [QDOT_OP_MOD] = "(#a - #b*floor(#a/#b))",
            [QDOT_OP_FLOOR] = "floor(&a)",
            [QDOT_OP_LT] = "(&a < &b)",
            [QDOT_OP_LE] = "(&a <= &b)",
            [QDOT_OP_EQ] = "(&a == &b)",
            [QDOT_OP_AND] = "(#a && #b)",
            [QDOT_OP_OR] = "(#a || #b)",
            [QDOT_OP_NOT] = "(!#a)",
            [QDOT_OP_SELECT] = "(#a ? &b : &c)",
        },
    .system = system_text,
    .value = value_text,
    .values = values_text,
};
