/* print.c -- expressions as formulas, and these as text: a stack of what is still to be opened, no recursion.
 *
 * Each node is opened into children of a node of the formula; those that are expressions are empty and wait on the
 * stack. Names and numbers are made by print-symbol.c and print-number.c.
 */
#include "expr/print.h"

#include <string.h>

#include "base/interrupt.h"
#include "expr/exact.h"
#include "expr/print-formula.h"
#include "expr/print-parts.h"
#include "expr/printed.h"
#include "expr/walk.h"
#include "formula/write.h"
#include "num/integer.h"

/* --- printing sums ---------------------------------------------------------------------------- */

static bool
is_negative_number(const qdot_pool *pool, qdot_expr number)
{
    return qdot_rational_sgn(RATIONAL(pool, number)) < 0;
}

/* One c t of a sum (t a PROD, a symbol ... or 1), its sign written before it: a plus where it
 * leads (nothing) or where a difference in t takes the minus. */
static void
term(printer *p, qdot_expr c, qdot_expr t, bool turned, bool leads)
{
    bool minus = is_negative_number(p->pool, c) != turned;
    bool flip = minus && turnable(p, t) != QDOT_NIL;

    if (minus && !flip)
        print_sign(p, leads ? QDOT_SIGN_NEGATIVE : QDOT_SIGN_MINUS);
    else if (!leads)
        print_sign(p, QDOT_SIGN_PLUS);
    qdot_print_part(p, (struct part){.e = t, .coefficient = c, .context = MAGNITUDE, .turned = flip});
}

/* Terms stand in their order, the number last. But constants stand before what coordinates enter
 * by functions alone: m + M sin(x)^2, R + r cos(x). */
static bool
is_constant_term(const qdot_pool *pool, qdot_expr e)
{
    return (NODE(pool, e)->holds & ~(QDOT_HAS_PARAM | QDOT_HAS_FORMAL | QDOT_HAS_FUN)) ==
           0;
}

/* Whether a term contains coordinates only as arguments of functions: R sin(x), r cos(x). */
static bool
has_coordinates_only_in_functions(const qdot_pool *pool, qdot_expr e)
{
    bool any = false;
    const qdot_node *node = NODE(pool, e);
    uint32_t allowed =
        QDOT_HAS_PARAM | QDOT_HAS_FORMAL | QDOT_HAS_COORD | QDOT_HAS_TIME | QDOT_HAS_FUN;

    if ((node->holds & ~allowed) != 0 || !(node->holds & QDOT_HAS_FUN))
        return false;
    if (node->kind != QDOT_PROD)
        return node->kind == QDOT_FUN;
    for (uint32_t i = 1; i < node->n; i += 2) {
        qdot_expr b = ARGS(pool, e)[i];

        if (!is_constant_term(pool, b) && NODE(pool, b)->kind != QDOT_FUN &&
            NODE(pool, b)->kind != QDOT_SYM)
            return false;
        any |= !is_constant_term(pool, b) && NODE(pool, b)->kind == QDOT_FUN;
    }
    return any;
}

static bool
constants_go_first(const qdot_pool *pool, qdot_expr e)
{
    const qdot_expr *args = ARGS(pool, e);
    uint32_t n = NODE(pool, e)->n, constants = args[0] != QDOT_ZERO, others = 0;

    if (!(NODE(pool, e)->holds & QDOT_HAS_FUN) || n > 64)
        return false;
    for (uint32_t i = 1; i < n; i += 2) {
        if (is_constant_term(pool, args[i]))
            constants++;
        else if (has_coordinates_only_in_functions(pool, args[i]))
            others++;
        else
            return false;
    }
    return constants > 0 && others > 0;
}

static bool
term_needs_minus(const printer *p, qdot_expr e, bool turned, uint32_t i)
{
    const qdot_expr *args = ARGS(p->pool, e);

    return is_negative_number(p->pool, i == 0 ? args[0] : args[i + 1]) != turned &&
           (i == 0 || turnable(p, args[i]) == QDOT_NIL);
}

