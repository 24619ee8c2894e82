/* remark.c -- what an analysis has to say of a stretch of text. */
#include "lang/analysis/remark.h"

#include <string.h>

qdot_status
qdot_remark_add(qdot_remark_list *list, qdot_stretch at, qdot_remark_level level, const char *message, const char *hint)
{
    qdot_remark remark = {.at = at, .level = level, .message = qdot_strdup(message), .hint = qdot_strdup(hint)};

    if (remark.message != NULL && remark.hint != NULL && qdot_vec_push(list, remark) == QDOT_OK)
        return QDOT_OK;
    qdot_free(remark.message);
    qdot_free(remark.hint);
    return QDOT_ENOMEM;
}

void
qdot_remark_truncate(qdot_remark_list *list, size_t n)
{
    while (list->n > n) {
        qdot_remark *last = &list->at[--list->n];

        qdot_free(last->message);
        qdot_free(last->hint);
        qdot_free(last->fix);
    }
}

void
qdot_remark_clear(qdot_remark_list *list)
{
    qdot_remark_truncate(list, 0);
    qdot_free(list->at);
    *list = (qdot_remark_list){0};
}

/* Whether the byte may be one of a name. */
static bool
is_of_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || (c & 0x80) != 0;
}

/* The bytes of a name at the beginning of the text. */
static size_t
length_of_name(const char *text)
{
    size_t n = 0;

    while (is_of_name(text[n]))
        n++;
    return n;
}

qdot_status
qdot_remark_find_fix(qdot_remark *remark, const char *text)
{
    static const char question[] = "did you mean `";
    const char *from, *to;
    const size_t name = length_of_name(text + remark->at.from);

    if (strncmp(remark->hint, question, sizeof question - 1) != 0 || name == 0)
        return QDOT_OK;
    from = remark->hint + sizeof question - 1;
    to = strchr(from, '`');
    /* only where a name stands for a name: `energy(bob)` may be an example */
    if (to == NULL || strcmp(to, "`?") != 0 || length_of_name(from) != (size_t)(to - from))
        return QDOT_OK;
    remark->fix = qdot_strndup(from, (size_t)(to - from));
    if (remark->fix == NULL)
        return QDOT_ENOMEM;
    remark->at.to = remark->at.from + name;
    return QDOT_OK;
}
