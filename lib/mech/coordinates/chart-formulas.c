/* chart-formulas.c -- writes the coordinates of each group of a chart in terms of the new coordinates that replace them. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "mech/coordinates/chart.h"

#include <stdio.h>

#include "expr/print.h"
#include "expr/walk.h"
#include "mech/coordinates/chart-body.h"
#include "mech/scene/scene.h"

size_t
qdot_chart_size(qdot_chart_kind kind)
{
    switch (kind) {
    case QDOT_CHART_ROOT: return 0;
    case QDOT_CHART_PLANE:
    case QDOT_CHART_SPHERE:
    case QDOT_CHART_PARABOLIC:
    case QDOT_CHART_ELLIPTIC: return 2;
    default: return 3;
    }
}

static qdot_expr
get_coordinate(const qdot_chart *c, size_t i)
{
    return c->of->coordinates.at[i];
}

static const char *
coordinate_name(const qdot_chart *c, size_t i)
{
    return qdot_expr_symbol(c->pool, get_coordinate(c, i))->name;
}

static qdot_expr
apply_elementary(const qdot_chart *c, uint16_t function, qdot_expr e)
{
    return qdot_fun1(c->pool, function, e);
}

static qdot_expr
multiply(const qdot_chart *c, qdot_expr a, qdot_expr b)
{
    return qdot_mul(c->pool, a, b);
}

static qdot_expr
half_of_expression(const qdot_chart *c, qdot_expr e)
{
    return multiply(c, QDOT_HALF, e);
}

static qdot_expr
square_of_expression(const qdot_chart *c, qdot_expr e)
{
    return qdot_pow_int(c->pool, e, 2);
}

static qdot_expr
sum_of_squares(const qdot_chart *c, size_t n, const qdot_expr *x)
{
    qdot_expr sum = QDOT_ZERO;

    for (size_t i = 0; i < n; i++)
        sum = qdot_add(c->pool, sum, square_of_expression(c, x[i]));
    return sum;
}

/* Make a new symbol whose name contains that of coordinate i. */
static qdot_expr
make_symbol_for(const qdot_chart *c, const char *what, size_t i)
{
    char name[120];

    snprintf(name, sizeof name, "%s#%.80s", what, coordinate_name(c, i));
    return qdot_symbol_get(c->pool, QDOT_FORMAL, name);
}

/* Append to the chart's description: the formulas of the new coordinates from k on, or the text `what`. */
static void
append_description(qdot_chart *c, size_t k, const char *what)
{
    qdot_text *names = &c->names;

    if (what)
        qdot_text_format(names, "%s%s", names->n > 0 ? ", " : "", what);
    for (; !what && k < c->fresh.n; k++)
        qdot_text_format(names, "%s%s", names->n > 0 ? ", " : "",
                         qdot_expr_symbol(c->pool, c->fresh.at[k].q)->name);
}

/* Add a new coordinate, named after its expression in the given ones. */
static qdot_status
add_new_coordinate(qdot_chart *c, qdot_expr given, qdot_expr *q)
{
    qdot_text name = {0};
    qdot_status status = qdot_print(c->pool, given, QDOT_PLAIN, &name);

    if (status == QDOT_OK) {
        *q = qdot_symbol_get(c->pool, QDOT_COORD, qdot_text_str(&name));
        status = qdot_pool_check(c->pool);
    }
    qdot_text_clear(&name);
    QDOT_TRY(status);
    return qdot_vec_push(&c->fresh, ((qdot_chart_fresh){*q, given}));
}

/* Add coordinate i to the coordinates that the chart replaces. */
static qdot_status
add_replaced_coordinate(qdot_chart *c, size_t i, qdot_chart_moved m)
{
    m.q = m.given = get_coordinate(c, i);
    if (m.sort == QDOT_CHART_ANGLE && m.value == QDOT_NIL)
        m.bare = make_symbol_for(c, "angle", i);
    return qdot_vec_push(&c->moved, m);
}

static qdot_status
add_replaced_length(qdot_chart *c, size_t i, qdot_expr value, size_t sign)
{
    return add_replaced_coordinate(c, i,
                                   (qdot_chart_moved){
                         .value = value, .ends = {QDOT_ZERO, QDOT_NIL}, .sign = sign});
}

