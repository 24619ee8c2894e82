/* watch.c -- searches a step for roots interval by interval, and keeps state between steps. */
#include "sim/watch/watch.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "sim/watch/watch-parts.h"

enum { MOST_PARTS = 4000 };

/* A step with a series ends after this many intervals; the rest is searched as a new step. */
enum { ENOUGH_PARTS = 500 };

/* After so many intervals functions that rounding makes are no longer searched. */
enum { MANY_PARTS = 64 };

/* --- intervals of a step ------------------------------------------------------------- */

static qdot_status
sample_functions(qdot_watch *w, const qdot_watch_part *p, int nodes)
{
    for (int j = 0; j < nodes; j++) {
        QDOT_TRY(qdot_watch_value_at(
            w, qdot_watch_time(p, qdot_chebyshev_node(nodes, j)), w->g));
        qdot_polynomial_bounds_sample(&w->bounds, j, w->in);
        for (size_t i = 0; i < w->m; i++)
            w->samples[i * QDOT_WATCH_NODES + (size_t)j] = w->g[i];
    }
    return QDOT_OK;
}

/* The worst verdict about the fit of any watched function on an interval. */
static qdot_watch_verdict
worst_verdict(qdot_watch *w, qdot_watch_part *p, int nodes)
{
    qdot_watch_verdict worst = QDOT_PART_GOOD;

    for (size_t i = 0; i < w->m; i++) {
        qdot_watch_verdict v =
            w->live[i] ? qdot_watch_fit(w, p, i, nodes) : QDOT_PART_GOOD;

        if (v == QDOT_PART_MORE_NODES && nodes == QDOT_WATCH_NODES)
            v = QDOT_PART_HALVED;
        worst = v > worst ? v : worst;
    }
    return worst;
}

/* An interval shorter than this fraction of its step (or of the first interval) is not halved further. */
static const double least_of_length = 0x1p-44;

/* Whether an interval is too short to be divided further. */
static bool
is_too_short(const qdot_watch *w, const qdot_watch_part *p)
{
    double t = fmax(fabs(p->a), fabs(p->b));

    return fabs(p->b - p->a) <= fmax(65536 * DBL_EPSILON * t, w->shortest);
}

/* Whether function i, which may have kinks, is 0 at an end of the part, and at the node beside it, but not
 * throughout: where the part is not much longer than rounding a polynomial goes through the kink between. */
static bool
is_partly_zero(const qdot_watch *w, const qdot_watch_part *p, size_t i, int nodes)
{
    const double *g = w->samples + i * QDOT_WATCH_NODES;
    const bool start = w->now.on[i] && qdot_watch_zero(w, i) == 0 && g[nodes - 1] == 0,
               end = g[0] == 0 && p->at_end == 0;

    return !w->smooth[i] && (start || end) && qdot_chebyshev_size(nodes, p->c) > 0;
}

/* Find the roots of function i on an interval that is not halved further: the fit is `good`, or it
 * is too short. */
static qdot_status
find_roots_of_function(qdot_watch *w, qdot_watch_part *p, size_t i, int nodes, bool good)
{
    const size_t before = w->roots.n;
    const int sign = w->now.sign[i];
    bool rough = qdot_watch_fit(w, p, i, nodes) == QDOT_PART_MORE_NODES;
    const bool may_kink = !w->smooth[i] || !(w->expanded || w->clock[i]),
               off = may_kink && !w->now.on[i] && sign != 0 && qdot_watch_is_noisy(w, p, i);

    if (!good && !rough) {
        qdot_watch_verdict v;

        QDOT_TRY(qdot_watch_resolve(w, p, i, nodes, &v));
        rough = v != QDOT_PART_GOOD;
    }
    if (rough || is_partly_zero(w, p, i, nodes)) {
        qdot_status status;

        w->coarse = true;
        status = qdot_watch_rough_roots(w, p, i, nodes);
        w->coarse = false;
        return status;
    }
    QDOT_TRY(qdot_watch_roots(w, p, i));
    if (!off || w->now.on[i] || w->now.sign[i] != sign || w->roots.n != before)
        return QDOT_OK;
    return qdot_watch_seek_least(w, p, i, nodes);
}

