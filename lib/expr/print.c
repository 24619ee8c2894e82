/* print.c -- expressions as text: a stack of pieces still to be written, no recursion.
 *
 * Each node is opened into pieces (texts and children, in reading order); names and numbers are
 * written by print-name.c.
 */
#include "expr/print.h"

#include <string.h>

#include "base/interrupt.h"
#include "expr/pool.h"
#include "expr/print-name.h"
#include "expr/printed.h"

/* How tightly the context binds: what a piece must not look like without brackets. */
enum { TOP, TERM, FACTOR, BASE, MAGNITUDE = -1, DENOMINATOR = -2, NUMERATOR = -3 };

/* A piece: a text (or a name), or an order of derivative, or an expression in its context;
 * `coefficient` not nil: times it (a NUM). */
struct piece {
    const char *text;
    qdot_expr e, coefficient;
    int context;
    uint32_t order;
    bool raised; /* a unicode superscript */
    bool turned; /* -1 times the sum e; of a product, its difference turned */
    bool name;   /* in its style: theta as θ */
    bool ends;   /* no text of its own: what began at `from` of the output is the text of e */
    size_t from;
};

typedef qdot_vec(struct piece) pieces;

typedef struct {
    const qdot_pool *pool;
    qdot_style style;
    qdot_text *out;
    pieces todo; /* a stack */
    pieces next; /* of the node being opened, in reading order */
    qdot_status status;
} printer;

static void
piece(printer *p, struct piece x)
{
    if (qdot_vec_push(&p->next, x) != QDOT_OK)
        p->status = QDOT_ENOMEM;
}

static void
say(printer *p, const char *text)
{
    piece(p, (struct piece){.text = text});
}

static void
child(printer *p, qdot_expr e, int context)
{
    piece(p, (struct piece){.e = e, .context = context});
}

/* The text of this style: plain, unicode, latex. */
static const char *
styled(const printer *p, const char *plain, const char *unicode, const char *latex)
{
    return p->style == QDOT_PLAIN ? plain : p->style == QDOT_UNICODE ? unicode : latex;
}

static void
open_bracket(printer *p)
{
    say(p, styled(p, "(", "(", "\\left("));
}

static void
close_bracket(printer *p)
{
    say(p, styled(p, ")", ")", "\\right)"));
}

static void
children(printer *p, qdot_expr e, uint32_t from, uint32_t to, const char *between)
{
    for (uint32_t i = from; i < to; i++) {
        if (i > from)
            say(p, between);
        child(p, ARGS(p->pool, e)[i], TOP);
    }
}

/* --- sums ------------------------------------------------------------------------------------- */

static bool
is_minus(const qdot_pool *pool, qdot_expr number)
{
    return fmpq_sgn(RATIONAL(pool, number)) < 0;
}

/* One c t of a sum (t a PROD, a symbol ... or 1), its sign written before it: a plus where it
 * leads (nothing) or where a difference in t takes the minus. */
static void
term(printer *p, qdot_expr c, qdot_expr t, bool turned, bool leads)
{
    bool minus = is_minus(p->pool, c) != turned;
    bool flip = minus && qdot_expr_turnable(p->pool, t) != QDOT_NIL;

    if (minus && !flip)
        say(p, leads ? styled(p, "-", "−", "-") : styled(p, " - ", " − ", " - "));
    else if (!leads)
        say(p, " + ");
    piece(p,
          (struct piece){.e = t, .coefficient = c, .context = MAGNITUDE, .turned = flip});
}

/* The first term that needs no minus stands first; then the others; the number last. */
static void
open_sum(printer *p, qdot_expr e, int context, bool turned)
{
    const qdot_pool *pool = p->pool;
    const qdot_expr *args = ARGS(pool, e);
    uint32_t n = NODE(pool, e)->n, lead = 1;
    bool number_first = false;

    while (lead < n && is_minus(pool, args[lead + 1]) != turned &&
           qdot_expr_turnable(pool, args[lead]) == QDOT_NIL)
        lead += 2;
    if (lead >= n) {
        number_first = args[0] != QDOT_ZERO && is_minus(pool, args[0]) == turned;
        lead = number_first ? n : 1;
    }
    if (context >= FACTOR)
        open_bracket(p);
    if (number_first)
        term(p, args[0], QDOT_ONE, turned, true);
    else
        term(p, args[lead + 1], args[lead], turned, true);
    for (uint32_t i = 1; i < n; i += 2)
        if (i != lead)
            term(p, args[i + 1], args[i], turned, false);
    if (args[0] != QDOT_ZERO && !number_first)
        term(p, args[0], QDOT_ONE, turned, false);
    if (context >= FACTOR)
        close_bracket(p);
}

