/* range.c -- the extrema, the mean and the drift of an expression over a range of runs.
 *
 * The range is gone over step by step (range-step.c), for the runs and again with the companions
 * of each in its place.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "expr/function.h"
#include "expr/node.h"
#include "num/past.h"
#include "ode/companion.h"
#include "ode/scale.h"
#include "sim/course/run-time.h"
#include "sim/error/companion.h"
#include "sim/error/horizon.h"
#include "sim/error/noise.h"
#include "sim/read/in-chart.h"
#include "sim/read/joint.h"
#include "sim/read/passage.h"
#include "sim/read/range-parts.h"
#include "sim/read/stretches.h"
#include "tape/knots.h"

/* The scan of a step, for extrema or a mean, is given up after this many intervals. */
enum { MOST_PARTS = 8192 };

typedef qdot_range_scan scan;

/* The arguments of qdot_run_range_along: an extremum or mean over a time range. */
typedef struct {
    const qdot_run_expression *x;
    qdot_range_kind kind;
    double from, to; /* start and end of the time range, in the direction of the runs */
    qdot_joint joint;
} question;

/* --- the extremum or mean along given courses ----------------------------------------- */

/* Include the value at a single time t: an end of the time range, or a range without length. */
static qdot_status
include_value_at(scan *s, double t)
{
    double x;

    QDOT_TRY(qdot_range_at(s, t, &x));
    qdot_range_meet(s, x);
    if (!s->begun)
        s->first = x;
    s->begun = true;
    return QDOT_OK;
}

/* From the time a on, up to b: where the first delayed value, x(t - tau), begins to be read from another step of the
 * run; b if none does before. */
static double
end_of_part(const qdot_knots *lines, double a, double b)
{
    static const double no_length = 1e-12;
    const double least = no_length * (fabs(a) + fabs(b));
    double end = b;

    for (size_t k = 0; k < lines->n; k++)
        if (qdot_past_has(lines->at[k].handle) && lines->at[k].b == 1) {
            const double until = qdot_past_piece_end(lines->at[k].handle, a + lines->at[k].a + least) - lines->at[k].a;

            end = until < end - least ? until : end;
        }
    return end;
}

static qdot_status
scan_stretch(scan *s, const qdot_stretches *steps, const qdot_knots *lines)
{
    for (double a = steps->a, b; a != steps->b; a = b) {
        qdot_reader_recall(&s->reader);
        b = end_of_part(lines, a, steps->b);
        s->odd[0] = a == steps->a && steps->odd[0];
        s->odd[1] = b == steps->b && steps->odd[1];
        QDOT_TRY(qdot_range_step(s, a, b));
    }
    return QDOT_OK;
}

static qdot_status
scan_runs(scan *s, const question *q, const qdot_course *const *courses)
{
    const qdot_reading *of = &q->joint.of;
    qdot_stretches steps;
    qdot_knots lines = {0};
    qdot_status status =
        qdot_stretches_init(&steps, q->x->n, courses, q->from, q->to);

    if (status == QDOT_OK && s->reader.past)
        status = qdot_knots_find(of->tape, 2 * of->plan->n, &lines);

    s->nodes = 16;
    s->largest = -INFINITY;
    s->smallest = INFINITY;
    s->highest = s->sure[0] = -INFINITY;
    s->lowest = s->sure[1] = INFINITY;
    s->pieces = steps.pieces;
    while (status == QDOT_OK && qdot_stretches_next(&steps))
        status = q->from == q->to ? include_value_at(s, q->from) : scan_stretch(s, &steps, &lines);
    s->pieces = NULL;
    qdot_free(lines.at);
    qdot_stretches_clear(&steps);
    return status;
}

static double
extremum_or_mean(const scan *s, qdot_range_kind kind, double from, double to)
{
    switch (kind) {
    case QDOT_RANGE_MAX: return s->largest;
    case QDOT_RANGE_MIN: return s->smallest;
    case QDOT_RANGE_MEAN:
        return from == to ? s->first : (double)(s->integral / (to - from));
    case QDOT_RANGE_REACH: return fmax(s->largest, -s->smallest);
    default:
        return fmax(s->largest - s->first, s->first - s->smallest)
               / fmax(1, fabs(s->first));
    }
}

/* The open part of a result: limits may lie beyond the values found, rough parts may not reach
 * theirs. */
