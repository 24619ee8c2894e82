/* zeros-find.c -- finds all zeros in a box: splits equations into systems, treats infinity and
 * ends, merges results. */
#include "expr/build.h"
#include "expr/elementary.h"
#include "expr/function.h"
#include "expr/node.h"
#include "normal/solve/zeros.h"

#include <math.h>
#include <stdlib.h>

#include "normal/solve/zeros-task.h"

enum {
    MOST = QDOT_ZEROS_MOST_UNKNOWNS,

    NEARBY = 4000,
    PLACES = 20,
    MOST_RELATIONS = 24
};

/* The default number of evaluations for n unknowns; expressions of more nodes than SHORT count as several. */
static const uint64_t usual[MOST + 1] = {0, 20000, 80000, 160000, 160000, 160000, 160000};
enum {
    SHORT = 50,
    FACTORING = 200
}; /* largest number of operations of an equation that is worth factoring */

/* --- ranges of the unknowns ------------------------------------------------------------------------- */

static qdot_status
read_ranges(qdot_zeros_task *t)
{
    for (size_t j = 0; j < t->n; j++) {
        const qdot_zeros_range *r = &t->range[j];
        qdot_expr both[2];
        uint32_t count = 0;

        t->lo[j] = qdot_interval_point(-INFINITY);
        t->hi[j] = qdot_interval_point(INFINITY);
        if (!r->turn && r->lo != QDOT_NIL)
            t->lo[j] = qdot_ball_bounds(t->pool, both[count++] = r->lo);
        if (!r->turn && r->hi != QDOT_NIL)
            t->hi[j] = qdot_ball_bounds(t->pool, both[count++] = r->hi);
        t->ends[j] = qdot_list(t->pool, count, both);
        t->bounds[j] = (qdot_interval){t->lo[j].lo, t->hi[j].hi};
        if (r->turn)
            t->bounds[j] = (qdot_interval){-nextafter(M_PI, 4), nextafter(M_PI, 4)};
        if (!(t->bounds[j].lo <= t->bounds[j].hi))
            t->bounds[j].hi = t->bounds[j].lo; /* the range is empty: search a single point */
    }
    return qdot_pool_check(t->pool);
}

/* For zeros that fill a range given by relations a < b: prepare enclosures of b - a. */
static qdot_status
prepare_ranges_of_zeros(qdot_zeros_task *t)
{
    qdot_expr held = t->n == 1 ? t->range[0].held : QDOT_NIL;

    for (uint32_t k = 0; held != QDOT_NIL && k < qdot_expr_count(t->pool, held); k++) {
        qdot_expr set = qdot_expr_arg(t->pool, held, k), gap[MOST_RELATIONS];
        size_t m = 0;
        qdot_enclosure *gaps;

        if (qdot_expr_count(t->pool, set) > MOST_RELATIONS)
            continue;
        for (uint32_t i = 0; i < qdot_expr_count(t->pool, set); i++) {
            qdot_expr one = qdot_expr_arg(t->pool, set, i), left = qdot_expr_arg(t->pool, one, 0),
                      right = qdot_expr_arg(t->pool, one, 1);

            if ((left == t->range[0].lo && right == t->x[0]) ||
                (left == t->x[0] && right == t->range[0].hi)) /* a bound of the whole range, which holds for every box in it */
                continue;
            gap[m++] = qdot_sub(t->pool, right, left);
        }
        QDOT_TRY(qdot_pool_check(t->pool));
        QDOT_TRY(qdot_enclosure_new(t->pool, m, gap, 1, t->x, &gaps));
        if (qdot_vec_push(&t->held, gaps) != QDOT_OK) {
            qdot_enclosure_free(gaps);
            return QDOT_ENOMEM;
        }
    }
    return QDOT_OK;
}

/* --- factors as separate systems -------------------------------------------------------------------- */

/* Make one system of equations for every choice of one factor from each equation. */
static qdot_status
make_systems_of_factors(qdot_zeros_task *t)
{
    qdot_expr lists[MOST];
    size_t all = 1;

    for (size_t i = 0; i < t->n; i++) {
        QDOT_TRY(qdot_zeros_factors(t->pool, t->F[i], t->n, t->x, &lists[i]));
        all *= qdot_expr_count(t->pool, lists[i]);
        if (all > QDOT_ZEROS_SYSTEMS) { /* too many combinations: do not split into factors */
            all /= qdot_expr_count(t->pool, lists[i]);
            lists[i] = qdot_list(t->pool, 1, &t->F[i]);
        }
    }
    QDOT_TRY(qdot_pool_check(t->pool));
    for (size_t k = 0; k < all; k++) {
        size_t at = k;

        for (size_t i = 0; i < t->n; i++) {
            size_t m = qdot_expr_count(t->pool, lists[i]);

            t->f[t->systems][i] = qdot_expr_arg(t->pool, lists[i], (uint32_t)(at % m));
            at /= m;
        }
        t->systems++;
    }
    return QDOT_OK;
}

