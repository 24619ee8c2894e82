/* enclosure.c -- evaluates expressions and their derivatives in interval arithmetic, in one pass. */
#include "normal/refute/enclosure.h"

#include <float.h>
#include <math.h>

#include "base/memory.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "num/arb.h"

/* A node: its operation, and the indices of its operands. */
typedef struct {
    qdot_kind kind;
    uint32_t op;
    uint32_t n, at; /* operands are arg[at] ... arg[at + n - 1]: terms of a sum, bases of a product */
    bool constant;  /* a constant, evaluated only once, when the object is made */
    size_t unknown; /* for a symbol: its index among the unknowns */
} node;

struct qdot_enclosure {
    size_t n, m, count;
    node *nodes;                 /* [count] the nodes, children first */
    qdot_enclosure_value *value; /* [count] present enclosure of each node */
    uint32_t *arg;               /* indices of the operands of all nodes */
    qdot_interval *number;       /* for each operand: coefficient in a sum, exponent in a product */
    bool *integer;               /* for each operand: its exponent is an integer */
    uint32_t *root;              /* [m] the node of each expression */
    bool slopes;
};

/* --- functions of one variable --------------------------------------------------------------- */

/* The image of an interval a under a function f: f(a), f'(a), and whether f is defined on a. */
typedef struct {
    qdot_interval y, slope;
    qdot_enclosure_state state;
} image;

static qdot_interval
interval_of(double lo, double hi)
{
    return (qdot_interval){lo, hi};
}

static qdot_interval
interval_scaled(double c, qdot_interval a)
{
    return qdot_interval_product(qdot_interval_point(c), a, false);
}

static qdot_interval
interval_square(qdot_interval a)
{
    return qdot_interval_product(a, a, true);
}

static qdot_interval
plus(double c, qdot_interval a)
{
    return qdot_interval_sum(qdot_interval_point(c), a);
}

static qdot_interval
inverse(qdot_interval a)
{
    return qdot_interval_quotient(qdot_interval_point(1), a);
}

static qdot_interval
interval_root(qdot_interval a)
{
    return qdot_interval_rising(sqrt, qdot_interval_within(a, 0, INFINITY));
}

static qdot_interval
wave_sin(qdot_interval a)
{
    return qdot_interval_wave(sin, a, M_PI_2);
}

static qdot_interval
wave_cos(qdot_interval a)
{
    return qdot_interval_wave(cos, a, 0);
}

static bool
contains_zero(qdot_interval a)
{
    return a.lo <= 0 && a.hi >= 0;
}

/* Where the interval a lies relative to the domain least ... most of a function; `ends`: the domain is closed. */
static qdot_enclosure_state
compare_with_domain(qdot_interval a, double least, double most, bool ends)
{
    if (a.hi < least || a.lo > most || (!ends && (a.hi <= least || a.lo >= most)))
        return QDOT_ENCLOSURE_NOWHERE;
    if (ends ? a.lo >= least && a.hi <= most : a.lo > least && a.hi < most)
        return QDOT_ENCLOSURE_WHOLE;
    return QDOT_ENCLOSURE_PARTLY;
}

/* The quotient above/below of two intervals, where `below` vanishes at poles only. */
static image
fraction(qdot_interval above, qdot_interval below, qdot_interval slope)
{
    image f = {qdot_interval_quotient(above, below), slope, QDOT_ENCLOSURE_WHOLE};

    if (contains_zero(below))
        f.state = below.lo == 0 && below.hi == 0 ? QDOT_ENCLOSURE_NOWHERE
                                                 : QDOT_ENCLOSURE_PARTLY;
    return f;
}

/* The image of a function that is defined and continuous everywhere. */
static image
everywhere(qdot_interval y, qdot_interval slope)
{
    return (image){y, slope, QDOT_ENCLOSURE_WHOLE};
}

/* The image of a function on a that is defined from `least` to `most`; `ends`: also there. */
static image
where(qdot_interval a, double least, double most, bool ends, qdot_interval y, qdot_interval slope)
{
    return (image){y, slope, compare_with_domain(a, least, most, ends)};
}

