/* test_operations.c -- what the tape of a scene costs, against SymPy's cse of the same
 * equations, and that it is the same equations.
 *
 * SymPy's figures: `bench/symbolic/sympy-peer.py direct SCENE N`, line `lowered` (M and f
 * with numbers for the parameters through sympy.cse, counted by count_ops), SymPy 1.11;
 * its lagrange and kane give as many or more.
 */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "sim/scenes.h"

#include <math.h>
#include <stdlib.h>

#include "sim/model/quotient.h"
#include "sim/plan/plan.h"
#include "tape/reference.h"

enum { MOST = 64 };

typedef struct {
    fixture f;
    qdot_expr q[MOST], symbols[2 * MOST + 1], values[2 * MOST + 1];
    size_t n;
} large;

static qdot_expr
named(large *s, bool coordinate_of_it, const char *name, int k)
{
    char text[32];

    snprintf(text, sizeof text, "%s[%d]", name, k);
    return coordinate_of_it ? coordinate(&s->f, text) : parameter(&s->f, text);
}

static void
value(large *s, qdot_expr symbol, qdot_expr number)
{
    s->symbols[s->f.request.n_values] = symbol;
    s->values[s->f.request.n_values++] = number;
}

/* links of masses 1 + k/10 and lengths 2 - k/200: a chain, or hung from link k/2. */
static void
make(large *s, int links, int dim, bool tree)
{
    qdot_expr place[MOST + 1][3], theta[MOST], phi[MOST];
    qdot_pool *pool;

    begin(&s->f);
    pool = s->f.pool;
    s->f.request.symbols = s->symbols;
    s->f.request.values = s->values;
    s->n = 0;
    for (int k = 1; k <= links; k++) {
        theta[k] = named(s, true, "theta", k);
        if (dim == 3)
            phi[k] = named(s, true, "phi", k);
    }
    place[0][0] = place[0][1] = place[0][2] = QDOT_ZERO;
    for (int k = 1; k <= links; k++) {
        qdot_expr l = named(s, false, "l", k), m = named(s, false, "m", k);
        qdot_expr across = times(&s->f, l, qdot_fun1(pool, QDOT_SIN, theta[k]));
        qdot_expr *r = place[k], *from = place[tree ? k / 2 : k - 1];
        char name[32];

        value(s, m, qdot_expr_ratio(pool, 10 + k, 10));
        value(s, l, qdot_expr_ratio(pool, 400 - k, 200));
        r[0] = dim == 2 ? across : times(&s->f, across, qdot_fun1(pool, QDOT_COS, phi[k]));
        if (dim == 3)
            r[1] = times(&s->f, across, qdot_fun1(pool, QDOT_SIN, phi[k]));
        r[dim - 1] =
            qdot_neg(pool, times(&s->f, l, qdot_fun1(pool, QDOT_COS, theta[k])));
        for (int d = 0; d < dim; d++)
            r[d] = qdot_add(pool, from[d], r[d]);
        snprintf(name, sizeof name, "bob[%d]", k);
        must(qdot_scene_particle(s->f.scene, name, m,
                                 qdot_vector(pool, (uint32_t)dim, r)));
    }
    {
        qdot_expr g[3] = {QDOT_ZERO, QDOT_ZERO, QDOT_ZERO};

        g[dim - 1] = qdot_neg(pool, parameter(&s->f, "g"));
        must(qdot_scene_gravity(s->f.scene, qdot_vector(pool, (uint32_t)dim, g)));
        value(s, parameter(&s->f, "g"), number(&s->f, "9.81"));
    }
    s->n = s->f.scene->coordinates.n;
}

static const struct {
    const char *name;
    int links, dim;
    bool tree;
    size_t sympy;
} rows[] = {
    {"planar", 1, 2, false, 9},       {"planar", 2, 2, false, 46},
    {"planar", 3, 2, false, 90},      {"planar", 4, 2, false, 145},
    {"planar", 5, 2, false, 211},     {"planar", 6, 2, false, 288},
    {"planar", 8, 2, false, 475},     {"planar", 12, 2, false, 981},
    {"planar", 16, 2, false, 1663},   {"planar", 32, 2, false, 6151},
    {"spatial", 1, 3, false, 59},     {"spatial", 2, 3, false, 168},
    {"spatial", 3, 3, false, 311},    {"spatial", 4, 3, false, 505},
    {"spatial", 8, 3, false, 1683},   {"tree", 3, 2, true, 79},
    {"tree", 7, 2, true, 255},        {"tree", 15, 2, true, 695},
    {"tree", 31, 2, true, 1751},
};
enum { ROWS = sizeof rows / sizeof *rows };

/* Fewer by a quarter at least, and half from eight links on; a pair of sine and cosine for
 * each base angle and no other call. SymPy counts a sine and a cosine as two. */
static void
tape_costs_less_than_cse(void **state)
{
    (void)state;
    for (int i = 0; i < ROWS; i++) {
        size_t operations, calls, angles;
        qdot_plan *plan;
        large s;

        make(&s, rows[i].links, rows[i].dim, rows[i].tree);
        must(qdot_plan_new(s.f.scene, &s.f.request, &plan));
        calls = qdot_tape_calls(plan->tape);
        operations = qdot_tape_operations(plan->tape) + calls;
        angles = s.n - (rows[i].dim == 3 && rows[i].links == 1); /* phi is cyclic */
        if (calls != angles || 4 * operations >= 3 * rows[i].sympy ||
            (rows[i].links >= 8 && 20 * operations >= 11 * rows[i].sympy))
            fail_msg("%s %d: %zu operations, %zu calls, SymPy %zu", rows[i].name,
                     rows[i].links, operations, calls, rows[i].sympy);
        qdot_plan_free(plan);
        end(&s.f);
    }
}

