/* plot-bode.c -- how a quotient of polynomials in s answers oscillations: magnitude and phase at s = i w. */
#include "lang/figures/plot-bode.h"

#include <math.h>
#include <string.h>

#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "lang/functions/quotient.h"
#include "lang/language/token-text.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "normal/solve/complex-roots.h"
#include "num/frequency.h"

enum { FIRST_POINTS = 401 };

/* The response of one quotient, with its zeros and poles behind it. */
typedef struct {
    qdot_frequency G;
    double root[];
} response;

/* The range of the frequency; least 0: not known yet. */
typedef struct {
    const char *name;
    double least, most;
} frequencies;

bool
qdot_plot_bode_is(const qdot_plot_said *said)
{
    return said->from < said->to && said->from->node->kind == QDOT_USAGE_WORD && qdot_filled_is(said->from, "bode");
}

/* --- the quotient --------------------------------------------------------------------------- */

/* The coefficients as rational numbers, with the values of `set`. */
static qdot_status
coefficients_as_numbers(qdot_session *s, qdot_quotient *G)
{
    for (size_t i = 0; i < G->top.n + G->bottom.n; i++) {
        qdot_expr *c = i < G->top.n ? &G->top.at[i] : &G->bottom.at[i - G->top.n];
        double value;

        if (qdot_expr_rational(s->pool, *c) != NULL)
            continue;
        QDOT_TRY(qdot_session_number(s, *c, &value, NULL));
        *c = qdot_measured_rational(s->pool, value);
    }
    return qdot_pool_check(s->pool);
}

static double
leading_coefficient(const qdot_pool *pool, const qdot_coefficients *c)
{
    return fmpq_get_d(qdot_expr_rational(pool, c->at[c->n - 1]));
}

static qdot_status
find_zeros_and_poles(qdot_session *s, const qdot_quotient *G, response **out)
{
    const size_t zeros = G->top.n - 1, poles = G->bottom.n - 1;
    response *r = qdot_calloc(1, sizeof *r + 2 * (zeros + poles + 1) * sizeof *r->root);
    qdot_status status;

    if (r == NULL)
        return QDOT_ENOMEM;
    r->G = (qdot_frequency){.gain = leading_coefficient(s->pool, &G->top) / leading_coefficient(s->pool, &G->bottom),
                            .zero = {zeros, r->root, r->root + zeros},
                            .pole = {poles, r->root + 2 * zeros, r->root + 2 * zeros + poles}};
    status = qdot_complex_roots(s->pool, zeros, G->top.at, r->root, r->root + zeros);
    if (status == QDOT_OK)
        status = qdot_complex_roots(s->pool, poles, G->bottom.at, r->root + 2 * zeros, r->root + 2 * zeros + poles);
    if (status == QDOT_OK)
        *out = r;
    else
        qdot_free(r);
    return status;
}

/* Evaluate one expression, in which s is Laplace's variable, and find its zeros and poles. */
static qdot_status
read_response(qdot_record *r, const qdot_filled *part, response **out)
{
    qdot_session *session = r->cursor.session;
    const qdot_expr s = qdot_quotient_laplace(session);
    const bool bound = qdot_names_find(session->names, "s") == NULL;
    qdot_quotient G = {0};
    qdot_status status = QDOT_OK;
    qdot_expr e;

    if (bound)
        QDOT_TRY(qdot_names_push(session->names, "s", s));
    status = qdot_record_scalar(r, part, &e);
    if (bound)
        qdot_names_pop(session->names);
    QDOT_TRY(status);
    r->cursor.error_at = r->compiled.at[part->first].from->start;
    e = qdot_session_bind(session, qdot_measured_as_rationals(session, e));
    QDOT_TRY(qdot_pool_check(session->pool));
    status = qdot_quotient_of(session, e, s, &G);
    if (status == QDOT_OK)
        status = coefficients_as_numbers(session, &G);
    if (status == QDOT_OK)
        status = find_zeros_and_poles(session, &G, out);
    qdot_quotient_clear(&G);
    return status;
}

/* --- curves ----------------------------------------------------------------------------------- */

/* Abscissa and ordinate at the decimal logarithms s of the frequency. */
static qdot_status
evaluate_magnitude(void *user, size_t n, const double *s, double *values)
{
    const qdot_plot_curve *curve = user;

    for (size_t k = 0; k < n; k++) {
        values[k] = pow(10, s[k]);
        values[n + k] = qdot_frequency_decibels(&((const response *)curve->response)->G, values[k]);
    }
    return QDOT_OK;
}

static qdot_status
evaluate_phase(void *user, size_t n, const double *s, double *values)
{
    const qdot_plot_curve *curve = user;

    for (size_t k = 0; k < n; k++) {
        values[k] = pow(10, s[k]);
        values[n + k] = qdot_frequency_degrees(&((const response *)curve->response)->G, values[k]);
    }
    return QDOT_OK;
}

/* Add a curve; its response is owned by the curve of the first panel. */
static qdot_status
add_curve(qdot_record *r, const qdot_filled *part, qdot_plot_panel *p, response *G, bool own, qdot_plot_curve **added)
{
    const qdot_compiled *program = &r->compiled.at[part->first];
    qdot_text label = {0};
    qdot_status status;

    qdot_token_text_written(r->cursor.session, program->from, program->to, &label);
    status = qdot_text_status(&label);
    if (status == QDOT_OK)
        status = qdot_plot_curve_add(p, qdot_text_str(&label), "", added);
    qdot_text_clear(&label);
    if (status != QDOT_OK) {
        if (own)
            qdot_free(G);
        return status;
    }
    (*added)->response = G;
    (*added)->borrowed = !own;
    (*added)->source = (qdot_trace_source){
        .axes = 2, .values = own ? evaluate_magnitude : evaluate_phase, .user = *added, .jumps = true};
    return QDOT_OK;
}