/* --- searching the box and beyond -------------------------------------------------------------------------- */

static qdot_status
search_boxes(qdot_zeros_task *t, qdot_zeros_system *s, const qdot_zero_box *box, uint64_t most)
{
    size_t nodes = qdot_enclosure_size(s->bounds);
    uint64_t weight = nodes > SHORT ? nodes / SHORT : 1;
    qdot_status status;

    s->budget = t->budget > t->spent ? t->budget - t->spent : 0;
    if (s->budget > most)
        s->budget = most;
    s->budget /= weight;
    QDOT_TRY(qdot_vec_push(&s->todo, *box));
    status = qdot_zeros_search(s);
    t->evaluations += s->evaluations;
    t->spent += s->evaluations * weight;
    s->evaluations = 0;
    return status;
}

/* Whether it is proved that the functions f [n] have no common zero in the region that a chart covers. */
static qdot_status
chart_has_no_zero(qdot_zeros_task *t, const qdot_zeros_chart *chart, const qdot_expr *of,
                  bool *empty)
{
    qdot_expr f[MOST];
    qdot_zeros_system s;
    qdot_status status = qdot_zeros_chart_put(t->pool, t->x, chart, of, f);

    *empty = false;
    if (status == QDOT_OK)
        status = qdot_zeros_chart_clear(t->pool, chart, f, empty);
    if (status == QDOT_EDOMAIN)
        return QDOT_OK;
    QDOT_TRY(status);
    if (*empty)
        return QDOT_OK;
    QDOT_TRY(qdot_zeros_system_begin(&s, t->pool, t->n, f, chart->y));
    s.least = 1e-14;
    status = search_boxes(t, &s, &chart->box, NEARBY);
    *empty = s.found.n == 0 && s.doubt.n == 0 && !s.exhausted;
    qdot_zeros_system_end(&s);
    return status;
}

/* A place in doubt, in several unknowns: an exact point of it at which f [n] vanish, or F is not defined, and
 * around which there is no zero. */
static qdot_status
decide_undecided_box(qdot_zeros_task *t, const qdot_expr *f, const qdot_zero_box *box,
                     bool *decided, qdot_zero_place *place)
{
    qdot_expr centre[MOST];
    double reach = 0;

    *decided = false;
    *place = (qdot_zero_place){.simple = false};
    for (size_t j = 0; j < t->n; j++) {
        place->at[j] = box->at[j].lo / 2 + box->at[j].hi / 2;
        place->radius[j] =
            box->at[j].hi / 2 - box->at[j].lo / 2 + 1e-14 * fabs(place->at[j]);
        if (!(place->radius[j] < 1e-3))
            return QDOT_OK;
    }
    QDOT_TRY(qdot_zeros_exact_place(t, f, place, centre, decided));
    for (size_t j = 0; j < t->n && *decided; j++) {
        qdot_interval c = qdot_ball_bounds(t->pool, centre[j]);

        reach = fmax(reach, fmax(box->at[j].hi - c.lo, c.hi - box->at[j].lo));
        place->at[j] = c.lo / 2 + c.hi / 2;
        place->radius[j] = c.hi - c.lo;
    }
    for (size_t k = 0; k < 2 * t->n && *decided; k++) {
        qdot_zeros_chart chart;

        qdot_zeros_chart_near(t->pool, t->n, centre, 2 * reach, k, &chart);
        QDOT_TRY(chart_has_no_zero(t, &chart, f, decided));
    }
    for (size_t j = 0; j < t->n; j++)
        place->alone[j] = (qdot_interval){place->at[j] - reach, place->at[j] + reach};
    return QDOT_OK;
}

