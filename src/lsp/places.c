/* places.c -- places of a text as an editor counts them. */
#include "places.h"

#include <string.h>

/* The bytes of the character at `at`, and how many units it counts. A byte that is no UTF-8 is a character by itself. */
static size_t
step(const qdot_server *server, const char *text, size_t length, size_t at, size_t *units)
{
    const unsigned char c = (unsigned char)text[at];
    size_t n = c < 0x80 ? 1 : c >= 0xF0 ? 4 : c >= 0xE0 ? 3 : c >= 0xC0 ? 2 : 1, k = 1;

    while (k < n && at + k < length && ((unsigned char)text[at + k] & 0xC0) == 0x80)
        k++;
    *units = server->utf8 ? k : k == 4 ? 2 : 1;
    return k;
}

/* The bytes of the end of a line at `at`; 0: none ends there. */
static size_t
length_of_end(const char *text, size_t length, size_t at)
{
    if (at >= length || (text[at] != '\n' && text[at] != '\r'))
        return 0;
    return text[at] == '\r' && at + 1 < length && text[at + 1] == '\n' ? 2 : 1;
}

bool
qdot_place_read(const qdot_server *server, const char *text, size_t length, const json_t *place, size_t *at)
{
    const json_t *line = json_object_get(place, "line"), *character = json_object_get(place, "character");
    json_int_t lines = json_integer_value(line), units = json_integer_value(character);
    size_t i = 0;

    if (!json_is_integer(line) || !json_is_integer(character) || lines < 0 || units < 0)
        return false;
    while (lines > 0 && i < length) {
        const size_t end = length_of_end(text, length, i);

        lines -= end > 0;
        i += end > 0 ? end : 1;
    }
    if (lines > 0) {
        *at = length;
        return true;
    }
    while (units > 0 && i < length && length_of_end(text, length, i) == 0) {
        size_t n, bytes = step(server, text, length, i, &n);

        if ((json_int_t)n > units)
            break;
        units -= (json_int_t)n;
        i += bytes;
    }
    *at = i;
    return true;
}

bool
qdot_place_read_range(const qdot_server *server, const char *text, size_t length, const json_t *range, qdot_stretch *at)
{
    return qdot_place_read(server, text, length, json_object_get(range, "start"), &at->from) &&
           qdot_place_read(server, text, length, json_object_get(range, "end"), &at->to) && at->from <= at->to;
}

void
qdot_place_walk_to(const qdot_server *server, const char *text, size_t length, size_t at, qdot_place_walk *walk)
{
    while (walk->at < at && walk->at < length) {
        const size_t end = length_of_end(text, length, walk->at);
        size_t units;

        if (end > 0) {
            walk->at += end;
            walk->line++;
            walk->character = 0;
        } else {
            walk->at += step(server, text, length, walk->at, &units);
            walk->character += units;
        }
    }
}

size_t
qdot_place_units(const qdot_server *server, const char *text, qdot_stretch at)
{
    size_t sum = 0;

    while (at.from < at.to) {
        size_t units;

        at.from += step(server, text, at.to, at.from, &units);
        sum += units;
    }
    return sum;
}

/* --- ranges in a long text ------------------------------------------------------------ */

enum { STRIDE = 512 }; /* bytes between two marks */

/* Mark i is the first place at or behind byte i*STRIDE. */
struct qdot_place_marks {
    const char *text;
    qdot_vec(qdot_place_walk) at;
};

qdot_place_marks *
qdot_places_new(void)
{
    return qdot_calloc(1, sizeof(qdot_place_marks));
}

void
qdot_places_free(qdot_place_marks *marks)
{
    if (marks != NULL)
        qdot_free(marks->at.at);
    qdot_free(marks);
}

void
qdot_places_forget(qdot_server *server)
{
    server->marks->text = NULL;
}

static void
mark_text(const qdot_server *server, const char *text, size_t length)
{
    qdot_place_marks *marks = server->marks;
    qdot_place_walk walk = {0};

    marks->text = text;
    marks->at.n = 0;
    while (qdot_vec_push(&marks->at, walk) == QDOT_OK && walk.at < length)
        qdot_place_walk_to(server, text, length, marks->at.n * STRIDE, &walk);
}

qdot_place_walk
qdot_place_at(const qdot_server *server, const char *text, size_t length, size_t at)
{
    const qdot_place_marks *marks = server->marks;
    qdot_place_walk walk = {0};

    if (marks->text != text)
        mark_text(server, text, length);
    for (size_t i = at / STRIDE < marks->at.n ? at / STRIDE : marks->at.n - 1; marks->at.n > 0; i--)
        if (marks->at.at[i].at <= at) { /* the first is 0 */
            walk = marks->at.at[i];
            break;
        }
    qdot_place_walk_to(server, text, length, at, &walk);
    return walk;
}

static json_t *
pack_place(const qdot_place_walk *walk)
{
    return json_pack("{s:I, s:I}", "line", (json_int_t)walk->line, "character", (json_int_t)walk->character);
}

json_t *
qdot_place_range(const qdot_server *server, const char *text, size_t length, qdot_stretch at)
{
    const qdot_place_walk start = qdot_place_at(server, text, length, at.from), end = qdot_place_at(server, text, length, at.to);

    return json_pack("{s:o, s:o}", "start", pack_place(&start), "end", pack_place(&end));
}
