/* alike.c -- frees kinds of parts; tells how a recurrence reads its rows. */
#include "series/alike.h"

#include "base/memory.h"

void
qdot_alike_reading(int op, unsigned *summed, unsigned *first)
{
    static const char operands[] = {'x', 'y', 'z'};

    *summed = *first = 0;
    for (const qdot_recurrence_operation *o = qdot_recurrence_operations(op); o->verb != QDOT_DO_END; o++)
        switch (o->verb) {
        case QDOT_DO_SUM:
        case QDOT_DO_SQUARED: *summed |= 1u << o->a | 1u << o->b; break;
        case QDOT_DO_TIMES:
        case QDOT_DO_PLUS_TIMES:
        case QDOT_DO_MINUS_TIMES:
        case QDOT_DO_OVER:
        case QDOT_DO_OVER_TWICE: *first |= 1u << o->b; break;
        default: break;
        }
    for (int i = 0; i < 3; i++)
        if (qdot_recurrence_divisor(op) == operands[i])
            *summed |= 1u << (QDOT_OF_x + i);
    if (qdot_recurrence_exponential(op) > 0)
        *summed |= 1u << QDOT_OF_x;
}

void
qdot_alike_kind_clear(qdot_alike_kind *k)
{
    qdot_free(k->steps.at);
    qdot_free(k->input.at);
    qdot_free(k->input_rows.at);
    qdot_free(k->number_rows.at);
    qdot_free(k->summed.at);
    qdot_free(k->results.at);
    *k = (qdot_alike_kind){0};
}

void
qdot_alike_free(qdot_alike *a)
{
    if (!a)
        return;
    for (size_t i = 0; i < a->kinds.n; i++)
        qdot_alike_kind_clear(a->kinds.at + i);
    qdot_free(a->kinds.at);
    qdot_free(a->terms.at);
    qdot_free(a->sums.at);
    qdot_free(a->value);
    qdot_free(a);
}
