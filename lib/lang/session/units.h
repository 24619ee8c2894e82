/* units.h -- the units of a session: what has been said of the dimensions of its names.
 *
 * Nothing is done before a unit is written. From then on each statement adds facts: that two expressions are of one
 * dimension, that one has a certain dimension. They are kept in a list, which `undo` shortens, and from which the
 * solver (dimensions/dimensions.h) is made again where facts have gone.
 */
#ifndef QDOT_LANG_SESSION_UNITS_H
#define QDOT_LANG_SESSION_UNITS_H

#include "base/memory.h"
#include "dimensions/dimensions.h"
#include "lang/session/parts.h"

typedef enum { QDOT_FACT_BEGIN, QDOT_FACT_VISIT, QDOT_FACT_JOIN, QDOT_FACT_FIX, QDOT_FACT_ANGLE, QDOT_FACT_SCALED, QDOT_FACT_SCENE } qdot_unit_fact_kind;

/* One fact; SCENE: what was declared before the first unit has been added. The fields that its kind does not use are 0. */
typedef struct {
    qdot_expr a, b;
    qdot_dimension is;
    uint32_t kind; /* a qdot_unit_fact_kind */
} qdot_unit_fact;

typedef struct qdot_units {
    qdot_vec(qdot_unit_fact) facts; /* the first is BEGIN */
    qdot_dimensions *known;         /* the solver; NULL: not made yet */
    size_t done;                    /* number of facts that it has */
    bool disagreed;                 /* the latest fact contradicted those before */
} qdot_units;

void qdot_units_clear(qdot_units *units);
/* Whether a unit has been written in the session. */
bool qdot_units_on(const qdot_session *session);
/* From now on dimensions count: the first unit has been written. */
QDOT_MUST_CHECK qdot_status qdot_units_begin(qdot_session *session);
/* Add what the scene and the definitions say that were there before the first unit; a failure names what does not agree. */
QDOT_MUST_CHECK qdot_status qdot_units_of_scene(qdot_session *session);
/* Drop all but the first n facts. */
void qdot_units_back_to(qdot_session *session, size_t n);

/* As the functions of dimensions.h, and kept as facts. Without units they do nothing. */
QDOT_MUST_CHECK qdot_status qdot_units_visit(qdot_session *session, qdot_expr e);
QDOT_MUST_CHECK qdot_status qdot_units_join(qdot_session *session, qdot_expr a, qdot_expr b, const char *format);
QDOT_MUST_CHECK qdot_status qdot_units_fix(qdot_session *session, qdot_expr e, qdot_dimension is, const char *format);
/* e is of the dimension of the stated Lagrangian, which may be one for a unit of mass; where none is stated, an energy. */
QDOT_MUST_CHECK qdot_status qdot_units_energy(qdot_session *session, qdot_expr e, const char *format);
/* The symbol is an angle: its unit is written, as rad. */
QDOT_MUST_CHECK qdot_status qdot_units_angle(qdot_session *session, qdot_expr symbol);
/* The symbols that are summands of the argument of a sine, cosine or tangent, up to a number, are angles. */
QDOT_MUST_CHECK qdot_status qdot_units_angles_in(qdot_session *session, qdot_expr argument);
/* e is a time: one with its unit, or a bare number, in s. */
QDOT_MUST_CHECK qdot_status qdot_units_time(qdot_session *session, qdot_expr e);

/* Whether the failure at hand is of dimensions that do not agree; it is asked once. */
bool qdot_units_take_disagreement(qdot_session *session);

/* The symbol was declared in a unit that is not 1 in SI units, such as cm or deg; whether it was, or is a derivative. */
QDOT_MUST_CHECK qdot_status qdot_units_scaled(qdot_session *session, qdot_expr symbol);
bool qdot_units_is_scaled(const qdot_session *session, qdot_expr symbol);

/* What is known of a symbol of the session is that of its copy in another, too. */
QDOT_MUST_CHECK qdot_status qdot_units_transfer(qdot_session *from, qdot_expr symbol, qdot_session *to, qdot_expr copy);

/* The dimension of e; NONE without units. */
qdot_dimension_state qdot_units_of(qdot_session *session, qdot_expr e, qdot_dimension *dimension);
/* Append the unit in which numbers of e are given, as "m/s" or "rad"; nothing: a number, or not known. */
void qdot_units_label(qdot_session *session, qdot_expr e, qdot_text *out);
/* The same as a string, which is to be freed; *label NULL: nothing. */
QDOT_MUST_CHECK qdot_status qdot_units_label_of(qdot_session *session, qdot_expr e, char **label);
/* The same in brackets: " [m/s]". */
void qdot_units_in_brackets(qdot_session *session, qdot_expr e, qdot_text *out);
/* Append the dimension of e in words: "a force", "an angular velocity"; where it is FREE, in terms of those of other names.
 * Returns what is known of it; nothing is appended where e is 0 or has none. */
qdot_dimension_state qdot_units_words(qdot_session *session, qdot_expr e, qdot_text *out);
/* As qdot_dimensions_groups. */
QDOT_MUST_CHECK qdot_status qdot_units_groups(qdot_session *session, size_t n, const qdot_expr *x, size_t *count,
                                              int32_t **power);

/* The SI unit of a dimension as an expression of base units, whose numbers are 1. */
QDOT_MUST_CHECK qdot_status qdot_units_base(qdot_session *session, qdot_dimension dimension, qdot_expr *unit);
/* Bare numbers in *value, one or a list, are rates: they get the unit 1/s. Without units nothing is done. */
QDOT_MUST_CHECK qdot_status qdot_units_give_rate(qdot_session *session, qdot_expr *value);

#endif
