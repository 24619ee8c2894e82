/* samples.c -- tables as piecewise polynomials: their coefficients, and the search for a piece. */
#include "num/samples.h"

#include <float.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <string.h>

#include "base/memory.h"
#include "num/past.h"

enum { MOST_TABLES = 4096, ITEMS = 32, PIECE = 0, KNOT = 2, COEFFICIENT = 4 };

/* A place outside the table is taken for the end if its distance is at most this times (length + largest |knot|): so large the
 * rounding error of an argument may be. */
static const double slack = 8 * DBL_EPSILON;

/* Pieces along an axis of n knots have numbers: 0 before the first knot, 1 ... n - 1 between knots, n behind the last one;
 * of a periodic table also all other integers, a period being n - 1 of them. */
typedef struct {
    size_t n;
    double *knots;
} axis;

typedef struct {
    int axes, degree;
    qdot_samples_beyond beyond;
    axis axis[2];
    double *values;         /* as given */
    double *coefficient[16]; /* at 4 i + j: those of w^i v^j, [pieces]; NULL: 0 */
} table;

static _Atomic(table *) tables[MOST_TABLES];
static atomic_int n_tables;
static pthread_mutex_t adding = PTHREAD_MUTEX_INITIALIZER;

static const table *
table_of(double handle, int *item)
{
    if (!(handle >= 0 && handle < (double)MOST_TABLES * ITEMS))
        return NULL;
    *item = (int)handle % ITEMS;
    return tables[(int)handle / ITEMS];
}

/* --- slopes of splines ------------------------------------------------------------------ */

/* Solve the system with sub-diagonal a, diagonal b, super-diagonal c [n] for x [n], which comes as the right side. b and c
 * are lost. The systems here are dominated by their diagonals after the first elimination. */
static void
solve_tridiagonal(size_t n, const double *a, double *b, double *c, double *x)
{
    for (size_t i = 1; i < n; i++) {
        const double f = a[i] / b[i - 1];

        b[i] -= f * c[i - 1];
        x[i] -= f * x[i - 1];
    }
    x[n - 1] /= b[n - 1];
    for (size_t i = n - 1; i-- > 0;)
        x[i] = (x[i] - c[i] * x[i + 1]) / b[i];
}

/* The slopes s [n] at the knots x [n] of the spline through f [n], in steps of `stride`; room [4n]. With h_i = x_{i+1} - x_i
 * and d_i = (f_{i+1} - f_i)/h_i the second derivative is continuous where
 *
 *     h_i s_{i-1} + 2 (h_{i-1} + h_i) s_i + h_{i-1} s_{i+1} = 3 (h_i d_{i-1} + h_{i-1} d_i)
 *
 * and the ends have no knot at x_1 and x_{n-2}. */
static void
find_slopes(size_t n, const double *x, const double *f, double *s, double *room)
{
    double *a = room, *b = a + n, *c = b + n;
    const double first = (f[1] - f[0]) / (x[1] - x[0]), last = (f[n - 1] - f[n - 2]) / (x[n - 1] - x[n - 2]);

    if (n == 2) {
        s[0] = s[1] = first;
        return;
    }
    if (n == 3) {
        const double bend = (last - first) / (x[2] - x[0]);

        s[0] = first - bend * (x[1] - x[0]);
        s[1] = first + bend * (x[1] - x[0]);
        s[2] = last + bend * (x[2] - x[1]);
        return;
    }
    for (size_t i = 1; i + 1 < n; i++) {
        const double before = x[i] - x[i - 1], after = x[i + 1] - x[i];

        a[i] = after;
        b[i] = 2 * (before + after);
        c[i] = before;
        s[i] = 3 * (after * (f[i] - f[i - 1]) / before + before * (f[i + 1] - f[i]) / after);
    }
    {
        const double h0 = x[1] - x[0], h1 = x[2] - x[1], d1 = (f[2] - f[1]) / h1;
        const double g0 = x[n - 1] - x[n - 2], g1 = x[n - 2] - x[n - 3], e1 = (f[n - 2] - f[n - 3]) / g1;

        b[0] = h1;
        c[0] = h0 + h1;
        s[0] = ((h0 + 2 * (h0 + h1)) * h1 * first + h0 * h0 * d1) / (h0 + h1);
        b[n - 1] = g1;
        a[n - 1] = g0 + g1;
        s[n - 1] = ((g0 + 2 * (g0 + g1)) * g1 * last + g0 * g0 * e1) / (g0 + g1);
    }
    solve_tridiagonal(n, a, b, c, s);
}

