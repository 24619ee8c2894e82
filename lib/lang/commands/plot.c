/* plot.c -- curves: along runs against t, against each other, paths; an expression
 * over a variable. */
#include <math.h>
#include <string.h>

#include "expr/calculus.h"
#include "lang/commands/figure-file.h"
#include "lang/commands/loop.h"
#include "lang/commands/operands.h"
#include "lang/commands/statement.h"
#include "lang/language/read.h"
#include "lang/language/token-text.h"
#include "lang/session/bind.h"
#include "lang/session/member.h"
#include "show/show.h"
#include "tape/tape.h"

enum { POINTS = 1001, MOST_POINTS = 20001 };

typedef struct {
    char *label;
    double *x, *y;
    size_t rows;
} curve;

typedef struct {
    qdot_vec(curve) curves;
    char *x_label;
    const char *path; /* NULL: a window, or a file by default */
    bool equal_axes;
} figure;

static void
free_figure(figure *f)
{
    for (size_t i = 0; i < f->curves.n; i++) {
        qdot_free(f->curves.at[i].label);
        qdot_free(f->curves.at[i].x);
        qdot_free(f->curves.at[i].y);
    }
    qdot_free(f->curves.at);
    qdot_free(f->x_label);
}

/* A curve without numbers yet. */
static qdot_status
add_curve(figure *f, const char *label, size_t rows, curve **added)
{
    curve one = {.rows = rows};

    one.label = qdot_strdup(label);
    one.x = qdot_calloc(rows, sizeof *one.x);
    one.y = qdot_calloc(rows, sizeof *one.y);
    if (one.label == NULL || one.x == NULL || one.y == NULL ||
        qdot_vec_push(&f->curves, one) != QDOT_OK) {
        qdot_free(one.label);
        qdot_free(one.x);
        qdot_free(one.y);
        return QDOT_ENOMEM;
    }
    *added = &f->curves.at[f->curves.n - 1];
    return QDOT_OK;
}

/* --- where it goes ------------------------------------------------------------------ */

static qdot_status
finish(qdot_session *session, figure *f)
{
    size_t n = f->curves.n;
    qdot_column *columns = qdot_calloc(2 * n, sizeof *columns);
    size_t *rows = qdot_calloc(n, sizeof *rows);
    qdot_figure out = {.x_label = f->x_label,
                       .curves = n,
                       .x = columns,
                       .y = columns + n,
                       .rows = rows,
                       .equal_axes = f->equal_axes};
    qdot_status status = columns == NULL || rows == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        columns[i] = (qdot_column){f->x_label, f->curves.at[i].x};
        columns[n + i] = (qdot_column){f->curves.at[i].label, f->curves.at[i].y};
        rows[i] = f->curves.at[i].rows;
    }
    if (f->equal_axes) /* a path: x and y of space, its name above */
        out.y_label = "y";
    if (status == QDOT_OK && n == 1 && f->equal_axes)
        out.title = f->curves.at[0].label;
    else if (status == QDOT_OK && n == 1)
        out.y_label = f->curves.at[0].label;
    if (status == QDOT_OK)
        status = qdot_figure_file_show(session, &out, f->path);
    qdot_free(columns);
    qdot_free(rows);
    return status;
}

/* --- along runs --------------------------------------------------------------------- */

/* Evenly spaced times, more of them where the run took many steps. */
static qdot_status
sample(const qdot_operand *o, double **times, size_t *n)
{
    const qdot_run_report *report = qdot_run_get_report(o->run);
    size_t steps = 4 * report->steps + 1;
    bool back = report->t1 < report->t0;
    double low = fmin(report->t0, report->t1), high = fmax(report->t0, report->t1), t0, t1;

    if (o->mixed)
        QDOT_TRY(qdot_member_span(o->session, o->columns.at[0], &low, &high));
    if (low > high)
        return qdot_fail(QDOT_EINVAL, "the runs have no time in common");
    t0 = back ? high : low;
    t1 = back ? low : high;

    *n = steps < POINTS ? POINTS : steps > MOST_POINTS ? MOST_POINTS : steps;
    *times = qdot_calloc(*n, sizeof **times);
    if (*times == NULL)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < *n; k++)
        (*times)[k] =
            k + 1 == *n ? t1 : t0 + (t1 - t0) * (double)k / (double)(*n - 1);
    return QDOT_OK;
}

