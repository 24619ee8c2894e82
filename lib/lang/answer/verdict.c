/* verdict.c -- answers to checks: the verdict, with a point at which the two sides differ. */
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/number-text.h"
#include "base/terminal.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/answer/expression.h"
#include "lang/answer/shown.h"
#include "lang/session/bind.h"
#include "lang/session/evaluation.h"
#include "lang/session/measured.h"
#include "lang/session/outcome.h"
#include "lang/session/output.h"

static const char *const verdicts[] = {
    [QDOT_PROVED] = "proved", [QDOT_REFUTED] = "refuted", [QDOT_UNDECIDED] = "undecided"};

static const char *const verdict_colours[] = {
    [QDOT_PROVED] = QDOT_GREEN, [QDOT_REFUTED] = QDOT_RED, [QDOT_UNDECIDED] = QDOT_YELLOW};

/* How a check looks on a page: whether the verdict is the one that the user wanted. */
static const struct {
    const char *mark, *class;
} looks[] = {[QDOT_PROVED] = {"\u2713", "holds"}, [QDOT_REFUTED] = {"\u2717", "fails"}, [QDOT_UNDECIDED] = {"?", "undecided"}};

/* The verdict on the whole claim: `check not ...` wants a refutation. */
static qdot_verdict
get_outcome(const qdot_session *session, qdot_verdict verdict)
{
    const char *const claim = session->evaluation->claim;
    const bool not = claim != NULL && strncmp(claim, "not ", 4) == 0;

    return !not || verdict == QDOT_UNDECIDED ? verdict : verdict == QDOT_PROVED ? QDOT_REFUTED : QDOT_PROVED;
}

/* Append ` at x = 1, y = 2: left = 3, right = 4`, a point at which the two sides differ. */
static qdot_status
append_counterexample(qdot_sheet *s, const qdot_decision *decision)
{
    const qdot_pool *pool = s->session->pool;
    const uint32_t n = decision->at == QDOT_NIL ? 0 : qdot_expr_count(pool, decision->at);
    double apart;
    int digits;

    for (uint32_t i = 0; i < n; i++) {
        qdot_sheet_words(s, i == 0 ? " at " : ", ");
        QDOT_TRY(qdot_sheet_formula(s, qdot_expr_arg(pool, decision->at, i)));
    }
    if (!isfinite(decision->left) || !isfinite(decision->right))
        return QDOT_OK;
    apart = fabs(decision->left - decision->right);
    digits = apart == 0 || apart > 1e-11 * fabs(decision->left) ? 12 : 17;
    qdot_sheet_words(s, ": left = ");
    qdot_sheet_double(s, decision->left, digits);
    qdot_sheet_words(s, ", right = ");
    qdot_sheet_double(s, decision->right, digits);
    return QDOT_OK;
}

/* Append the verdict and what there is to say of it, for a page with a mark before it. */
static qdot_status
append_verdict(qdot_sheet *s, const void *answer)
{
    const qdot_decision *decision = answer;
    const bool colours = qdot_write_colours(s->session);

    if (s->form == QDOT_SHEET_PAGE && qdot_write_displays(s->session))
        qdot_sheet_format(s, "%s ", looks[get_outcome(s->session, decision->verdict)].mark);
    qdot_sheet_format(s, "%s%s%s", colours ? verdict_colours[decision->verdict] : "", verdicts[decision->verdict],
                      colours ? QDOT_COLOUR_END : "");
    if (decision->verdict == QDOT_REFUTED)
        return append_counterexample(s, decision);
    if (decision->verdict == QDOT_UNDECIDED && decision->points > 0 && decision->digits > 0)
        qdot_sheet_format(s, ": equal at %d random points to %d digits, but not proved", decision->points,
                          decision->digits);
    else if (decision->verdict == QDOT_UNDECIDED && decision->points > 0)
        qdot_sheet_format(s, ": true at %d random points, but not proved", decision->points);
    else if (decision->verdict == QDOT_UNDECIDED)
        qdot_sheet_words(s, ": neither proved nor refuted");
    return QDOT_OK;
}

static qdot_status
answer_check_as_text(qdot_session *session, const qdot_decision *decision)
{
    qdot_sheet s = qdot_sheet_begin_words(session);
    const qdot_status status = append_verdict(&s, decision);

    return qdot_sheet_end(&s, "check", status);
}