/* What stands in a term beside parameters and functions; of the number nothing; roots of sums are a
 * sort of their own. */
static uint32_t
term_sort_class(const qdot_pool *pool, qdot_expr e, uint32_t i)
{
    const uint32_t either = QDOT_HAS_PARAM | QDOT_HAS_FORMAL | QDOT_HAS_FUN;
    const uint32_t root = UINT32_C(1) << 31;
    qdot_expr t = i == 0 ? QDOT_ONE : ARGS(pool, e)[i];
    uint32_t sort = NODE(pool, t)->holds & ~either;

    for (uint32_t k = 1; NODE(pool, t)->kind == QDOT_PROD && k < NODE(pool, t)->n; k += 2) {
        const fmpq *x = NUMBER(pool, ARGS(pool, t)[k + 1]);

        if (NODE(pool, ARGS(pool, t)[k])->kind == QDOT_SUM && x != NULL &&
            !fmpz_is_one(fmpq_denref(x)))
            sort |= root;
    }
    return sort;
}

/* The term at `lead` needs no minus, those before it do: it goes first, and what is of the sort of
 * one passed goes before that too: m2 + m3 - m1, but y - x + 1. */
static void
move_plus_terms_first(const printer *p, qdot_expr e, bool turned, uint32_t *order, uint32_t lead,
                      uint32_t n)
{
    for (uint32_t k = lead; k < n; k++) {
        uint32_t to = k, i = order[k];

        if (term_needs_minus(p, e, turned, i))
            continue;
        while (to > 0 && term_needs_minus(p, e, turned, order[to - 1]) &&
               (k == lead || term_sort_class(p->pool, e, i) == term_sort_class(p->pool, e, order[to - 1])))
            to--;
        memmove(order + to + 1, order + to, (k - to) * sizeof *order);
        order[to] = i;
    }
}

/* The terms as they are written, 0 the number: where the first needs a minus, those that need none
 * lead. */
static uint32_t
order_terms(const printer *p, qdot_expr e, bool turned, uint32_t *order)
{
    const qdot_pool *pool = p->pool;
    const qdot_expr *args = ARGS(pool, e);
    uint32_t n = NODE(pool, e)->n, count = 0, lead = 0, others;
    uint32_t late = NODE(pool, e)->holds & QDOT_HAS_MULTIPLIER;
    bool first = constants_go_first(pool, e);

    if (NODE(pool, e)->holds == 0 && args[0] != QDOT_ZERO) /* a number first, then roots: 2 + sqrt(2) */
        order[count++] = 0;

    for (uint32_t i = 1; i < n; i += 2)
        if (!(NODE(pool, args[i])->holds & late) &&
            (!first || is_constant_term(pool, args[i])))
            order[count++] = i;
    if (args[0] != QDOT_ZERO && NODE(pool, e)->holds != 0)
        order[count++] = 0;
    for (uint32_t i = 1; i < n && first; i += 2)
        if (!is_constant_term(pool, args[i]))
            order[count++] = i;
    others = count;
    for (uint32_t i = 1; i < n; i += 2) /* order of the terms: m g + lambda x, multipliers last */
        if (NODE(pool, args[i])->holds & late)
            order[count++] = i;
    if (others == 0)
        others = count;
    for (; lead < others; lead++) {
        if (!term_needs_minus(p, e, turned, order[lead]))
            break;
    }
    if (lead > 0 && lead < others)
        move_plus_terms_first(p, e, turned, order, lead, others);
    return count;
}

