/* embed.c -- libqdot from C: a pendulum declared, derived, decided, run and read.
 *
 *     cc embed.c $(pkg-config --cflags --libs qdot) -o embed
 */
#include <stdio.h>
#include <stdlib.h>

#include <qdot.h>

static const char scene[] = "param m, l, g > 0\n"
                            "coord theta\n"
                            "particle bob mass m at (l*sin(theta), -l*cos(theta))\n"
                            "gravity (0, -g)\n"
                            "set m = 1, l = 1, g = 9.81\n"
                            "start theta = 2\n";

/* End the program, with what the library says, unless the call went well. */
static void
need(const qdot_system *system, qdot_result result)
{
    if (result == QDOT_RESULT_OK)
        return;
    fprintf(stderr, "%s: %s", qdot_result_text(result), qdot_system_error(system));
    exit(1);
}

static void
print_formulas(qdot_system *system)
{
    static const char *const wanted[] = {"T", "V", "eom"};
    size_t i;

    for (i = 0; i < sizeof wanted / sizeof *wanted; i++) {
        char *formula;

        need(system, qdot_system_derive(system, wanted[i], QDOT_NOTATION_PLAIN, &formula));
        printf("%s: %s\n", wanted[i], formula);
        qdot_string_free(formula);
    }
}

static void
print_verdict(qdot_system *system, const char *claim)
{
    static const char *const words[] = {"proved", "refuted", "undecided"};
    qdot_truth truth;

    need(system, qdot_system_decide(system, claim, &truth));
    printf("%s: %s\n", claim, words[truth]);
}

static void
print_values(qdot_system *system)
{
    static const double times[] = {0, 2.5, 5, 7.5, 10};
    enum { ROWS = 5, COLUMNS = 2 };
    double values[ROWS][COLUMNS], errors[ROWS][COLUMNS], highest;
    qdot_motion_summary summary;
    qdot_motion *motion;
    int i;

    need(system, qdot_system_run(system, "0..10 tol 1e-12", &motion));
    need(system, qdot_motion_values(motion, "[theta, theta']", ROWS, times, COLUMNS, values[0],
                                    errors[0]));
    for (i = 0; i < ROWS; i++)
        printf("t = %4.1f  theta = %11.8f  theta' = %11.8f%s\n", times[i], values[i][0], values[i][1],
               errors[i][0] < 1e-9 && errors[i][1] < 1e-9 ? "" : " (uncertain)");
    need(system, qdot_motion_over(motion, QDOT_OVER_MAX, "theta'", 0, 10, &highest, NULL));
    printf("largest theta': %.8f\n", highest);
    need(system, qdot_motion_summarize(motion, &summary, sizeof summary));
    printf("method %s, energy drift below 1e-10: %s\n", summary.method,
           summary.energy_drift < 1e-10 ? "yes" : "no");
    qdot_motion_free(motion);
}

int
main(void)
{
    qdot_system *system;
    qdot_result result = qdot_system_new(&system);

    if (result != QDOT_RESULT_OK) {
        fprintf(stderr, "%s\n", qdot_result_text(result));
        return 1;
    }
    need(system, qdot_system_declare(system, scene));
    print_formulas(system);
    print_verdict(system, "conserved energy");
    print_verdict(system, "T == m*l^2*theta'^2");
    print_values(system);
    result = qdot_system_declare(system, "set l = 2, k = 3");
    printf("%s:\n%s", qdot_result_text(result), qdot_system_error(system));
    qdot_system_free(system);
    return 0;
}