/* The image of a function of which only the ends of its values are known. */
static image
by_range(uint32_t op)
{
    image f = {{0, 0}, qdot_interval_whole, QDOT_ENCLOSURE_PARTLY};

    qdot_fun_ends((qdot_fun_id)op, &f.y.lo, &f.y.hi);
    return f;
}

static image
tangent(qdot_interval a)
{
    qdot_interval c = wave_cos(a), slope = inverse(interval_square(c));

    if (!contains_zero(c) && a.hi - a.lo < 3) /* no pole of tan inside: a lies within one branch, in which tan increases */
        return everywhere(qdot_interval_rising(tan, a), slope);
    return fraction(wave_sin(a), c, slope);
}

static qdot_interval
hyperbolic_cosine(qdot_interval a)
{
    return qdot_interval_within(qdot_interval_rising(cosh, qdot_interval_size(a)), 1, INFINITY);
}

/* The interval 1 - a^2. */
static qdot_interval
one_less_square(qdot_interval a)
{
    return plus(1, qdot_interval_negative(interval_square(a)));
}

/* The interval 2/sqrt(pi) exp(-a^2). */
static qdot_interval
gaussian_slope(qdot_interval a)
{
    return interval_scaled(
        M_2_SQRTPI,
        qdot_interval_within(qdot_interval_rising(exp, qdot_interval_negative(interval_square(a))),
                             0, INFINITY));
}

static image
stepped(uint32_t op, qdot_interval a)
{
    qdot_interval zero = qdot_interval_point(0),
                  side = interval_of((a.lo > 0) - (a.lo < 0), (a.hi > 0) - (a.hi < 0));
    bool one_side = a.lo > 0 || a.hi < 0 || (a.lo == 0 && a.hi == 0);

    if (op == QDOT_ABS)
        return (image){qdot_interval_size(a),
                       interval_of(a.lo < 0 ? -1 : 1, a.hi > 0 ? 1 : -1),
                       QDOT_ENCLOSURE_WHOLE};
    if (op == QDOT_SIGN)
        return (image){side, zero,
                       one_side ? QDOT_ENCLOSURE_WHOLE : QDOT_ENCLOSURE_PARTLY};
    one_side = floor(a.lo) == floor(a.hi) && a.lo != floor(a.lo);
    return (image){interval_of(floor(a.lo), floor(a.hi)), zero,
                   one_side ? QDOT_ENCLOSURE_WHOLE : QDOT_ENCLOSURE_PARTLY};
}

/* The image of a function of function.def, by its column. */
static image
image_of_function(uint32_t op, qdot_interval a)
{
    const qdot_interval one = qdot_interval_point(1);

    switch (op) {
#define rising qdot_interval_rising
#define falling qdot_interval_falling
#define negative qdot_interval_negative
#define quotient qdot_interval_quotient
#define cut qdot_interval_within
#define X(ID, name, least, most, traits, lo, hi, inverse, operation, value, ball, image, ...) \
    case QDOT_##ID: return image;
#include "expr/function.def"
#undef X
#undef rising
#undef falling
#undef negative
#undef quotient
#undef cut
    default: return everywhere(a, one); /* hold */
    }
}

/* --- operations on intervals -------------------------------------------------------------------- */

static qdot_enclosure_state
worse_state(qdot_enclosure_state a, qdot_enclosure_state b)
{
    return a < b ? a : b;
}

/* Add to the derivatives of `to` those of v times a factor. */
static void
add_scaled_derivatives(const qdot_enclosure *s, qdot_enclosure_value *to, qdot_interval factor,
                       const qdot_enclosure_value *v)
{
    for (size_t j = 0; j < s->n && s->slopes; j++)
        if (v->slope[j].lo != 0 || v->slope[j].hi != 0)
            to->slope[j] = qdot_interval_sum(
                to->slope[j], qdot_interval_product(factor, v->slope[j], false));
}

static const qdot_enclosure_value *
operand(const qdot_enclosure *s, const node *k, uint32_t i)
{
    return s->value + s->arg[k->at + i];
}

