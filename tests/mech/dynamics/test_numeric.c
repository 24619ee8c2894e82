/* M q'' = f against the Lagrangian itself, differentiated numerically.
 *
 * L is written down anew (1/2 m v.v with v = dr/dt, 1/2 w.I w with w from R^T R'),
 * evaluated in long double along q(t) = q + v t + a t^2/2, and d/dt dL/dq' - dL/dq taken
 * by central differences of eighth order. M a - f must be that less the work of the
 * applied forces.
 */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/dynamics/quantity.h"
#include "mech/kit.h"
#include "mech/scene/access.h"

enum { MOST = 6 };

typedef struct {
    kit k;
    size_t n;
    qdot_expr L;                  /* T - V, independent of mech's */
    qdot_expr place[8], force[8]; /* applied F at r */
    size_t forces;
    qdot_expr damper[4], coefficient[4]; /* |u| and c */
    size_t dampers;
    uint64_t seed;
    long double q[MOST], v[MOST], a[MOST];
} world;

static double
uniform(world *w)
{
    w->seed ^= w->seed << 13;
    w->seed ^= w->seed >> 7;
    w->seed ^= w->seed << 17;
    return (double)(w->seed >> 11) / 9007199254740992.0;
}

static int
below(world *w, int n)
{
    return (int)(uniform(w) * n);
}

/* --- long double evaluation ------------------------------------------------------------
 * */

static long double
rational(const fmpq *x)
{
    return (long double)fmpz_get_d(fmpq_numref(x)) /
           (long double)fmpz_get_d(fmpq_denref(x));
}

static long double
parameter(const char *name)
{
    unsigned h = 7;

    for (; *name; name++)
        h = h * 31 + (unsigned char)*name;
    return 0.6L + (long double)(h % 97) / 80;
}

/* e at time t of the path. */
static long double
value(world *w, qdot_expr e, const long double *q, const long double *v, long double t)
{
    const qdot_pool *pool = w->k.pool;
    qdot_walk walk;
    long double *x, result;

    must(qdot_walk_begin(pool, e, &walk));
    x = qdot_calloc(walk.n, sizeof *x);
    for (size_t i = 0; i < walk.n; i++) {
        const qdot_node *node = qdot_expr_node(pool, walk.at[i]);
        const qdot_expr *arg =
            node->kind > QDOT_SYM ? qdot_expr_args(pool, walk.at[i]) : NULL;
#define ARG(k) x[qdot_walk_index(&walk, arg[k])]

        if (node->kind == QDOT_NUM) {
            x[i] = rational(qdot_expr_rational(pool, walk.at[i]));
        } else if (node->kind == QDOT_SYM) {
            const qdot_symbol *s = qdot_expr_symbol(pool, walk.at[i]);

            x[i] = walk.at[i] == QDOT_T ? t : walk.at[i] == QDOT_PI ? M_PIl : NAN;
            if (s->class == QDOT_PARAM)
                x[i] = parameter(s->name);
            for (size_t j = 0; j < w->n; j++) {
                qdot_expr base = w->k.scene->coordinates.at[j];

                if (s->class == QDOT_COORD && s->base == base && s->order > 0)
                    x[i] = s->order == 1 ? v[j] : w->a[j];
                if (walk.at[i] == base)
                    x[i] = q[j];
            }
        } else if (node->kind == QDOT_SUM) {
            x[i] = ARG(0);
            for (uint32_t k = 1; k < node->n; k += 2)
                x[i] += ARG(k) * ARG(k + 1);
        } else if (node->kind == QDOT_PROD) {
            x[i] = ARG(0);
            for (uint32_t k = 1; k < node->n; k += 2)
                x[i] *= powl(ARG(k), ARG(k + 1));
        } else if (node->kind == QDOT_FUN) {
            switch (node->op) {
            case QDOT_SIN: x[i] = sinl(ARG(0)); break;
            case QDOT_COS: x[i] = cosl(ARG(0)); break;
            case QDOT_EXP: x[i] = expl(ARG(0)); break;
            case QDOT_HOLD: x[i] = ARG(0); break;
            case QDOT_ABS: x[i] = fabsl(ARG(0)); break;
            case QDOT_SIGN: x[i] = ARG(0) > 0 ? 1 : -1; break;
            default: fail_msg("function %s", qdot_fun_name(node->op));
            }
        } else {
            x[i] = NAN;
        }
    }
    result = x[qdot_walk_index(&walk, e)];
    qdot_free(x);
    qdot_walk_end(&walk);
    return result;
}

