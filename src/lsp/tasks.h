/* tasks.h -- scripts that are run for a command of the editor, each by a process of its own.
 *
 * The process is this program again, as `qdot --lsp=KIND`; it reads the statements from its standard input and writes lines of JSON:
 *
 *     {"progress": "run", "done": 0.4, "left": 2.5}
 *     {"text": "...", "html": "...", "style": "...", "error": "", "status": 0, "latex": [...], "figures": [{"name": "...", "mime": "...", "data": "..."}]}
 *
 * the last of which is its result. So a run may be interrupted by a signal, and what goes wrong in it ends nothing else.
 *
 * Tests  tests/meta/lsp.test
 */
#ifndef QDOT_LSP_TASKS_H
#define QDOT_LSP_TASKS_H

#include <poll.h>

#include "parts.h"

/* Append what is to be waited for to `fds`; room for server->tasks.n. */
void qdot_tasks_poll(const qdot_server *server, struct pollfd *fds);
/* Read what the processes have written, answer requests whose process has ended. */
void qdot_tasks_work(qdot_server *server);
/* Interrupt the process of the request with this id. */
void qdot_tasks_cancel(qdot_server *server, const json_t *id);
/* End all processes, and remove the files that they have made. */
void qdot_tasks_free(qdot_server *server);

/* What the process does: carry out standard input. Returns the exit status. */
int qdot_task_run(void);

/* The statements of a document that a kind of command wants, the rest left out: `line` < 0, or the line of the one statement
 * that is to be shown. The caller's; NULL if memory runs out. */
char *qdot_task_statements(const qdot_analysis *a, const char *kind, int64_t line);

#endif
