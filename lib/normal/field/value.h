/* value.h -- computes the values of nodes in a field, in one pass, children first. */
#ifndef QDOT_NORMAL_VALUE_H
#define QDOT_NORMAL_VALUE_H

#include "normal/field/ratio.h"

/* Fill f->value and the rules of roots. Errors: QDOT_ENOMEM, the pool's; a stop of the
 * field is not an error. */
QDOT_MUST_CHECK qdot_status qdot_value_all(qdot_field *f);

#endif
