/* stability.c -- the motion about an equilibrium, and whether it stays near. */
#include "expr/calculus.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "mech/derived.h"
#include "mech/equilibrium.h"
#include "mech/quantity.h"
#include "normal/positive.h"
#include "normal/simplify.h"

/* --- linear motion -------------------------------------------------------------------- */

/* The facts of a scene where it has an equilibrium: the conditions under which that exists are
 * among them. own: to be freed. */
static qdot_status
facts_at(qdot_scene *s, qdot_expr exists, qdot_facts *facts, qdot_expr **own)
{
    uint32_t n = exists == QDOT_NIL ? 0 : qdot_expr_count(s->pool, exists);

    *facts = qdot_scene_facts(s);
    *own = qdot_malloc((facts->n_conditions + n + 1) * sizeof **own);
    if (*own == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < facts->n_conditions; i++)
        (*own)[i] = facts->conditions[i];
    for (uint32_t i = 0; i < n; i++)
        (*own)[facts->n_conditions + i] = qdot_expr_arg(s->pool, exists, i);
    facts->conditions = *own;
    facts->n_conditions += n;
    return QDOT_OK;
}

/* e at rest at the equilibrium, simplified. */
typedef struct {
    qdot_scene *s;
    qdot_facts facts;
    qdot_expr *own; /* the facts' conditions */
    size_t n;
    qdot_expr *from, *to;
} place;

static qdot_status
place_begin(place *p, qdot_scene *s, qdot_expr equations, qdot_expr exists)
{
    size_t n = s->coordinates.n, m = qdot_expr_count(s->pool, equations);

    *p = (place){.s = s, .n = 2 * n + m};
    QDOT_TRY(facts_at(s, exists, &p->facts, &p->own));
    p->from = qdot_calloc(2 * p->n + 1, sizeof *p->from);
    if (p->from == NULL)
        return QDOT_ENOMEM;
    p->to = p->from + p->n;
    for (size_t i = 0; i < n; i++) {
        p->from[i] = qdot_mech_jet(s, i, 1);
        p->from[n + i] = qdot_mech_jet(s, i, 2);
        p->to[i] = p->to[n + i] = QDOT_ZERO;
    }
    for (size_t i = 0; i < m; i++) {
        qdot_expr one = qdot_expr_arg(s->pool, equations, (uint32_t)i);

        p->from[2 * n + i] = qdot_expr_arg(s->pool, one, 0);
        p->to[2 * n + i] = qdot_expr_arg(s->pool, one, 1);
    }
    return qdot_pool_check(s->pool);
}

static void
place_end(place *p)
{
    qdot_free(p->from);
    qdot_free(p->own);
}

static qdot_expr
at(const place *p, qdot_expr e)
{
    e = qdot_subs(p->s->pool, e, p->n, p->from, p->to);
    return qdot_simplify(p->s->pool, e, &p->facts);
}

/* Whether the value of q is told by `equations`, or another one's holds it. */
static bool
is_free(qdot_scene *s, qdot_expr equations, qdot_expr q)
{
    return !qdot_expr_contains(s->pool, equations, q);
}

/* The tangent space of the holonomic constraints: N [n * *m], its columns a basis. free
 * coordinates of the scene, [n] flags, are left out. */
