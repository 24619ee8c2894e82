/* unmade.c -- statements, values and functions that are not made for Lagrangians with q'', or for delays. */
#include "lang/session/unmade.h"

#include <string.h>

#include "expr/symbol.h"
#include "lang/session/session.h"
#include "lang/session/values.h"
#include "mech/scene/scene.h"

/* --- words that are not made for Lagrangians with q'' ----------------------------------- */

static const char *const not_of_higher[] = {
    "mass_matrix", "Q",          "virtual_work", "forces",   "cyclic",     "routhian",    "conserved", "equilibria",
    "steady",      "modes",      "linearize",    "transfer", "reactions",  "stability",  "continue",   "poisson",   "lie",
    "dof",         "constraint", "speed",        "derive",   "export",     "report",      "animate",
    "action",      "hamilton_jacobi", "complete_integral", "canonical",
};

/* --- words that are not made for delays ------------------------------------------------- */

static const char *const not_of_delays[] = {
    "equilibria", "steady",      "modes",    "linearize", "transfer", "stability", "continue", "lyapunov", "sensitivity",
    "floquet",    "find",        "fit",      "longtime",  "race",      "export",   "report",   "poisson",
    "action",     "hamilton_jacobi", "workprecision", "start RUN",
};

/* Whether the scene, or a value that was given, holds a coordinate at another time. */
static bool
has_delays(const qdot_session *session)
{
    bool has = qdot_scene_has_delays(session->scene);

    for (size_t i = 0; i < session->values->set_values.n && !has; i++)
        has = qdot_has_delayed(session->pool, session->values->set_values.at[i]);
    return has;
}

/* --- refusing a word -------------------------------------------------------------------- */

static bool
is_listed(const char *word, const char *const *list, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (strcmp(word, list[i]) == 0)
            return true;
    return false;
}

qdot_status
qdot_session_refuse_unmade(const qdot_session *session, const char *word)
{
    if (session->scene->higher.n > 0 && is_listed(word, not_of_higher, sizeof not_of_higher / sizeof *not_of_higher))
        return qdot_higher_refuse(session->scene, word);
    if (is_listed(word, not_of_delays, sizeof not_of_delays / sizeof *not_of_delays) && has_delays(session))
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: %s with delays", word);
    return QDOT_OK;
}