/* Whether polynomials represent all watched functions accurately on the interval; *v: the worst verdict. */
static qdot_status
fit_all_functions(qdot_watch *w, qdot_watch_part *p, const double *at_end, int nodes, qdot_watch_verdict *v)
{
    *v = QDOT_PART_GOOD;
    for (size_t i = 0; i < w->m && *v == QDOT_PART_GOOD; i++) {
        if (!w->live[i])
            continue;
        p->at_end = at_end[i];
        (void)qdot_watch_fit(w, p, i, nodes); /* fit again with the number of nodes that sufficed */
        QDOT_TRY(qdot_watch_resolve(w, p, i, nodes, v));
    }
    return QDOT_OK;
}

/* Evaluate the functions at the nodes; double-double, with *at_end, if doubles do not determine their signs. */
static qdot_status
sample_with_sufficient_precision(qdot_watch *w, const qdot_watch_part *p, int nodes, const double **at_end)
{
    bool any = w->fine;

    if (!any)
        QDOT_TRY(sample_functions(w, p, nodes));
    if (!any)
        QDOT_TRY(qdot_watch_wants_two(w, p, nodes, &any));
    if (!any)
        return QDOT_OK;
    w->fine = true;
    QDOT_TRY(sample_functions(w, p, nodes));
    QDOT_TRY(qdot_watch_value_at(w, p->b, w->fine_end));
    *at_end = w->fine_end;
    return QDOT_OK;
}

/* A function that is 0 at the end of the part, but for rounding, is so from there on, until it is large
 * beside that. `fine`: its value there is in two doubles. */
static void
keep_value_at_zero(qdot_watch *w, size_t i, bool fine)
{
    if (fine)
        w->now.g0[i] += w->now.offset[i];
    if (w->now.on[i])
        w->now.offset[i] = w->now.g0[i];
    else if (!fine)
        w->now.offset[i] = 0;
    w->now.blurred[i] = w->now.on[i] && (w->now.blurred[i] || !fine);
    w->now.sharp[i] = fine;
}

static qdot_status
search_interval(qdot_watch *w, qdot_watch_part *p,
                const double *at_end, qdot_watch_verdict *v)
{
    int nodes = w->nodes;
    bool good;

    w->fine = w->steady = false;
    for (size_t i = 0; i < w->m; i++) {
        w->wants[i] = false;
        w->noise[i] = NAN;
        w->hidden[i] = 0;
        w->n_extrema[i] = QDOT_WATCH_UNKNOWN;
        w->n_fitted[i] = 0;
    }
    for (;; nodes *= 2) {
        QDOT_TRY(sample_with_sufficient_precision(w, p, nodes, &at_end));
        if (w->fine) /* the double values may consist of rounding only */
            QDOT_TRY(qdot_watch_find_noise(w, p));
        *v = worst_verdict(w, p, nodes);
        if (*v == QDOT_PART_HALVED) {
            QDOT_TRY(qdot_watch_find_noise(w, p));
            *v = worst_verdict(w, p, nodes);
        }
        if (*v != QDOT_PART_MORE_NODES || nodes == QDOT_WATCH_NODES)
            break;
    }
    if (*v == QDOT_PART_GOOD) {
        *v = qdot_watch_judge(w, p, nodes);
        if (*v == QDOT_PART_HALVED) {
            QDOT_TRY(qdot_watch_find_noise(w, p));
            *v = qdot_watch_judge(w, p, nodes);
        }
    }
    if (*v == QDOT_PART_GOOD)
        QDOT_TRY(fit_all_functions(w, p, at_end, nodes, v));
    if (*v != QDOT_PART_GOOD && !is_too_short(w, p))
        return QDOT_OK;
    good = *v == QDOT_PART_GOOD;
    if (!good) /* g leaves a zero too slowly to be seen, or has no accurate fit */
        QDOT_TRY(qdot_watch_find_noise(w, p));
    *v = QDOT_PART_GOOD;
    w->nodes = nodes > QDOT_WATCH_LEAST_NODES ? nodes : QDOT_WATCH_LEAST_NODES;
    for (size_t i = 0; i < w->m; i++) {
        if (!w->live[i])
            continue;
        p->at_end = at_end[i];
        p->sharp = false;
        QDOT_TRY(find_roots_of_function(w, p, i, nodes, good));
        keep_value_at_zero(w, i, qdot_watch_is_fine(w, i) || p->sharp);
    }
    return QDOT_OK;
}

