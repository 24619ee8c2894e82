/* units.c -- the facts about dimensions in a session, and the solver made of them. */
#include "lang/session/units.h"

#include "expr/build.h"
#include "expr/exact.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/unit.h"
#include "lang/session/measured.h"
#include "lang/session/member.h"
#include "lang/session/values.h"
#include "mech/scene/things.h"

void
qdot_units_clear(qdot_units *units)
{
    qdot_dimensions_free(units->known);
    qdot_free(units->facts.at);
    *units = (qdot_units){0};
}

bool
qdot_units_on(const qdot_session *session)
{
    return session->units->facts.n > 0;
}

qdot_status
qdot_units_begin(qdot_session *session)
{
    return qdot_units_on(session) ? QDOT_OK
                                  : qdot_vec_push(&session->units->facts, ((qdot_unit_fact){.kind = QDOT_FACT_BEGIN}));
}

void
qdot_units_back_to(qdot_session *session, size_t n)
{
    qdot_units *units = session->units;

    units->facts.n = units->facts.n < n ? units->facts.n : n;
    qdot_dimensions_free(units->known);
    units->known = NULL;
    units->done = 0;
}

/* --- the solver ------------------------------------------------------------------------ */

static const int energy[QDOT_BASES] = {2, 1, -2};

/* The Lagrangian that is stated, or found from a stated H; nil: none. */
static qdot_expr
stated_lagrangian(const qdot_session *session)
{
    const qdot_scene *s = session->scene;

    return s->higher_lagrangian != QDOT_NIL ? s->higher_lagrangian : s->lagrangian;
}

static qdot_expr
energy_unit(qdot_pool *pool)
{
    qdot_expr unit = QDOT_ONE;

    for (int k = 0; k < QDOT_BASES; k++)
        unit = qdot_mul(pool, unit, qdot_pow_int(pool, qdot_unit_symbol(pool, k), energy[k]));
    return unit;
}

/* An expression of the dimension of a multiplier: lambda f, times t for each derivative in the constraint f = 0, is an energy, or
 * what the stated L is; nil: the constraint is not known. */
static qdot_expr
like_multiplier(qdot_session *session, qdot_expr multiplier)
{
    const qdot_scene *s = session->scene;
    qdot_pool *pool = session->pool;
    const qdot_expr L = stated_lagrangian(session);
    qdot_expr f_t;
    size_t i = 0;

    while (i < s->constraints.n && s->constraints.at[i].multiplier != multiplier)
        i++;
    if (i == s->constraints.n || s->constraints.at[i].f == QDOT_ZERO)
        return QDOT_NIL;
    f_t = qdot_mul(pool, s->constraints.at[i].f, qdot_pow_int(pool, QDOT_T, (int64_t)s->constraints.at[i].kind));
    return qdot_div(pool, L != QDOT_NIL ? L : energy_unit(pool), f_t);
}

/* An expression of the dimension of a symbol: what one of a.EXPR stands for; for the time of an event, t; for p[q] L t/q where
 * L is stated. */
static qdot_expr
stands_for(const void *user, qdot_expr symbol)
{
    qdot_session *session = (qdot_session *)(uintptr_t)user;
    const qdot_symbol s = *qdot_expr_symbol(session->pool, symbol);
    const qdot_member *member = qdot_member_find(session, symbol);
    const qdot_measured *measured = member == NULL ? qdot_measured_find(session, symbol) : NULL;
    const qdot_expr L = stated_lagrangian(session);

    if (s.class == QDOT_MULTIPLIER)
        return like_multiplier(session, symbol);
    if (s.class == QDOT_MOMENTUM)
        return L == QDOT_NIL ? QDOT_NIL : qdot_mul(session->pool, L, qdot_div(session->pool, QDOT_T, s.base));
    if (member != NULL)
        return member->value;
    return measured != NULL && measured->origin.kind == QDOT_ORIGIN_EVENT ? QDOT_T : QDOT_NIL;
}

static qdot_status
carry_out_fact(qdot_dimensions *known, const qdot_unit_fact *fact, const char *format)
{
    switch ((qdot_unit_fact_kind)fact->kind) {
    case QDOT_FACT_VISIT: return qdot_dimensions_visit(known, fact->a);
    case QDOT_FACT_JOIN: return qdot_dimensions_join(known, fact->a, fact->b, format);
    case QDOT_FACT_FIX: return qdot_dimensions_fix(known, fact->a, fact->is, format);
    default: return QDOT_OK;
    }
}

