/* number.c -- run, plan, value: where floating point begins. */
#include "lang/number.h"

#include <limits.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "expr/calculus.h"
#include "expr/walk.h"
#include "lang/answer.h"
#include "lang/declare.h"
#include "lang/meant.h"
#include "lang/statement.h"
#include "lang/values.h"
#include "tape/constant.h"
#include "tape/tape.h"

/* --- run ---------------------------------------------------------------------------- */

typedef struct {
    qdot_expr from, to;
    double tol;
    long digits; /* 0: doubles */
    const char *method, *name;
    bool tol_given, treatment_given;
    qdot_run_treatment treatment;
    qdot_number_pairs with;
    qdot_text text; /* of the statement, without its name */
} options;

/* NAME = VALUE of a parameter or of a coordinate or velocity. */
static qdot_status
read_with(qdot_cursor *c, qdot_number_pairs *with)
{
    do {
        const qdot_token *start = c->at;
        qdot_cursor look = *c;
        qdot_expr symbol, value;
        const char *name;
        const qdot_name *known = NULL;

        if (c->at->kind == QDOT_TOKEN_NAME && qdot_read_name(&look, &name) == QDOT_OK)
            known = qdot_names_find(c->session->names, name);
        if (known != NULL && known->kind == QDOT_NAME_COORD)
            QDOT_TRY(qdot_number_read_jet(c, &symbol));
        else
            QDOT_TRY(qdot_number_read_parameter(c, &symbol));
        QDOT_TRY(qdot_number_read_constant(c, &value));
        c->error_at = start->start;
        QDOT_TRY(qdot_declare_in_domain(c->session, symbol, value));
        QDOT_TRY(qdot_number_push_pair(with, start, symbol, value));
    } while (qdot_cursor_accept_op(c, ","));
    return qdot_values_check(c, with);
}

static qdot_status
read_tolerance(qdot_cursor *c, options *o)
{
    const qdot_token *start = c->at;

    QDOT_TRY(qdot_statement_once(c, "tol", o->tol_given));
    o->tol_given = true;
    QDOT_TRY(qdot_read_number(c, &o->tol));
    if (o->tol > 0 && o->tol < 1)
        return QDOT_OK;
    c->error_at = start->start;
    return qdot_fail(QDOT_EINVAL, "a tolerance lies between 0 and 1");
}

/* project, baumgarte or none: how drift off the constraints is treated. */
static qdot_status
read_treatment(qdot_cursor *c, options *o)
{
    static const struct {
        const char *word;
        qdot_run_treatment treatment;
    } words[] = {{"project", QDOT_RUN_PROJECT},
                 {"baumgarte", QDOT_RUN_BAUMGARTE},
                 {"none", QDOT_RUN_NONE}};

    if (c->session->scene->constraints.n == 0) {
        c->error_at = c->at[-1].start;
        (void)qdot_fail(QDOT_EINVAL, "the scene has no constraints");
        return qdot_hint("constraint NAME: A = B");
    }
    QDOT_TRY(qdot_statement_once(c, "constraints", o->treatment_given));
    o->treatment_given = true;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (qdot_cursor_accept_word(c, words[i].word)) {
            o->treatment = words[i].treatment;
            return QDOT_OK;
        }
    return qdot_cursor_expected(c, "`project`, `baumgarte` or `none`");
}

static qdot_status
read_digits(qdot_cursor *c, options *o)
{
    const qdot_token *start = c->at++;

    QDOT_TRY(qdot_statement_once(c, "digits", o->digits != 0));
    QDOT_TRY(qdot_read_integer(c, &o->digits));
    c->error_at = start->start;
    if (o->digits >= 1 && o->digits <= INT_MAX)
        return QDOT_OK;
    qdot_fail(QDOT_EINVAL, "%ld digits cannot be asked for", o->digits);
    return qdot_hint("digits 30");
}

/* What the tokens [from, to) say, behind what was said before. */
static void
add_text(const qdot_cursor *c, const qdot_token *from, const qdot_token *to, options *o)
{
    if (from == to)
        return;
    if (o->text.n > 0)
        qdot_text_char(&o->text, ' ');
    qdot_statement_text(c->session, from, to, &o->text);
}