/* y against t or against `versus`; a vector is the path of its two components. */
static qdot_status
curve_along(figure *f, const qdot_operand *y, const qdot_operand *versus)
{
    double *times = NULL, *values = NULL;
    size_t rows = 0, m = y->columns.n;
    qdot_status status = sample(y, &times, &rows);
    curve *one;

    if (status == QDOT_OK) {
        values = qdot_calloc(m * rows, sizeof *values);
        status = values == NULL ? QDOT_ENOMEM : QDOT_OK;
    }
    if (status == QDOT_OK)
        status = qdot_operands_values(y, rows, times, values);
    if (status == QDOT_OK && y->vector) {
        status = add_curve(f, y->label, rows, &one);
        if (status == QDOT_OK) {
            memcpy(one->x, values, rows * sizeof *values);
            memcpy(one->y, values + rows, rows * sizeof *values);
        }
    }
    for (size_t i = 0; !y->vector && i < m && status == QDOT_OK; i++) {
        status = add_curve(f, y->label, rows, &one);
        if (status == QDOT_OK && versus != NULL) {
            qdot_operand x = *versus;

            x.run = y->run;
            status = qdot_operands_values(&x, rows, times, one->x);
        } else if (status == QDOT_OK) {
            memcpy(one->x, times, rows * sizeof *times);
        }
        if (status == QDOT_OK)
            memcpy(one->y, values + i * rows, rows * sizeof *values);
    }
    qdot_free(times);
    qdot_free(values);
    return status;
}

static qdot_status
check_paths(const qdot_operands *list, const qdot_operands *versus, bool *paths)
{
    *paths = false;
    for (size_t i = 0; i < list->n; i++) {
        const qdot_operand *o = &list->at[i];

        *paths = *paths || o->vector;
        if (o->vector && o->columns.n > 2) {
            (void)qdot_fail(QDOT_ENOTBUILT, "not built yet: a path in space");
            return qdot_hint("plot %s[1], %s[2], ... shows its components", o->label,
                             o->label);
        }
        if (o->vector && versus->n > 0)
            return qdot_fail(QDOT_ETYPE,
                             "a path has no `vs`: its components are both axes");
    }
    for (size_t i = 0; *paths && i < list->n; i++)
        if (!list->at[i].vector)
            return qdot_fail(QDOT_ETYPE, "a path and a curve against t share no axes");
    if (versus->n > 1 || (versus->n == 1 && versus->at[0].columns.n != 1))
        return qdot_fail(QDOT_ETYPE, "`vs` takes one number");
    return QDOT_OK;
}

static qdot_status
plot_runs(qdot_cursor *c, qdot_operands *list, qdot_operands *versus, figure *f)
{
    const qdot_token *start = c->at;
    bool paths;

    QDOT_TRY(qdot_operands_read(c, list));
    while (!qdot_cursor_is_end(c)) {
        if (qdot_cursor_accept_word(c, "vs")) {
            QDOT_TRY(qdot_cursor_once(c, "vs", versus->n > 0));
            QDOT_TRY(qdot_operands_read(c, versus));
        } else if (qdot_cursor_accept_word(c, "to")) {
            QDOT_TRY(qdot_figure_file_read(c, &f->path));
        } else {
            return qdot_cursor_expected(c, "`vs`, `to` or the end of the statement");
        }
    }
    c->error_at = start->start;
    QDOT_TRY(check_paths(list, versus, &paths));
    QDOT_TRY(qdot_operands_find_runs(c->session, list));
    f->equal_axes = paths;
    f->x_label = qdot_strdup(versus->n > 0 ? versus->at[0].label : paths ? "x" : "t");
    if (f->x_label == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < list->n; i++)
        QDOT_TRY(curve_along(f, &list->at[i], versus->n > 0 ? &versus->at[0] : NULL));
    return QDOT_OK;
}

