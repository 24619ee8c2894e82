/* continue.c -- the statement `continue`: reads its operands, and follows branches of equilibria. */
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/commands/set.h"
#include "lang/commands/value-check.h"
#include "lang/session/bind.h"
#include "lang/session/row-tables.h"
#include "lang/session/speeds.h"
#include "lang/session/trial.h"
#include "lang/session/units.h"
#include "lang/session/values.h"
#include "lang/slopes/slopes.h"
#include "lang/syntax/record.h"
#include "lang/unknowns/continue-parts.h"
#include "sim/branches/rest-continuation.h"

static qdot_status carry_out_continue(qdot_record *r);

QDOT_STATEMENT(continue) = {
    .word = "continue",
    .group = QDOT_NUMBERS,
    .usage = "continue equilibria|orbit in NAME = A..B [as NAME]",
    .summary = "branches of equilibria over a parameter, with their stability, and their folds, pitchforks, "
               "transcritical and Hopf points; or of periodic orbits, from the latest run that ends where it "
               "began, with period doublings and tori, over a parameter, or where the energy is conserved over "
               "`energy` or a number of the start; `plot branches` draws them, `table branches`, "
               "`save branches to`, `table bifurcations` give the numbers",
    .example = "continue equilibria in Omega = 0..10",
    .handler = carry_out_continue,
};

/* --- reading the operands --------------------------------------------------------------- */

/* Find the parameter to be varied; for periodic orbits this may also be `energy` or a start value x, x'. */
static qdot_status
find_varied_parameter(qdot_record *r, qdot_continue_wish *w)
{
    const qdot_filled *part = qdot_record_hole(r, "in", "NAME");

    w->place = part->from;
    if (!w->orbit)
        return qdot_set_find_parameter(r, part, &w->parameter);
    if (qdot_names_find(r->cursor.session->names, "energy") == NULL && qdot_filled_is_word(part, "energy"))
        return QDOT_OK;
    QDOT_TRY(qdot_set_find_symbol(r, part, &w->parameter));
    if (!qdot_session_is_speed(r->cursor.session, w->parameter))
        return QDOT_OK;
    (void)qdot_fail(QDOT_ENOTBUILT, "not built yet: periodic orbits continued in a speed");
    return qdot_hint("continue orbit in energy");
}

/* Check that the range A..B lies within the parameter's domain; it may reach the ends of that domain. */
static qdot_status
check_range(qdot_cursor *c, const qdot_continue_wish *w)
{
    qdot_symbol s = {.lo = QDOT_NIL, .hi = QDOT_NIL};
    double bound;

    if (w->parameter != QDOT_NIL)
        s = *qdot_expr_symbol(c->session->pool, w->parameter);

    c->error_at = w->range_at->start;
    if (!isfinite(w->least) || !isfinite(w->most))
        return qdot_fail(QDOT_EINVAL, "the range of a parameter has finite ends");
    if (w->least == w->most)
        return qdot_fail(QDOT_EINVAL, "the range %.9g..%.9g is empty", w->least, w->most);
    if (s.lo != QDOT_NIL && qdot_session_number(c->session, s.lo, &bound, NULL) == QDOT_OK &&
        w->least < bound)
        return qdot_fail(QDOT_EDOMAIN, "%s = %.10g is outside its domain: %s %s %.10g", s.name,
                         w->least, s.name, s.lo_open ? ">" : ">=", bound);
    if (s.hi != QDOT_NIL && qdot_session_number(c->session, s.hi, &bound, NULL) == QDOT_OK &&
        w->most > bound)
        return qdot_fail(QDOT_EDOMAIN, "%s = %.10g is outside its domain: %s %s %.10g", s.name,
                         w->most, s.name, s.hi_open ? "<" : "<=", bound);
    return QDOT_OK;
}

