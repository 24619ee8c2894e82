/* kinematics.c -- r(q, t): velocities' coefficients dr/dq, grouped before anything
 * expands. */
#include "mech/dynamics/kinematics.h"

#include <stdlib.h>
#include <string.h>

#include "base/interrupt.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/alike.h"
#include "mech/scene/access.h"

/* --- inertial terms -------------------------------------------------------------------
 * */

static qdot_status
add_inertial_term(qdot_scene *s, qdot_kinematics *k, qdot_expr w, qdot_expr x, qdot_expr y,
                  int axis)
{
    qdot_inertial term = {w, x, y, axis};

    QDOT_TRY(qdot_pool_check(s->pool));
    if (w == QDOT_ZERO)
        return QDOT_OK;
    return qdot_vec_push(&k->terms, term);
}

static qdot_status
add_point_mass(qdot_scene *s, qdot_kinematics *k, qdot_expr mass, qdot_expr r)
{
    uint32_t n = qdot_mech_dimension(s->pool, r);

    for (uint32_t d = 0; d < n; d++) {
        qdot_expr x = qdot_mech_component(s->pool, r, d);

        QDOT_TRY(add_inertial_term(s, k, mass, x, x, (int)d));
    }
    return QDOT_OK;
}

/* The second moment J_ij of a body, J = 1/2 tr(I) 1 - I; in the plane J = 1/2 I 1, as I = J_11 + J_22. */
static qdot_expr
second_moment(qdot_scene *s, const qdot_body *b, uint32_t dim, uint32_t i, uint32_t j)
{
    qdot_pool *pool = s->pool;
    qdot_expr trace = QDOT_ZERO;

    if (dim == 2)
        return i == j ? qdot_mul(pool, QDOT_HALF, b->inertia) : QDOT_ZERO;
    for (uint32_t k = 0; k < 3 && i == j; k++)
        trace = qdot_add(pool, trace, qdot_expr_arg(pool, b->inertia, 4 * k));
    return qdot_sub(pool, qdot_mul(pool, QDOT_HALF, trace),
                    qdot_expr_arg(pool, b->inertia, 3 * i + j));
}

static qdot_status
add_terms_of_body(qdot_scene *s, qdot_kinematics *k, const qdot_body *b)
{
    uint32_t dim = qdot_mech_dimension(s->pool, b->position);

    QDOT_TRY(add_point_mass(s, k, b->mass, b->position));
    for (uint32_t i = 0; i < dim; i++)
        for (uint32_t j = 0; j < dim; j++) {
            qdot_expr J = second_moment(s, b, dim, i, j);

            for (uint32_t d = 0; d < dim && J != QDOT_ZERO; d++)
                QDOT_TRY(add_inertial_term(s, k, J,
                                           qdot_expr_arg(s->pool, b->rotation, dim * d + i),
                                           qdot_expr_arg(s->pool, b->rotation, dim * d + j), -1));
        }
    return QDOT_OK;
}

/* --- sets -----------------------------------------------------------------------------
 * */

static uint32_t
hash_of_bits(const uint64_t *bits, size_t words)
{
    uint64_t h = 0x9e3779b97f4a7c15u;

    for (size_t i = 0; i < words; i++) {
        h = (h ^ bits[i]) * 0xbf58476d1ce4e5b9u;
        h ^= h >> 29;
    }
    return (uint32_t)(h ^ (h >> 32));
}

static qdot_status
enlarge_hash_table(qdot_kinematics *k)
{
    size_t size = k->slots.n ? 2 * k->slots.n : 64;
    uint32_t *slots = qdot_calloc(size, sizeof *slots);

    if (!slots)
        return QDOT_ENOMEM;
    for (uint32_t i = 0; i < k->weight.n; i++) {
        size_t at = hash_of_bits(k->bits.at + i * k->words, k->words) & (size - 1);

        while (slots[at])
            at = (at + 1) & (size - 1);
        slots[at] = i + 1;
    }
    qdot_free(k->slots.at);
    k->slots.at = slots;
    k->slots.n = k->slots.capacity = size;
    return QDOT_OK;
}

