/* names.h -- the names of a session and their meanings.
 *
 * A name is its canonical text: "theta", "theta[1]", "A[1,2]". Labels are not here (mech/scene/scene.h).
 */
#ifndef QDOT_LANG_NAMES_H
#define QDOT_LANG_NAMES_H

#include "base/memory.h"
#include "expr/id.h"
#include "lang/session/function-body.h"

typedef enum {
    QDOT_NAME_PARAM,    /* a parameter; value: its symbol */
    QDOT_NAME_COORD,    /* a coordinate; value: its symbol */
    QDOT_NAME_UFUN, /* an undefined function; ufun: its id; value: it applied to its declared arguments */
    QDOT_NAME_VALUE,    /* a defined name; value: any expression */
    QDOT_NAME_FUNCTION, /* formals: a LIST of symbols; body: its text; value: a LIST of the
                         * values of body->captured */
    QDOT_NAME_SPEED,    /* a speed (quasi-velocity); value: its symbol; formals: a LIST of one, what it is in velocities */
    QDOT_NAME_INDEX,    /* a loop or sum index; value: its present number; hides outer names */
    QDOT_NAME_ARGUMENT  /* a function argument; value: the one in the call; hides outer names */
} qdot_name_kind;

typedef struct {
    char *name;
    qdot_name_kind kind;
    qdot_expr value, formals;
    qdot_expr over; /* for VALUE: a LIST of coordinates by which its entries are indexed; nil: none */
    uint32_t ufun;
    qdot_function_body *body;   /* for FUNCTION and VALUE: the defining text; for a UFUN with values from a table: the statement `data` from the name on */
    const char *label; /* for ARGUMENT: label of the particle or body whose position it is; NULL: none */
    char *file; /* file in which the name was declared; owned */
    uint32_t line, column; /* where in the file; 0: not known */
    bool routhian; /* a Routhian of a former scene, with its momenta as parameters: every `reset scene` keeps it */
} qdot_name;

typedef struct qdot_names qdot_names;

qdot_names *qdot_names_new(void);
void qdot_names_free(qdot_names *names);

/* The innermost meaning of a name; NULL if it has none. Valid until the next change. */
const qdot_name *qdot_names_find(const qdot_names *names, const char *name);
/* The declared meaning of a name, regardless of temporary bindings; NULL if there is none. */
const qdot_name *qdot_names_declared(const qdot_names *names, const char *name);
/* The first declared member NAME[...]; NULL if there is none. */
const qdot_name *qdot_names_first_member(const qdot_names *names, const char *family);
/* Whether any member NAME[...] is declared. */
bool qdot_names_is_family(const qdot_names *names, const char *name);
/* Declare. A VALUE or FUNCTION replaces a VALUE or FUNCTION; the very same PARAM again is
 * allowed (its value changes); any other clash, a family and a plain name of one spelling ("a name is
 * never both" vector and family), reserved names (pi, t, p[..] Q[..] lambda[..] delta[..], dNAME of a coordinate):
 * QDOT_ENAME with where it was declared. `entry` is copied, with one more use of
 * its body. */
QDOT_MUST_CHECK qdot_status qdot_names_declare(qdot_names *names, const qdot_name *entry);
/* Replace the expressions of a declared name, which keeps its kind. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_names_update(qdot_names *names, const char *name,
                                              qdot_expr value, qdot_expr formals);
void qdot_names_remove(qdot_names *names, const char *name);
/* _push: bind an index or formal argument, hiding outer meanings of its name; _pop: end the latest binding. */
QDOT_MUST_CHECK qdot_status qdot_names_push(qdot_names *names, const char *name,
                                            qdot_expr value);
void qdot_names_pop(qdot_names *names);
/* Bind a formal argument; `label` is borrowed and must outlive the binding. */
QDOT_MUST_CHECK qdot_status qdot_names_push_argument(qdot_names *names, const char *name,
                                                     qdot_expr value, const char *label);
/* Hide what is bound so far, for the body of a function; returns what disclose() takes, which
 * shows it again and unbinds what was bound since. */
size_t qdot_names_enclose(qdot_names *names);
void qdot_names_disclose(qdot_names *names, size_t outer);
/* A declared name is never changed: another one takes its place. So a list of names is a state that
 * can be kept: one use more of each, then back to exactly this list, in this order; release gives
 * one use back. restore() cannot fail for names that were declared here. */
const qdot_name *qdot_names_keep(const qdot_name *declared);
void qdot_names_release(const qdot_name *declared);
void qdot_names_restore(qdot_names *names, size_t n, const qdot_name *const *list);
/* How many names at the beginning have not changed since the last call of settle or restore; mark
 * all as unchanged. */
size_t qdot_names_settled(const qdot_names *names);
void qdot_names_settle(qdot_names *names);
/* Name number i in order of declaration (without loop indices); NULL past the end. */
const qdot_name *qdot_names_at(const qdot_names *names, size_t i);
/* The declared or known name nearest in spelling (edit distance), NULL if none is near. `extra` [n]:
 * further candidates. */
const char *qdot_names_nearest(const qdot_names *names, const char *name, size_t n,
                               const char *const *extra);
#endif