static qdot_status
read_parameter_range(qdot_record *r, qdot_continue_wish *w)
{
    const qdot_filled *part = qdot_record_hole(r, "in", "A..B");
    qdot_expr ends[2];
    double at[2];

    w->range_at = part->from;
    QDOT_TRY(qdot_record_range(r, part, &ends[0], &ends[1]));
    for (int k = 0; k < 2 && w->parameter != QDOT_NIL; k++)
        QDOT_TRY(qdot_set_check_dimension(r, part, w->parameter, ends[k]));
    qdot_record_blame(r, part);
    for (int k = 0; k < 2; k++)
        QDOT_TRY(qdot_session_number(r->cursor.session, ends[k], &at[k], NULL));
    w->least = fmin(at[0], at[1]);
    w->most = fmax(at[0], at[1]);
    return check_range(&r->cursor, w);
}

static qdot_status
read_table_name(qdot_record *r, qdot_continue_wish *w)
{
    const qdot_filled *part = qdot_record_hole(r, "as", "NAME");

    w->name = "branches";
    w->marks = "bifurcations";
    if (part == NULL)
        return QDOT_OK;
    QDOT_TRY(qdot_record_name(r, part, &w->name));
    w->own = qdot_malloc(strlen(w->name) + sizeof "_bifurcations");
    if (w->own == NULL)
        return QDOT_ENOMEM;
    strcpy(w->own, w->name);
    strcat(w->own, "_bifurcations");
    w->marks = w->own;
    if (qdot_names_find(r->cursor.session->names, w->name) == NULL)
        return QDOT_OK;
    qdot_record_blame(r, part - 1);
    return qdot_fail(QDOT_ENAME, "`%s` means something else already", w->name);
}

static qdot_status
read_continue_operands(qdot_record *r, qdot_continue_wish *w)
{
    w->orbit = qdot_record_word(r, "orbit") != NULL;
    QDOT_TRY(find_varied_parameter(r, w));
    QDOT_TRY(read_parameter_range(r, w));
    return read_table_name(r, w);
}

/* --- following branches of equilibria -------------------------------------------------------- */

static qdot_expr
insert_session_values(void *session, qdot_expr e)
{
    return qdot_session_bind(session, e);
}

/* Keep the branches and answer them, with the units of their quantities. */
static qdot_status
present_branches(qdot_session *session, const qdot_continue_wish *w, qdot_branches b)
{
    const size_t n = qdot_units_on(session) ? b.found->width : 0;
    char **units = qdot_calloc(n + 1, sizeof *units);
    qdot_status status = units != NULL ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        if (b.of[i] != QDOT_NIL)
            status = qdot_units_label_of(session, b.of[i], &units[i]);
    b.units = n > 0 ? units : NULL;
    if (status == QDOT_OK)
        status = qdot_branches_keep(session, &b, w->name, w->marks);
    if (status == QDOT_OK && w->parameter != QDOT_NIL)
        status = qdot_row_tables_note_parameters(session, qdot_row_tables_find(session, w->name), 1, &w->parameter);
    if (status == QDOT_OK)
        status = qdot_branches_answer(session, &b);
    for (size_t i = 0; units != NULL && i < n; i++)
        qdot_free(units[i]);
    qdot_free(units);
    return status;
}

qdot_status
qdot_continue_conclude(qdot_session *session, const qdot_continue_wish *w, const qdot_branches *b, qdot_status status)
{
    if (b->found->interrupted)
        qdot_interrupt_clear(); /* the interruption is handled here: report the branches found so far */
    if (status == QDOT_OK && b->found->branches.n > 0)
        status = present_branches(session, w, *b);
    if (status == QDOT_OK && b->found->interrupted)
        status = qdot_fail(QDOT_EINTR, b->found->branches.n > 0
                                           ? "interrupted: there may be more branches"
                                           : "interrupted: no branch was followed yet");
    return status;
}

/* Notice of equilibria at a corner of the potential: `equilibria` lists them, but no curve can be
 * followed from them. */
