/* constrained.c -- evaluates tapes into saddle-point systems, one for each level of
 * differentiation. */
#include "sim/model/constrained.h"

#include <math.h>
#include <string.h>

#include "sim/model/constrained-parts.h"
#include "tape/derivative.h"
#include "tape/shake.h"

typedef qdot_constrained_level level;

void
qdot_constrained_free(qdot_constrained *h)
{
    if (!h)
        return;
    for (int l = 0; l < 3; l++) {
        qdot_saddle_clear(&h->levels[l].saddle);
        qdot_free(h->levels[l].row);
        qdot_free(h->levels[l].residual);
        qdot_free(h->levels[l].move.W);
    }
    qdot_tape_free(h->positions);
    qdot_tape_free(h->velocities);
    qdot_tape_free(h->metric);
    qdot_tape_free(h->equations);
    qdot_free(h->in);
    qdot_free(h->out);
    qdot_free(h->work);
    qdot_free(h->f);
    qdot_free(h->w);
    qdot_free(h->f_bound);
    qdot_free(h->w_bound);
    qdot_free(h->a);
    qdot_free(h->weight);
    qdot_free(h->slopes);
    qdot_free(h->gains);
    qdot_free(h->slopes_work);
    qdot_free(h->used);
    qdot_free(h);
}

/* --- evaluating the equations ------------------------------------------------------- */

void
qdot_constrained_load(qdot_constrained *h, double t, const double *y)
{
    memcpy(h->in, y, 2 * h->plan->n * sizeof *y);
    h->in[2 * h->plan->n] = t;
}

/* Find the residuals of the position constraints at the loaded state; other constraints get 0. */
void
qdot_constrained_positions(qdot_constrained *h)
{
    const qdot_constraints *c = h->c;
    const double *out = h->out;

    qdot_tape_eval(qdot_constrained_tape(h->positions, c->positions), h->in, h->out, h->work);
    for (size_t k = 0; k < c->m; k++)
        h->f[k] = c->rows[k].kind == QDOT_HOLONOMIC ? *out++ : 0;
}

void
qdot_constrained_velocities(qdot_constrained *h)
{
    const qdot_constraints *c = h->c;
    const double *out = h->out;

    qdot_tape_eval(qdot_constrained_tape(h->velocities, c->velocities), h->in, h->out, h->work);
    for (size_t k = 0; k < c->m; k++)
        h->w[k] = c->rows[k].kind != QDOT_ACCELERATION ? *out++ : 0;
}

void
qdot_constrained_residuals(qdot_constrained *h)
{
    qdot_constrained_positions(h);
    qdot_constrained_velocities(h);
}

/* Copy the matrices M and A of a level from the tape's outputs. Returns the address of the next output. */
static const double *
copy_matrices(qdot_constrained *h, level *l, const double *from)
{
    const qdot_constraints *c = h->c;
    const size_t n = h->plan->n;
    size_t at = 0;

    for (size_t k = 0; k < c->n_masses; k++) {
        size_t i = c->masses[k].row, j = c->masses[k].column;

        l->saddle.M[i * n + j] = l->saddle.M[j * n + i] = *from++;
    }
    for (size_t s = 0; s < c->n_slopes; s++, from++) {
        while (at < l->m && l->row[at] < c->slopes[s].row)
            at++;
        if (at < l->m && l->row[at] == c->slopes[s].row)
            l->saddle.A[at * n + c->slopes[s].column] = *from;
    }
    return from;
}

void
qdot_constrained_metric(qdot_constrained *h, qdot_constrained_level *l)
{
    qdot_tape_eval(qdot_constrained_tape(h->metric, h->c->metric), h->in, h->out, h->work);
    copy_matrices(h, l, h->out);
}

qdot_status
qdot_constrained_look_beside(const qdot_plan *plan, qdot_saddle *s, const size_t *row,
                             const double *in)
{
    static const double beside = 1e-3;
    const qdot_constraints *c = plan->constraints;
    const size_t inputs = 2 * plan->n + 1, outputs = qdot_tape_outputs(c->metric);
    double *room = qdot_calloc(inputs + outputs + qdot_tape_work(c->metric) + 1, sizeof *room);
    double *out = room + inputs;
    uint64_t seed = 12345;

    if (!room)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < inputs; i++) {
        seed = seed * 1103515245 + 12345;
        room[i] = in[i] * (1 + beside * (1 + (double)(seed >> 16 & 0x7fff) / 0x8000));
    }
    qdot_tape_eval(c->metric, room, out, out + outputs);
    for (size_t k = 0, at = 0; k < c->n_slopes; k++) {
        const double slope = out[c->n_masses + k];

        while (at < s->m && (row ? row[at] : at) < c->slopes[k].row)
            at++;
        if (at < s->m && (row ? row[at] : at) == c->slopes[k].row && isfinite(slope))
            s->widest[at] += slope * slope;
    }
    qdot_free(room);
    return QDOT_OK;
}