/* Search the zeros of system number k, which `core` holds, within a box; `again`: some may have been found before. */
static qdot_status
search_inside(qdot_zeros_task *t, size_t k, qdot_zeros_system *core,
              const qdot_zero_box *box, bool again)
{
    bool plain = true;

    for (size_t i = 0; i < t->n; i++)
        plain &= t->f[k][i] == t->F[i];
    if (!plain && core->also == NULL) {
        QDOT_TRY(qdot_enclosure_new(t->pool, t->n, t->F, t->n, t->x, &core->also));
        core->others = t->n;
    }
    QDOT_TRY(search_boxes(t, core, box, UINT64_MAX));
    t->exhausted |= core->exhausted;
    qdot_zeros_join(core);
    if (t->n == 1) {
        QDOT_TRY(qdot_zeros_decide_doubts(core, t->ends[0]));
        qdot_zeros_join(core);
    }
    for (size_t i = 0; i < core->found.n; i++)
        QDOT_TRY(qdot_zeros_add(t, k, core->found.at[i], again));
    for (size_t i = 0; i < core->doubt.n; i++) {
        qdot_zero_place place;
        bool decided = false;

        if (t->n > 1 && core->doubt.n <= PLACES)
            QDOT_TRY(decide_undecided_box(t, t->f[k], &core->doubt.at[i], &decided, &place));
        if (decided)
            QDOT_TRY(qdot_zeros_add(t, k, place, again));
        else
            QDOT_TRY(qdot_vec_push(&t->doubt, core->doubt.at[i]));
    }
    return QDOT_OK;
}

/* Search the zeros of system number k beyond |x| = R in one chart (with variables such as 1/x). */
static qdot_status
search_chart(qdot_zeros_task *t, size_t k, qdot_zeros_system *core,
             const qdot_zeros_chart *chart, bool wild, bool *beyond)
{
    qdot_expr f[MOST], F[MOST];
    qdot_zeros_system s;
    qdot_status status;
    bool empty;

    status = qdot_zeros_chart_put(t->pool, t->x, chart, t->f[k], f);
    if (status == QDOT_OK)
        status = qdot_zeros_chart_put(t->pool, t->x, chart, t->F, F);
    if (status == QDOT_OK)
        status = qdot_zeros_chart_clear(t->pool, chart, f, &empty);
    if (status == QDOT_EDOMAIN) {
        *beyond = true;
        return QDOT_OK;
    }
    QDOT_TRY(status);
    if (empty)
        return QDOT_OK;
    QDOT_TRY(qdot_zeros_system_begin(&s, t->pool, t->n, f, chart->y));
    s.least = wild ? 1e-4 : 1e-14;
    s.others = t->n;
    status = qdot_enclosure_new(t->pool, t->n, F, t->n, chart->y, &s.also);
    if (status == QDOT_OK)
        status = search_boxes(t, &s, &chart->box, t->budget / (wild ? 40 : 4));
    *beyond |= s.doubt.n > 0 || s.exhausted;
    for (size_t i = 0; i < s.found.n && status == QDOT_OK; i++) {
        double at[MOST];
        qdot_zero_place place;

        qdot_zeros_chart_place(chart, s.found.at[i].at, at);
        if (qdot_zeros_prove(core, at, &place))
            status = qdot_zeros_add(t, k, place, true);
        else
            *beyond = true;
    }
    qdot_zeros_system_end(&s);
    return status;
}

/* Search the zeros beyond |x| = R in all charts, with the unknowns grouped as given or one by one. */
static qdot_status
search_beyond(qdot_zeros_task *t, size_t k, qdot_zeros_system *core,
              const qdot_zeros_range *range, bool *beyond)
{
    bool wild = qdot_zeros_is_wild(t->pool, t->n, t->f[k], t->x, range);

    *beyond = false;
    for (size_t c = 1;; c++) {
        qdot_zeros_chart chart;

        qdot_zeros_chart_at(t->pool, t->n, t->x, range, t->bounds, c, &chart);
        if (chart.n == 0)
            return QDOT_OK;
        t->spent += FACTORING * t->n;
        if (t->spent > t->budget) {
            *beyond = true;
            return QDOT_OK;
        }
        QDOT_TRY(search_chart(t, k, core, &chart, wild, beyond));
        if (*beyond && !wild)
            return QDOT_OK;
    }
}

/* One unknown: search zeros beyond the box up to where growth excludes them; *beyond: growth does
 * not exclude them. */
static qdot_status
search_until_growth_excludes(qdot_zeros_task *t, size_t k, qdot_zeros_system *core,
                             const qdot_interval *box, bool *beyond)
{
    qdot_zero_box below, above;
    double lo = -t->bounds[0].lo, hi = t->bounds[0].hi;

    *beyond = false;
    if (isinf(lo))
        QDOT_TRY(qdot_zeros_far(t->pool, t->f[k][0], t->x[0], -1, &lo));
    if (isinf(hi))
        QDOT_TRY(qdot_zeros_far(t->pool, t->f[k][0], t->x[0], 1, &hi));
    *beyond = isinf(lo) || isinf(hi);
    if (*beyond)
        return QDOT_OK;
    below.at[0] = (qdot_interval){-lo, box->lo};
    above.at[0] = (qdot_interval){box->hi, hi};
    core->found.n = core->doubt.n = 0;
    if (-lo < box->lo)
        QDOT_TRY(search_inside(t, k, core, &below, true));
    core->found.n = core->doubt.n = 0;
    return box->hi < hi ? search_inside(t, k, core, &above, true) : QDOT_OK;
}

