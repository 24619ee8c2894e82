/* print.h -- expressions as text.
 *
 *   plain    parses back to the same expression: 1/2*m*r'^2, diff(x(s, t), s), delta[theta]
 *   unicode  for a terminal: ½ m ṙ², ∂x/∂s, δθ
 *   latex    \frac{1}{2} m \dot{r}^{2}
 *   mathml   presentation MathML, the contents of <math>: <msup><mi>r</mi><mn>2</mn></msup>
 */
#ifndef QDOT_EXPR_PRINT_H
#define QDOT_EXPR_PRINT_H

#include "expr/print-name.h"

/* Append e as text in that style. Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_print(const qdot_pool *pool, qdot_expr e, qdot_style style,
                                       qdot_text *out);

/* As qdot_print, for a series in the symbols of the LIST `in`: terms of lowest degree first. */
QDOT_MUST_CHECK qdot_status qdot_print_series(const qdot_pool *pool, qdot_expr e, qdot_expr in,
                                              qdot_style style, qdot_text *out);

#endif