/* The degree of b^x in the expansion symbols: b one of them or a sum that contains one, x an integer. */
static int64_t
degree_of_power(const printer *p, qdot_expr b, qdot_expr x)
{
    const fmpq *k = qdot_expr_rational(p->pool, x);
    uint8_t kind = NODE(p->pool, b)->kind;

    if ((kind != QDOT_SYM && kind != QDOT_SUM) || k == NULL ||
        !fmpz_is_one(fmpq_denref(k)) || !qdot_integer_fits(fmpq_numref(k)))
        return 0;
    for (uint32_t i = 0; i < NODE(p->pool, p->ascending)->n; i++)
        if (qdot_expr_contains(p->pool, b, ARGS(p->pool, p->ascending)[i]))
            return qdot_integer_get(fmpq_numref(k));
    return 0;
}

static int64_t
degree_of_term(const printer *p, qdot_expr term)
{
    int64_t sum = 0;

    if (NODE(p->pool, term)->kind != QDOT_PROD)
        return degree_of_power(p, term, QDOT_ONE);
    for (uint32_t i = 1; i < NODE(p->pool, term)->n; i += 2)
        sum += degree_of_power(p, ARGS(p->pool, term)[i], ARGS(p->pool, term)[i + 1]);
    return sum;
}

/* Sort the terms of a sum by degree, and keep their order among terms of the same degree. */
static uint32_t
order_terms_by_degree(const printer *p, qdot_expr e, uint32_t *order)
{
    const qdot_expr *args = ARGS(p->pool, e);
    uint32_t n = NODE(p->pool, e)->n, count = 0;

    if (args[0] != QDOT_ZERO)
        order[count++] = 0;
    for (uint32_t i = 1; i < n; i += 2) {
        int64_t of = degree_of_term(p, args[i]);
        uint32_t k = count++;

        for (; k > 0 && (order[k - 1] == 0 ? 0 : degree_of_term(p, args[order[k - 1]])) > of; k--)
            order[k] = order[k - 1];
        order[k] = i;
    }
    return count;
}

static void
print_sum(printer *p, qdot_expr e, int context, bool turned)
{
    const qdot_expr *args = ARGS(p->pool, e);
    uint32_t few[34], n = NODE(p->pool, e)->n / 2 + 2, count;
    uint32_t *order = n > 34 ? qdot_malloc(n * sizeof *order) : few;
    const qdot_formula_id outer = print_begin_bracket(p, context >= FACTOR);

    if (order == NULL) {
        p->status = QDOT_ENOMEM;
        return;
    }
    count = p->ascending != QDOT_NIL && context < FACTOR
                ? order_terms_by_degree(p, e, order)
                                     : order_terms(p, e, turned, order);
    for (uint32_t k = 0; k < count; k++) {
        uint32_t i = order[k];

        if (i == 0)
            term(p, args[0], QDOT_ONE, turned, k == 0);
        else
            term(p, args[i + 1], args[i], turned, k == 0);
    }
    p->at = outer;
    if (order != few)
        qdot_free(order);
}

/* --- conditions, vectors, matrices, lists --------------------------------------------------------- */

/* Print a relation so that a number stands on its right: x > 0. */
static void
print_relation(printer *p, qdot_expr e, int context)
{
    static const qdot_formula_sign signs[] = {QDOT_SIGN_EQUALS, QDOT_SIGN_LESS, QDOT_SIGN_AT_MOST, QDOT_SIGN_GREATER,
                                              QDOT_SIGN_AT_LEAST};
    uint16_t op = NODE(p->pool, e)->op;
    const qdot_expr *side = ARGS(p->pool, e);
    bool turned = op != QDOT_EQ && NODE(p->pool, side[0])->holds == 0 &&
                  NODE(p->pool, side[1])->holds != 0;
    const qdot_formula_id outer = print_begin_bracket(p, context > TOP);

    child(p, side[turned], TERM);
    print_sign(p, signs[op + (turned ? 2 : 0)]);
    child(p, side[!turned], TERM);
    p->at = outer;
}

/* Whether an operand of `and`, `or`, `not` needs brackets: `not` binds tightest. */
static bool
needs_brackets(const qdot_pool *pool, uint16_t op, qdot_expr part)
{
    const qdot_node *node = NODE(pool, part);

    return op == QDOT_NOT ||
           (node->kind == QDOT_LOGIC && node->op == QDOT_OR && op == QDOT_AND);
}

