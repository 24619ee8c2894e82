/* expansion.c -- lets an integrator run the machine code of a program; order p of a state is order
 * p - 1 of q''. */
#include "sim/form/expansion.h"

static qdot_status
write_machine_code(int p, int most, void *user)
{
    return qdot_taylor_prepare(user, p - 1, most - 1);
}

static bool
take_stored_code(int p, int most, void *user)
{
    return qdot_taylor_take_kept(user, p - 1, most - 1);
}

static bool
has_machine_code(int p, void *user)
{
    return qdot_taylor_is_code(user, p - 1);
}

static void
drop_machine_code(void *user)
{
    qdot_taylor_drop_code(user);
}

qdot_ode_code
qdot_expansion_code(qdot_taylor *taylor)
{
    return (qdot_ode_code){.write = write_machine_code,
                           .take = take_stored_code,
                           .there = has_machine_code,
                           .drop = drop_machine_code,
                           .user = taylor};
}
