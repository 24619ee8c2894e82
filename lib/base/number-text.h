/* number-text.h -- writes floating-point numbers for human readers and for JSON. */
#ifndef QDOT_BASE_NUMBER_TEXT_H
#define QDOT_BASE_NUMBER_TEXT_H

#include <stdbool.h>

#include "base/text.h"

/* Append a double for human readers: only the digits that its error leaves meaningful. */
void qdot_number_text(qdot_text *text, double value, double error);
/* Append a double as qdot_number_text does, but "unknown" where the error leaves no digit: above half of max(1,
 * |value|). */
bool qdot_number_is_known(double value, double error);
void qdot_number_text_known(qdot_text *text, double value, double error);
/* Append an error bound, one digit, rounded up: 3e-13. */
void qdot_number_text_bound(qdot_text *text, double error);
/* Append the error of the number before it, " ± 3e-13"; NaN: " (error unknown)", 0: nothing. */
void qdot_number_text_error(qdot_text *text, double error);
/* Append a double with its error behind it, as "1.25 ± 3e-13"; error NaN: " (error unknown)". */
void qdot_number_text_with_error(qdot_text *text, double value, double error);
/* Append a double with two digits of its standard error: "2.3855 ± 0.0012"; error NaN: " ± unknown". */
void qdot_number_text_estimate(qdot_text *text, double value, double error);
/* Append a double for JSON: the fewest digits that read back the same, null where it is not finite. */
void qdot_number_text_json(qdot_text *text, double value);

#endif