/* Whether e is a symbol of which the fact is known, or a time derivative of one. */
static bool
has_fact(const qdot_session *session, qdot_expr e, qdot_unit_fact_kind kind)
{
    const qdot_symbol *s = qdot_expr_symbol(session->pool, e);
    const qdot_units *units = session->units;

    if (s == NULL)
        return false;
    e = s->class == QDOT_COORD && s->base != QDOT_NIL ? s->base : e;
    for (size_t i = 0; i < units->facts.n; i++)
        if (units->facts.at[i].kind == kind && units->facts.at[i].a == e)
            return true;
    return false;
}

/* Make the solver from the facts that it does not have yet. */
static qdot_status
bring_up_to_date(qdot_session *session)
{
    qdot_units *units = session->units;

    if (units->known == NULL)
        units->known = qdot_dimensions_new(session->pool, stands_for, session);
    if (units->known == NULL)
        return QDOT_ENOMEM;
    for (; units->done < units->facts.n; units->done++)
        QDOT_TRY(carry_out_fact(units->known, &units->facts.at[units->done], "%s is %s"));
    return QDOT_OK;
}

/* Carry out a new fact, and keep it if it told anything. */
static qdot_status
add_fact(qdot_session *session, const qdot_unit_fact *fact, const char *format)
{
    qdot_units *units = session->units;
    qdot_status status;
    size_t rank;

    if (!qdot_units_on(session))
        return QDOT_OK;
    QDOT_TRY(bring_up_to_date(session));
    rank = qdot_dimensions_rank(units->known);
    status = carry_out_fact(units->known, fact, format);
    units->disagreed = status == QDOT_ETYPE;
    QDOT_TRY(status);
    if (qdot_dimensions_rank(units->known) == rank && fact->kind < QDOT_FACT_ANGLE)
        return QDOT_OK;
    QDOT_TRY(qdot_vec_push(&units->facts, *fact));
    units->done++;
    return QDOT_OK;
}

bool
qdot_units_take_disagreement(qdot_session *session)
{
    const bool disagreed = session->units->disagreed;

    session->units->disagreed = false;
    return disagreed;
}

qdot_status
qdot_units_visit(qdot_session *session, qdot_expr e)
{
    return add_fact(session, &(qdot_unit_fact){.kind = QDOT_FACT_VISIT, .a = e}, NULL);
}

qdot_status
qdot_units_join(qdot_session *session, qdot_expr a, qdot_expr b, const char *format)
{
    return add_fact(session, &(qdot_unit_fact){.kind = QDOT_FACT_JOIN, .a = a, .b = b}, format);
}

qdot_status
qdot_units_fix(qdot_session *session, qdot_expr e, qdot_dimension is, const char *format)
{
    return add_fact(session, &(qdot_unit_fact){.kind = QDOT_FACT_FIX, .a = e, .is = is}, format);
}

qdot_status
qdot_units_energy(qdot_session *session, qdot_expr e, const char *format)
{
    const qdot_expr L = stated_lagrangian(session);

    return L != QDOT_NIL ? qdot_units_join(session, e, L, format) : qdot_units_fix(session, e, qdot_dimension_make(energy), format);
}

qdot_status
qdot_units_angle(qdot_session *session, qdot_expr symbol)
{
    return add_fact(session, &(qdot_unit_fact){.kind = QDOT_FACT_ANGLE, .a = symbol}, NULL);
}

/* The term of a sum in the argument of a sine is an angle where it is a symbol, or a number times one. */
static qdot_status
note_angle(qdot_session *session, qdot_expr term)
{
    const qdot_pool *pool = session->pool;
    const qdot_symbol *s;

    if (qdot_expr_kind(pool, term) == QDOT_PROD && qdot_expr_count(pool, term) == 3 && qdot_expr_arg(pool, term, 2) == QDOT_ONE)
        term = qdot_expr_arg(pool, term, 1);
    s = qdot_expr_symbol(pool, term);
    if (s == NULL || s->base != QDOT_NIL || (s->class != QDOT_COORD && s->class != QDOT_PARAM) ||
        has_fact(session, term, QDOT_FACT_ANGLE))
        return QDOT_OK;
    return qdot_units_angle(session, term);
}

