/* unify.c -- makes equal arguments of functions identical, children first; candidates have equal
 * values at a few points. */
#include "normal/prove/unify.h"

#include <math.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/refute/sample.h"

enum {
    MOST_SEEN = 150,
    MOST_PROOFS = 80,
    TRIES = 100,
    PATIENCE = 80, /* number of attempts to find points at which everything is defined */
    LARGEST_RATIO = 1000,
    POINTS = 3
};

/* Classes of arguments; only arguments of the same class are compared. */
typedef enum { NONE, ANGLE, ABSOLUTE, BASE, LOGARITHM, OTHER } class;

/* Where an argument stands: in which function or power. */
struct place {
    class class;
    uint32_t op; /* for class OTHER: the function */
    qdot_kind kind;
};

/* An argument of functions to which all multiples of it are reduced. */
struct seen {
    struct place place;
    qdot_expr arg; /* the argument as it is after the replacements made so far */
    arb_struct at[POINTS];
};

typedef struct {
    qdot_pool *pool;
    const qdot_facts *facts;
    qdot_sample sample;
    qdot_walk walk;
    arb_ptr value[POINTS]; /* [walk.n] values of all nodes at each sample point */
    uint8_t *known;        /* [walk.n] whether the node has a value at all sample points */
    struct seen *seen;
    size_t n_seen;
    int proofs;
    const qdot_unify_way *way;
    bool changed;
} job;

/* --- sample values of arguments ---------------------------------------------------- */

static bool
has_undefined_node(const job *j)
{
    for (size_t i = 0; i < j->walk.n; i++)
        if (qdot_expr_is_scalar(j->pool, j->walk.at[i]) &&
            qdot_ball_get(&j->sample.ball, j->walk.at[i]) == NULL)
            return true;
    return false;
}

static qdot_status
evaluate_nodes(job *j, size_t n, const qdot_expr *e)
{
    int found = 0;

    QDOT_TRY(qdot_sample_begin(&j->sample, j->pool, n, e, j->facts));
    for (int k = 0; k < TRIES && j->sample.possible && found < POINTS; k++) {
        qdot_sample_point(&j->sample, k);
        if (!qdot_sample_values(&j->sample, 192) || (k < PATIENCE && has_undefined_node(j)))
            continue;
        for (size_t i = 0; i < j->walk.n; i++) {
            arb_srcptr v = qdot_expr_is_scalar(j->pool, j->walk.at[i])
                               ? qdot_ball_get(&j->sample.ball, j->walk.at[i])
                               : NULL;

            j->known[i] = (found == 0 || j->known[i]) && v != NULL;
            if (v != NULL)
                arb_set(j->value[found] + i, v);
        }
        found++;
    }
    qdot_sample_end(&j->sample);
    for (size_t i = 0; i < j->walk.n && found < POINTS; i++)
        j->known[i] = 0;
    return QDOT_OK;
}

/* Find a fraction c with a small denominator close to x; false if there is none. */
static bool
find_small_fraction(fmpq_t c, double x)
{
    for (int64_t d = 1; d <= 24; d++) {
        double n = nearbyint(x * (double)d);

        if (fabs(n) <= LARGEST_RATIO && n != 0 &&
            fabs(x * (double)d - n) < 1e-10 * (fabs(n) + 1)) {
            fmpq_set_si(c, (slong)n, (ulong)d);
            return true;
        }
    }
    return false;
}

/* Whether the sample values agree with a = c b for a rational c. */
static bool
values_are_proportional(const job *j, size_t a, const struct seen *b, fmpq_t c)
{
    int k = 0;
    arb_t x;
    bool fits;

    while (k + 1 < POINTS && arb_contains_zero(b->at + k))
        k++;
    arb_init(x);
    arb_div(x, j->value[k] + a, b->at + k, 128);
    fits = arb_is_finite(x) && find_small_fraction(c, arf_get_d(arb_midref(x), ARF_RND_NEAR));
    for (k = 0; k < POINTS && fits; k++) {
        arb_set_fmpq(x, c, 192);
        arb_mul(x, x, b->at + k, 192);
        fits = arb_overlaps(x, j->value[k] + a);
    }
    arb_clear(x);
    return fits;
}

