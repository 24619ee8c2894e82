/* recurrence-operations.c -- the recurrences of recurrence.def as tables of operations. */
#include "series/recurrence-operations.h"

#define DO(verb_, ...) {.verb = QDOT_DO_##verb_, __VA_ARGS__},
#define U1 QDOT_OF_U1
#define U2 QDOT_OF_U2
#define NEWEST(row) QDOT_OF_##row
#define TERMS(r_, a_, b_, from_, below_)                                                 \
    .r = r_, .a = QDOT_OF_##a_, .b = QDOT_OF_##b_, .from = from_, .below = below_
#define SUM(r, a, b, from, below) DO(SUM, TERMS(r, a, b, from, below))
#define PAIR(r, s, a, b, c) DO(SUM, TERMS(r, a, b, 1, 0), .paired = true) SUM(s, a, c, 1, 0)
#define SQUARED(r, a, from) DO(SQUARED, TERMS(r, a, a, from, from))
#define ADD(r_, p_, q_) DO(ADD, .r = r_, .p = p_, .q = q_)
#define SUB(r_, p_, q_) DO(SUB, .r = r_, .p = p_, .q = q_)
#define NEG(r_, p_) DO(NEG, .r = r_, .p = p_)
#define TIMES(r_, p_, b_) DO(TIMES, .r = r_, .p = p_, .b = QDOT_OF_##b_)
#define PLUS_TIMES(r_, q_, p_, b_) DO(PLUS_TIMES, .r = r_, .q = q_, .p = p_, .b = QDOT_OF_##b_)
#define MINUS_TIMES(r_, q_, p_, b_) DO(MINUS_TIMES, .r = r_, .q = q_, .p = p_, .b = QDOT_OF_##b_)
#define OVER(r_, p_, b_) DO(OVER, .r = r_, .p = p_, .b = QDOT_OF_##b_)
#define OVER_TWICE(r_, p_, b_) DO(OVER_TWICE, .r = r_, .p = p_, .b = QDOT_OF_##b_)
#define ORDERS(r_, p_) DO(ORDERS, .r = r_, .p = p_)
#define PER_ORDER(r_, p_) DO(PER_ORDER, .r = r_, .p = p_)
#define SIGNED(r_, p_) DO(SIGNED, .r = r_, .p = p_)

const qdot_recurrence_operation *
qdot_recurrence_operations(int op)
{
    enum { most = 12 };
    static const qdot_recurrence_operation operations[QDOT_T_COUNT][most] = {
#define RECURRENCE(ID, cost, body) [QDOT_T_##ID] = {body},
#include "series/recurrence.def"
    };

    return operations[op];
}

const qdot_recurrence_operation *
qdot_recurrence_find(int op, qdot_recurrence_verb verb)
{
    const qdot_recurrence_operation *o = qdot_recurrence_operations(op);

    while (o->verb != QDOT_DO_END && o->verb != verb)
        o++;
    return o->verb == verb ? o : NULL;
}
