/* machine.h -- the state while an expression is evaluated: the stack and unfinished sums. */
#ifndef QDOT_LANG_MACHINE_H
#define QDOT_LANG_MACHINE_H

#include "lang/language/evaluator.h"
#include "lang/session/evaluation.h"
#include "lang/source/token.h"

/* A value on the evaluation stack, with what is known of it. */
typedef struct {
    qdot_expr value;
    qdot_expr over;         /* a LIST of coordinates that index the entries; nil: none */
    const char *run;        /* name of the run to which the value refers; NULL: none */
    const char *label;      /* label of the particle or body whose position the value is; NULL: it is no position */
    const qdot_token *sign; /* the operator + - * / before it; NULL for the first operand */
} qdot_slot;

/* A sum(...) that is being evaluated. */
typedef struct {
    const char *index;
    const qdot_token *place; /* the token where the sum stands in the text */
    bool varies;             /* the terms depend on more than the index (language/partial-sum) */
    int64_t first, k, last;
    uint32_t resume; /* index of the instruction at which to go on after the sum */
    size_t terms;    /* index, in the list `terms`, of the first term of this sum */
    bool bound;      /* the index has a value at present */
    qdot_expr symbol; /* symbol of the index, for a sum by a formula; nil: the index is a number */
} qdot_sum_frame;

/* A call such as solve(...), which records what its arguments require to be defined; the record of the call around it. */
typedef struct qdot_passed_frame {
    qdot_passed passed;
    qdot_passed *outer; /* the record that the session had before */
    struct qdot_passed_frame *below;
} qdot_passed_frame;

typedef struct {
    qdot_cursor *c;
    qdot_session *session;
    qdot_pool *pool;
    const qdot_postfix_list *program;
    qdot_vec(qdot_slot) stack;
    qdot_vec(qdot_sum_frame) frames;
    qdot_vec(qdot_expr) terms; /* terms of all sums that are not complete */
    qdot_vec(qdot_expr) args;  /* scratch for arguments */
    qdot_vec(const char *) labels; /* labels of the arguments of the present call */
    const qdot_token *blame;   /* token at which an error points */
    bool belongs;              /* the run that the next MEMBER instruction names has been used already */
    qdot_passed_frame *passed; /* innermost open record; NULL: none */
} qdot_machine;

static inline qdot_slot *
qdot_machine_top(qdot_machine *m, size_t n)
{
    return &m->stack.at[m->stack.n - n];
}

QDOT_MUST_CHECK qdot_status qdot_machine_push(qdot_machine *m, qdot_expr value);
/* Record a value that must be defined, if it is a scalar with symbols. */
QDOT_MUST_CHECK qdot_status qdot_machine_pass(qdot_machine *m, qdot_expr value);
/* Record base^exponent, which gave `value`, as a value that must be defined. */
QDOT_MUST_CHECK qdot_status qdot_machine_pass_power(qdot_machine *m, qdot_expr base, qdot_expr exponent, qdot_expr value);
/* Record the values that must be defined in a separate frame, from _begin to _end. */
QDOT_MUST_CHECK qdot_status qdot_machine_pass_begin(qdot_machine *m);
void qdot_machine_pass_end(qdot_machine *m);
/* Note a call of `name`: unless it is a function of numbers only, it may use only parts of its arguments. */
void qdot_machine_spoil(qdot_machine *m, const char *name);
/* Replace a value along a run by a symbol, so that it can enter an expression. */
QDOT_MUST_CHECK qdot_status qdot_machine_enter(qdot_machine *m, qdot_slot *s);
/* The failures of what is meant along two runs at once, b.(a.x), and of a condition along a run,
 * a.(x > 0). */
qdot_status qdot_machine_along_two(const char *inner, const char *outer);
qdot_status qdot_machine_along_condition(const char *run);
/* Pop the top n values from the stack into m->args; _take: refuse texts such as latex(e). */
QDOT_MUST_CHECK qdot_status qdot_machine_take_any(qdot_machine *m, size_t n);
QDOT_MUST_CHECK qdot_status qdot_machine_take(qdot_machine *m, size_t n);
/* Whether all values of m->args are scalars. */
bool qdot_machine_all_scalars(const qdot_machine *m);

#endif