/* --- over a variable ---------------------------------------------------------------- */

typedef struct {
    const char *name;
    qdot_expr symbol; /* what the name means, or a symbol of its own */
    double from, to;
    const qdot_token *clause; /* behind `for`; NULL: none */
    const qdot_token *operands, *behind;
} variable;

/* `vs NAME = A..B` at the top level: its `vs`. */
static const qdot_token *
find_variable(const qdot_cursor *c)
{
    const qdot_token *vs = qdot_cursor_find_word(c, "vs");

    return vs->kind == QDOT_TOKEN_NAME && vs[1].kind == QDOT_TOKEN_NAME &&
                   vs[2].kind == QDOT_TOKEN_OPERATOR && strcmp(vs[2].text, "=") == 0
               ? vs
               : NULL;
}

/* The numbers of one curve. */
static qdot_status
fill_curve(qdot_session *session, const variable *v, qdot_expr e, curve *one)
{
    qdot_pool *pool = session->pool;
    qdot_expr x = qdot_symbol_get(pool, QDOT_FORMAL, "vs#x");
    qdot_tape *tape = NULL;
    double *work;

    e = qdot_session_bind(session, qdot_subs(pool, e, 1, &v->symbol, &x));
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(qdot_tape_new(pool, 1, &x, 1, &e, &tape));
    work = qdot_calloc(qdot_tape_work(tape) + 1, sizeof *work);
    for (size_t k = 0; work != NULL && k < one->rows; k++) {
        one->x[k] = v->from + (v->to - v->from) * (double)k / (double)(one->rows - 1);
        qdot_tape_eval(tape, &one->x[k], &one->y[k], work);
    }
    qdot_tape_free(tape);
    qdot_free(work);
    return work == NULL ? QDOT_ENOMEM : QDOT_OK;
}

/* The parameters of these names replaced by the values of the loop's indices. */
static qdot_expr
replace_indices(qdot_session *session, const qdot_loop *loop, qdot_expr e,
                qdot_text *label)
{
    for (size_t i = 0; loop != NULL && i < loop->indices.n; i++) {
        const char *name = loop->indices.at[i].name;
        qdot_expr param = qdot_symbol_get(session->pool, QDOT_PARAM, name);
        qdot_expr value = qdot_names_find(session->names, name)->value;

        e = qdot_subs(session->pool, e, 1, &param, &value);
        qdot_text_format(label, ", %s = ", name);
        if (qdot_print(session->pool, value, QDOT_PLAIN, label) != QDOT_OK)
            return qdot_pool_fail(session->pool);
    }
    return e;
}

/* The expressions, read anew for each pass of the loop; a curve each. */
static qdot_status
curves_over(qdot_cursor *c, const variable *v, const qdot_loop *loop, figure *f)
{
    qdot_session *session = c->session;

    c->at = v->operands;
    do {
        const qdot_token *start = c->at;
        qdot_text label = {0};
        qdot_status status;
        qdot_expr e;
        curve *one;

        QDOT_TRY(qdot_read_scalar(c, &e));
        c->error_at = start->start;
        qdot_token_text(c->session, start, c->at, &label);
        e = replace_indices(session, loop, e, &label);
        status = qdot_pool_check(session->pool);
        if (status == QDOT_OK)
            status = qdot_text_status(&label);
        if (status == QDOT_OK)
            status = add_curve(f, qdot_text_str(&label), POINTS, &one);
        if (status == QDOT_OK)
            status = fill_curve(session, v, e, one);
        qdot_text_clear(&label);
        QDOT_TRY(status);
    } while (qdot_cursor_accept_op(c, ","));
    if (qdot_cursor_is_word(c, "vs"))
        return QDOT_OK;
    return qdot_cursor_expected(c, "`vs`");
}

