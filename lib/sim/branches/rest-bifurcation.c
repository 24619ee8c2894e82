/* rest-bifurcation.c -- extended systems whose zeros are bifurcations of equilibria; guesses,
 * classification. */
#include "sim/branches/rest-bifurcation.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "tape/derivative.h"

/* Components of a unit tangent along p below `upright` count as 0; entries of Gamma below
 * `undamped` mean no damping. */
static const double upright = 1e-8, undamped = 1e-9;
/* --- systems of equations for bifurcations ------------------------------------------------ */

/* A new symbol for the k-th auxiliary unknown of a given kind; it is not a symbol of the scene. */
static qdot_expr
auxiliary_symbol(qdot_pool *pool, const char *kind, size_t k)
{
    char name[60];

    snprintf(name, sizeof name, "%s of the bifurcation[%zu]", kind, k + 1);
    return qdot_symbol_get(pool, QDOT_FORMAL, name);
}

static void
add_to(qdot_pool *pool, qdot_expr *sum, qdot_expr a, qdot_expr b)
{
    *sum = qdot_add(pool, *sum, qdot_mul(pool, a, b));
}

/* Begin an extended system of equations: its first unknowns are always y, `more` others follow. */
static qdot_status
begin_extended_system(const qdot_rest_bifurcations *b, size_t more, qdot_newton *s)
{
    const qdot_equilibrium_curve *c = b->x->c;

    QDOT_TRY(qdot_newton_begin(s, c->pool, c->n + 1 + more));
    for (size_t i = 0; i <= c->n; i++)
        s->x[i] = c->unknown[i];
    for (size_t i = 0; i < c->n; i++)
        s->f[i] = c->F[i];
    return QDOT_OK;
}

static qdot_status
make_fold_system(qdot_rest_bifurcations *b)
{
    const qdot_equilibrium_curve *c = b->x->c;
    const size_t n = c->n;
    qdot_newton *s = &b->fold;

    QDOT_TRY(begin_extended_system(b, n, s));
    s->f[2 * n] = QDOT_MINUS_ONE;
    for (size_t i = 0; i < n; i++)
        s->x[n + 1 + i] = auxiliary_symbol(c->pool, "phi", i);
    for (size_t i = 0; i < n; i++) {
        s->f[n + i] = QDOT_ZERO;
        for (size_t j = 0; j < n; j++)
            add_to(c->pool, &s->f[n + i], qdot_diff(c->pool, c->F[i], c->unknown[j]),
                   s->x[n + 1 + j]);
        add_to(c->pool, &s->f[2 * n], s->x[n + 1 + i], s->x[n + 1 + i]);
    }
    return qdot_newton_lower(s);
}

static qdot_status
make_crossing_system(qdot_rest_bifurcations *b)
{
    const qdot_equilibrium_curve *c = b->x->c;
    const size_t n = c->n;
    qdot_newton *s = &b->crossing;
    qdot_expr product = QDOT_ZERO, beta = auxiliary_symbol(c->pool, "beta", 0);

    QDOT_TRY(begin_extended_system(b, n + 1, s));
    s->f[2 * n + 1] = QDOT_MINUS_ONE;
    s->x[2 * n + 1] = beta;
    for (size_t i = 0; i < n; i++) {
        const qdot_expr psi = s->x[n + 1 + i] = auxiliary_symbol(c->pool, "psi", i);

        add_to(c->pool, &s->f[i], beta, psi);
        add_to(c->pool, &s->f[2 * n + 1], psi, psi);
        add_to(c->pool, &product, psi, c->F[i]);
    }
    for (size_t j = 0; j <= n; j++)
        s->f[n + j] = qdot_diff(c->pool, product, c->unknown[j]);
    return qdot_newton_lower(s);
}