/* --- finding equal arguments ------------------------------------------------------- */

/* Whether an argument is compared with others: a plain one stays as it is, but others may be multiples of it. */
static bool
is_worth_comparing(const qdot_pool *pool, qdot_expr arg)
{
    return qdot_expr_is_scalar(pool, arg) && qdot_expr_kind(pool, arg) != QDOT_NUM;
}

/* Find *with, which represents `arg` (whose old node has the index `at`), such that arg = *c times *with. */
static qdot_status
find_representative(job *j, struct place p, qdot_expr arg, size_t at, qdot_expr *with, fmpq_t c)
{
    qdot_status status = QDOT_OK;
    struct seen *new;

    *with = QDOT_NIL;
    if (!j->known[at])
        return QDOT_OK;
    for (size_t i = 0; i < j->n_seen && status == QDOT_OK; i++) {
        struct seen *s = &j->seen[i];
        bool equal = false;
        qdot_expr other;

        if (s->place.class != p.class ||
            (p.class == OTHER && (s->place.op != p.op || s->place.kind != p.kind)) ||
            !values_are_proportional(j, at, s, c))
            continue;
        if ((p.class == OTHER && !fmpq_is_one(c)) ||
            ((p.class == BASE || p.class == LOGARITHM) && fmpq_sgn(c) < 0))
            continue;
        other = qdot_mul(j->pool, qdot_expr_fmpq(j->pool, c), s->arg);
        if (other != arg && j->proofs++ < MOST_PROOFS)
            status = j->way->prove(j->pool, arg, other, j->facts, &equal);
        if (status == QDOT_OK && other != arg && !equal && j->way->harder != NULL)
            status = j->way->harder(j->pool, arg, other, j->facts, &equal);
        if (other == arg || equal) {
            *with = s->arg;
            return status;
        }
    }
    if (status != QDOT_OK || j->n_seen >= MOST_SEEN)
        return status;
    new = &j->seen[j->n_seen++];
    *new = (struct seen){.place = p, .arg = arg};
    for (int k = 0; k < POINTS; k++) {
        arb_init(new->at + k);
        arb_set(new->at + k, j->value[k] + at);
    }
    return QDOT_OK;
}

static class class_of(const job *j, uint32_t op)
{
    if (j->way->only_undefined)
        return NONE;
    if (op <= QDOT_COT || (op >= QDOT_SINH && op <= QDOT_TANH) || op == QDOT_EXP)
        return ANGLE;
    return op == QDOT_ABS ? ABSOLUTE : op == QDOT_LOG ? LOGARITHM : OTHER;
}

static size_t
argument_index(const job *j, qdot_expr old, uint32_t i)
{
    return qdot_walk_index(&j->walk, qdot_expr_arg(j->pool, old, i));
}

/* Unify the arguments of a function; *now is the node `old` with the arguments unified inside it. */
static qdot_status
unify_function(job *j, qdot_expr old, qdot_expr *now)
{
    qdot_pool *pool = j->pool;
    uint32_t op = qdot_expr_node(pool, *now)->op, n = qdot_expr_count(pool, *now);
    class class = class_of(j, op);
    qdot_expr args[4], with, scaled;
    bool any = false;
    fmpq_t c;

    if (class == NONE || n > 4 || n != qdot_expr_count(pool, old) ||
        qdot_expr_kind(pool, old) != QDOT_FUN)
        return QDOT_OK;
    fmpq_init(c);
    for (uint32_t i = 0; i < n; i++) {
        args[i] = qdot_expr_arg(pool, *now, i);
        if (!is_worth_comparing(pool, args[i]))
            continue;
        if (find_representative(j, (struct place){class, op, QDOT_FUN}, args[i], argument_index(j, old, i), &with,
                                c) != QDOT_OK)
            break;
        if (with == QDOT_NIL)
            continue;
        scaled = qdot_mul(pool, qdot_expr_fmpq(pool, c), with);
        any |= scaled != args[i];
        args[i] = scaled;
        if (class == ABSOLUTE && any) { /* move a factor out of an absolute value: |c B| = |c| |B| */
            fmpq_abs(c, c);
            *now =
                qdot_mul(pool, qdot_expr_fmpq(pool, c), qdot_fun1(pool, QDOT_ABS, with));
            any = false;
        } else if (class == LOGARITHM && any) {
            *now = qdot_add(pool, qdot_fun1(pool, QDOT_LOG, qdot_expr_fmpq(pool, c)),
                            qdot_fun1(pool, QDOT_LOG, with));
            any = false;
        } else {
            continue;
        }
        j->changed = true;
        break;
    }
    if (any) {
        j->changed = true;
        *now = qdot_fun(pool, op, n, args);
    }
    fmpq_clear(c);
    return qdot_interrupt_is_set() ? qdot_interrupt_check() : QDOT_OK;
}