/* The same of a periodic spline, f[n-1] being f[0]: the system is cyclic, solved as a tridiagonal one and a correction
 * (Sherman and Morrison); room [6n]. */
static void
find_periodic_slopes(size_t n, const double *x, const double *f, double *s, double *room)
{
    const size_t m = n - 1;
    double *a = room, *b = a + n, *c = b + n, *u = c + n, *b2 = u + n, *c2 = b2 + n;
    double corner, share;

    if (m == 1) {
        s[0] = s[1] = 0;
        return;
    }
    for (size_t i = 0; i < m; i++) {
        const size_t p = (i + m - 1) % m;
        const double before = x[p + 1] - x[p], after = x[i + 1] - x[i];

        a[i] = after;
        b[i] = 2 * (before + after);
        c[i] = before;
        s[i] = 3 * (after * (f[p + 1] - f[p]) / before + before * (f[i + 1] - f[i]) / after);
    }
    if (m == 2) { /* both neighbours of a knot are the other one */
        const double p = a[0] + c[0], q = a[1] + c[1], det = b[0] * b[1] - p * q, s0 = s[0];

        s[0] = (s[0] * b[1] - p * s[1]) / det;
        s[1] = (b[0] * s[1] - q * s0) / det;
        s[2] = s[0];
        return;
    }
    corner = -b[0];
    for (size_t i = 0; i < m; i++)
        u[i] = 0;
    u[0] = corner;
    u[m - 1] = c[m - 1];
    b[0] -= corner;
    b[m - 1] -= c[m - 1] * a[0] / corner;
    memcpy(b2, b, m * sizeof *b);
    memcpy(c2, c, m * sizeof *c);
    solve_tridiagonal(m, a, b2, c2, s);
    memcpy(b2, b, m * sizeof *b);
    memcpy(c2, c, m * sizeof *c);
    solve_tridiagonal(m, a, b2, c2, u);
    share = (s[0] + a[0] * s[m - 1] / corner) / (1 + u[0] + a[0] * u[m - 1] / corner);
    for (size_t i = 0; i < m; i++)
        s[i] -= share * u[i];
    s[m] = s[0];
}

static void
slopes_along(const table *t, const axis *x, const double *f, double *s, double *room)
{
    (t->beyond == QDOT_SAMPLES_PERIODIC ? find_periodic_slopes : find_slopes)(x->n, x->knots, f, s, room);
}

/* The coefficients k [4] of the cubic on [0, h] through f, g with slopes s, r. */
static void
cubic(double h, double f, double g, double s, double r, double *k)
{
    const double d = (g - f) / h;

    k[0] = f;
    k[1] = s;
    k[2] = (3 * d - 2 * s - r) / h;
    k[3] = (s + r - 2 * d) / (h * h);
}

/* --- coefficients ----------------------------------------------------------------------- */

static qdot_status
new_coefficients(table *t, size_t pieces)
{
    const int most = t->degree + 1;

    for (int i = 0; i < most; i++)
        for (int j = 0; j < (t->axes == 2 ? most : 1); j++) {
            t->coefficient[4 * i + j] = qdot_calloc(pieces, sizeof(double));
            if (!t->coefficient[4 * i + j])
                return QDOT_ENOMEM;
        }
    return QDOT_OK;
}

/* The coefficients k [degree + 1] between knots i and i + 1 of an axis. */
static void
coefficients_between(const table *t, const axis *x, size_t i, const double *f, const double *s, double *k)
{
    const double h = x->knots[i + 1] - x->knots[i];

    k[0] = f[i];
    if (t->degree == 1)
        k[1] = (f[i + 1] - f[i]) / h;
    else if (t->degree == 3)
        cubic(h, f[i], f[i + 1], s[i], s[i + 1], k);
}

