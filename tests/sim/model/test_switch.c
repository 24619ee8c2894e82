/* test_switch.c -- switches inside switches: random nestings of t, q and q' against the same
 * motion followed here, piece by piece, by another evaluation of them. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "sim/scenes.h"

#include <math.h>

/* --- nestings ------------------------------------------------------------------------ */

enum { T, X, V, C, ADD, MUL, ABS, SIGN, FLOOR, MOD, MIN, MAX, IF, IFAND, KINDS };

/* A node; of IF the comparison is at[0] < at[1], of IFAND at[2] < at[3] too. */
typedef struct {
    int kind, at[6];
    int tenths; /* of C, and of MOD what it is modulo */
} node;

enum { MOST_NODES = 200 };

typedef struct {
    node at[MOST_NODES];
    int n;
    double side[MOST_NODES];
    uint32_t random;
} nest;

static int
draw(nest *e, int below)
{
    e->random = e->random * 1664525u + 1013904223u;
    return (int)((e->random >> 8) % (unsigned)below);
}

static int
add_node(nest *e, node x)
{
    assert_true(e->n < MOST_NODES);
    e->at[e->n] = x;
    return e->n++;
}

/* Of depth levels, from the leaves 0 ... leaves - 1: t, x, x'. */
static int
grow(nest *e, int depth, int leaves)
{
    node x = {.kind = depth == 0 ? draw(e, leaves) : ADD + draw(e, KINDS - ADD)};
    int n = x.kind == IFAND ? 6 : x.kind == IF ? 4 : x.kind >= MIN || x.kind <= MUL ? 2 : 1;

    if (depth == 0)
        return add_node(e, x);
    x.tenths = 3 + draw(e, 17);
    for (int i = 0; i < n; i++) {
        bool constant = (x.kind == ADD || x.kind == MUL || i > 0) && draw(e, 2);

        x.at[i] = constant ? add_node(e, (node){.kind = C, .tenths = draw(e, 31) - 15})
                           : grow(e, i == 0 ? depth - 1 : draw(e, depth), leaves);
    }
    return add_node(e, x);
}

/* Its value: by the sides in e->side, or by those that it has, put there. */
static double
value(nest *e, int i, const double *in, bool frozen)
{
    const node *x = &e->at[i];
    double a[6] = {0}, *side = &e->side[i];
    int n = x->kind == IFAND ? 6 : x->kind == IF ? 4 : x->kind >= MIN || x->kind <= MUL ? 2 : 1;

    for (int k = 0; k < n && x->kind > C; k++)
        a[k] = value(e, x->at[k], in, frozen);
    switch (x->kind) {
    case T: case X: case V: return in[x->kind];
    case C: return x->tenths / 10.0;
    case ADD: return a[0] + a[1];
    case MUL: return a[0] * a[1];
    default: break;
    }
    if (!frozen)
        *side = x->kind == FLOOR   ? floor(a[0])
                : x->kind == MOD   ? floor(a[0] / (x->tenths / 10.0))
                : x->kind == MIN   ? a[0] <= a[1]
                : x->kind == MAX   ? a[0] >= a[1]
                : x->kind == IF    ? a[0] < a[1]
                : x->kind == IFAND ? a[0] < a[1] && a[2] < a[3]
                                   : (a[0] > 0) - (a[0] < 0);
    switch (x->kind) {
    case ABS: return *side * a[0];
    case SIGN: case FLOOR: return *side;
    case MOD: return a[0] - *side * (x->tenths / 10.0);
    case MIN: case MAX: return *side ? a[0] : a[1];
    case IF: return *side ? a[2] : a[3];
    default: return *side ? a[4] : a[5];
    }
}

