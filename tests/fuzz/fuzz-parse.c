/* fuzz-parse.c -- any bytes as a script: no crash, no leak, no undefined behaviour, and Ctrl-C
 * is heard. Errors are expected; what is answered is not looked at.
 */
#include "expr/print-name.h"
#include "fuzz.h"
#include "lang/session/output.h"
#include "lang/session/session.h"

int
LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    qdot_session *session;
    bool json = size > 0 && data[size - 1] % 2 != 0;

    fuzz_ready();
    session = qdot_session_new(fuzz_nowhere, fuzz_nowhere);
    if (session == NULL)
        abort();
    fuzz_begin(data, size);
    session->output->json = json;
    session->output->style = size > 1 ? (qdot_style)(data[size - 2] % 3) : QDOT_PLAIN;
    (void)qdot_script_is_incomplete((const char *)data, size);
    (void)qdot_script_run_text(session, "fuzz", (const char *)data, size);
    qdot_session_free(session);
    fuzz_end();
    return 0;
}
