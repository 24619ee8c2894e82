/* plot-run.c -- draws curves along runs: over t, over each other, as paths of points, as drifts. */
#include <math.h>
#include <string.h>

#include "lang/figures/plot-parts.h"
#include "lang/language/token-text.h"
#include "lang/session/member.h"

enum { LEAST_POINTS = 201, PARTS_OF_STEP = 8, MOST_AT_FIRST = 10001 };

/* a drift of 0 has no logarithm: on a logarithmic axis it is drawn as this, the rounding error */
static const double drift_floor = 0x1p-54;

/* --- reading expressions ------------------------------------------------------------ */

static qdot_status
add_item(qdot_plot_panel *p, bool drift)
{
    while (p->items.n < p->operands.n)
        QDOT_TRY(qdot_vec_push(&p->items,
                               ((qdot_plot_item){.drift = drift, .pass = p->passes.n})));
    return QDOT_OK;
}

/* Add expression k of the part as an operand; in a loop its label is the typed text, since index
 * values follow all labels. */
static qdot_status
add_operand(qdot_record *r, const qdot_filled *part, size_t k, qdot_plot_panel *p, qdot_operands *list)
{
    const qdot_compiled *program = &r->compiled.at[part->first + k];
    qdot_text written = {0};
    qdot_operand o = {0};
    qdot_status status = qdot_operand_find(r, part, k, &o);

    if (status == QDOT_OK && list == &p->versus && o.columns.n != 1) {
        r->cursor.error_at = program->from->start;
        status = qdot_fail(QDOT_ETYPE, "`vs` takes one number");
    }
    if (status == QDOT_OK && p->passes.n > 0) {
        qdot_token_text_written(r->cursor.session, program->from, program->to, &written);
        status = qdot_text_status(&written);
        if (status == QDOT_OK) {
            qdot_free(o.label);
            o.label = written.at;
        } else {
            qdot_text_clear(&written);
        }
    }
    if (status == QDOT_OK)
        status = qdot_vec_push(list, o);
    if (status != QDOT_OK)
        qdot_operand_clear(&o);
    return status;
}

/* Read one item of `plot`: an expression E, or drift(E, ...). */
static qdot_status
read_item(qdot_record *r, const qdot_filled *part, qdot_plot_panel *p)
{
    const bool drift = part->n > 1;

    for (size_t k = drift; k < part->n; k++) {
        QDOT_TRY(add_operand(r, part, k, p, &p->operands));
        QDOT_TRY(add_item(p, drift));
    }
    return QDOT_OK;
}

/* Read the list E, ... [vs E], ...: the abscissa after `vs` belongs to the items since the previous `vs`. */
static qdot_status
read_items(const qdot_plot_said *said, qdot_plot_panel *p)
{
    const qdot_filled *end = qdot_plot_data_find(said);
    size_t first = p->items.n;

    for (const qdot_filled *part = said->from; part < end; part++) {
        if (part->node->kind == QDOT_USAGE_WORD && !qdot_filled_is(part, "vs"))
            return QDOT_OK;
        if (part->node->kind != QDOT_USAGE_HOLE)
            continue;
        if (!qdot_filled_is(part - 1, "vs")) {
            QDOT_TRY(read_item(said->record, part, p));
            continue;
        }
        QDOT_TRY(add_operand(said->record, part, 0, p, &p->versus));
        while (first < p->items.n)
            p->items.at[first++].versus = p->versus.n;
    }
    return QDOT_OK;
}

/* --- loops: the run is repeated for each pass ---------------------------------------------- */

typedef struct {
    const qdot_plot_runs *runs;
    qdot_plot_panel *panel;
} repeated;

/* Hold the run just made with the present index values, and assign it to operands that name no run. */
static qdot_status
hold_latest_run(qdot_session *session, qdot_plot_panel *p, qdot_operands *list, size_t first)
{
    qdot_named_run *latest;

    QDOT_TRY(qdot_runs_find(session, NULL, &latest));
    for (size_t i = first; i < list->n; i++) {
        if (list->at[i].run == NULL) {
            list->at[i].run = latest->run;
            continue;
        }
        (void)qdot_fail(QDOT_EINVAL, "`%.200s` names its run, which has one value of the index",
                        list->at[i].label);
        return qdot_hint("without a run before the point it is the latest, made once more for each value");
    }
    if (p->made.n > 0 && p->made.at[p->made.n - 1].run == latest->run)
        return QDOT_OK;
    QDOT_TRY(qdot_vec_push(&p->made, *latest));
    ++*latest->uses;
    return QDOT_OK;
}