/* --- products --------------------------------------------------------------------------------- */

/* Whether b^e stands below the fraction bar. */
static bool
below(const qdot_pool *pool, qdot_expr e)
{
    const fmpq *x = qdot_expr_rational(pool, e);

    return x != NULL ? fmpq_sgn(x) < 0
                     : NODE(pool, e)->kind == QDOT_PROD && qdot_expr_is_negative(pool, e);
}

/* An exponent, its sign turned where it stands below. */
static void
exponent(printer *p, qdot_expr e, bool turned)
{
    const qdot_pool *pool = p->pool;
    const fmpq *x = qdot_expr_rational(pool, e);
    bool integer =
        x != NULL && fmpz_is_one(fmpq_denref(x)) && (fmpq_sgn(x) > 0 || turned);
    struct piece number = {.e = e, .context = turned ? MAGNITUDE : TOP};

    if (turned && x == NULL) {
        /* -n as n: the coefficient's sign is left out */
        number.context = MAGNITUDE;
        integer = NODE(pool, e)->n == 3 && ARGS(pool, e)[0] == QDOT_MINUS_ONE &&
                  ARGS(pool, e)[2] == QDOT_ONE &&
                  NODE(pool, ARGS(pool, e)[1])->kind == QDOT_SYM;
    } else if (x == NULL) {
        integer = NODE(pool, e)->kind == QDOT_SYM;
    }
    if (p->style == QDOT_LATEX) {
        say(p, "^{");
        piece(p, number);
        say(p, "}");
        return;
    }
    if (p->style == QDOT_UNICODE && x != NULL && integer) {
        number.raised = true;
        piece(p, number);
        return;
    }
    say(p, integer ? "^" : "^(");
    piece(p, number);
    if (!integer)
        say(p, ")");
}

static bool
is_circular(const qdot_pool *pool, qdot_expr e)
{
    return NODE(pool, e)->kind == QDOT_FUN && NODE(pool, e)->op <= QDOT_COT;
}

/* sin(x)^2 as sin²(x). */
static void
power_of_function(printer *p, qdot_expr b, qdot_expr e, bool turned)
{
    const char *name = qdot_fun_name(NODE(p->pool, b)->op);

    if (p->style == QDOT_LATEX)
        say(p, "\\");
    say(p, name);
    exponent(p, e, turned);
    open_bracket(p);
    children(p, b, 0, NODE(p->pool, b)->n, ", ");
    close_bracket(p);
}

/* Whether e is 1/2 or -1/2. */
static bool
is_sqrt(const qdot_pool *pool, qdot_expr e)
{
    const fmpq *x = qdot_expr_rational(pool, e);

    return x != NULL && fmpz_equal_si(fmpq_denref(x), 2) && fmpz_is_pm1(fmpq_numref(x));
}

/* What √ may stand before without brackets. */
static bool
is_bare(const qdot_pool *pool, qdot_expr e)
{
    return NODE(pool, e)->kind == QDOT_SYM ||
           (NODE(pool, e)->kind == QDOT_NUM &&
            fmpz_is_one(fmpq_denref(RATIONAL(pool, e))) &&
            fmpq_sgn(RATIONAL(pool, e)) > 0);
}

/* b^e, or b^-e below the bar. */
static void
factor(printer *p, qdot_expr b, qdot_expr e, bool turned, int context)
{
    const qdot_pool *pool = p->pool;
    const fmpq *x = qdot_expr_rational(pool, e);
    bool half = is_sqrt(pool, e) && (turned || fmpq_sgn(x) > 0);

    if (half && p->style == QDOT_UNICODE && is_bare(pool, b)) {
        say(p, "√");
        child(p, b, TOP);
    } else if (half) {
        say(p, styled(p, "sqrt(", "√(", "\\sqrt{"));
        child(p, b, TOP);
        say(p, styled(p, ")", ")", "}"));
    } else if (turned ? e == QDOT_MINUS_ONE : e == QDOT_ONE) {
        child(p, b, context);
    } else if (p->style != QDOT_PLAIN && is_circular(pool, b) && x != NULL &&
               fmpz_is_one(fmpq_denref(x)) && (turned || fmpq_sgn(x) > 0)) {
        power_of_function(p, b, e, turned);
    } else {
        child(p, b, BASE);
        exponent(p, e, turned);
    }
}

