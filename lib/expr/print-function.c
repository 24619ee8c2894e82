/* print-function.c -- elementary and undefined functions, and their derivatives, as text. */
#include "expr/print-parts.h"

/* if(C, A, if(D, B, E)) as A if C, B if D, E otherwise. */
static void
cases(printer *p, qdot_expr e, int context)
{
    const qdot_pool *pool = p->pool;

    if (context >= BASE)
        open_bracket(p);
    print_text(p, styled(p, "", "", "\\begin{cases} ",
                         "<mrow><mo>{</mo><mtable columnalign=\"left\"><mtr><mtd>"));
    for (;; e = ARGS(pool, e)[2]) {
        bool more = NODE(pool, e)->kind == QDOT_FUN && NODE(pool, e)->op == QDOT_IF;

        child(p, more ? ARGS(pool, e)[1] : e, TOP);
        print_text(p, more ? styled(p, "", "", " & \\text{if } ",
                                    "</mtd><mtd><mtext>if&#xA0;</mtext>")
                    : styled(p, "", "", " & \\text{otherwise}",
                             "</mtd><mtd><mtext>otherwise</mtext>"));
        if (!more)
            break;
        child(p, ARGS(pool, e)[0], TOP);
        print_text(p, styled(p, "", "", " \\\\ ", "</mtd></mtr><mtr><mtd>"));
    }
    print_text(p, styled(p, "", "", " \\end{cases}", "</mtd></mtr></mtable></mrow>"));
    if (context >= BASE)
        print_close_bracket(p);
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
        print_text(p, id == QDOT_ABS ? styled(p, "", "", "\\left|", "<mrow><mo>|</mo>")
                              : styled(p, "", "", "\\left\\lfloor ", "<mrow><mo>⌊</mo>"));
        child(p, ARGS(p->pool, e)[0], TOP);
        print_text(p, id == QDOT_ABS
                   ? styled(p, "", "", "\\right|", "<mo>|</mo></mrow>")
                   : styled(p, "", "", "\\right\\rfloor ", "<mo>⌋</mo></mrow>"));
        return;
    }
    if (p->style == QDOT_LATEX && qdot_print_latex_word(id) != NULL) {
        print_text(p, qdot_print_latex_word(id));
    } else {
        print_text(p, styled(p, "", "", "\\operatorname{", "<mi>"));
        print_text(p, qdot_fun_name(id));
        print_text(p, styled(p, "", "", "}", "</mi><mo>&#x2061;</mo>"));
    }
    open_bracket(p);
    children(p, e, 0, NODE(p->pool, e)->n, comma(p));
    print_close_bracket(p);
}

/* --- undefined functions ------------------------------------------------------------------------ */

/* (s, t): the arguments, or the declared ones. */
static void
print_arguments(printer *p, qdot_expr e, bool declared)
{
    const qdot_ufun *f = &p->pool->ufuns.at[NODE(p->pool, e)->op];

    print_text(p, styled(p, "(", "(", "(", "<mo>&#x2061;</mo><mrow><mo>(</mo>"));
    children(p, declared ? f->formals : e, 0, f->arity, comma(p));
    print_text(p, styled(p, ")", ")", ")", "<mo>)</mo></mrow>"));
}

static uint32_t
derivative_order(const qdot_pool *pool, qdot_expr e, uint32_t i)
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
        print_text(p, "subs(");
    for (uint32_t i = 0; i < n; i++)
        if (derivative_order(pool, e, i) > 0)
            print_text(p, "diff(");
    print_name_text(p, f->name);
    print_arguments(p, e, true);
    for (uint32_t i = 0; i < n; i++) {
        if (derivative_order(pool, e, i) == 0)
            continue;
        print_text(p, ", ");
        child(p, ARGS(pool, f->formals)[i], TOP);
        if (derivative_order(pool, e, i) > 1) {
            print_text(p, ", ");
            child(p, ARGS(pool, e)[n + i], TOP);
        }
        print_text(p, ")");
    }
    if (!moved)
        return;
    for (uint32_t i = 0; i < n; i++) {
        if (ARGS(pool, e)[i] == ARGS(pool, f->formals)[i])
            continue;
        print_text(p, ", ");
        child(p, ARGS(pool, f->formals)[i], TOP);
        print_text(p, " = ");
        child(p, ARGS(pool, e)[i], TOP);
    }
    print_text(p, ")");
}

/* The order above `before`, which stands there: ∂², \\partial^{2}. */
static void
with_order(printer *p, const char *before, qdot_expr e, uint32_t order)
{
    bool raise = p->style == QDOT_MATHML && order > 1;

    print_text(p, raise ? "<msup>" : "");
    print_text(p, before);
    if (e != QDOT_NIL)
        child(p, e, TOP);
    print_text(p, raise ? "<mn>" : "");
    piece(p, (struct piece){.order = order, .context = raise ? TERM : TOP});
    print_text(p, raise ? "</mn></msup>" : "");
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
    print_text(p, styled(p, "", "", "\\frac{", "<mfrac><mrow>"));
    with_order(p, styled(p, "", "", "\\partial", "<mo>∂</mo>"), QDOT_NIL, total);
    print_text(p, styled(p, "", "", " ", ""));
    print_name_text(p, f->name);
    print_text(p, styled(p, "", "", "}{", "</mrow><mrow>"));
    for (uint32_t i = 0; i < f->arity; i++) {
        if (derivative_order(pool, e, i) == 0)
            continue;
        print_text(p, styled(p, "", "", first ? "\\partial " : " \\partial ", "<mo>∂</mo>"));
        with_order(p, "", ARGS(pool, f->formals)[i], derivative_order(pool, e, i));
        first = false;
    }
    print_text(p, styled(p, "", "", "}", "</mrow></mfrac>"));
    if (bracket)
        print_close_bracket(p);
    if (moved)
        print_arguments(p, e, false);
}

void
qdot_print_ufun(printer *p, qdot_expr e, int context)
{
    const qdot_pool *pool = p->pool;
    const qdot_ufun *f = &pool->ufuns.at[NODE(pool, e)->op];
    uint32_t total = 0;
    bool moved = false;

    for (uint32_t i = 0; i < f->arity; i++) {
        total += derivative_order(pool, e, i);
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
    print_text(p, styled(p, "", "", "", total > 0 ? "<msup><mrow>" : ""));
    print_name_text(p, f->name);
    print_text(p, styled(p, "", "", "", total > 0 ? "</mrow><mo>" : ""));
    for (uint32_t i = 0; i < total && total <= 3; i++)
        print_text(p, styled(p, "'", "′", "'", "′"));
    if (total > 3) {
        print_text(p, styled(p, "", "⁽", "^{(", "("));
        piece(p, (struct piece){.order = total, .context = TERM});
        print_text(p, styled(p, "", "⁾", ")}", ")"));
    }
    print_text(p, styled(p, "", "", "", total > 0 ? "</mo></msup>" : ""));
    print_arguments(p, e, false);
}
