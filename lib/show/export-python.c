/* export-python.c -- exports to Python: a module for NumPy, integrated by SciPy. */
#include "show/export-language.h"

static const char system_text[] = {
#include "show/export-python.inc"
};

static const char table_functions[] = {
#include "show/export-python-tables.inc"
};

static const char knot_function[] = {
#include "show/export-python-knots.inc"
};

static const char value_text[] =
    "$origin$\n"
    "#\n"
    "# Written by qdot.\n"
    "import numpy as np\n"
    "?f from scipy.special import erf, erfc\n"
    "?t $tables$\n"
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
    "?t $tables$\n"
    "\n"
    "\n"
    "def $name$($arguments$):\n"
    "    out = np.zeros($shape$)\n"
    "    $code$\n"
    "    return out\n";

const qdot_export_language qdot_export_python = {
    .comment = "#",
    .reserved =
        " as assert async await break class continue def del elif except finally for from global import in is "
        "lambda nonlocal pass raise return try while with yield None True False abs min max float range len "
        "print repr copy fields Parameters START SPAN ORDERS SETS EFFECTS STEPS STAYS MOVES look march watch "
        "place lowest first choose decide cross signs check TOLERANCE COORDINATES MULTIPLIERS EVENTS WAYS STOPS "
        "equations accelerations derivative jacobian energy residuals events effect integrate bordered dataclass "
        "t state p M f A gamma acc lambda_ R J occurs df out event side u level project switches sides velocity velocities find_piece knot_of entry_of ",
    .nan = "np.nan",
    .number = "%s = %s",
    .truth = "%s = %s",
    .state = "state[%zu]",
    .acceleration = "acc[%zu]",
    .multiplier = "lambda_[%zu]",
    .parameter = "p.%s",
    .side = "side[%zu]",
    .check = "    if np.isnan(p.%s): raise...",
    .row_begin = "[",
    .row_end = "],",
    .line_end = "",
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
#define X(op, c, python, ...) [QDOT_OP_##op] = python,
#include "show/export-languages.def"
        },
    .table_begin = "%s = np.array([\n    ",
    .table_end = "\n])\n",
    .table_functions = table_functions,
    .knot_function = knot_function,
    .system = system_text,
    .value = value_text,
    .values = values_text,
};
