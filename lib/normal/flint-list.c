/* flint-list.c -- where FLINT keeps its spare integers; a program that loads FLINT late brings its
 * own (src/late.c), which is why this stands alone. */
#include "normal/flint.h"

/* FLINT exports them, though no header declares them; configure looks for them. */
extern _Thread_local __mpz_struct **mpz_free_arr;
extern _Thread_local ulong mpz_free_num, mpz_free_alloc;

void
qdot_flint_list(qdot_flint_spare *list)
{
    *list = (qdot_flint_spare){&mpz_free_arr, &mpz_free_num, &mpz_free_alloc};
}
