/* text-list.h -- texts that a session keeps: files being read, notices given, remarks. */
#ifndef QDOT_LANG_TEXT_LIST_H
#define QDOT_LANG_TEXT_LIST_H

#include "base/memory.h"

typedef struct qdot_text_list {
    qdot_vec(char *); /* each its own */
} qdot_text_list;

#endif
