/* constraints.c -- finds constraints that are integrable to holonomic ones, or redundant. */
#include "lang/declare/constraints.h"

#include <math.h>
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/answer/sheet.h"
#include "lang/language/hints.h"
#include "lang/session/outcome.h"
#include "lang/session/output.h"
#include "lang/syntax/statement.h"
#include "mech/dynamics/integrable.h"

/* Append the name of a constraint, such as "blade" or "roll[2]". */
static void
print_constraint(const qdot_constraint *c, qdot_text *out)
{
    const char *comma = strchr(c->name, ',');

    if (comma != NULL)
        qdot_text_format(out, "%.*s[%s]", (int)(comma - c->name), c->name,
                         comma + 1 + strspn(comma + 1, " "));
    else
        qdot_text_add(out, c->name);
}

/* --- redundant constraints ---------------------------------------------------------- */

void
qdot_constraints_print_redundant(const qdot_scene *scene, const qdot_dof *dof,
                                 qdot_text *out)
{
    size_t found = 0, hidden = 0;

    for (size_t k = 0; k < dof->constraints; k++) {
        if (dof->is_independent[k] || dof->is_hidden[k])
            continue;
        qdot_text_add(out, found++ > 0   ? ", "
                           : dof->unmet ? "\nredundant or contradicting those before: "
                                        : "\nredundant, beside those before: ");
        print_constraint(&scene->constraints.at[k], out);
    }
    if (found > 0 && !dof->unmet)
        qdot_text_add(out, "; the motion is unique, the multipliers are not");
    for (size_t k = 0; k < dof->constraints; k++) {
        if (!dof->is_hidden[k])
            continue;
        qdot_text_add(out, hidden++ > 0 ? ", "
                                        : "\nleaving, with those before, a condition that is none of the "
                                          "constraints, and that n does not count: ");
        print_constraint(&scene->constraints.at[k], out);
    }
    if (dof->unmet)
        qdot_text_add(out, "\nno configuration was found at which all constraints hold");
    else if (dof->freedom == 0 && dof->coordinates > 0)
        qdot_text_add(out, "\nthe constraints leave no freedom: they alone set the motion");
}

/* --- integrable constraints --------------------------------------------------------- */

/* Print the integral of a velocity constraint: `x - R*theta = const`. */
static qdot_status
print_integral(qdot_sheet *sheet, qdot_expr integral)
{
    QDOT_TRY(qdot_sheet_formula(sheet, integral));
    qdot_sheet_words(sheet, " = const");
    return QDOT_OK;
}

static qdot_status
print_why_not_integrable(qdot_sheet *sheet, const qdot_integrability *i)
{
    const qdot_pool *pool = sheet->session->pool;
    qdot_expr at = i->decision.at;

    qdot_sheet_words(sheet, " is not integrable: dw along ");
    QDOT_TRY(qdot_sheet_formula(sheet, i->along[0]));
    qdot_sheet_words(sheet, " and ");
    QDOT_TRY(qdot_sheet_formula(sheet, i->along[1]));
    qdot_sheet_words(sheet, " is ");
    QDOT_TRY(qdot_sheet_formula(sheet, i->component));
    if (at == QDOT_NIL || qdot_expr_count(pool, at) == 0)
        return QDOT_OK;
    if (isfinite(i->decision.left)) {
        qdot_sheet_words(sheet, ", ");
        qdot_sheet_double(sheet, i->decision.left, 12);
    }
    for (uint32_t k = 0; k < qdot_expr_count(pool, at); k++) {
        qdot_sheet_words(sheet, k == 0 ? " at " : ", ");
        QDOT_TRY(qdot_sheet_formula(sheet, qdot_expr_arg(pool, at, k)));
    }
    return QDOT_OK;
}

static qdot_status
answer_integrability_as_text(qdot_session *session, const qdot_constraint *c, const qdot_integrability *i)
{
    static const char *const verdicts[] = {[QDOT_PROVED] = "proved",
                                           [QDOT_REFUTED] = "refuted",
                                           [QDOT_UNDECIDED] = "undecided"};
    qdot_sheet sheet = qdot_sheet_begin_words(session);
    qdot_text name = {0};
    qdot_status status;

    print_constraint(c, &name);
    qdot_sheet_format(&sheet, "%s: %s", verdicts[i->decision.verdict], qdot_text_str(&name));
    status = qdot_text_status(&name);
    qdot_text_clear(&name);
    if (i->decision.verdict == QDOT_UNDECIDED)
        qdot_sheet_words(&sheet, " may be integrable beside the other constraints");
    if (i->decision.verdict == QDOT_PROVED)
        qdot_sheet_format(&sheet, " is integrable%s%s", i->alone ? "" : " beside the other constraints",
                          i->integral == QDOT_NIL ? "; its integral was not found" : ": ");
    if (status == QDOT_OK && i->decision.verdict == QDOT_REFUTED)
        status = print_why_not_integrable(&sheet, i);
    if (status == QDOT_OK && i->decision.verdict == QDOT_PROVED && i->integral != QDOT_NIL)
        status = print_integral(&sheet, i->integral);
    return qdot_sheet_end(&sheet, "check", status);
}

