/* action.c -- action(x) and action(x, E): the action variable of a coordinate, exact, or a number with its error. */
#include <float.h>
#include <math.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/value-kind.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/functions/builtin.h"
#include "lang/functions/separation.h"
#include "lang/functions/solve-conditions.h"
#include "lang/functions/solve-numbers.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "mech/scene/access.h"
#include "mech/hamilton/action.h"
#include "normal/calculus/decimal.h"
#include "normal/solve/conditions.h"
#include "normal/solve/solutions.h"

/* --- in numbers ------------------------------------------------------------------------------------ */

/* 2 int sqrt(f) between zeros that are known to within their radii. */
static qdot_status
number_between(qdot_session *session, qdot_expr f, qdot_expr x, const qdot_solve_zero *a, const qdot_solve_zero *b, qdot_expr *value)
{
    enum { DIGITS = 16 };
    qdot_pool *pool = session->pool;
    const double width[] = {2 * a->radius + 8 * DBL_EPSILON * fabs(a->at), 2 * b->radius + 8 * DBL_EPSILON * fabs(b->at)};
    const double lo = a->at + width[0], hi = b->at - width[1];
    const qdot_expr ends[] = {qdot_measured_rational(pool, lo), qdot_measured_rational(pool, hi)};
    qdot_measured m = {.plain = true};
    double missing = 0;
    qdot_expr J = qdot_integral(pool, qdot_sqrt(pool, f), x, ends[0], ends[1]);

    QDOT_TRY(qdot_pool_check(pool));
    for (int i = 0; i < 2; i++) { /* f is monotonic near a simple zero: the part left out is at most 2 width sqrt(f) */
        double there;

        QDOT_TRY(qdot_session_number(session, qdot_subs(pool, f, 1, &x, &ends[i]), &there, NULL));
        missing += 4 * width[i] * sqrt(fmax(there, 0));
    }
    QDOT_TRY(qdot_decimal(pool, qdot_mul(pool, qdot_expr_int(pool, 2), J), DIGITS, &m.exact, &m.error));
    m.error += missing;
    QDOT_TRY(qdot_session_number(session, m.exact, &m.value, NULL));
    return qdot_value_kind_give(pool, qdot_measured_add(session, m), value);
}

/* The number *there of f at x = at; NAN where f is not defined. */
static qdot_status
number_at(qdot_session *session, qdot_expr f, qdot_expr x, double at, double *there)
{
    qdot_pool *pool = session->pool;
    const qdot_expr place = qdot_measured_rational(pool, at), value = qdot_subs(pool, f, 1, &x, &place);

    *there = NAN;
    return qdot_grave(value == QDOT_NIL ? qdot_pool_check(pool) : qdot_session_number(session, value, there, NULL));
}

/* A full turn of an angle: the integral of p = shift + sqrt(f) from -pi to pi. */
static qdot_status
number_of_turn(qdot_session *session, qdot_expr p, qdot_expr x, qdot_expr *value)
{
    enum { DIGITS = 16 };
    qdot_pool *pool = session->pool;
    qdot_measured m = {.plain = true};
    const qdot_expr J = qdot_integral(pool, p, x, qdot_neg(pool, QDOT_PI), QDOT_PI);

    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(qdot_decimal(pool, J, DIGITS, &m.exact, &m.error));
    QDOT_TRY(qdot_session_number(session, m.exact, &m.value, NULL));
    return qdot_value_kind_give(pool, qdot_measured_add(session, m), value);
}

/* Find the only well, f > 0 between zeros i and i + 1, *at; of two that x -> -x exchanges the first. *wells: their number. */
static qdot_status
find_well(qdot_session *session, qdot_expr f, qdot_expr x, const qdot_solve_zeros *zeros, size_t *wells, size_t *at)
{
    qdot_pool *pool = session->pool;
    const qdot_expr back = qdot_neg(pool, x);

    *wells = 0;
    for (size_t i = 0; i + 1 < zeros->n; i++) {
        double there;

        QDOT_TRY(number_at(session, f, x, (zeros->at[i].at + zeros->at[i + 1].at) / 2, &there));
        if (there > 0 && (*wells)++ == 0)
            *at = i;
    }
    if (*wells != 2 || qdot_subs(pool, f, 1, &x, &back) != f)
        return qdot_pool_check(pool);
    *wells = 1;
    return qdot_answer_notice_once(session, "there are two equal wells: the action is that of one");
}