/* Row i of (K - w^2 M) z, where z are the unknowns of the system from index `z` on. */
static qdot_expr
eigenvalue_equation(const qdot_rest_bifurcations *b, const qdot_newton *s, qdot_expr square, size_t i, size_t z)
{
    const qdot_equilibrium_curve *c = b->x->c;
    qdot_expr sum = QDOT_ZERO;

    for (size_t j = 0; j < c->all; j++) {
        const size_t at = i * c->all + j;

        add_to(c->pool, &sum,
               qdot_sub(c->pool, c->K[at], qdot_mul(c->pool, square, c->M[at])), s->x[z + j]);
    }
    return sum;
}

/* What meets on the imaginary axis: nothing; two frequencies without Gamma, or with one that is
 * antisymmetric beside a symmetric K. */
typedef enum { CROSSES, MEETS, MEETS_TURNING } meeting;

/* Where two frequencies meet under gyroscopic forces: beta z to the rows, which depend on each other
 * without it, and the derivative of the Hermitian form by w. */
static void
add_gyroscopic_terms(const qdot_rest_bifurcations *b, qdot_newton *s, qdot_expr w)
{
    const qdot_equilibrium_curve *c = b->x->c;
    const size_t n = c->n, all = c->all, re = n + 1, im = re + all;
    qdot_pool *pool = c->pool;
    qdot_expr beta = auxiliary_symbol(pool, "beta", 0), sum = QDOT_ZERO;

    s->x[im + all + 1] = beta;
    for (size_t i = 0; i < all; i++) {
        add_to(pool, &s->f[n + i], qdot_neg(pool, beta), s->x[im + i]);
        add_to(pool, &s->f[n + all + i], beta, s->x[re + i]);
        for (size_t j = 0; j < all; j++) {
            const qdot_expr M = qdot_mul(pool, w, c->M[i * all + j]);

            add_to(pool, &sum, qdot_mul(pool, s->x[re + i], s->x[re + j]), M);
            add_to(pool, &sum, qdot_mul(pool, s->x[im + i], s->x[im + j]), M);
            add_to(pool, &sum, qdot_mul(pool, s->x[re + i], s->x[im + j]), c->Gamma[i * all + j]);
        }
    }
    s->f[n + 2 * all + 2] = sum;
}

/* System for oscillations: unknowns y, a, b, w (w^2 where two frequencies meet without damping),
 * beta; component `one` of z is set to 1. */
static qdot_status
make_oscillation_system(const qdot_rest_bifurcations *b, meeting what, size_t one, qdot_newton *s)
{
    const bool collision = what == MEETS;
    const qdot_equilibrium_curve *c = b->x->c;
    const size_t n = c->n, all = c->all, re = n + 1, im = re + all;
    qdot_pool *pool = c->pool;
    qdot_expr w = auxiliary_symbol(pool, "w", 0), square = collision ? w : qdot_mul(pool, w, w);

    QDOT_TRY(begin_extended_system(b, 2 * all + 1 + (what == MEETS_TURNING), s));
    s->x[im + all] = w;
    for (size_t i = 0; i < all; i++) {
        s->x[re + i] = auxiliary_symbol(pool, "a", i);
        s->x[im + i] = auxiliary_symbol(pool, "b", i);
    }
    for (size_t i = 0; i < all; i++) {
        qdot_expr *const first = &s->f[n + i], *const second = &s->f[n + all + i];

        *first = eigenvalue_equation(b, s, square, i, re);
        *second = eigenvalue_equation(b, s, square, i, im);
        for (size_t j = 0; j < all; j++) {
            const size_t at = i * all + j;

            if (collision) {
                add_to(pool, second, qdot_neg(pool, c->M[at]), s->x[re + j]);
            } else {
                const qdot_expr g = qdot_mul(pool, w, c->Gamma[at]);

                add_to(pool, first, qdot_neg(pool, g), s->x[im + j]);
                add_to(pool, second, g, s->x[re + j]);
            }
        }
    }
    s->f[n + 2 * all] = qdot_sub(pool, s->x[re + one], QDOT_ONE);
    s->f[n + 2 * all + 1] = s->x[im + one];
    if (what == MEETS_TURNING)
        add_gyroscopic_terms(b, s, w);
    return qdot_newton_lower(s);
}