static qdot_status
tangents(const place *p, const bool *out, qdot_expr *N, size_t *m)
{
    qdot_scene *s = p->s;
    qdot_pool *pool = s->pool;
    size_t n = s->coordinates.n, c = s->constraints.n, rank = 0, columns = 0;
    qdot_expr *A = qdot_calloc(c * n + n + 1, sizeof *A);
    size_t *pivot = qdot_calloc(c + 1, sizeof *pivot);
    qdot_status status = A == NULL || pivot == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t k = 0; k < c && status == QDOT_OK; k++) { /* reduced rows, one by one */
        qdot_expr *row = A + rank * n;
        size_t j = 0;

        for (size_t i = 0; i < n; i++)
            row[i] = out[i] ? QDOT_ZERO : at(p, qdot_constraint_slope(s, k, i));
        status = qdot_pool_check(pool);
        for (size_t r = 0; r < rank && status == QDOT_OK; r++) {
            qdot_expr by = row[pivot[r]];

            for (size_t i = 0; i < n && by != QDOT_ZERO; i++)
                row[i] = qdot_simplify(
                    pool, qdot_sub(pool, row[i], qdot_mul(pool, by, A[r * n + i])),
                    &p->facts);
            status = qdot_pool_check(pool);
        }
        while (status == QDOT_OK && j < n && qdot_is_zero(pool, row[j], &p->facts))
            j++;
        if (status != QDOT_OK || j == n)
            continue;
        for (size_t i = n; i-- > 0;)
            if (i != j)
                row[i] = qdot_simplify(pool, qdot_div(pool, row[i], row[j]), &p->facts);
        row[j] = QDOT_ONE;
        for (size_t r = 0; r < rank; r++) {
            qdot_expr by = A[r * n + j];

            for (size_t i = 0; i < n && by != QDOT_ZERO; i++)
                A[r * n + i] = qdot_simplify(
                    pool, qdot_sub(pool, A[r * n + i], qdot_mul(pool, by, row[i])),
                    &p->facts);
        }
        pivot[rank++] = j;
        status = qdot_pool_check(pool);
    }
    for (size_t j = 0; j < n && status == QDOT_OK; j++) {
        bool dependent = out[j];

        for (size_t r = 0; r < rank; r++)
            dependent |= pivot[r] == j;
        if (dependent)
            continue;
        for (size_t i = 0; i < n;
             i++) /* columns at stride n until their number is known */
            N[i * n + columns] = i == j ? QDOT_ONE : QDOT_ZERO;
        for (size_t r = 0; r < rank; r++)
            N[pivot[r] * n + columns] = qdot_neg(pool, A[r * n + j]);
        columns++;
    }
    *m = columns;
    qdot_free(A);
    qdot_free(pivot);
    return status;
}

/* N^T X N, X [n*n], N [n*m]. */
static qdot_status
reduce(const place *p, const qdot_expr *X, const qdot_expr *N, size_t m, qdot_expr *out)
{
    qdot_pool *pool = p->s->pool;
    size_t n = p->s->coordinates.n;

    for (size_t a = 0; a < m; a++)
        for (size_t b = 0; b < m; b++) {
            qdot_expr sum = QDOT_ZERO;

            for (size_t i = 0; i < n; i++)
                for (size_t j = 0; j < n; j++)
                    if (N[i * m + a] != QDOT_ZERO && N[j * m + b] != QDOT_ZERO &&
                        X[i * n + j] != QDOT_ZERO)
                        sum = qdot_add(
                            pool, sum,
                            qdot_product(
                                pool, 3,
                                (qdot_expr[]){N[i * m + a], X[i * n + j], N[j * m + b]}));
            out[a * m + b] = qdot_simplify(pool, sum, &p->facts);
        }
    return qdot_pool_check(pool);
}

/* M, Gamma, H of all coordinates, [n*n] each. */
static qdot_status
linearise(const place *p, qdot_expr *X)
{
    qdot_scene *s = p->s;
    size_t n = s->coordinates.n;

    for (size_t i = 0; i < n; i++) {
        qdot_expr equation = qdot_mech_equation(s, s->coordinates.at[i]), left;

        QDOT_TRY(qdot_pool_check(s->pool));
        left = qdot_sub(s->pool, qdot_expr_arg(s->pool, equation, 0),
                        qdot_expr_arg(s->pool, equation, 1));
        for (uint32_t order = 0; order < 3; order++)
            for (size_t j = 0; j < n; j++)
                X[(2 - order) * n * n + i * n + j] =
                    at(p, qdot_diff(s->pool, left, qdot_mech_jet(s, j, order)));
    }
    return qdot_pool_check(s->pool);
}

void
qdot_linear_motion_clear(qdot_linear_motion *m)
{
    qdot_free(m->M);
    *m = (qdot_linear_motion){0};
}

