/* evaluation.h -- the state while a statement is read: loops, calls, the sides of a check. */
#ifndef QDOT_LANG_EVALUATION_H
#define QDOT_LANG_EVALUATION_H

#include "base/memory.h"
#include "lang/session/parts.h"
#include "lang/session/text-list.h"
#include "mech/hamilton/phase-space.h"

/* Subexpressions of the two sides of a check: each must be defined wherever the sides are compared. */
typedef struct {
    qdot_vec(qdot_expr) value;
    qdot_vec(qdot_expr) root; /* powers among these subexpressions: base and exponent alternately */
    bool spoiled; /* a function like subs, which uses parts of its argument, was called: the list is not valid */
    unsigned branches; /* depth of if(...) branches being evaluated: parts inside need not be defined */
} qdot_passed;

/* A parameter or coordinate with a value for the present pass of a loop (lang/session/held). */
typedef struct {
    qdot_expr symbol, value;
    qdot_expr before; /* its value by `set` or `start` before the loop; nil: none */
} qdot_held;

typedef struct qdot_evaluation {
    bool declares;     /* the statement declares a part of the scene */
    bool asks;         /* an expression is read that is a statement by itself: its value is the answer */
    const char *claim; /* text of the check that is being answered; else NULL */
    const char *taken; /* short name of a value that was read (lang/functions/short-names); NULL: none */
    qdot_text_list told; /* notices that the present statement has given */
    unsigned calls;    /* depth of nested function calls */
    bool placed;       /* the error message already names a place in a function's definition */
    qdot_vec(qdot_held) held; /* parameters and coordinates set by open loops, innermost last */
    uint64_t declared;            /* version of the scene without the values of loops, while these stand in it; 0: they do not */
    unsigned phase_depth;         /* open statements that see the phase space of a stated H (lang/session/phase) */
    qdot_phase_space phase_space;
    size_t loops;      /* number of open loops, whose sources must be kept */
    qdot_vec(struct qdot_partial_sum) partial_sums; /* values of sums reused by the outermost loop (language/partial-sum) */
    qdot_passed *passed; /* records what must be defined in a check or a call such as solve(...); NULL: none is being read */
} qdot_evaluation;

#endif
