/* plot-over.c -- curves of an expression over a variable; no run is needed. */
#include <string.h>

#include "expr/calculus.h"
#include "expr/node.h"
#include "lang/figures/plot-loop.h"
#include "lang/figures/plot-parts.h"
#include "lang/language/read.h"
#include "lang/language/token-text.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/member.h"

enum { FIRST_POINTS = 401 };

typedef struct {
    const char *name;
    qdot_expr symbol; /* what the name means, or a symbol of its own */
    double from, to;
    const qdot_token *clause; /* behind `for`; NULL: none */
    const qdot_token *operands, *behind;
} variable;

const qdot_token *
qdot_plot_over_find(const qdot_cursor *c)
{
    const qdot_token *vs = qdot_cursor_find_word(c, "vs");

    return vs->kind == QDOT_TOKEN_NAME && vs[1].kind == QDOT_TOKEN_NAME &&
                   vs[2].kind == QDOT_TOKEN_OPERATOR && strcmp(vs[2].text, "=") == 0
               ? vs
               : NULL;
}

static qdot_status
over_values(void *user, size_t n, const double *s, double *values)
{
    const qdot_plot_curve *curve = user;

    memcpy(values, s, n * sizeof *s);
    for (size_t k = 0; k < n; k++)
        qdot_tape_eval(curve->tape, &s[k], &values[n + k], curve->work);
    return QDOT_OK;
}

/* Compute the first points of one curve. */
static qdot_status
fill_curve(qdot_session *session, const variable *v, qdot_expr e, qdot_plot_curve *one)
{
    qdot_pool *pool = session->pool;
    qdot_expr x = qdot_symbol_get(pool, QDOT_FORMAL, "vs#x");
    double s[FIRST_POINTS];

    QDOT_TRY(qdot_member_refuse(session, e));
    e = qdot_measured_as_rationals(session, e);
    e = qdot_session_bind(session, qdot_subs(pool, e, 1, &v->symbol, &x));
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(qdot_tape_new(pool, 1, &x, 1, &e, &one->tape));
    one->work = qdot_calloc(qdot_tape_work(one->tape) + 1, sizeof *one->work);
    if (one->work == NULL)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < FIRST_POINTS; k++)
        s[k] = k + 1 == FIRST_POINTS ? v->to
                                     : v->from + (v->to - v->from) * (double)k /
                                                     (double)(FIRST_POINTS - 1);
    one->source = (qdot_trace_source){
        .axes = 2, .values = over_values, .user = one, .jumps = true};
    return qdot_trace_begin(&one->source, FIRST_POINTS, s, &one->points);
}

/* Read one expression and make it a curve; the cursor ends after it. */
static qdot_status
curve_over(qdot_cursor *c, const variable *v, const qdot_loop *loop, qdot_plot_panel *p)
{
    qdot_session *session = c->session;
    const qdot_token *start = c->at;
    qdot_text axis = {0}, label = {0};
    qdot_plot_curve *curve;
    qdot_status status;
    qdot_expr e;

    QDOT_TRY(qdot_read_scalar(c, &e));
    c->error_at = start->start;
    qdot_token_text_written(session, start, c->at, &axis);
    qdot_text_add(&label, qdot_text_str(&axis));
    status = qdot_plot_indices(session, loop, &label);
    if (status == QDOT_OK)
        status = qdot_text_status(&axis);
    if (status == QDOT_OK)
        status = qdot_text_status(&label);
    if (status == QDOT_OK)
        status = qdot_plot_curve_add(p, qdot_text_str(&label), qdot_text_str(&axis), &curve);
    if (status == QDOT_OK)
        status = fill_curve(session, v, e, curve);
    qdot_text_clear(&axis);
    qdot_text_clear(&label);
    return status;
}

/* The expressions, read anew for each pass of the loop; a curve each. */
static qdot_status
curves_over(qdot_cursor *c, const variable *v, const qdot_loop *loop, qdot_plot_panel *p)
{
    c->at = v->operands;
    do
        QDOT_TRY(curve_over(c, v, loop, p));
    while (qdot_cursor_accept_op(c, ","));
    return qdot_cursor_is_word(c, "vs") ? QDOT_OK : qdot_cursor_expected(c, "`vs`");
}

/* Read `NAME = A..B [for ...]` with options, after `vs`. */
static qdot_status
read_variable(qdot_cursor *c, variable *v, qdot_plot_panel *p, qdot_figure_choice *figure)
{
    const qdot_token *start = c->at;
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
        c->at = qdot_plot_clause_end(c);
    }
    v->behind = c->at;
    QDOT_TRY(qdot_figure_option_read(c, figure, &p->choice));
    if (!qdot_cursor_is_end(c))
        return qdot_cursor_expected(c, v->clause != NULL ? QDOT_FIGURE_OPTIONS
                                                         : "`for`, " QDOT_FIGURE_OPTIONS);
    if (p->choice.n_labels == 3) {
        c->error_at = start->start;
        return qdot_fail(QDOT_EINVAL, "axes in the plane have two labels");
    }
    return QDOT_OK;
}

typedef struct {
    const variable *v;
    qdot_plot_panel *panel;
} repeated;

static qdot_status
pass(qdot_cursor *c, const qdot_loop *loop, void *user)
{
    const repeated *r = user;

    return curves_over(c, r->v, loop, r->panel);
}

static qdot_status
loop_over(qdot_cursor *c, const variable *v, qdot_plot_panel *p)
{
    repeated r = {v, p};

    return qdot_plot_loop_carry_out(
        c, &(qdot_plot_loop){v->operands, v->clause - 1, v->clause, v->behind, pass, &r});
}

qdot_status
qdot_plot_over(qdot_cursor *c, const qdot_token *vs, qdot_plot_panel *p,
               qdot_figure_choice *figure)
{
    variable v = {.operands = c->at};
    qdot_cursor own = *c;
    const qdot_token *end;
    bool bound;
    qdot_status status;

    own.at = vs + 1;
    status = read_variable(&own, &v, p, figure);
    end = own.at;
    if (status == QDOT_OK) {
        p->variable = qdot_strdup(v.name);
        status = p->variable == NULL ? QDOT_ENOMEM : QDOT_OK;
    }
    bound = status == QDOT_OK && qdot_names_find(c->session->names, v.name) == NULL;
    if (bound)
        status = qdot_names_push(c->session->names, v.name, v.symbol);
    if (status == QDOT_OK)
        status = v.clause != NULL ? loop_over(&own, &v, p) : curves_over(&own, &v, NULL, p);
    if (bound)
        qdot_names_pop(c->session->names);
    c->error_at = own.error_at;
    c->at = end;
    if (status == QDOT_OK && p->curves.n == 0)
        status = qdot_fail(QDOT_EINVAL, "there is no curve to plot");
    return status;
}
