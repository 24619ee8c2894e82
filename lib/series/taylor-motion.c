/* taylor-motion.c -- stages of a motion, and what follows when its unknowns are found. */
#include "series/taylor-motion.h"

#include "series/taylor-steps.h"

/* --- building ------------------------------------------------------------------------ */

/* Without the steps that write equations: products of K are summed apart. */
static qdot_status
make_explicit(qdot_taylor *t, int solved)
{
    const qdot_motion *m = t->motion;
    const size_t length = t->length - m->written;

    t->steps[length] = t->steps[t->length];
    t->length = length;
    QDOT_TRY(qdot_taylor_solve_motion(t, solved));
    for (size_t i = 0; i < m->unknowns.n; i++) {
        const qdot_motion_unknown *u = m->unknowns.at + i;
        const qdot_program_row of = u->value == QDOT_NO_ROW ? u->row : u->value;

        if (u->once != QDOT_NO_ROW)
            QDOT_TRY(qdot_taylor_link(t, u->once,
                                      u->twice == QDOT_NO_ROW ? SIZE_MAX : u->twice,
                                      qdot_taylor_place(t, of)));
    }
    return QDOT_OK;
}

qdot_status
qdot_taylor_of_motion(const qdot_motion *motion, bool shaken, int most, int solved,
                      qdot_taylor **taylor)
{
    const bool is_explicit = qdot_motion_is_explicit(motion);
    qdot_taylor *t = NULL;
    qdot_status status;

    *taylor = NULL;
    if (most < 0 || most + 1 > QDOT_SERIES_MOST)
        return qdot_fail(QDOT_EINVAL, "an order of %d is out of range", most);
    t = qdot_calloc(1, sizeof *t);
    if (!t)
        return QDOT_ENOMEM;
    t->motion = motion;
    status = qdot_taylor_settle(t, &motion->program, most + 1,
                                is_explicit ? motion->solved.n : 0,
                                is_explicit ? 0 : motion->program.length, shaken);
    if (status == QDOT_OK)
        status = is_explicit ? make_explicit(t, solved) : qdot_taylor_follow_motion(t);
    if (status != QDOT_OK) {
        qdot_taylor_free(t);
        return status;
    }
    *taylor = t;
    return QDOT_OK;
}

void
qdot_taylor_set_unit(qdot_taylor *t, double unit)
{
    t->unit = unit;
    for (size_t i = 0; i < t->length && t->motion->program.lead > 0; i++)
        if (t->steps[i].op == QDOT_T_RATE)
            t->steps[i].c = 1 / unit;
}

const double *
qdot_taylor_series(const qdot_taylor *t, qdot_program_row row)
{
    return qdot_taylor_place(t, row);
}

double *
qdot_taylor_matrices(const qdot_taylor *t, size_t block)
{
    return t->blocks[block].matrices;
}

/* --- stages -------------------------------------------------------------------------- */

/* No step reads what is solved for. */
static bool
is_explicit(const qdot_taylor *t)
{
    return !t->changes;
}

/* Order k of an integral is so much of order k - 1 of what it is of. */
static double
part(const qdot_taylor *t, int k)
{
    return t->unit / k;
}

static void
clear(const qdot_taylor *t, qdot_program_row row, int k)
{
    if (row != QDOT_NO_ROW)
        qdot_taylor_place(t, row)[k] = 0;
}

void
qdot_taylor_stage(qdot_taylor *t, int k)
{
    const qdot_motion *m = t->motion;

    if (is_explicit(t)) {
        qdot_taylor_order(t, k);
        return;
    }
    for (size_t i = 0; i < m->solved.n && k >= 0; i++) {
        const qdot_motion_unknown *u = m->unknowns.at + m->solved.at[i];

        clear(t, u->row, k);
        clear(t, u->once, k + 1);
        clear(t, u->twice, k + 2);
    }
    qdot_taylor_order_leading(t, k);
    for (size_t i = 0; i < m->unknowns.n && k >= 0; i++) {
        const qdot_motion_unknown *u = m->unknowns.at + i;
        double *once = qdot_taylor_place(t, u->once),
               *twice = qdot_taylor_place(t, u->twice);

        if (u->value == QDOT_NO_ROW || !once)
            continue;
        once[k + 1] = part(t, k + 1) * qdot_taylor_place(t, u->value)[k];
        if (twice)
            twice[k + 2] = part(t, k + 2) * once[k + 1];
    }
}

/* f_k less what M of orders above 0 takes of it. */
static void
right_hand_side(const qdot_taylor *t, const qdot_taylor_block *b, int k, double *to)
{
    qdot_series_dot *dot = k > 0 ? t->kernels->dot[k] : NULL;

    for (size_t i = 0; i < b->n; i++)
        to[i] = b->f[i][k];
    for (size_t c = 0; dot && c < b->n_couplings; c++) {
        const qdot_taylor_coupling *m = b->couplings + c;

        to[m->i] -= dot(m->M + 1, m->a + k - 1);
    }
}

void
qdot_taylor_missing(const qdot_taylor *t, int k, double *by)
{
    const qdot_motion *m = t->motion;

    for (size_t b = 0; b < t->n_blocks; b++) {
        right_hand_side(t, t->blocks + b, k, by);
        by += t->blocks[b].n;
    }
    for (size_t i = 0; !is_explicit(t) && i < m->solved.n; i++)
        by[i] = -qdot_taylor_place(t, m->equations.at[i])[k];
}

void
qdot_taylor_change(qdot_taylor *t, int k, const double *by)
{
    const qdot_motion *m = t->motion;

    if (is_explicit(t)) {
        for (size_t b = 0; b < t->n_blocks; b++)
            for (size_t i = 0; i < t->blocks[b].n; i++)
                t->blocks[b].a[i][k] = *by++;
        qdot_taylor_order_links(t, k);
        return;
    }
    for (size_t i = 0; i < m->solved.n; i++) {
        const qdot_motion_unknown *u = m->unknowns.at + m->solved.at[i];
        const double once = t->unit * by[i] / (k + 1), twice = t->unit * once / (k + 2);

        if (u->row != QDOT_NO_ROW)
            qdot_taylor_change_row(t, qdot_taylor_place(t, u->row), k, by[i]);
        if (u->once != QDOT_NO_ROW)
            qdot_taylor_change_row(t, qdot_taylor_place(t, u->once), k + 1, once);
        if (u->twice != QDOT_NO_ROW)
            qdot_taylor_change_row(t, qdot_taylor_place(t, u->twice), k + 2, twice);
    }
    qdot_taylor_follow(t, k);
}

qdot_lanes_rows
qdot_taylor_get_rows(const qdot_taylor *t)
{
    return (qdot_lanes_rows){&t->motion->program, t->coefficients, t->stride, 1};
}

void
qdot_taylor_set_inverses(const qdot_taylor *t)
{
    double *inverse = t->coefficients + t->rows * t->stride;

    for (size_t i = 0; i < t->length; i++)
        inverse[i] = t->steps[i].c;
}
