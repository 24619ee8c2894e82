/* chebyshev.c -- fits Chebyshev series, sums them by Clenshaw's method, and finds roots by halving intervals. */
#include "num/chebyshev.h"

#include <float.h>
#include <math.h>
#include <pthread.h>
#include <string.h>

enum { most = QDOT_CHEBYSHEV_MOST, quarters = 4 * most };

/* The largest number of halvings of an interval: the smallest has 2^-44 of the whole length. */
enum { deepest = 45 };

/* The most intervals that halving about one root makes; a series of n coefficients has fewer than n roots. */
enum { pieces_of_root = 2 * deepest };

/* A fit is good if its last coefficients are below this fraction of the largest. */
static const double unfitted = 0x1p-36;

/* table of cos(m pi / (2 most)), and of T_k at the nodes, row by row */
static double cosine[quarters];
static double at_node[2 * most][most];
static pthread_once_t once = PTHREAD_ONCE_INIT;

/* The values T_k, k < n, at node j of n nodes; the rows for `most` nodes come first, then those for
 * half as many. */
static const double *
node_table_row(int n, int j)
{
    return at_node[2 * most - 2 * n + j];
}

static void
fill_cosines(void)
{
    for (int m = 0; m < quarters; m++)
        cosine[m] = cos(m * M_PI / (2 * most));
    cosine[most] = cosine[3 * most] = 0;
    for (int n = most; n >= 1; n /= 2)
        for (int j = 0; j < n; j++)
            for (int k = 0; k < n; k++)
                at_node[2 * most - 2 * n + j][k] =
                    cosine[(2 * j + 1) * k * (most / n) % quarters];
}

double
qdot_chebyshev_node(int n, int j)
{
    pthread_once(&once, fill_cosines);
    return cosine[(2 * j + 1) * (most / n)];
}

void
qdot_chebyshev_fit(int n, const double *values, double *c)
{
    double sum[most] = {0};

    pthread_once(&once, fill_cosines);
    for (int j = 0; j < n; j++) {
        const double *T = node_table_row(n, j);

        for (int k = 0; k < n; k++)
            sum[k] += values[j] * T[k];
    }
    for (int k = 0; k < n; k++)
        c[k] = (k == 0 ? 1.0 : 2.0) / n * sum[k];
}

double
qdot_chebyshev_at(int n, const double *c, double x)
{
    double b = 0, b1 = 0;

    for (int k = n; k-- > 1;) {
        double next = c[k] + 2 * x * b - b1;

        b1 = b;
        b = next;
    }
    return c[0] + x * b - b1;
}

void
qdot_chebyshev_derivative(int n, const double *c, double *d)
{
    double above = 0, at = 0; /* coefficients d_(k+2) and d_(k+1) of the derivative */

    for (int k = n - 2; k >= 0; k--) {
        double now = above + 2 * (k + 1) * c[k + 1];

        above = at;
        at = now;
        d[k] = now;
    }
    d[0] *= 0.5;
}

double
qdot_chebyshev_integral(int n, const double *c)
{
    double sum = 0;

    for (int k = 0; k < n; k += 2)
        sum += 2 * c[k] / (1 - (double)k * k);
    return sum;
}

/* coefficients in T_k((x - 1)/2) = sum_j half[k][j] T_j(x), j = 0 ... k, from T_k+1(y) = 2 y T_k(y) - T_k-1(y) */
static double half[most][most];
static pthread_once_t once_half = PTHREAD_ONCE_INIT;

static void
fill_half_table(void)
{
    long double two[2][most + 1] = {{1}, {-0.5L, 0.5L}};

    half[0][0] = 1;
    half[1][0] = -0.5;
    half[1][1] = 0.5;
    for (int k = 2; k < most; k++) {
        long double *now = two[k % 2]; /* holds T_(k-2), to be replaced by T_k */
        const long double *last = two[(k + 1) % 2];

        for (int j = 0; j <= k; j++)
            now[j] = -now[j] - last[j] + 0.5L * last[j + 1]
                     + (j == 1 ? last[0] : j > 1 ? 0.5L * last[j - 1] : 0);
        for (int j = 0; j <= k; j++)
            half[k][j] = (double)now[j];
    }
}

void
qdot_chebyshev_halves(int n, const double *c, double *left, double *right)
{
    pthread_once(&once_half, fill_half_table);
    memset(left, 0, (size_t)n * sizeof *left);
    memset(right, 0, (size_t)n * sizeof *right);
    for (int k = 0; k < n; k++) {
        double mirrored = k % 2 ? -c[k] : c[k]; /* the coefficient of the mirrored series c(-x) */

        for (int j = 0; j <= k; j++) {
            left[j] += half[k][j] * c[k];
            right[j] += half[k][j] * mirrored;
        }
    }
    for (int j = 1; j < n; j += 2)
        right[j] = -right[j];
}

double
qdot_chebyshev_tail(int n, const double *c)
{
    const int tail = n / 8 + 1;

    return qdot_chebyshev_size(tail, c + n - tail);
}

double
qdot_chebyshev_size(int n, const double *c)
{
    double largest = 0;

    for (int k = 0; k < n; k++) /* the comparison ignores a NaN */
        largest = fabs(c[k]) > largest ? fabs(c[k]) : largest;
    return largest;
}