/* Twice the links, four times the work and not more. */
static void
operations_grow_as_the_square(void **state)
{
    size_t before = 0;

    (void)state;
    for (int links = 8; links <= 32; links *= 2) {
        qdot_plan *plan;
        large s;

        make(&s, links, 2, false);
        must(qdot_plan_new(s.f.scene, &s.f.request, &plan));
        assert_true(before == 0 || qdot_tape_operations(plan->tape) < 4 * before);
        before = qdot_tape_operations(plan->tape);
        assert_true(before <= 3 * (size_t)(links * (links - 1) / 2) + 17 * (size_t)links);
        qdot_plan_free(plan);
        end(&s.f);
    }
}

static uint64_t seed = 99;

static double
uniform(void)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) * 0x1p-53 * 2 - 1;
}

/* left - right of the equation that is printed for coordinate i, at in [3n + 1]. */
static long double
printed(large *s, const qdot_plan *p, size_t i, const long double *in, long double *scale)
{
    qdot_expr e = qdot_mech_equation(s->f.scene, s->f.scene->coordinates.at[i]);
    long double side[2];

    for (uint32_t k = 0; k < 2; k++) {
        qdot_expr x = qdot_plan_substitute(p, qdot_expr_arg(s->f.pool, e, k));

        must(qdot_pool_check(s->f.pool));
        side[k] = reference(s->f.pool, x, 3 * s->n + 1, p->inputs, in).v;
        *scale += fabsl(side[k]);
    }
    return side[0] - side[1];
}

/* M a - f of the tape, for one block that is not constant. */
static void
residuals(const large *s, const qdot_plan *p, const double *in, double *r, double *work,
          double *out)
{
    const double *m = out + s->n;

    qdot_tape_eval(p->tape, in, out, work);
    for (size_t i = 0; i < s->n; i++)
        r[i] = -out[i];
    for (size_t i = 0; i < s->n; i++)
        for (size_t j = 0; j <= i; j++, m++) {
            r[i] += *m * in[2 * s->n + 1 + j];
            if (i != j)
                r[j] += *m * in[2 * s->n + 1 + i];
        }
}

static void
tape_agrees_with_the_printed_equations(void **state)
{
    static const int checked[] = {2, 3, 6, 12, 13, 17};

    (void)state;
    for (size_t c = 0; c < sizeof checked / sizeof *checked; c++) {
        large s;
        qdot_plan *p;
        double *work, *out;

        make(&s, rows[checked[c]].links, rows[checked[c]].dim, rows[checked[c]].tree);
        must(qdot_plan_new(s.f.scene, &s.f.request, &p));
        assert_int_equal(p->structure.blocks, 1);
        work = malloc(qdot_tape_work(p->tape) * sizeof *work);
        out = malloc(qdot_tape_outputs(p->tape) * sizeof *out);
        for (int turn = 0; turn < 3; turn++) {
            double in[3 * MOST + 1], r[MOST];
            long double exact[3 * MOST + 1];

            for (size_t k = 0; k < 3 * s.n + 1; k++)
                exact[k] = in[k] = 3 * uniform();
            residuals(&s, p, in, r, work, out);
            for (size_t i = 0; i < s.n; i++) {
                long double scale = 1, want = printed(&s, p, i, exact, &scale);

                for (size_t j = 0; j < s.n; j++)
                    scale += 30 * fabs(in[2 * s.n + 1 + j]);
                if (!(fabsl(r[i] - want) <= 1e-14L * scale + 1e-12L * fabsl(want)))
                    fail_msg("%s %d, %zu: %.17g, printed %.17Lg",
                             rows[checked[c]].name, rows[checked[c]].links, i, r[i], want);
            }
        }
        free(work);
        free(out);
        qdot_plan_free(p);
        end(&s.f);
    }
}

/* (a r^3 + b r^2 s)/(3 r^2 (1 + r)) keeps neither r above nor r^2 below; what f does not
 * share with M stays, and no power of a sum is taken apart. */
static void
quotients_cancel(void **state)
{
    fixture f;
    qdot_expr r, s, a, b, sum, M, over;
    qdot_pool *pool;

    (void)state;
    begin(&f);
    pool = f.pool;
    r = coordinate(&f, "r");
    s = coordinate(&f, "s");
    a = parameter(&f, "a");
    b = parameter(&f, "b");
    sum = qdot_add(pool, times(&f, a, qdot_pow_int(pool, r, 3)),
                   times(&f, times(&f, b, s), qdot_pow_int(pool, r, 2)));
    over = qdot_add(pool, QDOT_ONE, r);
    M = times(&f, times(&f, qdot_expr_int(pool, 3), over), qdot_pow_int(pool, r, 2));
    assert_int_equal(qdot_quotient(pool, sum, M),
                     qdot_div(pool, qdot_add(pool, times(&f, a, r), times(&f, b, s)),
                              times(&f, qdot_expr_int(pool, 3), over)));
    assert_int_equal(qdot_quotient(pool, sum, s), qdot_div(pool, sum, s));
    /* a number beside them shares nothing */
    sum = qdot_add(pool, sum, QDOT_ONE);
    assert_int_equal(qdot_quotient(pool, sum, M), qdot_div(pool, sum, M));
    /* M a sum itself */
    sum = qdot_add(pool, times(&f, a, over), times(&f, s, qdot_pow_int(pool, over, 2)));
    assert_int_equal(qdot_quotient(pool, sum, over),
                     qdot_add(pool, a, times(&f, s, over)));
    must(qdot_pool_check(pool));
    end(&f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quotients_cancel),
        cmocka_unit_test(tape_costs_less_than_cse),
        cmocka_unit_test(operations_grow_as_the_square),
        cmocka_unit_test(tape_agrees_with_the_printed_equations),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
