/* collision.c -- writes a scene in coordinates in which a two-body collision is regular, and expressions in these. */
#include "mech/coordinates/collision.h"

#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/scene/access.h"
#include "mech/scene/scene.h"

enum { MOST = QDOT_COLLISION_MOST, PARTS = 4 };

void
qdot_collision_clear(qdot_collision *c)
{
    qdot_scene_free(c->scene);
    qdot_free(c->q0.at);
    qdot_free(c->v0.at);
    qdot_free(c->from.at);
    qdot_free(c->to.at);
    *c = (qdot_collision){0};
}

/* The regularised scene while it is being made: symbols, and the equations of the colliding pair. */
typedef struct {
    qdot_collision *c;
    qdot_pool *pool;
    qdot_scene *s;
    const qdot_collision_equations *of;
    size_t d, m; /* numbers of components: of x (relative position), and of u */
    int sign;    /* the sign in x = sign L(u) u; it is -1 only if d = 1 */
    int side;    /* the sign of x[0] (of the relative position) at the start */
    qdot_expr u[PARTS], energy, R;
    qdot_expr x[MOST], rate[MOST];      /* [d] symbols for x and dx/dt */
    qdot_expr in_u[MOST], rate_u[MOST]; /* [d] x and dx/dt in the new coordinates u: L u, 2 L u'/R */
    qdot_expr strength;                 /* strength k of the force k x/R^3 */
    qdot_expr P[MOST];                  /* [d] the rest of d2x/dt2 = -k x/R^3 + P, in terms of x, dx/dt, R */
    /* [n]: fields with an entry for each given coordinate */
    qdot_expr *Q, *w; /* [n] regular coordinates Q and their rates w; nil for a pivot (a coordinate that x replaces) */
    qdot_expr *value; /* given coordinates in terms of x and Q */
    qdot_expr *speed; /* dq/dt of the given coordinates in terms of dx/dt and w' */
    qdot_expr *pull;  /* [n d] the coefficients c in d2q/dt2 = c.x/R^3 + rest */
    qdot_expr *rest;  /* [n] the regular part of d2q/dt2 */
} work;

/* --- auxiliary formulas ---------------------------------------------------------------------------- */

static qdot_expr
multiply_expressions(const work *k, qdot_expr a, qdot_expr b)
{
    return qdot_mul(k->pool, a, b);
}

static qdot_expr
velocity_symbol(const work *k, qdot_expr q)
{
    return qdot_symbol_jet(k->pool, q, 1);
}

static qdot_expr
dot_product(const work *k, size_t n, const qdot_expr *a, const qdot_expr *b)
{
    qdot_expr sum = QDOT_ZERO;

    for (size_t i = 0; i < n; i++)
        sum = qdot_add(k->pool, sum, multiply_expressions(k, a[i], b[i]));
    return sum;
}

/* Entry (i, j) of the Kustaanheimo-Stiefel matrix L(u): plus or minus a component of u. */
static qdot_expr
ks_matrix_entry(const work *k, size_t i, size_t j)
{
    static const int index[MOST][PARTS] = {{1, -2, -3, 4}, {2, 1, -4, -3}, {3, 4, 1, 2}};
    const int at = index[i][j];
    const qdot_expr u = k->u[(at < 0 ? -at : at) - 1];

    return at * k->sign < 0 ? qdot_neg(k->pool, u) : u;
}

static qdot_expr
ks_matrix_row(const work *k, size_t i, const qdot_expr *b)
{
    qdot_expr sum = QDOT_ZERO;

    for (size_t j = 0; j < k->m; j++)
        sum = qdot_add(k->pool, sum, multiply_expressions(k, ks_matrix_entry(k, i, j), b[j]));
    return sum;
}

static qdot_expr
ks_matrix_column(const work *k, size_t j, const qdot_expr *b)
{
    qdot_expr sum = QDOT_ZERO;

    for (size_t i = 0; i < k->d; i++)
        sum = qdot_add(k->pool, sum, multiply_expressions(k, ks_matrix_entry(k, i, j), b[i]));
    return sum;
}

static void
record_hindrance(work *k, const char *why)
{
    if (k->c->hindrance[0] == '\0')
        snprintf(k->c->hindrance, sizeof k->c->hindrance, "%.180s", why);
}

