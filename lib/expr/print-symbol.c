/* print-symbol.c -- prints names and symbols. */
#include "formula/name.h"

#include <stdio.h>
#include <string.h>

#include "expr/print-formula.h"
#include "expr/print-parts.h"
#include "expr/unit.h"

static bool
is_name_with_index_known(const qdot_pool *pool, const char *name, size_t letters, const char *pattern,
                         const char *digits, size_t n_digits)
{
    qdot_text other = {0};
    bool is;

    qdot_text_add_n(&other, name, letters);
    qdot_text_format(&other, pattern, (int)n_digits, digits);
    is = qdot_text_status(&other) != QDOT_OK ||
         qdot_symbol_is_known(pool, qdot_text_str(&other));
    qdot_text_clear(&other);
    return is;
}

/* Whether x[1], x_1 may stand as x₁, which is else x1, else x[1]: no name that comes before is
 * there. */
static bool
may_print_index_lowered(const qdot_pool *pool, const char *name)
{
    qdot_name_digits d;

    return qdot_name_index(name, &d) &&
           (pool == NULL ||
            (!is_name_with_index_known(pool, name, d.letters, "%.*s", d.at, d.n) &&
             (d.brackets || !is_name_with_index_known(pool, name, d.letters, "[%.*s]", d.at, d.n))));
}

/* Append a name with dots or primes to a node of the formula. */
static void
add_symbol_name(qdot_formula *f, qdot_formula_id parent, const qdot_pool *pool, const char *name, uint32_t order,
         qdot_notation_kind notation)
{
    const size_t from = f->text.n;

    if (notation == QDOT_NOTATION_DRAWN) {
        qdot_formula_add_name(f, parent, name, order);
        return;
    }
    if (notation == QDOT_NOTATION_SCRIPT)
        qdot_text_add(&f->text, name);
    else
        qdot_name_line(name, order, may_print_index_lowered(pool, name), &f->text);
    qdot_formula_add_tail(f, parent, QDOT_TEXT_NAME, from);
}

void
qdot_print_spelled(printer *p, const char *name)
{
    add_symbol_name(p->out, p->at, p->pool, name, 0, p->notation);
}

void
qdot_print_name(const qdot_pool *pool, const char *name, qdot_style style, qdot_text *out)
{
    qdot_formula f = {0};
    qdot_formula_id all;

    if (style == QDOT_PLAIN) {
        qdot_text_add(out, name);
        return;
    }
    if (style == QDOT_UNICODE) {
        qdot_name_line(name, 0, may_print_index_lowered(pool, name), out);
        return;
    }
    all = qdot_formula_new(&f, QDOT_FORMULA_SPAN, 0, 0);
    qdot_formula_add_name(&f, all, name, 0);
    if (qdot_formula_status(&f) != QDOT_OK || qdot_print_written(&f, all, style, out) != QDOT_OK)
        out->failed = true;
    qdot_formula_clear(&f);
}

/* --- printing symbols ------------------------------------------------------------------------- */

/* The end of the digits in the name of a symbol that represents a number; NULL for other symbols. */
static const char *
end_of_number_digits(const qdot_symbol *s)
{
    return s->class == QDOT_FORMAL ? strchr(s->name, '#') : NULL;
}

bool
qdot_symbol_is_number(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_kind(pool, e) == QDOT_SYM && end_of_number_digits(qdot_expr_symbol(pool, e)) != NULL;
}

/* Print the digits of a number, in a drawn formula with its power of ten: 1.5 10^-9. */
static void
print_number_digits(printer *p, const char *name, size_t length)
{
    const char *power = is_drawn(p) ? memchr(name, 'e', length) : NULL;
    const size_t digits = power != NULL ? (size_t)(power - name) : length;
    qdot_formula_id raised;

    qdot_formula_add_text(p->out, p->at, QDOT_TEXT_NUMBER, name, digits);
    if (power == NULL)
        return;
    power += power[1] == '+' ? 2 : 1;
    print_sign(p, QDOT_SIGN_POINT);
    raised = qdot_formula_add(p->out, p->at, QDOT_FORMULA_POWER, 0, 0);
    qdot_formula_add_text(p->out, raised, QDOT_TEXT_NUMBER, "10", 2);
    qdot_formula_add_text(p->out, raised, QDOT_TEXT_NUMBER, power, length - (size_t)(power - name));
}

/* A symbol that stands for a number, such as `-1.5e-9#3`: what stands before the #, in brackets where it has a sign or
 * would stand beside another number without a sign between. */
static void
print_number_symbol(printer *p, const char *name, size_t length)
{
    const qdot_formula_id outer = p->at;

    if (p->notation != QDOT_NOTATION_SCRIPT || *name == '-')
        print_begin(p, QDOT_FORMULA_BRACKET, QDOT_BRACKET_ROUND, QDOT_FORMULA_FIXED);
    print_number_digits(p, name, length);
    p->at = outer;
}

