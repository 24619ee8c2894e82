/* export-python.c -- Python: a module for NumPy, integrated by SciPy. */
#include "show/export-language.h"

static const char system_text[] =
    "$origin$\n"
    "#\n"
    "?c #     M(q, t) q'' = f(q, q', t) + A^T lambda,   A q'' = gamma,   state = (q, q')\n"
    "!c #     M(q, t) q'' = f(q, q', t),   state = (q, q')\n"
    "#\n"
    "# Written by qdot. `python3 $file$.py` integrates and prints t, q, q'; as a module:\n"
    "#\n"
    "#     import $name$ as s\n"
    "#     run = s.integrate(s.Parameters())\n"
    "from dataclasses import dataclass\n"
    "\n"
    "import numpy as np\n"
    "?f from scipy.special import erf, erfc\n"
    "\n"
    "\n"
    "@dataclass\n"
    "class Parameters:\n"
    "    \"\"\"The values of `set`; nan: none.\"\"\"\n"
    "\n"
    "?k     $parameters$\n"
    "\n"
    "\n"
    "COORDINATES = [$coordinates$]\n"
    "?c MULTIPLIERS = [$multipliers$]\n"
    "START = np.array([$start$])\n"
    "SPAN = ($t0$, $t1$)\n"
    "TOLERANCE = $tol$\n"
    "?e EVENTS = [$event names$]\n"
    "?e WAYS = [$event ways$]  # 1: rising, -1: falling, 0: either\n"
    "?e STOPS = [$event stops$]\n"
    "\n"
    "\n"
    "def equations(t, state, p):\n"
    "!c     \"\"\"M and f.\"\"\"\n"
    "?c     \"\"\"M, f, A and gamma.\"\"\"\n"
    "    M = np.zeros(($n$, $n$))\n"
    "    f = np.zeros($n$)\n"
    "?c     A = np.zeros(($m$, $n$))\n"
    "?c     gamma = np.zeros($m$)\n"
    "    $equations$\n"
    "!c     return M, f\n"
    "?c     return M, f, A, gamma\n"
    "\n"
    "\n"
    "?c def bordered(M, A):\n"
    "?c     return np.block([[M, -A.T], [A, np.zeros(($m$, $m$))]])\n"
    "?c \n"
    "?c \n"
    "def accelerations(t, state, p):\n"
    "!c     \"\"\"q''.\"\"\"\n"
    "?c     \"\"\"q'' and the multipliers.\"\"\"\n"
    "!c     M, f = equations(t, state, p)\n"
    "!c     return np.linalg.solve(M, f)\n"
    "?c     M, f, A, gamma = equations(t, state, p)\n"
    "?c     x = np.linalg.solve(bordered(M, A), np.concatenate((f, gamma)))\n"
    "?c     return x[:$n$], x[$n$:]\n"
    "\n"
    "\n"
    "def derivative(t, state, p):\n"
    "    \"\"\"state' = (q', q'').\"\"\"\n"
    "!c     return np.concatenate((state[$n$:], accelerations(t, state, p)))\n"
    "?c     return np.concatenate((state[$n$:], accelerations(t, state, p)[0]))\n"
    "?j \n"
    "?j \n"
    "?j def jacobian(t, state, p):\n"
    "?j     \"\"\"d(state')/d(state), exact derivatives.\"\"\"\n"
    "?j !c     M, f = equations(t, state, p)\n"
    "?j !c     acc = np.linalg.solve(M, f)\n"
    "?j ?c     M, f, A, gamma = equations(t, state, p)\n"
    "?j ?c     M = bordered(M, A)\n"
    "?j ?c     acc = np.linalg.solve(M, np.concatenate((f, gamma)))\n"
    "?j ?c     lambda_ = acc[$n$:]\n"
    "?j     R = np.zeros(($r$, $2n$))\n"
    "?j     $slopes$\n"
    "?j     J = np.zeros(($2n$, $2n$))\n"
    "?j     J[:$n$, $n$:] = np.eye($n$)\n"
    "?j     J[$n$:] = np.linalg.solve(M, R)[:$n$]\n"
    "?j     return J\n"
    "\n"
    "\n"
    "def energy(t, state, p):\n"
    "    \"\"\"sum p q' - L.\"\"\"\n"
    "    $energy$\n"
    "?p \n"
    "?p \n"
    "?p def residuals(t, state, p):\n"
    "?p     \"\"\"What the constraints should be, 0: of positions, of velocities.\"\"\"\n"
    "?p     f = np.zeros($f$)\n"
    "?p     df = np.zeros($g$)\n"
    "?p     $constraints$\n"
    "?p     return f, df\n"
    "?e \n"
    "?e \n"
    "?e def events(t, state, p):\n"
    "?e     \"\"\"Each event occurs where its number is 0.\"\"\"\n"
    "?e     occurs = np.zeros($e$)\n"
    "?e     $events$\n"
    "?e     return occurs\n"
    "?d \n"
    "?d \n"
    "?d def effect(event, t, state, p):\n"
    "?d     \"\"\"Set in state and p what the event sets.\"\"\"\n"
    "?d     $effects$\n"
    "\n"
    "\n"
    "!e def integrate(p, state=START, span=SPAN, tol=TOLERANCE, method=\"DOP853\", **options):\n"
    "!e     \"\"\"The result of scipy.integrate.solve_ivp, with its dense output.\"\"\"\n"
    "!e     from scipy.integrate import solve_ivp\n"
    "!e \n"
    "?j !e     if method in (\"Radau\", \"BDF\", \"LSODA\"):\n"
    "?j !e         options.setdefault(\"jac\", jacobian)\n"
    "!e     return solve_ivp(derivative, span, state, method, args=(p,), dense_output=True,\n"
    "!e                      rtol=max(tol, 2.3e-14), atol=tol, **options)\n"
    "?e def integrate(p, state=START, span=SPAN, tol=TOLERANCE, method=\"DOP853\", **options):\n"
    "?e     \"\"\"Results of scipy.integrate.solve_ivp, one from event to event, and the events: (name, t).\"\"\"\n"
    "?e     from copy import copy\n"
    "?e     from scipy.integrate import solve_ivp\n"
    "?e \n"
    "?e     p, state, t, end = copy(p), np.array(state, float), span[0], span[1]\n"
    "?e     pieces, found = [], []\n"
    "?e \n"
    "?e     def watch(k, t0, y0):\n"
    "?e         def value(t, state, p):\n"
    "?e             if t == t0 and pieces:  # it has just occurred: its side a moment later\n"
    "?e                 h = np.copysign(1e-9*max(1.0, abs(t0)), end - t0)\n"
    "?e                 return events(t + h, state + h*derivative(t, state, p), p)[k]\n"
    "?e             return events(t, state, p)[k]\n"
    "?e         value.direction = WAYS[k]*np.copysign(1, end - t0)\n"
    "?e         value.terminal = True\n"
    "?e         return value\n"
    "?e \n"
    "?e     while True:\n"
    "?e         run = solve_ivp(derivative, (t, end), state, method, args=(p,), dense_output=True,\n"
    "?e                         events=[watch(k, t, state) for k in range($e$)],\n"
    "?e                         rtol=max(tol, 2.3e-14), atol=tol, **options)\n"
    "?e         pieces.append(run)\n"
    "?e         if run.status != 1:\n"
    "?e             return pieces, found\n"
    "?e         k = next(k for k in range($e$) if len(run.t_events[k]) > 0)\n"
    "?e         t, state = run.t_events[k][0], run.y_events[k][0].copy()\n"
    "?e         found.append((EVENTS[k], t))\n"
    "?d         p = copy(p)\n"
    "?d         effect(k, t, state, p)\n"
    "?e         if STOPS[k]:\n"
    "?e             return pieces, found\n"
    "\n"
    "\n"
    "if __name__ == \"__main__\":\n"
    "!e     runs = [integrate(Parameters())]\n"
    "?e     runs = integrate(Parameters())[0]\n"
    "    for run in runs:\n"
    "        for t in np.linspace(run.t[0], run.t[-1], 101):\n"
    "            print(repr(float(t)), *(repr(float(x)) for x in run.sol(t)))\n"
    "        if run.status < 0:\n"
    "            raise SystemExit(run.message)\n";

