/* dimension.h -- dimensions of quantities: products of powers of the seven base quantities.
 *
 *     length^a1 mass^a2 time^a3 current^a4 temperature^a5 amount^a6 intensity^a7
 *
 * with rational exponents. An angle is a number. The exponents of a dimension that was made here are in lowest terms with
 * positive denominators, so equal dimensions have equal fields.
 *
 * Tests  tests/units/test_unit.c
 */
#ifndef QDOT_UNITS_DIMENSION_H
#define QDOT_UNITS_DIMENSION_H

#include <stdint.h>

#include "base/text.h"

enum { QDOT_BASES = 7 };

/* The rational number n/d. */
typedef struct {
    int32_t n, d;
} qdot_exponent;

typedef struct {
    qdot_exponent of[QDOT_BASES]; /* of length, mass, time, current, temperature, amount, intensity */
} qdot_dimension;

/* n/d in lowest terms. */
qdot_exponent qdot_exponent_make(int64_t n, int64_t d);
/* a + b*c. A number too large for its field gives one with d = 0, which absorbs. */
qdot_exponent qdot_exponent_addmul(qdot_exponent a, qdot_exponent b, qdot_exponent c);

/* The dimension with these integer exponents. */
qdot_dimension qdot_dimension_make(const int exponent[QDOT_BASES]);
/* The dimension of a number. */
qdot_dimension qdot_dimension_none(void);
/* The dimension of A B^x, A and B being quantities of the dimensions a and b. */
qdot_dimension qdot_dimension_addmul(qdot_dimension a, qdot_dimension b, qdot_exponent x);
bool qdot_dimension_is_none(qdot_dimension a);
bool qdot_dimension_equal(qdot_dimension a, qdot_dimension b);
/* Whether an exponent became too large. */
bool qdot_dimension_failed(qdot_dimension a);

/* Append the name of the dimension: "a force"; of one without a name "a quantity in kg*m^3/s". */
void qdot_dimension_words(qdot_dimension a, qdot_text *out);
/* Append the SI unit: "N", "kg*m^3/s"; nothing for a number. */
void qdot_dimension_unit(qdot_dimension a, qdot_text *out);
/* Append the SI unit, of base units alone: "kg*m/s^2". */
void qdot_dimension_base_unit(qdot_dimension a, qdot_text *out);

#endif
