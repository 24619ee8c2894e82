/* alike-kinds.c -- finds the parts of a motion's program, and which of them have the same steps. */
#include "series/alike-kinds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "series/alike-parts.h"

enum {
    least_parts = 8, /* of one kind, for vectors to be full */
    lane = 8
};
/* The least share of the convolutions that parts in full vectors have. */
static const double least_share = 0.9;

/* Builds the kinds: rows of the part at hand have places. */
typedef struct {
    const qdot_motion *motion;
    const qdot_program *program;
    const qdot_alike_parts *parts;
    qdot_alike *alike;
    qdot_alike_place *place; /* [rows] where a row of the part at hand is */
    size_t *stamp, part;     /* [rows] the part for which that is so, counted from 1; the one at hand */
    qdot_alike_kind trial;   /* the part at hand as a kind of its own */
} builder;

/* --- a part as a kind ----------------------------------------------------------------- */

static bool
has_place(const builder *b, qdot_program_row r)
{
    return b->stamp[r] == b->part;
}

static qdot_alike_place
reserve_place(qdot_alike_kind *k, qdot_alike_space space)
{
    size_t *const of = space == QDOT_ALIKE_ORDERS   ? &k->orders
                       : space == QDOT_ALIKE_NEWEST ? &k->newest
                                                    : &k->numbers;

    return (qdot_alike_place){space, (uint32_t)(*of)++};
}

/* Give a place to a row of the part: an operand that is summed over orders is needed at all of them. */
static qdot_status
give_place(builder *b, qdot_program_row r, bool summed)
{
    qdot_alike_kind *k = &b->trial;
    const qdot_program_row_info *row = b->program->rows.at + r;

    if (has_place(b, r)) /* an input or a number may turn out to be summed later: its place changes then */
        return QDOT_OK;
    b->stamp[r] = b->part;
    if (row->still) {
        b->place[r] = reserve_place(k, QDOT_ALIKE_NUMBER);
        QDOT_TRY(qdot_vec_push(&k->number_rows, r));
        if (summed) {
            const qdot_alike_place orders = reserve_place(k, QDOT_ALIKE_ORDERS);

            QDOT_TRY(qdot_vec_push(&k->summed, b->place[r]));
            QDOT_TRY(qdot_vec_push(&k->summed, orders));
        }
        return QDOT_OK;
    }
    b->place[r] = reserve_place(k, summed ? QDOT_ALIKE_ORDERS : QDOT_ALIKE_NEWEST);
    if (row->source == QDOT_ROW_COMPUTED)
        return QDOT_OK;
    k->inputs++;
    QDOT_TRY(qdot_vec_push(&k->input, b->place[r]));
    return qdot_vec_push(&k->input_rows, r);
}

/* Rows that are summed by some step of the part get their places first. */
static qdot_status
give_all_places(builder *b, const uint32_t *steps, size_t n)
{
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < n; i++) {
            const qdot_program_step *s = b->program->steps.at + steps[i];
            unsigned summed, first;

            qdot_alike_reading(s->op, &summed, &first);
            for (unsigned name = 0; name < QDOT_OF_ROWS; name++) {
                const qdot_program_row r = qdot_program_step_row(s, name);
                const bool is_summed = summed >> name & 1;

                if (r != QDOT_NO_ROW && (pass == 1 || is_summed))
                    QDOT_TRY(give_place(b, r, is_summed));
            }
        }
    return QDOT_OK;
}

/* The place of all orders of a number that sums of products read. */
static qdot_alike_place
place_of_summed_number(const qdot_alike_kind *k, qdot_alike_place number)
{
    for (size_t i = 0; i + 1 < k->summed.n; i += 2)
        if (k->summed.at[i].at == number.at)
            return k->summed.at[i + 1];
    return number;
}

