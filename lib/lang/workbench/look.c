/* look.c -- parses statements without carrying them out, and hands their expressions over. */
#include "lang/workbench/look.h"

#include "lang/syntax/definition.h"
#include "lang/syntax/match.h"
#include "lang/syntax/outline.h"

qdot_status
qdot_look_at_record(const qdot_look *look, qdot_record *record)
{
    for (size_t i = 0; i < record->compiled.n && look->expression != NULL; i++)
        QDOT_TRY(look->expression(look->data, &record->cursor, &record->compiled.at[i]));
    return QDOT_OK;
}

static qdot_status
look_at_expression(const qdot_look *look, qdot_cursor *c)
{
    qdot_compiled program = {0};
    qdot_status status = qdot_compiled_parse(c, QDOT_PARSE_VALUE, &program);

    if (status == QDOT_OK && look->expression != NULL)
        status = look->expression(look->data, c, &program);
    qdot_compiled_free(&program);
    QDOT_TRY(status);
    return qdot_cursor_expect_end(c);
}

/* A comparison is the statement `check` without its word. */
static qdot_status
look_at_comparison(const qdot_look *look, qdot_cursor *c)
{
    qdot_record record;
    qdot_status status = qdot_match_operands(c, qdot_statement_find("check"), &record);

    if (status == QDOT_OK)
        status = qdot_look_at_record(look, &record);
    c->at = record.cursor.at;
    c->error_at = record.cursor.error_at;
    qdot_record_free(&record);
    return status;
}

qdot_status
qdot_look_at_wordless(const qdot_look *look, qdot_cursor *c, qdot_form form)
{
    qdot_definition d;

    if (form == QDOT_FORM_COMPARISON)
        return look_at_comparison(look, c);
    if (form == QDOT_FORM_DEFINITION && qdot_definition_find(c->at, qdot_outline_end(c->at), &d))
        c->at = d.equals + 1;
    return look_at_expression(look, c);
}