/* An angle equal to atan2(y, x), with its sine and cosine, where x^2 + y^2 = norm^2. */
static qdot_chart_moved
make_angle(const qdot_chart *c, qdot_expr x, qdot_expr y, qdot_expr norm, size_t sign)
{
    return (qdot_chart_moved){.sort = QDOT_CHART_ANGLE,
                              .cosine = qdot_div(c->pool, x, norm),
                              .sine = qdot_div(c->pool, y, norm),
                              .x = x,
                              .y = y,
                              .sign = sign};
}

/* Set the values at which the domain of an angle may end: 0 and pi; `turned`: less by a quarter turn. */
static void
set_ends_of_angle(const qdot_chart *c, qdot_chart_moved *m, bool turned)
{
    const qdot_expr quarter = half_of_expression(c, QDOT_PI);

    m->ends[0] = turned ? qdot_neg(c->pool, quarter) : QDOT_ZERO;
    m->ends[1] = turned ? quarter : QDOT_PI;
}

/* Add the distance N, whose square is given, with a sign s = +-1 that is followed during a run: *signed_N = s N. */
static qdot_status
add_distance(qdot_chart *c, size_t i, qdot_expr square, int start, qdot_expr *signed_N)
{
    const qdot_expr N = make_symbol_for(c, "distance", i), s = make_symbol_for(c, "sign", i);

    *signed_N = multiply(c, s, N);
    QDOT_TRY(qdot_vec_push(&c->roots, ((qdot_chart_root){.symbol = N, .square = square})));
    return qdot_vec_push(
        &c->signs, ((qdot_chart_sign){.symbol = s, .start = start, .distance = *signed_N}));
}

/* Set x and y to `across` times cos and sin of angle i; *R: `across` with a sign that is followed during a run. */
static qdot_status
add_angle_about_axis(qdot_chart *c, size_t i, qdot_expr across, int start, qdot_expr *x, qdot_expr *R)
{
    const qdot_expr phi = get_coordinate(c, i);
    qdot_expr s;

    QDOT_TRY(add_new_coordinate(c, multiply(c, across, apply_elementary(c, QDOT_COS, phi)), x));
    QDOT_TRY(add_new_coordinate(c, multiply(c, across, apply_elementary(c, QDOT_SIN, phi)), x + 1));
    QDOT_TRY(add_distance(c, i, sum_of_squares(c, 2, x), start, R));
    s = c->signs.at[c->signs.n - 1].symbol;
    return add_replaced_coordinate(c, i,
                                   make_angle(c, multiply(c, s, x[0]), multiply(c, s, x[1]),
                                              c->roots.at[c->roots.n - 1].symbol, c->signs.n));
}

static qdot_status
add_plane_group(qdot_chart *c, const size_t *index, int start)
{
    qdot_expr x[2], R;

    QDOT_TRY(add_angle_about_axis(c, index[1], get_coordinate(c, index[0]), start, x, &R));
    return add_replaced_length(c, index[0], R, c->signs.n);
}

/* Add spherical polar coordinates; a sphere, r = 1, has only theta and phi. Turned: theta is from the equator. */
static qdot_status
add_space_group(qdot_chart *c, const qdot_chart_group *g, int start)
{
    const bool sphere = g->kind == QDOT_CHART_SPHERE;
    const size_t i = g->index[sphere ? 0 : 1], j = g->index[sphere ? 1 : 2];
    const qdot_expr theta = get_coordinate(c, i);
    const qdot_expr r = sphere ? QDOT_ONE : get_coordinate(c, g->index[0]);
    const qdot_expr across = apply_elementary(c, g->turned ? QDOT_COS : QDOT_SIN, theta);
    const qdot_expr along = apply_elementary(c, g->turned ? QDOT_SIN : QDOT_COS, theta);
    qdot_expr x[3], R, norm;
    qdot_chart_moved tilt;

    QDOT_TRY(add_angle_about_axis(c, j, multiply(c, r, across), start, x, &R));
    QDOT_TRY(add_new_coordinate(c, multiply(c, r, along), x + 2));
    norm = sphere ? QDOT_ONE : qdot_sqrt(c->pool, sum_of_squares(c, 3, x));
    tilt = make_angle(c, g->turned ? R : x[2], g->turned ? x[2] : R, norm, c->signs.n);
    set_ends_of_angle(c, &tilt, g->turned);
    QDOT_TRY(add_replaced_coordinate(c, i, tilt));
    if (!sphere)
        return add_replaced_length(c, g->index[0], norm, c->signs.n);
    return qdot_vec_push(&c->unit, qdot_sub(c->pool, sum_of_squares(c, 3, x), QDOT_ONE));
}