/* How many of the factors stand below (or above) the bar. */
static uint32_t
count_factors(const qdot_pool *pool, qdot_expr e, bool down)
{
    uint32_t count = 0;

    if (NODE(pool, e)->kind != QDOT_PROD)
        return e != QDOT_ONE && !down;
    for (uint32_t i = 1; i < NODE(pool, e)->n; i += 2)
        count += below(pool, ARGS(pool, e)[i + 1]) == down;
    return count;
}

/* What joins a number to the factor b^e after it. */
static const char *
joint(const printer *p, const fmpq *number, qdot_expr b, qdot_expr e)
{
    if (NODE(p->pool, b)->kind != QDOT_NUM)
        return styled(p, "*", " ", " ");
    if (is_sqrt(p->pool, e) && qdot_print_is_compact(number)) /* 2√3 */
        return styled(p, "*", "", " ");
    return styled(p, "*", "·", " \\cdot ");
}

/* The factors of e above (below) the bar; number: what stands before them already, or NULL;
 * turned: the base that is written as its negative. */
static void
factors(printer *p, qdot_expr e, bool down, const fmpq *number, int context,
        qdot_expr turned)
{
    const qdot_pool *pool = p->pool;
    bool first = true;

    if (NODE(pool, e)->kind != QDOT_PROD) {
        if (number != NULL)
            say(p, joint(p, number, e, QDOT_ONE));
        child(p, e, context);
        return;
    }
    for (uint32_t i = 1; i < NODE(pool, e)->n; i += 2) {
        qdot_expr b = ARGS(pool, e)[i], x = ARGS(pool, e)[i + 1];

        if (below(pool, x) != down)
            continue;
        if (first && number != NULL)
            say(p, joint(p, number, b, x));
        else if (!first)
            say(p, NODE(pool, b)->kind == QDOT_NUM ? styled(p, "*", "·", " \\cdot ")
                                                   : styled(p, "*", " ", " "));
        if (b == turned)
            piece(p, (struct piece){.e = b, .context = context, .turned = true});
        else
            factor(p, b, x, down, context);
        first = false;
    }
}

/* c * e, e without a coefficient of its own (or the number 1); a context below 0: the sign is
 * written already; flip: a
 * difference takes the minus. */
static void
open_scaled(printer *p, qdot_expr c, qdot_expr e, int context, bool flip)
{
    const qdot_pool *pool = p->pool;
    const fmpq *x = RATIONAL(pool, c);
    bool latex = p->style == QDOT_LATEX;
    qdot_expr turned = flip || (fmpq_sgn(x) < 0 && context >= 0)
                           ? qdot_expr_turnable(pool, e)
                           : QDOT_NIL;
    bool minus = fmpq_sgn(x) < 0 && context >= 0 && turned == QDOT_NIL,
         fraction = !fmpz_is_one(fmpq_denref(x));
    uint32_t up = count_factors(pool, e, false), down = count_factors(pool, e, true);
    /* the number's denominator: 1/2*m/r, but 1/(2*r) where nothing else stands above */
    bool inside = fraction && down > 0 && (up == 0 || latex);
    bool number = up == 0 || !fmpz_is_pm1(fmpq_numref(x)) || (fraction && !inside);
    bool several = !latex && (down > 1 || inside), frac = latex && down > 0;
    uint32_t written = number + up + down;
    bool bracket = context == BASE
                       ? written > 1 || minus || e == QDOT_ONE || up + down > 0
                       : context == FACTOR && (minus || down > 0 || fraction);

    if (bracket)
        open_bracket(p);
    if (minus)
        say(p, styled(p, "-", "−", "-"));
    if (frac)
        say(p, "\\frac{");
    if (number)
        piece(p, (struct piece){.e = c, .context = inside ? NUMERATOR : MAGNITUDE});
    if (up > 0)
        factors(p, e, false, number ? x : NULL,
                frac && number + up == 1 ? TOP
                : written > 1 || minus   ? FACTOR
                : context < 0            ? TERM
                                         : context,
                turned);
    if (down > 0) {
        say(p, frac ? "}{" : several ? "/(" : "/");
        if (inside)
            piece(p, (struct piece){.e = c, .context = DENOMINATOR});
        factors(p, e, true, inside ? x : NULL,
                frac && down == 1 && !inside ? TOP
                : several || frac            ? FACTOR
                                             : BASE,
                QDOT_NIL);
        if (frac || several)
            say(p, frac ? "}" : ")");
    }
    if (bracket)
        close_bracket(p);
}