static qdot_status
fill_one_argument(table *t)
{
    const axis *x = &t->axis[0];
    double *room = qdot_calloc(7 * x->n, sizeof *room), k[4];

    if (!room)
        return QDOT_ENOMEM;
    if (t->degree == 3)
        slopes_along(t, x, t->values, room, room + x->n);
    for (size_t i = 0; i + 1 < x->n; i++) {
        coefficients_between(t, x, i, t->values, room, k);
        for (int c = 0; c <= t->degree; c++)
            t->coefficient[4 * c][i + 1] = k[c];
    }
    t->coefficient[0][0] = t->values[0];
    t->coefficient[0][x->n] = t->values[x->n - 1];
    qdot_free(room);
    return QDOT_OK;
}

/* Of two arguments, f(x, y): the coefficients along y at each knot of x, then along x of each of these. Where f holds its
 * value beyond an end, its coefficients are those at the end. */
static qdot_status
fill_two_arguments(table *t)
{
    const axis *x = &t->axis[0], *y = &t->axis[1];
    const size_t width = y->n + 1, most = x->n > y->n ? x->n : y->n;
    const int count = t->degree + 1;
    double *along = qdot_calloc(x->n * width * (size_t)count, sizeof *along);
    double *room = qdot_calloc(8 * most, sizeof *room), *f = room ? room + 7 * most : NULL, k[4];
    qdot_status status = along && room ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < x->n && status == QDOT_OK; i++) {
        const double *row = t->values + i * y->n;
        double *to = along + i * width * (size_t)count;

        if (t->degree == 3)
            slopes_along(t, y, row, room, room + most);
        for (size_t j = 0; j + 1 < y->n; j++)
            coefficients_between(t, y, j, row, room, to + (j + 1) * (size_t)count);
        to[0] = row[0];
        to[y->n * (size_t)count] = row[y->n - 1];
    }
    for (size_t j = 0; j < width && status == QDOT_OK; j++)
        for (int c = 0; c < count; c++) {
            double **to = t->coefficient;

            for (size_t i = 0; i < x->n; i++)
                f[i] = along[(i * width + j) * (size_t)count + (size_t)c];
            if (t->degree == 3)
                slopes_along(t, x, f, room, room + most);
            for (size_t i = 0; i + 1 < x->n; i++) {
                coefficients_between(t, x, i, f, room, k);
                for (int p = 0; p < count; p++)
                    to[4 * p + c][(i + 1) * width + j] = k[p];
            }
            to[c][j] = f[0];
            to[c][x->n * width + j] = f[x->n - 1];
        }
    qdot_free(along);
    qdot_free(room);
    return status;
}

/* --- adding a table --------------------------------------------------------------------- */

static void
table_free(table *t)
{
    if (!t)
        return;
    for (int k = 0; k < 2; k++)
        qdot_free(t->axis[k].knots);
    for (int k = 0; k < 16; k++)
        qdot_free(t->coefficient[k]);
    qdot_free(t->values);
    qdot_free(t);
}

static size_t
values_of(const qdot_samples_given *g)
{
    return g->axes == 2 ? g->n[0] * g->n[1] : g->n[0];
}

static bool
is_same(const table *t, const qdot_samples_given *g)
{
    if (t->axes != g->axes || t->degree != g->degree || t->beyond != g->beyond)
        return false;
    for (int k = 0; k < g->axes; k++)
        if (t->axis[k].n != g->n[k] || memcmp(t->axis[k].knots, g->knots[k], g->n[k] * sizeof(double)) != 0)
            return false;
    return memcmp(t->values, g->values, values_of(g) * sizeof(double)) == 0;
}

static double *
copy_of(const double *x, size_t n)
{
    double *copy = qdot_malloc(n * sizeof *copy);

    if (copy)
        memcpy(copy, x, n * sizeof *copy);
    return copy;
}