/* The action with the values of `set`, between the two zeros of f that have f > 0 inside, or over a turn of an angle. */
static qdot_status
number_of_action(qdot_session *session, const qdot_separated *one, qdot_expr *value)
{
    qdot_pool *pool = session->pool;
    const qdot_expr f = qdot_session_bind(session, one->square);
    const qdot_symbol *symbol = qdot_expr_symbol(pool, one->q);
    const qdot_facts facts = qdot_scene_facts(session->scene);
    const bool angle = symbol->lo == QDOT_NIL && symbol->hi == QDOT_NIL && qdot_is_angle(pool, f, one->q, &facts);
    const qdot_window window = qdot_solve_window(pool, one->q, angle);
    qdot_solve_zeros zeros = {0};
    bool known = false, all = false;
    size_t wells = 0, at = 0;
    double there = NAN;
    qdot_status status = qdot_pool_check(pool);

    if (status == QDOT_OK)
        status = qdot_solve_line(session, f, one->q, QDOT_NIL, &window, &zeros, &known, &all);
    if (status == QDOT_OK && angle && zeros.n > 0) { /* the last range ends at the first zero, a turn later */
        qdot_solve_zero next = zeros.at[0];

        next.at += 2 * M_PI;
        status = qdot_vec_push(&zeros, next);
    }
    if (status == QDOT_OK && known)
        status = find_well(session, f, one->q, &zeros, &wells, &at);
    if (status == QDOT_OK && angle && known && all && zeros.n == 0)
        status = number_at(session, f, one->q, 0, &there);
    if (status != QDOT_OK)
        ;
    else if (there > 0) {
        status = number_of_turn(session, qdot_add(pool, qdot_session_bind(session, one->shift), qdot_sqrt(pool, f)), one->q, value);
    } else if (!known || wells != 1) {
        status = qdot_fail(QDOT_EFAILED, wells > 1 ? "there are %zu wells at this energy" : "no turning points were found, neither by formulas nor in numbers", wells);
        qdot_hint(wells > 1 ? "the domain of a coordinate chooses one: coord x > 0" : "`set` gives values to the parameters and the energy");
    } else {
        status = number_between(session, f, one->q, &zeros.at[at], &zeros.at[at + 1], value);
    }
    qdot_free(zeros.at);
    return status;
}

/* --- exact ------------------------------------------------------------------------------------------- */

/* The relation of one set whose opposite is in the other, where all else in the other follows from the opposite and the scene;
 * nil: there is none. */
static qdot_expr
deciding_relation(qdot_session *session, qdot_expr set, qdot_expr other)
{
    qdot_pool *pool = session->pool;
    const qdot_facts scene = qdot_scene_facts(session->scene);

    for (uint32_t i = 0; set != QDOT_NIL && i < qdot_expr_count(pool, set); i++) {
        const qdot_expr a = qdot_expr_arg(pool, set, i);
        const qdot_expr opposite = qdot_rel(pool, QDOT_LT, qdot_expr_arg(pool, a, 1), qdot_expr_arg(pool, a, 0));
        qdot_expr room[QDOT_CONDITIONS_MOST];
        const qdot_facts there = qdot_facts_and(pool, &scene, qdot_list(pool, 1, &opposite), room);
        bool holds = false;
        uint32_t open = 0;

        for (uint32_t k = 0; other != QDOT_NIL && k < qdot_expr_count(pool, other); k++) {
            const qdot_expr b = qdot_expr_arg(pool, other, k);
            const qdot_expr gap = qdot_sub(pool, qdot_expr_arg(pool, b, 1), qdot_expr_arg(pool, b, 0));

            if (b == opposite)
                holds = true;
            else
                open += qdot_condition(pool, gap, true, &there) != QDOT_TRUE;
        }
        if (holds && open == 0)
            return a;
    }
    return QDOT_NIL;
}

