/* taylor-text.h -- machine code of a Taylor program as memory: written once, run by all programs
 * of the same shape. Internal to series/.
 *
 * Code depends on the operations of a program and on what they read and write, not on any number
 * (taylor-code.h), nor on the order but by how many vectors a sum has: how often each loop is run
 * stands in the work space. Loops of narrow vectors are those of any lower order too, which leaves
 * before the first that it has not. Runs of a scene, their companions, runs of a sweep, and pieces between
 * events want the same again and again: the last few that were written are kept. Any thread may take
 * and give.
 *
 * Tests  tests/series/test_taylor-code.c
 */
#ifndef QDOT_SERIES_TAYLOR_TEXT_H
#define QDOT_SERIES_TAYLOR_TEXT_H

#include <stdatomic.h>

#include "series/taylor-steps.h"

/* How the orders of an expansion are divided among the loops of machine code (taylor-code.c). */
typedef struct {
    int lanes, lag;
    bool as_they_stand;
} qdot_taylor_loops;

/* Orders 1 ... to are wanted; the code may serve orders up to `most`. */
typedef struct {
    int to, most;
} qdot_taylor_orders;

typedef struct {
    uint32_t *key; /* [length] the words that identify the program for which the code was generated */
    size_t length;
    void *memory;
    size_t size, used; /* bytes of the memory block; bytes of the code in it */
    size_t begin;      /* offset of the function that computes order 0 */
    qdot_taylor_loops loops;
    int from, to; /* lowest and highest order of the expansions that this code can make */
    bool exact;   /* at low orders integrals use factors in two doubles */
    size_t doubles;    /* number of doubles of work space that the code needs */
    uint32_t *blocks;  /* [blocks] index in the work space at which the matrices of each block begin */
    atomic_uint users;
} qdot_taylor_text;

/* Of these orders of a program: one that is kept, its `memory` there, to be read only, or an
 * empty one that has the key alone. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_taylor_text_take(const qdot_taylor *t,
                                                  qdot_taylor_orders orders,
                                                  qdot_taylor_text **text);
/* Fill an empty one. Memory is written or run, never both. False: the system does not let it
 * be run. */
bool qdot_taylor_text_fill(qdot_taylor_text *text, const unsigned char *code, size_t n);
/* Put a completed text (generated machine code) into the cache. */
void qdot_taylor_text_keep(qdot_taylor_text *text);
/* The address of the first instruction of a text (generated machine code). */
const unsigned char *qdot_taylor_text_first(const qdot_taylor_text *text);
/* Give back a text (generated machine code) that was taken. NULL is ignored. */
void qdot_taylor_text_give(qdot_taylor_text *text);

#endif
