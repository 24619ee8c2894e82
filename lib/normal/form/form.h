/* form.h -- polynomials of a field as expressions with the fewest operations.
 *
 * Every function gives an expression equal to the polynomial by construction.
 */
#ifndef QDOT_NORMAL_FORM_H
#define QDOT_NORMAL_FORM_H

#include <flint/fmpq.h>

#include "normal/field/polynomials.h"

/* The kinds of variables of a field, and the forms of polynomials found so far. */
typedef struct {
    qdot_field *f;
    bool *fast, *trig; /* [gens] the variable is a velocity or the like (ratio.h); is a sine or cosine */
    qdot_polynomials known;
    qdot_expr *said; /* [known.n] the shortest form found for each polynomial */
    size_t said_capacity;
    int depth, horner; /* nesting depth of products now being written; number of powers taken out of sums */
    bool quotient; /* the polynomial is the numerator of a quotient */
} qdot_form;

QDOT_MUST_CHECK qdot_status qdot_form_begin(qdot_form *form, qdot_field *f);
void qdot_form_end(qdot_form *form);

/* Write c times a polynomial: collected in velocities and accelerations, or as a product. */
qdot_expr qdot_form_say(qdot_form *form, const fmpz_mpoly_t p, const fmpq_t c);

/* Compare the forms of a quotient with *best, and keep the shortest (quotient.c). */
void qdot_form_say_quotient(qdot_form *form, const qdot_ratio *from, qdot_expr *best);

/* c r as coefficients of monomials in velocities and accelerations, each over the rest of the
 * denominator, with equal denominators together and common factors in front: the shorter of this
 * and *best (denominators.c). */
void qdot_form_say_apart(qdot_form *form, const qdot_ratio *r, const fmpq_t c,
                         qdot_expr *best);

/* Write the coefficient of a monomial in velocities; p contains no velocities or accelerations. */
qdot_expr qdot_form_coefficient(qdot_form *form, const fmpz_mpoly_t p);

/* The shortest form of a polynomial without trigonometric variables. */
qdot_expr qdot_form_plain(qdot_form *form, const fmpz_mpoly_t p);

bool qdot_form_has_trig(const qdot_form *form, const fmpz_mpoly_t p);

/* The polynomial as a sum with common powers taken out, if it has no trigonometric variables. */
qdot_expr qdot_form_horner(qdot_form *form, const fmpz_mpoly_t p);

/* c p as a sum of squares of two terms and what is left, each times c (squares.c); nil if
 * there are none. */
qdot_expr qdot_form_squares(qdot_form *form, const fmpz_mpoly_t p, const fmpq_t c);

qdot_expr qdot_form_integer(qdot_pool *pool, const fmpz_t n);

/* The shortest form of a polynomial in trigonometric variables only (trig-form.c). */
qdot_expr qdot_form_trig(qdot_form *form, const fmpz_mpoly_t p);

/* The form of p found before, nil if none; the second function stores e as the form of p and returns e. */
qdot_expr qdot_form_recall(const qdot_form *form, const fmpz_mpoly_t p);
qdot_expr qdot_form_remember(qdot_form *form, const fmpz_mpoly_t p, qdot_expr e);

/* Replace *best (nil: none yet) by the expression e if e has fewer operations. */
void qdot_form_keep(qdot_pool *pool, qdot_expr *best, qdot_expr e);

/* Write c * monomial, or a product of factors with exponents. */
qdot_expr qdot_form_monomial(qdot_field *f, const fmpq_t c, const ulong *exp);

#endif
