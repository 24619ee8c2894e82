/* scene-file.h -- a scene as a script: `scene to "x.lag"`, `save session to "x.lag"`; what was typed, `save history`.
 *
 * The statements are made from the present declarations, not from the typed text: positions and
 * values are evaluated, in exact numbers, in the plain style. Order: parameters, functions and
 * coordinates as they were declared; assumptions; things with mass, forces, constraints, events;
 * definitions; values of `set`; the start. Read by a fresh program they give the same scene, and
 * written again the same file. A session has its runs too, each under the conditions it was made under
 * (lang/declare/session-file).
 *
 * A definition is written as its value, or as the text it was defined with, whichever is verified
 * to read back as its value; else a comment and a notice say that it is missing.
 *
 * A file is overwritten only if it begins as these files do.
 *
 * Tests  tests/script/files/scene-file.sh
 */
#ifndef QDOT_LANG_SCENE_FILE_H
#define QDOT_LANG_SCENE_FILE_H

#include "base/text.h"
#include "lang/language/cursor.h"
#include "lang/source/token.h"

/* Whether the path is that of a scene file, "NAME.lag". */
bool qdot_scene_file_is(const char *path);

typedef enum {
    QDOT_FILE_SCENE,   /* the scene, parameter values, start and definitions */
    QDOT_FILE_SESSION, /* also the style, the runs, and names defined by results of runs */
    QDOT_FILE_HISTORY  /* the statements that were typed and were successful */
} qdot_scene_file;

/* Append the scene as it is listed for a reader: the coordinates, with their units, and what is declared with them. */
QDOT_MUST_CHECK qdot_status qdot_scene_file_list(qdot_session *session, qdot_text *out);
/* Append the contents of a scene or session file. */
QDOT_MUST_CHECK qdot_status qdot_scene_file_text(qdot_session *session, qdot_scene_file what,
                                                 qdot_text *out);
/* To the file that the token names. Errors, placed at it: QDOT_EIO; QDOT_EINVAL for a file that does
 * not begin as these do. */
QDOT_MUST_CHECK qdot_status qdot_scene_file_write(qdot_cursor *c, const qdot_token *name,
                                                  qdot_scene_file what);

#endif
