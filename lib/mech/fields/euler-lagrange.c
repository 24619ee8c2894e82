/* euler-lagrange.c -- the equations of a density in fields, and its energy-momentum tensor. */
#include "mech/fields/euler-lagrange.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/scene/access.h"

/* A field with what its density is differentiated by. */
typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    qdot_expr density, field;
    uint32_t m;
    const qdot_expr *variables; /* [m] */
    bool is_coordinate;
    bool along_motion; /* t is the only variable: coordinates move with it */
} variation;

static const char *
symbol_name(const variation *v, qdot_expr x)
{
    const qdot_symbol *symbol = qdot_expr_symbol(v->pool, x);

    return symbol != NULL ? symbol->name : "this";
}

static const char *
field_name(const variation *v)
{
    if (v->is_coordinate)
        return symbol_name(v, v->field);
    return qdot_ufun_get(v->pool, qdot_expr_node(v->pool, v->field)->op)->name;
}

static bool
is_variable(const variation *v, qdot_expr x)
{
    return qdot_expr_place(v->m, v->variables, x) < v->m;
}

/* --- checks ------------------------------------------------------------------------------ */

/* Whether a field of one kind is given: a coordinate, or an undefined function of symbols, not a derivative. */
static bool
field_is_sound(variation *v)
{
    qdot_pool *pool = v->pool;
    uint32_t n = qdot_expr_count(pool, v->field) / 2;

    v->is_coordinate = qdot_expr_is_coordinate(pool, v->field);
    if (v->is_coordinate)
        return true;
    for (uint32_t i = 0; qdot_expr_kind(pool, v->field) == QDOT_UFUN && i < n; i++) {
        if (qdot_expr_arg(pool, v->field, n + i) != QDOT_ZERO ||
            qdot_expr_kind(pool, qdot_expr_arg(pool, v->field, i)) != QDOT_SYM)
            break;
        if (i + 1 == n)
            return true;
    }
    qdot_fail(QDOT_ETYPE, "a field is an undefined function at its arguments, or a coordinate");
    (void)qdot_hint("function y(x, t)");
    qdot_pool_fail(pool);
    return false;
}

/* Whether the variables are different symbols, each an argument of the field. */
static bool
variables_are_sound(const variation *v)
{
    uint32_t n = qdot_expr_count(v->pool, v->field) / 2;

    for (uint32_t i = 0; i < v->m; i++) {
        qdot_expr x = v->variables[i];
        bool argument = v->is_coordinate && x == QDOT_T;

        if (qdot_expr_kind(v->pool, x) != QDOT_SYM) {
            qdot_mech_fail(v->s, QDOT_ETYPE, "the variables of the fields are symbols");
            return false;
        }
        for (uint32_t k = 0; !v->is_coordinate && k < n; k++)
            argument = argument || qdot_expr_arg(v->pool, v->field, k) == x;
        if (!argument) {
            qdot_mech_fail(v->s, QDOT_EINVAL, "`%.100s` does not depend on `%.100s`", field_name(v), symbol_name(v, x));
            return false;
        }
        if (qdot_expr_place(i, v->variables, x) < i) {
            qdot_mech_fail(v->s, QDOT_EINVAL, "the variable `%.200s` is named twice", symbol_name(v, x));
            return false;
        }
    }
    return true;
}

/* Whether the density holds nothing whose total derivatives are not known: q' of a coordinate beside a field in
 * space, or a coordinate that is no variable although t is one. */
static bool
density_is_sound(const variation *v)
{
    qdot_pool *pool = v->pool;
    qdot_expr atoms;

    if (!qdot_expr_is_scalar(pool, v->density)) {
        qdot_mech_fail(v->s, QDOT_ETYPE, "a density is a number, not a vector, list or equation");
        return false;
    }
    if (v->along_motion)
        return true;
    atoms = qdot_expr_atoms(pool, v->density, false);
    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(pool, atoms); i++) {
        qdot_expr x = qdot_expr_arg(pool, atoms, i);
        const qdot_symbol *symbol = qdot_expr_symbol(pool, x);

        if (symbol == NULL || symbol->class != QDOT_COORD || is_variable(v, x))
            continue;
        if (symbol->order > 0 || is_variable(v, QDOT_T)) {
            qdot_mech_fail(v->s, QDOT_EINVAL, "the density holds `%.200s`, which is none of the variables", symbol->name);
            return false;
        }
    }
    return atoms != QDOT_NIL;
}