/* --- functions --------------------------------------------------------------------------------- */

static void
open_function(printer *p, qdot_expr e)
{
    qdot_fun_id id = NODE(p->pool, e)->op;
    bool latex = p->style == QDOT_LATEX;

    if (latex && (id == QDOT_ABS || id == QDOT_FLOOR)) {
        say(p, id == QDOT_ABS ? "\\left|" : "\\left\\lfloor ");
        child(p, ARGS(p->pool, e)[0], TOP);
        say(p, id == QDOT_ABS ? "\\right|" : "\\right\\rfloor ");
        return;
    }
    if (latex && qdot_print_latex_word(id) != NULL) {
        say(p, qdot_print_latex_word(id));
    } else {
        say(p, latex ? "\\operatorname{" : "");
        say(p, qdot_fun_name(id));
        say(p, latex ? "}" : "");
    }
    open_bracket(p);
    children(p, e, 0, NODE(p->pool, e)->n, ", ");
    close_bracket(p);
}

/* --- undefined functions ------------------------------------------------------------------------ */

static void
name(printer *p, const char *text)
{
    piece(p, (struct piece){.text = text, .name = true});
}

/* (s, t): the arguments, or the declared ones. */
static void
arguments(printer *p, qdot_expr e, bool declared)
{
    const qdot_ufun *f = &p->pool->ufuns.at[NODE(p->pool, e)->op];

    say(p, "(");
    children(p, declared ? f->formals : e, 0, f->arity, ", ");
    say(p, ")");
}

static uint32_t
order_of(const qdot_pool *pool, qdot_expr e, uint32_t i)
{
    long order = 0;

    qdot_expr_to_int(pool, ARGS(pool, e)[NODE(pool, e)->n / 2 + i], &order);
    return (uint32_t)order;
}

/* subs(diff(x(s, t), s, 2), s = a), the shortest text that parses back. */
static void
derivative_plain(printer *p, qdot_expr e, bool moved)
{
    const qdot_pool *pool = p->pool;
    const qdot_ufun *f = &pool->ufuns.at[NODE(pool, e)->op];
    uint32_t n = f->arity;

    if (moved)
        say(p, "subs(");
    for (uint32_t i = 0; i < n; i++)
        if (order_of(pool, e, i) > 0)
            say(p, "diff(");
    name(p, f->name);
    arguments(p, e, true);
    for (uint32_t i = 0; i < n; i++) {
        if (order_of(pool, e, i) == 0)
            continue;
        say(p, ", ");
        child(p, ARGS(pool, f->formals)[i], TOP);
        if (order_of(pool, e, i) > 1) {
            say(p, ", ");
            child(p, ARGS(pool, e)[n + i], TOP);
        }
        say(p, ")");
    }
    if (!moved)
        return;
    for (uint32_t i = 0; i < n; i++) {
        if (ARGS(pool, e)[i] == ARGS(pool, f->formals)[i])
            continue;
        say(p, ", ");
        child(p, ARGS(pool, f->formals)[i], TOP);
        say(p, " = ");
        child(p, ARGS(pool, e)[i], TOP);
    }
    say(p, ")");
}

