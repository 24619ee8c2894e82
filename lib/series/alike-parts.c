/* alike-parts.c -- divides the steps of a program into parts and sums; orders parts so that like ones meet. */
#include "series/alike-parts.h"

#include <stdlib.h>
#include <string.h>

#define NONE UINT32_MAX

enum { ROUNDS = 3 };

typedef struct {
    const qdot_program *program;
    qdot_alike_parts *parts;
    uint32_t *maker;  /* [rows] the varying step that writes a row; NONE: none */
    uint32_t *parent; /* [steps] union-find over steps of parts */
    bool *sum;        /* [steps] whether it is a sum */
    uint32_t *level;  /* [steps] depth within its part */
    uint64_t *colour, *readers; /* [steps] */
} divider;

/* --- parts ------------------------------------------------------------------------------ */

static const qdot_program_step *
step_at(const divider *d, size_t i)
{
    return d->program->steps.at + i;
}

static bool
is_linear(const qdot_program_step *s)
{
    return s->op >= QDOT_T_NEG && s->op <= QDOT_T_SCALEOFF;
}

/* The step that writes an operand; NONE if it is an input or a number. */
static uint32_t
maker_of(const divider *d, const qdot_program_step *s, unsigned name)
{
    return d->maker[qdot_program_step_row(s, name)];
}

static uint32_t
find_root(divider *d, uint32_t i)
{
    while (d->parent[i] != i)
        i = d->parent[i] = d->parent[d->parent[i]];
    return i;
}

static void
join(divider *d, uint32_t a, uint32_t b)
{
    a = find_root(d, a);
    b = find_root(d, b);
    d->parent[a > b ? a : b] = a > b ? b : a; /* the first step of a part is its root */
}

static void
note_makers(divider *d)
{
    for (size_t i = d->program->still; i < d->program->length; i++) {
        const qdot_program_step *s = step_at(d, i);

        for (unsigned name = QDOT_OF_to; name <= QDOT_OF_d; name++)
            if (qdot_program_step_row(s, name) != QDOT_NO_ROW)
                d->maker[qdot_program_step_row(s, name)] = (uint32_t)i;
    }
}

static void
find_sums(divider *d)
{
    for (size_t i = d->program->still; i < d->program->length; i++)
        d->sum[i] = is_linear(step_at(d, i));
    for (size_t i = d->program->length; i-- > d->program->still;)
        for (unsigned name = QDOT_OF_x; name <= QDOT_OF_z && !d->sum[i]; name++)
            if (maker_of(d, step_at(d, i), name) != NONE)
                d->sum[maker_of(d, step_at(d, i), name)] = false;
}

static void
join_parts(divider *d)
{
    for (size_t i = d->program->still; i < d->program->length; i++)
        d->parent[i] = (uint32_t)i;
    for (size_t i = d->program->still; i < d->program->length; i++)
        for (unsigned name = QDOT_OF_x; name <= QDOT_OF_z && !d->sum[i]; name++)
            if (maker_of(d, step_at(d, i), name) != NONE)
                join(d, (uint32_t)i, maker_of(d, step_at(d, i), name));
}

/* Number the parts by their first steps, and list the steps of each. */
static qdot_status
list_parts(divider *d)
{
    const qdot_program *p = d->program;
    qdot_alike_parts *parts = d->parts;
    size_t *count;

    for (size_t i = p->still; i < p->length; i++)
        if (!d->sum[i])
            parts->part_of[i] = find_root(d, (uint32_t)i) == i ? (uint32_t)parts->n++ : parts->part_of[find_root(d, (uint32_t)i)];
    parts->first = qdot_calloc(parts->n + 2, sizeof *parts->first);
    parts->hash = qdot_calloc(parts->n + 1, sizeof *parts->hash);
    parts->order = qdot_calloc(parts->n + 1, sizeof *parts->order);
    parts->steps = qdot_calloc(p->length + 1, sizeof *parts->steps);
    if (!parts->first || !parts->hash || !parts->order || !parts->steps)
        return QDOT_ENOMEM;
    count = parts->first + 1;
    for (size_t i = p->still; i < p->length; i++)
        if (!d->sum[i])
            count[parts->part_of[i] + 1]++;
    for (size_t k = 1; k <= parts->n; k++)
        count[k] += count[k - 1];
    for (size_t i = p->still; i < p->length; i++) /* afterwards first[k] is where part k begins */
        if (!d->sum[i])
            parts->steps[count[parts->part_of[i]]++] = (uint32_t)i;
    return QDOT_OK;
}

