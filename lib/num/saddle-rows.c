/* saddle-rows.c -- finds rows of A that have shrunk to rounding errors or depend on other rows. */
#include <math.h>

#include "num/saddle.h"

/* A row counts as lost in rounding errors if its squared norm falls below this fraction of its largest one. */
static const double faded = 1e-14;

/* A row takes part in a linear dependency if its coefficient, relative to the largest, is above this. */
static const double participates = 1e-6;

static double
squared_row_norm(const qdot_saddle *s, size_t k)
{
    return qdot_saddle_row(s, k, s->A + k * s->n);
}

bool
qdot_saddle_has_faded(const qdot_saddle *s, size_t k)
{
    return squared_row_norm(s, k) < faded * s->widest[k];
}

double
qdot_saddle_remains(const qdot_saddle *s, size_t k)
{
    return s->widest[k] > 0 ? sqrt(squared_row_norm(s, k) / s->widest[k]) : 1;
}

bool
qdot_saddle_widens(const qdot_saddle *s)
{
    for (size_t k = 0; k < s->m; k++)
        if (s->widest[k] > 0 && squared_row_norm(s, k) > 4 * s->widest[k])
            return true;
    return false;
}

size_t
qdot_saddle_faded(qdot_saddle *s)
{
    size_t found = s->m;

    for (size_t k = 0; k < s->m; k++) {
        const double sum = squared_row_norm(s, k);

        if (sum > s->widest[k])
            s->widest[k] = s->aside ? s->widest[k] : sum;
        else if (sum < faded * s->widest[k])
            found = k;
    }
    return found;
}

void
qdot_saddle_weakest(qdot_saddle *s, double *row, double *column)
{
    const size_t n = s->n, last = s->rank - 1;

    for (size_t k = 0; k < s->m; k++)
        row[k] = 0;
    row[s->pivot[last]] = s->e[s->pivot[last]];
    for (size_t j = last; j-- > 0;) {
        double sum = s->R[last * n + j];

        for (size_t k = j + 1; k < last; k++)
            sum -= s->R[k * n + j] * s->u[k];
        s->u[j] = sum / s->R[j * n + j];
        row[s->pivot[j]] = -s->u[j] * s->e[s->pivot[j]];
    }
    for (size_t i = 0; i < n; i++)
        column[i] = s->Q[last * n + i] * s->d[i];
}

/* Express column k by the first `sound` pivots, into s->u; returns how many take part and marks
 * them in `part`. */
static size_t
express_by_pivots(const qdot_saddle *s, size_t k, size_t sound, const double *part, size_t *met)
{
    const size_t n = s->n;
    size_t count = 0;

    *met = 0;

    for (size_t j = sound; j-- > 0;) {
        double sum = s->R[k * n + j];

        for (size_t i = j + 1; i < sound; i++)
            sum -= s->R[i * n + j] * s->u[i];
        s->u[j] = sum / s->R[j * n + j];
        if (fabs(s->u[j]) > participates) {
            count++;
            *met += part[s->pivot[j]] > participates;
        }
    }
    return count;
}

/* The next dependency to be told, of a row k behind the sound pivots: the one of fewest rows (*count), and if it
 * is none of those that make up for the lost rank, no longer than these and one that shares rows with them. m: there is
 * none. */
static size_t
find_next_dependency(const qdot_saddle *s, size_t sound, bool lost, const double *part, size_t longest,
                     size_t *count)
{
    size_t next = s->m;

    for (size_t k = sound; k < s->m; k++) {
        size_t met, taking_part;

        if (part[s->pivot[k]] > 0)
            continue;
        taking_part = express_by_pivots(s, k, sound, part, &met);
        if (!lost && (met == 0 || taking_part > longest))
            continue; /* skip a redundant row that is not part of this dependency */
        if (next == s->m || taking_part < *count) {
            next = k;
            *count = taking_part;
        }
    }
    return next;
}

void
qdot_saddle_parts(qdot_saddle *s, double below, double *part)
{
    const size_t last = s->last, rank = s->rank < s->m ? s->rank : s->m;
    size_t sound = 0; /* number of pivots that are not small, so that their rows are independent */
    size_t longest = 0, count = 0, k;

    for (k = 0; k < s->m; k++)
        part[k] = 0;
    if (last >= s->m)
        return;
    while (sound < last && sound < s->n &&
           fabs(s->R[sound * s->n + sound]) > below * fabs(s->R[0]))
        sound++;
    for (size_t found = 0;; found++) {
        size_t met;

        k = find_next_dependency(s, sound, found < rank - sound, part, longest, &count);
        if (k == s->m)
            return;
        (void)express_by_pivots(s, k, sound, part, &met);
        longest = count > longest ? count : longest;
        part[s->pivot[k]] = 1;
        for (size_t j = 0; j < sound; j++)
            part[s->pivot[j]] = fmax(part[s->pivot[j]], fmin(1, fabs(s->u[j])));
    }
}