/* Append what a person reads of the check: the verdict and its claim. */
static qdot_status
append_shown_check(qdot_session *session, const qdot_decision *decision, qdot_text *line)
{
    const char *const claim = session->evaluation->claim;
    qdot_text class = {0}, code = {0};
    qdot_status status;

    qdot_text_format(&class, "check %s", looks[get_outcome(session, decision->verdict)].class);
    qdot_text_add(&code, claim != NULL ? " <code>" : "");
    qdot_text_html(&code, claim != NULL ? claim : "", claim != NULL ? strlen(claim) : 0, false);
    qdot_text_add(&code, claim != NULL ? "</code>" : "");
    status = qdot_shown_words(session, append_verdict, decision, qdot_text_str(&class), qdot_text_str(&code), line);
    line->failed = line->failed || class.failed || code.failed;
    qdot_text_clear(&class);
    qdot_text_clear(&code);
    return status;
}

/* Append {"x":1.5,...} for a LIST of equations symbol = number. */
static qdot_status
append_point_as_json(qdot_session *session, qdot_expr at, qdot_text *line)
{
    qdot_pool *pool = session->pool;
    uint32_t n = at == QDOT_NIL ? 0 : qdot_expr_count(pool, at);

    qdot_text_char(line, '{');
    for (uint32_t i = 0; i < n; i++) {
        qdot_expr equation = qdot_expr_arg(pool, at, i);
        qdot_text name = {0};
        double value = NAN;
        qdot_status status =
            qdot_print(pool, qdot_expr_arg(pool, equation, 0), QDOT_PLAIN, &name);

        if (status == QDOT_OK)
            status = qdot_session_number(session, qdot_expr_arg(pool, equation, 1),
                                         &value, NULL);
        qdot_text_add(line, i > 0 ? "," : "");
        qdot_text_json(line, qdot_text_str(&name));
        qdot_text_char(line, ':');
        qdot_number_text_json(line, value);
        qdot_text_clear(&name);
        QDOT_TRY(status);
    }
    qdot_text_char(line, '}');
    return QDOT_OK;
}

/* Print one side of a check: results of runs as numbers; of a very large expression only its size. */
static qdot_status
print_side(qdot_session *session, qdot_expr side, qdot_text *out)
{
    uint64_t size = qdot_expr_size(session->pool, side);
    double number;

    if (qdot_expr_is_scalar(session->pool, side) && qdot_measured_occurs(session, side)) {
        QDOT_TRY(qdot_session_number(session, side, &number, NULL));
        qdot_text_double(out, number, 17);
        return QDOT_OK;
    }
    if (size <= QDOT_EXPRESSION_OPERATIONS)
        return qdot_print(session->pool, side, QDOT_PLAIN, out);
    qdot_text_format(out, "(%" PRIu64 " operations)", size);
    return QDOT_OK;
}

static qdot_status
answer_check_as_json(qdot_session *session, qdot_expr left, qdot_expr right,
                     const qdot_decision *decision)
{
    qdot_text line = {0}, part = {0};
    qdot_status status;

    qdot_text_format(&line, "{\"kind\":\"check\",\"verdict\":\"%s\"", verdicts[decision->verdict]);
    if (session->evaluation->claim != NULL)
        qdot_write_field(&line, ",\"claim\":", session->evaluation->claim);
    qdot_text_add(&line, ",\"left\":");
    status = print_side(session, left, &part);
    qdot_text_json(&line, qdot_text_str(&part));
    qdot_text_truncate(&part, 0);
    if (status == QDOT_OK)
        status = print_side(session, right, &part);
    qdot_write_field(&line, ",\"right\":", qdot_text_str(&part));
    if (decision->verdict == QDOT_REFUTED) {
        qdot_text_add(&line, ",\"at\":");
        if (status == QDOT_OK)
            status = append_point_as_json(session, decision->at, &line);
        qdot_text_add(&line, ",\"values\":[");
        qdot_number_text_json(&line, decision->left);
        qdot_text_char(&line, ',');
        qdot_number_text_json(&line, decision->right);
        qdot_text_char(&line, ']');
    } else if (decision->verdict == QDOT_UNDECIDED) {
        qdot_text_format(&line, ",\"digits\":%d", decision->digits);
    }
    if (status == QDOT_OK)
        status = append_shown_check(session, decision, &line);
    qdot_text_add(&line, "}\n");
    line.failed = line.failed || part.failed;
    qdot_text_clear(&part);
    return qdot_write_answer(session, status, &line);
}

qdot_status
qdot_answer_check(qdot_session *session, qdot_expr left, qdot_expr right,
                  const qdot_decision *decision)
{
    session->outcome->verdicts[decision->verdict]++;
    return session->output->json ? answer_check_as_json(session, left, right, decision)
                         : answer_check_as_text(session, decision);
}