/* --- an order of steps ------------------------------------------------------------------ */

static uint64_t
mix(uint64_t x, uint64_t y)
{
    x = (x ^ y) * UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ x >> 29) * UINT64_C(0xbf58476d1ce4e5b9);
    return x ^ x >> 32;
}

static uint64_t
colour_of_operand(const divider *d, qdot_program_row r)
{
    const uint32_t maker = d->maker[r];
    const qdot_program_step *s;

    if (maker == NONE)
        return d->program->rows.at[r].still ? 1 : 2;
    s = step_at(d, maker);
    return mix(d->colour[maker], r == s->to ? 3 : r == s->second ? 4 : r == s->third ? 5 : 6);
}

/* Colour steps by what they read, then by who reads them. */
static void
refine_colours(divider *d)
{
    const qdot_program *p = d->program;

    for (size_t i = p->still; i < p->length; i++) {
        const qdot_program_step *s = step_at(d, i);

        for (unsigned name = QDOT_OF_x; name <= QDOT_OF_z && !d->sum[i]; name++)
            d->colour[i] = mix(d->colour[i], colour_of_operand(d, qdot_program_step_row(s, name)));
        d->readers[i] = 0;
    }
    for (size_t i = p->length; i-- > p->still;) {
        const qdot_program_step *s = step_at(d, i);

        if (d->sum[i])
            continue;
        d->colour[i] = mix(d->colour[i], d->readers[i]);
        for (unsigned name = QDOT_OF_x; name <= QDOT_OF_z; name++)
            if (maker_of(d, s, name) != NONE)
                d->readers[maker_of(d, s, name)] += mix(d->colour[i], name);
    }
}

static void
colour_steps(divider *d)
{
    const qdot_program *p = d->program;

    for (size_t i = p->still; i < p->length; i++) {
        const qdot_program_step *s = step_at(d, i);

        if (d->sum[i])
            continue;
        d->colour[i] = mix(mix(s->op, s->zero), (uint64_t)(s->sign + 1));
        for (unsigned name = QDOT_OF_to; name <= QDOT_OF_d; name++) {
            const qdot_program_row r = qdot_program_step_row(s, name);

            d->colour[i] = mix(d->colour[i], r == QDOT_NO_ROW ? 0 : 1 + (uint64_t)d->parts->read_outside[r]);
        }
        for (unsigned name = QDOT_OF_x; name <= QDOT_OF_z; name++) {
            const uint32_t maker = maker_of(d, s, name);

            if (maker != NONE && d->level[maker] >= d->level[i])
                d->level[i] = d->level[maker] + 1;
        }
    }
    for (int round = 0; round < ROUNDS; round++)
        refine_colours(d);
}

/* A step with the keys by which those of a part are sorted. */
typedef struct {
    uint32_t level, step;
    uint64_t colour;
} keyed;

static int
compare_steps(const void *left, const void *right)
{
    const keyed *a = left, *b = right;

    if (a->level != b->level)
        return a->level < b->level ? -1 : 1;
    if (a->colour != b->colour)
        return a->colour < b->colour ? -1 : 1;
    return a->step < b->step ? -1 : a->step > b->step;
}

static int
compare_parts(const void *left, const void *right)
{
    const keyed *a = left, *b = right;

    if (a->colour != b->colour)
        return a->colour < b->colour ? -1 : 1;
    return a->step < b->step ? -1 : a->step > b->step;
}

