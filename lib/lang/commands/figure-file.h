/* figure-file.h -- writes a figure to its file or window. */
#ifndef QDOT_LANG_FIGURE_FILE_H
#define QDOT_LANG_FIGURE_FILE_H

#include "lang/language/cursor.h"
#include "show/show.h"

/* A figure to a file; path NULL: into a window where there is one, else NAME-1.svg beside
 * the script. */
QDOT_MUST_CHECK qdot_status qdot_figure_file_show(qdot_session *session,
                                                  const qdot_figure *figure,
                                                  const char *path);
/* The quoted name behind `to`. */
QDOT_MUST_CHECK qdot_status qdot_figure_file_read(qdot_cursor *c, const char **path);

#endif
