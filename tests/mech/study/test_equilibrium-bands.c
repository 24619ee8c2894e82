/* Rests that dry friction holds: intervals, their ends, what is stable. */
#include "expr/build.h"
#include "mech/kit.h"

#include "base/memory.h"
#include "mech/study/equilibrium-bands.h"
#include "mech/study/equilibrium.h"

/* --- where relations hold ------------------------------------------------------------------ */

/* The intervals of all that hold, each `lo|hi` with [ ] for closed ends. */
static void
bands_are(kit *k, const char *u, size_t n, const char *const *positive, const char *expected)
{
    qdot_expr relation[4], x = E(k, "%s", u);
    qdot_bands bands;
    bool found;
    char text[400] = "";

    for (size_t i = 0; i < n; i++)
        relation[i] = qdot_rel(k->pool, QDOT_LE, QDOT_ZERO, E(k, "%s", positive[i]));
    must(qdot_bands_find(k->pool, x, n, relation, NULL, &bands, &found));
    if (!found)
        strcat(text, "not found");
    else if (bands.whole)
        strcat(text, "whole");
    for (size_t i = 0; i < bands.at.n && found; i++) {
        const qdot_band *b = &bands.at.at[i];

        strcat(text, i == 0 ? "" : " ");
        strcat(text, b->lo_open ? "(" : "[");
        strcat(text, b->lo == QDOT_NIL ? "" : show(k, b->lo));
        strcat(text, "|");
        strcat(text, b->hi == QDOT_NIL ? "" : show(k, b->hi));
        strcat(text, b->hi_open ? ")" : "]");
        strcat(text, b->numeric ? "~" : "");
    }
    assert_string_equal(text, expected);
    qdot_bands_clear(&bands);
}

static void
relations_hold_between_their_zeros_body(kit *k)
{
    coords(k, "x");
    bands_are(k, "x", 1, (const char *[]){"1 - x^2"}, "[-1|1]");
    bands_are(k, "x", 1, (const char *[]){"x^2 - 1"}, "(|-1] [1|)");
    bands_are(k, "x", 2, (const char *[]){"x^2 - 1", "4 - x^2"}, "[-2|-1] [1|2]");
    bands_are(k, "x", 1, (const char *[]){"-x^2"}, "[0|0]");
    bands_are(k, "x", 1, (const char *[]){"x^2*(1 - x)"}, "(|1]"); /* touched at 0 */
    bands_are(k, "x", 1, (const char *[]){"-1 - x^2"}, "");
    bands_are(k, "x", 1, (const char *[]){"1 + x^2"}, "whole");
    bands_are(k, "x", 1, (const char *[]){"1/x"}, "(0|)"); /* a sign changes at a pole */
    bands_are(k, "x", 1, (const char *[]){"x*sin(x) - 3"}, "not found"); /* without end */
    bands_are(k, "x", 1, (const char *[]){"2 - x - exp(x)"}, "(|0.442854401002389]~");
}
TEST(relations_hold_between_their_zeros)

/* An angle: an interval over pi is one. */
static void
a_circle_has_no_ends_body(kit *k)
{
    coords(k, "x");
    bands_are(k, "x", 1, (const char *[]){"-cos(x)"}, "[1/2*pi|3/2*pi]");
    bands_are(k, "x", 1, (const char *[]){"cos(x)"}, "[-1/2*pi|1/2*pi]");
    bands_are(k, "x", 1, (const char *[]){"cos(x) + 2"}, "whole");
}
TEST(a_circle_has_no_ends)

static void
linear_relations_may_have_parameters_body(kit *k)
{
    coords(k, "x");
    bands_are(k, "x", 2, (const char *[]){"b - k*x", "b + k*x"}, "[-b/k|b/k]");
    bands_are(k, "x", 1, (const char *[]){"(alpha - beta)*x - 1"}, "not found"); /* either side */
}
TEST(linear_relations_may_have_parameters)

/* --- rests --------------------------------------------------------------------------------- */

typedef struct {
    const char *coordinates, *V, *friction, *more; /* friction on x, another force on y */
    size_t n;                                       /* of rests */
    const char *range;                              /* of the first */
    qdot_stability stability;
    const char *when;
} row;