static void
print_logic(printer *p, qdot_expr e, int context)
{
    const qdot_node *node = NODE(p->pool, e);
    const qdot_formula_id outer = print_begin_bracket(p, context > TOP);

    if (node->op == QDOT_NOT)
        print_sign(p, QDOT_SIGN_NOT);
    for (uint32_t i = 0; i < node->n; i++) {
        qdot_expr part = ARGS(p->pool, e)[i];

        if (i > 0)
            print_sign(p, node->op == QDOT_AND ? QDOT_SIGN_AND : QDOT_SIGN_OR);
        child(p, part, needs_brackets(p->pool, node->op, part) ? TERM : TOP);
    }
    p->at = outer;
}

/* Print a vector (a, b); a vector of equations by itself as (a, b) = (c, d). */
static void
print_vector(printer *p, qdot_expr e, int context)
{
    uint32_t n = NODE(p->pool, e)->n;
    bool equations = context == TOP;

    for (uint32_t i = 0; i < n && equations; i++) {
        const qdot_node *node = NODE(p->pool, ARGS(p->pool, e)[i]);

        equations = node->kind == QDOT_REL && node->op == QDOT_EQ;
    }
    for (uint32_t side = 0; side <= equations; side++) {
        qdot_formula_id outer;

        if (side)
            print_sign(p, QDOT_SIGN_EQUALS);
        outer = print_begin_bracket(p, true);
        for (uint32_t i = 0; i < n; i++) {
            qdot_expr one = ARGS(p->pool, e)[i];

            if (i > 0)
                print_sign(p, QDOT_SIGN_COMMA);
            child(p, equations ? ARGS(p->pool, one)[side] : one, TOP);
        }
        p->at = outer;
    }
}

static void
print_matrix(printer *p, qdot_expr e)
{
    const qdot_node *node = NODE(p->pool, e);
    const qdot_formula_id outer = print_begin(p, QDOT_FORMULA_TABLE, 0, 0);

    qdot_formula_count(p->out, p->at, node->op);
    for (uint32_t i = 0; i < node->n; i++)
        child(p, ARGS(p->pool, e)[i], TOP);
    p->at = outer;
}

static void
print_number_node(printer *p, qdot_expr e, int context)
{
    fmpq_t c;

    fmpq_init(c);
    qdot_rational_set(c, RATIONAL(p->pool, e));
    if (context == MAGNITUDE)
        fmpq_abs(c, c);
    if (context == NUMERATOR) { /* print only the numerator */
        fmpz_abs(fmpq_numref(c), fmpq_numref(c));
        fmpz_one(fmpq_denref(c));
    }
    if (context == DENOMINATOR) { /* print only the denominator */
        fmpz_set(fmpq_numref(c), fmpq_denref(c));
        fmpz_one(fmpq_denref(c));
    }
    qdot_print_number(p, c, context >= FACTOR ? (context == BASE ? 2 : 1) : 0);
    fmpq_clear(c);
}

static void
print_node(printer *p, const struct part *x)
{
    const qdot_pool *pool = p->pool;
    const qdot_node *node = NODE(pool, x->e);

    p->at = x->at;
    p->binder = x->binder;
    if (x->coefficient != QDOT_NIL) {
        qdot_print_scaled(p, x->coefficient, x->e, x->context, x->turned);
        return;
    }
    switch (node->kind) {
    case QDOT_NUM: print_number_node(p, x->e, x->context); break;
    case QDOT_SYM: qdot_print_symbol_parts(p, x->e); break;
    case QDOT_SUM: print_sum(p, x->e, x->context, x->turned); break;
    case QDOT_PROD:
        qdot_print_scaled(p, ARGS(pool, x->e)[0], x->e, x->context, false);
        break;
    case QDOT_FUN: qdot_print_function(p, x->e, x->context); break;
    case QDOT_UFUN: qdot_print_ufun(p, x->e, x->context); break;
    case QDOT_INTEGRAL: qdot_print_integral(p, x->e, x->context); break;
    case QDOT_REL: print_relation(p, x->e, x->context); break;
    case QDOT_LOGIC: print_logic(p, x->e, x->context); break;
    case QDOT_VEC: print_vector(p, x->e, x->context); break;
    case QDOT_LIST:
        print_begin(p, QDOT_FORMULA_BRACKET, QDOT_BRACKET_SQUARE, 0);
        children(p, x->e, 0, node->n);
        break;
    default: print_matrix(p, x->e);
    }
}

