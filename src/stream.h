/* stream.h -- statements that a program writes: `qdot --json -i` on a pipe.
 *
 * Each statement is carried out when its last line has come, and answered before the next line is read. Its answers end
 * with {"kind":"done","statement":3,"status":0}; after an error the next statement is carried out all the same.
 *
 * Tests  tests/script/files/json-stream.sh
 */
#ifndef QDOT_STREAM_H
#define QDOT_STREAM_H

#include "lang/workbench/script.h"

/* Carry out the statements from standard input, up to its end or to `quit`. */
void qdot_stream_run(qdot_session *session);

#endif
