/* state-values.h -- expressions at a state of a scene, in symbols or in numbers.
 *
 * In symbols the values are inserted and the result is shortened. In numbers the values of the parameters are inserted
 * too, the rest is evaluated in balls and rounded to 128 bits.
 */
#ifndef QDOT_MECH_STATE_VALUES_H
#define QDOT_MECH_STATE_VALUES_H

#include "base/memory.h"
#include "mech/linear/elimination.h"
#include "mech/linear/rest.h"
#include "mech/scene/things.h"

typedef struct {
    qdot_scene *s;
    qdot_facts facts;
    qdot_elimination x;
    qdot_binder bind;
    void *user;
    qdot_vec(qdot_expr) symbols, values; /* the symbols whose values are known so far */
} qdot_state_values;

void qdot_state_values_begin(qdot_state_values *v, qdot_scene *s, bool numbers, qdot_binder bind, void *user);
void qdot_state_values_end(qdot_state_values *v);
/* From now on the symbol has this value, unless it has one. */
QDOT_MUST_CHECK qdot_status qdot_state_values_put(qdot_state_values *v, qdot_expr symbol, qdot_expr value);
/* Replace e [n] by their values. QDOT_EUNSET names a parameter without a value, QDOT_EDOMAIN: undefined there. */
QDOT_MUST_CHECK qdot_status qdot_state_values_of(qdot_state_values *v, size_t n, qdot_expr *e);

#endif
