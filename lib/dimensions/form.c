/* form.c -- affine forms over the rationals: sums, and elimination one equation after another. */
#include "dimensions/form.h"

#include <string.h>

void
qdot_forms_clear(qdot_forms *f)
{
    for (size_t i = 0; i < f->all.n; i++)
        qdot_free(f->all.at[i]);
    qdot_free(f->all.at);
    qdot_free(f->row.at);
    *f = (qdot_forms){0};
}

qdot_status
qdot_forms_unknown(qdot_forms *f, uint32_t *unknown)
{
    *unknown = (uint32_t)f->row.n;
    return qdot_vec_push(&f->row, (const qdot_form *)NULL);
}

/* --- making forms ---------------------------------------------------------------------- */

/* A form like this one, with room for n terms. */
static qdot_form *
form_new(qdot_forms *f, size_t n, qdot_form like)
{
    qdot_form *form = qdot_calloc(1, sizeof *form + n * sizeof *form->at);

    if (form == NULL)
        return NULL;
    if (qdot_vec_push(&f->all, form) != QDOT_OK) {
        qdot_free(form);
        return NULL;
    }
    *form = like;
    return form;
}

const qdot_form *
qdot_form_constant(qdot_forms *f, qdot_dimension constant)
{
    return form_new(f, 0, (qdot_form){.constant = constant});
}

const qdot_form *
qdot_form_any(qdot_forms *f)
{
    return form_new(f, 0, (qdot_form){.constant = qdot_dimension_none(), .any = true});
}

const qdot_form *
qdot_form_none(qdot_forms *f)
{
    return form_new(f, 0, (qdot_form){.constant = qdot_dimension_none(), .none = true});
}

const qdot_form *
qdot_form_unknown(qdot_forms *f, uint32_t unknown)
{
    qdot_form *form = form_new(f, 1, (qdot_form){.constant = qdot_dimension_none(), .n = 1});

    if (form != NULL)
        form->at[0] = (qdot_form_term){unknown, {1, 1}};
    return form;
}

const qdot_form *
qdot_form_addmul(qdot_forms *f, const qdot_form *a, const qdot_form *b, qdot_exponent x)
{
    qdot_form *sum;
    uint32_t i = 0, k = 0;
    bool large;

    if (a == NULL || b == NULL || a->any || a->none)
        return a == NULL || b == NULL ? NULL : a;
    if (b->any || b->none || x.n == 0)
        return x.n == 0 ? a : b;
    sum = form_new(f, (size_t)a->n + b->n, (qdot_form){.constant = qdot_dimension_addmul(a->constant, b->constant, x)});
    if (sum == NULL)
        return NULL;
    large = qdot_dimension_failed(sum->constant);
    while (i < a->n || k < b->n) {
        const bool left = k == b->n || (i < a->n && a->at[i].unknown <= b->at[k].unknown);
        const bool right = i == a->n || (k < b->n && b->at[k].unknown <= a->at[i].unknown);
        qdot_form_term t = {left ? a->at[i].unknown : b->at[k].unknown, left ? a->at[i].x : (qdot_exponent){0, 1}};

        if (right)
            t.x = qdot_exponent_addmul(t.x, b->at[k].x, x);
        large = large || t.x.d == 0;
        if (t.x.n != 0)
            sum->at[sum->n++] = t;
        i += left;
        k += right;
    }
    if (large) {
        (void)qdot_fail(QDOT_ELIMIT, "the exponents of dimensions grow too large");
        return NULL;
    }
    return sum;
}

/* --- elimination ----------------------------------------------------------------------- */

const qdot_form *
qdot_form_reduce(qdot_forms *f, const qdot_form *a)
{
    bool again = true;

    while (again && a != NULL) {
        again = false;
        for (uint32_t i = 0; i < a->n && !again; i++) {
            const uint32_t unknown = a->at[i].unknown;
            const qdot_exponent x = a->at[i].x;
            const qdot_form *row = f->row.at[unknown], *self;

            if (row == NULL)
                continue;
            self = qdot_form_unknown(f, unknown);
            a = qdot_form_addmul(f, a, self, (qdot_exponent){-x.n, x.d});
            a = qdot_form_addmul(f, a, row, x);
            again = true;
        }
    }
    return a;
}

qdot_status
qdot_forms_join(qdot_forms *f, const qdot_form *a, const qdot_form *b, bool *agree)
{
    const qdot_exponent minus = {-1, 1};
    const qdot_form *difference, *self;
    qdot_form_term pivot;

    *agree = true;
    if (a == NULL || b == NULL)
        return qdot_last_error()->status == QDOT_ELIMIT ? QDOT_ELIMIT : QDOT_ENOMEM;
    if (a->any || b->any || a->none || b->none || a == b)
        return QDOT_OK;
    difference = qdot_form_reduce(f, qdot_form_addmul(f, a, b, minus));
    if (difference == NULL)
        return QDOT_ENOMEM;
    if (difference->n == 0) {
        *agree = qdot_dimension_is_none(difference->constant);
        return QDOT_OK;
    }
    /* the unknown that came last: 0 = x*u + rest gives u = -rest/x */
    pivot = difference->at[difference->n - 1];
    self = qdot_form_unknown(f, pivot.unknown);
    difference = qdot_form_addmul(f, difference, self, (qdot_exponent){-pivot.x.n, pivot.x.d});
    difference = qdot_form_addmul(f, qdot_form_constant(f, qdot_dimension_none()), difference,
                                  qdot_exponent_make(pivot.x.n > 0 ? -(int64_t)pivot.x.d : (int64_t)pivot.x.d,
                                                     pivot.x.n > 0 ? pivot.x.n : -(int64_t)pivot.x.n));
    if (difference == NULL)
        return QDOT_ENOMEM;
    f->row.at[pivot.unknown] = difference;
    f->rank++;
    return QDOT_OK;
}
