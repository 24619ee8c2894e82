/* left-out.h -- methods that a study leaves out because they do not suit the scene, and why.
 *
 * Tests  tests/script/studies/longtime.sh, workprecision-scenes.sh
 */
#ifndef QDOT_SIM_LEFT_OUT_H
#define QDOT_SIM_LEFT_OUT_H

#include "base/memory.h"
#include "base/status.h"

typedef struct {
    const char *method;
    char reason[300];
} qdot_method_left_out;

typedef qdot_vec(qdot_method_left_out) qdot_methods_left_out;

/* Add a method to the list, with the message of the last failure as the reason. */
QDOT_MUST_CHECK qdot_status qdot_methods_leave_out(qdot_methods_left_out *list, const char *method);

#endif
