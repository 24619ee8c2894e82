/* gnuplot.h -- runs gnuplot: a script in, an image out. */
#ifndef QDOT_SHOW_GNUPLOT_H
#define QDOT_SHOW_GNUPLOT_H

#include "base/text.h"

/* Whether there is a gnuplot to run. */
bool qdot_gnuplot_is_here(void);

/* Carry out `script`. image: what gnuplot writes to its standard output, appended, which ends with the bytes
 * `end` but for blanks; NULL: nothing is wanted of it (a window, which stays when gnuplot is gone).
 *
 * The script is handed over in a nameless file and gnuplot's settings files are not
 * read, so neither a broken pipe nor a user's defaults can change a figure.
 *
 * Errors: QDOT_EIO where gnuplot is missing, fails (with the first thing it says),
 * writes nothing or a part of an image; QDOT_EINTR; QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_gnuplot_run(const qdot_text *script, const char *end, qdot_text *image);

#endif