/* A name without the primes at its end, which are added to *order: a coordinate may stand for a derivative, and a momentum
 * belong to one. */
static const char *
without_primes(const char *name, qdot_text *room, uint32_t *order)
{
    size_t n = strlen(name);

    for (; n > 0 && name[n - 1] == '\''; n--)
        ++*order;
    if (name[n] == '\0')
        return name;
    qdot_text_add_n(room, name, n);
    return qdot_text_str(room);
}

/* Print a symbol derived from a coordinate q, or from its derivative with so many primes: p with q as index, dq, or delta q. */
static void
print_coordinate_symbol(printer *p, const qdot_symbol *s, const char *name, uint32_t primes)
{
    const bool momentum = s->class == QDOT_MOMENTUM;
    const qdot_formula_id outer = p->at;

    if (!is_drawn(p)) {
        const size_t from = p->out->text.n;

        qdot_text_add(&p->out->text, momentum ? "p[" : s->class == QDOT_DELTA ? "δ" : "d");
        qdot_name_line(name, momentum ? primes : s->order, may_print_index_lowered(p->pool, name), &p->out->text);
        qdot_text_add(&p->out->text, momentum ? "]" : "");
        for (uint32_t i = 0; momentum && i < s->order; i++)
            qdot_text_char(&p->out->text, '\'');
        qdot_formula_add_tail(p->out, p->at, QDOT_TEXT_NAME, from);
        return;
    }
    print_begin(p, momentum ? QDOT_FORMULA_INDEX : QDOT_FORMULA_ROW, 0, 0);
    if (s->class == QDOT_DELTA)
        print_sign(p, QDOT_SIGN_DELTA);
    else if (momentum)
        qdot_formula_add_name(p->out, p->at, "p", s->order);
    else
        qdot_print_text(p, "d");
    add_symbol_name(p->out, p->at, p->pool, name, momentum ? primes : s->order, p->notation);
    p->at = outer;
}

/* The differentials of a LIST of coordinates: wedge(dr, dphi) in a line, with the sign of the product where it is drawn. */
static void
print_wedge(printer *p, qdot_expr list)
{
    const qdot_formula_id outer = p->at;

    if (is_drawn(p))
        print_begin(p, QDOT_FORMULA_ROW, 0, 0);
    else
        qdot_print_text(p, "wedge(");
    for (uint32_t i = 0; i < qdot_expr_count(p->pool, list); i++) {
        const char *name = qdot_expr_symbol(p->pool, qdot_expr_arg(p->pool, list, i))->name;

        if (i > 0)
            print_sign(p, is_drawn(p) ? QDOT_SIGN_WEDGE : QDOT_SIGN_COMMA);
        qdot_print_text(p, "d");
        add_symbol_name(p->out, p->at, p->pool, name, 0, p->notation);
    }
    if (!is_drawn(p))
        qdot_print_text(p, ")");
    p->at = outer;
}

void
qdot_print_symbol_parts(printer *p, qdot_expr e)
{
    const qdot_symbol *s = qdot_expr_symbol(p->pool, e);
    const qdot_symbol *base = s->base != QDOT_NIL ? qdot_expr_symbol(p->pool, s->base) : NULL;
    const char *mark = end_of_number_digits(s);
    const char *name = base != NULL ? base->name : s->name;
    qdot_text room = {0};
    uint32_t primes = 0;

    if (s->class == QDOT_COORD || s->class == QDOT_MOMENTUM)
        name = without_primes(name, &room, &primes);
    if (qdot_unit_symbol_base(p->pool, e) >= 0)
        qdot_print_scaled(p, QDOT_ONE, e, TOP, false);
    else if (s->class == QDOT_BOUND)
        qdot_print_bound(p, e);
    else if (s->class == QDOT_INFINITE && is_drawn(p))
        print_sign(p, QDOT_SIGN_INFINITY);
    else if (s->class == QDOT_WORDS)
        qdot_formula_add_text(p->out, p->at, QDOT_TEXT_WORDS, s->name, strlen(s->name));
    else if (mark != NULL)
        print_number_symbol(p, s->name, (size_t)(mark - s->name));
    else if (p->notation == QDOT_NOTATION_SCRIPT)
        qdot_print_text(p, s->name);
    else if (s->base != QDOT_NIL && base == NULL)
        print_wedge(p, s->base);
    else if (s->class == QDOT_MOMENTUM || s->class == QDOT_DIFFERENTIAL || s->class == QDOT_DELTA)
        print_coordinate_symbol(p, s, name, primes);
    else
        add_symbol_name(p->out, p->at, p->pool, name, s->order + primes, p->notation);
    qdot_text_clear(&room);
}
