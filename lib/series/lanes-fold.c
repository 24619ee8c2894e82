/* lanes-fold.c -- steps of a motion that their readers carry out: a sign, a rate or the rate of a
 * rate, a product that another one is added to. */
#include "series/lanes-writer.h"

/* The step of the series program that computes a row; NULL for an input or a constant. */
static const qdot_program_step *
step_of_row(const qdot_lanes_writer *w, qdot_program_row row)
{
    const size_t i = w->rows[row].step;

    return i == SIZE_MAX ? NULL : w->t->steps.at + i;
}

static bool
is_folded(const qdot_lanes_writer *w, qdot_program_row row)
{
    return step_of_row(w, row) && w->steps[w->rows[row].step].folded;
}

qdot_writer_addend
qdot_writer_expand(const qdot_lanes_writer *w, qdot_program_row row)
{
    qdot_writer_addend t = {.row = row};

    while (is_folded(w, t.row)) {
        const qdot_program_step *s = step_of_row(w, t.row);

        t.minus ^= s->op == QDOT_T_NEG;
        t.rates += s->op == QDOT_T_RATE;
        t.row = s->x;
    }
    return t;
}

static bool
lanes_step_is_product(int op)
{
    return op == QDOT_T_MUL || op == QDOT_T_MADD || op == QDOT_T_MSUB;
}

const qdot_program_step *
qdot_writer_within(const qdot_lanes_writer *w, const qdot_program_step *product)
{
    const qdot_program_step *z = product->op == QDOT_T_MADD ? step_of_row(w, product->z) : NULL;

    return z && lanes_step_is_product(z->op) && is_folded(w, product->z) ? z : NULL;
}

/* Whether a step reads the row only as a summand: in a plain sum, sign or time derivative, or as its operand z. */
static bool
is_only_summand(const qdot_program_step *s, qdot_program_row row)
{
    switch (s->op) {
    case QDOT_T_NEG:
    case QDOT_T_ADD:
    case QDOT_T_SUB:
    case QDOT_T_RATE: return true;
    case QDOT_T_SCALEADD:
    case QDOT_T_SCALESUB:
    case QDOT_T_SCALEOFF:
    case QDOT_T_MADD:
    case QDOT_T_MSUB:
    case QDOT_T_NMADD: return s->x != row && s->y != row;
    default: return false;
    }
}

static void
count_readers(qdot_lanes_writer *w)
{
    for (size_t i = w->t->still; i < w->t->length; i++) {
        const qdot_program_step *s = w->t->steps.at + i;
        const qdot_program_row rows[] = {s->x, s->y, s->z};

        w->rows[s->to].step = i;
        for (int r = 0; r < 3; r++) {
            if ((r > 0 && rows[r] == rows[0]) || (r > 1 && rows[r] == rows[1]))
                continue;
            w->rows[rows[r]].readers++;
            w->rows[rows[r]].linear += is_only_summand(s, rows[r]);
            w->rows[rows[r]].rated |= s->op == QDOT_T_RATE;
        }
    }
}

/* Mark the rows of the program that belong to equations or unknowns of the motion: they must be computed. */
static void
mark_required_rows(qdot_lanes_writer *w, const qdot_motion *m)
{
    for (size_t i = 0; i < m->equations.n; i++)
        w->rows[m->equations.at[i]].equation = w->rows[m->equations.at[i]].wanted = true;
    for (size_t i = 0; i < m->unknowns.n; i++)
        if (m->unknowns.at[i].value != QDOT_NO_ROW)
            w->rows[m->unknowns.at[i].value].equation = true;
}

static void
fold_negation_or_rate(qdot_lanes_writer *w, size_t i)
{
    const qdot_program_step *s = w->t->steps.at + i;
    const qdot_writer_row *to = w->rows + s->to;
    const int rates = qdot_writer_expand(w, s->x).rates + (s->op == QDOT_T_RATE);

    if (to->linear == to->readers && rates <= (to->rated ? 1 : 2) &&
        (s->op == QDOT_T_RATE || rates == 0))
        w->steps[i].folded = true;
}

/* If step i adds its product to the result of another product's step, which nothing else reads, fold that into step i. */
static void
fold_product(qdot_lanes_writer *w, size_t i)
{
    const qdot_program_step *s = w->t->steps.at + i, *z = step_of_row(w, s->z);
    int inner;

    w->steps[i].pairs = 1;
    if (s->op != QDOT_T_MADD || !z || !lanes_step_is_product(z->op) || z->lead != s->lead ||
        w->rows[s->z].readers != 1 || w->rows[s->z].linear != 1 || w->rows[s->z].equation)
        return;
    inner = w->steps[w->rows[s->z].step].pairs;
    if (inner >= QDOT_WRITER_PAIRS)
        return;
    w->steps[w->rows[s->z].step].folded = true;
    w->steps[i].pairs += inner;
}

/* Mark the rows on which equations depend, and the steps on which no equation depends. */
static void
mark_wanted_rows(qdot_lanes_writer *w)
{
    for (size_t i = w->t->length; i-- > w->t->still;) {
        const qdot_program_step *s = w->t->steps.at + i;
        const qdot_program_row made[] = {s->to, s->second, s->third, s->d};

        w->steps[i].idle = true;
        for (size_t r = 0; r < sizeof made / sizeof *made; r++)
            if (made[r] != QDOT_NO_ROW && w->rows[made[r]].wanted)
                w->steps[i].idle = false;
        if (!w->steps[i].idle)
            w->rows[s->x].wanted = w->rows[s->y].wanted = w->rows[s->z].wanted = true;
    }
}

void
qdot_writer_fold(qdot_lanes_writer *w, const qdot_motion *m)
{
    w->motion = m;
    count_readers(w);
    mark_required_rows(w, m);
    mark_wanted_rows(w);
    for (size_t i = w->t->still; i < w->t->length; i++) {
        const qdot_program_step *s = w->t->steps.at + i;

        if (lanes_step_is_product(s->op))
            fold_product(w, i);
        else if ((s->op == QDOT_T_NEG || s->op == QDOT_T_RATE) &&
                 !w->rows[s->to].equation)
            fold_negation_or_rate(w, i);
    }
}