/* The index of a set of inertial terms (terms of T), added if it is new; UINT32_MAX on failure. */
static uint32_t
find_or_add_set(qdot_scene *s, qdot_kinematics *k, const uint64_t *bits)
{
    size_t at;

    if (2 * k->weight.n >= k->slots.n && enlarge_hash_table(k) != QDOT_OK)
        goto no_memory;
    at = hash_of_bits(bits, k->words) & (k->slots.n - 1);
    for (; k->slots.at[at]; at = (at + 1) & (k->slots.n - 1))
        if (memcmp(k->bits.at + (k->slots.at[at] - 1) * k->words, bits,
                   k->words * sizeof *bits) == 0)
            return k->slots.at[at] - 1;
    if (qdot_grow(&k->bits.at, &k->bits.capacity, k->bits.n + k->words, sizeof *bits) !=
            QDOT_OK ||
        qdot_vec_push(&k->weight, QDOT_NIL) != QDOT_OK)
        goto no_memory;
    memcpy(k->bits.at + k->bits.n, bits, k->words * sizeof *bits);
    k->bits.n += k->words;
    k->slots.at[at] = (uint32_t)k->weight.n;
    return (uint32_t)k->weight.n - 1;
no_memory:
    qdot_pool_fail(s->pool);
    return UINT32_MAX;
}

/* `k->bits` has room for one more set behind the last: work space for what is interned.
 * */
static uint64_t *
get_scratch_set(qdot_scene *s, qdot_kinematics *k)
{
    if (qdot_grow(&k->bits.at, &k->bits.capacity, k->bits.n + 2 * k->words,
                  sizeof *k->bits.at) != QDOT_OK) {
        qdot_pool_fail(s->pool);
        return NULL;
    }
    memset(k->bits.at + k->bits.n + k->words, 0, k->words * sizeof *k->bits.at);
    return k->bits.at + k->bits.n + k->words;
}

uint32_t
qdot_kinematics_and(qdot_scene *s, qdot_kinematics *k, uint32_t a, uint32_t b)
{
    uint64_t *both;

    if (a == b)
        return a;
    both = get_scratch_set(s, k);
    if (!both)
        return UINT32_MAX;
    for (size_t i = 0; i < k->words; i++)
        both[i] = k->bits.at[a * k->words + i] & k->bits.at[b * k->words + i];
    return find_or_add_set(s, k, both);
}

qdot_expr
qdot_kinematics_weight(qdot_scene *s, qdot_kinematics *k, uint32_t set)
{
    qdot_expr *w;
    size_t n = 0;

    if (set == UINT32_MAX)
        return QDOT_NIL;
    if (k->weight.at[set] != QDOT_NIL)
        return k->weight.at[set];
    w = qdot_calloc(k->terms.n + 1, sizeof *w);
    if (!w)
        return qdot_pool_fail(s->pool);
    for (size_t p = 0; p < k->terms.n; p++)
        if (k->bits.at[set * k->words + p / 64] >> p % 64 & 1)
            w[n++] = k->terms.at[p].w;
    k->weight.at[set] = qdot_sum(s->pool, n, w);
    qdot_free(w);
    return k->weight.at[set];
}

/* --- the terms of x, each differentiated once ------------------------------------------
 * */

/* What is wanted of x: its slopes by q and t, x'' at q'' = 0, or x itself. Equations for people
 * need the first alone. */
typedef enum { SLOPES, REST, PLACE } want;

/* Of the terms p: the expression e stands at p under `key` (of slopes a coordinate's index, n
 * for t; else 0). */
typedef struct {
    uint32_t key, p;
    qdot_expr e;
} entry;
typedef qdot_vec(entry) entries;

typedef struct {
    uint32_t key;
    qdot_expr e;
} slope;

/* A summand of a coordinate function x(q, t); its derivatives are slopes.at[from .. to). */
typedef struct {
    qdot_expr term;
    uint32_t from, to;
} summand;

typedef struct {
    want want;
    qdot_vec(summand) known;
    qdot_vec(uint32_t) slots;
    qdot_vec(slope) slopes;
    qdot_vec(uint32_t) of_symbol; /* index + 1 of each coordinate of the scene, by the id of its symbol */
} summands;