static qdot_status
sort_parts(divider *d)
{
    qdot_alike_parts *parts = d->parts;
    const size_t all = parts->first[parts->n];
    keyed *keys = qdot_calloc((all > parts->n ? all : parts->n) + 1, sizeof *keys);

    if (!keys)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < parts->n; k++) {
        uint32_t *const steps = parts->steps + parts->first[k];
        const size_t n = parts->first[k + 1] - parts->first[k];

        for (size_t i = 0; i < n; i++)
            keys[i] = (keyed){d->level[steps[i]], steps[i], d->colour[steps[i]]};
        qsort(keys, n, sizeof *keys, compare_steps);
        for (size_t i = 0; i < n; i++) {
            steps[i] = keys[i].step;
            parts->hash[k] = mix(parts->hash[k], keys[i].colour);
        }
    }
    for (size_t k = 0; k < parts->n; k++)
        keys[k] = (keyed){0, (uint32_t)k, parts->hash[k]};
    qsort(keys, parts->n, sizeof *keys, compare_parts);
    for (size_t k = 0; k < parts->n; k++)
        parts->order[k] = keys[k].step;
    qdot_free(keys);
    return QDOT_OK;
}

/* --- all together ------------------------------------------------------------------------ */

/* Whether every varying step can be one of a part: what switches, or is a rate, cannot. */
static bool
can_be_divided(const qdot_program *p)
{
    for (size_t i = p->still; i < p->length; i++) {
        const qdot_program_step *s = p->steps.at + i;

        if (s->op <= QDOT_T_VALUE || s->op >= QDOT_T_LINK || s->zero == QDOT_OP_LOOKUP)
            return false;
    }
    return true;
}

static void
note_rows_read_outside(divider *d, const qdot_motion *motion)
{
    bool *read = d->parts->read_outside;

    for (size_t i = d->program->still; i < d->program->length; i++)
        for (unsigned k = 0; k < qdot_alike_operands(step_at(d, i)->op) && d->sum[i]; k++)
            read[qdot_program_step_row(step_at(d, i), QDOT_OF_x + k)] = true;
    for (size_t i = 0; i < d->program->outputs.n; i++)
        read[d->program->outputs.at[i]] = true;
    for (size_t i = 0; i < motion->unknowns.n; i++)
        if (motion->unknowns.at[i].value != QDOT_NO_ROW)
            read[motion->unknowns.at[i].value] = true;
}

static qdot_status
divide(divider *d, const qdot_motion *motion)
{
    const size_t rows = d->program->rows.n + 1, steps = d->program->steps.n + 1;

    d->maker = qdot_malloc(rows * sizeof *d->maker);
    d->parent = qdot_calloc(steps, sizeof *d->parent);
    d->sum = qdot_calloc(steps, sizeof *d->sum);
    d->level = qdot_calloc(steps, sizeof *d->level);
    d->colour = qdot_calloc(steps, sizeof *d->colour);
    d->readers = qdot_calloc(steps, sizeof *d->readers);
    d->parts->part_of = qdot_malloc(steps * sizeof *d->parts->part_of);
    d->parts->read_outside = qdot_calloc(rows, sizeof *d->parts->read_outside);
    if (!d->maker || !d->parent || !d->sum || !d->level || !d->colour || !d->readers || !d->parts->part_of ||
        !d->parts->read_outside)
        return QDOT_ENOMEM;
    memset(d->maker, 0xff, rows * sizeof *d->maker);
    memset(d->parts->part_of, 0xff, steps * sizeof *d->parts->part_of);
    note_makers(d);
    find_sums(d);
    join_parts(d);
    note_rows_read_outside(d, motion);
    QDOT_TRY(list_parts(d));
    colour_steps(d);
    return sort_parts(d);
}

qdot_status
qdot_alike_parts_find(const qdot_motion *motion, qdot_alike_parts *parts)
{
    divider d = {.program = &motion->program, .parts = parts};
    qdot_status status = QDOT_OK;

    *parts = (qdot_alike_parts){0};
    if (can_be_divided(d.program))
        status = divide(&d, motion);
    qdot_free(d.maker);
    qdot_free(d.parent);
    qdot_free(d.sum);
    qdot_free(d.level);
    qdot_free(d.colour);
    qdot_free(d.readers);
    return status;
}

void
qdot_alike_parts_clear(qdot_alike_parts *parts)
{
    qdot_free(parts->part_of);
    qdot_free(parts->first);
    qdot_free(parts->steps);
    qdot_free(parts->hash);
    qdot_free(parts->order);
    qdot_free(parts->read_outside);
    *parts = (qdot_alike_parts){0};
}