qdot_status
qdot_equilibrium_linear(qdot_scene *s, qdot_expr equations, qdot_expr exists,
                        bool keep_free, qdot_linear_motion *out)
{
    size_t n = s->coordinates.n, m = 0;
    qdot_expr *X = qdot_calloc(4 * n * n + 1, sizeof *X), *N;
    bool *left_out = qdot_calloc(n + 1, sizeof *left_out);
    qdot_status status = X == NULL || left_out == NULL ? QDOT_ENOMEM : QDOT_OK;
    place p = {0};

    *out = (qdot_linear_motion){0};
    if (status == QDOT_OK)
        status = place_begin(&p, s, equations, exists);
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        left_out[i] = !keep_free && is_free(s, equations, s->coordinates.at[i]);
    if (status == QDOT_OK)
        status = linearise(&p, X);
    N = X + 3 * n * n;
    if (status == QDOT_OK)
        status = tangents(&p, left_out, N, &m);
    if (status == QDOT_OK) {
        for (size_t i = 0; i < n; i++) /* close the columns up */
            for (size_t a = 0; a < m; a++)
                N[i * m + a] = N[i * n + a];
        out->n = m;
        out->M = qdot_calloc(3 * m * m + n * m + 1, sizeof *out->M);
        if (out->M == NULL)
            status = QDOT_ENOMEM;
    }
    if (status == QDOT_OK) {
        out->Gamma = out->M + m * m;
        out->H = out->Gamma + m * m;
        out->N = out->H + m * m;
        for (size_t i = 0; i < n * m; i++)
            out->N[i] = N[i];
        for (int k = 0; k < 3 && status == QDOT_OK; k++)
            status = reduce(&p, X + (size_t)k * n * n, N, m, out->M + (size_t)k * m * m);
    }
    qdot_free(X);
    qdot_free(left_out);
    place_end(&p);
    if (status != QDOT_OK)
        qdot_linear_motion_clear(out);
    return status;
}

/* --- definite or not ---------------------------------------------------------------------- */

typedef struct {
    qdot_scene *s;
    qdot_facts facts;
    qdot_vec(qdot_expr) known; /* scalars that are positive */
    qdot_vec(qdot_expr) when;  /* RELs */
} judgement;

/* Ask e > 0: true, false, or a condition that is noted. */
static qdot_status
ask(judgement *j, qdot_expr e, qdot_expr *answer)
{
    *answer = qdot_positive(j->s->pool, e, &j->facts, j->known.n, j->known.at);
    QDOT_TRY(qdot_pool_check(j->s->pool));
    if (*answer == QDOT_TRUE || *answer == QDOT_FALSE)
        return QDOT_OK;
    QDOT_TRY(qdot_vec_push(&j->when, *answer));
    return qdot_vec_push(&j->known, qdot_positive_of(j->s->pool, *answer));
}

/* Leading minors of A [n*n], simplified. */
static qdot_expr
minor_of(judgement *j, size_t n, const qdot_expr *A, size_t k)
{
    qdot_pool *pool = j->s->pool;
    qdot_expr *part, e;

    if (k == 1)
        return A[0];
    part = qdot_calloc(k * k, sizeof *part);
    if (part == NULL)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < k * k; i++)
        part[i] = A[i / k * n + i % k];
    e = qdot_det(pool, qdot_matrix(pool, (uint32_t)k, (uint32_t)k, part));
    qdot_free(part);
    return qdot_simplify(pool, e, &j->facts);
}

typedef enum { POSITIVE, CONDITIONAL, NEGATIVE_SOMEWHERE, UNKNOWN } definite;

/* Positive definite? A negative minor behind positive ones, or a negative diagonal entry: negative
 * somewhere. Conditions are noted. */
static qdot_status
definiteness(judgement *j, size_t n, const qdot_expr *A, definite *how)
{
    qdot_pool *pool = j->s->pool;
    size_t before = j->when.n;

    *how = UNKNOWN;
    for (size_t i = 0; i < n; i++) {
        qdot_expr sign = qdot_positive(pool, qdot_neg(pool, A[i * n + i]), &j->facts,
                                       j->known.n, j->known.at);

        QDOT_TRY(qdot_pool_check(pool));
        if (sign == QDOT_TRUE) {
            *how = NEGATIVE_SOMEWHERE;
            return QDOT_OK;
        }
    }
    for (size_t k = 1; k <= n; k++) {
        qdot_expr e = minor_of(j, n, A, k), answer;
        bool zero;

        QDOT_TRY(qdot_pool_check(pool));
        zero = qdot_is_zero(pool, e, &j->facts);
        QDOT_TRY(ask(j, e, &answer));
        if (answer == QDOT_FALSE) {
            if (!zero && j->when.n == before)
                *how = NEGATIVE_SOMEWHERE;
            return QDOT_OK;
        }
    }
    *how = j->when.n > before ? CONDITIONAL : POSITIVE;
    return QDOT_OK;
}