/* start: the first token of the statement's operands. */
static qdot_status
read_options(qdot_cursor *c, const qdot_token *start, options *o)
{
    while (!qdot_cursor_is_end(c)) {
        if (qdot_cursor_accept_word(c, "tol")) {
            QDOT_TRY(read_tolerance(c, o));
        } else if (qdot_cursor_is_word(c, "digits")) {
            QDOT_TRY(read_digits(c, o));
        } else if (qdot_cursor_accept_word(c, "method")) {
            QDOT_TRY(qdot_statement_once(c, "method", o->method != NULL));
            if (c->at->kind != QDOT_TOKEN_NAME)
                return qdot_cursor_expected(c, "the name of a method");
            o->method = c->at++->text;
        } else if (qdot_cursor_accept_word(c, "constraints")) {
            QDOT_TRY(read_treatment(c, o));
        } else if (qdot_cursor_accept_word(c, "as")) {
            add_text(c, start, c->at - 1, o);
            QDOT_TRY(qdot_statement_once(c, "as", o->name != NULL));
            QDOT_TRY(qdot_read_name(c, &o->name));
            start = c->at;
        } else if (qdot_cursor_accept_word(c, "with")) {
            QDOT_TRY(read_with(c, &o->with));
        } else {
            return qdot_cursor_expected(
                c, "`tol`, `digits`, `method`, `with`, `constraints` or `as`");
        }
    }
    add_text(c, start, c->at, o);
    if (o->tol_given && o->digits > 0) {
        c->error_at = c->at->start;
        qdot_fail(QDOT_EINVAL, "`digits` sets the tolerance itself: no `tol` beside it");
        return qdot_hint("digits %ld", o->digits);
    }
    return QDOT_OK;
}

/* Keep the run under its name; an older one of that name goes. Takes ownership in any
 * case. */
static qdot_status
keep_run(qdot_session *session, const char *name, const char *text, qdot_run *run)
{
    qdot_named_run named = {.name = qdot_strdup(name),
                            .text = qdot_strdup(text),
                            .run = run,
                            .uses = qdot_malloc(sizeof *named.uses)};
    qdot_status status = QDOT_OK;

    if (named.name == NULL || named.text == NULL || named.uses == NULL) {
        qdot_free(named.name);
        qdot_free(named.text);
        qdot_free(named.uses);
        qdot_run_free(run);
        return QDOT_ENOMEM;
    }
    *named.uses = 1;

    for (size_t i = 0; i < session->runs.n; i++) {
        if (strcmp(session->runs.at[i].name, name) != 0)
            continue;
        qdot_named_run_release(&session->runs.at[i]);
        memmove(&session->runs.at[i], &session->runs.at[i + 1],
                (session->runs.n - i - 1) * sizeof named);
        session->runs.n--;
        break;
    }
    status = qdot_vec_push(&session->runs, named);
    if (status != QDOT_OK)
        qdot_named_run_release(&named);
    return status;
}

/* run1, run2, ...: the first that is free, from the number of runs on. */
static void
next_name(const qdot_session *session, char *name, size_t size)
{
    for (size_t k = session->runs.n + 1;; k++) {
        bool taken = false;

        snprintf(name, size, "run%zu", k);
        for (size_t i = 0; i < session->runs.n; i++)
            taken = taken || strcmp(session->runs.at[i].name, name) == 0;
        if (!taken)
            return;
    }
}

/* The request is filled with the values of `with` in force, which then go again. */
static qdot_status
fill_with(qdot_session *session, const qdot_number_pairs *with, qdot_number_order *o)
{
    qdot_vec(qdot_expr) set_symbols = {0}, set_values = {0}, start_symbols = {0},
                        start_values = {0};
    qdot_status status = QDOT_OK;

#define SAVE(v)                                                                          \
    for (size_t i = 0; i < session->v.n && status == QDOT_OK; i++)                       \
        status = qdot_vec_push(&v, session->v.at[i]);
#define RESTORE(v)                                                                       \
    qdot_free(session->v.at);                                                            \
    memcpy(&session->v, &v, sizeof v);
    SAVE(set_symbols)
    SAVE(set_values)
    SAVE(start_symbols)
    SAVE(start_values)
    for (size_t i = 0; i < with->symbols.n && status == QDOT_OK; i++) {
        if (qdot_expr_is_class(session->pool, with->symbols.at[i], QDOT_COORD))
            status =
                qdot_number_set_start(session, with->symbols.at[i], with->values.at[i]);
        else
            qdot_declare_value(session, with->symbols.at[i], with->values.at[i], &status);
    }
    if (status == QDOT_OK)
        status = qdot_number_fill_order(session, o);
    RESTORE(set_symbols)
    RESTORE(set_values)
    RESTORE(start_symbols)
    RESTORE(start_values)
#undef SAVE
#undef RESTORE
    return status;
}

