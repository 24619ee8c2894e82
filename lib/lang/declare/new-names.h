/* new-names.h -- names that a statement declares, each with its domain.
 *
 * All are read before the first is declared; if one of them cannot be, those before it are taken back.
 */
#ifndef QDOT_LANG_NEW_NAMES_H
#define QDOT_LANG_NEW_NAMES_H

#include "lang/syntax/record.h"

typedef struct {
    const char *name;
    const qdot_token *start;
    qdot_expr lo, hi; /* nil: not declared */
    bool lo_open, hi_open;
    bool own;        /* the domain was declared for this name, or taken over from a later name of the list */
    qdot_expr value; /* nil: not declared */
    qdot_expr unit;  /* the unit, as an expression; nil: not declared */
    bool angle;      /* it is one of angles */
} qdot_new_name;

typedef qdot_vec(qdot_new_name) qdot_new_names;

/* The names of `param` or `coord`; free list->at in any case. Of parameters a sign spreads to the bare names before
 * it, and a value may use those before it. */
QDOT_MUST_CHECK qdot_status qdot_new_names_read(qdot_record *r, bool params, qdot_new_names *list);
/* Declare all names of the list; a parameter may have been declared before with the same domain. */
QDOT_MUST_CHECK qdot_status qdot_new_names_declare(qdot_cursor *c, qdot_name_kind kind,
                                                   const qdot_new_names *list);

#endif