static double
uncertainty_of_unevaluated(const scan *s, qdot_range_kind kind, double from, double to)
{
    double above = fmax(0, s->highest - s->largest) + (s->largest - s->sure[0]);
    double below = fmax(0, s->smallest - s->lowest) + (s->sure[1] - s->smallest);

    if (s->open)
        return NAN;
    switch (kind) {
    case QDOT_RANGE_MAX: return above;
    case QDOT_RANGE_MIN: return below;
    case QDOT_RANGE_MEAN: return from == to ? 0 : s->left / fabs(to - from);
    case QDOT_RANGE_REACH: return fmax(above, below);
    default: return fmax(above, below) / fmax(1, fabs(s->first));
    }
}

static qdot_status
check_bounded(const scan *s, qdot_range_kind kind)
{
    if (kind == QDOT_RANGE_MEAN ? !s->diverges
        : kind == QDOT_RANGE_MAX ? !s->above
        : kind == QDOT_RANGE_MIN ? !s->below
                                 : !s->above && !s->below)
        return QDOT_OK;
    return qdot_fail(QDOT_EDOMAIN,
                     kind == QDOT_RANGE_MEAN  ? "it has no mean: its integral diverges at t = %.9g"
                     : kind == QDOT_RANGE_MIN ? "it has no bound: it falls without bound towards t = %.9g"
                                              : "it has no bound: it grows without bound towards t = %.9g",
                     s->pole);
}

/* Find, for each input, the size below which its changes are ignored, as no force can hide in them. */
static qdot_status
find_negligible_changes(scan *s)
{
    const qdot_reader *r = &s->reader;

    s->least = qdot_calloc(qdot_tape_inputs(r->of.tape), sizeof *s->least);
    if (!s->least)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < r->n_courses; k++) {
        const qdot_course *c = r->courses[k].course;
        const double rough = 0x1p53 * qdot_range_roughness(&c->tr);

        for (size_t i = 0; i < 2 * r->courses[k].n; i++)
            s->least[r->courses[k].in - r->in + (ptrdiff_t)i] =
                rough * qdot_ode_scale(c->stage->scales, i);
    }
    return QDOT_OK;
}

static qdot_status
evaluate_over_runs(const question *q, const qdot_course *const *courses, double *value, double *rough)
{
    const qdot_reading *of = &q->joint.of;
    scan s = {.kind = q->kind, .most_parts = MOST_PARTS};
    qdot_status status = qdot_reader_init_along(&s.reader, of, courses);

    if (status == QDOT_OK)
        status = qdot_polynomial_bounds_init(&s.bounds, of->tape, 2 * of->plan->n);
    if (status == QDOT_OK)
        status = find_negligible_changes(&s);
    if (status == QDOT_OK)
        status = scan_runs(&s, q, courses);
    if (status == QDOT_OK && !s.begun)
        status = qdot_fail(QDOT_EDOMAIN, "the range contains no part of the run");
    if (status == QDOT_OK)
        status = check_bounded(&s, q->kind);
    if (status == QDOT_OK) {
        *value = extremum_or_mean(&s, q->kind, q->from, q->to);
        *rough = s.rough + uncertainty_of_unevaluated(&s, q->kind, q->from, q->to);
    }
    qdot_free(s.least);
    qdot_polynomial_bounds_clear(&s.bounds);
    qdot_reader_clear(&s.reader);
    return status;
}

/* --- error of the result -------------------------------------------------------------- */

/* Find the rounding error of the expression e, evaluated at the ends of the time range. */
static qdot_status
find_rounding_at_ends(const question *q, double *error)
{
    const qdot_course *const *own = q->joint.courses;
    double ends[] = {q->from, q->to}, values[2], errors[2];
    const bool drift = q->kind == QDOT_RANGE_DRIFT;
    qdot_reader r;
    qdot_status status = qdot_reader_init_along(&r, &q->joint.of, own);

    for (int k = 0; k < 2 && status == QDOT_OK; k++) {
        status = qdot_reader_read(&r, NULL, ends[k], values + k);
        if (status == QDOT_OK && !isfinite(values[k]))
            status = QDOT_EDOMAIN;
    }
    qdot_reader_clear(&r);
    QDOT_TRY(status);
    QDOT_TRY(qdot_noise_roundings(&q->joint.of, own, 2, ends, errors));
    *error = (drift ? 2 : 1) * fmax(errors[0], errors[1])
             / (drift ? fmax(1, fabs(values[0])) : 1);
    return QDOT_OK;
}

/* What the error of run k makes of x, the value of the runs: the values with its companions in
 * its place are that far from x. */
