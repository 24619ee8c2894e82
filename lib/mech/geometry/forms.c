/* forms.c -- exterior derivative and product, inner product with a vector, Hodge dual. */
#include "mech/geometry/forms.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "mech/geometry/manifold.h"
#include "mech/scene/access.h"
#include "normal/simplify/simplify.h"

/* f dq_i ^ dq_j ^ ...: bit 0 of `set` is dt, bit i the differential of the i-th coordinate of the scene, counted from 1. */
typedef struct {
    uint64_t set;
    qdot_expr f;
} form_term;

/* A form as its terms, each set once. */
typedef struct {
    qdot_scene *s;
    int degree; /* -1: the form is 0, which is of every degree */
    qdot_vec(form_term) terms;
} form;

static const char not_a_form[] = "a form is a number, or a sum of f*dr, or of f*wedge(dr, dphi), all of one degree";

static int
count_bits(uint64_t set)
{
    int n = 0;

    for (; set != 0; set &= set - 1)
        n++;
    return n;
}

/* The sign of the permutation that brings the differentials of a, then those of b, into order: +1, -1. */
static int
sign_of_order(uint64_t a, uint64_t b)
{
    int swaps = 0;

    for (uint64_t left = a >> 1; left != 0; left >>= 1)
        swaps += count_bits(left & b);
    return swaps % 2 == 0 ? 1 : -1;
}

/* --- coordinates by their numbers ------------------------------------------------------------- */

static qdot_expr
coordinate_at(const qdot_scene *s, uint32_t i)
{
    return i == 0 ? QDOT_T : s->coordinates.at[i - 1];
}

/* The bit of a coordinate or t; 0: it is none of the scene. */
static uint64_t
bit_of(const qdot_scene *s, qdot_expr q)
{
    for (uint32_t i = 0; i <= s->coordinates.n; i++)
        if (coordinate_at(s, i) == q)
            return (uint64_t)1 << i;
    return 0;
}

/* The set of coordinates of the symbol dq or wedge(dq, ...); 0: one of them is none of the scene. */
static uint64_t
set_of_symbol(const qdot_scene *s, qdot_expr symbol)
{
    const qdot_expr base = qdot_expr_symbol(s->pool, symbol)->base;
    uint64_t set = 0;

    if (qdot_expr_kind(s->pool, base) != QDOT_LIST)
        return bit_of(s, base);
    for (uint32_t i = 0; i < qdot_expr_count(s->pool, base); i++) {
        const uint64_t bit = bit_of(s, qdot_expr_arg(s->pool, base, i));

        if (bit == 0)
            return 0;
        set |= bit;
    }
    return set;
}

/* The symbol of dq_I; 1 for none. */
static qdot_expr
basis(const qdot_scene *s, uint64_t set)
{
    qdot_expr q[64];
    uint32_t n = 0;

    for (uint32_t i = 0; i <= s->coordinates.n; i++)
        if (set >> i & 1)
            q[n++] = coordinate_at(s, i);
    if (n == 0)
        return QDOT_ONE;
    return qdot_symbol_of(s->pool, QDOT_DIFFERENTIAL, n == 1 ? q[0] : qdot_list(s->pool, n, q));
}

/* --- forms and expressions ---------------------------------------------------------------------- */

/* Add f dq_I. */
static void
add_form_term(form *w, uint64_t set, qdot_expr f)
{
    qdot_pool *pool = w->s->pool;

    if (f == QDOT_ZERO || f == QDOT_NIL)
        return;
    for (size_t i = 0; i < w->terms.n; i++)
        if (w->terms.at[i].set == set) {
            w->terms.at[i].f = qdot_add(pool, w->terms.at[i].f, f);
            return;
        }
    if (qdot_vec_push(&w->terms, ((form_term){set, f})) != QDOT_OK)
        qdot_pool_fail(pool);
}

