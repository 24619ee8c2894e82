/* run-time.c -- converts times counted from the run's origin to t and back: in numbers, expressions, texts. */
#include "sim/course/run-time.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "num/two.h"
#include "sim/model/delay.h"

double
qdot_run_time_told(const qdot_run *run, double s)
{
    return run->origin + s;
}

static qdot_status
convert_times_in_text(double origin, char **text)
{
    qdot_text told = {0};
    char *copy = NULL;
    qdot_status status;

    if (*text == NULL)
        return QDOT_OK;
    qdot_run_time_tell(origin, *text, &told);
    status = qdot_text_status(&told);
    if (status == QDOT_OK && !(copy = qdot_strdup(qdot_text_str(&told))))
        status = QDOT_ENOMEM;
    qdot_text_clear(&told);
    if (status != QDOT_OK)
        return status;
    qdot_free(*text);
    *text = copy;
    return QDOT_OK;
}

qdot_status
qdot_run_time_begin(qdot_run *run, double origin)
{
    qdot_text notice = {0};
    size_t n;

    if (origin == 0)
        return QDOT_OK;
    run->origin = origin;
    run->told = qdot_calloc(1, sizeof *run->told);
    run->times = qdot_calloc(run->course.tr.count + 1, sizeof *run->times);
    if (!run->told || !run->times)
        return QDOT_ENOMEM;
    for (n = 0; n < run->course.tr.count; n++)
        run->times[n] = qdot_run_time_told(run, run->course.tr.t[n]);
    QDOT_TRY(convert_times_in_text(origin, &run->reason));
    QDOT_TRY(convert_times_in_text(origin, &run->doubt));
    run->report.reason = run->reason;
    run->report.doubt = run->doubt;
    qdot_run_time_tell(origin, qdot_text_str(&run->notice), &notice);
    qdot_text_clear(&run->notice);
    run->notice = notice;
    return qdot_text_status(&run->notice);
}

const qdot_run_report *
qdot_run_time_report(const qdot_run *run)
{
    if (!run->told)
        return &run->report;
    *run->told = run->report;
    run->told->t0 = qdot_run_time_told(run, run->report.t0);
    run->told->t1 = qdot_run_time_told(run, run->report.t1);
    run->told->horizon = qdot_run_time_told(run, run->report.horizon);
    run->told->standstill = qdot_run_time_told(run, run->report.standstill);
    return run->told;
}

const double *
qdot_run_time_points(const qdot_run *run, size_t *n)
{
    *n = run->course.tr.count;
    return run->times ? run->times : run->course.tr.t;
}

/* The point of the run just after a jump of the state at s, whose time t rounds to `t`; SIZE_MAX: none. */
static size_t
point_after_jump(const qdot_run *run, double t, double s)
{
    const qdot_trajectory *tr = &run->course.tr;
    const size_t at = qdot_trajectory_locate(tr, s, 0), last = tr->pieces.n > 0 ? tr->pieces.n - 1 : 0;
    const size_t piece = qdot_trajectory_piece_of(tr, at);

    for (size_t k = piece < last ? piece + 1 : last; k + 1 > piece && k > 0; k--)
        if (tr->pieces.at[k].jumped && qdot_run_time_told(run, tr->t[tr->pieces.at[k].first]) == t)
            return tr->pieces.at[k].first;
    return SIZE_MAX;
}

void
qdot_run_time_own(const qdot_run *run, double t, double low, double *s, double *rest)
{
    const qdot_trajectory *tr = &run->course.tr;
    double least, most, slack;
    qdot_two sum;
    size_t k;

    *s = t;
    *rest = low;
    if (run->origin == 0 || tr->count == 0)
        return;
    sum = qdot_two_add_double(qdot_two_add_double((qdot_two){t, 0}, -run->origin), low);
    *s = sum.hi;
    *rest = sum.lo;
    least = fmin(tr->t[0], tr->t[tr->count - 1]);
    most = fmax(tr->t[0], tr->t[tr->count - 1]);
    slack = DBL_EPSILON * fabs(t);
    if ((*s < least && *s >= least - slack) || (*s > most && *s <= most + slack)) {
        *s = *s < least ? least : most;
        *rest = 0;
    }
    if (low != 0 || *s < least || *s > most || tr->n_tracks > 0)
        return;
    k = point_after_jump(run, t, *s);
    if (k != SIZE_MAX) {
        *s = tr->t[k];
        *rest = 0;
    }
}

qdot_status
qdot_run_time_express(const qdot_run *run, size_t m, const qdot_expr *given, const qdot_expr **own,
                      qdot_expr **made)
{
    qdot_pool *pool = run->plan->pool;
    qdot_expr from_origin;

    *own = given;
    *made = NULL;
    if (run->origin == 0)
        return QDOT_OK;
    *made = qdot_malloc((m + 1) * sizeof **made);
    if (!*made)
        return QDOT_ENOMEM;
    from_origin = qdot_add(pool, QDOT_T, qdot_expr_of_double(pool, run->origin));
    for (size_t i = 0; i < m; i++)
        (*made)[i] = qdot_delay_replace_time(pool, given[i], from_origin);
    *own = *made;
    return qdot_pool_check(pool);
}

/* Copy a number in a text at `at`, converted to t, to out; returns the text after it, or `at` if
 * there is no number. */
static const char *
convert_number(double origin, const char *at, qdot_text *out)
{
    char *end;
    const double s = strtod(at, &end);

    if (end == at || !isfinite(s))
        return at;
    qdot_text_format(out, "%.15g", origin + s);
    return end;
}

void
qdot_run_time_tell(double origin, const char *text, qdot_text *out)
{
    static const char *const before[] = {"t = ", "which covers ", "which all cover ", "the range "},
                             *const between[] = {" to ", ".."};

    while (*text != '\0' && origin != 0) {
        bool range = false;

        for (size_t i = 0; i < sizeof before / sizeof *before && !range; i++) {
            const size_t n = strlen(before[i]);

            range = strncmp(text, before[i], n) == 0;
            if (range) {
                qdot_text_add_n(out, text, n);
                text = convert_number(origin, text + n, out);
            }
        }
        for (size_t i = 0; i < sizeof between / sizeof *between && range; i++) {
            const size_t n = strlen(between[i]);

            if (strncmp(text, between[i], n) != 0)
                continue;
            qdot_text_add_n(out, text, n);
            text = convert_number(origin, text + n, out);
            break;
        }
        if (!range)
            qdot_text_char(out, *text++);
    }
    qdot_text_add(out, text);
}

qdot_status
qdot_run_time_fail(double origin, qdot_status status)
{
    qdot_error before;
    qdot_text text = {0};

    if (status == QDOT_OK || origin == 0)
        return status;
    before = *qdot_last_error();
    qdot_run_time_tell(origin, before.message, &text);
    if (qdot_text_status(&text) == QDOT_OK)
        snprintf(before.message, sizeof before.message, "%s", qdot_text_str(&text));
    qdot_text_clear(&text);
    qdot_fail_again(&before);
    return status;
}
