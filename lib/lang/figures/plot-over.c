/* plot-over.c -- curves of an expression over a variable, `plot E vs x = A..B`; no run is needed. */
#include <string.h>

#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/node.h"
#include "lang/figures/plot-parts.h"
#include "lang/language/token-text.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/member.h"
#include "lang/session/units.h"

enum { FIRST_POINTS = 401 };

typedef struct {
    const char *name;
    qdot_expr symbol; /* the variable's symbol: that of a declared name, or a new one */
    double from, to;
} variable;

static qdot_status
evaluate_curve(void *user, size_t n, const double *s, double *values)
{
    const qdot_plot_curve *curve = user;

    memcpy(values, s, n * sizeof *s);
    for (size_t k = 0; k < n; k++)
        qdot_tape_eval(curve->tape, &s[k], &values[n + k], curve->work);
    return QDOT_OK;
}

/* Compute the first points of one curve, evenly spaced before they are refined. */
static qdot_status
compute_first_points(qdot_session *session, const variable *v, qdot_expr e, qdot_plot_curve *one)
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
        .axes = 2, .values = evaluate_curve, .user = one, .jumps = true};
    return qdot_trace_begin(&one->source, FIRST_POINTS, s, &one->points);
}

/* Make the curve of one expression over the variable of `vs NAME = A..B`. */
static qdot_status
make_curve(qdot_record *r, const qdot_filled *part, const variable *v, const qdot_loop *loop, qdot_plot_panel *p)
{
    const qdot_compiled *program = &r->compiled.at[part->first];
    qdot_session *session = r->cursor.session;
    qdot_text axis = {0}, label = {0};
    qdot_plot_curve *curve;
    qdot_status status;
    qdot_expr e;

    QDOT_TRY(qdot_record_scalar(r, part, &e));
    r->cursor.error_at = program->from->start;
    qdot_token_text_written(session, program->from, program->to, &axis);
    qdot_text_add(&label, qdot_text_str(&axis));
    status = qdot_plot_indices(session, loop, &label);
    if (status == QDOT_OK)
        status = qdot_text_status(&axis);
    if (status == QDOT_OK)
        status = qdot_text_status(&label);
    if (status == QDOT_OK)
        status = qdot_plot_curve_add(p, qdot_text_str(&label), qdot_text_str(&axis), &curve);
    if (status == QDOT_OK)
        status = compute_first_points(session, v, e, curve);
    if (status == QDOT_OK)
        status = qdot_plot_curve_unit(session, curve, e);
    qdot_text_clear(&axis);
    qdot_text_clear(&label);
    return status;
}

typedef struct {
    const variable *v;
    qdot_plot_panel *panel;
} repeated;

/* Make the curves of this pass of the loop: each expression is evaluated with the present index values. */
static qdot_status
make_curves(const qdot_plot_said *said, const qdot_loop *loop, void *user)
{
    const qdot_filled *end = qdot_plot_data_find(said);
    const repeated *x = user;

    for (const qdot_filled *part = said->from; part < end && !qdot_filled_is(part, "vs"); part++)
        if (part->node->kind == QDOT_USAGE_HOLE)
            QDOT_TRY(make_curve(said->record, part, x->v, loop, x->panel));
    return QDOT_OK;
}

/* The ends of the range have the dimension of the variable; a bare number is one in SI units. */
static qdot_status
join_range(qdot_session *session, qdot_expr x, qdot_expr from, qdot_expr to)
{
    if (!qdot_expr_is_constant(session->pool, from))
        QDOT_TRY(qdot_units_join(session, x, from, "the range of %s has an end that is %s"));
    return qdot_expr_is_constant(session->pool, to) ? QDOT_OK
                                                    : qdot_units_join(session, x, to, "the range of %s has an end that is %s");
}

/* Read the variable and its range in `vs NAME = A..B`. */
static qdot_status
read_variable(qdot_record *r, const qdot_filled *name, variable *v)
{
    qdot_session *session = r->cursor.session;
    const qdot_name *known;
    qdot_expr from, to;

    QDOT_TRY(qdot_record_name(r, name, &v->name));
    known = qdot_names_find(session->names, v->name);
    v->symbol = known != NULL && qdot_expr_kind(session->pool, known->value) == QDOT_SYM
                    ? known->value
                    : qdot_symbol_get(session->pool, QDOT_FORMAL, v->name);
    QDOT_TRY(qdot_record_range(r, qdot_record_next(r, name, "A..B"), &from, &to));
    qdot_record_blame(r, qdot_record_next(r, name, "A..B"));
    if (known != NULL)
        QDOT_TRY(join_range(session, v->symbol, from, to));
    QDOT_TRY(qdot_session_number(session, from, &v->from, NULL));
    return qdot_session_number(session, to, &v->to, NULL);
}

/* Read the options of a panel whose axes are in the plane. */
static qdot_status
read_options(const qdot_plot_said *said, const qdot_filled *name, qdot_plot_panel *p, qdot_figure_choice *figure)
{
    QDOT_TRY(qdot_figure_option_find(said->record, said->from, said->to, figure, &p->choice));
    if (p->choice.n_labels < 3)
        return QDOT_OK;
    qdot_record_blame(said->record, name);
    return qdot_fail(QDOT_EINVAL, "axes in the plane have two labels");
}

qdot_status
qdot_plot_over(const qdot_plot_said *said, qdot_plot_panel *p, qdot_figure_choice *figure)
{
    const qdot_filled *name = qdot_plot_find_word(said, "vs") + 1;
    qdot_names *names = said->record->cursor.session->names;
    variable v;
    repeated x = {&v, p};
    qdot_status status;
    bool bound;

    QDOT_TRY(read_variable(said->record, name, &v));
    QDOT_TRY(read_options(said, name, p, figure));
    p->variable = qdot_strdup(v.name);
    p->over = v.symbol;
    if (p->variable == NULL)
        return QDOT_ENOMEM;
    bound = qdot_names_find(names, v.name) == NULL;
    if (bound)
        QDOT_TRY(qdot_names_push(names, v.name, v.symbol));
    status = qdot_plot_find_word(said, "for") != NULL
                 ? qdot_plot_loop_carry_out(said, said->from->from, make_curves, &x)
                 : make_curves(said, NULL, &x);
    if (bound)
        qdot_names_pop(names);
    return status == QDOT_OK && p->curves.n == 0 ? qdot_fail(QDOT_EINVAL, "there is no curve to plot") : status;
}