static bool
has_hindrance(const work *k)
{
    return k->c->hindrance[0] != '\0';
}

/* Whether e contains a negative power of `base`. */
static bool
contains_negative_power(qdot_pool *pool, qdot_expr e, qdot_expr base)
{
    bool found = false;
    qdot_walk w;

    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return true;
    for (size_t i = 0; i < w.n; i++)
        for (uint32_t f = 1; qdot_expr_kind(pool, w.at[i]) == QDOT_PROD &&
                             f + 1 < qdot_expr_count(pool, w.at[i]);
             f += 2)
            found |= qdot_expr_arg(pool, w.at[i], f) == base &&
                     qdot_expr_is_negative(pool, qdot_expr_arg(pool, w.at[i], f + 1));
    qdot_walk_end(&w);
    return found;
}

/* --- new coordinates ------------------------------------------------------------------------------- */

static qdot_expr
make_coordinate(work *k, const char *what, const char *of)
{
    char name[120];
    qdot_expr q;

    snprintf(name, sizeof name, "%s#%.80s", what, of);
    q = qdot_symbol_get(k->pool, QDOT_COORD, name);
    if (q != QDOT_NIL && qdot_scene_coordinate(k->c->scene, q) != QDOT_OK)
        return qdot_pool_fail(k->pool);
    return q;
}

static qdot_expr
make_formal_symbol(const work *k, const char *what, size_t i)
{
    char name[40];

    snprintf(name, sizeof name, "%s#%zu", what, i);
    return qdot_symbol_get(k->pool, QDOT_FORMAL, name);
}

static bool
is_replaced_by_distance(const work *k, size_t i)
{
    for (size_t j = 0; j < k->d; j++)
        if (k->c->pair.pivot[j] == i)
            return true;
    return false;
}

static void
make_symbols(work *k)
{
    char number[20];

    k->d = k->c->pair.d;
    k->m = k->d == 3 ? 4 : k->d;
    for (size_t j = 0; j < k->m; j++) {
        snprintf(number, sizeof number, "%zu", j + 1);
        k->u[j] = make_coordinate(k, "u", number);
    }
    k->c->time = make_coordinate(k, "t", "");
    k->energy = make_coordinate(k, "h", "");
    k->R = k->c->R = make_formal_symbol(k, "distance", 0);
    qdot_symbol_domain(k->pool, k->R, QDOT_ZERO, true, QDOT_NIL, false);
    for (size_t i = 0; i < k->d; i++) {
        qdot_expr v[PARTS];

        for (size_t j = 0; j < k->m; j++)
            v[j] = velocity_symbol(k, k->u[j]);
        k->x[i] = k->d > 1 ? make_formal_symbol(k, "x", i)
                           : multiply_expressions(k, qdot_expr_int(k->pool, k->sign), k->R);
        k->rate[i] = make_formal_symbol(k, "rate", i);
        k->in_u[i] = qdot_expand(k->pool, ks_matrix_row(k, i, k->u));
        k->rate_u[i] =
            qdot_div(k->pool, multiply_expressions(k, qdot_expr_int(k->pool, 2), ks_matrix_row(k, i, v)), k->R);
    }
    for (size_t i = 0; i < k->of->n; i++) {
        const char *name = qdot_expr_symbol(k->pool, k->of->q[i])->name;

        if (is_replaced_by_distance(k, i))
            continue;
        k->Q[i] = make_coordinate(k, "free", name);
        k->w[i] = make_coordinate(k, "way", name);
    }
}

/* The expression e in terms of x and the given coordinates, after elimination of those that x replaces (pivots). */
static qdot_expr
eliminate_pivots(const work *k, qdot_expr e)
{
    const qdot_collision_pair *pair = &k->c->pair;
    qdot_expr from[MOST], to[MOST];

    for (size_t j = k->d; j-- > 0;) {
        from[j] = k->of->q[pair->pivot[j]];
        to[j] = qdot_add(k->pool, from[j], qdot_sub(k->pool, k->x[j], pair->x[j]));
        to[j] = qdot_expand(
            k->pool, qdot_subs(k->pool, to[j], k->d - j - 1, from + j + 1, to + j + 1));
    }
    return qdot_subs(k->pool, e, k->d, from, to);
}

