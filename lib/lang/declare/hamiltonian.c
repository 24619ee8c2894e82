/* hamiltonian.c -- the statement `hamiltonian`: states Hamilton's function. */
#include "base/text.h"
#include "lang/answer/answer.h"
#include "lang/session/evaluation.h"
#include "lang/session/measured.h"
#include "lang/syntax/record.h"
#include "mech/scene/scene.h"
#include "mech/hamilton/hamilton.h"

static qdot_status declare_hamiltonian(qdot_record *r);

QDOT_STATEMENT(hamiltonian) = {
    .word = "hamiltonian",
    .group = QDOT_DECLARING,
    .usage = "hamiltonian H",
    .summary = "state Hamilton's function H(q, p, t) itself, with the momenta p[q]; L follows where they can be solved for",
    .example = "hamiltonian p[x]^2/(2*m) + k*x^2/2",
    .handler = declare_hamiltonian,
};

/* Say why no Lagrangian follows from H, as the error that was just reported tells. */
static qdot_status
tell_missing_lagrangian(qdot_session *session)
{
    qdot_text text = {0};

    qdot_text_format(&text, "no Lagrangian follows: %s", qdot_last_error()->message);
    return qdot_answer_notice_text(session, QDOT_OK, &text);
}

static qdot_status
declare_hamiltonian(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_expr H, L = QDOT_NIL;
    qdot_status status;

    session->evaluation->declares = false; /* p[q] is the symbol of the momentum, not dL/dq' of an earlier Lagrangian */
    QDOT_TRY(qdot_record_scalar(r, qdot_record_hole(r, NULL, "H"), &H));
    H = qdot_measured_as_rationals(session, H);
    QDOT_TRY(qdot_pool_check(session->pool));
    r->cursor.error_at = r->start->start;
    QDOT_TRY(qdot_scene_hamiltonian(session->scene, H, QDOT_NIL));
    status = qdot_hamilton_lagrangian(session->scene, &L);
    if (status == QDOT_OK)
        return qdot_scene_hamiltonian(session->scene, H, L);
    if (status != QDOT_ESINGULAR && status != QDOT_EDOMAIN)
        return status;
    return tell_missing_lagrangian(session);
}