static qdot_status
compare_with_companions(const question *q, size_t k, double x, double *error)
{
    qdot_run *run = q->x->runs[k];
    const qdot_course *companions[] = {&run->companion, &run->twin};
    const size_t count = run->has_twin ? 2 : 1;
    const double last = qdot_trajectory_is_backward(&run->course.tr) ? fmin(q->from, q->to) : fmax(q->from, q->to);
    double theirs[2], rough, spread = 0;

    if (!qdot_run_covered(run, last))
        return qdot_fail(QDOT_EDOMAIN, "a second run does not get so far");
    for (size_t i = 0; i < count; i++) {
        qdot_status status;

        q->joint.courses[k] = companions[i];
        status = evaluate_over_runs(q, q->joint.courses, &theirs[i], &rough);
        q->joint.courses[k] = &run->course;
        QDOT_TRY(status);
    }
    if (qdot_horizon_passed(run, last))
        QDOT_TRY(qdot_horizon_spread(run, &q->joint.of, q->joint.courses, k, &spread));
    *error = fmax(qdot_companion_bound_of(x, count, theirs), spread);
    return QDOT_OK;
}

/* The error of x: its distance from the companions of all runs, and its own error `rough`. It stays NaN if a run
 * has no companion. */
static qdot_status
find_error_of_result(const question *q, double x, double rough, double *error)
{
    double sum = 0, one = NAN, rounded;

    for (size_t k = 0; k < q->x->n; k++)
        if (!qdot_run_comparable(q->x->runs[k]))
            return QDOT_OK;
    for (size_t k = 0; k < q->x->n; k++) {
        QDOT_TRY(compare_with_companions(q, k, x, &one));
        sum += one;
    }
    QDOT_TRY(find_rounding_at_ends(q, &rounded));
    *error = rounded + (sum + rough + DBL_EPSILON * fabs(x));
    return QDOT_OK;
}

/* --- answering the question ----------------------------------------------------------- */

/* The range in the direction of the runs, or forward where they go both ways; given [2], NULL: all
 * that they have in common. */
static qdot_status
find_time_limits(const qdot_run_expression *x, const double *given, double *from, double *to)
{
    const qdot_trajectory *first = &x->runs[0]->course.tr;
    double low = -INFINITY, high = INFINITY, ends[2];
    bool backward = true;

    for (size_t k = 0; k < x->n; k++) {
        const qdot_trajectory *tr = &x->runs[k]->course.tr;

        qdot_trajectory_narrow(tr, &low, &high);
        backward = backward && qdot_trajectory_is_backward(tr);
    }
    if (low > high)
        return qdot_fail(QDOT_EDOMAIN, "the runs have no time in common");
    ends[0] = given != NULL ? fmin(given[0], given[1]) : low;
    ends[1] = given != NULL ? fmax(given[0], given[1]) : high;
    *from = ends[backward];
    *to = ends[!backward];
    if (low <= ends[0] && ends[1] <= high && (given == NULL || !isnan(given[0] + given[1])))
        return QDOT_OK;
    if (x->n == 1)
        return qdot_fail(QDOT_EDOMAIN,
                         "the range %.15g..%.15g is outside the run, which covers %.15g to "
                         "%.15g",
                         given[0], given[1], first->t[0], first->t[first->count - 1]);
    return qdot_fail(QDOT_EDOMAIN,
                     "the range %.15g..%.15g is outside the runs, which all cover %.15g to "
                     "%.15g",
                     ends[0], ends[1], low, high);
}

static qdot_status
evaluate_range(const qdot_run_expression *x, qdot_range_kind kind, const double *range,
                     double *value, double *error)
{
    question q = {.x = x, .kind = kind};
    double rough;
    qdot_status status;

    *error = NAN;
    QDOT_TRY(find_time_limits(x, range, &q.from, &q.to));
    status = qdot_joint_init(&q.joint, x);
    if (status == QDOT_OK)
        status = evaluate_over_runs(&q, q.joint.courses, value, &rough);
    for (size_t k = 0; k < x->n && status == QDOT_OK; k++)
        status = qdot_run_twin(x->runs[k]);
    if (status == QDOT_OK) {
        status = find_error_of_result(&q, *value, rough, error);
        if (qdot_reader_has_nothing(status))
            status = QDOT_OK;
    }
    qdot_joint_clear(&q.joint);
    return status;
}

/* Of expressions in the coordinates of the runs. The largest |u| is the reach of u: |u| has corners
 * where u is 0, and if u is all rounding it has nothing else. */