/* Roots whose times differ relatively by less than this may be simultaneous. */
static const double one_instant = 64 * DBL_EPSILON;

/* Whether a root from w->roots.at[since] on ends the step, clearly before b; *after: how long after the start of
 * the step. */
static bool
step_ends_before(const qdot_watch *w, double b, size_t since, double *after)
{
    for (size_t i = since; i < w->roots.n && w->reader.ends; i++) {
        const qdot_root *root = &w->roots.at[i];

        *after = fabs(root->t - w->t);
        if (fabs(b - root->t) > one_instant * fmax(fabs(b), fabs(root->t))
            && w->reader.ends(root, w->reader.user))
            return true;
    }
    *after = 0;
    return false;
}

/* Push the end of an interval onto the stack of ends, with the functions' values there. */
static qdot_status
push_end(qdot_watch *w, double t, double *ends, int *depth)
{
    QDOT_TRY(qdot_watch_value_at(w, t, w->g));
    ends[*depth] = t;
    memcpy(w->ends + (size_t)*depth * w->m, w->g, w->m * sizeof *w->g);
    ++*depth;
    return QDOT_OK;
}

/* Where the last step was ended by a root, this one, if much longer, is looked at from a part of about that length on:
 * events of which hundreds would lie in the step come so. */
static double
length_of_first_cut(const qdot_watch *w, double t)
{
    const double least = 0x1p-40 * fmax(fabs(w->t), fabs(t)); /* a root just after the start says nothing */

    return w->reach > least && w->length > 16 * w->reach ? w->t + copysign(4 * w->reach, t - w->t)
                                                         : t;
}

/* The whole step, left to right, or as far as it is wanted; parts that wait stand on a stack of
 * their ends. */
static qdot_status
search_step_by_intervals(qdot_watch *w, double t, bool series, bool *whole)
{
    double ends[QDOT_WATCH_DEEPEST + 2], from = w->t, cut = length_of_first_cut(w, t);
    int depth = 1, parts = 0;
    size_t before = 0, earlier = 0; /* roots before this interval, and before the previous one */

    *whole = true;
    ends[0] = t;
    memcpy(w->ends, w->final, w->m * sizeof *w->ends);
    if (cut != t)
        QDOT_TRY(push_end(w, cut, ends, &depth));
    w->reach = 0;
    w->part_before = w->t;
    while (depth > 0) {
        qdot_watch_part p = {.a = from, .b = ends[depth - 1]};
        const double *at_end = w->ends + (size_t)(depth - 1) * w->m;
        double middle;
        qdot_watch_verdict v;

        QDOT_TRY(qdot_interrupt_check());
        QDOT_TRY(search_interval(w, &p, at_end, &v));
        w->fine = false;
        w->looked_at++;
        if (v == QDOT_PART_GOOD) {
            w->part_before = p.a;
            from = p.b;
            depth--;
            *whole = !step_ends_before(w, p.b, earlier, &w->reach);
            earlier = before;
            before = w->roots.n;
            if (!*whole)
                break;
            continue;
        }
        middle =
            p.a + (p.b - p.a) * (v == QDOT_PART_START_CUT   ? 0.0625
                                 : v == QDOT_PART_START_FAR ? w->cut
                                 : v == QDOT_PART_PARTED    ? QDOT_POLYNOMIAL_BOUNDS_BESIDE
                                                            : 0.5);
        if (v == QDOT_PART_START_FAR && p.a == w->t)
            w->shortest = fmin(w->shortest, least_of_length * fabs(middle - p.a));
        if (series && parts >= ENOUGH_PARTS && from != w->t) {
            w->reached = from;
            *whole = false;
            break;
        }
        if (++parts == MANY_PARTS) {
            bool any;

            QDOT_TRY(qdot_watch_drop_hidden(w, &any));
            if (!any)
                break;
        }
        if (depth == QDOT_WATCH_DEEPEST || parts > MOST_PARTS)
            return qdot_fail(QDOT_EFAILED, "an event cannot be resolved at t = %.15g",
                             p.a);
        QDOT_TRY(push_end(w, middle, ends, &depth));
    }
    return QDOT_OK;
}