qdot_status
qdot_units_angles_in(qdot_session *session, qdot_expr argument)
{
    const qdot_pool *pool = session->pool;

    if (!qdot_units_on(session))
        return QDOT_OK;
    if (qdot_expr_kind(pool, argument) != QDOT_SUM)
        return note_angle(session, argument);
    for (uint32_t i = 1; i < qdot_expr_count(pool, argument); i += 2)
        QDOT_TRY(note_angle(session, qdot_expr_arg(pool, argument, i)));
    return QDOT_OK;
}

qdot_status
qdot_units_time(qdot_session *session, qdot_expr e)
{
    static const int time[QDOT_BASES] = {0, 0, 1};

    return qdot_expr_is_constant(session->pool, e)
               ? QDOT_OK
               : qdot_units_fix(session, e, qdot_dimension_make(time), "a time belongs here, not %s");
}

qdot_status
qdot_units_scaled(qdot_session *session, qdot_expr symbol)
{
    return add_fact(session, &(qdot_unit_fact){.kind = QDOT_FACT_SCALED, .a = symbol}, NULL);
}

qdot_dimension_state
qdot_units_of(qdot_session *session, qdot_expr e, qdot_dimension *dimension)
{
    *dimension = qdot_dimension_none();
    if (!qdot_units_on(session) || bring_up_to_date(session) != QDOT_OK)
        return QDOT_DIMENSION_NONE;
    return qdot_dimensions_of(session->units->known, e, dimension);
}

/* --- units of numbers ------------------------------------------------------------------- */

/* The expression whose value the number e of a run is, such as value(theta', 1); others are themselves. */
static qdot_expr
expression_behind(const qdot_session *session, qdot_expr e)
{
    const qdot_pool *pool = session->pool;
    const qdot_measured *measured;
    const qdot_member *member;
    qdot_expr number = e;

    for (uint32_t i = 1; qdot_expr_kind(pool, e) == QDOT_PROD && i < qdot_expr_count(pool, e); i += 2) {
        if (qdot_unit_symbol_base(pool, qdot_expr_arg(pool, e, i)) >= 0)
            continue;
        if (number != e || qdot_expr_arg(pool, e, i + 1) != QDOT_ONE)
            return e;
        number = qdot_expr_arg(pool, e, i);
    }
    measured = qdot_measured_find(session, number);
    member = qdot_member_find(session, number);
    if (measured != NULL && measured->origin.e != QDOT_NIL)
        return measured->origin.e;
    return member != NULL ? member->value : e;
}

bool
qdot_units_is_scaled(const qdot_session *session, qdot_expr symbol)
{
    return has_fact(session, symbol, QDOT_FACT_SCALED);
}

qdot_status
qdot_units_transfer(qdot_session *from, qdot_expr symbol, qdot_session *to, qdot_expr copy)
{
    qdot_dimension is;

    if (!qdot_units_on(from))
        return QDOT_OK;
    QDOT_TRY(qdot_units_begin(to));
    if (qdot_units_of(from, symbol, &is) == QDOT_DIMENSION_KNOWN)
        QDOT_TRY(qdot_units_fix(to, copy, is, "%s is %s"));
    if (has_fact(from, symbol, QDOT_FACT_ANGLE))
        QDOT_TRY(qdot_units_angle(to, copy));
    return has_fact(from, symbol, QDOT_FACT_SCALED) ? qdot_units_scaled(to, copy) : QDOT_OK;
}

/* An angle, or its first or second rate. */
static const struct angle {
    const char *unit, *words;
} angles[] = {{"rad", "an angle"}, {"rad/s", "an angular velocity"}, {"rad/s^2", "an angular acceleration"}};

/* Which of these e is, of the dimension `is`; NULL: none. */
static const struct angle *
find_angle(const qdot_session *session, qdot_expr e, qdot_dimension is)
{
    const qdot_exponent time = is.of[2];

    for (int i = 0; i < QDOT_BASES; i++)
        if (i != 2 && is.of[i].n != 0)
            return NULL;
    return has_fact(session, expression_behind(session, e), QDOT_FACT_ANGLE) && time.n <= 0 && time.n >= -2 && time.d == 1 ? &angles[-time.n] : NULL;
}

