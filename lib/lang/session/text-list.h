/* text-list.h -- texts that a session keeps: files being read, notices given, remarks. */
#ifndef QDOT_LANG_TEXT_LIST_H
#define QDOT_LANG_TEXT_LIST_H

#include "base/memory.h"

typedef struct qdot_text_list {
    qdot_vec(char *); /* the texts, each owned */
} qdot_text_list;

/* Free the texts; the list is empty then. */
static inline void
qdot_text_list_clear(qdot_text_list *list)
{
    for (size_t i = 0; i < list->n; i++)
        qdot_free(list->at[i]);
    qdot_free(list->at);
    *list = (qdot_text_list){0};
}

#endif