/* The conditions of a set without one of them. */
static qdot_expr
without_relation(qdot_pool *pool, qdot_expr set, qdot_expr relation)
{
    qdot_expr rest = QDOT_NIL;

    for (uint32_t i = 0; set != QDOT_NIL && i < qdot_expr_count(pool, set); i++)
        if (qdot_expr_arg(pool, set, i) != relation)
            rest = qdot_conditions_and(pool, rest, qdot_expr_arg(pool, set, i));
    return rest;
}

static qdot_status
notice_of_regimes(qdot_session *session, qdot_expr x, const qdot_action *a)
{
    const char *name = qdot_expr_symbol(session->pool, x)->name;

    for (size_t i = 0; i < a->regime.n; i++)
        if (a->regime.at[i].wall)
            return qdot_answer_notice_once(session, "%s is reflected at the end of its domain", name);
    return QDOT_OK;
}

/* The value of the regimes: one, or if(CONDITION, J1, J2 ...) where a condition of each excludes the next; a notice says
 * where it holds. */
static qdot_status
join_regimes(qdot_session *session, qdot_expr x, const qdot_action *a, qdot_expr *value)
{
    qdot_pool *pool = session->pool;
    const size_t n = a->regime.n;
    qdot_expr all = a->regime.at[n - 1].value, holds = QDOT_NIL;

    QDOT_TRY(notice_of_regimes(session, x, a));
    for (size_t i = n - 1; i-- > 0;) {
        const qdot_action_regime *one = &a->regime.at[i];
        const qdot_expr by = deciding_relation(session, one->condition, a->regime.at[i + 1].condition);

        if (by == QDOT_NIL) { /* the first alone, for its conditions */
            QDOT_TRY(qdot_solve_notice_all(session, "the action is this for ", a->regime.at[0].condition));
            return qdot_value_kind_give(pool, a->regime.at[0].value, value);
        }
        all = qdot_fun(pool, QDOT_IF, 3, (qdot_expr[]){by, one->value, all});
        holds = without_relation(pool, one->condition, by);
    }
    QDOT_TRY(qdot_solve_notice_all(session, "the action is this for ", n == 1 ? a->regime.at[0].condition : holds));
    return qdot_value_kind_give(pool, all, value);
}

static qdot_status
refuse_unbound(qdot_action_verdict verdict, const char *name)
{
    switch (verdict) {
    case QDOT_ACTION_SEVERAL:
        (void)qdot_fail(QDOT_EFAILED, "there are several wells, with different actions");
        return qdot_hint("the domain of a coordinate chooses one: coord %.60s > 0", name);
    case QDOT_ACTION_FALLS: return qdot_fail(QDOT_EDOMAIN, "the action is infinite: the motion runs into a place where p is infinite");
    default: return qdot_fail(QDOT_EDOMAIN, "the motion in %.100s is not periodic: it has no two turning points and no full turn", name);
    }
}

static qdot_status
action_of_separated(qdot_session *session, const qdot_separation *all, size_t which, qdot_expr *value)
{
    const qdot_separated *one = &all->of[which];
    const char *name = qdot_expr_symbol(session->pool, one->q)->name;
    qdot_action a = {0};
    qdot_status status;

    if (one->square == QDOT_NIL)
        return qdot_fail(QDOT_EFAILED, "the equation of %.100s was not solved for p[%.100s]", name, name);
    status = qdot_action_find(session->scene, all, which, &a);
    if (status == QDOT_OK && a.verdict == QDOT_ACTION_NO_POINTS)
        status = number_of_action(session, one, value);
    else if (status == QDOT_OK)
        status = a.verdict == QDOT_ACTION_FOUND ? join_regimes(session, one->q, &a, value) : refuse_unbound(a.verdict, name);
    qdot_action_clear(&a);
    return status;
}

