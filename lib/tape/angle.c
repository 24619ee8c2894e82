/* angle.c -- chooses base angles, of which sines and cosines of sums and multiples are composed, by
 * their cost. */
#include "tape/angle.h"

#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/rational.h"
#include "expr/symbol.h"

enum { MOST_MULTIPLE = 8, NONE = QDOT_KEYMAP_NONE };

/* Cost of a call of sine and cosine, and of an addition formula: in operations for numbers; in products for Taylor series. */
static const struct {
    int64_t call, addition;
} number = {20, 6}, of_series = {2, 4};

/* A base angle, unit * term, from which other angles are composed; term nil: a constant, at no cost. */
typedef struct {
    qdot_expr term, unit;
    qdot_expr constant;
    bool split;    /* the term has too many different multiples: each multiple is a base angle of its own */
    uint32_t uses; /* the number of composed arguments (sums of base angles) that contain this base angle */
    bool made;
    qdot_value sine, cosine;
} base;

/* An integer multiple of a base angle: multiple * base. The first, with multiple 1, is the base itself. */
typedef struct {
    uint32_t base, multiple;
    uint32_t uses;
    bool made;
    qdot_value sine, cosine;
} multiple;

/* A sum of two angles: that of the sum `parent` (NONE: 0), plus or minus a multiple of a base angle. */
typedef struct {
    uint32_t parent, multiple;
    bool minus;
    uint32_t uses;
    bool made;
    qdot_value sine, cosine;
} angle_sum;

/* One summand of the argument of a sine or cosine. */
typedef struct {
    qdot_expr term, coefficient; /* the summand is coefficient * term */
    qdot_expr source, of_source; /* a node of the expression whose value is of_source * term */
    qdot_expr constant;          /* the summand if term is nil */
    uint32_t base, multiple;
    bool minus;
} part;

typedef struct {
    size_t first, n; /* index of the argument's first summand; number of its summands */
    bool minus;      /* the argument is minus the sum of the summands */
    bool composed;
    uint32_t sum;
} argument;

struct qdot_angles {
    qdot_pool *pool;
    int64_t call, addition; /* costs of calling a sine and cosine, and of an addition formula */
    qdot_vec(part) parts;
    qdot_vec(argument) arguments;
    qdot_vec(base) bases;
    qdot_vec(multiple) multiples;
    qdot_vec(angle_sum) sums;
    qdot_keymap by_expr;  /* argument expression -> argument */
    qdot_keymap by_term;  /* (term, coefficient if split) or (nil, constant) -> base */
    qdot_keymap by_times; /* (base, multiple) -> multiple */
    qdot_keymap by_sum;   /* (parent, multiple, minus) -> sum */
};

void
qdot_angles_free(qdot_angles *a)
{
    if (!a)
        return;
    qdot_free(a->parts.at);
    qdot_free(a->arguments.at);
    qdot_free(a->bases.at);
    qdot_free(a->multiples.at);
    qdot_free(a->sums.at);
    qdot_keymap_clear(&a->by_expr);
    qdot_keymap_clear(&a->by_term);
    qdot_keymap_clear(&a->by_times);
    qdot_keymap_clear(&a->by_sum);
    qdot_free(a);
}

static bool
is_sine_or_cosine(const qdot_node *node)
{
    return node->kind == QDOT_FUN
           && (node->op == QDOT_SIN || node->op == QDOT_COS || node->op == QDOT_TAN
               || node->op == QDOT_SEC || node->op == QDOT_CSC || node->op == QDOT_COT);
}

/* --- reading the arguments ---------------------------------------------------------- */

/* Split a term into its rational coefficient and the product of its other factors. */
static qdot_expr
split_off_coefficient(qdot_pool *pool, qdot_expr e, qdot_expr *coefficient)
{
    *coefficient = QDOT_ONE;
    if (qdot_expr_kind(pool, e) == QDOT_PROD) {
        *coefficient = qdot_expr_arg(pool, e, 0);
        if (*coefficient != QDOT_ONE)
            return qdot_div(pool, e, *coefficient);
    }
    return e;
}