static qdot_status
search_system(qdot_zeros_task *t, size_t k)
{
    qdot_zeros_range apart[MOST];
    qdot_zeros_chart chart;
    qdot_zeros_system core;
    qdot_status status;
    bool beyond = false, wild;

    QDOT_TRY(qdot_zeros_system_begin(&core, t->pool, t->n, t->f[k], t->x));
    core.held = t->held.at;
    core.ranges = t->held.n;
    qdot_zeros_chart_at(t->pool, t->n, t->x, t->range, t->bounds, 0, &chart);
    status = search_inside(t, k, &core, &chart.box, false);
    wild = t->n == 1 && qdot_zeros_is_wild(t->pool, t->n, t->f[k], t->x, t->range);
    if (status == QDOT_OK && wild)
        status = search_until_growth_excludes(t, k, &core, &chart.box.at[0], &beyond);
    if (status == QDOT_OK && (!wild || beyond))
        status = search_beyond(t, k, &core, t->range, &beyond);
    if (status == QDOT_OK && !wild && beyond && t->n == 1)
        status = search_until_growth_excludes(t, k, &core, &chart.box.at[0], &beyond);
    if (status == QDOT_OK && beyond &&
        t->n > 1) { /* a zero at infinity for these groups of unknowns may be none if each unknown is a group by itself */
        for (size_t j = 0; j < t->n; j++) {
            apart[j] = t->range[j];
            apart[j].group = (unsigned)j;
        }
        status = search_beyond(t, k, &core, apart, &beyond);
    }
    t->beyond |= beyond;
    qdot_zeros_system_end(&core);
    return status;
}

/* --- merging the results ----------------------------------------------------------------------------------- */

static int
compare_by_position(const void *a, const void *b)
{
    const qdot_zeros_member *x = a, *y = b;

    for (size_t j = 0; j < MOST; j++)
        if (fabs(x->place.at[j] - y->place.at[j]) >
            x->place.radius[j] + y->place.radius[j])
            return x->place.at[j] < y->place.at[j] ? -1 : 1;
    return 0;
}

/* Find which zeros are simple, which means that the Jacobian of F itself is regular. */
static qdot_status
find_simple_zeros(qdot_zeros_task *t)
{
    qdot_enclosure *bounds;

    QDOT_TRY(qdot_enclosure_new(t->pool, t->n, t->F, t->n, t->x, &bounds));
    for (size_t k = 0; k < t->found.n; k++) {
        qdot_zero_place *p = &t->found.at[k].place;
        qdot_interval X[MOST];
        bool plain = true;

        for (size_t i = 0; i < t->n; i++)
            plain &= t->f[t->found.at[k].system][i] == t->F[i];
        if (plain || !p->simple)
            continue;
        for (size_t j = 0; j < t->n; j++)
            X[j] = (qdot_interval){p->at[j] - p->radius[j], p->at[j] + p->radius[j]};
        qdot_enclosure_eval(bounds, X, true);
        for (size_t i = 0; i < t->n; i++)
            p->simple &= qdot_enclosure_get(bounds, i)->state == QDOT_ENCLOSURE_WHOLE;
        p->simple = p->simple && qdot_zeros_is_regular(bounds, t->n);
    }
    qdot_enclosure_free(bounds);
    return QDOT_OK;
}

/* Record that the base of a power is negative somewhere, or everywhere, in the box. */
static qdot_status
record_negative_base(qdot_zeros_task *t, qdot_expr base)
{
    qdot_enclosure *bounds;
    const qdot_enclosure_value *v;

    if ((qdot_expr_sign(t->pool, base) & QDOT_GE0) != 0)
        return QDOT_OK;
    QDOT_TRY(qdot_enclosure_new(t->pool, 1, &base, t->n, t->x, &bounds));
    qdot_enclosure_eval(bounds, t->bounds, false);
    v = qdot_enclosure_get(bounds, 0);
    if (v->state != QDOT_ENCLOSURE_NOWHERE && v->y.lo < 0) {
        t->single = true;
        t->nowhere = t->nowhere || v->y.hi < 0;
    }
    qdot_enclosure_free(bounds);
    return QDOT_OK;
}