/* Read the terms of e into w, which is empty. False: the pool keeps the failure. */
static bool
form_read(form *w, qdot_scene *s, qdot_expr e)
{
    qdot_pool *pool = s->pool;
    qdot_expr rest = e, atoms;
    const uint32_t strange = QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MOMENTUM | QDOT_HAS_DELTA | QDOT_HAS_MULTIPLIER;
    bool sound = true;

    *w = (form){.s = s, .degree = -1};
    if (e == QDOT_NIL)
        return false;
    if (s->coordinates.n > 62) {
        qdot_mech_fail(s, QDOT_ELIMIT, "forms are of at most 62 coordinates");
        return false;
    }
    if (qdot_expr_is_scalar(pool, e) && (qdot_mech_holds(s, e) & strange)) {
        qdot_mech_fail(s, QDOT_EINVAL, "a form is of positions: it cannot contain velocities or momenta");
        return false;
    }
    atoms = qdot_expr_is_scalar(pool, e) ? qdot_expr_atoms(pool, e, false) : QDOT_NIL;
    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(pool, atoms) && sound; i++) {
        const qdot_expr x = qdot_expr_arg(pool, atoms, i), zero = QDOT_ZERO;
        qdot_expr f;
        uint64_t set;

        if (!qdot_expr_is_class(pool, x, QDOT_DIFFERENTIAL))
            continue;
        set = set_of_symbol(s, x);
        f = qdot_diff(pool, e, x);
        rest = qdot_subs(pool, rest, 1, &x, &zero);
        sound = set != 0 && !(qdot_mech_holds(s, f) & QDOT_HAS_DIFFERENTIAL) &&
                (w->degree < 0 || w->degree == count_bits(set));
        w->degree = count_bits(set);
        add_form_term(w, set, f);
    }
    if (sound && rest != QDOT_ZERO && rest != QDOT_NIL) {
        sound = w->degree < 0;
        w->degree = 0;
        add_form_term(w, 0, rest);
    }
    if (!sound || !qdot_expr_is_scalar(pool, e))
        qdot_mech_fail(s, QDOT_ETYPE, not_a_form);
    return !qdot_pool_failed(pool);
}

/* The form as an expression with simplified coefficients; w is freed. */
static qdot_expr
form_write(form *w)
{
    qdot_pool *pool = w->s->pool;
    const qdot_facts facts = qdot_scene_facts(w->s);
    qdot_expr sum = QDOT_ZERO;

    for (size_t i = 0; i < w->terms.n && !qdot_pool_failed(pool); i++)
        sum = qdot_add(pool, sum, qdot_mul(pool, qdot_simplify(pool, w->terms.at[i].f, &facts), basis(w->s, w->terms.at[i].set)));
    qdot_free(w->terms.at);
    return qdot_pool_failed(pool) ? QDOT_NIL : sum;
}

/* --- derivative and products ---------------------------------------------------------------------- */

/* Add to `sum` the product a ^ f dq_I of a single term with the terms of w. */
static void
add_form_product(form *sum, uint64_t set, qdot_expr f, const form *w)
{
    qdot_pool *pool = sum->s->pool;

    for (size_t i = 0; i < w->terms.n; i++) {
        const form_term *t = &w->terms.at[i];
        const qdot_expr product = qdot_mul(pool, f, t->f);

        if ((set & t->set) == 0)
            add_form_term(sum, set | t->set, sign_of_order(set, t->set) > 0 ? product : qdot_neg(pool, product));
    }
}

qdot_expr
qdot_forms_exterior_derivative(qdot_scene *s, qdot_expr w)
{
    form a, sum = {.s = s};

    if (form_read(&a, s, w))
        for (size_t i = 0; i < a.terms.n; i++)
            for (uint32_t k = 0; k <= s->coordinates.n; k++) {
                const uint64_t bit = (uint64_t)1 << k;
                const qdot_expr slope = qdot_diff(s->pool, a.terms.at[i].f, coordinate_at(s, k));

                if ((a.terms.at[i].set & bit) == 0 && slope != QDOT_ZERO && slope != QDOT_NIL)
                    add_form_term(&sum, a.terms.at[i].set | bit,
                             sign_of_order(bit, a.terms.at[i].set) > 0 ? slope : qdot_neg(s->pool, slope));
            }
    qdot_free(a.terms.at);
    return form_write(&sum);
}