/* Whether `atom` is a derivative of the field, at the field's own arguments and by variables only (*is); false if
 * the density has the field in another way. */
static bool
is_derivative_of_field(const variation *v, qdot_expr atom, bool *is)
{
    qdot_pool *pool = v->pool;
    uint32_t n = qdot_expr_count(pool, v->field) / 2;

    if (v->is_coordinate) {
        const qdot_symbol *symbol = qdot_expr_symbol(pool, atom);

        *is = atom == v->field || (symbol != NULL && symbol->class == QDOT_COORD && symbol->order > 0 &&
                                   symbol->base == v->field);
        return true;
    }
    *is = qdot_expr_kind(pool, atom) == QDOT_UFUN &&
          qdot_expr_node(pool, atom)->op == qdot_expr_node(pool, v->field)->op;
    for (uint32_t i = 0; *is && i < n; i++) {
        qdot_expr x = qdot_expr_arg(pool, v->field, i);

        if (qdot_expr_arg(pool, atom, i) != x) {
            qdot_mech_fail(v->s, QDOT_EINVAL, "the density has `%.200s` at other arguments", field_name(v));
            return false;
        }
        if (qdot_expr_arg(pool, atom, n + i) != QDOT_ZERO && !is_variable(v, x)) {
            qdot_mech_fail(v->s, QDOT_EINVAL, "the density differentiates `%.100s` by `%.100s`, which is none of the variables",
                           field_name(v), symbol_name(v, x));
            return false;
        }
    }
    return true;
}

static bool
variation_begin(variation *v)
{
    if (v->density == QDOT_NIL || v->field == QDOT_NIL || !field_is_sound(v) || !variables_are_sound(v))
        return false;
    v->along_motion = v->m == 1 && v->variables[0] == QDOT_T;
    for (uint32_t i = 0; !v->is_coordinate && i < qdot_expr_count(v->pool, v->field) / 2; i++)
        if (qdot_expr_is_coordinate(v->pool, qdot_expr_arg(v->pool, v->field, i)))
            v->along_motion = false;
    return density_is_sound(v);
}

/* --- derivatives --------------------------------------------------------------------------- */

/* dL/da, a the field or one of its derivatives, all others held. */
static qdot_expr
by_derivative(const variation *v, qdot_expr a)
{
    qdot_pool *pool = v->pool;
    qdot_expr mark = qdot_symbol_get(pool, QDOT_FORMAL, "field derivative"), e;

    if (qdot_expr_kind(pool, a) == QDOT_SYM)
        return qdot_diff(pool, v->density, a);
    e = qdot_diff(pool, qdot_subs(pool, v->density, 1, &a, &mark), mark);
    return qdot_subs(pool, e, 1, &mark, &a);
}

/* The order of the derivative `atom` by the k-th argument of the field. */
static uint32_t
order_of(const variation *v, qdot_expr atom, uint32_t k)
{
    int64_t order = 0;

    if (v->is_coordinate)
        return atom == v->field ? 0 : qdot_expr_symbol(v->pool, atom)->order;
    (void)qdot_expr_to_int(v->pool, qdot_expr_arg(v->pool, atom, qdot_expr_count(v->pool, v->field) / 2 + k), &order);
    return (uint32_t)order;
}

static uint32_t
count_arguments(const variation *v)
{
    return v->is_coordinate ? 1 : qdot_expr_count(v->pool, v->field) / 2;
}

/* (-1)^(|J| + 1) d_J (dL/dy_J) for one derivative y_J. */
static qdot_expr
term_of_derivative(const variation *v, qdot_expr atom)
{
    qdot_expr e = by_derivative(v, atom);
    bool negative = true;

    for (uint32_t k = 0; k < count_arguments(v); k++)
        for (uint32_t order = order_of(v, atom, k); order > 0 && e != QDOT_NIL; order--) {
            e = v->along_motion ? qdot_ddt(v->pool, e) : qdot_diff(v->pool, e, qdot_expr_arg(v->pool, v->field, k));
            negative = !negative;
        }
    return negative ? qdot_neg(v->pool, e) : e;
}

