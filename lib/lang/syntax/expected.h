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
    const qdot_token *token; /* the token that does not fit the usage */
    int node[QDOT_EXPECTED_NODES]; /* nodes of the usage automaton that may follow, including options already given */
    bool taken[QDOT_EXPECTED_NODES];
    int n;
    bool given; /* the token begins an option that has already been given */
    bool hole;  /* an expression may follow here, or would if its option were not given already */
    bool open;  /* an expression may follow here, not one of an option already given */
} qdot_expected;

/* Add to the list the words and signs that may come at this node of the usage automaton. */
void qdot_expected_add(qdot_expected *list, int node, uint64_t taken);
/* Write the words after "expected", such as "`at`, `mass` or the end", to what; returns a fitting
 * hint, or NULL. */
const char *qdot_expected_words(const qdot_expected *list, char what[QDOT_EXPECTED_TEXT]);
/* The message if a statement ends without the required clause that begins with `word`; NULL: the general message. */
const char *qdot_expected_clause(const char *statement, const char *word);
/* Whether a row of expected.def refuses the token here; if so the failure is recorded. */
bool qdot_expected_refuses(const qdot_expected *list, const qdot_record *r);

#endif