/* Of a cyclic coordinate: 2 pi |p| if all places have the period 2 pi in it, else there and back between the ends of its
 * domain. */
static qdot_status
action_of_cyclic(qdot_session *session, const qdot_separated *one, qdot_expr *value)
{
    qdot_pool *pool = session->pool;
    const qdot_scene *s = session->scene;
    const qdot_facts facts = qdot_scene_facts(s);
    const qdot_symbol *symbol = qdot_expr_symbol(pool, one->q);
    bool turns = true, seen = false;
    qdot_expr p, way;

    for (size_t i = 0; i < s->particles.n + s->bodies.n && turns; i++) {
        const size_t k = i - s->particles.n;
        const qdot_expr at[] = {i < s->particles.n ? s->particles.at[i].position : s->bodies.at[k].position,
                                i < s->particles.n ? QDOT_ZERO : s->bodies.at[k].rotation};

        for (int j = 0; j < 2; j++)
            for (uint32_t c = 0; c < (qdot_expr_is_scalar(pool, at[j]) ? 1 : qdot_expr_count(pool, at[j])); c++) {
                const qdot_expr e = qdot_expr_is_scalar(pool, at[j]) ? at[j] : qdot_expr_arg(pool, at[j], c);

                seen |= qdot_expr_contains(pool, e, one->q);
                turns = turns && (!qdot_expr_contains(pool, e, one->q) || qdot_is_angle(pool, e, one->q, &facts));
            }
    }
    if (!turns && (symbol->lo == QDOT_NIL || symbol->hi == QDOT_NIL))
        return refuse_unbound(QDOT_ACTION_UNBOUND, symbol->name);
    if (!turns)
        QDOT_TRY(qdot_answer_notice_once(session, "%s is reflected at the ends of its domain", symbol->name));
    if (turns && !seen)
        QDOT_TRY(qdot_answer_notice_once(session, "%s counts as an angle: no place is stated that tells", symbol->name));
    p = one->square == QDOT_NIL ? qdot_fun1(pool, QDOT_ABS, one->p) : qdot_add(pool, one->shift, qdot_sqrt(pool, one->square));
    way = turns ? QDOT_PI : qdot_sub(pool, symbol->hi, symbol->lo);
    return qdot_value_kind_give(pool, qdot_product(pool, 3, (qdot_expr[]){qdot_expr_int(pool, 2), way, p}), value);
}

qdot_status
qdot_call_action(qdot_session *session, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    qdot_separation x = {0};
    qdot_status status;

    if (!qdot_expr_is_coordinate(session->pool, args[0]))
        return qdot_fail(QDOT_ETYPE, "action(x) takes a coordinate");
    if (n == 2 && !qdot_expr_is_scalar(session->pool, args[1]))
        return qdot_fail(QDOT_ETYPE, "the energy in action(x, E) is a number, not %s", qdot_value_kind_words(session->pool, args[1]));
    if (n == 2 && (qdot_mech_holds(session->scene, args[1]) & (QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_TIME)))
        return qdot_fail(QDOT_EDOMAIN, "the energy in action(x, E) is constant: it holds no coordinate, velocity or t");
    status = qdot_session_separate(session, n == 2 ? args[1] : QDOT_NIL, &x);
    if (status == QDOT_OK && x.energy == QDOT_NIL)
        status = qdot_fail(QDOT_EINVAL, "H depends on t: the motion has no action variables");
    if (status == QDOT_OK && x.verdict != QDOT_SEPARATES)
        status = qdot_fail(QDOT_EFAILED, "%s", x.verdict == QDOT_SEPARATES_NOT
                                                   ? "the motion does not separate in these coordinates, so that none has an action of its own"
                                                   : "no separation was found in these coordinates");
    for (size_t i = 0; i < x.n && status == QDOT_OK; i++)
        if (x.of[i].q == args[0])
            status = x.of[i].cyclic ? action_of_cyclic(session, &x.of[i], value) : action_of_separated(session, &x, i, value);
    qdot_separation_clear(&x);
    return status;
}
