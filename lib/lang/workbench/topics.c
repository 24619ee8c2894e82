/* topics.c -- help topics: words that are no statement, quantity, function or method. */
#include "lang/workbench/topics.h"

static const qdot_topic rows[] = {
#define TOPIC(word, usage, summary, example) {word, usage, summary, example, false},
#define OPTION(word, usage, summary, example) {word, usage, summary, example, true},
#include "lang/workbench/topic.def"
};
#undef TOPIC
#undef OPTION

const qdot_topic *
qdot_topic_at(size_t i)
{
    return i < sizeof rows / sizeof *rows ? &rows[i] : NULL;
}
