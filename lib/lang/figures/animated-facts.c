/* animated-facts.c -- the lines below an animation: which run it shows, and its accuracy. */
#include <inttypes.h>
#include <math.h>

#include "base/number-text.h"
#include "expr/build.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/figures/animated.h"
#include "lang/session/units.h"

enum { MOST_VALUES = 24 };

static qdot_status
add_fact(qdot_animation *a, const char *name, qdot_text *text)
{
    qdot_animation_fact fact = {name, text->at};
    qdot_status status = qdot_text_status(text);

    if (status == QDOT_OK && text->n > 0)
        status = qdot_vec_push(&a->facts, fact);
    if (status != QDOT_OK || text->n == 0)
        qdot_text_clear(text);
    *text = (qdot_text){0};
    return status;
}

/* Append the values of all parameters that the drawn things and the equations contain: m = 1, g = 9.81. */
static qdot_status
add_parameter_values(qdot_session *session, const qdot_named_run *run, qdot_animation *a)
{
    qdot_pool *pool = session->pool;
    const qdot_run_report *r = qdot_run_get_report(run->run);
    qdot_expr held[] = {qdot_mech_numeric_mass(session->scene),
                        qdot_mech_numeric_forcing(session->scene)};
    qdot_expr atoms = qdot_expr_atoms(pool, qdot_list(pool, 2, held), false);
    qdot_text text = {0};
    size_t shown = 0;

    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < qdot_expr_count(pool, atoms); i++) {
        qdot_expr x = qdot_expr_arg(pool, atoms, i);
        qdot_text unit = {0};
        qdot_status status;
        double value;

        if (!qdot_expr_is_class(pool, x, QDOT_PARAM))
            continue;
        if (shown++ >= MOST_VALUES)
            continue;
        status = qdot_run_values(run->run, 1, &x, 1, &r->t0, &value, NULL);
        qdot_text_add(&text, text.n > 0 ? ", " : "");
        if (status == QDOT_OK)
            status = qdot_print(pool, x, QDOT_UNICODE, &text);
        if (status != QDOT_OK) {
            qdot_text_clear(&text);
            return status;
        }
        qdot_text_add(&text, " = ");
        qdot_number_text(&text, value, 0);
        qdot_units_label(session, x, &unit);
        if (unit.n > 0)
            qdot_text_format(&text, " %s", qdot_text_str(&unit));
        text.failed = text.failed || unit.failed;
        qdot_text_clear(&unit);
    }
    if (shown > MOST_VALUES)
        qdot_text_format(&text, " and %zu more", shown - MOST_VALUES);
    return add_fact(a, "with", &text);
}

static void
add_drifts(qdot_session *session, const qdot_run_report *r, qdot_text *text)
{
    for (size_t i = 0; i < r->n_drifts; i++) {
        const qdot_drift *d = &r->drifts[i];

        qdot_text_add(text, i > 0 ? ", " : "");
        qdot_print_name(session->pool, d->name, QDOT_UNICODE, text);
        qdot_text_char(text, ' ');
        if (d->kept)
            qdot_text_add(text, "kept");
        else if (isfinite(d->drift))
            qdot_number_text_bound(text, d->drift);
        else
            qdot_text_add(text, "unknown");
    }
}

qdot_status
qdot_animated_facts(qdot_session *session, const qdot_named_run *run, qdot_animation *a)
{
    const qdot_run_report *r = qdot_run_get_report(run->run);
    qdot_text text = {0};

    qdot_text_format(&text, "run %s as %s", run->text, run->name);
    QDOT_TRY(add_fact(a, "run", &text));
    QDOT_TRY(add_parameter_values(session, run, a));
    qdot_text_format(&text, "%s, tol ", r->method);
    qdot_number_text(&text, r->tol, 0);
    qdot_text_format(&text, ", %" PRIu64 " step%s", r->steps, r->steps == 1 ? "" : "s");
    QDOT_TRY(add_fact(a, "method", &text));
    if (r->status != QDOT_RUN_DONE) {
        qdot_text_format(
            &text, "%s%s%s", r->status == QDOT_RUN_FAILED ? "failed" : "stopped",
            r->reason != NULL ? ": " : "", r->reason != NULL ? r->reason : "");
        QDOT_TRY(add_fact(a, "ended", &text));
    }
    if (isfinite(r->error)) {
        qdot_text_add(&text, "at most ");
        qdot_number_text_bound(&text, r->error);
        qdot_text_add(&text, " of max(1, |value|)");
    } else {
        qdot_text_format(&text, "unknown%s%s", r->doubt != NULL ? ": " : "",
                         r->doubt != NULL ? r->doubt : "");
    }
    QDOT_TRY(add_fact(a, "error of the end state", &text));
    if (isfinite(r->horizon)) {
        qdot_text_add(&text, "t = ");
        qdot_number_text(&text, r->horizon, 0.005 * fabs(r->horizon));
        qdot_text_add(&text, "; beyond it no digit of the state is right");
        QDOT_TRY(add_fact(a, "horizon", &text));
    }
    add_drifts(session, r, &text);
    QDOT_TRY(add_fact(a, "drift", &text));
    if (r->m > 0 && isfinite(r->constraint_drift)) {
        qdot_text_add(&text, "error ");
        qdot_number_text_bound(&text, r->constraint_drift);
        QDOT_TRY(add_fact(a, "constraints", &text));
    }
    qdot_text_format(&text, "qdot %s", PACKAGE_VERSION);
    return add_fact(a, "drawn by", &text);
}