static void
free_summands(summands *m)
{
    qdot_free(m->known.at);
    qdot_free(m->slots.at);
    qdot_free(m->slopes.at);
    qdot_free(m->of_symbol.at);
}

static qdot_status
add_derivative(qdot_scene *s, summands *m, size_t key, qdot_expr e)
{
    slope x = {(uint32_t)key, e};

    QDOT_TRY(qdot_pool_check(s->pool));
    return e == QDOT_ZERO ? QDOT_OK : qdot_vec_push(&m->slopes, x);
}

static qdot_status
differentiate_summand(qdot_scene *s, summands *m, qdot_expr term)
{
    qdot_pool *pool = s->pool;
    size_t n = s->coordinates.n;
    qdot_expr atoms = qdot_expr_atoms(pool, term, false);
    uint32_t count;

    QDOT_TRY(qdot_pool_check(pool));
    count = qdot_expr_count(pool, atoms);
    for (uint32_t i = 0; i < count; i++) {
        qdot_expr q = qdot_expr_arg(pool, atoms, i);

        if (q == QDOT_T)
            QDOT_TRY(add_derivative(s, m, n, qdot_diff(pool, term, q)));
        else if (q < m->of_symbol.n && m->of_symbol.at[q])
            QDOT_TRY(add_derivative(s, m, m->of_symbol.at[q] - 1, qdot_diff(pool, term, q)));
        else if (qdot_expr_is_class(pool, q, QDOT_COORD))
            return qdot_fail(QDOT_ENAME, "%s is not a coordinate of the scene",
                             qdot_expr_symbol(pool, q)->name);
    }
    return QDOT_OK;
}

/* Enter a new summand with what m->want asks for: its slopes by the coordinates, or its second time derivative at
 * rest. */
static qdot_status
add_summand(qdot_scene *s, summands *m, qdot_expr term)
{
    summand x = {term, (uint32_t)m->slopes.n, 0};
    qdot_expr e = term;

    QDOT_TRY(qdot_interrupt_check());
    if (m->want == REST)
        e = qdot_mech_at_rest(s, qdot_ddt(s->pool, qdot_ddt(s->pool, term)));
    QDOT_TRY(m->want == SLOPES ? differentiate_summand(s, m, term) : add_derivative(s, m, 0, e));
    x.to = (uint32_t)m->slopes.n;
    return qdot_vec_push(&m->known, x);
}

/* Find the index of a summand in m->known; the summand is added if it is new. */
static qdot_status
find_or_add_summand(qdot_scene *s, summands *m, qdot_expr term, uint32_t *index)
{
    size_t at;

    if (2 * m->known.n >= m->slots.n) {
        size_t size = m->slots.n ? 2 * m->slots.n : 64;
        uint32_t *slots = qdot_calloc(size, sizeof *slots);

        if (!slots)
            return QDOT_ENOMEM;
        for (uint32_t i = 0; i < m->known.n; i++) {
            at = m->known.at[i].term * 2654435769u & (size - 1);
            while (slots[at])
                at = (at + 1) & (size - 1);
            slots[at] = i + 1;
        }
        qdot_free(m->slots.at);
        m->slots.at = slots;
        m->slots.n = m->slots.capacity = size;
    }
    at = term * 2654435769u & (m->slots.n - 1);
    for (; m->slots.at[at]; at = (at + 1) & (m->slots.n - 1))
        if (m->known.at[m->slots.at[at] - 1].term == term) {
            *index = m->slots.at[at] - 1;
            return QDOT_OK;
        }
    QDOT_TRY(add_summand(s, m, term));
    *index = (uint32_t)m->known.n - 1;
    m->slots.at[at] = *index + 1;
    return QDOT_OK;
}