/* `NAME = A..B [for ...] [to FILE]` behind `vs`. A `to` behind a `for` ends it. */
static qdot_status
read_variable(qdot_cursor *c, variable *v, figure *f)
{
    const qdot_name *known;
    qdot_expr from, to;

    v->name = c->at->text;
    known = qdot_names_find(c->session->names, v->name);
    v->symbol =
        known != NULL && qdot_expr_kind(c->session->pool, known->value) == QDOT_SYM
            ? known->value
            : qdot_symbol_get(c->session->pool, QDOT_FORMAL, v->name);
    c->at += 2;
    QDOT_TRY(qdot_read_range(c, &from, &to));
    QDOT_TRY(qdot_session_number(c->session, from, &v->from, NULL));
    QDOT_TRY(qdot_session_number(c->session, to, &v->to, NULL));
    if (qdot_cursor_accept_word(c, "for")) {
        v->clause = c->at;
        c->at = qdot_cursor_find_word(c, "to");
    }
    v->behind = c->at;
    if (qdot_cursor_accept_word(c, "to"))
        QDOT_TRY(qdot_figure_file_read(c, &f->path));
    return qdot_cursor_expect_end(c);
}

static qdot_status
loop_over(qdot_cursor *c, const variable *v, figure *f)
{
    qdot_token *behind = (qdot_token *)v->behind; /* an end to the clause for the while */
    uint8_t kind = behind->kind;
    qdot_cursor clause = *c;
    qdot_status status;
    qdot_loop loop;
    bool more;

    clause.at = v->clause;
    behind->kind = QDOT_TOKEN_END;
    status = qdot_loop_begin(&loop, &clause, &more);
    if (status != QDOT_OK)
        c->error_at = loop.error_at;
    while (status == QDOT_OK && more) {
        behind->kind = kind;
        status = curves_over(c, v, &loop, f);
        behind->kind = QDOT_TOKEN_END;
        if (status == QDOT_OK) {
            status = qdot_loop_next(&loop, &more);
            if (status != QDOT_OK)
                c->error_at = loop.error_at;
        }
    }
    behind->kind = kind;
    qdot_loop_end(&loop);
    return status;
}

static qdot_status
plot_over(qdot_cursor *c, const qdot_token *vs, figure *f)
{
    variable v = {.operands = c->at};
    qdot_cursor own = *c;
    const qdot_token *end;
    bool bound;
    qdot_status status;

    own.at = vs + 1;
    status = read_variable(&own, &v, f);
    end = own.at;
    if (status == QDOT_OK) {
        f->x_label = qdot_strdup(v.name);
        status = f->x_label == NULL ? QDOT_ENOMEM : QDOT_OK;
    }
    bound = status == QDOT_OK && qdot_names_find(c->session->names, v.name) == NULL;
    if (bound)
        status = qdot_names_push(c->session->names, v.name, v.symbol);
    if (status == QDOT_OK)
        status =
            v.clause != NULL ? loop_over(&own, &v, f) : curves_over(&own, &v, NULL, f);
    if (bound)
        qdot_names_pop(c->session->names);
    c->error_at = own.error_at;
    c->at = end;
    if (status == QDOT_OK && f->curves.n == 0)
        status = qdot_fail(QDOT_EINVAL, "there is no curve to plot");
    return status;
}

qdot_status
qdot_plot_statement(qdot_cursor *c)
{
    qdot_operands list = {0}, versus = {0};
    const qdot_token *vs = find_variable(c);
    figure f = {0};
    qdot_status status =
        vs != NULL ? plot_over(c, vs, &f) : plot_runs(c, &list, &versus, &f);

    if (status == QDOT_OK)
        status = finish(c->session, &f);
    free_figure(&f);
    qdot_operands_free(&list);
    qdot_operands_free(&versus);
    return status;
}