/* Whether an initial value is among those of `with`. */
static bool
names_start(const qdot_session *session, const qdot_number_pairs *with)
{
    for (size_t i = 0; i < with->symbols.n; i++)
        if (qdot_expr_is_class(session->pool, with->symbols.at[i], QDOT_COORD))
            return true;
    return false;
}

/* Integrate, keep the run, tell how it went. */
static qdot_status
carry_out(qdot_cursor *c, const options *o, qdot_number_order *request)
{
    qdot_session *session = c->session;
    const qdot_run_report *report;
    qdot_run *run = NULL;
    qdot_status status;
    qdot_error error;
    char name[32];

    status = qdot_run_new(session->scene, &request->request, &run);
    error = *qdot_last_error();
    if (status == QDOT_OK)
        QDOT_TRY(qdot_pool_check(session->pool));
    if (run == NULL)
        return status;
    if (status == QDOT_EINTR)
        qdot_interrupt_clear(); /* heard: the run so far is kept and told */
    if (o->name == NULL)
        next_name(session, name, sizeof name);
    QDOT_TRY(keep_run(session, o->name != NULL ? o->name : name, qdot_text_str(&o->text), run));
    report = qdot_run_get_report(run);
    if (!names_start(session, &o->with))
        QDOT_TRY(qdot_meant_tell_start(session));
    for (const char *line = report->notice; line != NULL && *line != '\0';) {
        const char *behind = strchrnul(line, '\n');

        QDOT_TRY(qdot_answer_notice(session, "%.*s", (int)(behind - line), line));
        line = *behind == '\0' ? behind : behind + 1;
    }
    QDOT_TRY(qdot_answer_run(session, o->name != NULL ? o->name : name, report));
    if (report->doubt != NULL && report->status != QDOT_RUN_FAILED)
        QDOT_TRY(qdot_answer_notice(session, "the error is unknown: %s", report->doubt));
    if (status != QDOT_OK)
        return qdot_fail_again(&error);
    if (report->status == QDOT_RUN_FAILED)
        return qdot_fail(QDOT_EFAILED, "the run failed: %s",
                         report->reason != NULL ? report->reason : "no reason is known");
    return QDOT_OK;
}

qdot_status
qdot_number_run(qdot_cursor *c)
{
    const qdot_token *start = c->at;
    options o = {.tol = 1e-12};
    qdot_number_order request = {0};
    qdot_status status;

    status = qdot_read_range(c, &o.from, &o.to);
    if (status == QDOT_OK)
        status = read_options(c, start, &o);
    if (status == QDOT_OK)
        status = qdot_text_status(&o.text);
    if (status == QDOT_OK)
        c->error_at = start->start;
    if (status == QDOT_OK)
        status = fill_with(c->session, &o.with, &request);
    if (status == QDOT_OK) {
        request.request.t0 = qdot_session_bind(
            c->session, qdot_number_without_measured(c->session, o.from));
        request.request.t1 =
            qdot_session_bind(c->session, qdot_number_without_measured(c->session, o.to));
        request.request.tol = o.tol;
        request.request.digits = (int)o.digits;
        request.request.method = o.method != NULL ? o.method : "auto";
        request.request.treatment = o.treatment;
        status = qdot_pool_check(c->session->pool);
    }
    if (status == QDOT_OK)
        status = carry_out(c, &o, &request);
    qdot_text_clear(&o.text);
    qdot_number_free_order(&request);
    qdot_number_free_pairs(&o.with);
    return status;
}

/* As options of a run that would be taken; those that no plan depends on are refused. */
static qdot_status
read_plan_options(qdot_cursor *c, options *o)
{
    const qdot_token *start = c->at;

    QDOT_TRY(read_options(c, start, o));
    if (o->digits == 0 && o->name == NULL)
        return QDOT_OK;
    c->error_at = start->start;
    (void)qdot_fail(QDOT_EINVAL, o->name ? "a plan has no name" : "`digits` has no plan");
    return qdot_hint("plan tol 1e-9 method taylor");
}