/* The central difference of eighth order. */
static const long double H = 1e-3L;
static const struct {
    int at;
    long double weight;
} stencil[] = {{1, 4.0L / 5},   {-1, -4.0L / 5},   {2, -1.0L / 5},   {-2, 1.0L / 5},
               {3, 4.0L / 105}, {-3, -4.0L / 105}, {4, -1.0L / 280}, {-4, 1.0L / 280}};

static void
path(const world *w, long double t, long double *q, long double *v)
{
    for (size_t i = 0; i < w->n; i++) {
        q[i] = w->q[i] + w->v[i] * t + w->a[i] * t * t / 2;
        v[i] = w->v[i] + w->a[i] * t;
    }
}

static long double
slope(world *w, qdot_expr e, size_t i, bool velocity, long double t)
{
    long double sum = 0, q[MOST], v[MOST];

    for (int k = 0; k < 8; k++) {
        path(w, t, q, v);
        (velocity ? v : q)[i] += stencil[k].at * H;
        sum += stencil[k].weight * value(w, e, q, v, t + 0.3L);
    }
    return sum / H;
}

/* d/dt of e, or of dL/dq_i', at 0. */
static long double
rate(world *w, qdot_expr e, int64_t i)
{
    long double sum = 0, q[MOST], v[MOST];

    for (int k = 0; k < 8; k++) {
        long double t = stencil[k].at * H;

        path(w, t, q, v);
        sum += stencil[k].weight *
               (i < 0 ? value(w, e, q, v, t + 0.3L) : slope(w, e, (size_t)i, true, t));
    }
    return sum / H;
}

/* --- random scenes
 * ---------------------------------------------------------------------- */

static qdot_expr
random_angle(world *w)
{
    int i = below(w, (int)w->n), j = below(w, (int)w->n);

    switch (below(w, 4)) {
    case 0: return E(&w->k, "q%d", i);
    case 1: return E(&w->k, "q%d + q%d", i, j);
    case 2: return E(&w->k, "2*q%d - q%d", i, j);
    default: return E(&w->k, "q%d + w1*t", i);
    }
}

static qdot_expr
random_term(world *w)
{
    qdot_pool *p = w->k.pool;
    qdot_expr e = E(&w->k, "c%d", below(w, 6));

    switch (below(w, 4)) {
    case 0: return qdot_mul(p, e, qdot_fun1(p, QDOT_SIN, random_angle(w)));
    case 1: return qdot_mul(p, e, qdot_fun1(p, QDOT_COS, random_angle(w)));
    case 2:
        return qdot_mul(p, E(&w->k, "q%d", below(w, (int)w->n)),
                        qdot_fun1(p, QDOT_COS, random_angle(w)));
    default: return qdot_mul(p, e, E(&w->k, "q%d*(1 + t)", below(w, (int)w->n)));
    }
}

static qdot_expr
random_scalar(world *w)
{
    qdot_expr e = random_term(w);

    for (int k = below(w, 3); k > 0; k--)
        e = qdot_add(w->k.pool, e, random_term(w));
    return e;
}

static qdot_expr
random_place(world *w, int dim)
{
    qdot_expr e[3];

    for (int d = 0; d < dim; d++)
        e[d] = random_scalar(w);
    return dim == 1 ? e[0] : qdot_vector(w->k.pool, (uint32_t)dim, e);
}

static void
add_kinetic(world *w, qdot_expr m, qdot_expr r)
{
    qdot_pool *p = w->k.pool;
    qdot_expr v = qdot_ddt(p, r);

    w->L =
        qdot_add(p, w->L, qdot_mul(p, qdot_mul(p, QDOT_HALF, m), qdot_mech_dot(p, v, v)));
}