static void
evaluate_sum(const qdot_enclosure *s, const node *k, qdot_enclosure_value *to)
{
    for (uint32_t i = 0; i < k->n; i++) {
        const qdot_enclosure_value *v = operand(s, k, i);
        qdot_interval c = s->number[k->at + i];

        to->y = qdot_interval_sum(to->y, qdot_interval_product(c, v->y, false));
        to->state = worse_state(to->state, v->state);
        add_scaled_derivatives(s, to, c, v);
    }
}

/* The image of an interval a under v^p, and of its derivative by v, for exponents p in an interval. */
static image
image_power(qdot_interval a, qdot_interval p, bool integer)
{
    image f = {a, qdot_interval_point(1), QDOT_ENCLOSURE_WHOLE};

    if (p.lo == 1 && p.hi == 1)
        return f;
    if (!integer) {
        f.state = compare_with_domain(a, 0, INFINITY, p.lo > 0);
        a = qdot_interval_within(a, 0, INFINITY);
    } else if (p.lo < 0 && contains_zero(a)) {
        f.state = a.lo == 0 && a.hi == 0 ? QDOT_ENCLOSURE_NOWHERE : QDOT_ENCLOSURE_PARTLY;
    }
    f.y = qdot_interval_power(a, p);
    if (p.lo == 2 && p.hi == 2)
        f.slope = interval_scaled(2, a);
    else
        f.slope = qdot_interval_product(
            p,
            qdot_interval_power(a, integer ? qdot_interval_point(p.lo - 1) : plus(-1, p)),
            false);
    return f;
}

/* Evaluate a power v^p as exp(p log v), for an exponent that is an expression. */
static image
evaluate_general_power(const qdot_enclosure *s, const qdot_enclosure_value *v,
                       const qdot_enclosure_value *p, qdot_enclosure_value *to)
{
    qdot_interval base = qdot_interval_within(v->y, 0, INFINITY);
    image f = {qdot_interval_whole, qdot_interval_whole,
               worse_state(compare_with_domain(v->y, 0, INFINITY, false), worse_state(v->state, p->state))};

    f.y = qdot_interval_power(base, p->y);
    if (s->slopes) { /* derivative of y = v^p: y (p' log v + p v'/v) */
        qdot_interval log_v = qdot_interval_rising(log, base);

        add_scaled_derivatives(s, to, qdot_interval_product(f.y, log_v, false), p);
        add_scaled_derivatives(s, to,
                               qdot_interval_product(f.y, qdot_interval_quotient(p->y, base), false),
                               v);
    }
    return f;
}

static void
evaluate_product(const qdot_enclosure *s, const node *k, qdot_enclosure_value *to)
{
    for (uint32_t i = 0; i < k->n; i++) {
        const qdot_enclosure_value *v = operand(s, k, i);
        const qdot_interval p = s->number[k->at + i];
        image f;
        qdot_enclosure_value part = {.state = QDOT_ENCLOSURE_WHOLE};

        if (isnan(p.lo)) { /* NaN marks that the exponent is an expression, which follows its base in the list */
            f = evaluate_general_power(s, v, operand(s, k, ++i), &part);
        } else {
            f = image_power(v->y, p, s->integer[k->at + i]);
            f.state = worse_state(f.state, v->state);
            add_scaled_derivatives(s, &part, f.slope, v);
        }
        for (size_t j = 0; j < s->n && s->slopes; j++)
            to->slope[j] =
                qdot_interval_sum(qdot_interval_product(to->slope[j], f.y, false),
                                  qdot_interval_product(to->y, part.slope[j], false));
        to->y = qdot_interval_product(to->y, f.y, false);
        to->state = worse_state(to->state, f.state);
    }
}

static void
evaluate_max_or_min(const qdot_enclosure *s, const node *k, qdot_enclosure_value *to)
{
    bool most = k->op == QDOT_MAX;

    *to = *operand(s, k, 0);
    for (uint32_t i = 1; i < k->n; i++) {
        const qdot_enclosure_value *v = operand(s, k, i);
        bool above = most ? to->y.lo > v->y.hi : to->y.hi < v->y.lo,
             below = most ? to->y.hi < v->y.lo : to->y.lo > v->y.hi;

        for (size_t j = 0; j < s->n; j++)
            to->slope[j] = above   ? to->slope[j]
                           : below ? v->slope[j]
                                   : qdot_interval_around(to->slope[j], v->slope[j]);
        to->y = most ? interval_of(fmax(to->y.lo, v->y.lo), fmax(to->y.hi, v->y.hi))
                     : interval_of(fmin(to->y.lo, v->y.lo), fmin(to->y.hi, v->y.hi));
        to->state = worse_state(to->state, v->state);
    }
}

