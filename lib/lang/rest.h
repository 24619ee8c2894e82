/* rest.h -- rest lengths of springs by the values of the moment. */
#ifndef QDOT_LANG_REST_H
#define QDOT_LANG_REST_H

#include "lang/number.h"

/* Whether a rest length, with the values of `set` put in, is a negative number. One that holds
 * coordinates, t or parameters without a value is none. QDOT_EINVAL names the spring (NULL: one
 * without a name) and the number. Tests: tests/bad/rest-negative*.lag. */
QDOT_MUST_CHECK qdot_status qdot_rest_check(qdot_session *session, const char *spring,
                                            qdot_expr rest);

/* The same of every spring of the scene as it would be under these values, which come before
 * those of `set`; c->error_at is then the place of the one that makes it negative. */
QDOT_MUST_CHECK qdot_status qdot_rest_check_values(qdot_cursor *c,
                                                   const qdot_number_pairs *values);

#endif
