/* include.c -- the statement `include`: carries out another script. */
#include "lang/session/session.h"
#include "lang/syntax/record.h"
#include "lang/workbench/script.h"

static qdot_status carry_out_include(qdot_record *r);

QDOT_STATEMENT(include) = {
    .word = "include",
    .group = QDOT_WORKBENCH,
    .usage = "include \"FILE.lag\"",
    .summary = "carry out another script, found beside this one",
    .example = "include \"other.lag\"",
    .handler = carry_out_include,
};

static qdot_status
carry_out_include(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_text path = {0};
    qdot_status status;
    bool opened;

    qdot_session_path(session, qdot_record_text(qdot_record_hole(r, NULL, NULL)), &path);
    r->cursor.error_at = r->start->start;
    status = qdot_text_status(&path);
    if (status == QDOT_OK) {
        status = qdot_script_carry_out_file(session, qdot_text_str(&path), &opened);
        if (status != QDOT_OK && opened)
            r->cursor.error_at = QDOT_SCRIPT_REPORTED;
    }
    qdot_text_clear(&path);
    return status;
}