/* Read the summands of factor * e; if factor is 1, `e` is a node of the expression. */
static qdot_status
read_summands(qdot_angles *a, qdot_expr e, qdot_expr factor, qdot_expr *constant)
{
    qdot_pool *pool = a->pool;
    uint32_t n = qdot_expr_count(pool, e);

    *constant = qdot_mul(pool, factor, qdot_expr_arg(pool, e, 0));
    for (uint32_t i = 1; i + 1 < n; i += 2) {
        qdot_expr t = qdot_expr_arg(pool, e, i);
        qdot_expr c = qdot_mul(pool, factor, qdot_expr_arg(pool, e, i + 1));

        if (qdot_expr_is_constant(pool, t))
            *constant = qdot_add(pool, *constant, qdot_mul(pool, c, t));
        else
            QDOT_TRY(qdot_vec_push(&a->parts, ((part){.term = t,
                                                      .coefficient = c,
                                                      .source = t,
                                                      .of_source = QDOT_ONE})));
    }
    return QDOT_OK;
}

static qdot_status
read_argument(qdot_angles *a, qdot_expr e)
{
    qdot_pool *pool = a->pool;
    argument arg = {.first = a->parts.n};
    qdot_expr c, constant = QDOT_ZERO, term = split_off_coefficient(pool, e, &c);

    if (qdot_keymap_get(&a->by_expr, e, 0, 0, 0) != NONE)
        return QDOT_OK;
    if (qdot_pool_failed(pool))
        return qdot_pool_check(pool);
    if (qdot_expr_kind(pool, term) == QDOT_SUM)
        QDOT_TRY(read_summands(a, term, c, &constant));
    else
        QDOT_TRY(qdot_vec_push(&a->parts, ((part){.term = term, .coefficient = c,
                                                  .source = e, .of_source = c})));
    if (qdot_pool_failed(pool))
        return qdot_pool_check(pool);
    /* if the first summand is negative, use minus the sum of the opposite summands */
    if (a->parts.n > arg.first)
        arg.minus = qdot_expr_is_negative(pool, a->parts.at[arg.first].coefficient);
    for (size_t i = arg.first; i < a->parts.n; i++) {
        part *p = a->parts.at + i;

        p->minus = qdot_expr_is_negative(pool, p->coefficient) != arg.minus;
    }
    if (arg.minus)
        constant = qdot_neg(pool, constant);
    if (constant != QDOT_ZERO)
        QDOT_TRY(qdot_vec_push(&a->parts, ((part){.constant = constant})));
    arg.n = a->parts.n - arg.first;
    QDOT_TRY(qdot_vec_push(&a->arguments, arg));
    return qdot_keymap_set(&a->by_expr, e, 0, 0, 0, (uint32_t)(a->arguments.n - 1));
}

/* --- bases, multiples, sums --------------------------------------------------------- */

static qdot_expr
absolute_number(qdot_pool *pool, qdot_expr number)
{
    return qdot_expr_is_negative(pool, number) ? qdot_neg(pool, number) : number;
}

/* The largest unit of which x and y are both integer multiples; nil if x or y is nil. */
static qdot_expr
common_unit(qdot_pool *pool, qdot_expr x, qdot_expr y)
{
    qdot_expr e;
    fmpq_t g;

    if (x == QDOT_NIL || y == QDOT_NIL)
        return QDOT_NIL;
    fmpq_init(g);
    qdot_rational_gcd(g, qdot_expr_rational(pool, x), qdot_expr_rational(pool, y));
    e = qdot_expr_fmpq(pool, g);
    fmpq_clear(g);
    return e;
}

/* The number `coefficient` as an integer multiple of the unit; 0 if it is not a small integer multiple. */
static int64_t
multiple_of_unit(qdot_pool *pool, qdot_expr coefficient, qdot_expr unit)
{
    int64_t k = 0;

    if (!qdot_expr_to_int(pool, qdot_div(pool, coefficient, unit), &k) || k < 1
        || k > MOST_MULTIPLE)
        return 0;
    return k;
}

static qdot_status
find_or_add_base(qdot_angles *a, qdot_expr term, qdot_expr key, const base *fresh,
                 uint32_t *found)
{
    *found = qdot_keymap_get(&a->by_term, term, key, 0, 0);
    if (*found != NONE)
        return QDOT_OK;
    QDOT_TRY(qdot_vec_push(&a->bases, *fresh));
    *found = (uint32_t)(a->bases.n - 1);
    return qdot_keymap_set(&a->by_term, term, key, 0, 0, *found);
}

