/* near.c -- shortens a step so that no term that is negligible at its start can grow unseen. */
#include "series/near.h"

#include <float.h>
#include <math.h>

#include "num/series.h"

enum { halvings = 20 };

double
qdot_near_limit(int p, double u0, double digits)
{
    return fmax(0.5 * (p + 1), fabs(u0) - digits - QDOT_NEAR_BEYOND);
}

/* The sum of |x_k| s^k over k >= 1, by even and odd orders, which the processor sums in parallel. */
double
qdot_near_sum(int p, const double *x, double s)
{
    const double s2 = s * s;
    double odd = 0, even = 0;
    int k = p;

    if (k % 2 == 1)
        odd = fabs(x[k--]);
    for (; k >= 2; k -= 2) {
        even = (even + fabs(x[k])) * s2;
        odd = odd * s2 + fabs(x[k - 1]);
    }
    return even + odd * s;
}

static double
sum_of_magnitudes(int p, const double *log2_sizes, double log2_h)
{
    double sum = 0;

    for (int k = 1; k <= p; k++)
        sum += exp2(log2_sizes[k] + k * log2_h);
    return sum;
}

double
qdot_near_log2(int p, const double *log2_sizes, double limit, double log2_h)
{
    double high = INFINITY, low; /* bounds: at `high` one term alone reaches the limit; at `low` each term has 1/p of it */

    for (int k = 1; k <= p; k++)
        if (log2_sizes[k] > -INFINITY)
            high = fmin(high, (log2(limit) - log2_sizes[k]) / k);
    low = high - log2(p);
    if (!(log2_h > low))
        return log2_h;
    high = fmin(high, log2_h);
    if (sum_of_magnitudes(p, log2_sizes, high) <= limit)
        return high;
    for (int i = 0; i < halvings; i++) {
        const double middle = 0.5 * (low + high);

        if (sum_of_magnitudes(p, log2_sizes, middle) <= limit)
            low = middle;
        else
            high = middle;
    }
    return low;
}

double
qdot_near_argument(int p, const double *u, double times, double s)
{
    static const double digits = DBL_MANT_DIG * 0.6931471805599453;
    double sizes[QDOT_SERIES_MOST + 1];
    const double limit = qdot_near_limit(p, times * u[0], digits) / times;

    if (qdot_near_sum(p, u, s) <= limit)
        return s;
    for (int k = 1; k <= p; k++)
        sizes[k] = log2(fabs(u[k]));
    return exp2(qdot_near_log2(p, sizes, limit, log2(s)));
}

/* --- divisors that may vanish ---------------------------------------------------------- */

/* A zero of b lies at half of a step at least whose sum is below `well_before`, if it is double; it
 * is looked for in quarters. */
static const double well_before = 8;
enum { quarters = 4, shorter = 40 };

static double
evaluate_polynomial(int p, const double *b, double s)
{
    double sum = b[p];

    for (int k = p - 1; k >= 0; k--)
        sum = sum * s + b[k];
    return sum;
}

/* The first quarter of the step at whose end the divisor b is much smaller than b_0; 0 if there is none. */
static int
quarter_where_divisor_falls(int p, const double *b, double s)
{
    for (int j = 1; j <= quarters; j++)
        if (!(evaluate_polynomial(p, b, s * j / quarters) / b[0] >= QDOT_NEAR_LEFT))
            return j;
    return 0;
}

bool
qdot_near_may_fall(int p, const double *b, double s)
{
    return qdot_near_sizes_may_fall(fabs(b[0]), qdot_near_sum(p, b, s));
}

double
qdot_near_divisor(int p, const double *b, bool root, double s)
{
    const double size = fabs(b[0]), whole = s;

    if (isinf(s)) { /* a single term of the sum already exceeds the limit there */
        double least = 0;

        for (int k = 1; k <= p; k++)
            if (b[k] != 0)
                least = fmax(least, pow(fabs(b[k]) / size, 1.0 / k));
        if (least == 0)
            return s;
        s = well_before / least;
    }
    for (int i = 0; i < shorter && !(qdot_near_sum(p, b, s) <= well_before * size); i++)
        s *= 0.5;
    for (int i = 0; i < shorter; i++) {
        const int j = quarter_where_divisor_falls(p, b, s);

        if (j == 0)
            return s;
        if (root && evaluate_polynomial(p, b, s * j / quarters) / b[0] <= 0)
            return whole;
        s *= j > 1 ? (double)(j - 1) / quarters : 0.5 / quarters;
    }
    return s;
}

/* --- knots of tables -------------------------------------------------------------------- */

/* u is compared with the ends of the piece at so many places of a step; the passage is then found by so many bisections. */
enum { PLACES = 32, BISECTIONS = 50 };

/* The same of u_0 + u_1 s. */
static double
linear_near_knot(const double *u, double lo, double hi, double beyond, double s)
{
    const double at = (u[1] > 0 ? hi + beyond - u[0] : lo - beyond - u[0]) / u[1];

    return at < s ? at : s;
}

double
qdot_near_knot(int p, const double *u, double lo, double hi, double s)
{
    const double size = fmax(fabs(u[0]), isfinite(hi - lo) ? hi - lo : 0), beyond = 8 * DBL_EPSILON * size;
    double in = 0, out = 0;

    while (p > 1 && u[p] == 0)
        p--;
    if (!(u[0] >= lo && u[0] <= hi) || qdot_near_sum(p, u, s) <= fmin(u[0] - lo, hi - u[0]))
        return s;
    if (p == 1)
        return linear_near_knot(u, lo, hi, beyond, s);
    if (isinf(s)) { /* a polynomial, which passes a knot within this unless it is one number */
        for (s = 1; isfinite(s) && qdot_near_sum(p, u, s) < 4 * size + fmin(u[0] - lo, hi - u[0]);)
            s *= 2;
        if (!isfinite(s))
            return s;
    }
    for (int k = 1; k <= PLACES && out == 0; k++) {
        const double at = evaluate_polynomial(p, u, s * k / PLACES);

        if (at > hi + beyond || at < lo - beyond)
            out = s * k / PLACES;
        else
            in = s * k / PLACES;
    }
    if (out == 0)
        return s;
    for (int k = 0; k < BISECTIONS; k++) {
        const double middle = 0.5 * (in + out), at = evaluate_polynomial(p, u, middle);

        if (at > hi + beyond || at < lo - beyond)
            out = middle;
        else
            in = middle;
    }
    return out;
}

bool
qdot_near_diverges(int p, const double *quotient, double s)
{
    const double first = fmax(fabs(quotient[0]), fabs(quotient[1]) * s);

    for (int k = p; k >= p - 1 && k > 1; k--)
        if (log2(fabs(quotient[k])) + k * log2(s) > log2(first))
            return true;
    return false;
}
