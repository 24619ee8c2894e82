/* progress-line.h -- the line that says how far long work is.
 *
 * Tests  tests/src/test_prompt.c
 */
#ifndef QDOT_PROGRESS_LINE_H
#define QDOT_PROGRESS_LINE_H

/* From now on this thread's long work shows a line on standard error, which must be a terminal,
 * and takes it away when it is done (base/progress.h). */
void qdot_progress_line_install(void);

#endif