/* Find the base angle of every summand, after all summands have been read and the units are known. */
static qdot_status
find_base_angles(qdot_angles *a)
{
    qdot_pool *pool = a->pool;

    for (size_t i = 0; i < a->parts.n; i++) {
        part *p = a->parts.at + i;
        base fresh = {.term = p->term, .constant = p->constant};

        p->multiple = 1;
        if (p->term == QDOT_NIL) {
            QDOT_TRY(find_or_add_base(a, QDOT_NIL, p->constant, &fresh, &p->base));
            continue;
        }
        fresh.unit = p->coefficient = absolute_number(pool, p->coefficient);
        QDOT_TRY(find_or_add_base(a, p->term, 0, &fresh, &p->base));
        a->bases.at[p->base].unit =
            common_unit(pool, a->bases.at[p->base].unit, p->coefficient);
    }
    for (size_t i = 0; i < a->parts.n; i++) {
        part *p = a->parts.at + i;

        if (p->term != QDOT_NIL
            && multiple_of_unit(pool, p->coefficient, a->bases.at[p->base].unit) == 0)
            a->bases.at[p->base].split = true;
    }
    for (size_t i = 0; i < a->parts.n; i++) {
        part *p = a->parts.at + i;
        base fresh = {.term = p->term, .unit = p->coefficient};

        if (p->term == QDOT_NIL)
            continue;
        if (a->bases.at[p->base].split)
            QDOT_TRY(find_or_add_base(a, p->term, p->coefficient, &fresh, &p->base));
        else
            p->multiple =
                (uint32_t)multiple_of_unit(pool, p->coefficient, a->bases.at[p->base].unit);
    }
    return qdot_pool_check(pool);
}

static qdot_status
find_or_add_sums(qdot_angles *a)
{
    for (size_t i = 0; i < a->arguments.n; i++) {
        argument *arg = a->arguments.at + i;

        arg->sum = NONE;
        for (size_t k = 0; k < arg->n; k++) {
            part *p = a->parts.at + arg->first + k;
            uint32_t m = qdot_keymap_get(&a->by_times, p->base, p->multiple, 0, 0), s;

            if (m == NONE) {
                m = (uint32_t)a->multiples.n;
                QDOT_TRY(qdot_vec_push(
                    &a->multiples,
                    ((multiple){.base = p->base, .multiple = p->multiple})));
                QDOT_TRY(qdot_keymap_set(&a->by_times, p->base, p->multiple, 0, 0, m));
            }
            s = qdot_keymap_get(&a->by_sum, arg->sum, m, p->minus, 0);
            if (s == NONE) {
                s = (uint32_t)a->sums.n;
                QDOT_TRY(qdot_vec_push(&a->sums, ((angle_sum){.parent = arg->sum,
                                                              .multiple = m,
                                                              .minus = p->minus})));
                QDOT_TRY(qdot_keymap_set(&a->by_sum, arg->sum, m, p->minus, 0, s));
            }
            arg->sum = s;
        }
    }
    return QDOT_OK;
}

/* --- which arguments to compose ----------------------------------------------------- */

/* Choose whether an argument is composed from base angles, or has its own sine call; returns the added cost. */
static int64_t
choose_composition(qdot_angles *a, argument *arg, bool composed)
{
    int64_t change = composed ? -a->call : a->call;
    const uint32_t before = composed ? 0 : 1; /* number of uses with which an angle begins (or ceases) to cost something */

    if (arg->composed == composed)
        return 0;
    arg->composed = composed;
    for (uint32_t s = arg->sum; s != NONE; s = a->sums.at[s].parent) {
        angle_sum *sum = a->sums.at + s;
        multiple *m = a->multiples.at + sum->multiple;
        base *b = a->bases.at + m->base;
        int64_t cost = 0;

        cost += sum->uses == before && sum->parent != NONE ? a->addition : 0;
        cost += m->uses == before && m->multiple > 1 ? a->addition : 0;
        cost += b->uses == before && b->term != QDOT_NIL ? a->call : 0;
        change += composed ? cost : -cost;
        sum->uses += composed ? 1 : -1u;
        m->uses += composed ? 1 : -1u;
        b->uses += composed ? 1 : -1u;
    }
    return change;
}