static void
evaluate_if(const qdot_enclosure *s, const node *k, qdot_enclosure_value *to)
{
    const qdot_enclosure_value *c = operand(s, k, 0), *a = operand(s, k, 1),
                               *b = operand(s, k, 2);

    if (c->y.lo == c->y.hi) {
        *to = c->y.lo == 1 ? *a : *b;
        to->state = worse_state(to->state, c->state);
        return;
    }
    to->y = a->state == QDOT_ENCLOSURE_NOWHERE   ? b->y
            : b->state == QDOT_ENCLOSURE_NOWHERE ? a->y
                                                 : qdot_interval_around(a->y, b->y);
    to->state =
        c->state == QDOT_ENCLOSURE_NOWHERE ||
                (a->state == QDOT_ENCLOSURE_NOWHERE && b->state == QDOT_ENCLOSURE_NOWHERE)
            ? QDOT_ENCLOSURE_NOWHERE
            : QDOT_ENCLOSURE_PARTLY;
}

/* Evaluate the functions of two arguments, atan2 or mod. */
static void
evaluate_two_arguments(const qdot_enclosure *s, const node *k, qdot_enclosure_value *to)
{
    const qdot_enclosure_value *a = operand(s, k, 0), *b = operand(s, k, 1);
    qdot_interval square_of_r, q;

    to->state = worse_state(a->state, b->state);
    if (k->op == QDOT_ATAN2) {
        square_of_r = qdot_interval_sum(interval_square(a->y), interval_square(b->y));
        to->y = qdot_interval_angle(a->y, b->y);
        if (contains_zero(a->y) && b->y.lo <= 0)
            to->state = worse_state(to->state, QDOT_ENCLOSURE_PARTLY);
        add_scaled_derivatives(s, to, qdot_interval_quotient(b->y, square_of_r), a);
        add_scaled_derivatives(s, to,
                               qdot_interval_negative(qdot_interval_quotient(a->y, square_of_r)), b);
        return;
    }
    q = qdot_interval_quotient(a->y, b->y);
    to->y = qdot_interval_remainder(a->y, b->y);
    if (!isfinite(q.lo) || !isfinite(q.hi) || floor(q.lo) != floor(q.hi) ||
        q.lo == floor(q.lo))
        to->state = worse_state(to->state, QDOT_ENCLOSURE_PARTLY);
    add_scaled_derivatives(s, to, qdot_interval_point(1), a);
    add_scaled_derivatives(s, to, qdot_interval_point(-floor(q.lo)), b);
}

static void
evaluate_function(const qdot_enclosure *s, const node *k, qdot_enclosure_value *to)
{
    const qdot_enclosure_value *v = operand(s, k, 0);
    image f;

    switch (k->op) {
    case QDOT_MIN:
    case QDOT_MAX: evaluate_max_or_min(s, k, to); return;
    case QDOT_IF: evaluate_if(s, k, to); return;
    case QDOT_ATAN2:
    case QDOT_MOD: evaluate_two_arguments(s, k, to); return;
    default: break;
    }
    f = image_of_function(k->op, v->y);
    to->y = f.y;
    to->state = worse_state(v->state, f.state);
    add_scaled_derivatives(s, to, f.slope, v);
}

