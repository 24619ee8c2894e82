/* ask.c -- calls that carry out statements and ask for formulas, claims and numbers. */
#include <stdlib.h>
#include <string.h>

#include "api/system.h"
#include "base/memory.h"
#include "base/number-text.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "lang/answer/expression.h"
#include "lang/answer/shown-text.h"
#include "lang/ask/ask.h"
#include "lang/language/read.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/outcome.h"
#include "lang/session/output.h"
#include "lang/workbench/script.h"
#include "normal/prove/decide.h"

_Static_assert((int)QDOT_NOTATION_PLAIN == (int)QDOT_PLAIN, "notation");
_Static_assert((int)QDOT_NOTATION_UNICODE == (int)QDOT_UNICODE, "notation");
_Static_assert((int)QDOT_NOTATION_LATEX == (int)QDOT_LATEX, "notation");
_Static_assert((int)QDOT_NOTATION_MATHML == (int)QDOT_MATHML, "notation");
_Static_assert((int)QDOT_TRUTH_PROVED == (int)QDOT_PROVED, "verdict");
_Static_assert((int)QDOT_TRUTH_REFUTED == (int)QDOT_REFUTED, "verdict");
_Static_assert((int)QDOT_TRUTH_UNDECIDED == (int)QDOT_UNDECIDED, "verdict");

/* --- carrying out statements ---------------------------------------------------------- */

qdot_result
qdot_system_declare(qdot_system *system, const char *text)
{
    qdot_status status;

    if (system == NULL)
        return QDOT_RESULT_INVALID;
    if (text == NULL)
        return qdot_api_refuse(system, "declare: the text is NULL");
    status = qdot_api_begin(system);
    if (status == QDOT_OK)
        status = qdot_script_carry_out(system->session, "declare", 0, text, strlen(text));
    return qdot_api_end(system, status);
}

/* Return the text of the answers, which the caller then owns. */
static char *
take_answer_text(qdot_system *system)
{
    char *text = system->stream[QDOT_API_ANSWERS].text;

    system->stream[QDOT_API_ANSWERS].text = NULL;
    return text;
}

qdot_result
qdot_system_ask(qdot_system *system, const char *text, qdot_notation notation, char **answers)
{
    qdot_session *session;
    qdot_status status;
    qdot_style before;
    qdot_result result;

    if (answers != NULL)
        *answers = NULL;
    if (system == NULL)
        return QDOT_RESULT_INVALID;
    if (text == NULL || answers == NULL)
        return qdot_api_refuse(system, "ask: the %s is NULL", text == NULL ? "text" : "answer");
    if ((unsigned)notation > QDOT_NOTATION_DISPLAY)
        return qdot_api_refuse(system, "ask: there is no notation %d", (int)notation);
    session = system->session;
    before = session->output->style;
    status = qdot_api_begin(system);
    session->output->display = notation == QDOT_NOTATION_DISPLAY;
    session->output->json = notation == QDOT_NOTATION_JSON || session->output->display;
    session->output->style = session->output->display ? QDOT_UNICODE
                             : session->output->json  ? QDOT_PLAIN
                                                      : (qdot_style)notation;
    if (session->output->display) { /* notices stand among the answers */
        session->output->console = session->output->out;
        session->output->console_json = true;
    }
    if (status == QDOT_OK)
        status = qdot_script_carry_out(session, system->source != NULL ? system->source : "ask", 0, text, strlen(text));
    session->output->json = session->output->display = session->output->console_json = false;
    session->output->style = before;
    result = qdot_api_end(system, status);
    *answers = take_answer_text(system);
    return result;
}

const char *
qdot_display_style(void)
{
    return qdot_shown_style;
}

qdot_result
qdot_number_write(double value, double error, char **text)
{
    qdot_text number = {0};

    if (text == NULL)
        return QDOT_RESULT_INVALID;
    *text = NULL;
    qdot_number_text_with_error(&number, value, error);
    if (number.failed) {
        qdot_text_clear(&number);
        return QDOT_RESULT_NO_MEMORY;
    }
    *text = number.at;
    return QDOT_RESULT_OK;
}

/* --- deriving formulas ---------------------------------------------------------------- */

typedef struct {
    bool tree; /* as an array of JSON, not in a style */
    qdot_style style;
    qdot_text text;
} formula;