/* --- the equations of motion ----------------------------------------------------------------------- */

/* Split each acceleration, written in x and R, into its singular part c.x/R^3 and the rest. */
static void
split_accelerations(work *k)
{
    const int64_t power = k->d > 1 ? 3 : 2;

    for (size_t i = 0; i < k->of->n && !has_hindrance(k); i++) {
        qdot_expr e =
            qdot_collision_put_distance(k->pool, k->of->accels[i], &k->c->pair, k->R);
        qdot_expr most, left;

        e = eliminate_pivots(k, e);
        e = qdot_expand(k->pool, multiply_expressions(k, e, qdot_pow_int(k->pool, k->R, power)));
        if (e == QDOT_NIL || contains_negative_power(k->pool, e, k->R)) {
            record_hindrance(k, "the forces grow faster than 1/r^2");
            return;
        }
        left = most = qdot_subs(k->pool, e, 1, &k->R, (qdot_expr[]){QDOT_ZERO});
        for (size_t j = 0; j < k->d; j++) {
            qdot_expr *c = k->pull + i * k->d + j;

            *c = k->d > 1 ? qdot_diff(k->pool, most, k->x[j])
                          : multiply_expressions(k, qdot_expr_int(k->pool, k->sign), most);
            if (k->d > 1)
                left = qdot_sub(k->pool, left, multiply_expressions(k, *c, k->x[j]));
            if (qdot_expr_kind(k->pool, *c) != QDOT_NUM)
                record_hindrance(k, "the force between the points is not -k/r^2");
        }
        if (k->d > 1 && qdot_expand(k->pool, left) != QDOT_ZERO)
            record_hindrance(k, "the force between the points is not -k/r^2");
        k->rest[i] = qdot_expand(k->pool, multiply_expressions(k, qdot_sub(k->pool, e, most),
                                                               qdot_pow_int(k->pool, k->R, -power)));
    }
}

/* Find the strength k of the attraction of the pair, and P, the rest of d2x/dt2 = -k x/R^3 + P. */
static void
find_strength_of_attraction(work *k)
{
    const qdot_collision_pair *pair = &k->c->pair;

    for (size_t i = 0; i < k->d && !has_hindrance(k); i++) {
        k->P[i] = QDOT_ZERO;
        for (size_t l = 0; l < k->d; l++) {
            qdot_expr c = QDOT_ZERO;

            for (size_t j = 0; j < k->of->n; j++)
                c = qdot_add(k->pool, c,
                             multiply_expressions(k, qdot_diff(k->pool, pair->x[i], k->of->q[j]),
                                                  k->pull[j * k->d + l]));
            if (i == 0 && l == 0)
                k->strength = qdot_neg(k->pool, c);
            if (c != (i == l ? qdot_neg(k->pool, k->strength) : QDOT_ZERO))
                record_hindrance(k, "the force between the points is not -k/r^2");
        }
        for (size_t j = 0; j < k->of->n; j++)
            k->P[i] = qdot_add(
                k->pool, k->P[i],
                multiply_expressions(k, qdot_diff(k->pool, pair->x[i], k->of->q[j]), k->rest[j]));
    }
    if (!has_hindrance(k) &&
        (k->strength == QDOT_ZERO || qdot_expr_is_negative(k->pool, k->strength)))
        record_hindrance(k, "the points do not attract each other");
}

/* The difference c.x/k between a given coordinate and the regular coordinate Q that replaces it. */
static qdot_expr
offset_from_regular(const work *k, size_t i, const qdot_expr *x)
{
    return qdot_div(k->pool, dot_product(k, k->d, k->pull + i * k->d, x), k->strength);
}