static qdot_status
table_new(const qdot_samples_given *g, table **out)
{
    table *t = qdot_calloc(1, sizeof *t);
    bool copied = t != NULL;
    qdot_status status = QDOT_ENOMEM;

    if (t)
        *t = (table){.axes = g->axes, .degree = g->degree, .beyond = g->beyond};
    for (int k = 0; k < g->axes && copied; k++) {
        t->axis[k] = (axis){g->n[k], copy_of(g->knots[k], g->n[k])};
        copied = t->axis[k].knots != NULL;
    }
    if (copied)
        t->values = copy_of(g->values, values_of(g));
    if (copied && t->values)
        status = new_coefficients(t, (g->n[0] + 1) * (g->axes == 2 ? g->n[1] + 1 : 1));
    if (status == QDOT_OK)
        status = (g->axes == 2 ? fill_two_arguments : fill_one_argument)(t);
    if (status != QDOT_OK) {
        table_free(t);
        t = NULL;
    }
    *out = t;
    return status;
}

qdot_status
qdot_samples_add(const qdot_samples_given *given, int *number)
{
    qdot_status status = QDOT_OK;

    pthread_mutex_lock(&adding);
    for (*number = 0; *number < n_tables; ++*number)
        if (is_same(tables[*number], given))
            break;
    if (*number == MOST_TABLES)
        status = qdot_fail(QDOT_ELIMIT, "more than %d tables of data", MOST_TABLES);
    else if (*number == n_tables) {
        table *t;

        status = table_new(given, &t);
        if (status == QDOT_OK) {
            tables[*number] = t;
            n_tables = *number + 1;
        }
    }
    pthread_mutex_unlock(&adding);
    return status;
}

/* --- reading ---------------------------------------------------------------------------- */

int64_t
qdot_samples_piece(int number, int axis_)
{
    return (int64_t)number * ITEMS + PIECE + axis_;
}

int64_t
qdot_samples_knot(int number, int axis_)
{
    return (int64_t)number * ITEMS + KNOT + axis_;
}

int64_t
qdot_samples_coefficient(int number, int i, int j)
{
    return (int64_t)number * ITEMS + COEFFICIENT + 4 * i + j;
}

int64_t
qdot_samples_width(int number)
{
    const table *t = tables[number];

    return (int64_t)t->axis[1].n + 1;
}

/* The number of knots that are not beyond u, within the range: by where u is in it, which is right for equal distances,
 * else by bisection. */
static size_t
knots_up_to(const axis *x, double u)
{
    const double *k = x->knots;
    size_t low = (size_t)((u - k[0]) / (k[x->n - 1] - k[0]) * (double)(x->n - 1)), high = x->n - 1;

    low = low < high ? low : high - 1;
    if (k[low] <= u && u < k[low + 1])
        return low + 1;
    if (k[low] > u)
        high = low, low = 0;
    else
        low++;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;

        if (k[middle] <= u)
            low = middle;
        else
            high = middle;
    }
    return low + 1;
}

/* The number of the piece that holds u; NaN: none does. */
static double
piece_at_place(const table *t, const axis *x, double u)
{
    const double first = x->knots[0], last = x->knots[x->n - 1], length = last - first;
    const double more = slack * (length + fmax(fabs(first), fabs(last)));

    if (isnan(u) || isinf(u))
        return NAN;
    if (t->beyond == QDOT_SAMPLES_PERIODIC) {
        const double turns = floor((u - first) / length);
        double inside = u - turns * length;

        if (inside >= last)
            return (turns + 1) * (double)(x->n - 1) + 1;
        if (inside < first)
            return turns * (double)(x->n - 1);
        return turns * (double)(x->n - 1) + (double)knots_up_to(x, inside);
    }
    if (u >= last)
        return t->beyond == QDOT_SAMPLES_HOLD || (t->degree == 0 && u <= last + more) ? (double)x->n
               : u <= last + more                                                   ? (double)x->n - 1
                                                                                    : NAN;
    if (u < first)
        return t->beyond == QDOT_SAMPLES_HOLD ? 0 : u >= first - more ? 1 : NAN;
    return (double)knots_up_to(x, u);
}

/* The piece as a number of those stored; *shift: by how much the place of its knot is moved. */
static size_t
stored_piece(const table *t, const axis *x, double piece, double *shift)
{
    const double period = (double)(x->n - 1);
    double turns;

    *shift = 0;
    if (t->beyond != QDOT_SAMPLES_PERIODIC)
        return (size_t)piece;
    turns = floor((piece - 1) / period);
    *shift = turns * (x->knots[x->n - 1] - x->knots[0]);
    return (size_t)(piece - turns * period);
}

