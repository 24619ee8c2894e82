/* floquet.c -- the statement `floquet`: the Floquet multipliers of a periodic orbit, which tell its stability. */
#include "sim/study/floquet.h"

#include <math.h>
#include <stdio.h>

#include "base/number-text.h"
#include "lang/answer/answer.h"
#include "lang/session/output.h"
#include "lang/slopes/orbit-run.h"
#include "lang/session/measured.h"
#include "lang/session/runs.h"
#include "lang/syntax/record.h"

static qdot_status carry_out_floquet(qdot_record *r);

QDOT_STATEMENT(floquet) = {
    .word = "floquet",
    .group = QDOT_NUMBERS,
    .usage = "floquet [RUN]",
    .summary = "the multipliers of a periodic orbit, the latest run that ends where it began, each with its error, and "
               "whether it is stable",
    .example = "floquet",
    .handler = carry_out_floquet,
};

/* Answer re + im*i with a common error; in JSON as [re, im]. */
static qdot_status
answer_complex(qdot_session *session, const char *name, double re, double im,
               double error)
{
    qdot_numerals x = {0};

    qdot_text_char(&x.values, '[');
    qdot_number_text_json(&x.values, re);
    qdot_text_char(&x.values, ',');
    qdot_number_text_json(&x.values, im);
    qdot_text_char(&x.values, ']');
    qdot_number_text_json(&x.errors, error);
    qdot_number_text(&x.text, re, error);
    qdot_text_add(&x.text, im < 0 ? " - " : " + ");
    qdot_number_text(&x.text, fabs(im), error);
    qdot_text_add(&x.text, "*i");
    qdot_number_text_error(&x.text, error);
    return qdot_answer_numerals(session, name, false, QDOT_OK, &x);
}

static qdot_status
answer_multipliers(qdot_session *session, const char *run, const qdot_floquet *x)
{
    static const char *const verdicts[] = {[QDOT_FLOQUET_STABLE] = "stable",
                                           [QDOT_FLOQUET_UNSTABLE] = "unstable",
                                           [QDOT_FLOQUET_UNDECIDED] = "undecided"};
    qdot_text text = {0};

    for (size_t k = 0; k < x->n; k++) {
        char name[40];

        snprintf(name, sizeof name, "floquet[%zu]", k + 1);
        if (x->im[k] == 0)
            QDOT_TRY(qdot_answer_number(session, name, x->re[k], x->error[k]));
        else
            QDOT_TRY(answer_complex(session, name, x->re[k], x->im[k], x->error[k]));
    }
    qdot_text_format(&text, "%s: %s", run, verdicts[x->verdict]);
    if (x->verdict == QDOT_FLOQUET_STABLE)
        qdot_text_add(&text, x->asymptotic
                                 ? ", neighbouring motions approach it"
                                 : " in linear order, multipliers on the unit circle");
    if (x->verdict == QDOT_FLOQUET_UNSTABLE)
        qdot_text_add(&text, ", a multiplier beyond the unit circle");
    if (x->verdict == QDOT_FLOQUET_UNDECIDED)
        qdot_text_add(&text,
                      ", multipliers too near to the unit circle or to each other");
    qdot_text_char(&text, '\n');
    return qdot_answer_written(session, "floquet", QDOT_OK, &text);
}

static qdot_status
carry_out_floquet(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    const qdot_filled *run = qdot_record_hole(r, NULL, "RUN");
    qdot_named_run *orbit = NULL;
    qdot_run_request request;
    qdot_floquet x = {0};
    qdot_status status;
    const char *name;

    if (run != NULL)
        QDOT_TRY(qdot_record_name(r, run, &name));
    r->cursor.error_at = r->start->start;
    QDOT_TRY(run != NULL ? qdot_orbit_run_named(session, name, &orbit)
                         : qdot_orbit_run_find(session, &orbit));
    request = qdot_conditions_request(orbit->conditions);
    request.tol = qdot_run_get_report(orbit->run)->tol;
    request.method = qdot_run_get_report(orbit->run)->method;
    request.treatment = qdot_run_get_report(orbit->run)->treatment;
    status = qdot_floquet_find(session->scene, orbit->run, &request, &x);
    if (status == QDOT_OK)
        status = answer_multipliers(session, orbit->name, &x);
    qdot_floquet_clear(&x);
    return status;
}
