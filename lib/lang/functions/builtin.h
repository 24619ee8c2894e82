/* builtin.h -- the table of the language's functions. */
#ifndef QDOT_LANG_BUILTIN_H
#define QDOT_LANG_BUILTIN_H

#include "lang/session/parts.h"

/* A function such as `diff`, `ds2`, `expand`; the rows are in lang/functions/builtin.c. */
typedef struct {
    const char *name;
    int least, most; /* arguments; most < 0: any number */
    qdot_status (*call)(qdot_session *session, uint32_t n, const qdot_expr *args,
                        qdot_expr *value);
    const char *usage, *summary, *example; /* for help */
    unsigned flags;                        /* QDOT_BUILTIN_... */
    /* the coordinates (a LIST) by which the entries of the value are indexed, as metric(R)[r, phi]; or NULL */
    qdot_expr (*over)(qdot_session *session, uint32_t n, const qdot_expr *args);
} qdot_builtin;
enum {
    QDOT_BUILTIN_UNBUILT = 1, /* a word of the language that this version does not have */
    QDOT_BUILTIN_LABEL = 2,   /* the first argument is a label: its carrier symbol */
    QDOT_BUILTIN_RUN = 4,     /* arguments may name a run, value(a.theta, 20) */
    QDOT_BUILTIN_FORM = 8,    /* special syntax: sum, if */
    QDOT_BUILTIN_SHORT = 16,  /* anything else of this name takes precedence */
    QDOT_BUILTIN_RANGE = 32,  /* a range a..b may stand last: its ends are two more arguments */
    QDOT_BUILTIN_PASSED = 64  /* while its arguments are read, session->passed keeps what must exist in them */
};
const qdot_builtin *qdot_builtin_find(const char *name);
const qdot_builtin *qdot_builtin_at(size_t i); /* NULL past the end */

#endif