static bool
is_symmetric(judgement *j, size_t n, const qdot_expr *A, int sign)
{
    qdot_pool *pool = j->s->pool;

    for (size_t i = 0; i < n; i++)
        for (size_t k = i; k < n; k++) {
            qdot_expr other = A[k * n + i];

            other = sign > 0 ? qdot_sub(pool, A[i * n + k], other)
                             : qdot_add(pool, A[i * n + k], other);
            if (!qdot_is_zero(pool, other, &j->facts))
                return false;
        }
    return true;
}

/* The symmetric part of Gamma is not negative: none, or a diagonal of known sign, or what dampers
 * and the Rayleigh function of known sign give. */
static bool
is_damping(judgement *j, size_t n, const qdot_expr *Gamma, bool *none)
{
    qdot_pool *pool = j->s->pool;
    const qdot_scene *s = j->s;
    bool fine = s->forces.n == 0 && s->torques.n == 0 && s->dissipations.n == 0,
         diagonal = true;

    *none = is_symmetric(j, n, Gamma, -1);
    if (*none)
        return true;
    for (size_t k = 0; k < s->dampers.n; k++)
        fine = fine &&
               (qdot_expr_node(pool, s->dampers.at[k].stiffness)->sign & QDOT_GE0) != 0;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < n; k++) {
            qdot_expr e = qdot_add(pool, Gamma[i * n + k], Gamma[k * n + i]);

            if (i == k)
                diagonal = diagonal && (qdot_expr_node(pool, e)->sign & QDOT_GE0) != 0;
            else
                diagonal = diagonal && qdot_is_zero(pool, e, &j->facts);
        }
    return fine || diagonal;
}

