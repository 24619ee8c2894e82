/* expected.h -- what to say of a token that does not fit.
 *
 *   `=`, if it may come, unless it is optional
 *   else words of options and clauses, as the usage names them    "`tol`, `method` or `as`"
 *   else the end, if it may come                                  "the end of the statement"
 *   else a sign, else what the hole takes                         "`:`", "a name"
 *
 * A row of expected.def replaces that for a statement, behind a word of it.
 */
#ifndef QDOT_LANG_EXPECTED_H
#define QDOT_LANG_EXPECTED_H

#include "lang/syntax/record.h"

enum { QDOT_EXPECTED_TEXT = 256, QDOT_EXPECTED_NODES = 32 };

typedef struct {
    const qdot_usage *usage;
    const qdot_token *token; /* the token that does not fit */
    int node[QDOT_EXPECTED_NODES]; /* nodes that may follow, including options already given */
    bool taken[QDOT_EXPECTED_NODES];
    int n;
    bool given; /* the token begins an option that has already been given */
    bool hole;  /* an expression may follow here, or belongs to an option already given */
    bool open;  /* an expression may follow here */
} qdot_expected;

/* Add the words and signs that may come at this node of the usage. */
void qdot_expected_add(qdot_expected *list, int node, uint64_t taken);
/* Write the words after "expected", such as "`at`, `mass` or the end", to what; returns a fitting
 * hint, or NULL. */
const char *qdot_expected_words(const qdot_expected *list, char what[QDOT_EXPECTED_TEXT]);
/* The message at the end of a statement in which the clause of that word is missing; NULL: the general one. */
const char *qdot_expected_clause(const char *statement, const char *word);
/* Whether a row of expected.def refuses the token here; the failure is then set. */
bool qdot_expected_refuses(const qdot_expected *list, const qdot_record *r);

#endif