static qdot_status
add_body_group(qdot_chart *c, const size_t *index, int start)
{
    const qdot_expr phi = get_coordinate(c, index[0]), theta = get_coordinate(c, index[1]),
                    psi = get_coordinate(c, index[2]);
    const qdot_expr tilt = half_of_expression(c, theta);
    const qdot_expr sum = half_of_expression(c, qdot_add(c->pool, phi, psi));
    const qdot_expr difference = half_of_expression(c, qdot_sub(c->pool, phi, psi));
    const qdot_expr C = apply_elementary(c, QDOT_COS, tilt), S = apply_elementary(c, QDOT_SIN, tilt);
    const qdot_expr given[] = {multiply(c, C, apply_elementary(c, QDOT_COS, sum)),
                               multiply(c, S, apply_elementary(c, QDOT_COS, difference)),
                               multiply(c, S, apply_elementary(c, QDOT_SIN, difference)),
                               multiply(c, C, apply_elementary(c, QDOT_SIN, sum))};
    qdot_expr e[4], R[9], sN, s, N;
    qdot_chart_moved lean;

    for (size_t k = 0; k < 4; k++)
        QDOT_TRY(add_new_coordinate(c, given[k], e + k));
    QDOT_TRY(qdot_vec_push(&c->unit, qdot_sub(c->pool, sum_of_squares(c, 4, e), QDOT_ONE)));
    qdot_chart_body_axes(c->pool, e, R);
    QDOT_TRY(add_distance(c, index[1],
                          multiply(c, qdot_expr_int(c->pool, 4),
                                   multiply(c, sum_of_squares(c, 2, e + 1),
                                            sum_of_squares(c, 2, (qdot_expr[]){e[0], e[3]}))),
                          start, &sN));
    s = c->signs.at[c->signs.n - 1].symbol;
    N = c->roots.at[c->roots.n - 1].symbol;
    QDOT_TRY(add_replaced_coordinate(c, index[0],
                                     make_angle(c, qdot_neg(c->pool, multiply(c, s, R[5])), multiply(c, s, R[2]),
                                                N, c->signs.n)));
    lean = make_angle(c, R[8], sN, QDOT_ONE, c->signs.n);
    set_ends_of_angle(c, &lean, false);
    QDOT_TRY(add_replaced_coordinate(c, index[1], lean));
    QDOT_TRY(add_replaced_coordinate(
        c, index[2], make_angle(c, multiply(c, s, R[7]), multiply(c, s, R[6]), N, c->signs.n)));
    return qdot_chart_body_replace(c->of, c->scene,
                                   qdot_scene_euler(c->pool, phi, theta, psi), R,
                                   c->hindrance, sizeof c->hindrance);
}

/* --- parabolic and elliptic coordinates --------------------------------------------------------- */

/* The Cartesian components X, Y in a plane; one of them may be the distance from an axis of rotation. */
typedef struct {
    qdot_expr X, Y, XX, YY, dX, dY; /* the components, their squares and their rates of change */
    size_t sign;
} pair;

/* Find x[0], x[1]: the Cartesian X, Y in the given coordinates. */
static void
find_given_pair(const qdot_chart *c, const qdot_chart_group *g, qdot_expr *x)
{
    const qdot_expr u = get_coordinate(c, g->index[0]), v = get_coordinate(c, g->index[1]);

    if (g->kind == QDOT_CHART_PARABOLIC || g->kind == QDOT_CHART_PARABOLOIDS) {
        x[0] = multiply(c, u, v);
        x[1] = half_of_expression(c, qdot_sub(c->pool, square_of_expression(c, u), square_of_expression(c, v)));
        return;
    }
    x[0] = multiply(c, apply_elementary(c, QDOT_COSH, u), apply_elementary(c, g->turned ? QDOT_SIN : QDOT_COS, v));
    x[1] = multiply(c, apply_elementary(c, QDOT_SINH, u), apply_elementary(c, g->turned ? QDOT_COS : QDOT_SIN, v));
}