static qdot_expr
expression(fixture *f, const nest *e, int i, const qdot_expr *leaves)
{
    static const qdot_fun_id function[KINDS] = {
        [ABS] = QDOT_ABS, [SIGN] = QDOT_SIGN, [FLOOR] = QDOT_FLOOR, [MOD] = QDOT_MOD,
        [MIN] = QDOT_MIN, [MAX] = QDOT_MAX};
    const node *x = &e->at[i];
    int n = x->kind == IFAND ? 6 : x->kind == IF ? 4 : x->kind >= MIN || x->kind <= MUL ? 2 : 1;
    qdot_expr a[6], both[2];

    if (x->kind < C)
        return leaves[x->kind];
    if (x->kind == C)
        return qdot_div(f->pool, qdot_expr_int(f->pool, x->tenths), qdot_expr_int(f->pool, 10));
    for (int k = 0; k < n; k++)
        a[k] = expression(f, e, x->at[k], leaves);
    switch (x->kind) {
    case ADD: return qdot_add(f->pool, a[0], a[1]);
    case MUL: return qdot_mul(f->pool, a[0], a[1]);
    case IF:
        return qdot_fun(f->pool, QDOT_IF, 3,
                        (qdot_expr[]){qdot_rel(f->pool, QDOT_LT, a[0], a[1]), a[2], a[3]});
    case IFAND:
        both[0] = qdot_rel(f->pool, QDOT_LT, a[0], a[1]);
        both[1] = qdot_rel(f->pool, QDOT_LT, a[2], a[3]);
        return qdot_fun(f->pool, QDOT_IF, 3,
                        (qdot_expr[]){qdot_logic(f->pool, QDOT_AND, 2, both), a[4], a[5]});
    case MOD:
        a[1] = qdot_div(f->pool, qdot_expr_int(f->pool, x->tenths), qdot_expr_int(f->pool, 10));
        return qdot_fun(f->pool, QDOT_MOD, 2, a);
    default: return qdot_fun(f->pool, function[x->kind], (uint32_t)n, a);
    }
}

/* --- pieces, one by one -------------------------------------------------------------- */

/* x'' = -x - x'/5 + F. */
static void
rates(nest *e, const double *y, double *out)
{
    out[T] = 1;
    out[X] = y[V];
    out[V] = -y[X] - y[V] / 5 + value(e, e->n - 1, y, true);
}

/* One step of length h of Kutta's method by the sides at hand. */
static void
step(nest *e, const double *y, double h, double *out)
{
    static const double part[] = {0, 0.5, 0.5, 1}, weight[] = {1, 2, 2, 1};
    double k[3] = {0}, sum[3] = {0};

    for (int s = 0; s < 4; s++) {
        double at[3];

        for (int i = 0; i < 3; i++)
            at[i] = y[i] + h * part[s] * k[i];
        rates(e, at, k);
        for (int i = 0; i < 3; i++)
            sum[i] += weight[s] * k[i] / 6;
    }
    for (int i = 0; i < 3; i++)
        out[i] = y[i] + h * sum[i];
}

static bool
same_sides(nest *e, const double *y)
{
    double kept[MOST_NODES];
    bool same = true;

    memcpy(kept, e->side, sizeof kept);
    (void)value(e, e->n - 1, y, false);
    for (int i = 0; i < e->n; i++)
        same = same && kept[i] == e->side[i];
    memcpy(e->side, kept, sizeof kept);
    return same;
}

/* From y to time t; false where switches do not end, as where the motion would slide. */
static bool
follow(nest *e, double *y, double t)
{
    const double h = 1e-3 * (t < y[T] ? -1 : 1), past = 1e-12 * h / fabs(h);
    double next[3];
    int switches = 0;

    (void)value(e, e->n - 1, y, false);
    step(e, y, past, next);
    (void)value(e, e->n - 1, next, false); /* the sides right behind the start */
    for (;;) {
        double lo = 0, hi = fabs(t - y[T]) < fabs(h) ? t - y[T] : h;

        if (hi / h < 1e-9)
            return true;
        step(e, y, hi, next);
        if (same_sides(e, next)) {
            memcpy(y, next, sizeof next);
            continue;
        }
        for (int k = 0; k < 60; k++) {
            double middle = (lo + hi) / 2;

            step(e, y, middle, next);
            *(same_sides(e, next) ? &lo : &hi) = middle;
        }
        step(e, y, hi + past, next);
        step(e, y, hi, y);
        (void)value(e, e->n - 1, next, false);
        if (++switches > 400)
            return false;
    }
}

