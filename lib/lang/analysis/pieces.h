/* pieces.h -- divides a source into statements and blocks.
 *
 * Tests  tests/lang/analysis/test_analysis.c
 */
#ifndef QDOT_LANG_PIECES_H
#define QDOT_LANG_PIECES_H

#include "lang/analysis/analysis.h"

typedef qdot_vec(qdot_piece) qdot_piece_list;

/* Append the pieces of a source, in order; the caller frees pieces->at. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_pieces_of(const qdot_source *source, qdot_piece_list *pieces);

#endif
