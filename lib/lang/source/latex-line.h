/* latex-line.h -- translates a line of LaTeX into the language of the program, for a hint. */
#ifndef QDOT_LANG_LATEX_LINE_H
#define QDOT_LANG_LATEX_LINE_H

#include "base/text.h"

/* `\frac{1}{2} m \dot{x}^2` as `1/2*m*x'^2`: fractions, roots, dots, Greek letters, functions,
 * products without a sign. What is not known is left out. [from, to): one line. */
void qdot_latex_line(const char *from, const char *to, qdot_text *out);

#endif
