/* declared.c -- prints a declared name as the statement that declares it. */
#include "lang/ask/declared.h"

#include <inttypes.h>
#include <string.h>

#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/answer/expression.h"
#include "lang/language/function.h"
#include "lang/session/runs.h"
#include "lang/session/units.h"
#include "lang/session/values.h"
#include "mech/scene/scene.h"

/* Print a value, or only its size if it is too large. */
static qdot_status
print_value(qdot_session *session, qdot_expr value, qdot_text *out)
{
    uint64_t size = qdot_expr_size(session->pool, value);

    if (size <= QDOT_EXPRESSION_OPERATIONS)
        return qdot_print(session->pool, value, QDOT_PLAIN, out);
    qdot_text_format(out, "... # %" PRIu64 " operations", size);
    return QDOT_OK;
}

qdot_status
qdot_declared_print(qdot_session *session, const qdot_name *name, qdot_text *out)
{
    qdot_pool *pool = session->pool;
    qdot_expr value;

    switch (name->kind) {
    case QDOT_NAME_PARAM:
    case QDOT_NAME_COORD:
        if (qdot_scene_state_of(session->scene, name->value) != NULL)
            return qdot_scene_print_state(session->scene, name->value, out);
        qdot_text_add(out, name->kind == QDOT_NAME_PARAM ? "param " : "coord ");
        QDOT_TRY(qdot_scene_print_domain(session->scene, name->value, out));
        value = qdot_session_value_set(session, name->value);
        if (value != QDOT_NIL) {
            qdot_text_add(out, " = ");
            QDOT_TRY(print_value(session, value, out));
        }
        if (value == QDOT_NIL || qdot_expr_is_constant(pool, value))
            qdot_units_in_brackets(session, name->value, out);
        return QDOT_OK;
    case QDOT_NAME_UFUN:
        qdot_text_add(out, "function ");
        return qdot_print(pool, name->value, QDOT_PLAIN, out);
    case QDOT_NAME_SPEED:
        qdot_text_format(out, "speed %s = ", name->name);
        return print_value(session, qdot_expr_arg(pool, name->formals, 0), out);
    case QDOT_NAME_FUNCTION: return qdot_function_print(session, name, out);
    default:
        qdot_text_format(out, "%s = ", name->name);
        return print_value(session, name->value, out);
    }
}

qdot_status
qdot_declared_label(qdot_session *session, const char *label, qdot_text *out)
{
    qdot_text scene = {0};
    qdot_status status = qdot_scene_print(session->scene, &scene);
    size_t n = strlen(label);

    for (const char *line = qdot_text_str(&scene); status == QDOT_OK && *line != '\0';) {
        const char *end = strchrnul(line, '\n'), *word = strchr(line, ' ');

        if (word != NULL && word < end && strncmp(word + 1, label, n) == 0 &&
            strchr(" :", word[1 + n]) != NULL) {
            qdot_text_add_n(out, line, (size_t)(end - line));
            break;
        }
        line = *end == '\0' ? end : end + 1;
    }
    qdot_text_clear(&scene);
    return status;
}

bool
qdot_declared_run(const qdot_session *session, const char *name, qdot_text *out)
{
    for (size_t i = 0; i < session->runs->n; i++)
        if (strcmp(session->runs->at[i].name, name) == 0) {
            qdot_text_format(out, "run %s as %s", session->runs->at[i].text, name);
            return true;
        }
    return false;
}
