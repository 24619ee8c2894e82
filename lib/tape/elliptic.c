/* elliptic.c -- writes elliptic integrals and Jacobi's amplitude as operations of a tape. */
#include "tape/elliptic.h"

#include "expr/build.h"
#include "expr/elliptic.h"
#include "expr/exact.h"

enum { STEPS = 8, STEPS_OF_P = 40 };

/* The means a_0 ... and b_0 ..., of a parameter m, and c_1 ... (c_0 is not used). */
typedef struct {
    qdot_code *code;
    qdot_value a[STEPS + 1], b[STEPS + 1], c[STEPS + 1];
} means;

static qdot_value
added(qdot_code *code, qdot_value x, qdot_value y)
{
    return qdot_code_op(code, QDOT_OP_ADD, x, y, 0);
}

static qdot_value
minus(qdot_code *code, qdot_value x, qdot_value y)
{
    return qdot_code_op(code, QDOT_OP_SUB, x, y, 0);
}

static qdot_value
times(qdot_code *code, qdot_value x, qdot_value y)
{
    return qdot_code_op(code, QDOT_OP_MUL, x, y, 0);
}

static qdot_value
over(qdot_code *code, qdot_value x, qdot_value y)
{
    return qdot_code_op(code, QDOT_OP_DIV, x, y, 0);
}

static qdot_value
root(qdot_code *code, qdot_value x)
{
    return qdot_code_op(code, QDOT_OP_SQRT, x, 0, 0);
}

static qdot_value
constant(qdot_code *code, int64_t p, int64_t q)
{
    return qdot_code_constant(code, qdot_expr_ratio(code->pool, p, q));
}

static void
write_means(means *w, qdot_code *code, qdot_value m)
{
    const qdot_value one = qdot_code_constant(code, QDOT_ONE), half = qdot_code_constant(code, QDOT_HALF);

    w->code = code;
    w->a[0] = one;
    w->b[0] = root(code, minus(code, one, m));
    for (int n = 0; n < STEPS; n++) {
        w->a[n + 1] = times(code, half, added(code, w->a[n], w->b[n]));
        w->b[n + 1] = root(code, times(code, w->a[n], w->b[n]));
        w->c[n + 1] = times(code, half, minus(code, w->a[n], w->b[n]));
    }
}

/* K(m). The limit is taken as b_N, which is 0 for m = 1, where K is infinite. */
static qdot_value
first_kind(const means *w)
{
    const qdot_value right = qdot_code_constant(w->code, qdot_mul(w->code->pool, QDOT_HALF, QDOT_PI));

    return over(w->code, right, w->b[STEPS]);
}

/* 1 - E(m)/K(m). */
static qdot_value
share_of_second_kind(const means *w, qdot_value m)
{
    qdot_value sum = times(w->code, qdot_code_constant(w->code, QDOT_HALF), m);

    for (int n = 1; n <= STEPS; n++)
        sum = added(w->code, sum, times(w->code, constant(w->code, INT64_C(1) << (n - 1), 1), times(w->code, w->c[n], w->c[n])));
    return sum;
}

/* Pi(n, m). */
static qdot_value
third_kind(const means *w, qdot_value n)
{
    qdot_code *code = w->code;
    const qdot_value one = qdot_code_constant(code, QDOT_ONE), half = qdot_code_constant(code, QDOT_HALF);
    const qdot_value rest = minus(code, one, n);
    qdot_value p = root(code, rest), q = one, sum = one;

    for (int k = 0; k < STEPS_OF_P; k++) { /* p may be far from the limit and is halved at each step */
        const int i = k < STEPS ? k : STEPS;
        const qdot_value square = times(code, p, p), ab = times(code, w->a[i], w->b[i]), both = added(code, square, ab);

        q = times(code, half, times(code, q, over(code, minus(code, square, ab), both)));
        sum = added(code, sum, q);
        p = times(code, half, over(code, both, p));
    }
    sum = added(code, one, times(code, half, times(code, over(code, n, rest), sum)));
    return times(code, first_kind(w), sum);
}