/* Express q and dq/dt of the given coordinates in the new ones. */
static void
express_coordinates(work *k)
{
    const qdot_collision_pair *pair = &k->c->pair;

    for (size_t i = 0; i < k->of->n; i++)
        if (!is_replaced_by_distance(k, i)) {
            k->value[i] = qdot_sub(k->pool, k->Q[i], offset_from_regular(k, i, k->x));
            k->speed[i] = qdot_sub(k->pool, velocity_symbol(k, k->w[i]), offset_from_regular(k, i, k->rate));
        }
    for (size_t j = k->d; j-- > 0;) {
        const size_t p = pair->pivot[j];
        qdot_expr value = qdot_sub(k->pool, k->x[j], pair->x[j]), speed = k->rate[j];

        value = qdot_add(k->pool, value, k->of->q[p]);
        for (size_t i = 0; i < k->of->n; i++) {
            const qdot_expr slope =
                i == p ? QDOT_ZERO : qdot_diff(k->pool, pair->x[j], k->of->q[i]);

            if (slope == QDOT_ZERO)
                continue;
            value = qdot_subs(k->pool, value, 1, k->of->q + i, k->value + i);
            speed = qdot_sub(k->pool, speed, multiply_expressions(k, slope, k->speed[i]));
        }
        k->value[p] = qdot_expand(k->pool, value);
        k->speed[p] = qdot_expand(k->pool, speed);
    }
}

/* Write e, given in coordinates, x and R, in terms of x, dx/dt, and Q and w' of the other coordinates. */
static qdot_expr
to_pair_coordinates(const work *k, qdot_expr e)
{
    const qdot_expr now = QDOT_T;

    for (size_t i = 0; i < k->of->n; i++) {
        const qdot_expr from[] = {k->of->q[i], velocity_symbol(k, k->of->q[i])};
        const qdot_expr to[] = {k->value[i], k->speed[i]};

        e = qdot_subs(k->pool, e, 2, from, to);
    }
    return qdot_subs(k->pool, e, 1, &now, &k->c->time);
}

static qdot_expr
to_regular_coordinates(const work *k, qdot_expr e)
{
    if (k->d > 1)
        e = qdot_subs(k->pool, e, k->d, k->x, k->in_u);
    return qdot_subs(k->pool, e, k->d, k->rate, k->rate_u);
}

/* Write e, given in coordinates, x and R, in terms of the new coordinates and R. */
static qdot_expr
to_new_coordinates(const work *k, qdot_expr e)
{
    return to_regular_coordinates(k, to_pair_coordinates(k, e));
}

/* Write e as a polynomial in R, and replace R by |u|^2; if e is divided by R, record that as the hindrance. */
static qdot_expr
write_regular(work *k, qdot_expr e)
{
    const qdot_expr square = dot_product(k, k->m, k->u, k->u);

    e = qdot_expand(k->pool, e);
    if (e != QDOT_NIL && contains_negative_power(k->pool, e, k->R)) {
        e = qdot_expand(k->pool, qdot_subs(k->pool, e, 1, &k->R, &square));
        e = qdot_mech_tidy(k->s, e);
        if (e == QDOT_NIL || contains_negative_power(k->pool, e, k->d > 1 ? square : k->u[0]))
            record_hindrance(k, "another force is not smooth there");
        return e;
    }
    return qdot_subs(k->pool, e, 1, &k->R, &square);
}

static qdot_status
add_equation_of_motion(work *k, qdot_expr q, qdot_expr second, qdot_expr q0, qdot_expr v0)
{
    const qdot_torque force = {
        .torque = second, .coordinate = q, .force = true, .body = -1};

    QDOT_TRY(qdot_pool_check(k->pool));
    if (second != QDOT_ZERO && !has_hindrance(k))
        QDOT_TRY(qdot_scene_torque(k->c->scene, &force));
    QDOT_TRY(qdot_vec_push(&k->c->q0, q0));
    return qdot_vec_push(&k->c->v0, v0);
}

/* Choose the start value of u: of two solutions of x = L(u) u the one that is computed without cancellation. */
static void
choose_start_of_u(const work *k, qdot_expr *u)
{
    const qdot_collision_pair *pair = &k->c->pair;
    const size_t main = k->d > 1 && k->side < 0 ? 1 : 0;
    const qdot_expr two = qdot_expr_int(k->pool, 2);
    qdot_expr x = main ? qdot_neg(k->pool, pair->x[0]) : pair->x[0];

    for (size_t j = 0; j < PARTS; j++)
        u[j] = QDOT_ZERO;
    if (k->d == 1) {
        u[0] = qdot_sqrt(k->pool, pair->distance);
        return;
    }
    u[main] =
        qdot_sqrt(k->pool, multiply_expressions(k, QDOT_HALF, qdot_add(k->pool, pair->distance, x)));
    u[1 - main] = qdot_div(k->pool, pair->x[1], multiply_expressions(k, two, u[main]));
    if (k->d == 3)
        u[main ? 3 : 2] = qdot_div(k->pool, pair->x[2], multiply_expressions(k, two, u[main]));
}

