/* taylor.c -- a program for Taylor series in doubles: allocates its rows, and makes inputs integrals of rows. */
#include "series/taylor.h"

#include <math.h>
#include <string.h>

#include "series/taylor-code.h"
#include "series/taylor-products.h"
#include "series/taylor-steps.h"
#include "machine/asm.h"
#include "tape/shake.h"

/* --- making a program in doubles ---------------------------------------------------- */

enum { LINE = 8 }; /* number of doubles in a cache line */

static qdot_status
taylor_allocate(qdot_taylor *t, const qdot_program *p, int most, size_t spare, size_t more)
{
    /* an odd number of cache lines between rows, so that they use all sets of the cache */
    t->stride = (((size_t)most + 2 + 7) / 8 | 1) * 8;
    t->per_row = ((uint64_t)1 << 32) / t->stride + 1;
    t->spare = p->rows.n;
    t->rows = t->spare + spare;
    t->inputs = p->inputs;
    t->outputs = p->outputs.n;
    t->length = p->length;
    t->still = p->still;
    t->convolutions = p->convolutions;
    t->moving = p->moving;
    t->allocated =
        qdot_calloc(t->rows * t->stride + more + LINE, sizeof *t->coefficients);
    t->output = qdot_calloc(t->outputs + 1, sizeof *t->output);
    t->constant = qdot_calloc(t->outputs + 1, sizeof *t->constant);
    t->steps = qdot_calloc(p->steps.n, sizeof *t->steps);
    t->drawn = qdot_calloc(p->constants.n + 1, sizeof *t->drawn);
    if (!t->allocated || !t->output || !t->constant || !t->steps || !t->drawn)
        return QDOT_ENOMEM;
    t->coefficients = t->allocated;
    while ((uintptr_t)(t->coefficients + 1) % (LINE * sizeof(double)) != 0)
        t->coefficients++;
    return QDOT_OK;
}

/* Write constants to their rows: rounded to nearest, or for a shaken copy to the other side. Note those that are
 * rounded at random. */
static void
set_constants(qdot_taylor *t, const qdot_program *p, bool shaken)
{
    for (size_t r = 0; r < t->spare; r++) {
        const qdot_program_row_info *row = p->rows.at + r;
        double *to = t->coefficients + r * t->stride;

        if (row->source == QDOT_ROW_WHOLE)
            *to = row->at;
        if (row->source == QDOT_ROW_CONSTANT) {
            const qdot_program_constant *c = p->constants.at + row->at;
            const double far = qdot_shake_double(c->value, c->side);

            *to = shaken ? far : c->value;
            if (c->low != 0 && !shaken)
                t->drawn[t->n_drawn++] = (struct qdot_taylor_drawn){
                    to, c->value, far, c->low / (far - c->value)};
        }
    }
}

qdot_status
qdot_taylor_settle(qdot_taylor *t, const qdot_program *p, int most, size_t spare,
                   size_t more, bool shaken)
{
    QDOT_TRY(taylor_allocate(t, p, most, spare, more));
    set_constants(t, p, shaken);
    for (size_t i = 0; i < p->steps.n; i++) {
        const qdot_program_step *s = p->steps.at + i;

        t->steps[i] = (qdot_taylor_step){.op = s->op,
                                         .zero = s->zero,
                                         .sign = (signed char)s->sign,
                                         .lead = s->lead,
                                         .newest = s->newest,
                                         .kept = s->kept,
                                         .to = qdot_taylor_place(t, s->to),
                                         .second = qdot_taylor_place(t, s->second),
                                         .third = qdot_taylor_place(t, s->third),
                                         .d = qdot_taylor_place(t, s->d),
                                         .x = qdot_taylor_place(t, s->x),
                                         .y = qdot_taylor_place(t, s->y),
                                         .z = qdot_taylor_place(t, s->z)};
    }
    for (size_t i = 0; i < t->outputs; i++) {
        const qdot_program_row r = p->outputs.at[i];

        t->output[i] = qdot_taylor_place(t, r);
        t->constant[i] = p->rows.at[r].still;
    }
    t->kernels = qdot_series_kernels_get();
    qdot_taylor_find_functions(t);
    return QDOT_OK;
}

static qdot_status
check_highest_order(int most)
{
    return most < 0 || most > QDOT_SERIES_MOST
               ? qdot_fail(QDOT_EINVAL, "an order of %d is out of range", most)
               : QDOT_OK;
}

