/* letters.h -- the letters allowed in names, and the spelling of Greek ones. */
#ifndef QDOT_LANG_LETTERS_H
#define QDOT_LANG_LETTERS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/text.h"

/* The spelled name of a Greek letter ("theta"), NULL if c is none. */
const char *qdot_letters_greek(uint32_t c);
/* Whether c is a Latin letter. */
bool qdot_letters_latin(uint32_t c);
/* The digit 0-9 of which c is the subscript, or the superscript; -1 if c is neither. */
int qdot_letters_subscript(uint32_t c);
int qdot_letters_superscript(uint32_t c);
/* How many dots the letter that text begins with carries, ẋ 1, ẍ 2; *letter the one below them. ä, ë,
 * ï, ö, ü, ÿ are letters of names, and have none. */
unsigned qdot_letters_dotted(const char *text, const char **letter);

/* What a name with a subscript such as `x₁` may stand for if x1 is not declared: form 0 "x[1]",
 * form 1 "x_1". False: neither. */
bool qdot_subscript_means(const char *name, unsigned form, qdot_text *spelled);

#endif