/* --- searching a step ---------------------------------------------------------------- */

/* Whether the zero of a coordinate's bound is so far away that the step cannot reach it. */
static bool
is_bound_far(const qdot_watch *w, size_t i, double t, const double *y, const qdot_ode_expanded *step)
{
    const qdot_ode_series *series = w->reader.system->series;
    size_t c = w->coordinate[i];
    double distance;

    if (c == SIZE_MAX)
        return qdot_watch_excludes(w, i);
    distance = fabs(w->y[c] - w->bound[i]);
    if (!step)
        return fmin(distance, fabs(y[c] - w->bound[i])) >
               fabs(t - w->t) * fmax(fabs(w->y[w->n + c]), fabs(y[w->n + c]));
    return distance > w->kernels->span(series->x + c * series->stride, step->order,
                                       (t - w->t) / step->unit);
}

static int
compare_roots_by_time(const qdot_root *a, const qdot_root *b, double direction)
{
    return a->t != b->t ? (direction * (a->t - b->t) > 0 ? 1 : -1)
                        : (a->function > b->function) - (a->function < b->function);
}

static void
sort_roots(qdot_watch *w)
{
    for (size_t i = 1; i < w->roots.n; i++) {
        qdot_root root = w->roots.at[i];
        size_t k = i;

        for (; k > 0 && compare_roots_by_time(&w->roots.at[k - 1], &root, w->direction) > 0; k--)
            w->roots.at[k] = w->roots.at[k - 1];
        w->roots.at[k] = root;
    }
}

static void
copy_search_state(const qdot_watch *w, struct qdot_watch_state *to,
                  const struct qdot_watch_state *from)
{
    memcpy(to->sign, from->sign, w->m * sizeof *to->sign);
    memcpy(to->on, from->on, w->m * sizeof *to->on);
    memcpy(to->blurred, from->blurred, w->m * sizeof *to->blurred);
    memcpy(to->sharp, from->sharp, w->m * sizeof *to->sharp);
    memcpy(to->g0, from->g0, w->m * sizeof *to->g0);
    memcpy(to->offset, from->offset, w->m * sizeof *to->offset);
    memcpy(to->joined, from->joined, w->m * sizeof *to->joined);
    memcpy(to->apart, from->apart, w->m * sizeof *to->apart);
}