static qdot_status
add_step(builder *b, const qdot_program_step *s)
{
    qdot_alike_step to = {.op = s->op, .zero = s->zero, .sign = s->sign,
                          .second = s->second != QDOT_NO_ROW, .third = s->third != QDOT_NO_ROW,
                          .d = s->d != QDOT_NO_ROW};
    unsigned summed, first;

    qdot_alike_reading(s->op, &summed, &first);
    for (unsigned name = 0; name < QDOT_OF_ROWS; name++) {
        const qdot_program_row r = qdot_program_step_row(s, name);
        qdot_alike_place p = b->place[r == QDOT_NO_ROW ? s->to : r];

        if (name >= QDOT_OF_x)
            to.first[name - QDOT_OF_x] = p;
        if (p.space == QDOT_ALIKE_NUMBER) {
            if (summed >> name & 1)
                p = place_of_summed_number(&b->trial, p);
            else if (!(first >> name & 1))
                p = (qdot_alike_place){QDOT_ALIKE_NOUGHT, 0};
        }
        to.row[name] = p;
    }
    b->trial.convolutions += qdot_recurrence_cost(s->op);
    return qdot_vec_push(&b->trial.steps, to);
}

/* Describe the part at hand as a kind: b->trial. */
static qdot_status
describe_part(builder *b, const uint32_t *steps, size_t n)
{
    qdot_alike_kind_clear(&b->trial);
    b->part++;
    QDOT_TRY(give_all_places(b, steps, n));
    for (size_t i = 0; i < n; i++)
        QDOT_TRY(add_step(b, b->program->steps.at + steps[i]));
    for (size_t i = 0; i < n; i++) {
        const qdot_program_step *s = b->program->steps.at + steps[i];
        const qdot_program_row rows[] = {s->to, s->second, s->third, s->d};

        for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
            if (rows[k] != QDOT_NO_ROW && b->parts->read_outside[rows[k]])
                QDOT_TRY(qdot_vec_push(&b->trial.results, ((qdot_alike_result){b->place[rows[k]], rows[k]})));
    }
    b->trial.parts = 1;
    return QDOT_OK;
}

static bool
is_same_place(qdot_alike_place a, qdot_alike_place b)
{
    return a.space == b.space && a.at == b.at;
}

static bool
is_same_step(const qdot_alike_step *a, const qdot_alike_step *b)
{
    bool same = a->op == b->op && a->zero == b->zero && a->sign == b->sign && a->second == b->second &&
                a->third == b->third && a->d == b->d;

    for (int i = 0; i < QDOT_OF_ROWS && same; i++)
        same = is_same_place(a->row[i], b->row[i]);
    for (int i = 0; i < 3 && same; i++)
        same = is_same_place(a->first[i], b->first[i]);
    return same;
}

static bool
is_same_kind(const qdot_alike_kind *a, const qdot_alike_kind *b)
{
    bool same = a->steps.n == b->steps.n && a->inputs == b->inputs && a->numbers == b->numbers &&
                a->results.n == b->results.n && a->input.n == b->input.n && a->summed.n == b->summed.n;

    for (size_t i = 0; i < a->steps.n && same; i++)
        same = is_same_step(a->steps.at + i, b->steps.at + i);
    for (size_t i = 0; i < a->input.n && same; i++)
        same = is_same_place(a->input.at[i], b->input.at[i]);
    for (size_t i = 0; i < a->summed.n && same; i++)
        same = is_same_place(a->summed.at[i], b->summed.at[i]);
    for (size_t i = 0; i < a->results.n && same; i++)
        same = is_same_place(a->results.at[i].place, b->results.at[i].place);
    return same;
}

/* Add the part at hand to a kind that it is like. The rows of its results are kept in `rows` by part. */
static qdot_status
add_part_to(builder *b, qdot_alike_kind *k)
{
    for (size_t i = 0; i < b->trial.input_rows.n; i++)
        QDOT_TRY(qdot_vec_push(&k->input_rows, b->trial.input_rows.at[i]));
    for (size_t i = 0; i < b->trial.number_rows.n; i++)
        QDOT_TRY(qdot_vec_push(&k->number_rows, b->trial.number_rows.at[i]));
    for (size_t i = 0; i < b->trial.results.n; i++)
        QDOT_TRY(qdot_vec_push(&k->results, b->trial.results.at[i]));
    k->parts++;
    return QDOT_OK;
}

/* --- all kinds -------------------------------------------------------------------------- */