static qdot_status
read_pass(const qdot_plot_said *said, const qdot_loop *loop, void *user)
{
    qdot_cursor *c = &said->record->cursor;
    const repeated *r = user;
    qdot_plot_panel *p = r->panel;
    const size_t first = p->operands.n, first_versus = p->versus.n;
    qdot_text indices = {0};
    qdot_status status = qdot_plot_indices(c->session, loop, &indices);

    if (status == QDOT_OK)
        status = qdot_text_status(&indices);
    if (status == QDOT_OK)
        status = qdot_vec_push(&p->passes, indices.at);
    if (status != QDOT_OK) {
        qdot_text_clear(&indices);
        return status;
    }
    c->error_at = said->from->from->start;
    status = r->runs->make(r->runs->user);
    if (status == QDOT_EFAILED) {
        const qdot_error error = *qdot_last_error();

        (void)qdot_fail(QDOT_EFAILED, "the run with %s: %s", p->passes.at[p->passes.n - 1] + 2,
                        error.message);
    }
    if (status == QDOT_OK)
        status = read_items(said, p);
    if (status == QDOT_OK)
        status = hold_latest_run(c->session, p, &p->operands, first);
    if (status == QDOT_OK)
        status = hold_latest_run(c->session, p, &p->versus, first_versus);
    r->runs->drop(r->runs->user);
    return status;
}

static qdot_status
read_loop(const qdot_plot_said *said, const qdot_plot_runs *runs, qdot_plot_panel *p)
{
    repeated r = {runs, p};

    said->record->cursor.error_at = said->from[-1].from->start; /* errors point at the word `plot` */
    QDOT_TRY(runs->begin(runs->user));
    QDOT_TRY(qdot_plot_loop_carry_out(said, said->from[-1].from, read_pass, &r));
    return p->operands.n > 0 ? QDOT_OK : qdot_fail(QDOT_EINVAL, "there is no curve to plot");
}

/* Refuse curves that cannot share axes: paths in space beside curves over t, for example. */
static qdot_status
check_curves_share_axes(const qdot_plot_panel *p)
{
    size_t paths = 0, space = 0, against = 0;

    for (size_t i = 0; i < p->operands.n; i++) {
        const qdot_operand *o = &p->operands.at[i];

        paths += o->vector;
        space += o->vector && o->columns.n == 3;
        against += p->items.at[i].versus > 0;
        if (o->vector && o->columns.n > 3) {
            (void)qdot_fail(QDOT_ETYPE, "a path has two or three components, `%s` has %zu",
                            o->label, o->columns.n);
            return qdot_hint("plot %s[1], %s[2], ... shows its components", o->label,
                             o->label);
        }
        if (o->vector && p->items.at[i].versus > 0)
            return qdot_fail(QDOT_ETYPE,
                             "a path has no `vs`: its components are the axes");
        if (o->vector && p->items.at[i].drift)
            return qdot_fail(QDOT_ETYPE, "the drift of a path is that of its components");
    }
    if (paths > 0 && paths < p->operands.n)
        return qdot_fail(QDOT_ETYPE, "a path and a curve against t share no axes");
    if (space > 0 && space < paths)
        return qdot_fail(QDOT_ETYPE, "paths in the plane and in space share no axes");
    if (space > 0 && (p->choice.range[0].set || p->choice.range[1].set || p->choice.logs))
        return qdot_fail(QDOT_EINVAL, "a path in space is shown whole, on linear axes");
    if (paths > 0 && p->choice.logs)
        return qdot_fail(QDOT_EINVAL, "a path has equal scales, which are not logarithmic");
    if (p->choice.n_labels == 3 && space == 0)
        return qdot_fail(QDOT_EINVAL, "axes in the plane have two labels");
    if (against == 0 || against == p->operands.n)
        return QDOT_OK;
    (void)qdot_fail(QDOT_ETYPE, "some curves have a `vs` and `%s` has none",
                    p->operands.at[p->operands.n - 1].label);
    return qdot_hint("plot y1 vs x1, y2 vs x2; `vs t` is the course");
}

