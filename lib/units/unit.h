/* unit.h -- units of measurement: reading [km/h], with its exact factor to SI and its dimension.
 *
 *     unit     TERM { (* | /) TERM }          after a / no * may come: J/(kg*K), not J/kg*K
 *     TERM     NAME [^ EXPONENT]   1   (unit) [^ EXPONENT]
 *     EXPONENT   2   -1   (1/2)
 *
 * A name is a row of unit.def, or a prefix and such a name. 1 unit = factor * pi^pi SI units.
 *
 * Tests  tests/units/test_unit.c
 */
#ifndef QDOT_UNITS_UNIT_H
#define QDOT_UNITS_UNIT_H

#include <flint/fmpq.h>

#include "units/dimension.h"

typedef struct {
    fmpq_t factor;
    int64_t pi;         /* the power of pi beside the factor */
    bool angle;      /* it holds rad, deg ... : of its dimension a number, yet written */
    qdot_dimension dimension;
} qdot_unit;

void qdot_unit_init(qdot_unit *unit); /* the number 1 */
void qdot_unit_clear(qdot_unit *unit);

/* Read a whole text as a unit. *at: the offset of what does not fit. QDOT_ENAME: no such unit (with the nearest as a
 * hint); QDOT_ESYNTAX; QDOT_EDOMAIN: an inexact power, or a scale with an offset such as degC. */
QDOT_MUST_CHECK qdot_status qdot_unit_read(const char *text, qdot_unit *unit, size_t *at);

/* Whether text is the name of a unit, with a prefix or without. */
bool qdot_unit_is_name(const char *text);
/* The i-th name of unit.def; NULL past the end. */
const char *qdot_unit_name_at(size_t i);

#endif