static qdot_status
add_entries(qdot_scene *s, summands *m, qdot_expr x, uint32_t p, entries *out)
{
    qdot_pool *pool = s->pool;
    bool sum = qdot_expr_kind(pool, x) == QDOT_SUM;
    uint32_t n = sum ? (qdot_expr_count(pool, x) - 1) / 2 : 1;

    if (m->want == PLACE && sum && qdot_expr_arg(pool, x, 0) != QDOT_ZERO) {
        entry constant = {0, p, qdot_expr_arg(pool, x, 0)};

        QDOT_TRY(qdot_vec_push(out, constant));
    }
    for (uint32_t i = 0; i < n; i++) {
        qdot_expr term = sum ? qdot_expr_arg(pool, x, 2 * i + 1) : x;
        qdot_expr factor = sum ? qdot_expr_arg(pool, x, 2 * i + 2) : QDOT_ONE;
        uint32_t index;

        QDOT_TRY(find_or_add_summand(s, m, term, &index));
        for (uint32_t k = m->known.at[index].from; k < m->known.at[index].to; k++) {
            entry e = {m->slopes.at[k].key, p, m->slopes.at[k].e};

            e.e = qdot_mul(pool, factor, e.e);
            QDOT_TRY(qdot_vec_push(out, e));
        }
    }
    return qdot_pool_check(pool);
}

/* --- grouping -------------------------------------------------------------------------
 * */

static int
compare_entries(const void *a, const void *b)
{
    const entry *x = a, *y = b;

    if (x->key != y->key)
        return x->key < y->key ? -1 : 1;
    if (x->p != y->p)
        return x->p < y->p ? -1 : 1;
    return x->e < y->e ? -1 : x->e > y->e;
}

static int
compare_by_expression(const void *a, const void *b)
{
    const entry *x = a, *y = b;

    if (x->key != y->key)
        return x->key < y->key ? -1 : 1;
    if (x->e != y->e)
        return x->e < y->e ? -1 : 1;
    return x->p < y->p ? -1 : x->p > y->p;
}

/* Several summands of one x under one key are added: dx/dq. Those of x'' and of x itself
 * stay apart, so that a chain's links share them; only equal ones are counted together.
 * */
static qdot_status
combine_entries(qdot_scene *s, entries *all, bool slopes)
{
    size_t kept = 0;
    qdot_expr first = QDOT_NIL; /* the expression, before additions, of the last entry that was kept */

    if (all->n > 1)
        qsort(all->at, all->n, sizeof *all->at, compare_entries);
    for (size_t i = 0; i < all->n; i++) {
        entry *last = kept ? &all->at[kept - 1] : NULL;

        if (last && last->key == all->at[i].key && last->p == all->at[i].p &&
            (slopes || first == all->at[i].e)) {
            last->e = qdot_add(s->pool, last->e, all->at[i].e);
        } else {
            first = all->at[i].e;
            all->at[kept++] = all->at[i];
        }
    }
    all->n = kept;
    return qdot_pool_check(s->pool);
}

/* Make one group of all entries with the same key and expression: the expression and the set of its terms. */
static qdot_status
group_entries(qdot_scene *s, qdot_kinematics *k, entries *all, want want, qdot_groups *out)
{
    QDOT_TRY(combine_entries(s, all, want == SLOPES));
    if (all->n > 1)
        qsort(all->at, all->n, sizeof *all->at, compare_by_expression);
    for (size_t i = 0, j; i < all->n; i = j) {
        const entry *first = &all->at[i];
        qdot_group g = {first->e, 0};
        uint64_t *bits = get_scratch_set(s, k);

        if (!bits)
            return qdot_pool_check(s->pool);
        for (j = i;
             j < all->n && all->at[j].key == first->key && all->at[j].e == first->e; j++)
            bits[all->at[j].p / 64] |= (uint64_t)1 << all->at[j].p % 64;
        if (first->e == QDOT_ZERO)
            continue;
        g.set = find_or_add_set(s, k, bits);
        QDOT_TRY(qdot_pool_check(s->pool));
        QDOT_TRY(qdot_vec_push(&out[first->key], g));
    }
    return QDOT_OK;
}

/* Store the index of each coordinate of the scene by the id of its symbol. */
static qdot_status
index_coordinates(const qdot_scene *s, summands *m)
{
    for (size_t i = 0; i < s->coordinates.n; i++) {
        qdot_expr q = s->coordinates.at[i];

        if (m->of_symbol.n <= q) {
            QDOT_TRY(qdot_grow(&m->of_symbol.at, &m->of_symbol.capacity, q + 1u,
                               sizeof *m->of_symbol.at));
            memset(m->of_symbol.at + m->of_symbol.n, 0,
                   (q + 1u - m->of_symbol.n) * sizeof *m->of_symbol.at);
            m->of_symbol.n = q + 1u;
        }
        m->of_symbol.at[q] = (uint32_t)i + 1;
    }
    return QDOT_OK;
}

