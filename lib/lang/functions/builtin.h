/* builtin.h -- the table of the language's functions. */
#ifndef QDOT_LANG_BUILTIN_H
#define QDOT_LANG_BUILTIN_H

#include "lang/session/parts.h"

/* A function such as `diff`, `ds2`, `expand`; the rows are in builtin.def and expr/function.def. */
typedef struct {
    const char *name;
    int least, most; /* least and largest number of arguments; most < 0: any number */
    qdot_status (*call)(qdot_session *session, uint32_t n, const qdot_expr *args,
                        qdot_expr *value);
    const char *usage, *summary, *example; /* texts for help */
    unsigned flags;                        /* bits QDOT_BUILTIN_... */
    /* the coordinates (a LIST) by which the entries of the value are indexed, as metric(R)[r, phi]; or NULL */
    qdot_expr (*over)(qdot_session *session, uint32_t n, const qdot_expr *args);
} qdot_builtin;
enum {
    QDOT_BUILTIN_LABEL = 1,       /* the first argument is a label, given as the symbol that stands for it */
    QDOT_BUILTIN_RUN = 2,         /* arguments may name a run, as in value(a.theta, 20) */
    QDOT_BUILTIN_FORM = 4,        /* arguments are not evaluated before the call, as for sum and if */
    QDOT_BUILTIN_SHORT = 8,       /* a name declared by the user takes precedence */
    QDOT_BUILTIN_RANGE = 16,      /* the last argument may be a range a..b: it counts as two arguments */
    QDOT_BUILTIN_PASSED = 32,     /* while the arguments are read, session->passed records what must be defined */
    QDOT_BUILTIN_NAMES = 64,      /* an argument NAME = EXPR may have a new name, given as a symbol */
    QDOT_BUILTIN_VARIABLE = 128,  /* a name after the first argument is a variable, as x in diff(T, x) or subs(T, x = 0) */
    QDOT_BUILTIN_CALCULUS = 256,  /* multipliers in the arguments are what the equations of motion make of them */
    QDOT_BUILTIN_MOMENTA = 512,   /* p[q] in its statement is the momentum as a symbol, not dL/dq' */
    QDOT_BUILTIN_FORMULA = 1024   /* differentiates or solves: a value along a run would wrongly look like a constant */
};

/* The functions of builtin.def, with args [n]: qdot_call_diff, ... */
#define FUNCTION(word, ...)                                                                        \
    QDOT_MUST_CHECK qdot_status qdot_call_##word(qdot_session *session, uint32_t n, const qdot_expr *args, \
                                                 qdot_expr *value);
#include "lang/functions/builtin.def"

const qdot_builtin *qdot_builtin_find(const char *name);
const qdot_builtin *qdot_builtin_at(size_t i); /* returns NULL past the end */

#endif
