/* names.h -- where the names of a script are declared, and where they stand.
 *
 * A name in Greek letters and its spelled form are one. Arguments of functions and indices of loops are names of their
 * statement or block only. dtheta and deltatheta are places of the coordinate theta.
 *
 * Tests  tests/lang/analysis/test_analysis.c, tests/meta/lsp.test
 */
#ifndef QDOT_LANG_NAMES_OF_TEXT_H
#define QDOT_LANG_NAMES_OF_TEXT_H

#include "lang/analysis/analysis.h"

typedef enum {
    QDOT_ROLE_UNKNOWN,
    QDOT_ROLE_PARAMETER,
    QDOT_ROLE_COORDINATE,
    QDOT_ROLE_FUNCTION,
    QDOT_ROLE_VALUE,
    QDOT_ROLE_LABEL,
    QDOT_ROLE_RUN,  /* a run or table */
    QDOT_ROLE_LOCAL /* an argument or index */
} qdot_role;

/* A place where a name stands. */
typedef struct {
    const char *name;  /* as the language spells it; borrowed from the source */
    qdot_stretch at;   /* without the d of dtheta */
    size_t piece;      /* the statement in which it stands */
    qdot_role role;
    bool declares;
    bool weak; /* it is LOCAL only if nothing else has its name: the index of a loop, the variable of an integral */
} qdot_occurrence;

typedef qdot_vec(qdot_occurrence) qdot_occurrence_list;

/* All places of names of the source, in order; words of the language and names that nobody declares are among them with the
 * role UNKNOWN. The caller frees list->at. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_names_of_source(const qdot_analysis *a, const qdot_source *source, qdot_occurrence_list *list);
/* The place that contains byte `at` or ends there; NULL: there is none. */
const qdot_occurrence *qdot_names_at_byte(const qdot_occurrence_list *list, size_t at);
/* Whether two places are of one name. */
bool qdot_names_are_same(const qdot_occurrence *a, const qdot_occurrence *b);

/* Whether the name at byte `at` can be renamed; *at_name: where it stands. QDOT_ENAME: it is a word of the language, or
 * nobody declares it in this text. */
QDOT_MUST_CHECK qdot_status qdot_names_renameable(const qdot_analysis *a, size_t at, qdot_occurrence *found);
/* The places of the text at which `name` is to be put in place of the name at byte `at`. QDOT_ENAME: as above, or the new name is none, is a word of the
 * language, is taken, or the text would not mean the same. The caller frees places->at. */
QDOT_MUST_CHECK qdot_status qdot_names_rename(const qdot_analysis *a, size_t at, const char *name, qdot_occurrence_list *places);

#endif