static qdot_status
evaluate_range_along(const qdot_run_expression *x, qdot_range_kind kind, const double *range, double *value,
                     double *error)
{
    const qdot_pool *pool = x->runs[0]->plan->pool;
    qdot_run_expression inner = *x;

    if (kind != QDOT_RANGE_MAX || qdot_expr_kind(pool, x->e) != QDOT_FUN
        || qdot_expr_node(pool, x->e)->op != QDOT_ABS)
        return evaluate_range(x, kind, range, value, error);
    inner.e = qdot_expr_arg(pool, x->e, 0);
    return evaluate_range(&inner, QDOT_RANGE_REACH, range, value, error);
}

/* If run k was made in other coordinates: the expression along it, written in those for the
 * stretch of time t. */
static qdot_status
express_in_run_coordinates(const qdot_run_expression *x, size_t k, double t, qdot_in_chart *in, qdot_expr *e,
                           qdot_run_member *members)
{
    qdot_run *run = x->runs[k];
    qdot_expr *given = qdot_calloc(x->m + 1, sizeof *given);
    qdot_status status = given ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < x->m && given; i++)
        given[i] = x->members[i].run == k ? x->members[i].value : QDOT_ZERO;
    if (given)
        given[x->m] = k == 0 ? *e : QDOT_ZERO;
    if (status == QDOT_OK)
        status = qdot_in_chart_express(in, run, x->m + 1, given, t);
    for (size_t i = 0; i < x->m && status == QDOT_OK; i++)
        if (x->members[i].run == k)
            members[i].value = in->exprs[i];
    if (status == QDOT_OK && k == 0)
        *e = in->exprs[x->m];
    qdot_free(given);
    return status;
}

/* The result over the earlier intervals, to be combined with that over one more interval. */
typedef struct {
    double length, sum, most, least, first, error, sum_error;
    bool begun;
} gathered;

static void
include_extrema(gathered *g, double most, double least, double error)
{
    g->most = g->begun ? fmax(g->most, most) : most;
    g->least = g->begun ? fmin(g->least, least) : least;
    g->error = isnan(g->error) || isnan(error) ? NAN : fmax(g->error, error);
    g->begun = true;
}

/* The extrema next to places at the ends of range [2], which is narrowed to what is left. Not of
 * several runs. */
static qdot_status
include_singular_places(const qdot_run_expression *given, double *range, gathered *g)
{
    qdot_run *run = given->runs[0];
    const double whole[] = {range[0], range[1]};

    if (given->n != 1 || !run->chart)
        return QDOT_OK;
    for (int end = 0; end < 2; end++) {
        const size_t k = qdot_passage_at(run, whole[end]);
        qdot_passage p;
        bool found;

        if (k == SIZE_MAX || whole[0] == whole[1])
            continue;
        QDOT_TRY(qdot_passage_extrema(run, given->e, k, end == 1, whole[!end], &p, &found));
        if (!found)
            continue;
        include_extrema(g, p.most, p.least, p.error);
        range[end] = p.beyond;
    }
    return QDOT_OK;
}

static qdot_status
evaluate_and_combine(const qdot_run_expression *x, const qdot_run_expression *given, qdot_range_kind kind,
                     double *range, gathered *g)
{
    double value, error, most = NAN;

    if (kind == QDOT_RANGE_MEAN) {
        const double length = range[0] == range[1] ? 1 : fabs(range[1] - range[0]);

        QDOT_TRY(evaluate_range_along(x, kind, range, &value, &error));
        g->sum += length * value;
        g->sum_error += length * error;
        g->length += length;
        return QDOT_OK;
    }
    if (!g->begun)
        QDOT_TRY(evaluate_range_along(x, QDOT_RANGE_MEAN, (double[]){range[0], range[0]}, &g->first,
                                      &error));
    QDOT_TRY(include_singular_places(given, range, g));
    for (int way = 0; way < 2; way++) {
        QDOT_TRY(evaluate_range_along(x, way ? QDOT_RANGE_MIN : QDOT_RANGE_MAX, range, &value, &error));
        most = way ? most : value;
        include_extrema(g, most, way ? value : most, error);
    }
    return QDOT_OK;
}