qdot_status
qdot_watch_step(qdot_watch *w, double t, const double *y, bool last,
                const qdot_ode_expanded *step, const qdot_root **roots, size_t *n)
{
    bool any = false, whole = true;

    w->direction = t < w->t ? -1 : 1;
    w->expanded = step != NULL;
    w->fine = w->coarse = false;
    copy_search_state(w, &w->now, &w->start);
    w->roots.n = 0;
    memcpy(w->in, y, 2 * w->n * sizeof *y);
    QDOT_TRY(qdot_watch_value(w, t, w->final));
    w->end[2 * w->n] = t;
    memcpy(w->end, y, 2 * w->n * sizeof *y);
    w->length = fabs(t - w->t);
    w->shortest = least_of_length * w->length;
    w->reached = t;
    if (w->all_bounds)
        w->bound_at_step = false;
    else
        qdot_watch_bound(w, step);
    qdot_polynomial_bounds_begin(&w->bounds, NULL);
    QDOT_TRY(qdot_watch_find_fading(w, t, y));
    if (w->any_deep)
        QDOT_TRY(qdot_watch_leave_deep(w, t));
    for (size_t i = 0; i < w->m; i++) {
        w->live[i] = !qdot_watch_has_faded(w, i)
                     && (w->start.on[i] || qdot_watch_sign(w->final[i]) != w->start.sign[i] || !is_bound_far(w, i, t, y, step));
        w->first_noise[i] = NAN;
        w->fresh[i] = true;
        w->first[i] = w->start.sign[i];
        w->slow[i] = w->grazed[i] = false;
        w->hides[i] = QDOT_WATCH_UNKNOWN;
    }
    QDOT_TRY(qdot_watch_claim_hidden(w));
    for (size_t i = 0; i < w->m; i++)
        any |= w->live[i];
    if (qdot_watch_is_over_jump(w, w->t, t))
        QDOT_TRY(qdot_watch_pass_jump(w, t));
    else if (any)
        QDOT_TRY(search_step_by_intervals(w, t, step != NULL, &whole));
    if (whole)
        QDOT_TRY(qdot_watch_doubt_missed(w));
    qdot_watch_mark_pieces(w);
    if (last && whole)
        QDOT_TRY(qdot_watch_end_on_zero(w, t));
    for (size_t i = 0; i < w->m; i++)
        if (!w->live[i]) {
            if (qdot_watch_has_faded(w, i) || w->hides[i] == true)
                w->now.sign[i] = qdot_watch_sign(w->final[i]);
            w->now.g0[i] = w->final[i];
            w->now.on[i] = w->now.blurred[i] = w->now.sharp[i] = false;
            w->now.offset[i] = 0;
        }
    sort_roots(w);
    if (qdot_watch_join_instants(w))
        sort_roots(w);
    if (w->least > 0)
        QDOT_TRY(qdot_watch_forget_start(w));
    *roots = w->roots.at;
    *n = w->roots.n;
    return QDOT_OK;
}

bool
qdot_watch_is_far(const qdot_watch *w, const qdot_ode_expanded *step)
{
    for (size_t i = 0; i < w->m; i++)
        if (w->coordinate[i] == SIZE_MAX || w->start.on[i] ||
            !is_bound_far(w, i, step->t_end, NULL, step))
            return false;
    return true;
}

void
qdot_watch_pass(qdot_watch *w, double t, const double *y)
{
    memcpy(w->y, y, 2 * w->n * sizeof *y);
    w->t = t;
    for (size_t i = 0; i < w->m; i++)
        w->start.g0[i] = y[w->coordinate[i]] - w->bound[i];
}

void
qdot_watch_take(qdot_watch *w)
{
    copy_search_state(w, &w->start, &w->now);
    qdot_watch_end_deep(w);
    qdot_watch_take_fading(w);
    w->least = 0;
    memcpy(w->y, w->end, 2 * w->n * sizeof *w->y);
    w->t = w->end[2 * w->n];
}

qdot_status
qdot_watch_measure(qdot_watch *w, const qdot_watch_reader *reader, double t, const double *y,
                   const double **g)
{
    w->reader = *reader;
    memcpy(w->in, y, 2 * w->n * sizeof *y);
    *g = w->g;
    return qdot_watch_value(w, t, w->g);
}

/* Whether g_i = g at a state is rounding, of its operations (in two doubles, if `exact`) or of the state, unless that is
 * `given` in two doubles. Where g_i
 * jumps from there a rounding of the state changes it as much as a larger change does: that tells nothing. */