qdot_status
qdot_constrained_look_first(const qdot_constrained *h, qdot_constrained_level *level)
{
    return level->m > 1 && level->saddle.rank == QDOT_SADDLE_UNKNOWN
               ? qdot_constrained_look_beside(h->plan, &level->saddle, level->row, h->in)
               : QDOT_OK;
}

static qdot_status
fail_dependent_constraint(const qdot_constraints *c, qdot_saddle *s, const size_t *row)
{
    /* a constraint is dependent if less than this fraction of its gradient is independent of the others */
    static const double lost = 1e-9;
    bool *rows = qdot_calloc(c->m, sizeof *rows);
    qdot_status status = rows ? QDOT_ESINGULAR : QDOT_ENOMEM;

    if (rows && qdot_constrained_dependent(c, s, row, lost, rows))
        status = qdot_constrained_fail_dependent(c, rows);
    qdot_free(rows);
    return status;
}

/* Fail if a constraint's gradient in use has shrunk to its rounding error; redundant ones may. */
static qdot_status
check_vanishing_gradients(const qdot_constraints *c, const qdot_saddle *s, const size_t *row)
{
    for (size_t j = 0; j < s->rank; j++)
        if (qdot_saddle_has_faded(s, s->pivot[j]))
            return qdot_constrained_without_direction(c, row ? row[s->pivot[j]] : s->pivot[j]);
    return QDOT_OK;
}

qdot_status
qdot_constrained_factor_rows(const qdot_plan *p, qdot_saddle *s, const size_t *row)
{
    const size_t faded = qdot_saddle_faded(s);
    size_t failed = 0;
    qdot_status status;

    if (faded < s->m && s->rank == s->m)
        return qdot_constrained_without_direction(p->constraints, row ? row[faded] : faded);
    status = qdot_saddle_factor(s, &failed);
    if (status == QDOT_OK && faded < s->m)
        return check_vanishing_gradients(p->constraints, s, row);
    if (status != QDOT_ESINGULAR)
        return status;
    if (failed >= p->n)
        return fail_dependent_constraint(p->constraints, s, row);
    return qdot_fail(status, "the mass matrix is singular: no mass moves with %s",
                     p->names[failed]);
}

qdot_status
qdot_constrained_factor(const qdot_plan *plan, qdot_saddle *s)
{
    return qdot_constrained_factor_rows(plan, s, NULL);
}

void
qdot_constrained_damp(const qdot_constrained *h, double *gamma)
{
    const double a = QDOT_CONSTRAINED_RATE;

    for (size_t k = 0; k < h->c->m; k++)
        gamma[k] -= h->c->rows[k].kind == QDOT_HOLONOMIC
                        ? 2 * a * h->w[k] + a * a * h->f[k]
                        : a * h->w[k];
}

/* Whether the loaded state is far off the constraints, as a method may try with a long step: the sizes
 * of their slopes there are none that the motion meets. Writes h->out. */
static bool
is_off_constraints(qdot_constrained *h, const level *l, const double *y)
{
    qdot_constrained_positions(h);
    for (size_t k = 0; k < l->m; k++)
        if (fabs(h->f[l->row[k]]) > 0.1 * qdot_saddle_row_size(&l->saddle, k, y, 0))
            return true;
    return false;
}

/* Evaluate the equations of motion at the loaded state y. Returns the constraints' right-hand sides gamma = A q''. */
static const double *
evaluate_equations(qdot_constrained *h, level *all, const double *y)
{
    const qdot_plan *p = h->plan;
    const double *gamma;

    qdot_tape_eval(qdot_constrained_tape(h->equations, p->tape), h->in, h->out, h->work);
    gamma = copy_matrices(h, all, h->out + p->n);
    all->saddle.aside = false;
    if (qdot_saddle_widens(&all->saddle)) {
        all->saddle.aside = is_off_constraints(h, all, y);
        qdot_tape_eval(qdot_constrained_tape(h->equations, p->tape), h->in, h->out, h->work);
    }
    return gamma;
}