/* Take b dx/dt, a force along the velocity, out of P, in rates: b. As u'.(L^T L u') = R u'.u', for 4
 * components along the motion alone, it is smooth. */
static qdot_expr
split_off_force_along_velocity(const work *k, qdot_expr *P)
{
    const qdot_expr b = qdot_expand(k->pool, qdot_diff(k->pool, P[0], k->rate[0]));

    for (size_t i = 0; i < k->d; i++)
        if (qdot_expand(k->pool, qdot_diff(k->pool, P[i], k->rate[i])) != b ||
            qdot_expr_contains(k->pool, b, k->rate[i]))
            return QDOT_ZERO;
    for (size_t i = 0; i < k->d; i++)
        P[i] = qdot_expand(k->pool, qdot_sub(k->pool, P[i], multiply_expressions(k, b, k->rate[i])));
    return b;
}

static qdot_status
add_pair_equations(work *k)
{
    const qdot_expr h = velocity_symbol(k, k->energy), two = qdot_expr_int(k->pool, 2);
    qdot_expr RP[MOST], u0[PARTS], v[PARTS], rate0[MOST], power = QDOT_ZERO, along;
    work at_start = *k;

    for (size_t j = 0; j < k->m; j++)
        v[j] = velocity_symbol(k, k->u[j]);
    for (size_t i = 0; i < k->d; i++)
        RP[i] = to_pair_coordinates(k, k->P[i]);
    along = write_regular(k, to_regular_coordinates(k, split_off_force_along_velocity(k, RP)));
    for (size_t i = 0; i < k->d; i++) {
        RP[i] = qdot_expand(k->pool, multiply_expressions(k, k->R, to_regular_coordinates(k, RP[i])));
        rate0[i] = qdot_ddt(k->pool, k->c->pair.x[i]);
        power = qdot_add(k->pool, power, multiply_expressions(k, ks_matrix_row(k, i, v), RP[i]));
    }
    choose_start_of_u(k, u0);
    memcpy(at_start.u, u0, sizeof u0);
    for (size_t j = 0; j < k->m; j++) {
        qdot_expr push = write_regular(k, multiply_expressions(k, QDOT_HALF, ks_matrix_column(k, j, RP)));

        push = qdot_add(k->pool, push,
                        multiply_expressions(k, along, multiply_expressions(k, dot_product(k, k->m, k->u, k->u), v[j])));
        push = qdot_add(k->pool, multiply_expressions(k, QDOT_HALF, multiply_expressions(k, h, k->u[j])), push);
        QDOT_TRY(add_equation_of_motion(k, k->u[j], push, u0[j],
                                        multiply_expressions(k, QDOT_HALF, ks_matrix_column(&at_start, j, rate0))));
    }
    QDOT_TRY(add_equation_of_motion(k, k->c->time, multiply_expressions(k, two, dot_product(k, k->m, k->u, v)), QDOT_T,
                                    k->c->pair.distance));
    power = write_regular(k, qdot_div(k->pool, multiply_expressions(k, two, power), k->R));
    power = qdot_add(
        k->pool, power,
        multiply_expressions(k, qdot_expr_int(k->pool, 4), multiply_expressions(k, along, dot_product(k, k->m, v, v))));
    return add_equation_of_motion(k, k->energy, power, QDOT_ZERO,
                                  qdot_sub(k->pool, multiply_expressions(k, QDOT_HALF, dot_product(k, k->d, rate0, rate0)),
                                           qdot_div(k->pool, k->strength, k->c->pair.distance)));
}