static const char value_text[] =
    "$origin$\n"
    "#\n"
    "# Written by qdot.\n"
    "import numpy as np\n"
    "?f from scipy.special import erf, erfc\n"
    "\n"
    "\n"
    "def $name$($arguments$):\n"
    "    $code$\n";

static const char values_text[] =
    "$origin$\n"
    "#\n"
    "# Written by qdot.\n"
    "import numpy as np\n"
    "?f from scipy.special import erf, erfc\n"
    "\n"
    "\n"
    "def $name$($arguments$):\n"
    "    out = np.zeros($shape$)\n"
    "    $code$\n"
    "    return out\n";

const qdot_export_syntax qdot_export_python = {
    .comment = "#",
    .reserved =
        " and as assert async await break class continue def del elif else except finally for from "
        "global if import in is lambda nonlocal not or pass raise return try while with yield None "
        "True False np erf erfc abs min max float range len print repr copy Parameters START SPAN "
        "TOLERANCE COORDINATES MULTIPLIERS EVENTS WAYS STOPS equations accelerations derivative "
        "jacobian energy residuals events effect integrate bordered dataclass t state p M f A gamma acc "
        "lambda_ R J occurs df out event ",
    .nan = "np.nan",
    .number = "%s = %s",
    .truth = "%s = %s",
    .state = "state[%zu]",
    .acceleration = "acc[%zu]",
    .multiplier = "lambda_[%zu]",
    .parameter = "p.%s",
    .element = "%s[%zu]",
    .entry = "%s[%zu, %zu]",
    .vector_shape = "%zu",
    .matrix_shape = "(%zu, %zu)",
    .result = "return %s",
    .separator = ", ",
    .declared = "%s: float = %s  # %s",
    .no_argument = "",
    .argument = "%s",
    .argument_value = "%s=%s",
    .effect_begin = "if event == %zu:\n",
    .effect_end = "",
    .operation =
        {
            [QDOT_OP_SQRT] = "np.sqrt(&a)",
            [QDOT_OP_POW] = "np.power(&a, &b)",
            [QDOT_OP_SIN] = "np.sin(&a)",
            [QDOT_OP_COS] = "np.cos(&a)",
            [QDOT_OP_ASIN] = "np.arcsin(&a)",
            [QDOT_OP_ACOS] = "np.arccos(&a)",
            [QDOT_OP_ATAN] = "np.arctan(&a)",
            [QDOT_OP_ATAN2] = "np.arctan2(&a, &b)",
            [QDOT_OP_SINH] = "np.sinh(&a)",
            [QDOT_OP_COSH] = "np.cosh(&a)",
            [QDOT_OP_TANH] = "np.tanh(&a)",
            [QDOT_OP_ASINH] = "np.arcsinh(&a)",
            [QDOT_OP_ACOSH] = "np.arccosh(&a)",
            [QDOT_OP_ATANH] = "np.arctanh(&a)",
            [QDOT_OP_EXP] = "np.exp(&a)",
            [QDOT_OP_LOG] = "np.log(&a)",
            [QDOT_OP_ERF] = "erf(&a)",
            [QDOT_OP_ERFC] = "erfc(&a)",
            [QDOT_OP_ABS] = "np.abs(&a)",
            [QDOT_OP_SIGN] = "np.sign(&a)",
            [QDOT_OP_MIN] = "np.minimum(&a, &b)",
            [QDOT_OP_MAX] = "np.maximum(&a, &b)",
            [QDOT_OP_MOD] = "(#a - #b*np.floor(#a/#b))",
            [QDOT_OP_FLOOR] = "np.floor(&a)",
            [QDOT_OP_LT] = "(&a < &b)",
            [QDOT_OP_LE] = "(&a <= &b)",
            [QDOT_OP_EQ] = "(&a == &b)",
            [QDOT_OP_AND] = "(#a and #b)",
            [QDOT_OP_OR] = "(#a or #b)",
            [QDOT_OP_NOT] = "(not #a)",
            [QDOT_OP_SELECT] = "(&b if #a else &c)",
        },
    .system = system_text,
    .value = value_text,
    .values = values_text,
};