static const row rows[] = {
    {"x", "x^2/2", "-sign(x')/2", NULL, 1, "[x >= -1/2, x <= 1/2]", QDOT_STABLE, "nil"},
    /* off the top: beyond the ends the force points away */
    {"x", "-x^2/2", "-sign(x')/2", NULL, 1, "[x >= -1/2, x <= 1/2]", QDOT_STABLE,
     "[x > -1/2, x < 1/2]"},
    {"x", "x^3/3", "-sign(x')", NULL, 1, "[x >= -1, x <= 1]", QDOT_STABLE, "[x > -1]"},
    {"x", "cos(x)", "-sign(x')/2", NULL, 2, "[x >= -1/6*pi, x <= 1/6*pi]", QDOT_STABLE,
     "[x > -1/6*pi, x < 1/6*pi]"},
    {"x", "2*x", "-sign(x')", NULL, 0, NULL, QDOT_STABLE, NULL},
    /* what drives is weaker than friction near rest, but not at an end, where friction is used up */
    {"x", "x^2/2", "-sign(x')/2 + 3*x'", NULL, 1, "[x >= -1/2, x <= 1/2]", QDOT_STABLE,
     "[x > -1/2, x < 1/2]"},
    /* friction that drives holds nothing */
    {"x", "x^2/2", "sign(x')", NULL, 1, "nil", QDOT_STABILITY_UNDECIDED, "nil"},
    /* y without friction: at a least V of it, or not; x stays where friction holds it */
    {"x y", "x^2/2 + y^2/2", "-sign(x')", NULL, 1, "[x >= -1, x <= 1]", QDOT_STABLE,
     "[x > -1, x < 1]"},
    {"x y", "x^2/2 - y^2/2", "-sign(x')", NULL, 1, "[x >= -1, x <= 1]", QDOT_UNSTABLE, "nil"},
    {"x y", "-x^2/2 + y^2/2", "-sign(x')", "-sign(y')", 1, "nil", QDOT_STABLE,
     "[x > -1, x < 1, y < 1, y > -1]"},
};

static void
rests_under_friction_body(kit *k)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const row *r = &rows[i];
        qdot_equilibria all;

        if (i > 0) {
            kit_close(k);
            kit_open(k);
        }
        coords(k, r->coordinates);
        must(qdot_scene_lagrangian(k->scene, E(k, strchr(r->coordinates, 'y') != NULL
                                                      ? "(x'^2 + y'^2)/2 - (%s)"
                                                      : "x'^2/2 - (%s)",
                                               r->V)));
        torque(k, r->friction, "x");
        if (r->more != NULL)
            torque(k, r->more, "y");
        must(qdot_equilibrium_find(k->scene, NULL, NULL, &all));
        if (all.n != r->n)
            fail_msg("%s: %zu rests", r->V, all.n);
        if (all.n > 0) {
            assert_string_equal(show(k, all.at[0].range), r->range);
            assert_string_equal(show(k, all.at[0].stable_when), r->when);
            if (all.at[0].stability != r->stability)
                fail_msg("%s: stability %d", r->V, (int)all.at[0].stability);
        }
        assert_true(all.complete);
        qdot_equilibria_clear(&all);
    }
}
TEST(rests_under_friction)

/* Out of memory at the n-th allocation, for n up to where it passes. */
static void
survives_failed_allocations_too_body(kit *k)
{
    qdot_status status = QDOT_ENOMEM;
    int64_t n = 0;

    coords(k, "x");
    must(qdot_scene_lagrangian(k->scene, E(k, "x'^2/2 - x^2/2 - alpha*cos(x)/beta")));
    torque(k, "-sign(x')/2", "x");
    for (; status != QDOT_OK && n < 200000; n += 1 + n / 30) {
        qdot_equilibria all = {0};

        k->scene->version++; /* derive again */
        qdot_memory_fail_at(n);
        status = qdot_equilibrium_find(k->scene, NULL, NULL, &all);
        qdot_memory_fail_at(-1);
        assert_true(status == QDOT_OK || status == QDOT_ENOMEM);
        qdot_equilibria_clear(&all);
    }
    assert_true(status == QDOT_OK && n > 20);
}
TEST(survives_failed_allocations_too)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(relations_hold_between_their_zeros),
        cmocka_unit_test(a_circle_has_no_ends),
        cmocka_unit_test(linear_relations_may_have_parameters),
        cmocka_unit_test(rests_under_friction),
        cmocka_unit_test(survives_failed_allocations_too),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
