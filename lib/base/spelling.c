/* spelling.c -- finds the word in a list that is nearest in spelling to a given word. */
#include "base/spelling.h"

#include <string.h>

enum { LONGEST = 64 };

static int
lower_case_letter(char c)
{
    return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : (unsigned char)c;
}

/* Twice the least number of letters put in, left out, changed or swapped; a change of
 * case alone costs half. Optimal string alignment (Damerau 1964). */
static int
spelling_distance(const char *a, size_t n, const char *b, size_t m)
{
    int rows[3][LONGEST + 1];

    for (size_t j = 0; j <= m; j++)
        rows[0][j] = 2 * (int)j;
    for (size_t i = 1; i <= n; i++) {
        int *row = rows[i % 3], *above = rows[(i - 1) % 3], *higher = rows[(i + 1) % 3];

        row[0] = 2 * (int)i;
        for (size_t j = 1; j <= m; j++) {
            int change = a[i - 1] == b[j - 1]                 ? 0
                         : lower_case_letter(a[i - 1]) == lower_case_letter(b[j - 1]) ? 1
                                                              : 2;
            int best = above[j - 1] + change;

            if (above[j] + 2 < best)
                best = above[j] + 2;
            if (row[j - 1] + 2 < best)
                best = row[j - 1] + 2;
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] &&
                higher[j - 2] + 2 < best)
                best = higher[j - 2] + 2;
            row[j] = best;
        }
    }
    return rows[n % 3][m];
}

void
qdot_spelling_begin(qdot_spelling *s, const char *name)
{
    size_t length = strlen(name);

    *s = (qdot_spelling){.name = name, .length = length};
    s->least = length == 1 ? 2 /* to a name of one letter only the other case of that letter is near */
                           : 2 * (length < 7 ? 1 : length < 11 ? 2 : 3) + 2;
}

void
qdot_spelling_offer(qdot_spelling *s, const char *candidate)
{
    size_t m = strlen(candidate);
    int d;

    if (s->length == 0 || s->length > LONGEST || m > LONGEST || m > s->length + 3 ||
        s->length > m + 3)
        return;
    d = spelling_distance(s->name, s->length, candidate, m);
    /* a name of one letter is taken for a mistyped one only if the same letter in the other case exists */
    if (m < 2 && d > 1)
        return;
    if (d < s->least) {
        s->least = d;
        s->best = candidate;
    }
}

const char *
qdot_spelling_nearest(const char *name, size_t n, const char *const *list)
{
    qdot_spelling s;

    qdot_spelling_begin(&s, name);
    for (size_t i = 0; i < n; i++)
        qdot_spelling_offer(&s, list[i]);
    return s.best;
}