/* Whether the argument of a sine or cosine is a base angle itself. */
static bool
is_base_angle(const qdot_angles *a, const argument *arg)
{
    const part *p = a->parts.at + arg->first;

    return arg->n == 1 && p->multiple == 1;
}

static bool
contains_base(const qdot_angles *a, const argument *arg, uint32_t b)
{
    for (size_t k = 0; k < arg->n; k++)
        if (a->parts.at[arg->first + k].base == b)
            return true;
    return false;
}

/* Give all composed arguments that contain base b (NONE: all) their own calls if that is cheaper;
 * returns whether it was. */
static bool
is_cheaper_without_base(qdot_angles *a, uint32_t b, bool *changed)
{
    size_t n = 0;
    int64_t change = 0;

    for (size_t i = 0; i < a->arguments.n; i++) {
        argument *arg = a->arguments.at + i;

        changed[i] =
            arg->composed && !is_base_angle(a, arg) && (b == NONE || contains_base(a, arg, b));
        if (changed[i]) {
            change += choose_composition(a, arg, false);
            n++;
        }
    }
    if (n == 0 || change < 0)
        return n > 0;
    for (size_t i = 0; i < a->arguments.n; i++)
        if (changed[i])
            choose_composition(a, a->arguments.at + i, true);
    return false;
}

static qdot_status
choose_compositions(qdot_angles *a)
{
    bool *changed = qdot_malloc(a->arguments.n * sizeof *changed), again = true;

    if (!changed)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < a->arguments.n; i++)
        choose_composition(a, a->arguments.at + i, true);
    is_cheaper_without_base(a, NONE, changed);
    for (int round = 0; again && round < 8; round++) {
        again = false;
        for (uint32_t b = 0; b < a->bases.n; b++)
            again |= a->bases.at[b].term != QDOT_NIL && is_cheaper_without_base(a, b, changed);
        for (size_t i = 0; i < a->arguments.n; i++) {
            argument *arg = a->arguments.at + i;

            if (!arg->composed || is_base_angle(a, arg))
                continue;
            if (choose_composition(a, arg, false) < 0)
                again = true;
            else
                choose_composition(a, arg, true);
        }
    }
    qdot_free(changed);
    return QDOT_OK;
}

qdot_status
qdot_angles_new(qdot_pool *pool, const qdot_walk *walk, bool series,
                qdot_angles **angles)
{
    qdot_angles *a = qdot_calloc(1, sizeof *a);
    qdot_status status = a ? QDOT_OK : QDOT_ENOMEM;

    *angles = NULL;
    if (!a)
        return status;
    a->pool = pool;
    a->call = series ? of_series.call : number.call;
    a->addition = series ? of_series.addition : number.addition;
    for (size_t i = 0; i < walk->n && status == QDOT_OK; i++) {
        qdot_expr e = walk->at[i];

        if (is_sine_or_cosine(qdot_expr_node(pool, e)) && !qdot_expr_is_constant(pool, e))
            status = read_argument(a, qdot_expr_arg(pool, e, 0));
    }
    if (status == QDOT_OK)
        status = find_base_angles(a);
    if (status == QDOT_OK)
        status = find_or_add_sums(a);
    if (status == QDOT_OK)
        status = choose_compositions(a);
    if (status != QDOT_OK) {
        qdot_angles_free(a);
        a = NULL;
    }
    *angles = a;
    return status;
}

/* --- writing code for angles -------------------------------------------------------- */

/* Write code for the sine and cosine (s, c) of the sum A + B, or of the difference A - B. */
static void
write_addition_formula(qdot_code *code, qdot_value *s, qdot_value *c, qdot_value sb, qdot_value cb,
                       bool minus)
{
    qdot_value sc = qdot_code_op(code, QDOT_OP_MUL, *s, cb, 0);
    qdot_value cs = qdot_code_op(code, QDOT_OP_MUL, *c, sb, 0);
    qdot_value cc = qdot_code_op(code, QDOT_OP_MUL, *c, cb, 0);
    qdot_value ss = qdot_code_op(code, QDOT_OP_MUL, *s, sb, 0);

    *s = qdot_code_op(code, minus ? QDOT_OP_SUB : QDOT_OP_ADD, sc, cs, 0);
    *c = qdot_code_op(code, minus ? QDOT_OP_ADD : QDOT_OP_SUB, cc, ss, 0);
}