qdot_expr
qdot_forms_wedge(qdot_scene *s, qdot_expr a, qdot_expr b)
{
    form left = {0}, right = {0}, product = {.s = s};

    if (form_read(&left, s, a) && form_read(&right, s, b))
        for (size_t i = 0; i < left.terms.n; i++)
            add_form_product(&product, left.terms.at[i].set, left.terms.at[i].f, &right);
    qdot_free(left.terms.at);
    qdot_free(right.terms.at);
    return form_write(&product);
}

/* Whether every differential of w is among the coordinates q [n]; else the pool keeps the failure, in which they are called
 * those of `what`. */
static bool
has_coordinates(const form *w, uint32_t n, const qdot_expr *q, const char *what)
{
    qdot_scene *s = w->s;
    uint64_t known = 0, used = 0;

    for (uint32_t i = 0; i < n; i++)
        known |= bit_of(s, q[i]);
    for (size_t i = 0; i < w->terms.n; i++)
        used |= w->terms.at[i].set;
    for (uint32_t i = 0; i <= s->coordinates.n; i++)
        if ((used & ~known) >> i & 1) {
            qdot_mech_fail(s, QDOT_EINVAL, "the form holds d%.200s, which is none of the differentials of the %s",
                           qdot_expr_symbol(s->pool, coordinate_at(s, i))->name, what);
            return false;
        }
    return true;
}

qdot_expr
qdot_forms_interior(qdot_scene *s, qdot_expr X, qdot_expr w, uint32_t n, const qdot_expr *q)
{
    form a, sum = {.s = s};

    if (X == QDOT_NIL)
        return QDOT_NIL;
    if (qdot_mech_dimension(s->pool, X) != n)
        return qdot_mech_fail(s, QDOT_ETYPE, "a vector field needs %u component%s, one for each coordinate", n, n == 1 ? "" : "s");
    if (form_read(&a, s, w) && has_coordinates(&a, n, q, "vector"))
        for (size_t i = 0; i < a.terms.n; i++)
            for (uint32_t k = 0; k < n; k++) {
                const uint64_t bit = bit_of(s, q[k]), set = a.terms.at[i].set;
                const qdot_expr f = qdot_mul(s->pool, qdot_mech_component(s->pool, X, k), a.terms.at[i].f);

                if (set & bit)
                    add_form_term(&sum, set & ~bit, sign_of_order(bit, set & ~bit) > 0 ? f : qdot_neg(s->pool, f));
            }
    qdot_free(a.terms.at);
    return form_write(&sum);
}

bool
qdot_forms_has_product(const qdot_scene *s, qdot_expr w)
{
    qdot_expr atoms;

    if (w == QDOT_NIL || !(qdot_mech_holds(s, w) & QDOT_HAS_DIFFERENTIAL))
        return false;
    atoms = qdot_expr_atoms(s->pool, w, false);
    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(s->pool, atoms); i++) {
        const qdot_symbol *symbol = qdot_expr_symbol(s->pool, qdot_expr_arg(s->pool, atoms, i));

        if (symbol->class == QDOT_DIFFERENTIAL && qdot_expr_kind(s->pool, symbol->base) == QDOT_LIST)
            return true;
    }
    return false;
}

qdot_expr
qdot_forms_lie(qdot_scene *s, qdot_expr w, qdot_expr X, uint32_t n, const qdot_expr *q)
{
    const qdot_expr inner = qdot_forms_interior(s, X, w, n, q);
    const qdot_expr outer = qdot_forms_interior(s, X, qdot_forms_exterior_derivative(s, w), n, q);
    form sum;

    if (form_read(&sum, s, qdot_add(s->pool, qdot_forms_exterior_derivative(s, inner), outer)))
        return form_write(&sum);
    qdot_free(sum.terms.at);
    return QDOT_NIL;
}

