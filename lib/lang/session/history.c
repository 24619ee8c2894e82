/* history.c -- adds an answer to the history of answers, which %1, %2 ... stand for. */
#include "lang/session/history.h"

qdot_status
qdot_session_remember(qdot_session *session, qdot_expr value, qdot_expr over)
{
    QDOT_TRY(qdot_vec_push(&session->history->values, value));
    while (session->history->over.n < session->history->values.n)
        QDOT_TRY(qdot_vec_push(&session->history->over, QDOT_NIL));
    session->history->over.at[session->history->values.n - 1] = over;
    return QDOT_OK;
}