/* The knot from which a piece's polynomial counts. */
static double
knot_of_piece(const table *t, const axis *x, double piece)
{
    double shift;
    const size_t at = stored_piece(t, x, piece, &shift);

    return x->knots[at > 0 ? at - 1 : 0] + shift;
}

double
qdot_samples_lookup(double handle, double x)
{
    int item;
    const table *t = table_of(handle, &item);
    double shift;

    if (qdot_past_has(handle))
        return qdot_past_lookup(handle, x);
    if (!t || isnan(x) || (item < COEFFICIENT && item % KNOT >= t->axes))
        return NAN;
    if (item < KNOT)
        return piece_at_place(t, &t->axis[item - PIECE], x);
    if (item < COEFFICIENT)
        return knot_of_piece(t, &t->axis[item - KNOT], x);
    if (!t->coefficient[item - COEFFICIENT])
        return 0;
    return t->coefficient[item - COEFFICIENT][t->axes == 2 ? (size_t)x : stored_piece(t, &t->axis[0], x, &shift)];
}

bool
qdot_samples_look(double handle, qdot_samples_view *view)
{
    int item = ITEMS;
    const table *t = table_of(handle, &item);
    const axis *x;

    if (!t || (item < COEFFICIENT && item % KNOT >= t->axes))
        return false;
    x = &t->axis[item < COEFFICIENT ? item % KNOT : 0];
    *view = (qdot_samples_view){
        .item = item < KNOT ? QDOT_SAMPLES_PIECE : item < COEFFICIENT ? QDOT_SAMPLES_KNOT : QDOT_SAMPLES_COEFFICIENT,
        .at = x->knots,
        .n = x->n,
        .period = t->beyond == QDOT_SAMPLES_PERIODIC ? x->n - 1 : 0,
        .beyond = t->beyond,
        .jumps = t->degree == 0};
    if (item >= COEFFICIENT) {
        view->at = t->coefficient[item - COEFFICIENT];
        view->n = (t->axis[0].n + 1) * (t->axes == 2 ? t->axis[1].n + 1 : 1);
    }
    return view->at != NULL;
}

bool
qdot_samples_finds(double handle)
{
    int item = ITEMS;

    return qdot_past_finds(handle) || (table_of(handle, &item) && item < KNOT);
}

void
qdot_samples_bounds(double handle, double x, double *lo, double *hi)
{
    int item;
    const table *t = table_of(handle, &item);
    const double piece = t ? qdot_samples_lookup(handle, x) : NAN;
    const axis *along;

    *lo = *hi = NAN;
    if (isnan(piece))
        return;
    along = &t->axis[item - PIECE];
    if (t->beyond == QDOT_SAMPLES_PERIODIC) {
        *lo = knot_of_piece(t, along, piece);
        *hi = knot_of_piece(t, along, piece + 1);
        return;
    }
    *lo = piece == 0 ? -INFINITY : along->knots[(size_t)piece - 1];
    *hi = piece == (double)along->n ? INFINITY : along->knots[(size_t)piece];
}

double
qdot_samples_blur(double handle)
{
    int item;
    const table *t = table_of(handle, &item);

    if (!t || item >= KNOT || t->beyond != QDOT_SAMPLES_PERIODIC)
        return 0;
    return fabs(t->axis[item].knots[0]) + fabs(t->axis[item].knots[t->axis[item].n - 1]);
}

bool
qdot_samples_is_same(double a, double b)
{
    int item;

    return table_of(a, &item) != NULL && table_of(a, &item) == table_of(b, &item);
}

bool
qdot_samples_jumps(double handle)
{
    int item;
    const table *t = table_of(handle, &item);

    return t && t->degree == 0;
}

bool
qdot_samples_range(double handle, double *lo, double *hi)
{
    int item = ITEMS;
    const table *t = table_of(handle, &item);

    if (!t || item >= KNOT)
        return false;
    *lo = t->axis[item].knots[0];
    *hi = t->axis[item].knots[t->axis[item].n - 1];
    return t->beyond == QDOT_SAMPLES_END;
}