static qdot_status
add_other_equations(work *k)
{
    const qdot_collision_pair *pair = &k->c->pair;
    qdot_expr v[PARTS], change, rate0[MOST];

    for (size_t j = 0; j < k->m; j++)
        v[j] = velocity_symbol(k, k->u[j]);
    for (size_t i = 0; i < k->d; i++)
        rate0[i] = qdot_ddt(k->pool, pair->x[i]);
    change = multiply_expressions(k, qdot_expr_int(k->pool, 2), dot_product(k, k->m, k->u, v));
    for (size_t i = 0; i < k->of->n && !has_hindrance(k); i++) {
        const qdot_expr q = k->of->q[i];
        qdot_expr second, free;

        if (is_replaced_by_distance(k, i))
            continue;
        free = qdot_add(k->pool, velocity_symbol(k, q), offset_from_regular(k, i, rate0));
        second = qdot_add(k->pool, k->rest[i], offset_from_regular(k, i, k->P));
        second = write_regular(k, multiply_expressions(k, k->R, to_new_coordinates(k, second)));
        QDOT_TRY(add_equation_of_motion(k, k->Q[i],
                                        qdot_add(k->pool, multiply_expressions(k, change, velocity_symbol(k, k->w[i])),
                                                 multiply_expressions(k, dot_product(k, k->m, k->u, k->u), second)),
                                        qdot_add(k->pool, q, offset_from_regular(k, i, pair->x)),
                                        multiply_expressions(k, pair->distance, free)));
        QDOT_TRY(add_equation_of_motion(k, k->w[i], second, QDOT_ZERO, free));
    }
    return qdot_pool_check(k->pool);
}

/* --- expressions in the new coordinates ------------------------------------------------------------ */

static qdot_status
record_replacement(work *k, qdot_expr from, qdot_expr to)
{
    const qdot_expr square = dot_product(k, k->m, k->u, k->u);

    to = qdot_subs(k->pool, to, 1, &k->R, &square);
    QDOT_TRY(qdot_vec_push(&k->c->from, from));
    return qdot_vec_push(&k->c->to, to);
}

static qdot_status
record_all_replacements(work *k)
{
    for (size_t i = 0; i < k->of->n; i++) {
        qdot_expr e =
            qdot_collision_put_distance(k->pool, k->of->accels[i], &k->c->pair, k->R);

        QDOT_TRY(record_replacement(k, k->of->q[i], to_new_coordinates(k, k->of->q[i])));
        QDOT_TRY(
            record_replacement(k, velocity_symbol(k, k->of->q[i]), to_new_coordinates(k, velocity_symbol(k, k->of->q[i]))));
        QDOT_TRY(record_replacement(k, qdot_symbol_jet(k->pool, k->of->q[i], 2), to_new_coordinates(k, e)));
    }
    QDOT_TRY(record_replacement(k, QDOT_T, k->c->time));
    QDOT_TRY(record_replacement(k, k->R, k->R));
    return qdot_pool_check(k->pool);
}

qdot_expr
qdot_collision_express(const qdot_collision *c, qdot_expr e)
{
    e = qdot_collision_put_distance(c->pool, e, &c->pair, c->R);
    return qdot_subs(c->pool, e, c->from.n, c->from.at, c->to.at);
}

/* Write the energy T + V = rest + m (dx/dt . dx/dt/2 - k/R) as rest + m h. */
static void
express_energy(work *k)
{
    const qdot_expr minus_half = qdot_neg(k->pool, QDOT_HALF);
    qdot_expr e = qdot_collision_put_distance(k->pool, k->of->energy, &k->c->pair, k->R),
              m, pole;

    e = to_pair_coordinates(k, e);
    pole = qdot_expand(k->pool, multiply_expressions(k, e, k->R));
    if (pole == QDOT_NIL || contains_negative_power(k->pool, pole, k->R))
        return;
    pole = qdot_subs(k->pool, pole, 1, &k->R, (qdot_expr[]){QDOT_ZERO});
    m = qdot_neg(k->pool, qdot_div(k->pool, pole, k->strength));
    e = qdot_sub(k->pool, e, qdot_div(k->pool, pole, k->R));
    e = qdot_add(k->pool, e,
                 multiply_expressions(k, multiply_expressions(k, minus_half, m), dot_product(k, k->d, k->rate, k->rate)));
    e = to_regular_coordinates(k, qdot_expand(k->pool, e));
    k->c->energy =
        qdot_subs(k->pool, qdot_add(k->pool, e, multiply_expressions(k, m, velocity_symbol(k, k->energy))), 1,
                  &k->R, (qdot_expr[]){dot_product(k, k->m, k->u, k->u)});
}