static qdot_status
unify_undefined(job *j, qdot_expr old, qdot_expr *now)
{
    qdot_pool *pool = j->pool;
    uint32_t n = qdot_expr_count(pool, *now);
    qdot_expr *args = qdot_malloc((n + 1) * sizeof *args), with;
    qdot_status status = args == NULL ? QDOT_ENOMEM : QDOT_OK;
    bool any = false;
    fmpq_t c;

    fmpq_init(c);
    for (uint32_t i = 0; i < n && status == QDOT_OK; i++) {
        args[i] = qdot_expr_arg(pool, *now, i);
        if (2 * i >= n) /* the rest are the orders of derivatives of an undefined function */
            continue;
        status = find_representative(j, (struct place){OTHER, qdot_expr_node(pool, *now)->op, QDOT_UFUN},
                                     args[i], argument_index(j, old, i), &with, c);
        if (with != QDOT_NIL) {
            any |= with != args[i];
            args[i] = with;
        }
    }
    if (any && status == QDOT_OK) {
        j->changed = true;
        *now = qdot_rebuild(pool, *now, args);
    }
    fmpq_clear(c);
    qdot_free(args);
    return status;
}

/* Unify the bases of powers with non-integer exponents. */
static qdot_status
unify_product(job *j, qdot_expr old, qdot_expr *now)
{
    qdot_pool *pool = j->pool;
    uint32_t n = qdot_expr_count(pool, old);
    qdot_expr result = qdot_expr_arg(pool, old, 0), with;
    qdot_status status = QDOT_OK;
    bool any = false;
    fmpq_t c;
    int64_t k;

    if (j->way->only_undefined)
        return QDOT_OK;
    fmpq_init(c);
    for (uint32_t i = 1; i < n && status == QDOT_OK; i += 2) {
        qdot_expr b = (qdot_expr)qdot_walk_get(&j->walk, qdot_expr_arg(pool, old, i));
        qdot_expr x = (qdot_expr)qdot_walk_get(&j->walk, qdot_expr_arg(pool, old, i + 1));
        qdot_expr power;

        if (b == QDOT_NIL || x == QDOT_NIL)
            break;
        power = qdot_pow(pool, b, x);
        if (!qdot_expr_to_int(pool, x, &k) && is_worth_comparing(pool, b)) {
            status = find_representative(j, (struct place){BASE, 0, QDOT_PROD}, b, argument_index(j, old, i),
                                         &with, c);
            if (with != QDOT_NIL && with != b) {
                any = true;
                power = qdot_mul(pool, qdot_pow(pool, qdot_expr_fmpq(pool, c), x),
                                 qdot_pow(pool, with, x));
            }
        }
        result = qdot_mul(pool, result, power);
    }
    if (any && status == QDOT_OK) {
        j->changed = true;
        *now = result;
    }
    fmpq_clear(c);
    return status;
}

/* --- unifying all arguments -------------------------------------------------------- */