/* --- Hodge dual -------------------------------------------------------------------------------------- */

/* The numbers in the metric of the coordinates of a set; returns how many. */
static uint32_t
rows_of_set(const qdot_manifold *m, uint64_t set, uint32_t *rows)
{
    uint32_t n = 0;

    for (uint32_t i = 0; i < m->n; i++)
        if (set & bit_of(m->s, m->q[i]))
            rows[n++] = i;
    return n;
}

/* The minor of the inverse metric with the rows of `up` and the columns of `down`: the part of w_down in w^up. */
static qdot_expr
minor_of_inverse(const qdot_manifold *m, uint64_t up, uint64_t down)
{
    qdot_expr *entries, result;
    uint32_t rows[64], columns[64], p = rows_of_set(m, up, rows);

    rows_of_set(m, down, columns);
    if (p == 0)
        return QDOT_ONE;
    if (m->diagonal && up != down)
        return QDOT_ZERO;
    entries = qdot_calloc((size_t)p * p, sizeof *entries);
    if (entries == NULL)
        return qdot_pool_fail(m->pool);
    for (uint32_t i = 0; i < p * p; i++)
        entries[i] = m->inverse[rows[i / p] * m->n + columns[i % p]];
    result = p == 1 ? entries[0] : qdot_det(m->pool, qdot_matrix(m->pool, p, p, entries));
    qdot_free(entries);
    return result;
}

/* The next larger set with as many bits. */
static uint64_t
next_set(uint64_t set)
{
    const uint64_t low = set & -set, carried = set + low;

    return carried | (((carried ^ set) / low) >> 2);
}

/* The set of coordinates whose numbers in the metric are the bits of `numbers`. */
static uint64_t
set_of_numbers(const qdot_manifold *m, uint64_t numbers)
{
    uint64_t set = 0;

    for (uint32_t i = 0; i < m->n; i++)
        if (numbers >> i & 1)
            set |= bit_of(m->s, m->q[i]);
    return set;
}

static void
add_dual(form *sum, const qdot_manifold *m, const form *w)
{
    qdot_pool *pool = m->pool;
    const uint64_t end = (uint64_t)1 << m->n, all = set_of_numbers(m, end - 1);
    const qdot_expr volume = qdot_manifold_tidy(m, qdot_sqrt(pool, qdot_fun1(pool, QDOT_ABS, m->det)));

    for (uint64_t numbers = ((uint64_t)1 << w->degree) - 1; numbers < end; numbers = next_set(numbers)) {
        const uint64_t up = set_of_numbers(m, numbers);
        qdot_expr raised = QDOT_ZERO;

        for (size_t i = 0; i < w->terms.n; i++)
            raised = qdot_add(pool, raised, qdot_mul(pool, minor_of_inverse(m, up, w->terms.at[i].set), w->terms.at[i].f));
        raised = qdot_mul(pool, volume, raised);
        add_form_term(sum, all & ~up, sign_of_order(up, all & ~up) > 0 ? raised : qdot_neg(pool, raised));
        if (numbers == 0)
            break;
    }
}

qdot_expr
qdot_forms_hodge(qdot_scene *s, qdot_expr w, qdot_expr R)
{
    form a, sum = {.s = s};
    qdot_manifold m;

    if (!form_read(&a, s, w)) {
        qdot_free(a.terms.at);
        return QDOT_NIL;
    }
    if (qdot_manifold_begin(&m, s, R)) {
        if (has_coordinates(&a, m.n, m.q, "metric") && a.degree >= 0)
            add_dual(&sum, &m, &a);
        qdot_manifold_end(&m);
    }
    qdot_free(a.terms.at);
    return form_write(&sum);
}