/* Group the wanted derivatives of x (or, with of_y, of y) of all inertial terms w x' y' of T. */
static qdot_status
group_all_terms(qdot_scene *s, qdot_kinematics *k, want want, bool of_y, qdot_groups *out)
{
    summands m = {.want = want};
    entries all = {0};
    qdot_status status = index_coordinates(s, &m);

    for (size_t p = 0; p < k->terms.n && status == QDOT_OK; p++)
        status = add_entries(s, &m, of_y ? k->terms.at[p].y : k->terms.at[p].x,
                             (uint32_t)p, &all);
    if (status == QDOT_OK)
        status = group_entries(s, k, &all, want, out);
    qdot_free(all.at);
    free_summands(&m);
    return status;
}

qdot_status
qdot_kinematics_terms(qdot_scene *s, qdot_kinematics *k)
{
    for (size_t i = 0; i < s->particles.n; i++)
        QDOT_TRY(add_point_mass(s, k, s->particles.at[i].mass, s->particles.at[i].position));
    for (size_t i = 0; i < s->bodies.n; i++)
        QDOT_TRY(add_terms_of_body(s, k, &s->bodies.at[i]));
    return QDOT_OK;
}

static qdot_status
build_kinematics(qdot_scene *s, qdot_kinematics *k)
{
    size_t n = k->n = s->coordinates.n;
    uint64_t *bits;
    bool crossed = false;

    QDOT_TRY(qdot_kinematics_terms(s, k));
    k->words = k->terms.n / 64 + 1;
    k->dx = qdot_calloc(n + 1, sizeof *k->dx);
    for (size_t p = 0; p < k->terms.n; p++)
        crossed |= k->terms.at[p].x != k->terms.at[p].y;
    k->dy = crossed ? qdot_calloc(n + 1, sizeof *k->dy) : k->dx;
    if (!k->dx || !k->dy)
        return QDOT_ENOMEM;

    bits = get_scratch_set(s, k);
    if (!bits || find_or_add_set(s, k, bits) == UINT32_MAX)
        return qdot_pool_check(s->pool);
    for (int axis = 0; axis < 3; axis++) {
        bits = get_scratch_set(s, k);
        if (!bits)
            return qdot_pool_check(s->pool);
        for (size_t p = 0; p < k->terms.n; p++)
            if (k->terms.at[p].axis == axis)
                bits[p / 64] |= (uint64_t)1 << p % 64;
        k->axis_set[axis] = find_or_add_set(s, k, bits);
        QDOT_TRY(qdot_pool_check(s->pool));
    }

    QDOT_TRY(group_all_terms(s, k, SLOPES, false, k->dx));
    return crossed ? group_all_terms(s, k, SLOPES, true, k->dy) : QDOT_OK;
}

qdot_kinematics *
qdot_kinematics_get(qdot_scene *s)
{
    qdot_derived *d = qdot_derived_get(s);

    if (!d->kinematics_ready) {
        qdot_kinematics_clear(&d->kinematics); /* remove what a failed attempt left */
        if (build_kinematics(s, &d->kinematics) != QDOT_OK) {
            qdot_pool_fail(s->pool);
            return NULL;
        }
        d->kinematics_ready = true;
    }
    return &d->kinematics;
}

/* The groups of the second time derivatives x'', or of the functions x, computed when first needed. */
static const qdot_groups *
get_groups(qdot_scene *s, qdot_kinematics *k, want want, qdot_groups *out, bool *ready)
{
    if (*ready)
        return out;
    out->n = 0; /* remove what a failed attempt left */
    if (group_all_terms(s, k, want, false, out) != QDOT_OK) {
        qdot_pool_fail(s->pool);
        return NULL;
    }
    *ready = true;
    return out;
}