qdot_status
qdot_number_plan(qdot_cursor *c)
{
    options o = {.tol = 1e-12};
    const qdot_token *start = c->at - 1;
    qdot_number_order request = {0};
    qdot_text text = {0};
    qdot_status status = read_plan_options(c, &o);

    if (status == QDOT_OK) {
        c->error_at = start->start;
        status = fill_with(c->session, &o.with, &request);
    }
    request.request.t0 = QDOT_ZERO;
    request.request.t1 = QDOT_ONE;
    request.request.tol = o.tol;
    request.request.method = o.method != NULL ? o.method : "auto";
    request.request.treatment = o.treatment;
    if (status == QDOT_OK)
        status = qdot_run_plan(c->session->scene, &request.request, &text);
    if (status == QDOT_OK)
        status = qdot_text_status(&text);
    if (status == QDOT_OK)
        status = qdot_answer_text(c->session, "plan", qdot_text_str(&text));
    qdot_text_clear(&text);
    qdot_number_free_order(&request);
    qdot_text_clear(&o.text);
    qdot_number_free_pairs(&o.with);
    return status;
}

/* --- value -------------------------------------------------------------------------- */

qdot_status
qdot_number_find_run(qdot_session *session, const char *name, qdot_named_run **run)
{
    if (session->runs.n == 0) {
        (void)qdot_fail(QDOT_EINVAL, "there is no run yet");
        return qdot_hint("run 0..20");
    }
    *run = &session->runs.at[session->runs.n - 1];
    if (name == NULL)
        return QDOT_OK;
    for (size_t i = 0; i < session->runs.n; i++)
        if (strcmp(session->runs.at[i].name, name) == 0) {
            *run = &session->runs.at[i];
            return QDOT_OK;
        }
    return qdot_fail(QDOT_ENAME, "there is no run `%s`", name);
}

qdot_expr
qdot_number_exact(qdot_pool *pool, double x)
{
    int exponent;
    long mantissa;

    if (!isfinite(x)) {
        (void)qdot_fail(QDOT_EDOMAIN, "a number of the run is not finite");
        return qdot_pool_fail(pool);
    }
    mantissa = (long)ldexp(frexp(x, &exponent), 53);
    if (mantissa == 0)
        return QDOT_ZERO;
    return qdot_mul(pool, qdot_expr_int(pool, mantissa),
                    qdot_pow_int(pool, qdot_expr_int(pool, 2), exponent - 53));
}

qdot_status
qdot_number_flatten(qdot_session *session, qdot_expr e, qdot_number_columns *columns)
{
    qdot_pool *pool = session->pool;
    qdot_kind kind = qdot_expr_kind(pool, e);

    e = qdot_number_without_measured(session, e);
    QDOT_TRY(qdot_pool_check(pool));
    if (qdot_expr_is_scalar(pool, e))
        return qdot_vec_push(columns, e);
    if (kind != QDOT_VEC && kind != QDOT_LIST)
        return qdot_fail(QDOT_ETYPE, "only numbers and vectors have values along a run");
    for (uint32_t i = 0; i < qdot_expr_count(pool, e); i++) {
        qdot_expr part = qdot_expr_arg(pool, e, i);

        if (!qdot_expr_is_scalar(pool, part))
            return qdot_fail(QDOT_ETYPE,
                             "only numbers and vectors have values along a run");
        QDOT_TRY(qdot_vec_push(columns, part));
    }
    return QDOT_OK;
}

static qdot_expr
measured_symbol(qdot_session *session, qdot_measured m)
{
    char name[40];

    snprintf(name, sizeof name, "value#%zu", session->measured.n + 1);
    m.symbol = qdot_symbol_get(session->pool, QDOT_FORMAL, name);
    if (m.symbol == QDOT_NIL)
        return QDOT_NIL;
    return qdot_vec_push(&session->measured, m) == QDOT_OK
               ? m.symbol
               : qdot_pool_fail(session->pool);
}

qdot_expr
qdot_number_measured_as(qdot_session *session, qdot_measured m)
{
    return measured_symbol(session, m);
}

