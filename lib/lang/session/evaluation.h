/* evaluation.h -- the context in which a statement is read: loops, calls, the sides of a check. */
#ifndef QDOT_LANG_EVALUATION_H
#define QDOT_LANG_EVALUATION_H

#include "base/memory.h"
#include "lang/session/parts.h"
#include "lang/session/text-list.h"

/* Subexpressions of the sides of a check: each must be defined where the sides are compared. */
typedef struct {
    qdot_vec(qdot_expr) value;
    qdot_vec(qdot_expr) root; /* of powers among them, base and exponent in turn */
    bool spoiled;      /* a function that may take its argument apart (subs) was called */
    unsigned branches; /* open branches of ifs: subexpressions there need not be defined */
} qdot_passed;

/* A parameter or coordinate with a value for the present pass of a loop (lang/session/held). */
typedef struct {
    qdot_expr symbol, value;
    qdot_expr before; /* its earlier value from `set` or `start`; nil: none */
} qdot_held;

typedef struct qdot_evaluation {
    bool declares;     /* the present statement declares part of a scene */
    const char *claim; /* while a check is answered, its text; else NULL */
    const char *taken; /* short name of a value that it read (lang/functions/short-names); NULL */
    qdot_text_list told; /* notices that the present statement has given */
    unsigned calls;    /* depth of nested function calls */
    bool placed;       /* the present error already names its place in a body */
    qdot_vec(qdot_held) held; /* by the loops under way, innermost last */
    size_t loops;      /* open loops: what they refer to must outlive them */
    qdot_vec(struct qdot_partial_sum) partial_sums; /* of the outermost (language/partial-sum) */
    qdot_passed *passed; /* while the sides of a check are read; else NULL */
} qdot_evaluation;

#endif