qdot_status
qdot_rest_bifurcations_begin(qdot_rest_bifurcations *b, qdot_rest_path *x)
{
    const qdot_equilibrium_curve *c = x->c;
    const size_t count = 3 * c->all * c->all;

    *b = (qdot_rest_bifurcations){.x = x};
    QDOT_TRY(qdot_tape_new(c->pool, c->n + 1, c->unknown, count, c->K, &b->motion));
    b->value = qdot_calloc(count + 1, sizeof *b->value);
    b->work = qdot_malloc((qdot_tape_work(b->motion) + 1) * sizeof *b->work);
    return b->value && b->work ? QDOT_OK : QDOT_ENOMEM;
}

void
qdot_rest_bifurcations_end(qdot_rest_bifurcations *b)
{
    qdot_newton_end(&b->fold);
    qdot_newton_end(&b->crossing);
    qdot_tape_free(b->motion);
    qdot_free(b->value);
    qdot_free(b->work);
    *b = (qdot_rest_bifurcations){0};
}

/* --- guesses for Newton's method -------------------------------------------------------- */

/* Guess phi, the null vector of F_u, at a fold. */
static qdot_status
guess_fold(qdot_path *x, double *phi)
{
    const size_t n = x->n;

    for (size_t i = 0; i < n; i++)
        memcpy(x->A + i * n, x->J + i * (n + 1), n * sizeof *x->A);
    return qdot_null_vectors(n, n, x->A, 1, phi);
}

/* Guess psi, the null vector of F_y^T, at a crossing. */
static qdot_status
guess_crossing(qdot_path *x, double *psi)
{
    const size_t n = x->n;

    for (size_t j = 0; j <= n; j++)
        for (size_t i = 0; i < n; i++)
            x->A[j * n + i] = x->J[i * (n + 1) + j];
    return qdot_null_vectors(n + 1, n, x->A, 1, psi);
}

/* --- kinds of crossings ------------------------------------------------------------------- */

/* The bilinear form v.H w, where H is m x m, stored in rows of length `width`. */
static double
bilinear_form(size_t m, const double *H, size_t width, const double *v, const double *w)
{
    double sum = 0;

    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < m; j++)
            sum += v[i] * H[i * width + j] * w[j];
    return sum;
}

/* Classify the zero z of an extended system as a kind of bifurcation; v [4 (n + 1)] is work space. */
static qdot_status
classify_rest_bifurcation(qdot_rest_bifurcations *b, const double *z, double beta_error, const double *t, double *v,
                          qdot_bifurcation *out, double *other, qdot_bifurcation_answer *answer)
{
    qdot_path *x = &b->x->path;
    const size_t n = x->n, m = n + 1;
    const qdot_newton *s = &b->crossing;
    const double *H = s->J + n * s->n;
    double c[3];

    x->at(x, z);
    memcpy(x->A, x->J, n * m * sizeof *x->A);
    memset(x->A + n * m, 0, m * sizeof *x->A);
    QDOT_TRY(qdot_null_vectors(m, m, x->A, 2, v));
    qdot_derivative_eval(s->tape, z, 0, s->n, s->f_value, s->J, s->work);
    c[0] = bilinear_form(m, H, s->n, v, v);
    c[1] = bilinear_form(m, H, s->n, v, v + m);
    c[2] = bilinear_form(m, H, s->n, v + m, v + m);
    if (fabs(z[2 * n + 1]) > 2 * beta_error)
        *answer = QDOT_BIFURCATION_APART;
    else if (!qdot_bifurcation_cross(x, c, v, t, upright, 1e-22, &out->kind, other))
        *answer = QDOT_BIFURCATION_NONE;
    return QDOT_OK;
}

/* --- onset of oscillations ------------------------------------------------------------------ */

/* The frequency of the pair of roots nearest to the imaginary axis; where it is undamped, of the pair that
 * has a partner. */