void
qdot_print_text(printer *p, const char *text)
{
    qdot_formula_add_text(p->out, p->at, QDOT_TEXT_NAME, text, strlen(text));
}

/* The context of x, apart from the expression itself, on which its printed form depends. */
static uint32_t
get_printing_context(const printer *p, const struct part *x)
{
    return (uint32_t)(x->context - NUMERATOR) << 4 | (uint32_t)p->fractions << 3 | (uint32_t)p->notation << 1 | x->turned;
}

/* Print x; if an equal sum, function or name was printed before, share the children of its node. */
static void
print_part(printer *p, struct part x)
{
    uint8_t kind = NODE(p->pool, x.e)->kind;
    const bool again = x.coefficient == QDOT_NIL && p->ascending == QDOT_NIL && p->below == QDOT_NIL &&
                       !(NODE(p->pool, x.e)->holds & QDOT_HAS_BOUND) &&
                       (kind == QDOT_SUM || kind == QDOT_FUN || kind == QDOT_UFUN || kind == QDOT_SYM);
    const qdot_formula_id of = again ? qdot_printed_find(p->pool->printed, x.e, get_printing_context(p, &x)) : 0;

    if (of != 0) {
        qdot_formula_share(p->out, x.at, of);
        return;
    }
    print_node(p, &x);
    qdot_formula_unwrap(p->out, x.at);
    if (again && p->status == QDOT_OK)
        p->status = qdot_printed_keep(p->pool->printed, x.e, get_printing_context(p, &x), x.at);
}

void
qdot_print_part(printer *p, struct part x)
{
    const uint8_t kind = NODE(p->pool, x.e)->kind;

    if (x.coefficient == QDOT_NIL && kind == QDOT_NUM &&
        (x.context < 0 || qdot_rational_sgn(RATIONAL(p->pool, x.e)) >= 0)) {
        print_number_node(p, x.e, x.context);
        return;
    }
    x.at = qdot_formula_add(p->out, p->at, QDOT_FORMULA_SPAN, 0, 0);
    x.binder = p->binder;
    if (x.coefficient == QDOT_NIL && kind == QDOT_SYM) {
        const qdot_formula_id at = p->at;

        print_part(p, x);
        p->at = at;
    } else if (qdot_vec_push(&p->todo, x) != QDOT_OK) {
        p->status = QDOT_ENOMEM;
    }
}

/* The difference in the denominator of a matrix entry; nil if there is none. */
static qdot_expr
difference_in_denominator(const qdot_pool *pool, qdot_expr e)
{
    for (uint32_t i = 1; NODE(pool, e)->kind == QDOT_PROD && i < NODE(pool, e)->n; i += 2) {
        qdot_expr b = ARGS(pool, e)[i];
        if (ARGS(pool, e)[i + 1] == QDOT_MINUS_ONE && NODE(pool, b)->kind == QDOT_SUM &&
            !(NODE(pool, b)->sign & QDOT_GE0))
            for (uint32_t k = 0; k < NODE(pool, b)->n; k += 2)
                if (is_negative_number(pool, ARGS(pool, b)[k]))
                    return b;
    }
    return QDOT_NIL;
}

/* Entries of a matrix over one difference show it alike, with the sign by which fewer of them have a
 * minus, else the first none: [d, -b; -c, a] over a*d - b*c. */