/* Find the powers with an unknown in their exponent whose base may be negative. There they are real only where the
 * exponent is an integer or has an odd denominator: at single places, of which boxes, and derivatives, know nothing. */
static qdot_status
find_powers_at_isolated_points(qdot_zeros_task *t)
{
    const qdot_expr bases = qdot_expr_bases_of_powers(t->pool, t->n, t->F, t->n, t->x);

    QDOT_TRY(qdot_pool_check(t->pool));
    for (uint32_t i = 0; i < qdot_expr_count(t->pool, bases); i++)
        QDOT_TRY(record_negative_base(t, qdot_expr_arg(t->pool, bases, i)));
    for (size_t i = 0; i < t->n && t->nowhere; i++) /* unless an if(...) chooses another value where the power is undefined */
        t->nowhere = qdot_expr_find_function(t->pool, t->F[i], 1, (qdot_fun_id[]){QDOT_IF}, QDOT_NIL) == QDOT_NIL;
    return qdot_pool_check(t->pool);
}

static qdot_status
write_result(qdot_zeros_task *t, qdot_zeros *out)
{
    size_t n = t->n, count = t->found.n, doubts = t->doubt.n;

    *out = (qdot_zeros){.n = n,
                        .count = count,
                        .doubts = doubts,
                        .beyond = t->beyond,
                        .exhausted = t->exhausted,
                        .single = t->single,
                        .complete = !t->beyond && !t->exhausted && !t->single && doubts == 0,
                        .evaluations = t->evaluations};
    out->at = qdot_calloc(2 * n * (count + doubts) + 1, sizeof *out->at);
    out->simple = qdot_calloc(count + 1, sizeof *out->simple);
    if (out->at == NULL || out->simple == NULL)
        return QDOT_ENOMEM;
    out->radius = out->at + n * count;
    out->doubt = out->radius + n * count;
    out->reach = out->doubt + n * doubts;
    if (count > 1)
        qsort(t->found.at, count, sizeof *t->found.at, compare_by_position);
    for (size_t k = 0; k < count; k++) {
        const qdot_zero_place *p = &t->found.at[k].place;

        out->simple[k] = p->simple;
        for (size_t j = 0; j < n; j++) {
            bool nothing = fabs(p->at[j]) <= p->radius[j] && p->radius[j] < 1e-14;

            out->at[k * n + j] = nothing ? 0 : p->at[j]; /* the value is 0 within its error bound */
            out->radius[k * n + j] = p->radius[j] + (nothing ? fabs(p->at[j]) : 0);
        }
    }
    for (size_t k = 0; k < doubts; k++)
        for (size_t j = 0; j < n; j++) {
            const qdot_interval *X = &t->doubt.at[k].at[j];

            out->doubt[k * n + j] = X->lo / 2 + X->hi / 2;
            out->reach[k * n + j] = X->hi / 2 - X->lo / 2;
        }
    return QDOT_OK;
}

void
qdot_zeros_clear(qdot_zeros *z)
{
    qdot_free(z->at);
    qdot_free(z->simple);
    *z = (qdot_zeros){0};
}

qdot_status
qdot_zeros_find(qdot_pool *pool, size_t n, const qdot_expr *F, const qdot_expr *x,
                const qdot_zeros_range *range, uint64_t budget, qdot_zeros *out)
{
    qdot_zeros_task t = {.pool = pool, .n = n, .F = F, .x = x, .range = range};
    qdot_status status;

    *out = (qdot_zeros){0};
    if (n == 0 || n > MOST)
        return qdot_fail(QDOT_ETYPE, "zeros are searched in 1 to %d unknowns", MOST);
    t.budget = budget == 0 ? usual[n] : budget;
    status = read_ranges(&t);
    if (status == QDOT_OK)
        status = prepare_ranges_of_zeros(&t);
    if (status == QDOT_OK)
        status = find_powers_at_isolated_points(&t);
    if (status == QDOT_OK && !t.nowhere)
        status = make_systems_of_factors(&t);
    for (size_t k = 0; k < t.systems && status == QDOT_OK; k++)
        status = search_system(&t, k);
    if (status == QDOT_OK)
        status = find_simple_zeros(&t);
    if (status == QDOT_OK)
        status = write_result(&t, out);
    for (size_t k = 0; k < t.held.n; k++)
        qdot_enclosure_free(t.held.at[k]);
    qdot_free(t.held.at);
    qdot_free(t.found.at);
    qdot_free(t.doubt.at);
    if (status != QDOT_OK)
        qdot_zeros_clear(out);
    return status;
}