static void
result_of_gathered(const gathered *g, qdot_range_kind kind, double *value, double *error)
{
    const double size = fmax(1, fabs(g->first));

    *error = g->error;
    switch (kind) {
    case QDOT_RANGE_MAX: *value = g->most; break;
    case QDOT_RANGE_MIN: *value = g->least; break;
    case QDOT_RANGE_MEAN:
        *value = g->sum / g->length;
        *error = g->sum_error / g->length;
        break;
    default:
        *value = fmax(g->most - g->first, g->first - g->least) / size;
        *error = 2 * g->error / size;
    }
}

/* Of runs of which some were made in other coordinates. Where an angle stands by itself the range
 * is gone over stretch by stretch. */
static qdot_status
evaluate_in_chart(const qdot_run_expression *x, qdot_range_kind kind, const double *range,
                  double *value, double *error)
{
    qdot_run_member *members = qdot_calloc(x->m + 1, sizeof *members);
    qdot_run_expression own = *x;
    gathered g = {0};
    double from, to;
    qdot_status status = members ? find_time_limits(x, range, &from, &to) : QDOT_ENOMEM;

    own.members = members;
    for (bool more = true; more && status == QDOT_OK;) {
        double end = to;

        own.e = x->e;
        if (x->m > 0)
            memcpy(members, x->members, x->m * sizeof *members);
        for (size_t k = 0; k < x->n && status == QDOT_OK; k++) {
            qdot_in_chart in = {0};

            if (x->runs[k]->chart)
                status = express_in_run_coordinates(x, k, from, &in, &own.e, members);
            if (status == QDOT_OK && in.turns)
                end = qdot_in_chart_end(&in, from, end);
            qdot_in_chart_clear(&in);
        }
        if (status == QDOT_OK && end == to && !g.begun
            && g.length == 0) {
            status = evaluate_range_along(&own, kind, range, value, error);
            qdot_free(members);
            return status;
        }
        if (status == QDOT_OK)
            status = evaluate_and_combine(&own, x, kind, (double[]){from, end}, &g);
        more = end != to;
        from = end;
    }
    qdot_free(members);
    if (status == QDOT_OK)
        result_of_gathered(&g, kind, value, error);
    return status;
}

static qdot_status
evaluate_by_chart(const qdot_run_expression *x, qdot_range_kind kind, const double *range, double *value,
                  double *error)
{
    for (size_t k = 0; k < x->n; k++)
        if (x->runs[k]->chart)
            return evaluate_in_chart(x, kind, range, value, error);
    return evaluate_range_along(x, kind, range, value, error);
}

/* Find an extremum or mean over runs that count their times from the same origin. */
static qdot_status
range_from_origin(const qdot_run_expression *x, qdot_range_kind kind, const double *range, double *value,
                  double *error)
{
    qdot_run_member *members = qdot_malloc((x->m + 1) * sizeof *members);
    qdot_run_expression own = *x;
    double limits[2], rest;
    qdot_status status = members ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i <= x->m && status == QDOT_OK; i++) {
        const qdot_expr *e;
        qdot_expr *made;

        status = qdot_run_time_express(x->runs[0], 1, i < x->m ? &x->members[i].value : &x->e, &e, &made);
        if (status == QDOT_OK && i < x->m) {
            members[i] = x->members[i];
            members[i].value = *e;
        } else if (status == QDOT_OK) {
            own.e = *e;
        }
        qdot_free(made);
    }
    own.members = members;
    for (int i = 0; i < 2 && range; i++)
        qdot_run_time_own(x->runs[0], range[i], 0, &limits[i], &rest);
    if (status == QDOT_OK)
        status = evaluate_by_chart(&own, kind, range ? limits : NULL, value, error);
    qdot_free(members);
    return qdot_run_time_fail(x->runs[0]->origin, status);
}

qdot_status
qdot_run_range_along(const qdot_run_expression *x, qdot_range_kind kind, const double *range,
                     double *value, double *error)
{
    for (size_t k = 1; k < x->n; k++)
        if (x->runs[k]->origin != x->runs[0]->origin)
            return qdot_fail(QDOT_ENOTBUILT, "not built yet: extrema and means of several runs far from t = 0, "
                                             "unless they begin at one time");
    return (x->runs[0]->origin != 0 ? range_from_origin : evaluate_by_chart)(x, kind, range, value, error);
}

qdot_status
qdot_run_range(qdot_run *run, qdot_range_kind kind, qdot_expr e, double from, double to,
               double *value, double *error)
{
    return qdot_run_range_along(&(qdot_run_expression){.e = e, .n = 1, .runs = &run}, kind,
                                (double[]){from, to}, value, error);
}