/* atan(y/x), x > 0. */
static qdot_value
arc(qdot_code *code, qdot_value y, qdot_value x)
{
    return qdot_code_op(code, QDOT_OP_ATAN, over(code, y, x), 0, 0);
}

/* F(phi, m); *waves: the sum of c_n sin(phi_n), n > 0. */
static qdot_value
incomplete(const means *w, qdot_value phi, qdot_value *waves)
{
    qdot_code *code = w->code;
    qdot_value s, c;

    *waves = qdot_code_constant(code, QDOT_ZERO);
    for (int n = 0; n < STEPS; n++) {
        qdot_value below;

        qdot_code_sincos(code, phi, &s, &c);
        if (n > 0)
            *waves = added(code, *waves, times(code, w->c[n], s));
        below = added(code, times(code, w->a[n], times(code, c, c)), times(code, w->b[n], times(code, s, s)));
        s = times(code, minus(code, w->a[n], w->b[n]), times(code, s, c));
        phi = minus(code, added(code, phi, phi), arc(code, s, below));
    }
    qdot_code_sincos(code, phi, &s, &c);
    *waves = added(code, *waves, times(code, w->c[STEPS], s));
    return over(code, times(code, constant(code, 1, INT64_C(1) << STEPS), phi), w->b[STEPS]);
}

/* am(u, m). */
static qdot_value
amplitude(const means *w, qdot_value u)
{
    qdot_code *code = w->code;
    const qdot_value half = qdot_code_constant(code, QDOT_HALF);
    /* b_N from b_N^2: no number for m = 1, where both means tend to 0 */
    const qdot_value limit = over(code, times(code, w->a[STEPS - 1], w->b[STEPS - 1]), w->b[STEPS]);
    qdot_value phi = times(code, times(code, constant(code, INT64_C(1) << STEPS, 1), limit), u);

    for (int n = STEPS; n > 0; n--) {
        qdot_value s, c, below;

        qdot_code_sincos(code, phi, &s, &c);
        c = times(code, w->a[n], c);
        below = times(code, w->b[n], s);
        below = root(code, added(code, times(code, c, c), times(code, below, below)));
        phi = times(code, half, added(code, phi, arc(code, times(code, w->c[n], s), below)));
    }
    return phi;
}

/* dn = sqrt(cn^2 + (1 - m) sn^2). */
static qdot_value
dn_of_amplitude(qdot_code *code, qdot_value am, qdot_value m)
{
    const qdot_value rest = minus(code, qdot_code_constant(code, QDOT_ONE), m);
    qdot_value s, c;

    qdot_code_sincos(code, am, &s, &c);
    return root(code, added(code, times(code, c, c), times(code, rest, times(code, s, s))));
}

bool
qdot_code_elliptic(qdot_code *code, qdot_fun_id f, uint32_t n, const qdot_value *x, qdot_value *y)
{
    const qdot_value m = x[n - 1];
    qdot_value first, whole, waves;
    means w;

    if (!qdot_is_elliptic(f) || n == 3)
        return false;
    code->approximate = true;
    write_means(&w, code, m);
    if (f == QDOT_JACOBI_AM || f == QDOT_JACOBI_DN) {
        *y = amplitude(&w, x[0]);
        if (f == QDOT_JACOBI_DN)
            *y = dn_of_amplitude(code, *y, m);
        return true;
    }
    if (f == QDOT_ELLIPTIC_PI) {
        *y = third_kind(&w, x[0]);
        return true;
    }
    if (n == 1) {
        first = whole = first_kind(&w);
    } else {
        first = whole = incomplete(&w, x[0], &waves);
        if (f == QDOT_ELLIPTIC_E)
            whole = added(code, first, waves);
    }
    *y = f == QDOT_ELLIPTIC_E ? minus(code, whole, times(code, first, share_of_second_kind(&w, m))) : first;
    return true;
}