static qdot_status
add_cartesian_pair(qdot_chart *c, const qdot_chart_group *g, int start, pair *p)
{
    const bool round = qdot_chart_size(g->kind) == 3;
    const size_t across = g->kind == QDOT_CHART_PROLATE ? 1 : 0;
    qdot_expr given[2], now[2], squares[2], x[2];

    find_given_pair(c, g, given);
    for (size_t k = 0; k < 2; k++) {
        if (round && k == across) {
            QDOT_TRY(add_angle_about_axis(c, g->index[2], given[k], start, x, now + k));
            squares[k] = sum_of_squares(c, 2, x);
        } else {
            QDOT_TRY(add_new_coordinate(c, given[k], now + k));
            squares[k] = square_of_expression(c, now[k]);
        }
    }
    *p = (pair){now[0],
                now[1],
                squares[0],
                squares[1],
                qdot_chart_rate(c, now[0]),
                qdot_chart_rate(c, now[1]),
                round ? c->signs.n : 0};
    return QDOT_OK;
}

/* Whether coordinate k of a plane group alone is positive by its domain: of parabolic ones either may
 * be, of elliptic ones u. */
static bool
is_positive_by_domain(const qdot_pool *pool, const qdot_scene *s, const qdot_chart_group *g, size_t k)
{
    const bool parabolic = g->kind == QDOT_CHART_PARABOLIC;
    const qdot_symbol *own = qdot_expr_symbol(pool, s->coordinates.at[g->index[k]]);
    const qdot_symbol *other = qdot_expr_symbol(pool, s->coordinates.at[g->index[1 - k]]);

    return (parabolic || (g->kind == QDOT_CHART_ELLIPTIC && k == 0)) && own->lo == QDOT_ZERO &&
           other->lo == QDOT_NIL;
}

/* Add an auxiliary angle atan2(y, x), from which the angles of the group are computed. */
static qdot_status
add_auxiliary_angle(qdot_chart *c, const qdot_chart_group *g, const pair *p, qdot_expr x, qdot_expr y,
                    qdot_expr given)
{
    const qdot_symbol *u = qdot_expr_symbol(c->pool, get_coordinate(c, g->index[0]));
    const qdot_symbol *v = qdot_expr_symbol(c->pool, get_coordinate(c, g->index[1]));
    const bool second = is_positive_by_domain(c->pool, c->of, g, 1);

    return qdot_vec_push(
        &c->moved,
        ((qdot_chart_moved){.q = make_symbol_for(c, "turn", g->index[0]),
                            .sort = QDOT_CHART_ANGLE,
                            .x = x,
                            .y = y,
                            .cut = second || is_positive_by_domain(c->pool, c->of, g, 0),
                            .middle = second,
                            .bare = make_symbol_for(c, "angle of turn", g->index[0]),
                            .given = given,
                            .sign = p->sign,
                            .between = p->sign > 0 && u->lo != QDOT_NIL && v->lo != QDOT_NIL}));
}

