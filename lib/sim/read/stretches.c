/* stretches.c -- divides a time range at the stored points of several runs. */
#include "sim/read/stretches.h"

#include <float.h>
#include <math.h>

#include "num/sort.h"

void
qdot_stretches_clear(qdot_stretches *s)
{
    qdot_free(s->times.at);
    qdot_free(s->pieces);
    *s = (qdot_stretches){0};
}

qdot_status
qdot_stretches_init(qdot_stretches *s, size_t n, const qdot_course *const *courses, double from,
                    double to)
{
    double low = fmin(from, to), high = fmax(from, to);

    *s = (qdot_stretches){.n = n, .courses = courses, .from = from, .to = to};
    s->pieces = qdot_calloc(n, sizeof *s->pieces);
    if (!s->pieces)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < n; k++)
        qdot_trajectory_narrow(&courses[k]->tr, &low, &high);
    if (low > high)
        return QDOT_OK;
    QDOT_TRY(qdot_vec_push(&s->times, low));
    for (size_t k = 0; k < n; k++)
        for (size_t i = 0; i < courses[k]->tr.count; i++)
            if (courses[k]->tr.t[i] > low && courses[k]->tr.t[i] < high)
                QDOT_TRY(qdot_vec_push(&s->times, courses[k]->tr.t[i]));
    QDOT_TRY(qdot_vec_push(&s->times, high));
    qdot_sort(s->times.n, s->times.at);
    return QDOT_OK;
}

/* Whether the equations of a run switch at t, the end of one of its pieces. */
static bool
switches_at(const qdot_trajectory *tr, size_t piece, double t)
{
    for (size_t k = piece; k <= piece + 1; k++)
        if (k > 0 && k < tr->pieces.n && !tr->pieces.at[k].jumped &&
            tr->t[tr->pieces.at[k].first] == t)
            return true;
    return false;
}

/* Find the pieces of the runs that contain the interval a ... b, inside which no run has a stored point. */
static void
find_pieces_of_interval(qdot_stretches *s)
{
    s->odd[0] = s->odd[1] = false;
    for (size_t k = 0; k < s->n; k++) {
        const qdot_trajectory *tr = &s->courses[k]->tr;
        const bool opposite = qdot_trajectory_is_backward(tr) != (s->b < s->a);
        const size_t point = qdot_trajectory_locate(tr, opposite ? s->b : s->a, 0);

        s->pieces[k] = qdot_trajectory_piece_of(tr, point);
        s->odd[0] = s->odd[0] || switches_at(tr, s->pieces[k], s->a);
        s->odd[1] = s->odd[1] || switches_at(tr, s->pieces[k], s->b);
    }
}

/* Of a range of no length: of each course the piece of this rank among those with that time, or
 * its last; false: none has so many. */
static bool
enter_interval_without_length(qdot_stretches *s, size_t rank)
{
    bool found = false;

    for (size_t k = 0; k < s->n; k++) {
        const qdot_trajectory *tr = &s->courses[k]->tr;
        const size_t last = qdot_trajectory_piece_of(tr, qdot_trajectory_locate(tr, s->to, 0));
        size_t first = last;

        while (first > 0 && tr->t[tr->pieces.at[first].first] == s->to)
            first--;
        found = found || first + rank <= last;
        s->pieces[k] = first + rank < last ? first + rank : last;
    }
    return found;
}

bool
qdot_stretches_next(qdot_stretches *s)
{
    const double *t = s->times.at;
    const size_t n = s->times.n;

    if (n > 0 && s->from == s->to)
        return enter_interval_without_length(s, s->next++);
    while (s->next + 1 < n) {
        const size_t k = s->next++;

        s->a = s->from < s->to ? t[k] : t[n - 1 - k];
        s->b = s->from < s->to ? t[k + 1] : t[n - 2 - k];
        /* treat stored points of two runs that differ only by rounding as one */
        if (s->a == s->b || (s->n > 1 && k + 2 < n &&
                             fabs(s->b - s->a) <= 16 * DBL_EPSILON * fabs(s->b)))
            continue;
        find_pieces_of_interval(s);
        return true;
    }
    return false;
}
