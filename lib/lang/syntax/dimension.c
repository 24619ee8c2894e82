/* dimension.c -- the dimensions of what stands in the holes of statements. */
#include "lang/syntax/dimension.h"

#include <string.h>

#include "expr/build.h"
#include "expr/symbol.h"
#include "lang/session/units.h"
#include "mech/scene/things.h"

static const struct row {
    const char *statement, *before, *text, *words;
    int exponent[QDOT_BASES];
} rows[] = {
#define DIMENSION(statement, before, text, words, ...) {statement, before, text, words, {__VA_ARGS__}},
#include "lang/syntax/dimension.def"
#undef DIMENSION
};

static const int force[QDOT_BASES] = {1, 1, -2}, energy[QDOT_BASES] = {2, 1, -2};

static bool
suits(const char *wanted, const char *is)
{
    return wanted == NULL || (is != NULL && strcmp(wanted, is) == 0);
}

/* A force on a point is one; what acts on a coordinate q does the work force*q, what turns a body torque*angle. */
static qdot_status
give_action(qdot_session *session, qdot_expr value, qdot_expr on, bool torque)
{
    if (on != QDOT_NIL)
        return qdot_units_energy(session, qdot_mul(session->pool, value, on), "force times displacement is %s, not %s");
    return torque ? qdot_units_fix(session, value, qdot_dimension_make(energy), "a torque belongs here (as an energy), not %s")
                  : qdot_units_fix(session, value, qdot_dimension_make(force), "a force belongs here, not %s");
}

/* A Lagrangian or Hamiltonian of which that is not determined is an energy; it may be another, such as one for a unit of
 * mass. What acts on coordinates does work of the same dimension. */
static qdot_status
give_energy_if_free(qdot_session *session, qdot_expr value)
{
    const qdot_scene *s = session->scene;
    qdot_pool *pool = session->pool;
    qdot_dimension is;
    qdot_status status;

    QDOT_TRY(qdot_units_visit(session, value));
    if (qdot_units_of(session, value, &is) == QDOT_DIMENSION_FREE)
        QDOT_TRY(qdot_units_fix(session, value, qdot_dimension_make(energy), "%s is not %s"));
    status = QDOT_OK;
    for (size_t i = 0; i < s->torques.n && status == QDOT_OK; i++)
        if (s->torques.at[i].coordinate != QDOT_NIL)
            status = qdot_units_join(session, value, qdot_mul(pool, s->torques.at[i].torque, s->torques.at[i].coordinate),
                                     "the Lagrangian is %s, but force times displacement %s");
    for (size_t i = 0; i < s->dissipations.n && status == QDOT_OK; i++)
        status = qdot_units_join(session, value, qdot_mul(pool, s->dissipations.at[i].e, QDOT_T),
                                 "the Lagrangian is %s, but dissipation times time %s");
    if (status == QDOT_ETYPE)
        (void)qdot_hint("with the Lagrangian first, what acts on coordinates gets its dimension from it");
    return status;
}

qdot_status
qdot_hole_dimension(qdot_session *session, const char *statement, const qdot_usage_node *node, qdot_expr on, qdot_expr value)
{
    const char *before = node->before, *text = node->text;
    qdot_text format = {0};
    qdot_status status;
    const struct row *row = rows, *const end = rows + sizeof rows / sizeof *rows;

    if (strcmp(statement, "force") == 0 && suits("F", text))
        return give_action(session, value, on, false);
    if (strcmp(statement, "torque") == 0 && suits("TAU", text))
        return give_action(session, value, on, true);
    if ((strcmp(statement, "lagrangian") == 0 && suits("L", text)) || strcmp(statement, "hamiltonian") == 0)
        return give_energy_if_free(session, value);
    if (strcmp(statement, "dissipation") == 0 && suits("D", text) && session->scene->lagrangian != QDOT_NIL)
        return qdot_units_energy(session, qdot_mul(session->pool, value, QDOT_T), "dissipation times time is %s, not %s");
    while (row < end && !(suits(row->statement, statement) && suits(row->before, before) && suits(row->text, text)))
        row++;
    if (row == end || (suits("a time", row->words) && qdot_expr_is_constant(session->pool, value)))
        return QDOT_OK; /* a bare number is a time in s */
    qdot_text_format(&format, "%s belongs here, not %%s", row->words);
    status = qdot_text_status(&format);
    if (status == QDOT_OK)
        status = qdot_units_fix(session, value, qdot_dimension_make(row->exponent), format.at);
    if (status == QDOT_OK && suits("an angle", row->words))
        status = qdot_units_angles_in(session, value);
    qdot_text_clear(&format);
    return status;
}
