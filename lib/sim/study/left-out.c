/* left-out.c -- lists the methods that a study of methods leaves out, with reasons. */
#include "sim/study/left-out.h"

#include <stdio.h>

qdot_status
qdot_methods_leave_out(qdot_methods_left_out *list, const char *method)
{
    qdot_method_left_out x = {.method = method};

    snprintf(x.reason, sizeof x.reason, "%.299s", qdot_last_error()->message);
    return qdot_vec_push(list, x);
}
