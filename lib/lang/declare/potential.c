/* potential.c -- the statement `potential`: declares a term of the potential energy. */
#include "lang/declare/objects.h"

static qdot_status
declare_potential(qdot_record *r)
{
    return qdot_object_term(r, qdot_record_hole(r, NULL, "V"), QDOT_POTENTIAL);
}

QDOT_STATEMENT(potential) = {
    .word = "potential",
    .group = QDOT_DECLARING,
    .usage = "potential [NAME:] V",
    .summary = "a term of the potential energy",
    .example = "potential k*r^2/2",
    .handler = declare_potential,
};