/* Parts are compared with the kinds of equal hash, which are the last `recent`. */
static qdot_status
add_part(builder *b, size_t part, size_t recent)
{
    const qdot_alike_parts *p = b->parts;
    qdot_alike *a = b->alike;
    qdot_alike_kind *same = NULL;

    QDOT_TRY(describe_part(b, p->steps + p->first[part], p->first[part + 1] - p->first[part]));
    for (size_t k = a->kinds.n - recent; k < a->kinds.n && !same; k++) {
        qdot_alike_kind first = a->kinds.at[k];

        first.results.n /= first.parts;
        if (is_same_kind(&first, &b->trial))
            same = a->kinds.at + k;
    }
    if (same)
        return add_part_to(b, same);
    QDOT_TRY(qdot_vec_push(&a->kinds, b->trial));
    b->trial = (qdot_alike_kind){0};
    return QDOT_OK;
}

static size_t
round_up(size_t n, size_t to)
{
    return (n + to - 1) / to * to;
}

/* Number the values that are results: those of the first part keep their places, all are entered by row. */
static uint32_t
number_results(qdot_alike *a, uint32_t at)
{
    for (qdot_alike_kind *k = a->kinds.at; k < a->kinds.at + a->kinds.n; k++) {
        const size_t results = k->results.n / k->parts;

        for (size_t r = 0; r < results; r++) {
            for (size_t part = 0; part < k->parts; part++)
                a->value[k->results.at[part * results + r].at] = at + (uint32_t)part;
            k->results.at[r].at = at;
            at += (uint32_t)round_up(k->parts, QDOT_ALIKE_LANES);
        }
        k->results.n = results;
    }
    return at;
}

static qdot_status
make_kinds(builder *b)
{
    const qdot_alike_parts *p = b->parts;
    size_t recent = 0;

    for (size_t i = 0; i < p->n; i++) {
        const size_t kinds = b->alike->kinds.n;

        if (i > 0 && p->hash[p->order[i]] != p->hash[p->order[i - 1]])
            recent = 0;
        QDOT_TRY(add_part(b, p->order[i], recent));
        recent += b->alike->kinds.n - kinds;
    }
    return QDOT_OK;
}

static qdot_status
make_alike(builder *b, bool *worth)
{
    const qdot_program *p = b->program;
    qdot_alike *a = b->alike;
    double all = 0, full = 0;

    b->place = qdot_calloc(p->rows.n + 1, sizeof *b->place);
    b->stamp = qdot_calloc(p->rows.n + 1, sizeof *b->stamp);
    a->value = qdot_malloc((p->rows.n + 1) * sizeof *a->value);
    if (!b->place || !b->stamp || !a->value)
        return QDOT_ENOMEM;
    memset(a->value, 0xff, (p->rows.n + 1) * sizeof *a->value);
    QDOT_TRY(make_kinds(b));
    for (const qdot_alike_kind *k = a->kinds.at; k < a->kinds.at + a->kinds.n; k++) {
        const double convolutions = k->convolutions * (double)k->parts;

        all += convolutions;
        full += k->parts >= least_parts ? convolutions : 0;
    }
    *worth = full > 0 && full >= least_share * all;
    if (!*worth)
        return QDOT_OK;
    for (qdot_alike_kind *k = a->kinds.at; k < a->kinds.at + a->kinds.n; k++) {
        QDOT_TRY(qdot_alike_join(k));
        a->vectors += k->convolutions * (double)round_up(k->parts, lane) / lane;
    }
    for (size_t i = 0; i < p->moving; i++)
        a->value[i] = (uint32_t)i;
    a->one = (uint32_t)p->moving;
    a->first_sum = number_results(a, a->one + 1);
    return qdot_alike_sums(b->motion, b->parts, a);
}

qdot_status
qdot_alike_find(qdot_motion *motion)
{
    qdot_alike_parts parts = {0};
    builder b = {.motion = motion, .program = &motion->program, .parts = &parts};
    qdot_status status;
    bool worth = false;

    if (motion->solved.n > 0 || motion->program.lead > 0 ||
        motion->program.length - motion->program.still < least_parts)
        return QDOT_OK;
    status = qdot_alike_parts_find(motion, &parts);
    if (status == QDOT_OK && parts.n >= least_parts) {
        b.alike = qdot_calloc(1, sizeof *b.alike);
        status = b.alike ? make_alike(&b, &worth) : QDOT_ENOMEM;
    }
    qdot_alike_parts_clear(&parts);
    qdot_alike_kind_clear(&b.trial);
    qdot_free(b.place);
    qdot_free(b.stamp);
    if (status != QDOT_OK || !worth) {
        qdot_alike_free(b.alike);
        return status;
    }
    motion->alike = b.alike;
    return QDOT_OK;
}
