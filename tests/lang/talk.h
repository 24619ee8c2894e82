/* talk.h -- a session whose answers and errors are kept, for tests that talk to one. */
#ifndef TESTS_LANG_TALK_H
#define TESTS_LANG_TALK_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lang/session/session.h"
#include "lang/workbench/script.h"

typedef struct {
    qdot_session *session;
    FILE *out, *err;
    char *out_text, *err_text;
    size_t out_size, err_size;
} talk;

static inline int
begin(void **state)
{
    talk *k = calloc(1, sizeof *k);

    k->out = open_memstream(&k->out_text, &k->out_size);
    k->err = open_memstream(&k->err_text, &k->err_size);
    k->session = qdot_session_new(k->out, k->err);
    *state = k;
    return k->session == NULL;
}

static inline int
end(void **state)
{
    talk *k = *state;

    qdot_session_free(k->session);
    fclose(k->out);
    fclose(k->err);
    free(k->out_text);
    free(k->err_text);
    free(k);
    return 0;
}

static inline int
say(talk *k, const char *text)
{
    return qdot_script_run_text(k->session, "test", text, strlen(text));
}

static inline const char *
since_last_look(FILE *file, char **text, const size_t *size)
{
    fflush(file);
    (*text)[*size] = '\0';
    rewind(file);
    return *text;
}

/* What was answered since the last look; until something is said again. */
static inline const char *
heard(talk *k)
{
    return since_last_look(k->out, &k->out_text, &k->out_size);
}

/* What was complained of since the last look; until something is said again. */
static inline const char *
complaint(talk *k)
{
    return since_last_look(k->err, &k->err_text, &k->err_size);
}

#endif