static qdot_status
sample_response(const frequencies *w, qdot_plot_curve *curve)
{
    const double from = log10(w->least), to = log10(w->most);
    double s[FIRST_POINTS];

    for (size_t k = 0; k < FIRST_POINTS; k++)
        s[k] = from + (to - from) * (double)k / (FIRST_POINTS - 1);
    return qdot_trace_begin(&curve->source, FIRST_POINTS, s, &curve->points);
}

/* --- the range ------------------------------------------------------------------------------------ */

/* Read `for w = A..B`. */
static qdot_status
read_frequencies(const qdot_plot_said *said, frequencies *w)
{
    const qdot_filled *word = qdot_plot_find_word(said, "for");
    qdot_record *r = said->record;
    const qdot_filled *range;
    qdot_expr from, to;

    *w = (frequencies){.name = "omega"};
    if (word == NULL)
        return QDOT_OK;
    range = qdot_record_next(r, word + 1, "A..B");
    w->name = word[1].from->text;
    QDOT_TRY(qdot_record_range(r, range, &from, &to));
    QDOT_TRY(qdot_session_number(r->cursor.session, from, &w->least, NULL));
    QDOT_TRY(qdot_session_number(r->cursor.session, to, &w->most, NULL));
    if (w->least > 0 && w->least < w->most && isfinite(w->most))
        return QDOT_OK;
    qdot_record_blame(r, range);
    (void)qdot_fail(QDOT_EINVAL, "the frequency goes from a positive number to a greater one, as its axis is logarithmic");
    return qdot_hint("for %.40s = 0.1..100", w->name);
}

static void
widen(const qdot_frequency_roots *roots, double *least, double *most)
{
    for (size_t k = 0; k < roots->n; k++) {
        const double size = hypot(roots->re[k], roots->im[k]);

        if (size == 0)
            continue;
        *least = fmin(*least, size);
        *most = fmax(*most, size);
    }
}

/* The decades in which zeros and poles lie, and one more on both sides. */
static void
choose_frequencies(const qdot_plot_panel *p, frequencies *w)
{
    double least = INFINITY, most = 0;

    for (size_t k = 0; k < p->curves.n; k++) {
        const response *r = p->curves.at[k]->response;

        widen(&r->G.zero, &least, &most);
        widen(&r->G.pole, &least, &most);
    }
    w->least = most > 0 ? pow(10, floor(log10(least)) - 1) : 0.1;
    w->most = most > 0 ? pow(10, ceil(log10(most)) + 1) : 10;
}

/* --- options --------------------------------------------------------------------------------------- */

/* The options of the diagram; the second panel has those of the abscissa and of the looks. */
static qdot_status
read_bode_options(const qdot_plot_said *said, qdot_plot_panel *magnitude, qdot_plot_panel *phase, qdot_figure_choice *figure)
{
    static const char *const own[] = {"log", "ticks", "equal", "range", "labels", "ylabel"};

    for (const qdot_filled *part = said->from; part < said->to; part++)
        for (size_t i = 0; i < sizeof own / sizeof *own; i++)
            if (part->node->kind == QDOT_USAGE_WORD && qdot_filled_is(part, own[i])) {
                qdot_record_blame(said->record, part);
                (void)qdot_fail(QDOT_EINVAL, "`%s` is not chosen here: decibels and degrees over the logarithm of the frequency",
                                own[i]);
                return qdot_hint("leave it out; `xlabel`, `from A to B`, `title` and the like may stand");
            }
    QDOT_TRY(qdot_figure_option_find(said->record, said->from, said->to, figure, &magnitude->choice));
    magnitude->choice.logs = magnitude->choice.log[0] = true;
    phase->choice = magnitude->choice;
    phase->choice.title = NULL;
    magnitude->choice.labels[1] = "magnitude (dB)";
    phase->choice.degrees = true;
    phase->choice.labels[1] = "phase (degrees)";
    return QDOT_OK;
}

static qdot_status
name_frequency(qdot_plot_panel *p, const char *name)
{
    p->variable = qdot_strdup(name);
    return p->variable == NULL ? QDOT_ENOMEM : QDOT_OK;
}

qdot_status
qdot_plot_bode(const qdot_plot_said *said, qdot_plot_panel *magnitude, qdot_plot_panel *phase, qdot_figure_choice *figure)
{
    const qdot_filled *end = said->from;
    frequencies w;

    while (end < said->to && !(end > said->from && end->node->kind == QDOT_USAGE_WORD))
        end++;
    QDOT_TRY(read_bode_options(said, magnitude, phase, figure));
    QDOT_TRY(read_frequencies(said, &w));
    QDOT_TRY(name_frequency(magnitude, w.name));
    QDOT_TRY(name_frequency(phase, w.name));
    for (const qdot_filled *part = said->from; part < end; part++)
        if (part->node->kind == QDOT_USAGE_HOLE) {
            response *G = NULL;
            qdot_plot_curve *curve;

            QDOT_TRY(read_response(said->record, part, &G));
            QDOT_TRY(add_curve(said->record, part, magnitude, G, true, &curve));
            QDOT_TRY(add_curve(said->record, part, phase, G, false, &curve));
        }
    if (w.least == 0)
        choose_frequencies(magnitude, &w);
    for (size_t k = 0; k < magnitude->curves.n; k++) {
        QDOT_TRY(sample_response(&w, magnitude->curves.at[k]));
        QDOT_TRY(sample_response(&w, phase->curves.at[k]));
    }
    return QDOT_OK;
}
