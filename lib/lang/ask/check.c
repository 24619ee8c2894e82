/* check.c -- the statement `check`: proves, refutes or leaves undecided a claim, component by component. */
#include <math.h>
#include <string.h>

#include "expr/build.h"
#include "expr/elementary.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/unit.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/answer/digits.h"
#include "lang/answer/sheet.h"
#include "lang/ask/ask.h"
#include "lang/ask/check-parts.h"
#include "lang/declare/constraints.h"
#include "lang/functions/equilibria.h"
#include "lang/language/token-text.h"
#include "lang/session/bind.h"
#include "lang/session/held.h"
#include "lang/session/measured.h"
#include "lang/session/momenta.h"
#include "lang/session/outcome.h"
#include "lang/session/output.h"
#include "lang/session/speeds.h"
#include "lang/session/units.h"
#include "lang/syntax/match.h"
#include "normal/inequality/contradiction.h"
#include "normal/inequality/less.h"
#include "normal/solve/proportion.h"

static qdot_status check_claim(qdot_record *r);

QDOT_STATEMENT(check) = {
    .word = "check",
    .group = QDOT_ASKING,
    .usage = "check [not] A == B [when C, D, ...] [within E] | check [not] A ~ B [when C, D, ...] | check [not] conserved E [when C, D, ...] | "
             "check [not] integrable LABEL",
    .summary = "decide an identity, an inequality, whether equations agree up to a factor (~), a conservation, or whether a velocity constraint "
               "is holonomic in disguise: proved, refuted or undecided",
    .example = "check sin(x)^2 + cos(x)^2 == 1",
    .handler = check_claim,
};

/* --- deciding a claim --------------------------------------------------------------- */

static qdot_status
decide_scalars(qdot_session *session, qdot_expr left, qdot_expr right, qdot_check_comparison how, const qdot_facts *known, qdot_decision *decision)
{
    qdot_pool *pool = session->pool;
    qdot_expr a, b;

    if (how != QDOT_CHECK_EQUAL)
        return qdot_decide_less(pool, left, right, how == QDOT_CHECK_LESS, known, decision);
    QDOT_TRY(qdot_decide_equal(pool, left, right, known, decision));
    if (decision->verdict != QDOT_UNDECIDED)
        return QDOT_OK;
    /* try again with |u|, sign(u) and if(...) replaced where the assumptions decide them */
    a = qdot_known_signs(pool, left, known);
    b = qdot_known_signs(pool, right, known);
    QDOT_TRY(qdot_pool_check(pool));
    return a == left && b == right ? QDOT_OK : qdot_decide_equal(pool, a, b, known, decision);
}

/* Whether e is a quoted text or a verdict of stability(...): such a value is equal only to itself. */
static bool
is_text_value(qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_is_class(pool, e, QDOT_WORDS) || qdot_equilibria_is_word(pool, e);
}

/* left - right of an equation; a scalar e stands for e = 0. */
static qdot_expr
residual_of(qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_is_scalar(pool, e) ? e : qdot_sub(pool, qdot_expr_arg(pool, e, 0), qdot_expr_arg(pool, e, 1));
}

/* Decide whether two equations are equivalent: the residual of one is that of the other times a factor without zeros, which
 * may hold velocities where `how` is QDOT_CHECK_PROPORTIONAL. */
