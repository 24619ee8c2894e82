/* holes.h -- what the holes of usage texts take.
 *
 * A hole is named by its usage: EXPR, NAME, T0..T1, "FILE". Its row of holes.def says how it is
 * read, what is said where something else stands there, and what TAB offers.
 */
#ifndef QDOT_LANG_HOLES_H
#define QDOT_LANG_HOLES_H

/* How the tokens of a placeholder ("hole") of a usage text are parsed; they are evaluated later. */
typedef enum {
    QDOT_HOLE_SIDE,       /* an expression SIDE, which ends before a relation, `and` or `or` */
    QDOT_HOLE_VALUE,      /* an expression, which may contain relations, `and`, `or` */
    QDOT_HOLE_CONDITION,  /* SIDE = SIDE, `returns after SIDE`, or several joined by `and` */
    QDOT_HOLE_PERIOD,     /* SIDE behind `returns after`, to which conditions may be joined by `and` */
    QDOT_HOLE_EQUATION,   /* SIDE = SIDE, or one expression that is an equation */
    QDOT_HOLE_COMPARISON, /* as QDOT_HOLE_EQUATION, also with == < <= > >= */
    QDOT_HOLE_RANGE,      /* a range SIDE..SIDE */
    QDOT_HOLE_VALUES,     /* a range SIDE..SIDE, or a single SIDE */
    QDOT_HOLE_TUPLE,      /* (SIDE, SIDE, ...), with as many entries as the text of the placeholder has */
    QDOT_HOLE_CURVE,      /* SIDE, or drift(SIDE, ...) with its further arguments */
    QDOT_HOLE_NAME,       /* a name, which may have indices: name[SIDE, ...] */
    QDOT_HOLE_ROWS,       /* the name of an existing table of rows */
    QDOT_HOLE_DOMAIN,     /* a new name with its bounds: SIDE < name < SIDE */
    QDOT_HOLE_COORDINATE, /* a name with its bounds, and with primes */
    QDOT_HOLE_CALL,       /* a name with argument names: name(name, ...) */
    QDOT_HOLE_BODY, /* an expression that may contain the arguments of the NAME(...) before it */
    QDOT_HOLE_WORD,       /* a single name */
    QDOT_HOLE_TOPIC,      /* a single name, a text in quotes or % */
    QDOT_HOLE_TEXT        /* a quoted text */
} qdot_hole_class;

typedef struct {
    const char *statement, *before, *text; /* statement, word before, and text of the placeholders; NULL: any */
    qdot_hole_class class;
    const char *expected; /* what should stand for the placeholder, in words, for messages */
} qdot_hole;

/* The index of the row for a placeholder of that statement, after that word of its usage; there always is one. */
int qdot_hole_find(const char *statement, const char *before, const char *text);
const qdot_hole *qdot_hole_at(int row);

#endif