/* Scale the rows so that the least-norm multipliers are those of the scene: c->scale times the rows'. */
static void
scale_multipliers(qdot_constrained *h)
{
    static const double most = 0x1p400;
    const size_t m = h->c->m;
    double *scale = h->weight + m;

    qdot_tape_eval(h->c->scale, h->in, scale, scale + m);
    for (size_t k = 0; k < m; k++)
        h->weight[k] = isnan(scale[k]) ? 1 : fmin(most, fmax(1 / most, 1 / fabs(scale[k])));
}

qdot_status
qdot_constrained_solve(qdot_constrained *h, double t, const double *y, double *a,
                       double *lambda)
{
    const qdot_plan *p = h->plan;
    const size_t n = p->n, m = h->c->m;
    level *all = h->at[QDOT_ACCELERATION];
    double *x = all->saddle.x;
    const double *gamma;

    qdot_constrained_load(h, t, y);
    if (p->treatment == QDOT_RUN_BAUMGARTE)
        qdot_constrained_residuals(h);
    gamma = evaluate_equations(h, all, y);
    memcpy(x, h->out, n * sizeof *x);
    memcpy(x + n, gamma, m * sizeof *x);
    if (p->treatment == QDOT_RUN_BAUMGARTE)
        qdot_constrained_damp(h, x + n);
    if (lambda && h->weight)
        scale_multipliers(h);
    QDOT_TRY(qdot_constrained_look_first(h, all));
    QDOT_TRY(qdot_constrained_factor_rows(p, &all->saddle, all->row));
    qdot_saddle_solve_refined(&all->saddle);
    for (size_t i = 0; i < n; i++) {
        a[i] = x[i];
        if (!isfinite(a[i]))
            return qdot_fail(QDOT_EDOMAIN, "the acceleration of %s is undefined",
                             p->names[i]);
    }
    for (size_t k = 0; lambda && k < m; k++)
        lambda[k] = -x[n + k];
    return QDOT_OK;
}

qdot_status
qdot_constrained_accelerate(qdot_constrained *h, double t, const double *y, double *a)
{
    const size_t n = h->plan->n;

    QDOT_TRY(qdot_constrained_solve(h, t, y, h->a, h->a + n));
    memcpy(a, h->a, (n + h->plan->m) * sizeof *a);
    return QDOT_OK;
}

/* The residual A q'' - gamma of constraint k; *size: its largest term. */
static double
acceleration_residual(const qdot_constrained *h, size_t k, double *size)
{
    const qdot_saddle *s = &h->at[QDOT_ACCELERATION]->saddle;
    const size_t n = h->plan->n;
    const double gamma = h->out[n + h->c->n_masses + h->c->n_slopes + k];
    double sum = -gamma;

    *size = fabs(gamma);
    for (size_t i = 0; i < n; i++) {
        sum += s->A[k * n + i] * h->a[i];
        *size = fmax(*size, fabs(s->A[k * n + i] * h->a[i]));
    }
    return sum;
}

/* How much a violation of the constraints (drift) changes q'', estimated from the terms that would damp it. */
static double
error_by_drift(qdot_constrained *h)
{
    const double a = QDOT_CONSTRAINED_RATE;
    double sum = 0;

    if (h->plan->treatment == QDOT_RUN_PROJECT)
        return 0;
    qdot_constrained_residuals(h);
    for (size_t k = 0; k < h->c->m; k++)
        sum += 2 * a * fabs(h->w[k]) + a * a * fabs(h->f[k]);
    return sum;
}

size_t
qdot_constrained_contradicting(qdot_constrained *h)
{
    const qdot_saddle *s = &h->at[QDOT_ACCELERATION]->saddle;
    const double drift = error_by_drift(h);

    for (size_t j = s->rank; j < s->m; j++) {
        double size;

        if (fabs(acceleration_residual(h, s->pivot[j], &size)) > 1e-6 * fmax(1, size) + drift)
            return s->pivot[j];
    }
    return SIZE_MAX;
}

qdot_status
qdot_constrained_check_repeated(qdot_constrained *h, qdot_status broken)
{
    const size_t k = qdot_constrained_contradicting(h);
    double size;

    return k == SIZE_MAX ? QDOT_OK
                         : qdot_fail(broken,
                                     "constraint %s contradicts the others: they leave it a "
                                     "second derivative of %.3g",
                                     h->c->rows[k].name, acceleration_residual(h, k, &size));
}