/* ∂²x/∂s∂t, at other arguments (∂x/∂s)(a, b). */
static void
derivative_partial(printer *p, qdot_expr e, uint32_t total, bool moved, int context)
{
    const qdot_pool *pool = p->pool;
    const qdot_ufun *f = &pool->ufuns.at[NODE(pool, e)->op];
    bool bracket = (moved && p->style != QDOT_LATEX) || (!moved && context >= BASE),
         first = true;

    if (bracket)
        open_bracket(p);
    say(p, styled(p, "", "∂", "\\frac{\\partial"));
    piece(p, (struct piece){.order = total});
    say(p, styled(p, "", "", " "));
    name(p, f->name);
    say(p, styled(p, "", "/", "}{"));
    for (uint32_t i = 0; i < f->arity; i++) {
        if (order_of(pool, e, i) == 0)
            continue;
        say(p, styled(p, "", "∂", first ? "\\partial " : " \\partial "));
        child(p, ARGS(pool, f->formals)[i], TOP);
        piece(p, (struct piece){.order = order_of(pool, e, i)});
        first = false;
    }
    say(p, styled(p, "", "", "}"));
    if (bracket)
        close_bracket(p);
    if (moved)
        arguments(p, e, false);
}

static void
open_ufun(printer *p, qdot_expr e, int context)
{
    const qdot_pool *pool = p->pool;
    const qdot_ufun *f = &pool->ufuns.at[NODE(pool, e)->op];
    uint32_t total = 0;
    bool moved = false;

    for (uint32_t i = 0; i < f->arity; i++) {
        total += order_of(pool, e, i);
        moved |= ARGS(pool, e)[i] != ARGS(pool, f->formals)[i];
    }
    if (total > 0 && f->arity > 1 && p->style != QDOT_PLAIN) {
        derivative_partial(p, e, total, moved, context);
        return;
    }
    if (total > 0 && p->style == QDOT_PLAIN && (!moved || f->arity > 1 || total > 3)) {
        derivative_plain(p, e, moved);
        return;
    }
    name(p, f->name);
    for (uint32_t i = 0; i < total && total <= 3; i++)
        say(p, styled(p, "'", "′", "'"));
    if (total > 3) {
        say(p, styled(p, "", "⁽", "^{("));
        piece(p, (struct piece){.order = total, .context = TERM});
        say(p, styled(p, "", "⁾", ")}"));
    }
    arguments(p, e, false);
}

/* --- conditions, vectors, matrices, lists --------------------------------------------------------- */

static void
open_relation(printer *p, qdot_expr e, int context)
{
    static const char *const plain[] = {" = ", " < ", " <= "};
    static const char *const unicode[] = {" = ", " < ", " ≤ "};
    static const char *const latex[] = {" = ", " < ", " \\le "};
    uint16_t op = NODE(p->pool, e)->op;

    if (context > TOP)
        open_bracket(p);
    child(p, ARGS(p->pool, e)[0], TERM);
    say(p, styled(p, plain[op], unicode[op], latex[op]));
    child(p, ARGS(p->pool, e)[1], TERM);
    if (context > TOP)
        close_bracket(p);
}

static void
open_logic(printer *p, qdot_expr e, int context)
{
    const qdot_node *node = NODE(p->pool, e);
    const char *word = node->op == QDOT_AND ? styled(p, " and ", " and ", " \\wedge ")
                                            : styled(p, " or ", " or ", " \\vee ");

    if (context > TOP)
        open_bracket(p);
    if (node->op == QDOT_NOT)
        say(p, styled(p, "not ", "not ", "\\neg "));
    for (uint32_t i = 0; i < node->n; i++) {
        qdot_expr part = ARGS(p->pool, e)[i];

        if (i > 0)
            say(p, word);
        child(p, part,
              NODE(p->pool, part)->kind == QDOT_LOGIC || node->op == QDOT_NOT ? TERM
                                                                              : TOP);
    }
    if (context > TOP)
        close_bracket(p);
}

static void
open_matrix(printer *p, qdot_expr e)
{
    const qdot_node *node = NODE(p->pool, e);

    say(p, styled(p, "[", "[", "\\begin{pmatrix}"));
    for (uint32_t i = 0; i < node->n; i++) {
        if (i > 0)
            say(p, i % node->op ? styled(p, ", ", ", ", " & ")
                                : styled(p, "; ", "; ", " \\\\ "));
        child(p, ARGS(p->pool, e)[i], TOP);
    }
    /* one row must not look like a list */
    say(p, styled(p, node->n == node->op ? ";]" : "]", "]", "\\end{pmatrix}"));
}

