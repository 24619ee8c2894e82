/* foreign-words.h -- names of functions in other systems, each with the name used here. */
#ifndef QDOT_LANG_FOREIGN_WORDS_H
#define QDOT_LANG_FOREIGN_WORDS_H

/* Our function for the name of another system's, `log` for `ln`, `sin` for Sin and for itself; NULL
 * if there is none. */
const char *qdot_foreign_word(const char *name);

#endif
