/* dissipation.c -- the statement `dissipation`: declares a term of the Rayleigh function. */
#include "lang/declare/objects.h"

static qdot_status
declare_dissipation(qdot_record *r)
{
    return qdot_object_term(r, qdot_record_hole(r, NULL, "D"), QDOT_DISSIPATION);
}

QDOT_STATEMENT(dissipation) = {
    .word = "dissipation",
    .group = QDOT_DECLARING,
    .usage = "dissipation [NAME:] D",
    .summary = "a term of the Rayleigh function: Q has -dD/dq'",
    .example = "dissipation c*theta'^2/2",
    .handler = declare_dissipation,
};