static qdot_status
decide_equations(qdot_session *session, qdot_expr left, qdot_expr right, qdot_check_comparison how, const qdot_facts *known, qdot_decision *decision)
{
    qdot_pool *pool = session->pool;
    qdot_expr a = residual_of(pool, left), b = residual_of(pool, right);
    qdot_expr factor = QDOT_NIL;
    bool may_vanish = false;
    qdot_text text = {0};
    qdot_status status;
    qdot_sheet sheet;

    QDOT_TRY(qdot_pool_check(pool));
    if (a != b && qdot_expr_is_constant(pool, a) && qdot_expr_is_constant(pool, b))
        return qdot_fail(QDOT_ETYPE, "`~` compares equations up to a factor: numbers are compared by `==`, or `within` a tolerance");
    if ((qdot_expr_kind(pool, left) == QDOT_REL && qdot_expr_node(pool, left)->op != QDOT_EQ) ||
        (qdot_expr_kind(pool, right) == QDOT_REL && qdot_expr_node(pool, right)->op != QDOT_EQ))
        return qdot_fail(QDOT_ETYPE, "inequalities are not compared with one another");
    QDOT_TRY(qdot_decide_proportional(pool, a, b, how == QDOT_CHECK_PROPORTIONAL ? QDOT_FACTOR_OF_STATE : QDOT_FACTOR_OF_PLACE, known, decision,
                                      &factor, &may_vanish));
    if (decision->verdict != QDOT_PROVED || !may_vanish || factor == QDOT_NIL)
        return QDOT_OK;
    sheet = qdot_sheet_begin_text(session, session->output->style);
    status = qdot_sheet_text(&sheet, qdot_sheet_formula(&sheet, factor), &text);
    if (status == QDOT_OK)
        status = qdot_answer_notice(session, "the equations differ by the factor %s: where it is 0 or undefined they need not agree",
                                    qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

static bool
is_equation_or_scalar(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_is_scalar(pool, e) || qdot_expr_kind(pool, e) == QDOT_REL;
}

static const char *
kind_in_words(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_is_scalar(pool, e) ? "a scalar" : qdot_value_kind_words(pool, e);
}

static qdot_status
report_unequal_shapes(const qdot_pool *pool, qdot_expr left, qdot_expr right)
{
    uint32_t m = qdot_expr_count(pool, left), n = qdot_expr_count(pool, right);

    if (qdot_expr_kind(pool, left) == qdot_expr_kind(pool, right) && m != n)
        return qdot_fail(QDOT_ETYPE, "the sides have %u and %u components", m, n);
    if (qdot_expr_kind(pool, left) == qdot_expr_kind(pool, right))
        return qdot_fail(QDOT_ETYPE, "the sides are matrices of different shapes");
    return qdot_fail(QDOT_ETYPE, "%s is not compared with %s", kind_in_words(pool, left),
                     kind_in_words(pool, right));
}

/* The worst verdict is the first refutation, else the last undecided, else proved. Members of lists may be vectors: an explicit
 * stack. */
qdot_status
qdot_check_by_components(qdot_session *session, qdot_expr left, qdot_expr right, qdot_check_comparison how,
                     const qdot_facts *known, qdot_decision *decision)
{
    qdot_pool *pool = session->pool;
    qdot_vec(qdot_expr) todo = {0};
    qdot_status status = qdot_vec_push(&todo, left);

    if (status == QDOT_OK)
        status = qdot_vec_push(&todo, right);
    *decision = (qdot_decision){.verdict = QDOT_PROVED, .left = NAN, .right = NAN};
    while (status == QDOT_OK && todo.n > 0) {
        qdot_expr b = todo.at[--todo.n], a = todo.at[--todo.n];
        qdot_kind kind = qdot_expr_kind(pool, a);
        qdot_decision one = {.left = NAN, .right = NAN};

        if (how == QDOT_CHECK_EQUAL && is_text_value(pool, a) && is_text_value(pool, b)) {
            one.verdict = a == b ? QDOT_PROVED : QDOT_REFUTED;
        } else if (how == QDOT_CHECK_PROPORTIONAL && is_equation_or_scalar(pool, a) && is_equation_or_scalar(pool, b)) {
            status = decide_equations(session, a, b, how, known, &one);
        } else if (qdot_expr_is_scalar(pool, a) && qdot_expr_is_scalar(pool, b)) {
            status = decide_scalars(session, a, b, how, known, &one);
        } else if (kind != qdot_expr_kind(pool, b) || kind == QDOT_LOGIC ||
                   qdot_expr_count(pool, a) != qdot_expr_count(pool, b) ||
                   (kind == QDOT_MAT &&
                    qdot_expr_node(pool, a)->op != qdot_expr_node(pool, b)->op)) {
            status = report_unequal_shapes(pool, a, b);
        } else if (how != QDOT_CHECK_EQUAL && how != QDOT_CHECK_PROPORTIONAL) {
            status = qdot_fail(QDOT_ETYPE, "`<` compares numbers, not %s", kind_in_words(pool, a));
        } else if (kind == QDOT_REL) {
            status = decide_equations(session, a, b, how, known, &one);
        } else {
            for (uint32_t i = 2 * qdot_expr_count(pool, a); i-- > 0 && status == QDOT_OK;)
                status = qdot_vec_push(&todo, qdot_expr_arg(pool, i % 2 != 0 ? a : b, i / 2));
            continue;
        }
        if (status == QDOT_OK && one.verdict != QDOT_PROVED)
            *decision = one;
        if (one.verdict == QDOT_REFUTED)
            break;
    }
    qdot_free(todo.at);
    return status;
}

/* Compare numbers of runs: |a - b| <= tol max(1, |b|) for equality, or a < b. */
static qdot_status
compare_numbers(qdot_session *session, qdot_expr left, qdot_expr right, qdot_check_comparison how,
                double tol, qdot_decision *decision)
{
    double difference, errors[2];
    bool holds;

    QDOT_TRY(qdot_session_number(session, left, &decision->left, &errors[0]));
    QDOT_TRY(qdot_session_number(session, right, &decision->right, &errors[1]));
    difference = decision->left - decision->right;
    if (qdot_digits_of(session, left) > 0 || qdot_digits_of(session, right) > 0)
        QDOT_TRY(qdot_digits_difference(session, left, right, &difference));
    if (how == QDOT_CHECK_EQUAL)
        holds = fabs(difference) <= tol * fmax(1, fabs(decision->right));
    else
        holds = how == QDOT_CHECK_LESS ? difference < 0 : difference <= 0;
    decision->verdict = holds ? QDOT_PROVED : QDOT_REFUTED;
    if (holds || !(isnan(errors[0]) || isnan(errors[1])))
        return QDOT_OK;
    return qdot_answer_notice(session, "refuted by numbers whose error is unknown");
}

/* Compare two values component by component within a tolerance; the first refuted component decides. */
static qdot_status
decide_within(qdot_session *session, qdot_expr left, qdot_expr right, qdot_check_comparison how, double tol, qdot_decision *decision)
{
    qdot_pool *pool = session->pool;
    uint32_t n = qdot_expr_count(pool, left);

    *decision = (qdot_decision){.verdict = QDOT_PROVED};
    if (qdot_expr_is_scalar(pool, left) || qdot_expr_is_scalar(pool, right))
        return compare_numbers(session, left, right, how, tol, decision);
    if (n != qdot_expr_count(pool, right) || qdot_expr_kind(pool, left) == QDOT_REL)
        return report_unequal_shapes(pool, left, right);
    for (uint32_t i = 0; i < n && decision->verdict == QDOT_PROVED; i++)
        QDOT_TRY(compare_numbers(session, qdot_expr_arg(pool, left, i),
                                 qdot_expr_arg(pool, right, i), how, tol, decision));
    return QDOT_OK;
}

/* --- the statement `check` ---------------------------------------------------------- */

/* Split a relation such as `check (a = b)`, or a name that stands for one, into its two sides. */
static qdot_status
split_relation(qdot_record *r, const qdot_filled *part, qdot_check_question *q)
{
    qdot_pool *pool = r->cursor.session->pool;
    qdot_expr e = q->left;
    static const qdot_check_comparison how[] = {[QDOT_EQ] = QDOT_CHECK_EQUAL, [QDOT_LT] = QDOT_CHECK_LESS, [QDOT_LE] = QDOT_CHECK_LESS_EQUAL};

    if (e == QDOT_TRUE || e == QDOT_FALSE) { /* a relation between numbers, decided when it was read */
        q->left = e == QDOT_TRUE ? QDOT_ZERO : QDOT_ONE;
        q->right = QDOT_ZERO;
        return QDOT_OK;
    }
    if (qdot_expr_kind(pool, e) != QDOT_REL)
        return qdot_record_expected(r, part->to, "`==` and the other side");
    q->how = how[qdot_expr_node(pool, e)->op];
    q->left = qdot_expr_arg(pool, e, 0);
    q->right = qdot_expr_arg(pool, e, 1);
    return QDOT_OK;
}

static qdot_status
read_comparison(qdot_record *r, const qdot_filled *part, qdot_check_question *q)
{
    const char *relation = r->compiled.at[part->first].to->text;

    QDOT_TRY(qdot_record_side(r, part, 0, &q->left));
    if (part->n == 1)
        return split_relation(r, part, q);
    q->turned = relation[0] == '>';
    q->how = relation[0] == '=' ? QDOT_CHECK_EQUAL : relation[0] == '~' ? QDOT_CHECK_PROPORTIONAL : relation[1] == '=' ? QDOT_CHECK_LESS_EQUAL : QDOT_CHECK_LESS;
    QDOT_TRY(qdot_record_side(r, part, 1, &q->right));
    r->cursor.error_at = r->compiled.at[part->first].to->start;
    return qdot_units_join(r->cursor.session, q->left, q->right, "%s is compared with %s");
}

static qdot_status
read_question(qdot_record *r, qdot_check_question *q, qdot_assumed *f)
{
    const qdot_filled *sides = qdot_record_hole(r, NULL, "A"), *within = qdot_record_hole(r, "within", NULL);
    qdot_session *session = r->cursor.session;
    qdot_status status;

    q->not = qdot_record_word(r, "not") != NULL;
    q->integrable = qdot_record_word(r, "integrable") != NULL;
    q->conserved = qdot_record_word(r, "conserved") != NULL;
    if (q->conserved)
        QDOT_TRY(qdot_record_value(r, qdot_record_hole(r, "conserved", NULL), &q->left));
    if (sides != NULL) {
        session->evaluation->passed = &q->passed;
        status = read_comparison(r, sides, q);
        session->evaluation->passed = NULL;
        QDOT_TRY(status);
    }
    for (size_t i = 1; i < r->parts.n; i++)
        if (r->parts.at[i].node->kind == QDOT_USAGE_HOLE && strcmp(r->parts.at[i].node->before, "when") == 0)
            QDOT_TRY(qdot_assumed_add(r, &r->parts.at[i], f));
    q->within = within != NULL;
    return q->within ? qdot_record_number(r, within, &q->tol) : QDOT_OK;
}

/* In `check eom == (x'' = -x)`: replace a list of one member by that member if the other side is no list. */
static void
unwrap_single_members(const qdot_pool *pool, qdot_expr *left, qdot_expr *right)
{
    qdot_expr *sides[] = {left, right};

    for (int i = 0; i < 2; i++)
        if (qdot_expr_kind(pool, *sides[i]) == QDOT_LIST &&
            qdot_expr_count(pool, *sides[i]) == 1 &&
            qdot_expr_kind(pool, *sides[1 - i]) != QDOT_LIST)
            *sides[i] = qdot_expr_arg(pool, *sides[i], 0);
}

/* Exchange the values found for the left and right side of the claim. */
static void
exchange_sides(qdot_decision *decision)
{
    double left = decision->left;

    decision->left = decision->right;
    decision->right = left;
}

/* The LIST of subexpressions that must be defined, with the replacements after `when` made; nil on failure. */
static qdot_expr
list_defined_subexpressions(qdot_session *session, const qdot_assumed *f, const qdot_check_question *q)
{
    qdot_expr list = qdot_list(session->pool, (uint32_t)q->passed.value.n, q->passed.value.at);

    return list == QDOT_NIL ? list : qdot_assumed_replace(session, f, list);
}

qdot_status
qdot_check_contradiction(qdot_session *session, const qdot_assumed *f, const qdot_facts *known)
{
    qdot_pool *pool = session->pool;
    qdot_vec(qdot_expr) conditions = {0};
    qdot_facts all = *known;
    qdot_status status = QDOT_OK;
    bool found = false;

    for (size_t i = 0; i < known->n_conditions && status == QDOT_OK; i++)
        status = qdot_vec_push(&conditions,
                               qdot_assumed_replace(session, f, known->conditions[i]));
    for (size_t i = 0; i < f->from.n && status == QDOT_OK; i++) { /* bounds of the symbols that the conditions replace */
        qdot_symbol s = *qdot_expr_symbol(pool, f->from.at[i]);

        if (s.lo != QDOT_NIL)
            status = qdot_vec_push(&conditions, qdot_rel(pool, s.lo_open ? QDOT_LT : QDOT_LE,
                                                         s.lo, f->to.at[i]));
        if (s.hi != QDOT_NIL && status == QDOT_OK)
            status = qdot_vec_push(&conditions, qdot_rel(pool, s.hi_open ? QDOT_LT : QDOT_LE,
                                                         f->to.at[i], s.hi));
    }
    all.n_conditions = conditions.n;
    all.conditions = conditions.at;
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    if (status == QDOT_OK)
        status = qdot_contradiction(pool, &all, &found);
    qdot_free(conditions.at);
    if (status == QDOT_OK && found)
        status = qdot_answer_notice(session, "what is assumed contradicts itself or the declared "
                                             "domains: there is nothing to compare");
    return status;
}

qdot_facts
qdot_check_known_facts(qdot_session *session, const qdot_assumed *f, const qdot_check_question *q)
{
    /* a given function of time leaves its second derivative free, so accelerations count as known */
    return (qdot_facts){f->relations.n, f->relations.at,
                        f->conditions.n, f->conditions.at,
                        f->motion && !f->stated ? 2 : 0,
                        q->passed.spoiled ? QDOT_NIL : list_defined_subexpressions(session, f, q), false};
}

/* If momenta and velocities both occur, on either side of the claim or in its assumptions, write all in velocities. */
static qdot_status
replace_momenta_by_velocities(qdot_session *session, qdot_check_question *q, qdot_assumed *f)
{
    const qdot_expr sides[] = {q->left, q->right};
    qdot_vec(qdot_expr) list = {0};
    qdot_status status = QDOT_OK;

    if (qdot_session_speeds_meet(session, 2, sides) || (f->motion && qdot_session_has_speeds(session))) {
        q->left = qdot_session_speeds_replaced(session, q->left);
        q->right = qdot_session_speeds_replaced(session, q->right);
        QDOT_TRY(qdot_pool_check(session->pool));
    }
    if (!((qdot_expr_node(session->pool, q->left)->holds |
           qdot_expr_node(session->pool, q->right)->holds) & QDOT_HAS_MOMENTUM))
        return QDOT_OK;
    for (size_t i = 0; i < 2 && status == QDOT_OK; i++)
        status = qdot_vec_push(&list, sides[i]);
    for (size_t i = 0; i < f->relations.n && status == QDOT_OK; i++)
        status = qdot_vec_push(&list, f->relations.at[i]);
    for (size_t i = 0; i < f->conditions.n && status == QDOT_OK; i++)
        status = qdot_vec_push(&list, f->conditions.at[i]);
    for (size_t i = 0; i < f->from.n && status == QDOT_OK; i++)
        if (!f->motion || !(qdot_expr_node(session->pool, f->from.at[i])->holds &
                            (QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER)))
            status = qdot_vec_push(&list, qdot_rel(session->pool, QDOT_EQ, f->from.at[i], f->to.at[i]));
    if (status == QDOT_OK && qdot_momenta_meet(session, (uint32_t)list.n, list.at)) {
        q->left = qdot_momenta_unify(session, q->left);
        q->right = qdot_momenta_unify(session, q->right);
        status = qdot_assumed_in_velocities(session, f);
    }
    qdot_free(list.at);
    return status == QDOT_OK ? qdot_pool_check(session->pool) : status;
}

/* Whether both sides contain multipliers and are equal for all values of them, as a reaction and
 * its components. */
static qdot_status
holds_for_all_multipliers(qdot_session *session, const qdot_check_question *q, const qdot_assumed *f, bool *is)
{
    qdot_pool *pool = session->pool;
    qdot_decision decision;
    qdot_facts known;

    *is = q->how == QDOT_CHECK_EQUAL && (qdot_expr_node(pool, q->left)->holds & QDOT_HAS_MULTIPLIER) &&
          (qdot_expr_node(pool, q->right)->holds & QDOT_HAS_MULTIPLIER);
    if (!*is)
        return QDOT_OK;
    known = qdot_check_known_facts(session, f, q);
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(qdot_check_by_components(session, qdot_assumed_replace(session, f, q->left),
                                  qdot_assumed_replace(session, f, q->right), q->how, &known, &decision));
    *is = decision.verdict == QDOT_PROVED;
    return QDOT_OK;
}

/* A multiplier among values is what the equations make of it; beside accelerations, in an equation or in
 * numbers of a run it stays itself. */
static qdot_status
replace_multipliers(qdot_session *session, const qdot_check_question *q, qdot_assumed *f)
{
    bool formal;
    const qdot_pool *pool = session->pool;
    const uint32_t holds =
        qdot_expr_node(pool, q->left)->holds | qdot_expr_node(pool, q->right)->holds;

    if (!(holds & QDOT_HAS_MULTIPLIER) || (holds & QDOT_HAS_ACCELERATION) || f->motion || q->within ||
        qdot_expr_kind(pool, q->left) == QDOT_REL || qdot_expr_kind(pool, q->right) == QDOT_REL ||
        qdot_measured_occurs(session, q->left) || qdot_measured_occurs(session, q->right))
        return QDOT_OK;
    QDOT_TRY(holds_for_all_multipliers(session, q, f, &formal));
    if (formal)
        return QDOT_OK;
    QDOT_TRY(qdot_answer_notice(session, "multipliers have their values from the equations: checked `when eom`"));
    return qdot_assumed_motion(session, f);
}

/* Whether a side holds a function that is given by data. */
static bool
holds_data(qdot_session *session, const qdot_check_question *q)
{
    const qdot_expr both = qdot_session_bind(session, qdot_list(session->pool, 2, (qdot_expr[]){q->left, q->right}));

    return both != QDOT_NIL && qdot_expr_find_function(session->pool, both, 1, (qdot_fun_id[]){QDOT_LOOKUP}, QDOT_NIL) != QDOT_NIL;
}

qdot_status
qdot_check_answer(qdot_session *session, const qdot_check_question *q, qdot_expr left, qdot_expr right, const qdot_decision *decision)
{
    if (decision->verdict == (q->not ? QDOT_PROVED : QDOT_REFUTED))
        session->outcome->refuted = true;
    return qdot_answer_check(session, left, right, decision);
}

qdot_status
qdot_check_compare(qdot_cursor *c, qdot_check_question *q, qdot_assumed *f)
{
    qdot_session *session = c->session;
    qdot_pool *pool = session->pool;
    qdot_expr left, right;
    qdot_decision decision;
    qdot_facts known;
    bool measured;

    unwrap_single_members(pool, &q->left, &q->right);
    if (qdot_units_on(session)) { /* of one dimension: their numbers are compared */
        q->left = qdot_expr_in_si(pool, q->left);
        q->right = qdot_expr_in_si(pool, q->right);
    }
    QDOT_TRY(replace_multipliers(session, q, f));
    QDOT_TRY(replace_momenta_by_velocities(session, q, f));
    measured = qdot_measured_occurs(session, q->left) || qdot_measured_occurs(session, q->right);
    if (q->how == QDOT_CHECK_PROPORTIONAL && (measured || q->within))
        return qdot_fail(QDOT_EINVAL, "`~` compares equations, not numbers");
    if (measured && q->how == QDOT_CHECK_EQUAL && !q->within) {
        (void)qdot_fail(QDOT_EINVAL, "numbers of a run are never exactly equal");
        return qdot_hint("check ... within 1e-9");
    }
    if (q->within || measured) {
        left = q->turned ? q->right : q->left;
        right = q->turned ? q->left : q->right;
        QDOT_TRY(decide_within(session, left, right, q->how, q->tol, &decision));
        if (q->turned)
            exchange_sides(&decision);
    } else {
        left = qdot_assumed_replace(session, f, q->left);
        right = qdot_assumed_replace(session, f, q->right);
        QDOT_TRY(qdot_pool_check(pool));
        known = qdot_check_known_facts(session, f, q);
        QDOT_TRY(qdot_pool_check(pool));
        if (q->turned) {
            QDOT_TRY(qdot_check_by_components(session, right, left, q->how, &known, &decision));
            exchange_sides(&decision);
        } else {
            QDOT_TRY(qdot_check_by_components(session, left, right, q->how, &known, &decision));
        }
    }
    if (!q->within && !measured && decision.verdict == QDOT_REFUTED && holds_data(session, q)) { /* it took other values than the data's */
        decision = (qdot_decision){.verdict = QDOT_UNDECIDED, .left = NAN, .right = NAN};
        QDOT_TRY(qdot_answer_notice(session, "the values of data are not read here: `check ... within 1e-9` compares numbers"));
    }
    QDOT_TRY(qdot_pool_check(pool));
    if (!q->within && !measured &&
        (decision.verdict == QDOT_PROVED || decision.points == 0 || f->from.n > 0))
        QDOT_TRY(qdot_check_contradiction(session, f, &known));
    return qdot_check_answer(session, q, q->left, q->right, &decision);
}

/* The equations of motion could not be solved for q'' within the work budget: undecided, with what may help. */
static qdot_status
answer_past_budget(qdot_session *session, const qdot_check_question *q)
{
    const char *numbers = q->conserved ? "`drift(...)` is its change along a run"
                                       : "`check ... within 1e-9` compares numbers of a run";

    QDOT_TRY(qdot_answer_notice(session, "%s; with momenta p[q] in place of velocities, or with numbers as parameters, it may "
                                         "be decided, and %s", qdot_last_error()->message, numbers));
    return qdot_answer_check(session, q->left, q->right, &(qdot_decision){.verdict = QDOT_UNDECIDED});
}

static qdot_status
answer_claim(qdot_record *r)
{
    qdot_cursor *c = &r->cursor;
    qdot_check_question q = {.right = QDOT_ZERO};
    qdot_assumed f = {0};
    qdot_status status = qdot_assumed_begin(c->session, &f);

    if (status == QDOT_OK)
        status = read_question(r, &q, &f);
    if (status == QDOT_OK && q.conserved && qdot_held_coordinate(c->session)) {
        c->error_at = r->start->start;
        status = qdot_fail(QDOT_EINVAL, "conservation is a property of the motion, so no coordinate can be held");
    }
    if (status == QDOT_OK && c->session->evaluation->held.n > 0)
        status = qdot_assumed_hold(c->session, &f);
    if (status == QDOT_OK && q.integrable) {
        status = qdot_constraints_check_integrable(r, qdot_record_hole(r, NULL, "LABEL"), q.not);
    } else if (status == QDOT_OK) {
        c->error_at = r->start->start;
        status = q.conserved ? qdot_check_conserved(c, &q, &f) : qdot_check_compare(c, &q, &f);
    }
    if (status == QDOT_ELIMIT && f.motion)
        status = answer_past_budget(c->session, &q);
    qdot_free(q.passed.value.at);
    qdot_free(q.passed.root.at);
    qdot_assumed_free(&f);
    return status;
}

static qdot_status
check_claim(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_text claim = {0};
    qdot_status status;

    qdot_token_text(session, r->start, r->cursor.at, &claim);
    status = qdot_text_status(&claim);
    session->evaluation->claim = qdot_text_str(&claim);
    if (status == QDOT_OK)
        status = answer_claim(r);
    session->evaluation->claim = NULL;
    qdot_text_clear(&claim);
    return status;
}

qdot_status
qdot_check(qdot_cursor *c)
{
    qdot_record r;
    qdot_status status = qdot_match_operands(c, &qdot_statement_row_check, &r);

    if (status == QDOT_OK)
        status = check_claim(&r);
    c->at = r.cursor.at;
    c->error_at = r.cursor.error_at;
    qdot_record_free(&r);
    return status;
}