static qdot_status
add_parabolic_group(qdot_chart *c, const qdot_chart_group *g, int start)
{
    qdot_pool *pool = c->pool;
    const size_t i = g->index[0], j = g->index[1];
    const qdot_expr xi = make_symbol_for(c, "root", i), eta = make_symbol_for(c, "root", j);
    const qdot_expr rho = make_symbol_for(c, "distance", i);
    qdot_expr angle, size, rate[2];
    pair p;

    QDOT_TRY(add_cartesian_pair(c, g, start, &p));
    size = qdot_sqrt(pool, multiply(c, qdot_expr_int(pool, 2), rho));
    QDOT_TRY(add_auxiliary_angle(c, g, &p, p.Y, p.X,
                                 multiply(c, qdot_expr_int(pool, 2),
                                          qdot_fun(pool, QDOT_ATAN2, 2,
                                                   (qdot_expr[]){get_coordinate(c, j), get_coordinate(c, i)}))));
    angle = half_of_expression(c, c->moved.at[c->moved.n - 1].bare);
    rate[0] = qdot_div(pool, half_of_expression(c, qdot_add(pool, multiply(c, xi, p.dY), multiply(c, eta, p.dX))),
                       rho);
    rate[1] = qdot_div(pool, half_of_expression(c, qdot_sub(pool, multiply(c, xi, p.dX), multiply(c, eta, p.dY))),
                       rho);
    QDOT_TRY(qdot_vec_push(&c->roots, ((qdot_chart_root){
                                          .symbol = xi,
                                          .square = qdot_add(pool, rho, p.Y),
                                          .partner = eta,
                                          .product = p.X,
                                          .rate = rate[0],
                                          .value = multiply(c, size, apply_elementary(c, QDOT_COS, angle))})));
    QDOT_TRY(qdot_vec_push(&c->roots, ((qdot_chart_root){
                                          .symbol = eta,
                                          .square = qdot_sub(pool, rho, p.Y),
                                          .rate = rate[1],
                                          .value = multiply(c, size, apply_elementary(c, QDOT_SIN, angle))})));
    QDOT_TRY(qdot_vec_push(
        &c->roots, ((qdot_chart_root){.symbol = rho, .square = qdot_add(pool, p.XX, p.YY)})));
    for (size_t k = 0; k < 2; k++)
        QDOT_TRY(add_replaced_coordinate(c, g->index[k],
                                         (qdot_chart_moved){.value = k ? eta : xi,
                                              .ends = {p.sign || is_positive_by_domain(pool, c->of, g, k)
                                                           ? QDOT_ZERO
                                                           : QDOT_NIL,
                                                       QDOT_NIL},
                                              .rate = rate[k],
                                              .sign = p.sign}));
    return QDOT_OK;
}

/* The roots used by elliptic coordinates: cosh u, sinh u, cos v, sin v, and S = sinh^2 u + sin^2 v; v not turned. */
typedef struct {
    qdot_expr cosh, sinh, cos, sin, S, du, dv;
} ellipse;

static qdot_status
add_elliptic_roots(qdot_chart *c, const pair *p, const ellipse *e)
{
    qdot_pool *pool = c->pool;
    const qdot_expr sum = qdot_add(pool, qdot_add(pool, p->XX, p->YY), QDOT_ONE);
    const qdot_expr less = qdot_sub(pool, qdot_add(pool, p->XX, p->YY), QDOT_ONE);
    const qdot_expr angle = half_of_expression(c, c->moved.at[c->moved.n - 1].bare);
    const qdot_expr size = qdot_sqrt(pool, e->S);
    const qdot_chart_root roots[] = {
        {.symbol = e->cosh,
         .square = half_of_expression(c, qdot_add(pool, sum, e->S)),
         .partner = e->cos,
         .product = p->X,
         .rate = multiply(c, e->sinh, e->du)},
        {.symbol = e->sinh,
         .square = half_of_expression(c, qdot_add(pool, less, e->S)),
         .partner = e->sin,
         .product = p->Y,
         .rate = multiply(c, e->cosh, e->du),
         .value = multiply(c, size, apply_elementary(c, QDOT_COS, angle))},
        {.symbol = e->cos,
         .square = half_of_expression(c, qdot_sub(pool, sum, e->S)),
         .rate = qdot_neg(pool, multiply(c, e->sin, e->dv)),
         .value = qdot_div(pool, p->X, e->cosh)},
        {.symbol = e->sin,
         .square = half_of_expression(c, qdot_sub(pool, e->S, less)),
         .rate = multiply(c, e->cos, e->dv),
         .value = multiply(c, size, apply_elementary(c, QDOT_SIN, angle))},
        {.symbol = e->S,
         .square = qdot_add(pool, square_of_expression(c, less), multiply(c, qdot_expr_int(pool, 4), p->YY))},
    };

    for (size_t k = 0; k < sizeof roots / sizeof *roots; k++)
        QDOT_TRY(qdot_vec_push(&c->roots, roots[k]));
    return QDOT_OK;
}

