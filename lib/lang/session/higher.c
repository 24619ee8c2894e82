/* higher.c -- statements, values and functions that are not made for Lagrangians with q''. */
#include "lang/session/higher.h"

#include <string.h>

#include "mech/scene/scene.h"

qdot_status
qdot_session_refuse_higher(const qdot_session *session, const char *word)
{
    static const char *const refused[] = {
        "mass_matrix", "Q",          "virtual_work", "forces",   "cyclic",     "routhian",    "conserved", "equilibria",
        "steady",      "modes",      "linearize",    "transfer", "reactions",  "stability",  "continue",   "poisson",   "lie",
        "dof",         "constraint", "speed",        "derive",   "export",     "report",      "animate",
        "action",      "hamilton_jacobi", "complete_integral", "canonical",
    };

    for (size_t i = 0; session->scene->higher.n > 0 && i < sizeof refused / sizeof *refused; i++)
        if (strcmp(word, refused[i]) == 0)
            return qdot_higher_refuse(session->scene, word);
    return QDOT_OK;
}
