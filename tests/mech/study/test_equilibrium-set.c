/* Equilibria as functions of one parameter, against closed forms: members, walls, verdicts. */
#include "mech/kit.h"

#include "base/memory.h"
#include "mech/study/equilibrium-set.h"

static qdot_expr
bind_nothing(void *user, qdot_expr e)
{
    (void)user;
    return e;
}

typedef struct {
    const char *V;         /* of x and alpha, which runs from 1 to 4 */
    bool complete;
    const char *walls;     /* between these */
    double at;             /* a value of alpha, and the places there */
    const char *places;
    const char *verdicts;  /* of these: s stable, u unstable, - undecided; C before one at a corner */
} row;

static const row rows[] = {
    {"x^4/4 - (alpha - 2)*x^2/2", true, "2", 3, "0 -1 1", "-ss"},
    {"x^4/4 - (alpha - 2)*x^2/2", true, "2", 1.5, "0", "s"},
    /* an island, a part in three thousand of the range */
    {"x^3/3 + ((alpha - 2)^2 - 1/4000000)*x", true, "1.9995 2.0005", 2, "-0.0005 0.0005", "us"},
    {"abs(x) + x^2/2 - alpha*x/2", true, "2", 1.5, "0", "Cs"},
    {"abs(x) + x^2/2 - alpha*x/2", true, "2", 3, "0.5", "s"},
    /* a divisor is a wall */
    {"x^2/2 - x/(alpha - 2)", true, "2", 1.5, "-2", "s"},
    /* so is where a formula jumps or has a kink */
    {"x^2/2 - sign(alpha - 2)*x", true, "2", 1.5, "-1", "s"},
    {"x^2/2 - floor(alpha)*x", true, "2 3", 2.5, "2", "s"},
    {"x^2/2 - mod(alpha, 3/2)*x", true, "1.5 3", 2.5, "1", "s"},
    {"x^2/2 - atan2(alpha - 2, -1)*x", true, "2", 3, "2.35619449", "s"},
    {"x^2/2 - max(alpha, 3)*x", true, "3", 2, "3", "s"},
    /* not solved for: the walls are where curves turn */
    {"x^3/3 + ((alpha - 2)^2 - 1/4000000)*x + exp(x)/10000000", false, "", 2, "", ""},
};

static void
set_is(qdot_equilibrium_set *set, const row *r)
{
    char text[400] = "", verdicts[40] = "";
    size_t n = 0;

    assert_int_equal(set->complete, r->complete);
    assert_true(set->wall.at[0] == 1 && set->wall.at[set->wall.n - 1] == 4);
    for (size_t i = 1; i + 1 < set->wall.n; i++)
        n += (size_t)snprintf(text + n, sizeof text - n, "%s%.12g", i == 1 ? "" : " ", set->wall.at[i]);
    if (r->complete)
        assert_string_equal(text, r->walls);
    else
        assert_int_equal(set->wall.n, 4); /* two folds */
    n = 0;
    text[0] = '\0';
    for (size_t k = 0; k < set->member.n; k++) {
        double y[2] = {0, r->at};
        qdot_stability verdict;
        bool exists;

        must(qdot_equilibrium_set_place(set, k, y, &exists));
        if (!exists)
            continue;
        must(qdot_equilibrium_set_judge(set, k, r->at, &verdict));
        strcat(verdicts, set->member.at[k].corner ? "C" : "");
        strcat(verdicts, verdict == QDOT_STABLE ? "s" : verdict == QDOT_UNSTABLE ? "u" : "-");
        n += (size_t)snprintf(text + n, sizeof text - n, "%s%.9g", n == 0 ? "" : " ", y[0] + 0.0);
    }
    if (strcmp(text, r->places) != 0 || strcmp(verdicts, r->verdicts) != 0)
        fail_msg("%s at %g: %s (%s)", r->V, r->at, text, verdicts);
}

static void
members_and_walls_body(kit *k)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        qdot_equilibrium_curve c = {0};
        qdot_equilibrium_set set = {0};

        if (i > 0) {
            kit_close(k);
            kit_open(k);
        }
        coords(k, "x");
        must(qdot_scene_lagrangian(k->scene, E(k, "x'^2/2 - (%s)", rows[i].V)));
        must(qdot_equilibrium_curve_begin(&c, k->scene, E(k, "alpha"), bind_nothing, NULL));
        must(qdot_equilibrium_set_begin(&set, &c, 1, 4));
        set_is(&set, &rows[i]);
        qdot_equilibrium_set_end(&set);
        qdot_equilibrium_curve_end(&c);
    }
}
TEST(members_and_walls)

/* Out of memory at the n-th allocation, for n up to where it passes. */
static void
survives_failed_allocations_body(kit *k)
{
    qdot_status status = QDOT_ENOMEM;
    qdot_expr alpha;
    int64_t n = 0;

    coords(k, "x");
    alpha = E(k, "alpha");
    must(qdot_scene_lagrangian(k->scene, E(k, "x'^2/2 - abs(x) - x^2/2 + alpha*x/2")));
    for (; status != QDOT_OK && n < 200000; n += 1 + n / 30) {
        qdot_equilibrium_curve c = {0};
        qdot_equilibrium_set set = {0};

        k->scene->version++; /* derive again */
        qdot_memory_fail_at(n);
        status = qdot_equilibrium_curve_begin(&c, k->scene, alpha, bind_nothing, NULL);
        if (status == QDOT_OK)
            status = qdot_equilibrium_set_begin(&set, &c, 1, 4);
        qdot_memory_fail_at(-1);
        assert_true(status == QDOT_OK || status == QDOT_ENOMEM);
        qdot_equilibrium_set_end(&set);
        qdot_equilibrium_curve_end(&c);
    }
    assert_true(status == QDOT_OK && n > 20);
}
TEST(survives_failed_allocations)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(members_and_walls),
        cmocka_unit_test(survives_failed_allocations),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