static double
guess_frequency(const qdot_linear_roots *r, bool collision)
{
    double best = INFINITY, w = 0;

    for (size_t i = 0; i < r->n; i++) {
        double off = fabs(r->re[i]);

        if (!(r->im[i] > 1e-9))
            continue;
        for (size_t k = 0; k < r->n && collision; k++) {
            const double d = hypot(r->re[i] - r->re[k], r->im[i] - r->im[k]);

            off = k == 0 || (k != i && d < off) ? (k == i ? INFINITY : d) : off;
        }
        if (off < best) {
            best = off;
            w = r->im[i];
        }
    }
    return w;
}

/* The null vector z of K + i w Gamma - w^2 M in real form: a, then b; which component is largest, scaled
 * to 1. */
static qdot_status
guess_vector(const qdot_rest_bifurcations *b, double w, double *z, size_t *one)
{
    const size_t all = b->x->c->all, m = 2 * all;
    const double *K = b->value, *Gamma = K + all * all, *M = Gamma + all * all;
    double *A = qdot_calloc(m * m + 1, sizeof *A), re, im;
    qdot_status status = A ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < all && A; i++)
        for (size_t j = 0; j < all; j++) {
            const size_t at = i * all + j;

            A[i * m + j] = A[(all + i) * m + all + j] = K[at] - w * w * M[at];
            A[i * m + all + j] = -w * Gamma[at];
            A[(all + i) * m + j] = w * Gamma[at];
        }
    if (status == QDOT_OK)
        status = qdot_null_vectors(m, m, A, 1, z);
    qdot_free(A);
    QDOT_TRY(status);
    *one = 0;
    for (size_t i = 1; i < all; i++)
        if (hypot(z[i], z[all + i]) > hypot(z[*one], z[all + *one]))
            *one = i;
    re = z[*one] / (z[*one] * z[*one] + z[all + *one] * z[all + *one]);
    im = -z[all + *one] / (z[*one] * z[*one] + z[all + *one] * z[all + *one]);
    for (size_t i = 0; i < all; i++) {
        const double a = z[i];

        z[i] = a * re - z[all + i] * im;
        z[all + i] = a * im + z[all + i] * re;
    }
    return QDOT_OK;
}

static meeting
which_roots_meet(const qdot_rest_bifurcations *b)
{
    const size_t all = b->x->c->all;
    const double *K = b->value, *Gamma = K + all * all;
    double most = 0, damping = 0, lopsided = 0, size = 0;

    for (size_t i = 0; i < all * all; i++) {
        const size_t turned = i % all * all + i / all;

        most = fmax(most, fabs(Gamma[i]));
        damping = fmax(damping, fabs(Gamma[i] + Gamma[turned]));
        lopsided = fmax(lopsided, fabs(K[i] - K[turned]));
        size = fmax(size, sqrt(fabs(K[i])));
    }
    if (most <= undamped * size)
        return MEETS;
    return damping <= undamped * most && lopsided <= undamped * size * size ? MEETS_TURNING : CROSSES;
}

/* Solve for the point at which an oscillation begins; z [n + 1 + 2 all + 2]: first y, then work space. */
static qdot_status
find_oscillation(qdot_rest_bifurcations *b, qdot_bifurcation *out, double *z, double *error, bool *found)
{
    const qdot_rest_path *x = b->x;
    const size_t n = x->path.n, all = x->c->all;
    qdot_stability unused;
    qdot_newton s = {0};
    qdot_status status;
    meeting what;
    size_t one;
    double w;

    *found = false;
    QDOT_TRY(qdot_equilibrium_curve_judge(x->c, z, &unused));
    qdot_tape_eval(b->motion, z, b->value, b->work);
    what = which_roots_meet(b);
    w = guess_frequency(&x->c->roots, what != CROSSES);
    if (w == 0 || !x->c->damped)
        return QDOT_OK;
    QDOT_TRY(guess_vector(b, w, z + n + 1, &one));
    if (what == MEETS)
        memset(z + n + 1 + all, 0, all * sizeof *z);
    z[n + 1 + 2 * all] = what == MEETS ? w * w : w;
    status = make_oscillation_system(b, what, one, &s);
    if (status == QDOT_OK)
        status = qdot_newton_solve(&s, z, error, found);
    qdot_newton_end(&s);
    w = z[n + 1 + 2 * all];
    *found = *found && (what == MEETS ? w > 0 : w != 0);
    out->kind = what == CROSSES ? QDOT_HOPF : QDOT_COLLISION;
    out->frequency = what == MEETS ? sqrt(fmax(w, 0)) : fabs(w);
    out->frequency_error = error[n + 1 + 2 * all];
    if (what == MEETS)
        out->frequency_error /= 2 * out->frequency;
    return status;
}