/* --- computing points --------------------------------------------------------------- */

static qdot_status
evaluate_path(void *user, size_t n, const double *s, double *values)
{
    const qdot_plot_curve *curve = user;

    return qdot_operands_values(curve->y, n, s, values, NULL);
}

static qdot_status
evaluate_curve(void *user, size_t n, const double *s, double *values)
{
    const qdot_plot_curve *curve = user;
    const size_t m = curve->y->columns.n;
    double *all = qdot_calloc(m * n + 1, sizeof *all), *y = values + n;
    qdot_status status = all == NULL ? QDOT_ENOMEM : QDOT_OK;

    memcpy(values, s, n * sizeof *s);
    if (status == QDOT_OK && curve->x.session != NULL)
        status = qdot_operands_values(&curve->x, n, s, values, NULL);
    if (status == QDOT_OK)
        status = qdot_operands_values(curve->y, n, s, all, NULL);
    if (status == QDOT_OK)
        memcpy(y, all + curve->component * n, n * sizeof *y);
    for (size_t k = 0; curve->drift && k < n && status == QDOT_OK; k++) {
        y[k] = fabs(y[k] - curve->begin) / fmax(1, fabs(curve->begin));
        y[k] = y[k] < drift_floor ? drift_floor : y[k];
    }
    qdot_free(all);
    return status;
}

/* Narrow the time range low..high to the times that the runs of an operand cover. */
static qdot_status
narrow_to_run_times(const qdot_operand *o, double *low, double *high)
{
    const qdot_run_report *r = qdot_run_get_report(o->run);

    *low = fmax(*low, fmin(r->t0, r->t1));
    *high = fmin(*high, fmax(r->t0, r->t1));
    return o->mixed ? qdot_member_span(o->session, o->columns.at[0], low, high) : QDOT_OK;
}

/* Choose the times of the first points: each step divided evenly, or, if there are many steps,
 * evenly spaced. */
static qdot_status
choose_first_times(const qdot_plot_curve *curve, double low, double high, double **times, size_t *n)
{
    size_t steps, parts, at = 0, most;
    const double *ends = qdot_run_times(curve->y->run, &steps);
    const bool back = steps > 1 && ends[steps - 1] < ends[0];
    const double from = back ? high : low, to = back ? low : high;

    parts = steps > 1 ? LEAST_POINTS / (steps - 1) + 1 : LEAST_POINTS;
    parts = parts < PARTS_OF_STEP ? PARTS_OF_STEP : parts;
    most = parts * (steps + 1) + 2;
    most = most > MOST_AT_FIRST ? MOST_AT_FIRST : most;
    *times = qdot_calloc(most + 1, sizeof **times);
    if (*times == NULL)
        return QDOT_ENOMEM;
    if (most == MOST_AT_FIRST) {
        for (size_t k = 0; k < most; k++)
            (*times)[k] = from + (to - from) * (double)k / (double)(most - 1);
        (*times)[most - 1] = to;
        *n = most;
        return QDOT_OK;
    }
    (*times)[at++] = from;
    for (size_t k = 0; k + 1 < steps; k++)
        for (size_t j = 0; j < parts; j++) {
            double t = ends[k] + (ends[k + 1] - ends[k]) * (double)j / (double)parts;

            if (back ? t < (*times)[at - 1] && t > to : t > (*times)[at - 1] && t < to)
                (*times)[at++] = t;
        }
    if (to != from)
        (*times)[at++] = to;
    *n = at;
    return QDOT_OK;
}

/* A logarithmic axis of times from 0 on begins at a power of ten, some way before the second time, and not
 * wherever steps happen to be halved to. */
static void
move_off_zero(double *times, size_t n)
{
    enum { powers_before = 3 };

    if (n > 1 && times[0] == 0 && times[1] > 0)
        times[0] = pow(10, floor(log10(times[1])) - powers_before);
}

