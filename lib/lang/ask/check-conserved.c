/* check-conserved.c -- `check conserved E`: whether dE/dt = 0 along the motion. */
#include "lang/ask/check-parts.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "lang/answer/answer.h"
#include "lang/session/measured.h"
#include "lang/session/momenta.h"
#include "lang/session/speeds.h"
#include "mech/dynamics/quantity.h"
#include "mech/dynamics/rate.h"
#include "mech/hamilton/phase-constraints.h"

/* A scalar as a function of the state: accelerations, and rates of momenta, by the equations of motion. */
static qdot_expr
function_of_state(qdot_pool *pool, qdot_expr e, void *user)
{
    qdot_session *session = user;

    if (!qdot_session_in_speeds(session, e))
        e = qdot_session_speeds_replaced(session, e);
    if (e == QDOT_NIL)
        return e;
    if (qdot_mech_holds_momentum_rate(session->scene, e))
        e = qdot_momenta_to_velocities(session, e);
    return e != QDOT_NIL && (qdot_expr_node(pool, e)->holds & QDOT_HAS_ACCELERATION) && session->scene->coordinates.n > 0
               ? qdot_rate_on_motion(session->scene, e) : e;
}

/* The rate of a scalar where it needs no accelerations; *missing: it does. */
typedef struct {
    qdot_session *session;
    bool missing;
} rate_search;

static qdot_expr
rate_of_component(qdot_pool *pool, qdot_expr e, void *user)
{
    rate_search *search = user;
    const bool speeds = qdot_session_in_speeds(search->session, e);
    qdot_expr rate = speeds ? qdot_session_speeds_rate(search->session, e) : qdot_mech_rate(search->session->scene, e);

    if (rate != QDOT_NIL || qdot_pool_failed(pool))
        return qdot_phase_constraints_put(search->session->scene, rate);
    search->missing = true;
    return QDOT_ZERO;
}

/* dE/dt = 0 along the motion, where that needs no accelerations; *done: it was decided so.
 * Where multipliers are left, which the state tells, or a coordinate has no mass, only a proof
 * counts. */
static qdot_status
decide_conserved_by_rate(qdot_session *session, qdot_check_question *q, qdot_assumed *f, bool *done)
{
    qdot_pool *pool = session->pool;
    qdot_decision decision;
    qdot_facts known;
    rate_search search = {.session = session};
    qdot_expr rate, zero;

    *done = false;
    if (session->scene->coordinates.n == 0 ||
        f->from.n > 0 || qdot_measured_occurs(session, q->left))
        return QDOT_OK;
    rate = qdot_value_map(pool, q->left, rate_of_component, &search);
    zero = qdot_value_sub(pool, rate, rate);
    QDOT_TRY(qdot_pool_check(pool));
    if (search.missing)
        return QDOT_OK;
    f->motion = true;
    for (size_t i = 0; i < session->scene->constraints.n; i++)
        QDOT_TRY(qdot_assumed_constraint(session, f, i, false));
    known = qdot_check_known_facts(session, f, q);
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(qdot_check_by_components(session, rate, zero, QDOT_CHECK_EQUAL, &known, &decision));
    *done = decision.verdict == QDOT_PROVED ||
            ((qdot_expr_node(pool, rate)->holds & QDOT_HAS_MULTIPLIER) == 0 &&
             !qdot_mech_lacks_mass(session->scene));
    if (!*done)
        return QDOT_OK;
    if (decision.verdict == QDOT_PROVED)
        QDOT_TRY(qdot_check_contradiction(session, f, &known));
    return qdot_check_answer(session, q, rate, zero, &decision);
}

/* `conserved E`: by its rate, else with accelerations put in; undecided where E jumps with time. */
qdot_status
qdot_check_conserved(qdot_cursor *c, qdot_check_question *q, qdot_assumed *f)
{
    qdot_session *session = c->session;
    qdot_decision decision = {.verdict = QDOT_UNDECIDED};
    bool done, jumps;

    q->left = qdot_value_map(session->pool, q->left, function_of_state, session);
    QDOT_TRY(qdot_pool_check(session->pool));
    QDOT_TRY(qdot_jumps(session->pool, q->left, QDOT_HAS_TIME, &jumps));
    if (!jumps) {
        QDOT_TRY(decide_conserved_by_rate(session, q, f, &done));
        if (done)
            return QDOT_OK;
    }
    q->left = qdot_momenta_to_velocities(session, q->left); /* speeds become velocities, too */
    QDOT_TRY(qdot_pool_check(session->pool));
    q->left = qdot_ddt(session->pool, q->left);
    q->right = qdot_value_sub(session->pool, q->left, q->left);
    QDOT_TRY(qdot_pool_check(session->pool));
    if (jumps) {
        QDOT_TRY(qdot_answer_notice(session, "it jumps with time: its rate is that between jumps"));
        return qdot_answer_check(session, q->left, q->right, &decision);
    }
    QDOT_TRY(qdot_assumed_motion(session, f));
    return qdot_check_compare(c, q, f);
}