qdot_expr
qdot_fields_euler_lagrange(qdot_scene *s, qdot_expr density, qdot_expr field, uint32_t m, const qdot_expr *variables)
{
    variation v = {.s = s, .pool = s->pool, .density = density, .field = field, .m = m, .variables = variables};
    qdot_expr atoms, sum = QDOT_ZERO;

    if (!variation_begin(&v))
        return QDOT_NIL;
    atoms = qdot_expr_atoms(v.pool, density, true);
    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(v.pool, atoms); i++) {
        qdot_expr atom = qdot_expr_arg(v.pool, atoms, i);
        bool is;

        if (!is_derivative_of_field(&v, atom, &is))
            return QDOT_NIL;
        if (is)
            sum = qdot_add(v.pool, sum, term_of_derivative(&v, atom));
    }
    if (atoms == QDOT_NIL || sum == QDOT_NIL)
        return QDOT_NIL;
    return qdot_rel(v.pool, QDOT_EQ, qdot_mech_tidy(s, sum), QDOT_ZERO);
}

/* --- energy and momentum --------------------------------------------------------------------- */

/* Add (dL/d(d_i y)) d_k y of one field to each entry [m*m]. */
static bool
add_field(const variation *v, qdot_expr *entries)
{
    qdot_pool *pool = v->pool;
    qdot_expr atoms = qdot_expr_atoms(pool, v->density, true);

    for (uint32_t a = 0; atoms != QDOT_NIL && a < qdot_expr_count(pool, atoms); a++) {
        qdot_expr atom = qdot_expr_arg(pool, atoms, a), slope;
        uint32_t order = 0, by = 0;
        bool is;

        if (!is_derivative_of_field(v, atom, &is))
            return false;
        for (uint32_t k = 0; is && k < count_arguments(v); k++)
            if (order_of(v, atom, k) > 0) {
                order += order_of(v, atom, k);
                by = (uint32_t)qdot_expr_place(v->m, v->variables,
                                               v->is_coordinate ? QDOT_T : qdot_expr_arg(pool, v->field, k));
            }
        if (order > 1) {
            qdot_mech_fail(v->s, QDOT_ENOTBUILT, "not built yet: energy_momentum of densities with second derivatives");
            return false;
        }
        if (order == 0)
            continue;
        slope = by_derivative(v, atom);
        for (uint32_t k = 0; k < v->m; k++) {
            qdot_expr y_k = v->is_coordinate ? qdot_symbol_jet(pool, v->field, 1)
                                             : qdot_diff(pool, v->field, v->variables[k]);

            entries[by * v->m + k] = qdot_add(pool, entries[by * v->m + k], qdot_mul(pool, slope, y_k));
        }
    }
    return atoms != QDOT_NIL;
}

qdot_expr
qdot_fields_energy_momentum(qdot_scene *s, qdot_expr density, uint32_t n, const qdot_expr *fields, uint32_t m,
                            const qdot_expr *variables)
{
    variation v = {.s = s, .pool = s->pool, .density = density, .m = m, .variables = variables};
    qdot_expr *entries = qdot_calloc((size_t)m * m + 1, sizeof *entries), result = QDOT_NIL;
    bool sound = entries != NULL;

    if (!sound)
        return qdot_pool_fail(s->pool);
    for (uint32_t i = 0; i < m * m; i++)
        entries[i] = i % (m + 1) == 0 ? qdot_neg(s->pool, density) : QDOT_ZERO;
    for (uint32_t i = 0; sound && i < n; i++) {
        v.field = fields[i];
        sound = variation_begin(&v) && add_field(&v, entries);
    }
    if (sound) {
        for (uint32_t i = 0; i < m * m; i++)
            entries[i] = qdot_mech_tidy(s, entries[i]);
        result = m == 1 ? entries[0] : qdot_matrix(s->pool, m, m, entries);
    }
    qdot_free(entries);
    return result;
}