static qdot_status
unify_node(job *j, qdot_expr old, qdot_expr *now)
{
    qdot_pool *pool = j->pool;
    uint32_t n = qdot_expr_count(pool, old);
    qdot_expr *args = qdot_malloc((n + 1) * sizeof *args);
    bool same = true;

    if (args == NULL)
        return QDOT_ENOMEM;
    for (uint32_t i = 0; i < n; i++) {
        qdot_expr child = qdot_expr_arg(pool, old, i);

        args[i] = (qdot_expr)qdot_walk_get(&j->walk, child);
        same &= args[i] == child;
    }
    *now = same ? old : qdot_rebuild(pool, old, args);
    qdot_free(args);
    if (*now == QDOT_NIL)
        return QDOT_OK;
    switch (qdot_expr_kind(pool, old)) {
    case QDOT_FUN:
        return qdot_expr_kind(pool, *now) == QDOT_FUN ? unify_function(j, old, now) : QDOT_OK;
    case QDOT_UFUN: return unify_undefined(j, old, now);
    case QDOT_PROD: return unify_product(j, old, now);
    default: return QDOT_OK;
    }
}

static qdot_status
reserve_memory(job *j)
{
    size_t n = j->walk.n + 1;

    j->known = qdot_calloc(n, 1);
    j->seen = qdot_calloc(MOST_SEEN, sizeof *j->seen);
    if (j->known == NULL || j->seen == NULL)
        return QDOT_ENOMEM;
    for (int k = 0; k < POINTS; k++) {
        j->value[k] = qdot_malloc(n * sizeof(arb_struct));
        if (j->value[k] == NULL)
            return QDOT_ENOMEM;
        for (size_t i = 0; i < j->walk.n; i++)
            arb_init(j->value[k] + i);
    }
    return QDOT_OK;
}

static void
release_memory(job *j)
{
    for (int k = 0; k < POINTS; k++) {
        for (size_t i = 0; j->value[k] != NULL && i < j->walk.n; i++)
            arb_clear(j->value[k] + i);
        qdot_free(j->value[k]);
        for (size_t i = 0; i < j->n_seen; i++)
            arb_clear(j->seen[i].at + k);
    }
    qdot_free(j->known);
    qdot_free(j->seen);
    qdot_walk_end(&j->walk);
}

/* Whether there are at least two functions or powers whose arguments can be compared. */
static bool
has_comparable_arguments(const job *j)
{
    size_t count = 0;

    for (size_t i = 0; i < j->walk.n; i++) {
        qdot_kind kind = qdot_expr_kind(j->pool, j->walk.at[i]);

        count += kind == QDOT_UFUN || (!j->way->only_undefined && kind == QDOT_FUN);
        for (uint32_t k = 2; !j->way->only_undefined && kind == QDOT_PROD &&
                             k < qdot_expr_count(j->pool, j->walk.at[i]);
             k += 2) {
            int64_t whole;

            count += !qdot_expr_to_int(j->pool, qdot_expr_arg(j->pool, j->walk.at[i], k),
                                       &whole);
        }
    }
    return count > 1;
}

qdot_status
qdot_unify(qdot_pool *pool, size_t n, qdot_expr *e, const qdot_facts *facts,
           const qdot_unify_way *way, bool *changed)
{
    job j = {.pool = pool, .facts = facts, .way = way};
    qdot_status status;

    *changed = false;
    QDOT_TRY(qdot_walk_begin_n(pool, n, e, &j.walk));
    if (!has_comparable_arguments(&j)) {
        qdot_walk_end(&j.walk);
        return QDOT_OK;
    }
    status = reserve_memory(&j);
    if (status == QDOT_OK)
        status = evaluate_nodes(&j, n, e);
    for (size_t i = 0; i < j.walk.n && status == QDOT_OK; i++) {
        qdot_expr now = QDOT_NIL;

        status = unify_node(&j, j.walk.at[i], &now);
        if (now == QDOT_NIL && status == QDOT_OK)
            status = QDOT_EFAILED; /* give up: the result is undefined, so the replacement was wrong */
        qdot_walk_set(&j.walk, j.walk.at[i], now);
    }
    for (size_t i = 0; i < n && status == QDOT_OK && j.changed; i++)
        e[i] = (qdot_expr)qdot_walk_get(&j.walk, e[i]);
    *changed = status == QDOT_OK && j.changed;
    release_memory(&j);
    return status == QDOT_EFAILED ? QDOT_OK : status;
}