/* Write code for the base angle unit * term, from the value of `source`, a node of the expression. */
static void
write_base_angle(qdot_angles *a, const qdot_walk *walk, qdot_code *code, const part *p)
{
    base *b = a->bases.at + p->base;
    qdot_value x;

    if (b->made)
        return;
    b->made = true;
    if (b->term == QDOT_NIL) {
        b->sine = qdot_code_constant(code, qdot_fun1(a->pool, QDOT_SIN, b->constant));
        b->cosine = qdot_code_constant(code, qdot_fun1(a->pool, QDOT_COS, b->constant));
        return;
    }
    x = (qdot_value)qdot_walk_get(walk, p->source);
    if (p->of_source != b->unit) {
        qdot_expr ratio = qdot_div(a->pool, b->unit, p->of_source);

        x = ratio == QDOT_MINUS_ONE
                ? qdot_code_op(code, QDOT_OP_NEG, x, 0, 0)
                : qdot_code_op(code, QDOT_OP_MUL, x, qdot_code_constant(code, ratio), 0);
    }
    qdot_code_sincos(code, x, &b->sine, &b->cosine);
}

/* Write code for sine and cosine of an integer multiple of a base angle, by doubling and adding angles. */
static void
write_multiple_angle(qdot_angles *a, qdot_code *code, uint32_t m)
{
    multiple *to = a->multiples.at + m;
    const base *b = a->bases.at + to->base;
    uint32_t bit = 1;

    if (to->made)
        return;
    to->made = true;
    while (2 * bit <= to->multiple)
        bit *= 2;
    to->sine = b->sine;
    to->cosine = b->cosine;
    while ((bit /= 2) > 0) {
        /* sin 2x = 2 s c and cos 2x = (c - s)(c + s) */
        qdot_value sc = qdot_code_op(code, QDOT_OP_MUL, to->sine, to->cosine, 0);
        qdot_value minus = qdot_code_op(code, QDOT_OP_SUB, to->cosine, to->sine, 0);
        qdot_value plus = qdot_code_op(code, QDOT_OP_ADD, to->cosine, to->sine, 0);

        to->sine = qdot_code_op(code, QDOT_OP_ADD, sc, sc, 0);
        to->cosine = qdot_code_op(code, QDOT_OP_MUL, minus, plus, 0);
        if (to->multiple & bit)
            write_addition_formula(code, &to->sine, &to->cosine, b->sine, b->cosine, false);
    }
}

static void
write_composed_angle(qdot_angles *a, const qdot_walk *walk, qdot_code *code, const argument *arg,
                     qdot_value *sine, qdot_value *cosine)
{
    /* The sums from the outermost in; those not made yet are then made outward. Parts
     * and sums correspond: part k belongs to the sum k steps above the innermost. */
    qdot_value s = 0, c = 0;

    for (size_t k = 0; k < arg->n; k++) {
        uint32_t sum = arg->sum;
        angle_sum *at;
        const multiple *m;

        for (size_t up = arg->n - 1; up > k; up--)
            sum = a->sums.at[sum].parent;
        at = a->sums.at + sum;
        if (!at->made) {
            write_base_angle(a, walk, code, a->parts.at + arg->first + k);
            write_multiple_angle(a, code, at->multiple);
            m = a->multiples.at + at->multiple;
            if (at->parent == NONE) {
                s = m->sine;
                c = m->cosine;
            } else
                write_addition_formula(code, &s, &c, m->sine, m->cosine, at->minus);
            at->made = true;
            at->sine = s;
            at->cosine = c;
        }
        s = at->sine;
        c = at->cosine;
    }
    *sine = arg->minus ? qdot_code_op(code, QDOT_OP_NEG, s, 0, 0) : s;
    *cosine = c;
}

void
qdot_angles_pair(qdot_angles *a, const qdot_walk *walk, qdot_code *code, qdot_expr e,
                 qdot_value *sine, qdot_value *cosine)
{
    const argument *arg = a->arguments.at + qdot_keymap_get(&a->by_expr, e, 0, 0, 0);

    if (arg->composed)
        write_composed_angle(a, walk, code, arg, sine, cosine);
    else
        qdot_code_sincos(code, (qdot_value)qdot_walk_get(walk, e), sine, cosine);
}