/* --- locating a bifurcation of any kind ----------------------------------------------------- */

static qdot_status
find_rest_crossing(qdot_rest_bifurcations *b, const double *t, qdot_bifurcation *out, double *z,
                   double *error, double *other, qdot_bifurcation_answer *answer)
{
    qdot_path *x = &b->x->path;
    const size_t n = x->n;
    double *v;
    bool found = false;
    qdot_status status;

    if (b->crossing.tape == NULL)
        QDOT_TRY(make_crossing_system(b));
    QDOT_TRY(guess_crossing(x, z + n + 1));
    z[2 * n + 1] = 0;
    QDOT_TRY(qdot_newton_solve(&b->crossing, z, error, &found));
    if (!found || !b->crossing.regular)
        return QDOT_OK;
    v = qdot_calloc(4 * (n + 1), sizeof *v);
    *answer = QDOT_BIFURCATION_FOUND;
    status = v ? classify_rest_bifurcation(b, z, error[2 * n + 1], t, v, out, other, answer) : QDOT_ENOMEM;
    qdot_free(v);
    return status;
}

static qdot_status
find_rest_bifurcation(qdot_rest_bifurcations *b, const double *t, qdot_bifurcation *out, double *z, double *error,
                      double *other, qdot_bifurcation_answer *answer)
{
    qdot_path *x = &b->x->path;
    bool found = false;

    x->at(x, z);
    if (out->kind == QDOT_PITCHFORK)
        return find_rest_crossing(b, t, out, z, error, other, answer);
    if (out->kind == QDOT_HOPF) {
        QDOT_TRY(find_oscillation(b, out, z, error, &found));
    } else {
        if (b->fold.tape == NULL)
            QDOT_TRY(make_fold_system(b));
        QDOT_TRY(guess_fold(x, z + x->n + 1));
        QDOT_TRY(qdot_newton_solve(&b->fold, z, error, &found));
        found = found && b->fold.regular;
    }
    *answer = found ? QDOT_BIFURCATION_FOUND : QDOT_BIFURCATION_NONE;
    return QDOT_OK;
}

qdot_status
qdot_rest_bifurcation_find(void *user, const qdot_bifurcation_bracket *in, qdot_bifurcation *out,
                           double *other, qdot_bifurcation_answer *answer)
{
    qdot_rest_bifurcations *b = user;
    const size_t n = b->x->path.n, room = 2 * n + 2 * b->x->c->all + 5;
    double *z = qdot_calloc(2 * room, sizeof *z), *error = z + room;
    qdot_status status;

    *answer = QDOT_BIFURCATION_NONE;
    if (z == NULL)
        return QDOT_ENOMEM;
    memcpy(z, out->y, (n + 1) * sizeof *z);
    status = find_rest_bifurcation(b, in->a->t, out, z, error, other, answer);
    if (status == QDOT_OK && *answer == QDOT_BIFURCATION_FOUND) {
        memcpy(out->y, z, (n + 1) * sizeof *z);
        memcpy(out->error, error, (n + 1) * sizeof *z);
    }
    qdot_free(z);
    return status;
}