qdot_status
qdot_taylor_of_program(const qdot_program *program, bool shaken, int most,
                       qdot_taylor **taylor)
{
    qdot_taylor *t;
    qdot_status status;

    *taylor = NULL;
    QDOT_TRY(check_highest_order(most));
    t = qdot_calloc(1, sizeof *t);
    status = t ? qdot_taylor_settle(t, program, most, 0, 0, shaken) : QDOT_ENOMEM;
    if (status != QDOT_OK) {
        qdot_taylor_free(t);
        return status;
    }
    *taylor = t;
    return QDOT_OK;
}

static void
free_block(qdot_taylor_block *b)
{
    qdot_free(b->f);
    qdot_free(b->a);
    qdot_free(b->couplings);
    qdot_free(b->matrices);
}

void
qdot_taylor_free(qdot_taylor *t)
{
    if (!t)
        return;
    qdot_taylor_changes_free(t);
    qdot_taylor_code_free(t->code);
    for (size_t b = 0; b < t->n_blocks; b++)
        free_block(t->blocks + b);
    qdot_free(t->blocks);
    qdot_free(t->negated);
    qdot_free(t->unknowns);
    qdot_free(t->newest);
    qdot_taylor_products_free(t->products);
    qdot_free(t->allocated);
    qdot_free(t->output);
    qdot_free(t->constant);
    qdot_free(t->steps);
    qdot_free(t->drawn);
    qdot_free(t);
}

qdot_status
qdot_taylor_link(qdot_taylor *t, size_t i, size_t twice, const double *from)
{
    size_t capacity = t->length + t->n_links + 1;
    qdot_taylor_step *link;

    QDOT_TRY(qdot_grow(&t->steps, &capacity, capacity + 1, sizeof *t->steps));
    link = t->steps + t->length + t->n_links++;
    link[1] = link[0];
    *link = (qdot_taylor_step){
        .op = QDOT_T_LINK,
        .to = t->coefficients + i * t->stride,
        .second = twice != SIZE_MAX ? t->coefficients + twice * t->stride : NULL,
        .x = from};
    return QDOT_OK;
}

bool
qdot_taylor_may_be_code(void)
{
    return qdot_asm_is_here();
}

const char *
qdot_taylor_code_kind(void)
{
    static const char *const names[] = {"SSE2", "AVX2", "AVX-512"};

    return names[qdot_asm_kind()];
}

bool
qdot_taylor_is_code(const qdot_taylor *t, int to)
{
    return t->code && qdot_taylor_code_orders(t->code) == to;
}

qdot_status
qdot_taylor_prepare(qdot_taylor *t, int to, int most)
{
    if (to < 1 || to > QDOT_SERIES_MOST)
        return qdot_fail(QDOT_EINVAL, "an order of %d is out of range", to);
    if (t->refused || qdot_taylor_is_code(t, to))
        return QDOT_OK;
    qdot_taylor_drop_code(t);
    return qdot_taylor_code_new(t, to, most, false, &t->code, &t->no_code);
}

bool
qdot_taylor_take_kept(qdot_taylor *t, int to, int most)
{
    const char *why;

    if (t->refused || t->asked || t->code || to < 1 || to > QDOT_SERIES_MOST)
        return false;
    t->asked = true;
    return qdot_taylor_code_new(t, to, most, true, &t->code, &why) == QDOT_OK && t->code;
}

void
qdot_taylor_drop_code(qdot_taylor *t)
{
    qdot_taylor_code_free(t->code);
    t->code = NULL;
}

void
qdot_taylor_refuse_code(qdot_taylor *t, const char *why)
{
    qdot_taylor_drop_code(t);
    t->refused = true;
    t->no_code = why;
}

size_t
qdot_taylor_code_bytes(const qdot_taylor *t, const char **why)
{
    *why = t->code ? NULL : t->no_code;
    return t->code ? qdot_taylor_code_size(t->code) : 0;
}

double *
qdot_taylor_input(qdot_taylor *t, size_t i)
{
    return t->coefficients + i * t->stride;
}

size_t
qdot_taylor_stride(const qdot_taylor *t)
{
    return t->stride;
}

const double *
qdot_taylor_output(const qdot_taylor *t, size_t i)
{
    return t->output[i];
}

bool
qdot_taylor_is_constant(const qdot_taylor *t, size_t i)
{
    return t->constant[i];
}

double
qdot_taylor_convolutions(const qdot_taylor *t)
{
    return t->convolutions;
}

size_t
qdot_taylor_length(const qdot_taylor *t)
{
    return t->length - t->still;
}