static qdot_status
is_value_rounding(qdot_watch *w, double t, const double *y, double least, bool exact, bool given, size_t i, double g,
                  bool *is)
{
    double noise, more;

    *is = g == 0;
    if (!*is) {
        memcpy(w->in, y, 2 * w->n * sizeof *y);
        QDOT_TRY(qdot_watch_operations(w, t, exact, i, &noise));
        *is = fabs(g) <= noise;
    }
    if (*is)
        return QDOT_OK;
    if (exact && given) { /* the state is exact, but numbers in g are rounded */
        memcpy(w->in, y, 2 * w->n * sizeof *y);
        w->in[2 * w->n] = t;
        qdot_tape_eval(w->sizes, w->in, w->moved, w->work);
        if (fabs(g) > DBL_EPSILON * w->moved[i])
            return QDOT_OK;
    }
    QDOT_TRY(qdot_watch_noise(w, t, y, DBL_EPSILON, least, i, &noise));
    if (fabs(g) > 2 * noise)
        return QDOT_OK;
    QDOT_TRY(qdot_watch_noise(w, t, y, 1024 * DBL_EPSILON, least, i, &more));
    *is = more > 4 * noise;
    return QDOT_OK;
}

qdot_status
qdot_watch_begin(qdot_watch *w, const qdot_watch_reader *reader, double t, const double *y,
                 const qdot_watch_known *known, bool *on)
{
    w->reader = *reader;
    w->least = known->least;
    w->largest = known->largest;
    w->begun = t;
    memcpy(w->y, y, 2 * w->n * sizeof *y);
    w->t = t;
    memset(w->now.blurred, 0, w->m * sizeof *w->now.blurred);
    QDOT_TRY(qdot_watch_value_at_begin(w, known->low));
    QDOT_TRY(qdot_watch_begin_deep(w, known->low));
    for (size_t i = 0; i < w->m; i++) {
        const double g = w->start.g0[i];
        const bool met = known->residual && known->residual[i] >= 0;

        if (w->start.sharp[i] && met && i < known->left) {
            w->start.on[i] = fabs(g) <= QDOT_WATCH_NEGLIGIBLE * known->residual[i];
        } else {
            QDOT_TRY(is_value_rounding(w, t, y, known->least, w->start.sharp[i] && w->smooth[i],
                                       known->exact && (t == 0 || !w->bounds.reads_time), i, g, &w->start.on[i]));
            w->start.on[i] = w->start.on[i] || (met && fabs(g) <= 4 * known->residual[i]);
        }
        w->start.blurred[i] = false;
        w->start.offset[i] = w->start.on[i] && w->start.sharp[i] ? g : 0;
        w->start.sign[i] = w->start.on[i] ? known->before[i] : qdot_watch_sign(g);
        on[i] = w->start.on[i];
        w->faded[i] = 0;
    }
    return QDOT_OK;
}

double
qdot_watch_reached(const qdot_watch *w)
{
    return w->reached;
}

size_t
qdot_watch_looked_at(const qdot_watch *w)
{
    return w->looked_at;
}

const int *
qdot_watch_first(const qdot_watch *w)
{
    return w->first;
}

const bool *
qdot_watch_slow(const qdot_watch *w)
{
    return w->slow;
}

qdot_status
qdot_watch_look(qdot_watch *w, double t, const double *y, const double *largest, int *signs, double *g,
                bool *on)
{
    memcpy(w->in, y, 2 * w->n * sizeof *y);
    QDOT_TRY(qdot_watch_value(w, t, g));
    for (size_t i = 0; i < w->m; i++)
        signs[i] = qdot_watch_sign(g[i]);
    for (size_t i = 0; i < w->m && on; i++) {
        double noise = 0, of_time = 0;

        if (g[i] != 0) {
            QDOT_TRY(qdot_watch_noise_of(w, t, y, largest, i, &noise));
            QDOT_TRY(qdot_watch_noise_of_time(w, t, y, i, &of_time));
        }
        on[i] = fabs(g[i]) <= noise + of_time;
    }
    return QDOT_OK;
}
