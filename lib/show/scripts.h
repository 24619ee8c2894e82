/* scripts.h -- MathML for pages: indices and powers one above the other, brackets, functions.
 *
 * Tests  tests/show/test_page.c
 */
#ifndef QDOT_SHOW_SCRIPTS_H
#define QDOT_SHOW_SCRIPTS_H

#include "base/text.h"

/* Append MathML, [n]. A power of a name with an index, <msup><mrow><msub>A B</msub></mrow>C</msup>, becomes
 * <msubsup>A B C</msubsup>, which sets both at the same place; the power is not set behind the index.
 * Brackets about nothing high do not stretch: browsers leave room for the widest form of one that does.
 * Between a factor and a function of several letters, as in L cos u, stands a thin space. */
void qdot_page_add_mathml(qdot_text *out, const char *mathml, size_t n);

#endif