qdot_expr
qdot_number_measured(qdot_session *session, double value, double error)
{
    return measured_symbol(session, (qdot_measured){.value = value, .error = error});
}

/* The columns at a time as numbers m [columns]. */
static qdot_status
measure(qdot_session *session, qdot_run *run, const qdot_number_columns *columns,
        qdot_expr time, qdot_measured *m)
{
    const size_t n = columns->n;
    double t, low, *values = qdot_calloc(2 * n, sizeof *values);
    qdot_status status = values == NULL ? QDOT_ENOMEM : QDOT_OK;

    if (status == QDOT_OK)
        status = qdot_session_split(session, time, &t, &low);
    if (status == QDOT_OK)
        status = qdot_run_values_beyond(run, n, columns->at, 1, &t, &low, values, values + n);
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        m[i] = (qdot_measured){.value = values[i], .error = values[n + i]};
    qdot_free(values);
    return status;
}

/* The same of a run with `digits`, whose time is exact too. */
static qdot_status
measure_exactly(qdot_session *session, qdot_run *run, const qdot_number_columns *columns,
                qdot_expr time, qdot_measured *m)
{
    const size_t n = columns->n;
    const int digits = qdot_run_get_report(run)->digits;
    double *errors = qdot_calloc(n, sizeof *errors);
    qdot_expr *exact = qdot_calloc(n, sizeof *exact);
    qdot_status status = errors == NULL || exact == NULL ? QDOT_ENOMEM : QDOT_OK;

    time = qdot_number_without_measured(session, qdot_session_bind(session, time));
    if (status == QDOT_OK)
        status = qdot_pool_check(session->pool);
    if (status == QDOT_OK)
        status = qdot_run_exact_values(run, n, columns->at, time, exact, errors);
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        m[i] = (qdot_measured){.error = errors[i], .digits = digits, .exact = exact[i]};
        status = qdot_tape_constant(session->pool, exact[i], &m[i].value);
    }
    qdot_free(errors);
    qdot_free(exact);
    return status;
}

/* Columns that name no run inside, along a run, in doubles or with the digits of the run. */
static qdot_status
measure_along(qdot_session *session, const char *run, const qdot_number_columns *columns,
              qdot_expr time, qdot_measured *m)
{
    qdot_named_run *named = NULL;

    QDOT_TRY(qdot_number_find_run(session, run, &named));
    return qdot_run_get_report(named->run)->digits > 0
               ? measure_exactly(session, named->run, columns, time, m)
               : measure(session, named->run, columns, time, m);
}

qdot_status
qdot_number_measure(qdot_session *session, const char *run, qdot_expr e, qdot_expr time,
                    qdot_measured *m)
{
    return measure_along(session, run, &(qdot_number_columns){.at = &e, .n = 1}, time, m);
}

/* A column that names runs inside. Along one run it is measured as any other; along several that
 * all have digits it becomes *value, of numbers that each have theirs; else it is measured in
 * doubles. */
static qdot_status
measure_members(qdot_session *session, const char *run, qdot_expr e, qdot_expr time,
                qdot_measured *m, qdot_expr *value)
{
    double t, low;
    bool mixed;

    QDOT_TRY(qdot_member_resolve(session, &run, &e, &mixed));
    if (!mixed)
        return qdot_number_measure(session, run, e, time, m);
    QDOT_TRY(qdot_member_exactly(session, run, e, time, value));
    if (*value != QDOT_NIL)
        return QDOT_OK;
    QDOT_TRY(qdot_session_split(session, time, &t, &low));
    return qdot_member_values(session, run, e, 1, &t, &low, &m->value, &m->error);
}

static bool
any_member(const qdot_session *session, const qdot_number_columns *columns)
{
    for (size_t i = 0; i < columns->n; i++)
        if (qdot_member_any(session, columns->at[i]))
            return true;
    return false;
}

/* The columns at a time: numbers m [columns], or values [columns] of such numbers, not nil. */
static qdot_status
measure_columns(qdot_session *session, const char *run, const qdot_number_columns *columns,
                qdot_expr time, qdot_measured *m, qdot_expr *values)
{
    if (!any_member(session, columns))
        return measure_along(session, run, columns, time, m);
    for (size_t i = 0; i < columns->n; i++)
        QDOT_TRY(measure_members(session, run, columns->at[i], time, m + i, values + i));
    return QDOT_OK;
}