qdot_constrained_residual
qdot_constrained_measure(qdot_constrained *h, double t, const double *y)
{
    qdot_constrained_residual r = {.worst_position = SIZE_MAX,
                                   .worst_velocity = SIZE_MAX};

    qdot_constrained_load(h, t, y);
    qdot_constrained_residuals(h);
    for (size_t k = 0; k < h->c->m; k++) {
        if (h->c->rows[k].kind == QDOT_HOLONOMIC && !(fabs(h->f[k]) < r.position)) {
            r.position = fabs(h->f[k]);
            r.worst_position = k;
        }
        if (h->c->rows[k].kind != QDOT_ACCELERATION && !(fabs(h->w[k]) < r.velocity)) {
            r.velocity = fabs(h->w[k]);
            r.worst_velocity = k;
        }
    }
    return r;
}

qdot_status
qdot_constrained_rescale(const qdot_constrained *h, double t, const double *y, double *lambda)
{
    const qdot_tape *scale = h->c->scale;
    const size_t n = 2 * h->plan->n, m = h->plan->m;
    double *in;

    if (!scale)
        return QDOT_OK;
    in = qdot_calloc(n + 1 + m + qdot_tape_work(scale), sizeof *in);
    if (!in)
        return QDOT_ENOMEM;
    memcpy(in, y, n * sizeof *in);
    in[n] = t;
    qdot_tape_eval(scale, in, in + n + 1, in + n + 1 + m);
    for (size_t k = 0; k < m; k++)
        lambda[k] *= in[n + 1 + k];
    qdot_free(in);
    return QDOT_OK;
}

size_t
qdot_constrained_rows(const qdot_constrained *h)
{
    return h->c->m;
}

const qdot_constraints *
qdot_constrained_of(const qdot_constrained *h)
{
    return h->c;
}

size_t
qdot_constrained_rank(const qdot_constrained *h)
{
    return h->at[QDOT_ACCELERATION]->saddle.rank;
}

size_t
qdot_constrained_factored(const qdot_constrained *h)
{
    return h->levels[0].saddle.factored + h->levels[1].saddle.factored +
           h->levels[2].saddle.factored;
}

/* --- making the evaluator ----------------------------------------------------------- */

static qdot_status
find_matrix_pattern(const qdot_constraints *c, level *l)
{
    qdot_saddle_entry *slopes = qdot_calloc(c->n_slopes + 1, sizeof *slopes);
    size_t count = 0, at = 0;
    qdot_status status;

    if (!slopes)
        return QDOT_ENOMEM;
    for (size_t s = 0; s < c->n_slopes; s++) {
        while (at < l->m && l->row[at] < c->slopes[s].row)
            at++;
        if (at < l->m && l->row[at] == c->slopes[s].row)
            slopes[count++] = (qdot_saddle_entry){(uint32_t)at, c->slopes[s].column};
    }
    status = qdot_saddle_pattern(&l->saddle, c->n_masses, c->masses, count, slopes);
    qdot_free(slopes);
    return status;
}

static qdot_status
make_constraint_level(qdot_constrained *h, qdot_constraint_kind kind)
{
    const qdot_constraints *c = h->c;
    level *l = h->levels + kind;

    for (size_t k = 0; k < c->m; k++)
        l->m += c->rows[k].kind <= kind;
    h->at[kind] = l;
    if (kind > 0 && h->at[kind - 1]->m == l->m) {
        h->at[kind] = h->at[kind - 1];
        l->m = 0;
        return QDOT_OK;
    }
    l->row = qdot_calloc(l->m + 1, sizeof *l->row);
    l->residual = qdot_calloc(2 * l->m + 1, sizeof *l->residual);
    l->move = (qdot_least_move){.n = h->plan->n, .m = l->m};
    l->move.W = qdot_calloc(l->m * h->plan->n + 1, sizeof *l->move.W);
    if (!l->row || !l->residual || !l->move.W)
        return QDOT_ENOMEM;
    l->noise = l->residual + l->m;
    l->few = l->m <= QDOT_LEAST_MOVE_ROWS && c->n_masses == h->plan->n && !h->plan->indefinite;
    for (size_t k = 0; k < c->n_masses; k++)
        l->few = l->few && c->masses[k].row == c->masses[k].column;
    for (size_t k = 0, at = 0; k < c->m; k++)
        if (c->rows[k].kind <= kind)
            l->row[at++] = k;
    QDOT_TRY(qdot_saddle_init(&l->saddle, h->plan->n, l->m, h->plan->indefinite));
    return find_matrix_pattern(c, l);
}

