/* forces.c -- the statement `forces`: lists the generalized forces by their sources. */
#include "expr/build.h"
#include "lang/answer/sheet.h"
#include "lang/ask/ask.h"
#include "lang/session/history.h"
#include "lang/syntax/record.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/things.h"

static qdot_status carry_out_forces(qdot_record *r);

QDOT_STATEMENT(forces) = {
    .word = "forces",
    .group = QDOT_ASKING,
    .usage = "forces",
    .summary = "the generalized forces, part by part",
    .example = "forces",
    .alone = true,
    .handler = carry_out_forces,
};

/* Print a line such as `theta, spring s1: FORCE` for each coordinate and each source of force. */
static qdot_status
print_forces_by_source(qdot_sheet *sheet)
{
    qdot_session *session = sheet->session;
    qdot_scene *s = session->scene;
    qdot_force_source source;

    for (size_t i = 0; i < s->coordinates.n; i++)
        for (size_t k = 0; qdot_mech_source_at(s, k, &source); k++) {
            const qdot_expr q = s->coordinates.at[i];
            const qdot_expr part = qdot_mech_source_force(s, &source, q);

            QDOT_TRY(qdot_pool_check(session->pool));
            if (part == QDOT_ZERO)
                continue;
            QDOT_TRY(qdot_sheet_formula(sheet, q));
            qdot_sheet_format(sheet, ", %s%s%s: ", source.kind, source.name != NULL ? " " : "",
                              source.name != NULL ? source.name : "");
            QDOT_TRY(qdot_sheet_formula(sheet, part));
            qdot_sheet_words(sheet, "\n");
        }
    if (qdot_sheet_is_empty(sheet))
        qdot_sheet_words(sheet, "nothing is applied");
    return QDOT_OK;
}

static qdot_status
carry_out_forces(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_expr forces;
    qdot_sheet sheet;

    forces = qdot_mech_forces(session->scene);
    QDOT_TRY(qdot_pool_check(session->pool));
    QDOT_TRY(qdot_session_remember(session, forces,
                                   qdot_list(session->pool,
                                             (uint32_t)session->scene->coordinates.n,
                                             session->scene->coordinates.at)));
    QDOT_TRY(qdot_ask_list(session, "forces", forces, QDOT_NIL));
    sheet = qdot_sheet_begin(session);
    return qdot_sheet_end(&sheet, "forces", print_forces_by_source(&sheet));
}