qdot_status
qdot_number_along(qdot_session *session, const char *run, qdot_expr e, size_t k,
                  const double *times, const double *lows, double *values,
                  double *errors)
{
    qdot_named_run *named = NULL;
    bool mixed;

    QDOT_TRY(qdot_member_resolve(session, &run, &e, &mixed));
    if (mixed)
        return qdot_member_values(session, run, e, k, times, lows, values, errors);
    QDOT_TRY(qdot_number_find_run(session, run, &named));
    return qdot_run_values_beyond(named->run, 1, &e, k, times, lows, values, errors);
}

/* What the numbers of runs that stand in e are off by, as it makes e at t: sum |de/dm| error
 * of m, added to *error. */
static qdot_status
add_error_within(qdot_session *session, const char *run, qdot_expr e, double t, double *error)
{
    const size_t n = session->measured.n;

    for (size_t i = 0; i < n; i++) {
        const qdot_measured m = session->measured.at[i];
        double slope = 0, off, low = 0;
        qdot_expr d;

        if (!qdot_expr_contains(session->pool, e, m.symbol))
            continue;
        d = qdot_number_without_measured(session,
                                         qdot_diff(session->pool, e, m.symbol));
        QDOT_TRY(qdot_pool_check(session->pool));
        QDOT_TRY(qdot_number_along(session, run, d, 1, &t, &low, &slope, &off));
        *error += slope == 0 ? 0 : fabs(slope) * m.error;
    }
    return QDOT_OK;
}

/* The same of all components of args [n], whose numbers are m. */
static qdot_status
add_errors_within(qdot_session *session, const char *run, uint32_t n, const qdot_expr *args,
                  qdot_expr time, qdot_measured *m)
{
    double t;

    QDOT_TRY(qdot_session_number(session, time, &t, NULL));
    for (uint32_t i = 0; i < n; i++) {
        const bool scalar = qdot_expr_is_scalar(session->pool, args[i]);
        const uint32_t parts = scalar ? 1 : qdot_expr_count(session->pool, args[i]);

        for (uint32_t k = 0; k < parts; k++, m++)
            QDOT_TRY(add_error_within(session, run,
                                      scalar ? args[i] : qdot_expr_arg(session->pool, args[i], k),
                                      t, &m->error));
    }
    return QDOT_OK;
}

qdot_status
qdot_number_value(qdot_session *session, const char *run, uint32_t n,
                  const qdot_expr *args, qdot_expr *value)
{
    qdot_number_columns columns = {0};
    qdot_vec(qdot_expr) symbols = {0};
    qdot_measured *measured = NULL;
    qdot_expr *values = NULL;
    qdot_named_run *named = NULL;
    qdot_status status;

    if (n < 2) {
        (void)qdot_fail(QDOT_ETYPE, "`value` needs an expression and a time");
        return qdot_hint("value(theta, 20)");
    }
    QDOT_TRY(qdot_number_find_run(session, run, &named));
    status = QDOT_OK;
    for (uint32_t i = 0; i + 1 < n && status == QDOT_OK; i++)
        status = qdot_number_flatten(session, args[i], &columns);
    if (status == QDOT_OK) {
        measured = qdot_calloc(columns.n, sizeof *measured);
        values = qdot_calloc(columns.n, sizeof *values);
        status = measured == NULL || values == NULL ? QDOT_ENOMEM : QDOT_OK;
    }
    if (status == QDOT_OK)
        status = measure_columns(session, run, &columns, args[n - 1], measured, values);
    if (status == QDOT_OK)
        status = add_errors_within(session, run, n - 1, args, args[n - 1], measured);
    for (size_t i = 0; i < columns.n && status == QDOT_OK; i++)
        status = qdot_vec_push(&symbols, values[i] != QDOT_NIL
                                             ? values[i]
                                             : measured_symbol(session, measured[i]));
    if (status == QDOT_OK) {
        *value = columns.n == 1
                     ? symbols.at[0]
                     : qdot_list(session->pool, (uint32_t)symbols.n, symbols.at);
        status = qdot_pool_check(session->pool);
    }
    qdot_free(measured);
    qdot_free(values);
    qdot_free(columns.at);
    qdot_free(symbols.at);
    return status;
}