static void
add_body(world *w, int dim)
{
    kit *k = &w->k;
    qdot_pool *p = k->pool;
    qdot_expr r = random_place(w, dim), m = E(k, "mb");

    add_kinetic(w, m, r);
    if (dim == 2) {
        qdot_expr angle = random_scalar(w), spin = qdot_ddt(p, angle);

        must(declare_body(k->scene, "plate", m, E(k, "I"), QDOT_NIL, r, angle,
                             QDOT_NIL));
        w->L = qdot_add(p, w->L, qdot_mul(p, E(k, "I/2"), qdot_pow_int(p, spin, 2)));
    } else {
        static const char *I[9] = {"I1", "a", "b", "a", "I2", "c", "b", "c", "I3"};
        qdot_expr R =
            qdot_scene_euler(p, random_scalar(w), random_scalar(w), random_scalar(w));
        qdot_expr W = qdot_value_mul(p, qdot_transpose(p, R), qdot_ddt(p, R)), e[9],
                  wb[3];

        for (int i = 0; i < 9; i++)
            e[i] = E(k, "%s", I[i]);
        wb[0] = qdot_expr_arg(p, W, 7);
        wb[1] = qdot_expr_arg(p, W, 2);
        wb[2] = qdot_expr_arg(p, W, 3);
        e[0] = qdot_matrix(p, 3, 3, e);
        W = qdot_vector(p, 3, wb);
        must(declare_body(k->scene, "rigid", m, e[0], QDOT_NIL, r, QDOT_NIL, R));
        w->L = qdot_add(
            p, w->L, qdot_mul(p, QDOT_HALF, qdot_dot(p, W, qdot_value_mul(p, e[0], W))));
    }
    if (k->scene->gravities.n)
        w->L =
            qdot_add(p, w->L, qdot_mul(p, m, qdot_dot(p, k->scene->gravities.at[0].e, r)));
}

static void
add_links(world *w, int dim)
{
    kit *k = &w->k;
    qdot_pool *p = k->pool;
    qdot_link link = {.stiffness = E(k, "kk"), .rest = E(k, "rest")};
    qdot_expr u, d;

    link.at[0] = random_place(w, dim);
    link.at[1] = random_place(w, dim);
    u = qdot_value_sub(p, link.at[0], link.at[1]);
    d = qdot_mech_dot(p, u, u);
    if (d == QDOT_ZERO)
        return;
    must(qdot_scene_spring(k->scene, &link));
    d = qdot_sqrt(p, d);
    w->L = qdot_sub(
        p, w->L,
        qdot_mul(p, E(k, "kk/2"), qdot_pow_int(p, qdot_sub(p, d, link.rest), 2)));
    link.rest = QDOT_NIL;
    must(qdot_scene_spring(k->scene, &link));
    w->L = qdot_sub(p, w->L, qdot_mul(p, E(k, "kk/2"), qdot_pow_int(p, d, 2)));
    link.stiffness = E(k, "cc");
    must(qdot_scene_damper(k->scene, &link));
    w->damper[w->dampers] = d;
    w->coefficient[w->dampers++] = link.stiffness;
}

static void
build(world *w, uint64_t seed, bool bodies)
{
    kit *k = &w->k;
    int dim;

    *w = (world){.seed = 0x9e3779b97f4a7c15u * (seed + 1), .L = QDOT_ZERO};
    kit_open(k);
    for (int i = 0; i < 20; i++)
        uniform(w);
    w->n = 1 + (size_t)below(w, 3);
    dim = bodies ? 2 + below(w, 2) : 1 + below(w, 3);
    for (size_t i = 0; i < w->n; i++) {
        char name[32];

        snprintf(name, sizeof name, "q%zu", i);
        coords(k, name);
        w->q[i] = 2 * uniform(w) - 1;
        w->v[i] = 2 * uniform(w) - 1;
        w->a[i] = 2 * uniform(w) - 1;
    }
    if (below(w, 2))
        gravity(k, dim == 1 ? "-g" : dim == 2 ? "(g*t, -g)" : "(0, g/2, -g)");
    for (int i = 0; i < 2; i++) {
        qdot_expr r = random_place(w, dim);
        qdot_expr m = E(k, i ? "m2*(2 + sin(q0 + t))" : "m1");
        char name[4] = {(char)('a' + i), '\0'};

        must(qdot_scene_particle(k->scene, name, m, r));
        add_kinetic(w, m, r);
        if (k->scene->gravities.n)
            w->L =
                qdot_add(k->pool, w->L,
                         qdot_mul(k->pool, m,
                                  qdot_mech_dot(k->pool, k->scene->gravities.at[0].e, r)));
    }
    if (bodies)
        add_body(w, dim);
    add_links(w, dim);
    if (below(w, 2)) {
        qdot_expr V = E(k, "kk*q0^4/4 + b1*cos(t)*q0*q%zu'", w->n - 1);

        if (below(w, 2))
            V = qdot_add(k->pool, V, E(k, "b2*q0'^2*q%zu^2/8", w->n - 1));
        must(qdot_scene_potential(k->scene, V));
        w->L = qdot_sub(k->pool, w->L, V);
    }
    {
        qdot_force f = {.force = random_place(w, dim), .point = random_place(w, dim)};

        must(qdot_scene_force(k->scene, &f));
        w->place[w->forces] = f.point;
        w->force[w->forces++] = f.force;
    }
    must(qdot_pool_check(k->pool));
}

