/* print-function.c -- elementary and undefined functions, and their derivatives, as text. */
#include "expr/print-parts.h"

/* if(C, A, if(D, B, E)) as A if C, B if D, E otherwise. */
static void
cases(printer *p, qdot_expr e, int context)
{
    const qdot_pool *pool = p->pool;

    if (context >= BASE)
        open_bracket(p);
    say(p, styled(p, "", "", "\\begin{cases} ",
                  "<mrow><mo>{</mo><mtable columnalign=\"left\"><mtr><mtd>"));
    for (;; e = ARGS(pool, e)[2]) {
        bool more = NODE(pool, e)->kind == QDOT_FUN && NODE(pool, e)->op == QDOT_IF;

        child(p, more ? ARGS(pool, e)[1] : e, TOP);
        say(p, more ? styled(p, "", "", " & \\text{if } ",
                             "</mtd><mtd><mtext>if&#xA0;</mtext>")
                    : styled(p, "", "", " & \\text{otherwise}",
                             "</mtd><mtd><mtext>otherwise</mtext>"));
        if (!more)
            break;
        child(p, ARGS(pool, e)[0], TOP);
        say(p, styled(p, "", "", " \\\\ ", "</mtd></mtr><mtr><mtd>"));
    }
    say(p, styled(p, "", "", " \\end{cases}", "</mtd></mtr></mtable></mrow>"));
    if (context >= BASE)
        close_bracket(p);
}

void
qdot_print_function(printer *p, qdot_expr e, int context)
{
    qdot_fun_id id = NODE(p->pool, e)->op;

    if (is_drawn(p) && id == QDOT_IF) {
        cases(p, e, context);
        return;
    }

    if (is_drawn(p) && (id == QDOT_ABS || id == QDOT_FLOOR)) {
        say(p, id == QDOT_ABS ? styled(p, "", "", "\\left|", "<mrow><mo>|</mo>")
                              : styled(p, "", "", "\\left\\lfloor ", "<mrow><mo>⌊</mo>"));
        child(p, ARGS(p->pool, e)[0], TOP);
        say(p, id == QDOT_ABS
                   ? styled(p, "", "", "\\right|", "<mo>|</mo></mrow>")
                   : styled(p, "", "", "\\right\\rfloor ", "<mo>⌋</mo></mrow>"));
        return;
    }
    if (p->style == QDOT_LATEX && qdot_print_latex_word(id) != NULL) {
        say(p, qdot_print_latex_word(id));
    } else {
        say(p, styled(p, "", "", "\\operatorname{", "<mi>"));
        say(p, qdot_fun_name(id));
        say(p, styled(p, "", "", "}", "</mi><mo>&#x2061;</mo>"));
    }
    open_bracket(p);
    children(p, e, 0, NODE(p->pool, e)->n, comma(p));
    close_bracket(p);
}

/* --- undefined functions ------------------------------------------------------------------------ */

/* (s, t): the arguments, or the declared ones. */
static void
arguments(printer *p, qdot_expr e, bool declared)
{
    const qdot_ufun *f = &p->pool->ufuns.at[NODE(p->pool, e)->op];

    say(p, styled(p, "(", "(", "(", "<mo>&#x2061;</mo><mrow><mo>(</mo>"));
    children(p, declared ? f->formals : e, 0, f->arity, comma(p));
    say(p, styled(p, ")", ")", ")", "<mo>)</mo></mrow>"));
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

/* The order above `before`, which stands there: ∂², \\partial^{2}. */
static void
with_order(printer *p, const char *before, qdot_expr e, uint32_t order)
{
    bool raise = p->style == QDOT_MATHML && order > 1;

    say(p, raise ? "<msup>" : "");
    say(p, before);
    if (e != QDOT_NIL)
        child(p, e, TOP);
    say(p, raise ? "<mn>" : "");
    piece(p, (struct piece){.order = order, .context = raise ? TERM : TOP});
    say(p, raise ? "</mn></msup>" : "");
}

/* \frac{\partial^{2} x}{\partial s \partial t}, where that is drawn; at other arguments these
 * behind it. */
static void
derivative_partial(printer *p, qdot_expr e, uint32_t total, bool moved, int context)
{
    const qdot_pool *pool = p->pool;
    const qdot_ufun *f = &pool->ufuns.at[NODE(pool, e)->op];
    bool bracket = !moved && context >= BASE, first = true;

    if (bracket)
        open_bracket(p);
    say(p, styled(p, "", "", "\\frac{", "<mfrac><mrow>"));
    with_order(p, styled(p, "", "", "\\partial", "<mo>∂</mo>"), QDOT_NIL, total);
    say(p, styled(p, "", "", " ", ""));
    name(p, f->name);
    say(p, styled(p, "", "", "}{", "</mrow><mrow>"));
    for (uint32_t i = 0; i < f->arity; i++) {
        if (order_of(pool, e, i) == 0)
            continue;
        say(p, styled(p, "", "", first ? "\\partial " : " \\partial ", "<mo>∂</mo>"));
        with_order(p, "", ARGS(pool, f->formals)[i], order_of(pool, e, i));
        first = false;
    }
    say(p, styled(p, "", "", "}", "</mrow></mfrac>"));
    if (bracket)
        close_bracket(p);
    if (moved)
        arguments(p, e, false);
}

void
qdot_print_ufun(printer *p, qdot_expr e, int context)
{
    const qdot_pool *pool = p->pool;
    const qdot_ufun *f = &pool->ufuns.at[NODE(pool, e)->op];
    uint32_t total = 0;
    bool moved = false;

    for (uint32_t i = 0; i < f->arity; i++) {
        total += order_of(pool, e, i);
        moved |= ARGS(pool, e)[i] != ARGS(pool, f->formals)[i];
    }
    if (total > 0 && f->arity > 1 && is_drawn(p)) {
        derivative_partial(p, e, total, moved, context);
        return;
    }
    if (total > 0 && !is_drawn(p) &&
        (f->arity > 1 || (p->style == QDOT_PLAIN && (!moved || total > 3)))) {
        derivative_plain(p, e, moved);
        return;
    }
    say(p, styled(p, "", "", "", total > 0 ? "<msup><mrow>" : ""));
    name(p, f->name);
    say(p, styled(p, "", "", "", total > 0 ? "</mrow><mo>" : ""));
    for (uint32_t i = 0; i < total && total <= 3; i++)
        say(p, styled(p, "'", "′", "'", "′"));
    if (total > 3) {
        say(p, styled(p, "", "⁽", "^{(", "("));
        piece(p, (struct piece){.order = total, .context = TERM});
        say(p, styled(p, "", "⁾", ")}", ")"));
    }
    say(p, styled(p, "", "", "", total > 0 ? "</mo></msup>" : ""));
    arguments(p, e, false);
}