double
qdot_chebyshev_spread(int n, const double *c)
{
    double sum = 0;

    for (int k = 1; k < n; k++)
        sum += fabs(c[k]);
    return sum;
}

double
qdot_chebyshev_ellipse(int n, const double *c, double noise, double rho)
{
    double sum = 0, power = 1;

    if (!(qdot_chebyshev_tail(n, c) <= fmax(unfitted * qdot_chebyshev_size(n, c), noise)))
        return INFINITY;
    for (int k = 1; k < n; k++) {
        power *= rho;
        if (fabs(c[k]) > noise)
            sum += 0.5 * fabs(c[k]) * (power + 1 / power);
    }
    return sum;
}

int
qdot_chebyshev_sign(int n, const double *c)
{
    return fabs(c[0]) > qdot_chebyshev_spread(n, c) ? (c[0] > 0) - (c[0] < 0) : 0;
}

/* --- roots of a series -------------------------------------------------------------- */

typedef struct {
    double lo, hi; /* the ends of this piece, in the variable x of the whole series */
    double at_lo, at_hi;
    int n;
    double c[most];
} piece;

static bool
sign_changes(double a, double b)
{
    return (a < 0) != (b < 0);
}

/* The number of coefficients of a series up to the last one above the rounding error of its sum. */
static int
shorten_series(int n, const double *c)
{
    double least = 0x1p-56 * qdot_chebyshev_size(n, c);

    while (n > 2 && fabs(c[n - 1]) <= least)
        n--;
    return n;
}

/* Find a root of a Chebyshev series in lo..hi by the Illinois variant of the secant method. */
double
qdot_chebyshev_root(int n, const double *c, double lo, double hi)
{
    const double rounding = 4 * DBL_EPSILON * qdot_chebyshev_spread(n, c);
    double at_lo = qdot_chebyshev_at(n, c, lo), at_hi = qdot_chebyshev_at(n, c, hi), x = lo;

    int kept = 0; /* which end of the interval the last step did not move: -1 lo, 1 hi, 0 none yet */

    n = shorten_series(n, c);
    for (int k = 0; k < 100; k++) {
        double now;

        x = at_hi != at_lo ? hi - at_hi * (hi - lo) / (at_hi - at_lo) : 0.5 * (lo + hi);
        if (!(x > lo && x < hi) || k % 8 == 7)
            x = 0.5 * (lo + hi);
        if (x == lo || x == hi)
            break;
        now = qdot_chebyshev_at(n, c, x);
        if (fabs(now) <= rounding)
            break;
        if (sign_changes(at_lo, now)) {
            hi = x;
            at_hi = now;
            at_lo *= kept < 0 ? 0.5 : 1;
            kept = -1;
        } else {
            lo = x;
            at_lo = now;
            at_hi *= kept > 0 ? 0.5 : 1;
            kept = 1;
        }
    }
    return x;
}

/* The only root of the piece p of a series, an interval at whose ends the signs differ. */
static double
root_of_piece(const piece *p)
{
    const double x = qdot_chebyshev_root(p->n, p->c, -1, 1);

    return 0.5 * (p->lo + p->hi) + 0.5 * (p->hi - p->lo) * x;
}

static bool
is_monotone(const piece *p)
{
    double d[most];

    if (p->n < 3)
        return true;
    qdot_chebyshev_derivative(p->n, p->c, d);
    return qdot_chebyshev_sign(p->n - 1, d) != 0;
}

static void
halve_piece(const piece *p, piece *left, piece *right)
{
    double middle = qdot_chebyshev_at(p->n, p->c, 0);

    left->lo = p->lo;
    left->at_lo = p->at_lo;
    left->hi = right->lo = 0.5 * (p->lo + p->hi);
    left->at_hi = right->at_lo = middle;
    right->hi = p->hi;
    right->at_hi = p->at_hi;
    qdot_chebyshev_halves(p->n, p->c, left->c, right->c);
    left->n = shorten_series(p->n, left->c);
    right->n = shorten_series(p->n, right->c);
}

int
qdot_chebyshev_crossings(int n, const double *c, double *roots)
{
    piece stack[deepest + 2], left, right;
    int depth = 0, found = 0, left_to_do = pieces_of_root * (n + 1);

    if (!isfinite(qdot_chebyshev_spread(n, c)) || !isfinite(c[0]))
        return -1;
    stack[0] = (piece){.lo = -1, .hi = 1, .n = shorten_series(n, c)};
    memcpy(stack[0].c, c, (size_t)n * sizeof *c);
    stack[0].at_lo = qdot_chebyshev_at(stack[0].n, c, -1);
    stack[0].at_hi = qdot_chebyshev_at(stack[0].n, c, 1);
    for (depth = 1; depth > 0;) {
        const piece *p = &stack[--depth];

        if (left_to_do-- == 0)
            return -1;
        if (qdot_chebyshev_sign(p->n, p->c) != 0)
            continue;
        if (is_monotone(p) || p->hi - p->lo < 0x1p-43) {
            if (sign_changes(p->at_lo, p->at_hi) && found < n)
                roots[found++] = root_of_piece(p);
            continue;
        }
        halve_piece(p, &left, &right);
        stack[depth++] = right;
        stack[depth++] = left;
    }
    return found;
}
