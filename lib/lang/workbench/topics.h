/* topics.h -- words that are no statement, value, function or method, and what `help` says of them.
 *
 * Tests  tests/script/language/help-topics.lag
 */
#ifndef QDOT_LANG_TOPICS_H
#define QDOT_LANG_TOPICS_H

#include <stdbool.h>
#include <stddef.h>

typedef struct {
    const char *word, *usage, *summary, *example;
    bool option; /* the word is an option of statements */
} qdot_topic;

/* Row i of the table topic.def; NULL past the end. */
const qdot_topic *qdot_topic_at(size_t i);

#endif
