/* foreign-words.c -- names of functions in other systems, each with the name used here. */
#include "lang/language/foreign-words.h"

#include <string.h>

#include "lang/functions/builtin.h"

/* Names that differ only in case (Sin, SIN) need no row. `ours` is NULL if the language has nothing similar. */
static const struct {
    const char *theirs, *ours;
} words[] = {
    {"ln", "log"},
    {"arcsin", "asin"},
    {"arccos", "acos"},
    {"arctan", "atan"},
    {"ArcSin", "asin"},
    {"ArcCos", "acos"},
    {"ArcTan", "atan"},
    {"arctan2", "atan2"},
    {"arcsinh", "asinh"},
    {"arsinh", "asinh"},
    {"arccosh", "acosh"},
    {"arcosh", "acosh"},
    {"arctanh", "atanh"},
    {"artanh", "atanh"},
    {"tg", "tan"},
    {"ctg", "cot"},
    {"cotan", "cot"},
    {"cosec", "csc"},
    {"sh", "sinh"},
    {"ch", "cosh"},
    {"th", "tanh"},
    {"sgn", "sign"},
    {"signum", "sign"},
    {"fabs", "abs"},
    {"fmod", "mod"},
    {"rem", "mod"},
    {"D", "diff"},
    {"derivative", "diff"},
    {"Derivative", "diff"},
    {"Dt", "ddt"},
    {"dot_t", "ddt"},
    {"ReplaceAll", "subs"},
    {"Integrate", NULL},
    {"FullSimplify", "simplify"},
    {"trigsimp", "simplify"},
    {"ratsimp", "simplify"},
    {"radsimp", "simplify"},
    {"TrigExpand", "expand"},
    {"determinant", "det"},
    {"inv", "inverse"},
    {"Tr", "trace"},
    {"eig", "eigenvalues"},
    {"eigvals", "eigenvalues"},
    {"grad", "gradient"},
    {"div", "divergence"},
    {"laplace", "laplacian"},
    {"tex", "latex"},
    {"TeXForm", "latex"},
    {"evalf", "numeric"},
    {"float", "numeric"},
    {"vpa", "numeric"},
    {"taylor", "series"},
    {"linsolve", "solve"},
    {"PoissonBracket", "poisson"},
};

const char *
qdot_foreign_word(const char *name)
{
    char low[32];
    size_t n = strlen(name);
    const qdot_builtin *row;

    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(name, words[i].theirs) == 0)
            return words[i].ours;
    if (n >= sizeof low)
        return NULL;
    for (size_t i = 0; i <= n; i++)
        low[i] = (char)(name[i] >= 'A' && name[i] <= 'Z' ? name[i] - 'A' + 'a' : name[i]);
    row = qdot_builtin_find(low);
    return row != NULL ? row->name : NULL;
}