/* Compute the first points of a curve along its run. */
static qdot_status
compute_first_points(qdot_plot_panel *p, qdot_plot_curve *curve)
{
    double low = -INFINITY, high = INFINITY, *times = NULL;
    const qdot_figure_range *r = &p->choice.range[0];
    size_t n = 0;
    qdot_status status;

    QDOT_TRY(narrow_to_run_times(curve->y, &low, &high));
    if (curve->x.session != NULL)
        QDOT_TRY(narrow_to_run_times(&curve->x, &low, &high));
    if (low > high)
        return qdot_fail(QDOT_EINVAL, "the runs have no time in common");
    if (curve->drift) {
        const double t0 = qdot_run_get_report(curve->y->run)->t0;
        qdot_plot_curve whole = *curve;
        double at[2];

        whole.drift = false;
        whole.x.session = NULL;
        QDOT_TRY(evaluate_curve(&whole, 1, &t0, at));
        curve->begin = at[1];
    }
    if (r->set && !curve->y->vector && curve->x.session == NULL) {
        if (r->least >= high || r->most <= low)
            return qdot_fail(QDOT_EINVAL, "the run has no time between %.6g and %.6g",
                             r->least, r->most);
        low = fmax(low, r->least);
        high = fmin(high, r->most);
    }
    status = choose_first_times(curve, low, high, &times, &n);
    if (status == QDOT_OK && p->choice.log[0] && !curve->y->vector && curve->x.session == NULL)
        move_off_zero(times, n);
    if (status == QDOT_OK)
        status = qdot_trace_begin(&curve->source, n, times, &curve->points);
    qdot_free(times);
    return status;
}

/* Write the label of curve i: "theta' vs theta" if the curves have different abscissae. */
static qdot_status
write_labels(const qdot_plot_panel *p, size_t i, qdot_text *label, qdot_text *axis)
{
    const qdot_operand *o = &p->operands.at[i];
    const size_t versus = p->items.at[i].versus;

    qdot_text_format(axis, p->items.at[i].drift ? "drift(%s)" : "%s", o->label);
    qdot_text_add(label, qdot_text_str(axis));
    if (p->versus.n > (p->passes.n > 0 ? p->passes.n : 1) && versus > 0)
        qdot_text_format(label, " vs %s", p->versus.at[versus - 1].label);
    if (p->items.at[i].pass > 0)
        qdot_text_add(label, p->passes.at[p->items.at[i].pass - 1]);
    QDOT_TRY(qdot_text_status(axis));
    return qdot_text_status(label);
}

static qdot_status
make_curves_of_item(qdot_plot_panel *p, size_t i)
{
    const qdot_operand *o = &p->operands.at[i];
    const size_t versus = p->items.at[i].versus, m = o->vector ? 1 : o->columns.n;
    qdot_text label = {0}, axis = {0};
    qdot_status status = write_labels(p, i, &label, &axis);

    for (size_t k = 0; k < m && status == QDOT_OK; k++) {
        qdot_plot_curve *curve;

        status = qdot_plot_curve_add(p, qdot_text_str(&label), qdot_text_str(&axis), &curve);
        if (status != QDOT_OK)
            break;
        curve->y = o;
        curve->component = k;
        curve->drift = p->items.at[i].drift;
        if (versus > 0) {
            curve->x = p->versus.at[versus - 1];
            curve->x.run = curve->x.run != NULL ? curve->x.run : o->run;
        }
        curve->source = (qdot_trace_source){.axes = o->vector ? o->columns.n : 2,
                                             .values = o->vector ? evaluate_path : evaluate_curve,
                                             .user = curve};
        status = compute_first_points(p, curve);
        if (status == QDOT_OK)
            status = qdot_plot_curve_unit(o->session, curve, o->columns.at[k]);
    }
    qdot_text_clear(&label);
    qdot_text_clear(&axis);
    return status;
}

qdot_status
qdot_plot_run(const qdot_plot_said *said, const qdot_plot_runs *runs, qdot_plot_panel *p,
              qdot_figure_choice *figure)
{
    qdot_record *r = said->record;

    QDOT_TRY(qdot_plot_find_word(said, "for") != NULL ? read_loop(said, runs, p) : read_items(said, p));
    QDOT_TRY(qdot_figure_option_find(r, said->from, said->to, figure, &p->choice));
    r->cursor.error_at = said->from->from->start;
    QDOT_TRY(check_curves_share_axes(p));
    QDOT_TRY(qdot_operands_find_runs(r->cursor.session, &p->operands));
    for (size_t i = 0; i < p->operands.n; i++)
        QDOT_TRY(make_curves_of_item(p, i));
    return QDOT_OK;
}