static qdot_status
print_value(qdot_session *session, qdot_expr value, formula *f)
{
    const bool several = qdot_expr_kind(session->pool, value) == QDOT_LIST;
    const uint32_t n = several ? qdot_expr_count(session->pool, value) : 1;

    if (f->tree) {
        QDOT_TRY(qdot_expression_tree(session, value, &f->text));
        return qdot_text_status(&f->text);
    }
    for (uint32_t i = 0; i < n; i++) {
        qdot_text_add(&f->text, i > 0 ? "\n" : "");
        QDOT_TRY(qdot_expression_print(session,
                                    several ? qdot_expr_arg(session->pool, value, i) : value,
                                    f->style, &f->text));
    }
    qdot_text_add(&f->text, ""); /* an empty list gives the empty text, not NULL */
    return qdot_text_status(&f->text);
}

static qdot_status
read_formula(qdot_cursor *c, void *data)
{
    const size_t start = c->at->start;
    qdot_expr value;

    QDOT_TRY(qdot_read_value(c, &value));
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = start;
    if (!qdot_measured_occurs(c->session, value))
        return print_value(c->session, value, data);
    (void)qdot_fail(QDOT_ETYPE, "numbers of a run are no formula");
    return qdot_hint("qdot_system_number, or qdot_motion_values for many");
}

qdot_result
qdot_system_derive(qdot_system *system, const char *expression, qdot_notation notation,
                   char **text)
{
    formula f = {.tree = notation == QDOT_NOTATION_TREE, .style = (qdot_style)notation};
    qdot_status status;

    if (text != NULL)
        *text = NULL;
    if (system == NULL)
        return QDOT_RESULT_INVALID;
    if (expression == NULL || text == NULL)
        return qdot_api_refuse(system, "derive: the %s is NULL",
                               expression == NULL ? "expression" : "formula");
    if ((unsigned)notation > QDOT_NOTATION_MATHML && !f.tree)
        return qdot_api_refuse(system, "derive: there is no notation %d", (int)notation);
    status = qdot_api_begin(system);
    if (status == QDOT_OK)
        status = qdot_api_read(system, "derive", expression, read_formula, &f);
    return qdot_api_end_with_text(system, status, &f.text, text);
}

/* --- claims and numbers --------------------------------------------------------------- */

static qdot_status
read_claim(qdot_cursor *c, void *data)
{
    qdot_truth *truth = data;
    const size_t *verdicts = c->session->outcome->verdicts;

    QDOT_TRY(qdot_check(c));
    *truth = verdicts[QDOT_REFUTED] > 0     ? QDOT_TRUTH_REFUTED
             : verdicts[QDOT_UNDECIDED] > 0 ? QDOT_TRUTH_UNDECIDED
                                            : QDOT_TRUTH_PROVED;
    return QDOT_OK;
}

qdot_result
qdot_system_decide(qdot_system *system, const char *claim, qdot_truth *truth)
{
    qdot_status status;

    if (system == NULL)
        return QDOT_RESULT_INVALID;
    if (claim == NULL || truth == NULL)
        return qdot_api_refuse(system, "decide: the %s is NULL", claim == NULL ? "claim" : "truth");
    status = qdot_api_begin(system);
    if (status == QDOT_OK)
        status = qdot_api_read(system, "decide", claim, read_claim, truth);
    return qdot_api_end(system, status);
}

typedef struct {
    double value, error;
} number;

static qdot_status
read_number(qdot_cursor *c, void *data)
{
    const size_t start = c->at->start;
    number *x = data;
    qdot_expr value;

    QDOT_TRY(qdot_read_scalar(c, &value));
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = start;
    return qdot_session_number(c->session, value, &x->value, &x->error);
}

qdot_result
qdot_system_number(qdot_system *system, const char *expression, double *value, double *error)
{
    number x = {0};
    qdot_status status;

    if (system == NULL)
        return QDOT_RESULT_INVALID;
    if (expression == NULL || value == NULL)
        return qdot_api_refuse(system, "number: the %s is NULL",
                               expression == NULL ? "expression" : "value");
    status = qdot_api_begin(system);
    if (status == QDOT_OK)
        status = qdot_api_read(system, "number", expression, read_number, &x);
    *value = x.value;
    if (error != NULL)
        *error = x.error;
    return qdot_api_end(system, status);
}