static void
open_node(printer *p, const struct piece *x)
{
    const qdot_pool *pool = p->pool;
    const qdot_node *node = NODE(pool, x->e);
    fmpq_t c;

    if (x->coefficient != QDOT_NIL) {
        open_scaled(p, x->coefficient, x->e, x->context, x->turned);
        return;
    }
    switch (node->kind) {
    case QDOT_NUM:
        fmpq_init(c);
        fmpq_set(c, RATIONAL(pool, x->e));
        if (x->context == MAGNITUDE)
            fmpq_abs(c, c);
        if (x->context == NUMERATOR) { /* the numerator alone */
            fmpz_abs(fmpq_numref(c), fmpq_numref(c));
            fmpz_one(fmpq_denref(c));
        }
        if (x->context == DENOMINATOR) { /* the denominator alone */
            fmpz_set(fmpq_numref(c), fmpq_denref(c));
            fmpz_one(fmpq_denref(c));
        }
        qdot_print_number(c, p->style, x->raised,
                          x->context >= FACTOR ? (x->context == BASE ? 2 : 1) : 0,
                          p->out);
        fmpq_clear(c);
        break;
    case QDOT_SYM: qdot_print_symbol(pool, x->e, p->style, p->out); break;
    case QDOT_SUM: open_sum(p, x->e, x->context, x->turned); break;
    case QDOT_PROD: open_scaled(p, ARGS(pool, x->e)[0], x->e, x->context, false); break;
    case QDOT_FUN: open_function(p, x->e); break;
    case QDOT_UFUN: open_ufun(p, x->e, x->context); break;
    case QDOT_REL: open_relation(p, x->e, x->context); break;
    case QDOT_LOGIC: open_logic(p, x->e, x->context); break;
    case QDOT_VEC:
        open_bracket(p);
        children(p, x->e, 0, node->n, ", ");
        close_bracket(p);
        break;
    case QDOT_LIST:
        say(p, styled(p, "[", "[", "\\left["));
        children(p, x->e, 0, node->n, ", ");
        say(p, styled(p, "]", "]", "\\right]"));
        break;
    default: open_matrix(p, x->e);
    }
}

/* What the text of x depends on beside its node. */
static uint32_t
how(const printer *p, const struct piece *x)
{
    return (uint32_t)(x->context - NUMERATOR) << 4 | (uint32_t)p->style << 2 |
           (uint32_t)x->raised << 1 | x->turned;
}

/* Sums, functions, spelled names are copied if they stand again, else kept when they end. */
static void
write_node(printer *p, struct piece x)
{
    uint8_t kind = NODE(p->pool, x.e)->kind;
    bool again = x.coefficient == QDOT_NIL &&
                 (kind == QDOT_SUM || kind == QDOT_FUN || kind == QDOT_UFUN ||
                  (kind == QDOT_SYM && p->style != QDOT_PLAIN));

    if (x.ends) {
        p->status = qdot_printed_keep(p->pool, x.e, how(p, &x), p->out, x.from);
    } else if (!again) {
        open_node(p, &x);
    } else if (!qdot_printed_copy(p->pool, x.e, how(p, &x), p->out)) {
        x.from = p->out->n;
        open_node(p, &x);
        x.ends = true;
        piece(p, x);
    }
}

qdot_status
qdot_print(const qdot_pool *pool, qdot_expr e, qdot_style style, qdot_text *out)
{
    printer p = {.pool = pool, .style = style, .out = out};

    if (e == QDOT_NIL)
        return qdot_fail(QDOT_EINVAL, "nothing to print");
    child(&p, e, TOP);
    while (p.status == QDOT_OK && (p.next.n > 0 || p.todo.n > 0)) {
        struct piece x;

        while (p.next.n > 0 && p.status == QDOT_OK)
            p.status = qdot_vec_push(&p.todo, p.next.at[--p.next.n]);
        if (p.status != QDOT_OK)
            break;
        x = p.todo.at[--p.todo.n];
        if (x.name)
            qdot_print_name(x.text, style, out);
        else if (x.text != NULL)
            qdot_text_add(out, x.text);
        else if (x.order > 0)
            qdot_print_order(x.order, style, x.context, out);
        else
            write_node(&p, x);
        if (p.status == QDOT_OK)
            p.status = qdot_interrupt_check();
    }
    qdot_free(p.todo.at);
    qdot_free(p.next.at);
    return p.status != QDOT_OK ? p.status : qdot_text_status(out);
}