/* As JSON the sides are mu f and dF/dt where an integral proves it, else the worst
 * component of dw and 0. */
static qdot_status
answer_integrability_as_json(qdot_session *session, const qdot_constraint *c, const qdot_integrability *i)
{
    qdot_pool *pool = session->pool;
    bool shown = i->integral != QDOT_NIL && i->factor != QDOT_NIL;
    qdot_expr left = shown                        ? qdot_mul(pool, i->factor, c->f)
                     : i->component != QDOT_NIL ? i->component
                                                : QDOT_ZERO;
    qdot_expr right = shown ? qdot_ddt(pool, i->integral) : QDOT_ZERO;

    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(qdot_answer_check(session, left, right, &i->decision));
    return i->integral != QDOT_NIL
               ? qdot_answer_expr(session, "integral", i->integral)
               : QDOT_OK;
}

qdot_status
qdot_constraints_check_integrable(qdot_record *r, const qdot_filled *name, bool not)
{
    qdot_session *session = r->cursor.session;
    qdot_scene *scene = session->scene;
    const char *label, *nearest;
    bool found = false;

    QDOT_TRY(qdot_record_name(r, name, &label));
    qdot_record_blame(r, name);
    for (size_t k = 0; k < scene->constraints.n; k++) {
        qdot_integrability i;

        if (scene->constraints.at[k].label == NULL ||
            strcmp(scene->constraints.at[k].label, label) != 0)
            continue;
        found = true;
        QDOT_TRY(qdot_mech_integrable(scene, k, false, &i));
        QDOT_TRY(qdot_pool_check(session->pool));
        if (i.decision.verdict == (not? QDOT_PROVED : QDOT_REFUTED))
            session->outcome->refuted = true;
        QDOT_TRY(session->output->json ? answer_integrability_as_json(session, &scene->constraints.at[k], &i)
                               : answer_integrability_as_text(session, &scene->constraints.at[k], &i));
    }
    if (found)
        return QDOT_OK;
    (void)qdot_fail(QDOT_ENAME, "no constraint is labelled `%s`", label);
    nearest = qdot_hints_nearest(session, label);
    if (nearest != NULL && qdot_scene_has_label(scene, nearest))
        return qdot_hint("did you mean `%s`?", nearest);
    return qdot_hint("constraint %s: ... labels one", label);
}

/* --- notices at the declaration of a constraint ------------------------------------- */

/* Constraints with more operations are tested only by `check integrable`. */
enum { MOST_OPERATIONS = 400 };

qdot_status
qdot_constraints_tell_disguise(qdot_session *session, size_t before)
{
    qdot_scene *scene = session->scene;

    for (size_t k = before; k < scene->constraints.n; k++) {
        const qdot_constraint *c = &scene->constraints.at[k];
        qdot_integrability i;
        qdot_text text = {0};
        qdot_status status;

        if (c->kind != QDOT_VELOCITY ||
            qdot_expr_size(session->pool, c->f) > MOST_OPERATIONS)
            continue;
        status = qdot_mech_integrable(scene, k, true, &i);
        if (status == QDOT_EINVAL) /* the constraint is not linear in the velocities */
            continue;
        QDOT_TRY(status);
        if (i.decision.verdict != QDOT_PROVED)
            continue;
        qdot_text_add(&text, c->label == NULL ? "constraint " : "");
        print_constraint(c, &text);
        qdot_text_add(&text, " is holonomic in disguise");
        if (i.integral != QDOT_NIL) {
            qdot_sheet sheet = qdot_sheet_begin_text(session, session->output->style);

            qdot_text_add(&text, ": ");
            status = qdot_sheet_text(&sheet, print_integral(&sheet, i.integral), &text);
        }
        QDOT_TRY(qdot_answer_notice_text(session, status, &text));
    }
    return QDOT_OK;
}
