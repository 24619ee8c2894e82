/* set.h -- reads `NAME = VALUE` for parameters, coordinates and velocities. */
#ifndef QDOT_LANG_SET_H
#define QDOT_LANG_SET_H

#include "lang/syntax/record.h"

/* What `NAME = VALUE` holds in a filled statement: a parameter or p[NAME]; q or q' of `start`; a value, an
 * expression of parameters. */
QDOT_MUST_CHECK qdot_status qdot_set_find_parameter(qdot_record *r, const qdot_filled *name,
                                                    qdot_expr *symbol);
QDOT_MUST_CHECK qdot_status qdot_set_find_jet(qdot_record *r, const qdot_filled *name, qdot_expr *jet);
QDOT_MUST_CHECK qdot_status qdot_set_find_constant(qdot_record *r, const qdot_filled *part, qdot_expr symbol,
                                                   qdot_expr *value);
/* Where units are declared: fails unless the value, a bare number being one in SI units, has the dimension of the
 * symbol. */
QDOT_MUST_CHECK qdot_status qdot_set_check_dimension(qdot_record *r, const qdot_filled *part, qdot_expr symbol,
                                                     qdot_expr value);
/* Whether the part p[NAME] is a momentum, because the script does not declare `p` itself. */
bool qdot_set_is_momentum(const qdot_session *session, const qdot_filled *part);
/* The symbol of the speed that a part of a statement names; nil: it names none. */
QDOT_MUST_CHECK qdot_status qdot_set_find_speed(qdot_record *r, const qdot_filled *part, qdot_expr *speed);
/* Find a symbol for which a run can take a value: a parameter, q, q', a momentum p[NAME] or a speed. QDOT_EINVAL: a speed
 * where the start gives velocities, or the other way round. */
QDOT_MUST_CHECK qdot_status qdot_set_find_symbol(qdot_record *r, const qdot_filled *name, qdot_expr *symbol);
/* Whether `symbol`, whose name the part is, stands elsewhere in the statement, or something in the scene depends on it;
 * QDOT_EINVAL where neither is so. */
bool qdot_set_is_read(const qdot_record *r, const qdot_filled *part, qdot_expr symbol);
QDOT_MUST_CHECK qdot_status qdot_set_need_read(qdot_record *r, const qdot_filled *part, qdot_expr symbol);
/* Numbers of runs in a value become rationals; what they make it is off by is kept, for who writes it
 * down (lang/declare/session-file). */
QDOT_MUST_CHECK qdot_status qdot_set_keep_measured(qdot_session *session, qdot_expr *value);
/* Fail with QDOT_ENAME because there is no `what` of this name; the hint is the name probably meant. */
QDOT_MUST_CHECK qdot_status qdot_set_unknown(const qdot_session *session,
                                             const char *what, const char *name);

#endif
