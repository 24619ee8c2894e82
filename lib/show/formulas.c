/* formulas.c -- the script of pages with MathML that helps browsers without a mathematical font. */
#include "show/formulas.h"

static const char program[] = {
#include "show/formulas-js.inc"
};

void
qdot_formulas_foot(qdot_text *out)
{
    qdot_text_add(out, "<script>\n");
    qdot_text_add(out, program);
    qdot_text_add(out, "</script>\n");
}