/* Evaluate a relation or logical operation: 1 true, 0 false, 0..1 not known. */
static void
evaluate_truth(const qdot_enclosure *s, const node *k, qdot_enclosure_value *to)
{
    const qdot_interval a = operand(s, k, 0)->y, b = k->n > 1 ? operand(s, k, 1)->y : a;
    bool sure, never;

    for (uint32_t i = 0; i < k->n; i++)
        to->state = worse_state(to->state, operand(s, k, i)->state);
    if (k->kind == QDOT_REL && k->op == QDOT_EQ) {
        sure = a.lo == a.hi && b.lo == b.hi && a.lo == b.lo;
        never = a.hi < b.lo || b.hi < a.lo;
    } else if (k->kind == QDOT_REL) {
        sure = k->op == QDOT_LT ? a.hi < b.lo : a.hi <= b.lo;
        never = k->op == QDOT_LT ? a.lo >= b.hi : a.lo > b.hi;
    } else if (k->op == QDOT_NOT) {
        sure = a.hi == 0;
        never = a.lo == 1;
    } else {
        bool all = k->op == QDOT_AND;

        sure = all;
        never = !all;
        for (uint32_t i = 0; i < k->n; i++) {
            qdot_interval c = operand(s, k, i)->y;

            sure = all ? sure && c.lo == 1 : sure || c.lo == 1;
            never = all ? never || c.hi == 0 : never && c.hi == 0;
        }
    }
    to->y = interval_of(sure, !never);
}

void
qdot_enclosure_eval(qdot_enclosure *s, const qdot_interval *X, bool slopes)
{
    s->slopes = slopes;
    for (size_t i = 0; i < s->count; i++) {
        const node *k = s->nodes + i;
        qdot_enclosure_value *to = s->value + i;

        if (k->constant)
            continue;
        for (size_t j = 0; j < s->n && slopes; j++)
            to->slope[j] = qdot_interval_point(0);
        to->state = QDOT_ENCLOSURE_WHOLE;
        switch (k->kind) {
        case QDOT_SYM:
            to->y = X[k->unknown];
            to->slope[k->unknown] = qdot_interval_point(1);
            break;
        case QDOT_SUM:
            to->y = s->number[k->at + k->n];
            evaluate_sum(s, k, to);
            break;
        case QDOT_PROD:
            to->y = s->number[k->at + k->n];
            evaluate_product(s, k, to);
            break;
        case QDOT_FUN: evaluate_function(s, k, to); break;
        default: evaluate_truth(s, k, to); break;
        }
        if (isnan(to->y.lo) || isnan(to->y.hi))
            to->y = qdot_interval_whole;
    }
}

const qdot_enclosure_value *
qdot_enclosure_get(const qdot_enclosure *s, size_t i)
{
    return s->value + s->root[i];
}

size_t
qdot_enclosure_size(const qdot_enclosure *s)
{
    return s->count;
}

size_t
qdot_enclosure_count(const qdot_enclosure *s)
{
    return s->m;
}

/* --- translating an expression -------------------------------------------------------------------- */

/* The smallest interval with doubles as ends that contains a rational. */
static qdot_interval
interval_of_rational(const fmpq *x)
{
    qdot_interval d;
    arb_t v;
    arf_t end;

    arb_init(v);
    arf_init(end);
    arb_set_fmpq(v, x, 64);
    arb_get_lbound_arf(end, v, 64);
    d.lo = arf_get_d(end, ARF_RND_FLOOR);
    arb_get_ubound_arf(end, v, 64);
    d.hi = arf_get_d(end, ARF_RND_CEIL);
    arb_clear(v);
    arf_clear(end);
    return d;
}

static void
set_operand(qdot_enclosure *s, uint32_t at, uint32_t arg, const fmpq *number)
{
    s->arg[at] = arg;
    s->number[at] = number == NULL ? interval_of(NAN, NAN) : interval_of_rational(number);
    s->integer[at] = number != NULL && fmpz_is_one(fmpq_denref(number));
}

/* List the operands of a sum or product with their coefficients or exponents; the constant comes last. */
static void
list_operands(qdot_enclosure *s, const qdot_pool *pool, const qdot_walk *w, qdot_expr e,
              node *k, uint32_t *used)
{
    uint32_t n = qdot_expr_count(pool, e);

    for (uint32_t i = 1; i + 1 < n; i += 2) {
        const fmpq *number = qdot_expr_rational(pool, qdot_expr_arg(pool, e, i + 1));

        set_operand(s, (*used)++, (uint32_t)qdot_walk_index(w, qdot_expr_arg(pool, e, i)),
                    number);
        if (number == NULL)
            set_operand(s, (*used)++, (uint32_t)qdot_walk_index(w, qdot_expr_arg(pool, e, i + 1)),
                        NULL);
    }
    k->n = *used - k->at;
    set_operand(s, (*used)++, 0, qdot_expr_rational(pool, qdot_expr_arg(pool, e, 0)));
}