/* One degree of freedom where H = 0: the first derivative of the force that is not. */
static qdot_status
higher(judgement *j, qdot_equilibrium *at_rest)
{
    qdot_scene *s = j->s;
    qdot_pool *pool = s->pool;
    qdot_expr q = s->coordinates.at[0], e = qdot_mech_equation(s, q), answer;
    place p = {0};
    qdot_status status = place_begin(&p, s, at_rest->equations, at_rest->exists);

    if (status != QDOT_OK || e == QDOT_NIL) {
        place_end(&p);
        return status != QDOT_OK ? status : qdot_pool_check(pool);
    }
    e = qdot_sub(pool, qdot_expr_arg(pool, e, 0), qdot_expr_arg(pool, e, 1));
    for (int k = 1; k <= 7 && status == QDOT_OK; k++) {
        qdot_expr value;

        e = qdot_diff(pool, e, q);
        value = at(&p, e);
        status = qdot_pool_check(pool);
        if (status != QDOT_OK || qdot_is_zero(pool, value, &j->facts))
            continue;
        answer = qdot_positive(pool, value, &j->facts, j->known.n, j->known.at);
        if (k % 2 == 0 || answer == QDOT_FALSE)
            at_rest->stability = QDOT_UNSTABLE;
        else if (answer == QDOT_TRUE)
            at_rest->stability = QDOT_STABLE;
        break;
    }
    place_end(&p);
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

/* det(-w^2 M + i w Gamma + H) = a w^4 - b w^2 + c, Gamma antisymmetric, n = 2: two positive w^2. */
static qdot_status
gyroscopic(judgement *j, const qdot_linear_motion *m, bool *possible)
{
    qdot_pool *pool = j->s->pool;
    const qdot_expr *M = m->M, *H = m->H;
    qdot_expr g = m->Gamma[1], a, b, c, answer;

    a = qdot_sub(pool, qdot_mul(pool, M[0], M[3]), qdot_mul(pool, M[1], M[1]));
    b = qdot_sum(
        pool, 4,
        (qdot_expr[]){
            qdot_mul(pool, M[0], H[3]), qdot_mul(pool, M[3], H[0]),
            qdot_product(pool, 3, (qdot_expr[]){qdot_expr_int(pool, -2), M[1], H[1]}),
            qdot_mul(pool, g, g)});
    c = qdot_sub(pool, qdot_mul(pool, H[0], H[3]), qdot_mul(pool, H[1], H[1]));
    *possible = true;
    for (int k = 0; k < 3 && *possible; k++) {
        qdot_expr e =
            k == 0 ? c
            : k == 1
                ? b
                : qdot_sub(
                      pool, qdot_mul(pool, b, b),
                      qdot_product(pool, 3, (qdot_expr[]){qdot_expr_int(pool, 4), a, c}));

        e = qdot_simplify(pool, e, &j->facts);
        QDOT_TRY(qdot_pool_check(pool));
        QDOT_TRY(ask(j, e, &answer));
        *possible = answer != QDOT_FALSE;
    }
    return QDOT_OK;
}

static qdot_status
judge(judgement *j, const qdot_linear_motion *m, qdot_equilibrium *e)
{
    size_t known = j->known.n;
    bool undamped, damped = is_damping(j, m->n, m->Gamma, &undamped), possible;
    bool no_gyro = is_symmetric(j, m->n, m->Gamma, 1);
    definite how;

    if (!damped || !is_symmetric(j, m->n, m->H, 1))
        return qdot_pool_check(j->s->pool);
    QDOT_TRY(definiteness(j, m->n, m->H, &how));
    if (how == POSITIVE || (how == CONDITIONAL && (no_gyro || m->n != 2 || !undamped))) {
        e->stability = QDOT_STABLE;
    } else if (how == NEGATIVE_SOMEWHERE && no_gyro) {
        e->stability = QDOT_UNSTABLE;
    } else if (undamped && !no_gyro && m->n == 2) {
        j->when.n = 0;
        j->known.n = known;
        QDOT_TRY(gyroscopic(j, m, &possible));
        e->stability = possible ? QDOT_STABLE : QDOT_UNSTABLE;
        j->when.n = possible ? j->when.n : 0;
    } else {
        j->when.n = 0;
    }
    if (how == UNKNOWN && m->n == 1 && j->s->coordinates.n == 1 && no_gyro)
        QDOT_TRY(higher(j, e));
    return QDOT_OK;
}

/* Leave out what another condition says already: a > 0 follows from b > 0 where a - b is
 * positive. known [n]: scalars that are positive without any of them. */
static qdot_status
drop_implied(judgement *j, size_t n)
{
    qdot_pool *pool = j->s->pool;

    for (size_t i = j->when.n; i-- > 0;)
        for (size_t k = 0; k < j->when.n; k++) {
            qdot_expr more = qdot_sub(pool, qdot_positive_of(pool, j->when.at[i]),
                                      qdot_positive_of(pool, j->when.at[k]));
            bool follows = k != i && qdot_positive(pool, more, &j->facts, n, j->known.at)
                                         == QDOT_TRUE;

            QDOT_TRY(qdot_pool_check(pool));
            if (!follows)
                continue;
            for (size_t m = i + 1; m < j->when.n; m++)
                j->when.at[m - 1] = j->when.at[m];
            j->when.n--;
            break;
        }
    return QDOT_OK;
}

qdot_status
qdot_equilibrium_judge(qdot_scene *s, qdot_equilibrium *e)
{
    judgement j = {.s = s};
    qdot_linear_motion m;
    qdot_status status;
    qdot_expr *own;
    size_t known;

    e->stability = QDOT_STABILITY_UNDECIDED;
    e->stable_when = QDOT_NIL;
    for (size_t k = 0; k < s->constraints.n; k++)
        if (s->constraints.at[k].kind != QDOT_HOLONOMIC)
            return QDOT_OK;
    QDOT_TRY(qdot_equilibrium_linear(s, e->equations, e->exists, false, &m));
    status = facts_at(s, e->exists, &j.facts, &own);
    for (uint32_t i = 0; e->exists != QDOT_NIL &&
                         i < qdot_expr_count(s->pool, e->exists) && status == QDOT_OK;
         i++)
        status = qdot_vec_push(
            &j.known, qdot_positive_of(s->pool, qdot_expr_arg(s->pool, e->exists, i)));
    known = j.known.n;
    if (status == QDOT_OK && m.n > 0)
        status = judge(&j, &m, e);
    if (status == QDOT_OK)
        status = drop_implied(&j, known);
    if (status == QDOT_OK && e->stability == QDOT_STABLE && j.when.n > 0)
        e->stable_when = qdot_list(s->pool, (uint32_t)j.when.n, j.when.at);
    if (status == QDOT_OK)
        status = qdot_pool_check(s->pool);
    qdot_linear_motion_clear(&m);
    qdot_free(own);
    qdot_free(j.known.at);
    qdot_free(j.when.at);
    return status;
}
