/* server.h -- the language server: `qdot --lsp`, for editors.
 *
 * Messages are those of the Language Server Protocol 3.17 on standard input and output. What a script says is found by
 * lib/lang/analysis; here requests are read, places are counted as the editor counts them, answers are written.
 *
 * One thread reads a message, answers it, and reads the next. While no message waits, documents that have changed are
 * analysed, and their diagnostics published. Scripts are run by processes of their own (tasks.h).
 *
 * Tests  tests/meta/lsp.test
 */
#ifndef QDOT_LSP_SERVER_H
#define QDOT_LSP_SERVER_H

/* Serve until the client says `exit` or closes its end. Returns the exit status of the program: 0 after `shutdown`, else 1.
 * program: how this program was called; task: NULL, or what the server has a process of its own do (tasks.h). */
int qdot_lsp_run(const char *program, const char *task);

#endif