static bool
translate_node(qdot_enclosure *s, const qdot_pool *pool, const qdot_walk *w, size_t i,
               const qdot_expr *x, uint32_t *used)
{
    qdot_expr e = w->at[i];
    node *k = s->nodes + i;
    qdot_enclosure_value *v = s->value + i;

    *k = (node){
        .kind = qdot_expr_kind(pool, e), .op = qdot_expr_node(pool, e)->op, .at = *used};
    v->state = QDOT_ENCLOSURE_WHOLE;
    switch (k->kind) {
    case QDOT_NUM:
        k->constant = true;
        v->y = interval_of_rational(qdot_expr_rational(pool, e));
        return true;
    case QDOT_SYM:
        k->unknown = qdot_expr_place(s->n, x, e);
        k->constant = k->unknown == s->n;
        v->y = e == QDOT_PI ? interval_of(M_PI, nextafter(M_PI, 4))
                            : qdot_interval_point(e == QDOT_TRUE);
        return !k->constant || e == QDOT_PI || e == QDOT_TRUE || e == QDOT_FALSE;
    case QDOT_SUM:
    case QDOT_PROD: list_operands(s, pool, w, e, k, used); return true;
    case QDOT_FUN:
    case QDOT_REL:
    case QDOT_LOGIC:
        k->n = qdot_expr_count(pool, e);
        for (uint32_t a = 0; a < k->n; a++)
            set_operand(s, (*used)++, (uint32_t)qdot_walk_index(w, qdot_expr_arg(pool, e, a)),
                        NULL);
        return true;
    default: return false;
    }
}

static qdot_status
translate_nodes(qdot_enclosure *s, const qdot_pool *pool, const qdot_walk *w, size_t m,
                const qdot_expr *e, const qdot_expr *x)
{
    size_t operands = 1;
    uint32_t used = 0;

    for (size_t i = 0; i < w->n; i++)
        operands += qdot_expr_count(pool, w->at[i]) + 1;
    s->count = w->n;
    s->m = m;
    s->nodes = qdot_calloc(w->n + 1, sizeof *s->nodes);
    s->value = qdot_calloc(w->n + 1, sizeof *s->value);
    s->arg = qdot_calloc(operands, sizeof *s->arg);
    s->number = qdot_calloc(operands, sizeof *s->number);
    s->integer = qdot_calloc(operands, sizeof *s->integer);
    s->root = qdot_calloc(m + 1, sizeof *s->root);
    if (s->nodes == NULL || s->value == NULL || s->arg == NULL || s->number == NULL ||
        s->integer == NULL || s->root == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < w->n; i++)
        if (!translate_node(s, pool, w, i, x, &used))
            return qdot_fail(QDOT_ETYPE, "an expression has no numbers");
    for (size_t i = 0; i < m; i++)
        s->root[i] = (uint32_t)qdot_walk_index(w, e[i]);
    return QDOT_OK;
}

qdot_status
qdot_enclosure_new(qdot_pool *pool, size_t m, const qdot_expr *e, size_t n,
                   const qdot_expr *x, qdot_enclosure **out)
{
    qdot_walk walk;
    qdot_status status;

    *out = qdot_calloc(1, sizeof **out);
    if (*out == NULL)
        return QDOT_ENOMEM;
    (*out)->n = n;
    status = n > QDOT_ENCLOSURE_MOST ? qdot_fail(QDOT_ETYPE, "too many unknowns")
                                     : qdot_walk_begin_n(pool, m, e, &walk);
    if (status == QDOT_OK) {
        status = translate_nodes(*out, pool, &walk, m, e, x);
        qdot_walk_end(&walk);
    }
    if (status != QDOT_OK) {
        qdot_enclosure_free(*out);
        *out = NULL;
    }
    return status;
}

void
qdot_enclosure_free(qdot_enclosure *s)
{
    if (s == NULL)
        return;
    qdot_free(s->nodes);
    qdot_free(s->value);
    qdot_free(s->arg);
    qdot_free(s->number);
    qdot_free(s->integer);
    qdot_free(s->root);
    qdot_free(s);
}
