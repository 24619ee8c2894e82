/* export-matlab.c -- Matlab and Octave: a function file that gives a struct of functions. */
#include "show/export-language.h"

static const char system_text[] =
    "function s = $name$()\n"
    "% $name$ -- equations of motion, written by qdot, for Matlab and Octave.\n"
    "%\n"
    "$origin$\n"
    "%\n"
    "?c %     M(q, t) q'' = f(q, q', t) + A' lambda,   A q'' = gamma,   state = [q; q']\n"
    "!c %     M(q, t) q'' = f(q, q', t),   state = [q; q']\n"
    "%\n"
    "%     s = $name$();\n"
    "%     p = s.parameters;\n"
    "%     o = odeset('RelTol', s.tolerance, 'AbsTol', s.tolerance);\n"
    "%     [t, state] = ode45(@(t, state) s.derivative(t, state, p), s.span, s.start, o);\n"
    "    s.parameters = struct();\n"
    "?k     $parameters$\n"
    "    s.coordinates = {$coordinates$};\n"
    "?c     s.multipliers = {$multipliers$};\n"
    "    s.start = [$start$]';\n"
    "    s.span = [$t0$, $t1$];\n"
    "    s.tolerance = $tol$;\n"
    "?e     s.event_names = {$event names$};\n"
    "?e     s.event_ways = [$event ways$]; % 1: rising, -1: falling, 0: either\n"
    "?e     s.event_stops = [$event stops$];\n"
    "    s.equations = @equations;\n"
    "    s.accelerations = @accelerations;\n"
    "    s.derivative = @derivative;\n"
    "?j     s.jacobian = @jacobian;\n"
    "    s.energy = @energy;\n"
    "?p     s.residuals = @residuals;\n"
    "?e     s.events = @events;\n"
    "?d     s.effect = @effect;\n"
    "end\n"
    "\n"
    "!c function [M, f] = equations(t, state, p)\n"
    "?c function [M, f, A, gamma] = equations(t, state, p)\n"
    "    M = zeros($n$, $n$);\n"
    "    f = zeros($n$, 1);\n"
    "?c     A = zeros($m$, $n$);\n"
    "?c     gamma = zeros($m$, 1);\n"
    "    $equations$\n"
    "    if ~isreal(M) || ~isreal(f)\n"
    "        error('the equations have no real value here');\n"
    "    end\n"
    "end\n"
    "\n"
    "!c % q''\n"
    "!c function a = accelerations(t, state, p)\n"
    "!c     [M, f] = equations(t, state, p);\n"
    "!c     a = M \\ f;\n"
    "!c end\n"
    "?c % q'' and the multipliers\n"
    "?c function [a, lambda] = accelerations(t, state, p)\n"
    "?c     [M, f, A, gamma] = equations(t, state, p);\n"
    "?c     x = bordered(M, A) \\ [f; gamma];\n"
    "?c     a = x(1:$n$);\n"
    "?c     lambda = x($n$+1:end);\n"
    "?c end\n"
    "?c \n"
    "?c function K = bordered(M, A)\n"
    "?c     K = [M, -A'; A, zeros($m$)];\n"
    "?c end\n"
    "\n"
    "% state' = [q'; q'']\n"
    "function dy = derivative(t, state, p)\n"
    "    dy = [state($n$+1:end); accelerations(t, state, p)];\n"
    "end\n"
    "?j \n"
    "?j % d(state')/d(state), exact derivatives\n"
    "?j function J = jacobian(t, state, p)\n"
    "?j !c     [M, f] = equations(t, state, p);\n"
    "?j !c     acc = M \\ f;\n"
    "?j ?c     [M, f, A, gamma] = equations(t, state, p);\n"
    "?j ?c     M = bordered(M, A);\n"
    "?j ?c     acc = M \\ [f; gamma];\n"
    "?j ?c     lambda = acc($n$+1:end);\n"
    "?j     R = zeros($r$, $2n$);\n"
    "?j     $slopes$\n"
    "?j     x = M \\ R;\n"
    "?j     J = [zeros($n$), eye($n$); x(1:$n$, :)];\n"
    "?j end\n"
    "\n"
    "% the energy, sum p q' - L\n"
    "function h = energy(t, state, p)\n"
    "    $energy$\n"
    "end\n"
    "?p \n"
    "?p % what the constraints should be, 0: of positions, of velocities\n"
    "?p function [f, df] = residuals(t, state, p)\n"
    "?p     f = zeros($f$, 1);\n"
    "?p     df = zeros($g$, 1);\n"
    "?p     $constraints$\n"
    "?p end\n"
    "?e \n"
    "?e % each event occurs where its number is 0\n"
    "?e function occurs = events(t, state, p)\n"
    "?e     occurs = zeros($e$, 1);\n"
    "?e     $events$\n"
    "?e end\n"
    "?d \n"
    "?d % state and p after the event\n"
    "?d function [state, p] = effect(event, t, state, p)\n"
    "?d     $effects$\n"
    "?d end\n"
    "?h \n"
    "?h function x = choose(condition, a, b)\n"
    "?h     if condition\n"
    "?h         x = a;\n"
    "?h     else\n"
    "?h         x = b;\n"
    "?h     end\n"
    "?h end\n";