const qdot_groups *
qdot_kinematics_rest(qdot_scene *s, qdot_kinematics *k)
{
    return get_groups(s, k, REST, &k->rest, &k->rest_ready);
}

const qdot_groups *
qdot_kinematics_place(qdot_scene *s, qdot_kinematics *k)
{
    return get_groups(s, k, PLACE, &k->place, &k->place_ready);
}

/* --- sums over terms ------------------------------------------------------------------
 * */

typedef struct {
    qdot_expr weight, product;
} weighed;

static int
compare_weights(const void *a, const void *b)
{
    const weighed *x = a, *y = b;

    return x->weight < y->weight ? -1 : x->weight > y->weight;
}

/* sum over weights of weight (sum of products); people: each inner sum simplified, and
 * the whole where there are several. */
static qdot_expr
sum_by_weight(qdot_scene *s, weighed *at, size_t n, bool people)
{
    qdot_pool *pool = s->pool;
    qdot_expr *inner = qdot_calloc(2 * n + 1, sizeof *inner), *outer = inner + n, total;
    size_t groups = 0;

    if (!inner)
        return qdot_pool_fail(pool);
    if (n > 1)
        qsort(at, n, sizeof *at, compare_weights);
    for (size_t i = 0, j; i < n; i = j) {
        qdot_expr sum;

        for (j = i; j < n && at[j].weight == at[i].weight; j++)
            inner[j - i] = at[j].product;
        sum = qdot_sum(pool, j - i, inner);
        if (people)
            sum = qdot_mech_alike(s, sum);
        outer[groups++] = qdot_mul(pool, at[i].weight, sum);
    }
    total = qdot_sum(pool, groups, outer);
    qdot_free(inner);
    return people && groups > 1 ? qdot_mech_tidy(s, total) : total;
}

qdot_expr
qdot_kinematics_pair(qdot_scene *s, qdot_kinematics *k, const qdot_groups *a,
                     const qdot_groups *b, bool people)
{
    qdot_vec(weighed) all = {0};
    qdot_expr total = QDOT_NIL;

    for (size_t i = 0; i < a->n; i++)
        for (size_t j = 0; j < b->n; j++) {
            uint32_t set = qdot_kinematics_and(s, k, a->at[i].set, b->at[j].set);
            weighed w;

            if (set == 0) /* the two sets have no inertial term in common, as for two different axes */
                continue;
            w.weight = qdot_kinematics_weight(s, k, set);
            w.product = qdot_mul(s->pool, a->at[i].e, b->at[j].e);
            if (w.weight == QDOT_NIL || qdot_vec_push(&all, w) != QDOT_OK) {
                total = qdot_pool_fail(s->pool);
                goto done;
            }
        }
    total = sum_by_weight(s, all.at, all.n, people);
done:
    qdot_free(all.at);
    return total;
}

qdot_expr
qdot_kinematics_gravity(qdot_scene *s, qdot_kinematics *k, const qdot_groups *a)
{
    qdot_pool *pool = s->pool;
    qdot_vec(weighed) all = {0};
    qdot_expr field[3] = {QDOT_ZERO, QDOT_ZERO, QDOT_ZERO}, total = QDOT_NIL;

    for (size_t i = 0; i < s->gravities.n; i++)
        for (uint32_t d = 0; d < qdot_mech_dimension(pool, s->gravities.at[i].e); d++)
            field[d] = qdot_add(pool, field[d],
                                qdot_mech_component(pool, s->gravities.at[i].e, d));
    for (size_t i = 0; i < a->n; i++)
        for (int d = 0; d < 3; d++) {
            uint32_t set;
            weighed w;

            if (field[d] == QDOT_ZERO)
                continue;
            set = qdot_kinematics_and(s, k, a->at[i].set, k->axis_set[d]);
            if (set == 0)
                continue;
            w.weight = qdot_kinematics_weight(s, k, set);
            w.product = qdot_mul(pool, field[d], a->at[i].e);
            if (w.weight == QDOT_NIL || qdot_vec_push(&all, w) != QDOT_OK) {
                total = qdot_pool_fail(pool);
                goto done;
            }
        }
    total = sum_by_weight(s, all.at, all.n, false);
done:
    qdot_free(all.at);
    return total;
}
