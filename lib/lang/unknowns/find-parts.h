/* find-parts.h -- what `find` is asked, between the reading of it and the search.
 *
 *     find NAME = A..B, NAME = GUESS, ... such that A = B, returns after T [run T0..T1 ...] [as NAME]
 *
 * Tests  tests/script/studies/find.sh, tests/bad/studies/find-*.lag
 */
#ifndef QDOT_LANG_FIND_PARTS_H
#define QDOT_LANG_FIND_PARTS_H

#include "lang/runs/run-options.h"
#include "lang/slopes/slopes.h"
#include "sim/study/shooting.h"

typedef struct {
    const qdot_token *from;
    const qdot_compiled *side[2]; /* both sides, owned by the record; for a return: the time, twice */
    bool returns;
} qdot_find_condition;

typedef struct {
    qdot_record *record;
    qdot_cursor *c; /* cursor of `record` */
    qdot_slope_names unknowns;
    qdot_vec(double) guess, low, high; /* guessed values and bounds of the unknowns; infinite bounds with a guess only */
    size_t pushed; /* number of unknowns not declared elsewhere, whose names are bound temporarily */
    qdot_vec(qdot_find_condition) conditions;
    bool returns;             /* some condition is that the motion returns to its start */
    const qdot_token *run_at; /* the word `run`; NULL: not given */
    qdot_run_options run;     /* options of the run, or of the latest run */
    const qdot_run_report
        *latest; /* report of the latest run, borrowed; NULL: none, or `run` was given */
    qdot_expr latest_from, latest_to;
} qdot_find;

/* Search for a solution, and print it. */
QDOT_MUST_CHECK qdot_status qdot_find_carry_out(qdot_find *f);

/* The number of residuals that must vanish for the conditions to hold. */
size_t qdot_find_count(const qdot_find *f);
/* The limits of the run for unknowns that are in force; they may hold unknowns. QDOT_EINVAL: nothing says how
 * long it is. */
QDOT_MUST_CHECK qdot_status qdot_find_limits(const qdot_find *f, qdot_expr *from,
                                             qdot_expr *to);
/* The guess r->u of a periodic orbit, moved to the orbit (r->found) by multiple shooting where motions near it grow
 * (sim/study/shooting.h); as it was where these do not, where it does not lead to one, or where more than a return
 * is asked for. */
QDOT_MUST_CHECK qdot_status qdot_find_shoot(const qdot_find *f, qdot_shooting_result *r);
/* Set the residuals [qdot_find_count] of the conditions, which must be 0, as expressions of the latest run. */
QDOT_MUST_CHECK qdot_status qdot_find_residuals(const qdot_find *f, qdot_expr from,
                                                qdot_expr *e);

/* Sizes [qdot_find_count] of what is subtracted in e, of the run: of a condition the sum of its terms, of a return how
 * large a coordinate or velocity becomes. */
QDOT_MUST_CHECK qdot_status qdot_find_sizes(const qdot_find *f, qdot_run *run, const qdot_expr *e, double *size);

/* The cost of the runs made by a search so far. Starts as {0}. */
typedef struct {
    double first, length, spent; /* work and duration of the first run; work of all runs so far */
} qdot_find_budget;

/* QDOT_EFAILED if a further run of that length would exceed the budget of the search. */
QDOT_MUST_CHECK qdot_status qdot_find_spend(qdot_find_budget *b, double length);
/* Add the cost of `runs` runs, each like this one, to the cost of the search. */
void qdot_find_spent(qdot_find_budget *b, qdot_run *run, size_t runs);

#endif
