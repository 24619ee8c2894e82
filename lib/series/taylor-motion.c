/* taylor-motion.c -- expands the solution of a motion stage by stage; updates rows when its unknowns are found. */
#include "series/taylor-motion.h"

#include "series/taylor-products.h"
#include "series/taylor-steps.h"

/* --- building the program ------------------------------------------------------------ */

/* Remove the steps that compute the explicit equations E; products with the matrix K are then summed separately. */
static qdot_status
remove_steps_of_equations(qdot_taylor *t, int most, int solved)
{
    const size_t length = t->length - t->motion->written;

    t->steps[length] = t->steps[t->length];
    t->length = length;
    QDOT_TRY(qdot_taylor_solve_motion(t, solved));
    t->negated = qdot_calloc(t->rows + 1, sizeof *t->negated);
    if (!t->negated)
        return QDOT_ENOMEM;
    for (const qdot_taylor_step *s = t->steps; s->op != QDOT_T_END; s++)
        if (s->op == QDOT_T_NEG)
            t->negated[qdot_taylor_row(t, s->to)] = s->x;
    return qdot_taylor_products_new(t, most + 1, &t->products);
}

/* Let integrals of unknowns be computed as links, if no step reads the newest coefficients of unknowns. */
static qdot_status
make_integrals_links(qdot_taylor *t)
{
    const qdot_motion *m = t->motion;

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
    const bool apart = motion->right.n > 0;
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
                                apart ? motion->solved.n : 0,
                                is_explicit ? 0 : motion->program.length, shaken);
    if (status == QDOT_OK && apart)
        status = remove_steps_of_equations(t, most, solved);
    if (status == QDOT_OK)
        status = qdot_taylor_find_unknowns(t, is_explicit);
    if (status == QDOT_OK && apart && !is_explicit)
        status = qdot_taylor_shorten(t);
    if (status == QDOT_OK)
        status = is_explicit ? make_integrals_links(t) : qdot_taylor_follow_motion(t);
    if (status == QDOT_OK && !is_explicit)
        status = qdot_taylor_find_newest(t);
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

const double *
qdot_taylor_entry(const qdot_taylor *t, qdot_program_row row, double *sign)
{
    const double *positive = t->negated ? t->negated[row] : NULL;

    *sign = positive ? -1 : 1;
    return positive ? positive : qdot_taylor_place(t, row);
}

double *
qdot_taylor_matrices(const qdot_taylor *t, size_t block)
{
    return t->blocks[block].matrices;
}

/* --- stages of a motion -------------------------------------------------------------- */

/* Whether no step reads the newest coefficients of unknowns. */
static bool
is_explicit(const qdot_taylor *t)
{
    return !t->changes;
}

/* The factor from order k - 1 of an integrand to order k of its integral. */
static double
factor_of_integration(const qdot_taylor *t, int k)
{
    return t->unit / k;
}

/* Integrate unknowns that are given by rows of the program, once coefficient k of these is known. */
static void
integrate_given_unknowns(const qdot_taylor *t, int k)
{
    const qdot_motion *m = t->motion;

    for (size_t i = 0; i < m->unknowns.n; i++) {
        const qdot_motion_unknown *u = m->unknowns.at + i;
        double *once = qdot_taylor_place(t, u->once),
               *twice = qdot_taylor_place(t, u->twice);

        if (u->value == QDOT_NO_ROW || !once)
            continue;
        once[k + 1] = factor_of_integration(t, k + 1) * qdot_taylor_place(t, u->value)[k];
        if (twice)
            twice[k + 2] = factor_of_integration(t, k + 2) * once[k + 1];
    }
}

void
qdot_taylor_stage(qdot_taylor *t, int k)
{
    const qdot_motion *m = t->motion;

    if (is_explicit(t)) {
        qdot_taylor_order(t, k);
        return;
    }
    for (size_t i = 0; i < t->n_newest && k >= 0; i++)
        t->newest[i].row[k + t->newest[i].lead] = 0;
    qdot_taylor_order_leading(t, k);
    if (k >= 0 && m->unknowns.n > m->solved.n)
        integrate_given_unknowns(t, k);
}

void
qdot_taylor_missing(qdot_taylor *t, int k, double *by)
{
    const size_t n = t->motion->solved.n;

    const double rate = (k + 1) / t->unit, rates[] = {1, rate, rate * ((k + 2) / t->unit)};

    for (size_t i = 0; i < n; i++) {
        const struct qdot_taylor_unknown *u = t->unknowns + i;

        by[i] = u->is_explicit ? u->right[k] : -rates[u->rates] * u->right[k + u->rates];
    }
    if (t->products)
        qdot_taylor_products_take_off(t->products, t->kernels, k, by);
}

void
qdot_taylor_change(qdot_taylor *t, int k, const double *by)
{
    const size_t n = t->motion->solved.n;

    for (size_t i = 0; i < n; i++) {
        const struct qdot_taylor_unknown *u = t->unknowns + i;
        const double once = t->unit * by[i] / (k + 1);

        if (u->row)
            u->row[k] = by[i];
        if (u->once)
            u->once[k + 1] = once;
        if (u->twice)
            u->twice[k + 2] = t->unit * once / (k + 2);
    }
    if (t->products)
        qdot_taylor_products_note(t->products, k);
    if (is_explicit(t)) {
        qdot_taylor_order_links(t, k);
        return;
    }
    for (size_t i = 0; i < t->n_newest; i++)
        *t->newest[i].change = t->newest[i].row[k + t->newest[i].lead];
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