static void
find_common_denominator(printer *p, qdot_expr e)
{
    const qdot_node *node = NODE(p->pool, e);
    int minuses = 0, count = 0;

    for (uint32_t i = 0; i < node->n && node->kind == QDOT_MAT; i++) {
        qdot_expr entry = ARGS(p->pool, e)[i], b = difference_in_denominator(p->pool, entry);
        bool minus;

        if (b == QDOT_NIL || (p->below != QDOT_NIL && b != p->below))
            continue;
        minus = is_negative_number(p->pool, ARGS(p->pool, entry)[0]);
        if (count == 0)
            p->below_turned = minus;
        p->below = b;
        count++;
        minuses += minus;
    }
    if (2 * minuses != count)
        p->below_turned = 2 * minuses > count;
    if (count < 2) {
        p->below = QDOT_NIL;
        p->below_turned = false;
    }
}

qdot_notation_kind
qdot_print_notation(qdot_style style)
{
    return style == QDOT_PLAIN     ? QDOT_NOTATION_SCRIPT
           : style == QDOT_UNICODE ? QDOT_NOTATION_LINE
                                   : QDOT_NOTATION_DRAWN;
}

qdot_status
qdot_print_formula(const qdot_pool *pool, qdot_expr e, qdot_expr in, qdot_notation_kind notation, qdot_formula *out,
                   qdot_formula_id parent)
{
    printer p = {.pool = pool, .notation = notation, .ascending = in, .out = out, .at = parent};

    if (e == QDOT_NIL)
        return qdot_pool_failed(pool) ? qdot_fail_again(&pool->error) /* the reason why there is no formula */
                                      : qdot_fail(QDOT_EINVAL, "nothing to print");
    qdot_printed_begin(pool->printed, out);
    QDOT_TRY(qdot_print_wants_fractions(pool, e, &p.fractions));
    find_common_denominator(&p, e);
    if (qdot_vec_push(&p.binders, ((struct binder){0})) != QDOT_OK)
        return QDOT_ENOMEM;
    child(&p, e, TOP);
    while (p.status == QDOT_OK && p.todo.n > 0) {
        print_part(&p, p.todo.at[--p.todo.n]);
        if (p.status == QDOT_OK)
            p.status = out->failed ? QDOT_ENOMEM : qdot_interrupt_check();
    }
    qdot_free(p.todo.at);
    qdot_free(p.binders.at);
    if (p.status == QDOT_OK) /* a number or a name takes no step of the loop, where the formula is checked, too */
        p.status = qdot_formula_status(out);
    if (p.status != QDOT_OK)
        /* forget the nodes stored for expressions that were not printed completely */
        qdot_printed_forget(pool->printed);
    return p.status;
}

qdot_status
qdot_print(const qdot_pool *pool, qdot_expr e, qdot_style style, qdot_text *out)
{
    return qdot_print_series(pool, e, QDOT_NIL, style, out);
}

qdot_status
qdot_print_series(const qdot_pool *pool, qdot_expr e, qdot_expr in, qdot_style style,
                  qdot_text *out)
{
    qdot_formula *f = qdot_printed_formula(pool->printed);
    const qdot_formula_id all = qdot_formula_new(f, QDOT_FORMULA_SPAN, 0, 0);
    qdot_status status = qdot_print_formula(pool, e, in, qdot_print_notation(style), f, all);

    return status != QDOT_OK ? status : qdot_print_written(f, all, style, out);
}

qdot_status
qdot_print_written(const qdot_formula *f, qdot_formula_id id, qdot_style style, qdot_text *out)
{
    switch (style) {
    case QDOT_LATEX: return qdot_formula_write_latex(f, id, out);
    case QDOT_MATHML: return qdot_formula_write_mathml(f, id, out);
    default: return qdot_formula_write_line(f, id, qdot_print_notation(style), out);
    }
}