/* d/dt dL/dq' - dL/dq - Q of the path. */
static long double
residual(world *w, size_t i)
{
    kit *k = &w->k;
    long double r = rate(w, w->L, (int64_t)i) - slope(w, w->L, i, false, 0);

    for (size_t f = 0; f < w->forces; f++)
        for (uint32_t d = 0; d < qdot_mech_dimension(k->pool, w->place[f]); d++)
            r -=
                value(w, qdot_mech_component(k->pool, w->force[f], d), w->q, w->v, 0.3L) *
                slope(w, qdot_mech_component(k->pool, w->place[f], d), i, false, 0);
    for (size_t f = 0; f < w->dampers; f++)
        r += value(w, w->coefficient[f], w->q, w->v, 0.3L) * rate(w, w->damper[f], -1) *
             slope(w, w->damper[f], i, false, 0);
    return r;
}

static void
compare(world *w, uint64_t seed)
{
    qdot_expr M = qdot_mech_numeric_mass(w->k.scene);
    qdot_expr f = qdot_mech_numeric_forcing(w->k.scene);

    must(qdot_pool_check(w->k.pool));
    for (size_t i = 0; i < w->n; i++) {
        long double fi =
            value(w, qdot_expr_arg(w->k.pool, f, (uint32_t)i), w->q, w->v, 0.3L);
        long double got = -fi, want = residual(w, i), scale = 1 + fabsl(fi);

        for (size_t j = 0; j < w->n; j++) {
            long double m =
                value(w, qdot_expr_arg(w->k.pool, M, (uint32_t)(i * w->n + j)), w->q,
                      w->v, 0.3L);

            got += m * w->a[j];
            scale += fabsl(m);
        }
        if (!(fabsl(got - want) < 1e-9L * scale))
            fail_msg("scene %d, equation %zu: %.15Lg, want %.15Lg", (int)seed, i, got,
                     want);
    }
}

static void
random_scenes_agree_with_their_lagrangian(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 24; seed++) {
        world w;

        build(&w, seed, false);
        compare(&w, seed);
        kit_close(&w.k);
    }
}

static void
random_bodies_agree_with_their_lagrangian(void **state)
{
    (void)state;
    for (uint64_t seed = 100; seed < 112; seed++) {
        world w;

        build(&w, seed, true);
        compare(&w, seed);
        kit_close(&w.k);
    }
}

/* The equations for people are the same equations: left - right at the path's
 * accelerations. */
static void
equations_for_people_agree_too(void **state)
{
    (void)state;
    for (uint64_t seed = 200; seed < 206; seed++) {
        world w;

        build(&w, seed, seed % 4 == 0);
        for (size_t i = 0; i < w.n; i++) {
            qdot_expr e = qdot_mech_equation(w.k.scene, w.k.scene->coordinates.at[i]);
            long double left = value(&w, lhs(&w.k, e), w.q, w.v, 0.3L);
            long double right = value(&w, rhs(&w.k, e), w.q, w.v, 0.3L);
            long double want = residual(&w, i);

            if (!(fabsl(left - right - want) < 1e-9L * (1 + fabsl(left) + fabsl(right))))
                fail_msg("scene %d, equation %zu: %.15Lg, want %.15Lg", (int)seed, i,
                         left - right, want);
        }
        kit_close(&w.k);
    }
}

static void
stated_lagrangian_gives_the_same_equations(void **state)
{
    (void)state;
    for (uint64_t seed = 300; seed < 308; seed++) {
        world w;
        qdot_scene *stated;

        build(&w, seed, false);
        w.forces = w.dampers = 0;
        stated = qdot_scene_new(w.k.pool);
        for (size_t i = 0; i < w.n; i++)
            must(qdot_scene_coordinate(stated, w.k.scene->coordinates.at[i]));
        must(qdot_scene_lagrangian(stated, w.L));
        qdot_scene_free(w.k.scene);
        w.k.scene = stated;
        compare(&w, seed);
        kit_close(&w.k);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_scenes_agree_with_their_lagrangian),
        cmocka_unit_test(random_bodies_agree_with_their_lagrangian),
        cmocka_unit_test(equations_for_people_agree_too),
        cmocka_unit_test(stated_lagrangian_gives_the_same_equations),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