static qdot_status
give_notice_of_corners(qdot_session *session, qdot_equilibrium_curve *curve)
{
    qdot_expr u;

    QDOT_TRY(qdot_rest_corner(&curve->rest, &u));
    return u == QDOT_NIL ? QDOT_OK
                         : qdot_answer_notice_of(session,
                                                 "forces jump where %s = 0: equilibria there are not "
                                                 "followed; `equilibria` lists them",
                                                 u);
}

static qdot_status
follow_equilibria(qdot_session *session, const qdot_continue_wish *w)
{
    qdot_equilibrium_curve curve = {0};
    qdot_continuation found = {0};
    const char **names = NULL;
    size_t *columns = NULL;
    qdot_status status =
        qdot_equilibrium_curve_begin(&curve, session->scene, w->parameter, insert_session_values, session);

    if (status == QDOT_OK) {
        names = qdot_calloc(curve.n + 1, sizeof *names);
        columns = qdot_calloc(curve.n + 1, sizeof *columns);
        status = names && columns ? QDOT_OK : QDOT_ENOMEM;
    }
    if (status == QDOT_OK) {
        const qdot_branches b = {.found = &found,
                                 .names = names,
                                 .of = curve.unknown,
                                 .columns = columns,
                                 .n_columns = curve.coordinates,
                                 .n_told = curve.coordinates,
                                 .n_drawn = curve.coordinates};

        for (size_t i = 0; i <= curve.n; i++) {
            names[i] = qdot_expr_symbol(session->pool, curve.unknown[i])->name;
            columns[i] = i;
        }
        status = qdot_rest_continuation_find(&curve, w->least, w->most, &found);
        status = qdot_continue_conclude(session, w, &b, status);
    }
    if (status == QDOT_OK && found.corners)
        status = give_notice_of_corners(session, &curve);
    for (uint32_t i = 0; found.undefined != QDOT_NIL && i < qdot_expr_count(session->pool, found.undefined) && status == QDOT_OK; i++)
        status = qdot_answer_notice_of(session, "where %s = 0 the energy or a force has no value",
                                       qdot_expr_arg(session->pool, found.undefined, i));
    if (status == QDOT_OK && found.families)
        status = qdot_answer_notice(session, "some equilibria recur without end: of each such family one is followed");
    if (status == QDOT_OK)
        status = qdot_answer_notice(session, found.complete
                                                 ? "these are all branches, except vertical ones (at one value of %.100s alone)"
                                                 : "branches that are not connected with these may be missed",
                                    qdot_expr_symbol(session->pool, w->parameter)->name);
    qdot_free(names);
    qdot_free(columns);
    qdot_continuation_clear(&found);
    qdot_equilibrium_curve_end(&curve);
    return status;
}

/* Set the parameter, if it has a value, to its own symbol, so that values depending on it vary with it. */
static void
let_parameter_vary(qdot_session *session, qdot_expr parameter)
{
    const size_t at = qdot_expr_place(session->values->set_symbols.n, session->values->set_symbols.at, parameter);

    if (at < session->values->set_symbols.n)
        session->values->set_values.at[at] = parameter;
}

static qdot_status
carry_out_continue(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_trial trial;
    qdot_continue_wish w = {0};
    qdot_status status = read_continue_operands(r, &w);

    if (status == QDOT_OK) {
        r->cursor.error_at = w.place->start;
        if (session->scene->coordinates.n == 0) {
            (void)qdot_fail(QDOT_EINVAL, "the scene has no coordinates");
            status = qdot_hint("declare them: coord theta");
        }
    }
    if (status == QDOT_OK)
        status = qdot_value_check_assumed(session);
    if (status == QDOT_OK)
        status = qdot_trial_begin(&trial, session);
    if (status == QDOT_OK) {
        if (w.orbit) {
            status = qdot_continue_orbit(session, &w);
        } else {
            let_parameter_vary(session, w.parameter);
            status = follow_equilibria(session, &w);
        }
        qdot_trial_end(&trial);
    }
    qdot_free(w.own);
    return status;
}