static qdot_status
add_elliptic_group(qdot_chart *c, const qdot_chart_group *g, int start)
{
    qdot_pool *pool = c->pool;
    const size_t i = g->index[0], j = g->index[1];
    const qdot_expr u = get_coordinate(c, i), v = get_coordinate(c, j), two = qdot_expr_int(pool, 2);
    ellipse e = {.cosh = make_symbol_for(c, "cosh", i),
                 .sinh = make_symbol_for(c, "sinh", i),
                 .cos = make_symbol_for(c, "cos", j),
                 .sin = make_symbol_for(c, "sin", j),
                 .S = make_symbol_for(c, "distance", i)};
    size_t turn;
    qdot_expr bp, aq, bare;
    qdot_chart_moved angle, own;
    pair p;

    QDOT_TRY(add_cartesian_pair(c, g, start, &p));
    QDOT_TRY(add_auxiliary_angle(c, g, &p,
                                 qdot_sub(pool, qdot_add(pool, p.XX, p.YY), QDOT_ONE), multiply(c, two, p.Y),
                                 multiply(c, two,
                                          qdot_fun(pool, QDOT_ATAN2, 2,
                                                   (qdot_expr[]){apply_elementary(c, g->turned ? QDOT_COS : QDOT_SIN, v),
                                                   apply_elementary(c, QDOT_SINH, u)}))));
    turn = c->moved.n - 1;
    bp = multiply(c, e.sinh, e.cos);
    aq = multiply(c, e.cosh, e.sin);
    e.du = qdot_div(pool, qdot_add(pool, multiply(c, bp, p.dX), multiply(c, aq, p.dY)), e.S);
    e.dv = qdot_div(pool, qdot_sub(pool, multiply(c, bp, p.dY), multiply(c, aq, p.dX)), e.S);
    QDOT_TRY(add_elliptic_roots(c, &p, &e));
    QDOT_TRY(add_replaced_coordinate(c, i, (qdot_chart_moved){.sort = QDOT_CHART_HYPERBOLIC,
                                                .value = apply_elementary(c, QDOT_ASINH, e.sinh),
                                                .cosine = e.cosh,
                                                .sine = e.sinh,
                                                .ends = {g->kind == QDOT_CHART_PROLATE ||
                                                                 is_positive_by_domain(pool, c->of, g, 0)
                                                             ? QDOT_ZERO
                                                             : QDOT_NIL,
                                                         QDOT_NIL},
                                                .rate = e.du,
                                                .sign = p.sign}));
    bare = make_symbol_for(c, "angle", j);
    own = (qdot_chart_moved){.q = g->turned ? make_symbol_for(c, "turn", j) : v,
                             .sort = QDOT_CHART_ANGLE,
                             .cosine = e.cos,
                             .sine = e.sin,
                             .x = p.X,
                             .y = aq,
                             .half = turn,
                             .factor = multiply(c, e.cosh, qdot_sqrt(pool, e.S)),
                             .bare = bare,
                             .rate = e.dv,
                             .given = g->turned ? qdot_sub(pool, half_of_expression(c, QDOT_PI), v) : v,
                             .sign = p.sign};
    angle = own;
    angle.q = v;
    if (p.sign)
        set_ends_of_angle(c, g->turned ? &angle : &own, g->turned == (g->kind == QDOT_CHART_PROLATE));
    if (!g->turned)
        return qdot_vec_push(&c->moved, own);
    angle.given = v;
    angle.cosine = e.sin;
    angle.sine = e.cos;
    angle.rate = qdot_neg(pool, e.dv);
    angle.value = qdot_sub(pool, half_of_expression(c, QDOT_PI), bare);
    angle.bare = QDOT_NIL;
    QDOT_TRY(qdot_vec_push(&c->moved, own));
    return qdot_vec_push(&c->moved, angle);
}

/* --- square roots as new coordinates ---------------------------------------------------------------- */