/* Copy the events of the scene, which must not set coordinates or velocities. */
static qdot_status
copy_events(work *k)
{
    qdot_collision *c = k->c;

    for (size_t i = 0; i < k->s->events.n && !has_hindrance(k); i++) {
        qdot_event own = k->s->events.at[i];

        if (own.targets.n > 0) {
            record_hindrance(k, "an event sets coordinates");
            return QDOT_OK;
        }
        own.left = qdot_collision_express(c, own.left);
        own.right = qdot_collision_express(c, own.right);
        QDOT_TRY(qdot_pool_check(c->pool));
        QDOT_TRY(qdot_scene_event(c->scene, &own));
    }
    return QDOT_OK;
}

/* Check that the domains of coordinates end nowhere but at the collision. */
static void
check_domains(work *k)
{
    for (size_t i = 0; i < k->of->n; i++) {
        const qdot_symbol *q = qdot_expr_symbol(k->pool, k->of->q[i]);
        const bool ends = q->lo != QDOT_NIL || q->hi != QDOT_NIL;

        if (ends && !(k->d == 1 && k->c->pair.x[0] == k->of->q[i] && q->hi == QDOT_NIL &&
                      q->lo == QDOT_ZERO))
            record_hindrance(k, "a coordinate has a domain");
    }
}

/* --- the whole scene --------------------------------------------------------------------------------- */

static qdot_status
build_scene(work *k)
{
    qdot_expr kinetic = QDOT_ZERO;
    qdot_scene *to = k->c->scene;

    make_symbols(k);
    QDOT_TRY(qdot_pool_check(k->pool));
    check_domains(k);
    split_accelerations(k);
    find_strength_of_attraction(k);
    QDOT_TRY(qdot_pool_check(k->pool));
    k->c->strength = k->strength;
    if (has_hindrance(k))
        return QDOT_OK;
    k->c->parts = k->m;
    express_coordinates(k);
    for (size_t i = 0; i < to->coordinates.n; i++)
        kinetic =
            qdot_add(k->pool, kinetic,
                     multiply_expressions(k, QDOT_HALF,
                                          qdot_pow_int(k->pool, velocity_symbol(k, to->coordinates.at[i]), 2)));
    QDOT_TRY(qdot_scene_lagrangian(to, kinetic));
    QDOT_TRY(add_pair_equations(k));
    QDOT_TRY(add_other_equations(k));
    QDOT_TRY(record_all_replacements(k));
    if (k->of->energy != QDOT_NIL)
        express_energy(k);
    return copy_events(k);
}

qdot_status
qdot_collision_make(qdot_scene *s, const qdot_collision_equations *of,
                    const qdot_collision_pair *pair, int sign, qdot_collision *c)
{
    const size_t n = of->n, d = pair->d;
    qdot_expr *room = qdot_calloc((6 + d) * n + 1, sizeof *room);
    work k = {.c = c,
              .pool = of->pool,
              .s = s,
              .of = of,
              .sign = d > 1 ? 1 : sign,
              .side = sign};
    qdot_status status;

    *c = (qdot_collision){
        .pool = of->pool, .pair = *pair, .scene = qdot_scene_new(of->pool)};
    if (room) {
        k.Q = room;
        k.w = k.Q + n;
        k.value = k.w + n;
        k.speed = k.value + n;
        k.rest = k.speed + n;
        k.pull = k.rest + n;
    }
    if (s->states.n > 0)
        snprintf(c->hindrance, sizeof c->hindrance, "the scene has states");
    status = !room || !c->scene ? QDOT_ENOMEM : s->states.n > 0 ? QDOT_OK : build_scene(&k);
    qdot_free(room);
    if (status == QDOT_OK && c->hindrance[0] != '\0') {
        qdot_scene_free(c->scene);
        c->scene = NULL;
    }
    return status;
}
