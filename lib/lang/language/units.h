/* units.h -- units in expressions: 9.81 [m/s^2], and E in [km/h] behind a whole expression.
 *
 * A unit follows a number, `pi`, or a closing bracket, with a blank between (behind a number also without). Its tokens are
 * read as one text by units/unit.h.
 */
#ifndef QDOT_LANG_LANGUAGE_UNITS_H
#define QDOT_LANG_LANGUAGE_UNITS_H

#include "lang/language/compiled.h"
#include "lang/language/machine.h"
#include "units/unit.h"

/* Read the unit in the brackets that open at the token: its value as an expression, whether it is one of angles. *blame:
 * the token that an error is about. */
QDOT_MUST_CHECK qdot_status qdot_read_unit(qdot_session *session, const qdot_token *open, qdot_expr *value, bool *angle,
                                           const qdot_token **blame);
/* Whether the token opens a unit behind `pi` or a bracket. */
bool qdot_unit_follows(const qdot_token *t);
/* Parse the unit that opens at the cursor, behind a number, `pi` or a bracket. below: a `/` or `^` stands before that, so
 * that a unit behind a number is refused: 1/2 [m] may mean (1/2) [m] or 1/(2 [m]). */
QDOT_MUST_CHECK qdot_status qdot_unit_parse(qdot_cursor *c, bool below, qdot_postfix_list *program);
/* Parse a unit that stands for itself, as in `coord x [m]`. */
QDOT_MUST_CHECK qdot_status qdot_unit_parse_alone(qdot_cursor *c, qdot_postfix_list *program);
/* Parse `in [UNIT]` at the cursor, if it is there. */
QDOT_MUST_CHECK qdot_status qdot_unit_parse_in(qdot_cursor *c, qdot_postfix_list *program);

/* Multiply the value on top of the stack by the unit, or divide it by it, for `in`. */
QDOT_MUST_CHECK qdot_status qdot_machine_unit(qdot_machine *m, const qdot_postfix *code);
/* Where units are used: the top n values are summands; so are the arguments of the machine, terms of sum( ); the two sides of a
 * relation; a new value agrees in itself. */
QDOT_MUST_CHECK qdot_status qdot_machine_units_sum(qdot_machine *m, size_t n);
QDOT_MUST_CHECK qdot_status qdot_machine_units_terms(qdot_machine *m);
QDOT_MUST_CHECK qdot_status qdot_machine_units_relation(qdot_machine *m, const qdot_token *relation);
QDOT_MUST_CHECK qdot_status qdot_machine_units_value(qdot_machine *m);

/* The numbers *value that the function `name` gives of its arguments, such as value(x, 3), have the units of these. */
QDOT_MUST_CHECK qdot_status qdot_units_of_call(qdot_session *session, const char *name, uint32_t n, const qdot_expr *args,
                                               qdot_expr *value);

/* The bracket of the unit that ends the expression: of `0.5 [m]`, and of `E in [m]` if `in` is asked for; NULL: none. */
const qdot_token *qdot_compiled_unit(const qdot_compiled *program, bool in);

#endif