/* Add the new coordinate w = sqrt(P) of a group, with the constraint w^2 = P. */
static qdot_status
add_root_group(qdot_chart *c, const qdot_chart_group *g)
{
    qdot_expr w;

    QDOT_TRY(add_new_coordinate(c, qdot_sqrt(c->pool, g->square), &w));
    QDOT_TRY(qdot_vec_push(&c->unit, qdot_sub(c->pool, square_of_expression(c, w), g->square)));
    return qdot_vec_push(
        &c->signs,
        ((qdot_chart_sign){.symbol = w, .start = 1, .branch = true, .square = g->square}));
}

/* --- adding a group; its distance --------------------------------------------------------------- */

qdot_status
qdot_chart_add(qdot_chart *c, const qdot_chart_group *g, int sign)
{
    const size_t before = c->fresh.n;
    char what[200];

    switch (g->kind) {
    case QDOT_CHART_PLANE: QDOT_TRY(add_plane_group(c, g->index, sign)); break;
    case QDOT_CHART_SPACE:
    case QDOT_CHART_SPHERE: QDOT_TRY(add_space_group(c, g, sign)); break;
    case QDOT_CHART_PARABOLIC:
    case QDOT_CHART_PARABOLOIDS: QDOT_TRY(add_parabolic_group(c, g, sign)); break;
    case QDOT_CHART_ELLIPTIC:
    case QDOT_CHART_PROLATE:
    case QDOT_CHART_OBLATE: QDOT_TRY(add_elliptic_group(c, g, sign)); break;
    case QDOT_CHART_ROOT: QDOT_TRY(add_root_group(c, g)); break;
    default:
        QDOT_TRY(add_body_group(c, g->index, sign));
        snprintf(what, sizeof what, "the unit quaternion of %.50s, %.50s, %.50s",
                 coordinate_name(c, g->index[0]), coordinate_name(c, g->index[1]), coordinate_name(c, g->index[2]));
    }
    append_description(c, before, g->kind == QDOT_CHART_BODY ? what : NULL);
    return QDOT_OK;
}

/* sinh(u)^2 + sin(v)^2, which is 0 at the foci of elliptic coordinates; with cos(v) if v is turned by a quarter. */
static qdot_expr
distance_from_foci(qdot_pool *pool, const qdot_chart_group *g, qdot_expr u, qdot_expr v)
{
    return qdot_add(pool, qdot_pow_int(pool, qdot_fun1(pool, QDOT_SINH, u), 2),
                    qdot_pow_int(pool, qdot_fun1(pool, g->turned ? QDOT_COS : QDOT_SIN, v), 2));
}

qdot_expr
qdot_chart_distance(const qdot_scene *s, const qdot_chart_group *g)
{
    qdot_pool *pool = s->pool;
    const qdot_expr a = s->coordinates.at[g->index[0]], b = s->coordinates.at[g->index[1]];
    const uint16_t sine = g->turned ? QDOT_COS : QDOT_SIN, cosine = g->turned ? QDOT_SIN : QDOT_COS;

    if (g->kind == QDOT_CHART_PARABOLIC || g->kind == QDOT_CHART_ELLIPTIC)
        for (size_t k = 0; k < 2; k++) /* u > 0 ends on a line, not at a point */
            if (is_positive_by_domain(pool, s, g, k))
                return k ? b : a;
    switch (g->kind) {
    case QDOT_CHART_PLANE: return a;
    case QDOT_CHART_SPACE: return qdot_mul(pool, a, qdot_fun1(pool, sine, b));
    case QDOT_CHART_SPHERE: return qdot_fun1(pool, sine, a);
    case QDOT_CHART_PARABOLIC:
        return qdot_add(pool, qdot_pow_int(pool, a, 2), qdot_pow_int(pool, b, 2));
    case QDOT_CHART_PARABOLOIDS: return qdot_mul(pool, a, b);
    case QDOT_CHART_ELLIPTIC: return distance_from_foci(pool, g, a, b);
    case QDOT_CHART_PROLATE:
        return qdot_mul(pool, qdot_fun1(pool, QDOT_SINH, a), qdot_fun1(pool, sine, b));
    case QDOT_CHART_OBLATE:
        return qdot_mul(pool, distance_from_foci(pool, g, a, b), qdot_fun1(pool, cosine, b));
    case QDOT_CHART_ROOT: return qdot_sqrt(pool, g->square);
    default: return qdot_fun1(pool, QDOT_SIN, b);
    }
}
