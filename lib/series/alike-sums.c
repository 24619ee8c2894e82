/* alike-sums.c -- makes the sums over what parts contribute: lists of terms, without the partial sums. */
#include <string.h>

#include "series/alike-parts.h"

#define NONE UINT32_MAX

/* A term in a linked list; those of a row that is read once move on to its reader. */
typedef struct {
    qdot_alike_term term;
    uint32_t next;
} link;

typedef struct {
    uint32_t first, last;
} list;

typedef struct {
    const qdot_program *program;
    qdot_alike *alike;
    uint32_t *reads;   /* [rows] how many sums read a row */
    bool *needs_value; /* [rows] whether it is an output or integrated */
    list *of_row;     /* [rows] the terms of a sum that is not written yet */
    qdot_vec(link) links;
} builder;

static void
count_readers_of_rows(builder *b, const qdot_motion *motion, const qdot_alike_parts *parts)
{
    const qdot_program *p = b->program;

    for (size_t i = p->still; i < p->length; i++)
        for (unsigned k = 0; k < qdot_alike_operands(p->steps.at[i].op) && parts->part_of[i] == NONE; k++)
            b->reads[qdot_program_step_row(p->steps.at + i, QDOT_OF_x + k)]++;
    for (size_t i = 0; i < p->outputs.n; i++)
        b->needs_value[p->outputs.at[i]] = true;
    for (size_t i = 0; i < motion->unknowns.n; i++)
        if (motion->unknowns.at[i].value != QDOT_NO_ROW)
            b->needs_value[motion->unknowns.at[i].value] = true;
}

/* Give a row whose terms are in a list a value of its own. */
static qdot_status
write_sum(builder *b, qdot_program_row r)
{
    qdot_alike *a = b->alike;

    a->value[r] = a->first_sum + (uint32_t)a->sums.n;
    QDOT_TRY(qdot_vec_push(&a->sums, (uint32_t)a->terms.n));
    for (uint32_t i = b->of_row[r].first; i != NONE; i = b->links.at[i].next)
        QDOT_TRY(qdot_vec_push(&a->terms, b->links.at[i].term));
    return QDOT_OK;
}

static void
append(builder *b, list *to, list from)
{
    if (from.first == NONE)
        return;
    if (to->first == NONE)
        *to = from;
    else {
        b->links.at[to->last].next = from.first;
        to->last = from.last;
    }
}

/* A single term is copied to all that read it. */
static bool
is_single_term(const builder *b, list of_row)
{
    return of_row.first != NONE && b->links.at[of_row.first].next == NONE;
}

static qdot_status
append_term(builder *b, list *to, uint32_t from, qdot_program_row factor, int sign)
{
    append(b, to, (list){(uint32_t)b->links.n, (uint32_t)b->links.n});
    return qdot_vec_push(&b->links, ((link){{from, factor, sign}, NONE}));
}

/* Append sign times the number in row `factor` (QDOT_NO_ROW: 1) times row r to a list of terms. */
static qdot_status
add_scaled_row(builder *b, list *to, qdot_program_row r, qdot_program_row factor, int sign)
{
    list *of_row = b->of_row + r;

    if (b->program->rows.at[r].still) {
        if (factor == QDOT_NO_ROW)
            return append_term(b, to, b->alike->one, r, sign);
        if (of_row->first == NONE)
            QDOT_TRY(append_term(b, of_row, b->alike->one, r, 1));
    }
    if (b->alike->value[r] == NONE) {
        if (factor == QDOT_NO_ROW && is_single_term(b, *of_row)) {
            const qdot_alike_term *t = &b->links.at[of_row->first].term;

            return append_term(b, to, t->from, t->factor, sign * t->sign);
        }
        if (factor == QDOT_NO_ROW && b->reads[r] == 1) {
            for (uint32_t i = of_row->first; i != NONE && sign < 0; i = b->links.at[i].next)
                b->links.at[i].term.sign = -b->links.at[i].term.sign;
            append(b, to, *of_row);
            return QDOT_OK;
        }
        QDOT_TRY(write_sum(b, r));
    }
    return append_term(b, to, b->alike->value[r], factor, sign);
}

/* The terms of a linear step. */
static qdot_status
add_step(builder *b, const qdot_program_step *s)
{
    list to = {NONE, NONE};

    switch (s->op) {
    case QDOT_T_NEG: QDOT_TRY(add_scaled_row(b, &to, s->x, QDOT_NO_ROW, -1)); break;
    case QDOT_T_ADD:
    case QDOT_T_SUB:
        QDOT_TRY(add_scaled_row(b, &to, s->x, QDOT_NO_ROW, 1));
        QDOT_TRY(add_scaled_row(b, &to, s->y, QDOT_NO_ROW, s->op == QDOT_T_ADD ? 1 : -1));
        break;
    default: /* x y, x y + z, x y - z, z - x y */
        QDOT_TRY(add_scaled_row(b, &to, s->y, s->x, s->op == QDOT_T_SCALEOFF ? -1 : 1));
        if (s->op != QDOT_T_SCALE)
            QDOT_TRY(add_scaled_row(b, &to, s->z, QDOT_NO_ROW, s->op == QDOT_T_SCALESUB ? -1 : 1));
    }
    b->of_row[s->to] = to;
    return b->needs_value[s->to] || (b->reads[s->to] > 1 && !is_single_term(b, to)) ? write_sum(b, s->to) : QDOT_OK;
}

static qdot_status
make_sums(builder *b, const qdot_motion *motion, const qdot_alike_parts *parts)
{
    const qdot_program *p = b->program;
    const size_t rows = p->rows.n + 1;

    b->reads = qdot_calloc(rows, sizeof *b->reads);
    b->of_row = qdot_malloc(rows * sizeof *b->of_row);
    b->needs_value = qdot_calloc(rows, sizeof *b->needs_value);
    if (!b->reads || !b->of_row || !b->needs_value)
        return QDOT_ENOMEM;
    memset(b->of_row, 0xff, rows * sizeof *b->of_row);
    count_readers_of_rows(b, motion, parts);
    for (size_t i = p->still; i < p->length; i++)
        if (parts->part_of[i] == NONE)
            QDOT_TRY(add_step(b, p->steps.at + i));
    return qdot_vec_push(&b->alike->sums, (uint32_t)b->alike->terms.n);
}

qdot_status
qdot_alike_sums(const qdot_motion *motion, const qdot_alike_parts *parts, qdot_alike *alike)
{
    builder b = {.program = &motion->program, .alike = alike};
    const qdot_status status = make_sums(&b, motion, parts);

    qdot_free(b.reads);
    qdot_free(b.needs_value);
    qdot_free(b.of_row);
    qdot_free(b.links.at);
    return status;
}
