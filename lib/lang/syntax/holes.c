/* holes.c -- the table of placeholders ("holes") in usage texts and what each accepts. */
#include "lang/syntax/holes.h"

#include <stdbool.h>
#include <string.h>

static const qdot_hole rows[] = {
#define HOLE(statement, before, text, class, expected, kinds)                            \
    {statement, before, text, QDOT_HOLE_##class, expected},
#include "lang/syntax/holes.def"
};
#undef HOLE

static bool
row_fits_placeholder(const char *row, const char *text)
{
    return row == NULL || strcmp(row, text) == 0;
}

int
qdot_hole_find(const char *statement, const char *before, const char *text)
{
    const char *kind = text[0] == '"' ? "\"...\"" : text[0] == '(' ? "(...)" : text;
    int i = 0;

    while (!row_fits_placeholder(rows[i].statement, statement) || !row_fits_placeholder(rows[i].before, before) ||
           !row_fits_placeholder(rows[i].text, kind))
        i++; /* the search ends at the last row, which fits any placeholder */
    return i;
}

const qdot_hole *
qdot_hole_at(int row)
{
    return &rows[row];
}