static qdot_status
perturb_tapes(qdot_constrained *h)
{
    QDOT_TRY(qdot_tape_shake(h->c->positions, &h->positions));
    QDOT_TRY(qdot_tape_shake(h->c->velocities, &h->velocities));
    QDOT_TRY(qdot_tape_shake(h->c->metric, &h->metric));
    return qdot_tape_shake(h->plan->tape, &h->equations);
}

/* Allocate work space for a Jacobian; `outputs` is the largest number of outputs of a tape. */
static qdot_status
allocate_jacobian_work(qdot_constrained *h, size_t outputs)
{
    const qdot_tape *tapes[] = {h->plan->tape, h->c->positions, h->c->velocities};
    const size_t columns = 2 * h->plan->n + 1;
    size_t work = 0;

    for (size_t i = 0; i < sizeof tapes / sizeof *tapes; i++) {
        size_t w = qdot_derivative_work(tapes[i]);

        work = w > work ? w : work;
    }
    h->slopes = qdot_calloc(outputs * columns + 1, sizeof *h->slopes);
    h->gains = qdot_calloc((h->plan->n + h->c->m) * columns, sizeof *h->gains);
    h->slopes_work = qdot_calloc(work + 1, sizeof *h->slopes_work);
    h->used = qdot_calloc(h->c->m + 1, sizeof *h->used);
    return h->slopes && h->gains && h->slopes_work && h->used ? QDOT_OK : QDOT_ENOMEM;
}

static qdot_status
constrained_make(qdot_constrained *h, bool shaken)
{
    const qdot_tape *tapes[] = {h->c->positions, h->c->velocities, h->c->metric,
                                h->plan->tape};
    size_t out = 0, work = 0, m = h->c->m;

    for (size_t i = 0; i < sizeof tapes / sizeof *tapes; i++) {
        size_t o = qdot_tape_outputs(tapes[i]), w = qdot_tape_work(tapes[i]);

        out = o > out ? o : out;
        work = w > work ? w : work;
    }
    h->in = qdot_calloc(2 * (2 * h->plan->n + 1), sizeof *h->in);
    h->out = qdot_calloc(out + 1, sizeof *h->out);
    h->work = qdot_calloc(work + 1, sizeof *h->work);
    h->f = qdot_calloc(m + 1, sizeof *h->f);
    h->w = qdot_calloc(m + 1, sizeof *h->w);
    h->f_bound = qdot_calloc(m + 1, sizeof *h->f_bound);
    h->w_bound = qdot_calloc(m + 1, sizeof *h->w_bound);
    h->a = qdot_calloc(h->plan->n + m, sizeof *h->a);
    if (!h->in || !h->out || !h->work || !h->f || !h->w || !h->a || !h->f_bound ||
        !h->w_bound)
        return QDOT_ENOMEM;
    for (int kind = 0; kind < 3; kind++)
        QDOT_TRY(make_constraint_level(h, (qdot_constraint_kind)kind));
    if (h->c->scale) {
        h->weight = qdot_calloc(2 * m + qdot_tape_work(h->c->scale) + 1, sizeof *h->weight);
        if (!h->weight)
            return QDOT_ENOMEM;
        for (size_t k = 0; k < m; k++)
            h->weight[k] = 1;
        h->at[QDOT_ACCELERATION]->saddle.weight = h->weight;
    }
    if (qdot_plan_needs_jacobian(h->plan))
        QDOT_TRY(allocate_jacobian_work(h, out));
    return shaken ? perturb_tapes(h) : QDOT_OK;
}

qdot_status
qdot_constrained_new(const qdot_plan *plan, bool shaken, qdot_constrained **held)
{
    qdot_constrained *h = qdot_calloc(1, sizeof *h);
    qdot_status status;

    *held = NULL;
    if (!h)
        return QDOT_ENOMEM;
    h->plan = plan;
    h->c = plan->constraints;
    status = constrained_make(h, shaken);
    if (status != QDOT_OK) {
        qdot_constrained_free(h);
        return status;
    }
    *held = h;
    return QDOT_OK;
}
