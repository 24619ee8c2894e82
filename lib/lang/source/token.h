/* token.h -- a source text and its tokens. */
#ifndef QDOT_LANG_TOKEN_H
#define QDOT_LANG_TOKEN_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "base/memory.h"

typedef enum {
    QDOT_TOKEN_END,     /* end of a statement: a newline, `;`, or the end of the source */
    QDOT_TOKEN_NUMBER,  /* a number as "9.81" */
    QDOT_TOKEN_NAME,    /* a name as "theta1", with Greek letters spelled out */
    QDOT_TOKEN_STRING,  /* the text of a string without its quotes */
    QDOT_TOKEN_OPERATOR /* a sign: ( ) [ ] { } , ; : . .. ' + - * / ^ = == < <= > >= % ... */
} qdot_token_kind;

typedef struct qdot_token {
    uint8_t kind;
    bool glued;             /* no blank precedes the token */
    bool shown;             /* its statement has signs or numbers beyond ASCII, as ½, ², √ and the dot of θ̇: it is
                             * written as the screen shows formulas */
    const char *text;       /* NUL-terminated, in the source's arena */
    uint32_t start, length; /* position and length in the source, in bytes */
} qdot_token;

typedef struct qdot_source {
    unsigned uses; /* number of users of this source; the last one frees it */
    char *name;
    char *text; /* NUL-terminated copy of the source text */
    size_t length;
    qdot_vec(uint32_t) lines; /* the first byte of each line but the first */
    uint32_t lines_before; /* number of lines of the same input before this text */
    qdot_arena *arena;
    qdot_vec(qdot_token) tokens; /* the tokens; the last one is END */
} qdot_source;

static inline bool
qdot_token_is(const qdot_token *token, const char *op)
{
    return token->kind == QDOT_TOKEN_OPERATOR && strcmp(token->text, op) == 0;
}

/* The change of bracket depth by a token: 1 for an opening bracket, -1 for a closing one, else 0. */
static inline int
qdot_token_bracket(const qdot_token *token)
{
    if (token->kind != QDOT_TOKEN_OPERATOR || token->text[1] != '\0')
        return 0;
    return (strchr("([{", token->text[0]) != NULL) - (strchr(")]}", token->text[0]) != NULL);
}

/* The token behind the bracket that opens at `open`; `open` itself if it is not closed within its statement, as where a `for`
 * inside of it ends that. */
static inline const qdot_token *
qdot_token_behind_bracket(const qdot_token *open)
{
    int64_t depth = 0;

    for (const qdot_token *k = open; k->kind != QDOT_TOKEN_END; k++) {
        const int step = qdot_token_bracket(k);

        depth += step;
        if (step != 0 && depth == 0)
            return k + 1;
    }
    return open;
}

/* The token behind the name and its index, which follows it without a blank: x, x[1,2]. Of an index that is not closed the
 * bracket itself. */
static inline const qdot_token *
qdot_token_behind_index(const qdot_token *name)
{
    const qdot_token *next = name + 1;

    return next->glued && qdot_token_is(next, "[") ? qdot_token_behind_bracket(next) : next;
}

/* Whether the name joins claims: `and`, `or`, `not`. */
static inline bool
qdot_is_connective(const char *name)
{
    return strcmp(name, "and") == 0 || strcmp(name, "or") == 0 || strcmp(name, "not") == 0;
}

static inline bool
qdot_token_is_word(const qdot_token *token, const char *word)
{
    return token->kind == QDOT_TOKEN_NAME && strcmp(token->text, word) == 0;
}

#endif