/* What a function that holds a choice has behind it. */
#define CHOOSE \
    "?h \n" \
    "?h function x = choose(condition, a, b)\n" \
    "?h     if condition\n" \
    "?h         x = a;\n" \
    "?h     else\n" \
    "?h         x = b;\n" \
    "?h     end\n" \
    "?h end\n"

static const char value_text[] =
    "function h = $name$($arguments$)\n"
    "% $name$ -- written by qdot, for Matlab and Octave.\n"
    "%\n"
    "$origin$\n"
    "    $code$\n"
    "end\n"
    CHOOSE;

static const char values_text[] =
    "function out = $name$($arguments$)\n"
    "% $name$ -- written by qdot, for Matlab and Octave.\n"
    "%\n"
    "$origin$\n"
    "    out = zeros($shape$);\n"
    "    $code$\n"
    "end\n"
    CHOOSE;

const qdot_export_syntax qdot_export_matlab = {
    .comment = "%",
    .exact_name = true,
    .reserved =
        " break case catch classdef continue else elseif end endfunction endif endfor endwhile do until "
        "unwind_protect for function global if otherwise parfor persistent return spmd switch try while "
        "i j pi Inf NaN inf nan eps ans sin cos asin acos atan atan2 sinh cosh tanh asinh acosh atanh "
        "exp log sqrt power erf erfc abs sign min max floor zeros eye isreal error choose struct s "
        "equations accelerations derivative jacobian energy residuals events effect bordered t state p M f "
        "A gamma acc lambda R J df h out event condition parameters ",
    .nan = "NaN",
    .number = "%s = %s;",
    .truth = "%s = %s;",
    .state = "state(%zu)",
    .acceleration = "acc(%zu)",
    .multiplier = "lambda(%zu)",
    .parameter = "p.%s",
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
            [QDOT_OP_SQRT] = "sqrt(&a)",
            [QDOT_OP_POW] = "power(&a, &b)",
            [QDOT_OP_SIN] = "sin(&a)",
            [QDOT_OP_COS] = "cos(&a)",
            [QDOT_OP_ASIN] = "asin(&a)",
            [QDOT_OP_ACOS] = "acos(&a)",
            [QDOT_OP_ATAN] = "atan(&a)",
            [QDOT_OP_ATAN2] = "atan2(&a, &b)",
            [QDOT_OP_SINH] = "sinh(&a)",
            [QDOT_OP_COSH] = "cosh(&a)",
            [QDOT_OP_TANH] = "tanh(&a)",
            [QDOT_OP_ASINH] = "asinh(&a)",
            [QDOT_OP_ACOSH] = "acosh(&a)",
            [QDOT_OP_ATANH] = "atanh(&a)",
            [QDOT_OP_EXP] = "exp(&a)",
            [QDOT_OP_LOG] = "log(&a)",
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
            [QDOT_OP_NOT] = "(~#a)",
            [QDOT_OP_SELECT] = "choose(&a, &b, &c)",
        },
    .system = system_text,
    .value = value_text,
    .values = values_text,
};
