/* undo-state.h -- the state of a session as arrays of items that are copied byte by byte.
 *
 * Inside of lang/session/undo. A qdot_scene_part says where an array is, in the session or in a copy; runs and
 * names count who uses them. */
#ifndef QDOT_LANG_UNDO_STATE_H
#define QDOT_LANG_UNDO_STATE_H

#include "expr/print-name.h"
#include "lang/session/history.h"
#include "lang/session/names.h"
#include "lang/session/parts.h"
#include "mech/scene/scene.h"

enum { /* numbered after the parts of the scene */
    QDOT_UNDO_SET_SYMBOLS = QDOT_SCENE_PARTS,
    QDOT_UNDO_SET_VALUES,
    QDOT_UNDO_START_SYMBOLS,
    QDOT_UNDO_START_VALUES,
    QDOT_UNDO_START_ERRORS,
    QDOT_UNDO_SCALE_SYMBOLS,
    QDOT_UNDO_SCALE_VALUES,
    QDOT_UNDO_UNITS,
    QDOT_UNDO_HISTORY,
    QDOT_UNDO_HISTORY_OVER,
    QDOT_UNDO_RUNS,
    QDOT_UNDO_TABLES,
    QDOT_UNDO_NAMES,
    QDOT_UNDO_PARTS
};

/* The parts of the session's state that are not arrays. */
typedef struct {
    qdot_expr lagrangian, higher_lagrangian, hamiltonian, series, series_in;
    qdot_expr steady_in, modes_at;
    uint64_t modes_version;
    qdot_linear linear;
    qdot_style style;
    bool flat, timing, start_exactly;
} qdot_undo_single;

typedef struct {
    unsigned char *at;
    size_t n, capacity;
} qdot_undo_array;

/* A copy of a session's state. */
typedef struct {
    qdot_undo_array part[QDOT_UNDO_PARTS];
    qdot_undo_single single;
    qdot_vec(const qdot_name *) names; /* the session's own names, in order; not copied */
} qdot_undo_state;

/* The address of part k of the session (of names: the list in *state); the items of a part; the
 * parts that are no arrays. */
qdot_scene_part qdot_undo_part(qdot_session *s, qdot_undo_state *state, int k);
unsigned char *qdot_undo_items(const qdot_scene_part *part);
qdot_undo_single qdot_undo_single_of(const qdot_session *s);

/* Raise (more) or lower by one the reference count of each item of a part of the state. */
void qdot_undo_count(int part, const unsigned char *at, size_t n, bool more);
/* Copy one item of a part into *to, which the caller owns, with references of its own. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_undo_copy(int part, const unsigned char *from, size_t n,
                                           size_t size, unsigned char **to);
/* Allocate memory for n items in a part of the state. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_undo_make_room(qdot_scene_part *part, size_t n);
/* Replace the items [at, at + gone) of a part of the state by `come` items of `in`; there must be room. */
void qdot_undo_splice(const qdot_scene_part *part, size_t at, size_t gone,
                      const unsigned char *in, size_t come);
/* As qdot_undo_splice, in a copy of the state, which counts its references separately. */
void qdot_undo_splice_kept(qdot_undo_state *kept, int k, size_t size, size_t at,
                           size_t gone, const unsigned char *in, size_t come);
void qdot_undo_clear(qdot_undo_state *state);

#endif