/* --- runs ---------------------------------------------------------------------------- */

static const char *const methods[] = {"auto", "dop853", "rk8pd", "rkf45", "msadams", "bsimp"};

/* The run from y0 to time t by a method; whether it was carried out, then with its end. */
static bool
carried_out(fixture *f, const char *method, double tol, qdot_expr from, qdot_expr to,
            double *end, double *error)
{
    const qdot_run_report *report;
    qdot_run *r = NULL;

    f->request.method = method;
    f->request.tol = tol;
    f->request.t0 = from;
    f->request.t1 = to;
    if (qdot_run_new(f->scene, &f->request, &r) != QDOT_OK)
        fail_msg("%s", qdot_last_error()->message);
    report = qdot_run_get_report(r);
    end[X] = report->q[0];
    end[V] = report->v[0];
    *error = report->error;
    bool done = report->status == QDOT_RUN_DONE;
    qdot_run_free(r);
    return done;
}

static void
nestings_agree(int seeds, int leaves, int most_depth, int least_done)
{
    int done = 0;

    for (int seed = 0; seed < seeds; seed++) {
        nest e = {.random = (uint32_t)seed * 2654435761u + 12345u};
        double y[3] = {0, 0.3, 0.7}, end_state[3], error;
        const bool back = seed % 3 == 2;
        bool known;
        qdot_expr x, leaf[3];
        fixture f;

        grow(&e, 1 + draw(&e, most_depth), leaves);
        begin(&f);
        x = coordinate(&f, "x");
        leaf[T] = QDOT_T;
        leaf[X] = x;
        leaf[V] = velocity(&f, x);
        must(qdot_scene_particle(f.scene, "p", QDOT_ONE, x));
        must(qdot_scene_potential(
            f.scene, qdot_mul(f.pool, QDOT_HALF, qdot_mul(f.pool, x, x))));
        must(qdot_scene_torque(
            f.scene,
            &(qdot_torque){.coordinate = x,
                           .torque = qdot_sub(
                               f.pool, expression(&f, &e, e.n - 1, leaf),
                               qdot_div(f.pool, leaf[V], qdot_expr_int(f.pool, 5)))}));
        f.q0[0] = number(&f, "0.3");
        f.v0[0] = number(&f, "0.7");
        known = follow(&e, y, back ? -4 : 4);
        if (carried_out(&f, methods[seed % 6], seed % 6 ? 1e-10 : 1e-12, QDOT_ZERO,
                        qdot_expr_int(f.pool, back ? -4 : 4), end_state, &error)
            && !isnan(error)) {
            const double by = fmax(fabs(end_state[X] - y[X]), fabs(end_state[V] - y[V]))
                              / fmax(1, fmax(fabs(y[X]), fabs(y[V])));

            done++;
            if (!known || !(by <= 1e-7 + 10 * error))
                fail_msg("seed %d of %d leaves by %s: off by %.3g, stated %.3g", seed, leaves,
                         methods[seed % 6], by, error);
        }
        end(&f);
    }
    if (done < least_done)
        fail_msg("only %d of %d were carried out", done, seeds);
}

static void
nestings_of_time_agree(void **state)
{
    (void)state;
    nestings_agree(90, 1, 4, 80);
}

static void
nestings_of_time_and_place_agree(void **state)
{
    (void)state;
    nestings_agree(90, 2, 3, 60);
}

static void
nestings_of_velocity_agree(void **state)
{
    (void)state;
    nestings_agree(60, 3, 3, 30);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nestings_of_time_agree),
        cmocka_unit_test(nestings_of_time_and_place_agree),
        cmocka_unit_test(nestings_of_velocity_agree),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
