/* Ctrl-C wherever it is heard: a statement ends and says so, and the session is as good as before. */
#include "base/interrupt.h"
#include "base/memory.h"
#include "lang/talk.h"
#include "own-folder.h"

#include <inttypes.h>
#include <pthread.h>

/* Scenes and statements that run, search, read or write; each short, for it is done once for every check. */
static const struct {
    const char *name, *scene, *statement;
} cases[] = {
    {"a run beside its companions", "coord x\nparticle p mass 1 at x\npotential x^2/2\nstart x = 1",
     "run 0..5"},
    {"a run with events",
     "coord y\nparticle p mass 1 at y\ngravity -1\nstart y = 1\n"
     "event floor: y = 0 falling then y' = -y'/2",
     "run 0..4"},
    {"a run with a switch", "coord x\nparticle p mass 1 at x\nforce -sign(x) on p\nstart x = 1",
     "run 0..5"},
    {"a run under a constraint",
     "coord x, y\nparticle p mass 1 at (x, y)\ngravity (0, -1)\nconstraint rod: x^2 + y^2 = 1\n"
     "start x = 1, y = 0",
     "run 0..2"},
    {"a run in digits", "coord x\nparticle p mass 1 at x\npotential x^2/2\nstart x = 1",
     "run 0..1 digits 30"},
    {"a stiff run", "coord x\nparticle p mass 1 at x\nforce -1e6*(x - cos(t)) - 1e4*x' on p\nstart x = 1",
     "run 0..1 method radau"},
    {"a run of fixed steps", "coord x\nparticle p mass 1 at x\npotential x^2/2\nstart x = 1",
     "run 0..1 method composition8"},
    {"what is read from a run",
     "coord x\nparticle p mass 1 at x\npotential x^4/4\nstart x = 1\nrun 0..5",
     "value(x, 2)\nmax(x)\nmean(x^2)"},
    {"a sweep", "param k = 1\ncoord x\nparticle p mass 1 at x\npotential k*x^2/2\nstart x = 1",
     "sweep k = 1..2 count 3 run 0..1 : x threads 1"},
    {"exponents", "coord x\nparticle p mass 1 at x\npotential x^2/2\nstart x = 1",
     "lyapunov 0..10"},
    {"an unknown", "param k = 1\ncoord x\nparticle p mass 1 at x\npotential k*x^2/2\nstart x = 1",
     "find k = 2 such that value(x, 1) = 0"},
    {"equations and rests",
     "param m > 0, l > 0, g > 0\ncoord theta\nparticle p mass m at (l*sin(theta), -l*cos(theta))\ngravity (0, -g)",
     "eom\nequilibria\nsimplify(sin(theta)^2 + cos(theta)^2)"},
    {"branches of equilibria", "param P = 1\ncoord x\nparticle p mass 1 at x\npotential x^4/4 - P*x^2/2",
     "continue equilibria in P = -0.1..0.1"},
    {"a branch of orbits",
     "param F = 1\ncoord x\nparticle p mass 1 at x\npotential x^2/2\nforce F*cos(2*t) - x' on p\n"
     "find x = 0, x' = 0 such that returns after pi",
     "continue orbit in F = 1..1.02"},
    {"a section",
     "coord x\nparticle p mass 1 at x\npotential x^4/4\nstart x = 1\nrun 0..20",
     "poincare x = 0 rising : x'"},
    {"slopes", "param k = 1\ncoord x\nparticle p mass 1 at x\npotential k*x^2/2\nstart x = 1\nrun 0..2",
     "sensitivity value(x, 2) of k, x"},
    {"equations as functions",
     "param l > 0\ncoord a, b\nparticle p mass 1 at (l*sin(a), -l*cos(a))\n"
     "particle q mass 1 at (l*sin(a) + l*sin(2*a + b), -l*cos(a) - l*cos(2*a + b))\ngravity (0, -1)",
     "export c eom to \"motion.c\""},
};

/* Carry out the statement with Ctrl-C at the n-th place, then once more; whether none was reached. */
static bool
survives(size_t i, const char *place, void (*press_at)(int64_t n), int64_t n)
{
    bool done;
    void *data;
    talk *k;
    int ended;

    assert_int_equal(begin(&data), 0);
    k = data;
    if (say(k, cases[i].scene) != 0)
        fail_msg("%s: %s", cases[i].name, complaint(k));
    press_at(n);
    ended = say(k, cases[i].statement);
    press_at(-1);
    done = ended == 0;
    qdot_interrupt_clear(); /* it came behind the last check */
    (void)complaint(k);
    ended = say(k, cases[i].statement);
    if (ended != 0)
        fail_msg("%s: after %s %" PRId64 " the same statement ends with %d: %s", cases[i].name, place, n, ended,
                 complaint(k));
    end(&data);
    return done;
}

static void
at_every_place(const char *place, void (*press_at)(int64_t n), int64_t dense)
{
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        int64_t n = 0;

        for (int ends = 0; ends < 3; n += 1 + n / dense) /* the last ones may be behind the last check */
            ends = survives(i, place, press_at, n) ? ends + 1 : 0;
        print_message("# %s: %s up to %" PRId64 "\n", cases[i].name, place, n);
    }
}

static void
press_at_check(int64_t n)
{
    qdot_interrupt_set_at((int)n);
}

static void
every_check_may_be_the_one(void **state)
{
    (void)state;
    at_every_place("check", press_at_check, 100);
}

static void
it_may_come_between_checks(void **state)
{
    (void)state;
    at_every_place("allocation", qdot_memory_press_at, 40);
}

static void *
run_all(void *failed)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_check_may_be_the_one),
        cmocka_unit_test(it_may_come_between_checks),
    };

    *(int *)failed = cmocka_run_group_tests(tests, own_folder_enter, own_folder_leave);
    return NULL;
}

/* On a thread of its own, whose end ends the one that computes exactly for it: each computation that is left ends one,
 * and when numbers of threads come again LeakSanitizer takes a new one for one that ended, and what it holds for lost. */
int
main(void)
{
    pthread_t all;
    int failed = 1;

    if (pthread_create(&all, NULL, run_all, &failed) == 0)
        (void)pthread_join(all, NULL);
    return failed;
}
