/* figure-file.h -- shows a figure in a window or as a terminal sketch, or writes it to a file. */
#ifndef QDOT_LANG_FIGURE_FILE_H
#define QDOT_LANG_FIGURE_FILE_H

#include "lang/language/cursor.h"
#include "show/figure.h"

/* A figure to the file `path`. path NULL: into a window where one opens; else to NAME-1.svg beside
 * the script, or the first of NAME-2.svg ... that is not there yet, which a note tells where a
 * window was to be expected; a terminal gets a sketch. Also with `keep` it is a file. A program that displays
 * answers (session/output.h) gets it as an answer, also with `keep`; a notice tells that this needs a file. */
QDOT_MUST_CHECK qdot_status qdot_figure_file_show(qdot_session *session,
                                                  const qdot_figure *figure,
                                                  const char *path);

#endif
