/* analysis.h -- what a script that is being written says: its statements, their faults, what they declare.
 *
 * The statements of a text are carried out one after another in a session of the analysis' own, as at the prompt, but for
 * those that take long, write files or show pictures: runs, sweeps, fits, plots, exports. These are parsed, and
 * the names in their expressions looked up. After a change of the text the session is taken back to the first statement that
 * is another one, and goes on from there. A statement that fails is told, and the next is read.
 *
 * What a statement is allowed to cost is a number of steps of work, so that the same text has the same remarks on
 * every machine; a question that needs more goes without an answer. What depends on a statement that was not carried out (a number read
 * from a run) is parsed only.
 *
 * Nothing is written to a file.
 *
 * Tests  tests/lang/analysis/test_analysis.c, tests/meta/lsp.test
 */
#ifndef QDOT_LANG_ANALYSIS_H
#define QDOT_LANG_ANALYSIS_H

#include "base/text.h"
#include "lang/analysis/remark.h"
#include "lang/session/text-list.h"
#include "lang/session/parts.h"
#include "lang/source/token.h"

/* What is known behind a statement; positions in lists that grow. */
typedef struct {
    size_t remarks;  /* number of remarks on the statements up to here */
    size_t undo;     /* number of records for undo */
    size_t told;     /* number of notices of the session that are given once */
    size_t unknown;  /* number of names whose meaning is not known */
    size_t forgotten; /* how many of these `reset` has forgotten */
    size_t included; /* number of scripts included */
    int64_t work;    /* steps of work spent on questions */
    bool partial;    /* a part of the scene is missing: it was not carried out */
    bool loose;      /* values of parameters come from what was not carried out */
    bool reads;      /* files have been read: other scripts, data */
    bool uncertain;  /* `undo`, `quit`: what is declared is not known any more */
} qdot_piece_state;

/* A statement, or a block with its loop. */
typedef struct {
    qdot_stretch at;
    size_t first, end; /* its tokens first ... end - 1; the token `end` is an END */
    uint32_t line;     /* number of lines before it */
    bool block;
    qdot_piece_state behind;
} qdot_piece;

/* Another script that is carried out by `include`. */
typedef struct {
    char *path;
    qdot_source *source;
    size_t piece; /* the statement that includes it */
} qdot_included;

/* A name that is known to stand for something, but not for what. */
typedef struct {
    char *name;
    bool label; /* of a run: any other name hides it */
    bool gone;  /* it was the label of a run or table that `remove` has taken away */
} qdot_unknown;

/* What an analysis asks of who makes it; any function may be NULL. */
typedef struct {
    /* Append the text of a script as it is being edited; false: it is not, the file is read. */
    bool (*read)(void *data, const char *path, qdot_text *text);
    /* Whether something waits, so that the analysis had better be interrupted. */
    bool (*waits)(void *data);
    void *data;
} qdot_analysis_host;

typedef struct {
    char *path; /* the file, for relative names of others; need not exist */
    qdot_analysis_host host;
    bool quick; /* questions are parsed only */
    char *text; /* as it is being written; NUL-terminated */
    size_t length;
    qdot_source *source; /* the text without lines at fault (torn.h) */
    qdot_vec(qdot_piece) pieces;
    size_t done; /* number of pieces that have been analysed */
    qdot_remark_list remarks; /* on the pieces, in order; bytes are counted from the beginning of the piece */
    qdot_remark_list torn;    /* on lines that could not be split into tokens */
    qdot_session *session;    /* what is declared by the pieces that are done */
    FILE *nowhere;
    qdot_vec(qdot_unknown) unknown; /* runs, what depends on runs */
    size_t forgotten;               /* those before this number are no more, because of `reset` */
    qdot_vec(qdot_included) included;
} qdot_analysis;

/* Returns NULL if memory runs out. */
qdot_analysis *qdot_analysis_new(const char *path, bool quick, const qdot_analysis_host *host);
void qdot_analysis_free(qdot_analysis *a);

/* Forget all that has been found out, with a new session. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_analysis_begin(qdot_analysis *a);
/* Keep of the remarks, names without a meaning, scripts included those that were there in that state. */
void qdot_analysis_truncate(qdot_analysis *a, const qdot_piece_state *state);

/* Remark i of all, its bytes counted in the text; false: there are fewer. */
bool qdot_analysis_remark(const qdot_analysis *a, size_t i, qdot_remark *remark);
/* The piece that contains byte `at`, or ends before it; NULL: it is before the first. */
const qdot_piece *qdot_analysis_piece(const qdot_analysis *a, size_t at);
/* Index of the token that contains byte `at` or ends there, an END left out; SIZE_MAX: there is none. */
size_t qdot_analysis_token(const qdot_source *source, size_t at);

#endif