void
qdot_units_label(qdot_session *session, qdot_expr e, qdot_text *out)
{
    const struct angle *angle;
    qdot_dimension is;

    if (qdot_units_of(session, e, &is) != QDOT_DIMENSION_KNOWN)
        return;
    angle = find_angle(session, e, is);
    if (angle != NULL)
        qdot_text_add(out, angle->unit);
    else
        qdot_dimension_unit(is, out);
}

qdot_status
qdot_units_label_of(qdot_session *session, qdot_expr e, char **label)
{
    qdot_text text = {0};
    qdot_status status;

    qdot_units_label(session, e, &text);
    status = qdot_text_status(&text);
    *label = status == QDOT_OK && text.n > 0 ? text.at : NULL;
    if (*label == NULL)
        qdot_text_clear(&text);
    return status;
}

void
qdot_units_in_brackets(qdot_session *session, qdot_expr e, qdot_text *out)
{
    qdot_text unit = {0};

    qdot_units_label(session, e, &unit);
    if (unit.n > 0)
        qdot_text_format(out, " [%s]", qdot_text_str(&unit));
    out->failed = out->failed || unit.failed;
    qdot_text_clear(&unit);
}

qdot_dimension_state
qdot_units_words(qdot_session *session, qdot_expr e, qdot_text *out)
{
    qdot_dimension is;
    const qdot_dimension_state state = qdot_units_of(session, e, &is);
    const struct angle *angle = state == QDOT_DIMENSION_KNOWN ? find_angle(session, e, is) : NULL;

    if (angle != NULL)
        qdot_text_add(out, angle->words);
    else if (state == QDOT_DIMENSION_KNOWN)
        qdot_dimension_words(is, out);
    else if (state == QDOT_DIMENSION_FREE)
        qdot_dimensions_words(session->units->known, e, out);
    return state;
}

qdot_status
qdot_units_groups(qdot_session *session, size_t n, const qdot_expr *x, size_t *count, int32_t **power)
{
    *power = NULL;
    QDOT_TRY(bring_up_to_date(session));
    return qdot_dimensions_groups(session->units->known, n, x, count, power);
}

/* Add what was declared before the first unit that has a dimension: a scene of numbers may have angles in degrees. */
static qdot_status
look_back(qdot_session *session)
{
    const qdot_units *units = session->units;

    for (size_t i = 0; i < units->facts.n; i++)
        if (units->facts.at[i].kind == QDOT_FACT_SCENE)
            return QDOT_OK;
    QDOT_TRY(add_fact(session, &(qdot_unit_fact){.kind = QDOT_FACT_SCENE}, NULL));
    return qdot_units_of_scene(session);
}

qdot_status
qdot_units_base(qdot_session *session, qdot_dimension dimension, qdot_expr *unit)
{
    qdot_pool *pool = session->pool;
    qdot_status status = qdot_units_begin(session);

    *unit = QDOT_ONE;
    if (status == QDOT_OK && !qdot_dimension_is_none(dimension))
        status = look_back(session);
    for (int i = 0; i < QDOT_BASES && status == QDOT_OK; i++) {
        const qdot_exponent x = dimension.of[i];
        const qdot_expr base = x.n != 0 ? qdot_unit_symbol(pool, i) : QDOT_NIL;

        if (base == QDOT_NIL)
            continue;
        if (qdot_session_value_set(session, base) == QDOT_NIL)
            qdot_session_set(session, base, QDOT_ONE, &status);
        *unit = qdot_mul(pool, *unit, qdot_pow(pool, base, qdot_expr_ratio(pool, x.n, x.d)));
    }
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

typedef struct {
    qdot_session *session;
    qdot_expr unit;
} rate;

static qdot_expr
with_rate(qdot_pool *pool, qdot_expr e, void *user)
{
    const rate *r = user;
    const bool number = qdot_expr_is_constant(pool, e) || qdot_measured_occurs(r->session, e);

    return number && !qdot_expr_has_units(pool, e) ? qdot_mul(pool, e, r->unit) : e;
}

qdot_status
qdot_units_give_rate(qdot_session *session, qdot_expr *value)
{
    static const int exponent[QDOT_BASES] = {0, 0, -1};
    rate r = {.session = session};

    if (!qdot_units_on(session))
        return QDOT_OK;
    QDOT_TRY(qdot_units_base(session, qdot_dimension_make(exponent), &r.unit));
    *value = qdot_value_map(session->pool, *value, with_rate, &r);
    return qdot_pool_check(session->pool);
}
