/* range.c -- finds the maximum, minimum, mean and drift over a time range of a run. */
#include "lang/session/range.h"

#include <string.h>

#include "base/text.h"
#include "expr/build.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/member.h"
#include "lang/session/mixture.h"
#include "lang/session/runs.h"

static const struct {
    const char *word;
    qdot_range_kind kind;
} words[] = {{"max", QDOT_RANGE_MAX},
             {"min", QDOT_RANGE_MIN},
             {"mean", QDOT_RANGE_MEAN},
             {"drift", QDOT_RANGE_DRIFT}};

bool
qdot_range_is_word(const char *word)
{
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(words[i].word, word) == 0)
            return true;
    return false;
}

bool
qdot_range_is_of_way(const char *word)
{
    return qdot_range_is_word(word) || strcmp(word, "value") == 0;
}

static qdot_status
evaluate_over_several_runs(qdot_session *session, const char *run, qdot_range_kind kind, qdot_expr e,
                           const double *range, qdot_expr *value)
{
    qdot_mixture *mixture;
    double x, error;
    qdot_status status = qdot_mixture_new(session, run, e, &mixture);

    if (status == QDOT_OK)
        status = qdot_mixture_range(mixture, kind, range, &x, &error);
    qdot_mixture_free(mixture);
    QDOT_TRY(status);
    *value = qdot_measured_new(session, x, error);
    return qdot_pool_check(session->pool);
}

/* The value of one expression over a range, which was said so, a new symbol; plain: it holds no other numbers of
 * runs. */
static qdot_status
evaluate_over_one_run(qdot_session *session, const char *run, qdot_range_kind kind, qdot_expr e,
                      const double *range, const qdot_expr *said, bool plain, qdot_expr *value)
{
    const qdot_run_report *report;
    qdot_named_run *named;
    double x, error;
    bool mixed;

    QDOT_TRY(qdot_member_resolve(session, &run, &e, &mixed));
    if (mixed)
        return evaluate_over_several_runs(session, run, kind, e, range, value);
    QDOT_TRY(qdot_runs_read(session, run, &named));
    report = qdot_run_get_report(named->run);
    QDOT_TRY(qdot_run_range(named->run, kind, e, range != NULL ? range[0] : report->t0,
                            range != NULL ? range[1] : report->t1, &x, &error));
    *value = qdot_measured_add(
        session,
        (qdot_measured){.value = x,
                        .error = error,
                        .origin = {.kind = plain ? QDOT_ORIGIN_RANGE : QDOT_ORIGIN_OTHER,
                                   .range = kind,
                                   .e = e,
                                   .ends = {range != NULL ? range[0] : report->t0,
                                            range != NULL ? range[1] : report->t1},
                                   .said = {range != NULL ? said[0] : QDOT_NIL,
                                            range != NULL ? said[1] : QDOT_NIL},
                                   .run = run}});
    return qdot_pool_check(session->pool);
}

/* Refuse range ends given as separate arguments: mean(E, 2, 11) means mean(E, 2..11), not three expressions. */
static qdot_status
refuse_ends_apart(qdot_session *session, const char *word, uint32_t n, const qdot_expr *args)
{
    const qdot_pool *pool = session->pool;
    qdot_text line = {0};
    const uint32_t both = n > 2 && qdot_expr_is_constant(pool, args[n - 2]) ? 2 : 1;
    qdot_status status = QDOT_OK;

    if (n < 2 || qdot_expr_is_constant(pool, args[0]) || !qdot_expr_is_constant(pool, args[n - 1]))
        return QDOT_OK;
    for (uint32_t i = 0; i < n && status == QDOT_OK; i++) {
        qdot_text_add(&line, i == 0 ? "" : i + both > n ? ".." : i == n - 1 ? ", 0.." : ", ");
        status = qdot_print(session->pool, args[i], QDOT_PLAIN, &line);
    }
    if (status == QDOT_OK) {
        (void)qdot_fail(QDOT_ETYPE, "`%s` of a number, which does not change along a run", word);
        status = qdot_hint("a range is written A..B: %s(%.200s)", word, qdot_text_str(&line));
    }
    qdot_text_clear(&line);
    return status;
}

qdot_status
qdot_range_value(qdot_session *session, const char *run, const char *word, uint32_t n,
                 const qdot_expr *args, const qdot_expr *range, qdot_expr *value)
{
    qdot_runs_columns columns = {0};
    qdot_vec(qdot_expr) results = {0};
    qdot_range_kind kind = QDOT_RANGE_MAX;
    double ends[2];
    bool plain = true;
    qdot_status status = QDOT_OK;

    for (uint32_t i = 0; i < n; i++)
        plain = plain && !qdot_measured_occurs(session, args[i]);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(words[i].word, word) == 0)
            kind = words[i].kind;
    if (n == 0)
        return qdot_fail(QDOT_ETYPE, "`%s` needs an expression", word);
    if (range == NULL)
        QDOT_TRY(refuse_ends_apart(session, word, n, args));
    for (int k = 0; k < 2 && range != NULL; k++)
        QDOT_TRY(qdot_session_number(session, range[k], &ends[k], NULL));
    for (uint32_t i = 0; i < n && status == QDOT_OK; i++)
        status = qdot_runs_flatten(session, args[i], &columns);
    for (size_t i = 0; i < columns.n && status == QDOT_OK; i++) {
        qdot_expr one = QDOT_NIL;

        status = evaluate_over_one_run(session, run, kind, columns.at[i], range != NULL ? ends : NULL,
                                       range, plain, &one);
        if (status == QDOT_OK)
            status = qdot_vec_push(&results, one);
    }
    if (status == QDOT_OK) {
        *value = results.n == 1
                     ? results.at[0]
                     : qdot_list(session->pool, (uint32_t)results.n, results.at);
        status = qdot_pool_check(session->pool);
    }
    qdot_free(columns.at);
    qdot_free(results.at);
    return status;
}
