/* read.c -- reads a typed formula from left to right, with a stack of the brackets that are open. */
#include "formula/read.h"

#include <ctype.h>
#include <string.h>

#include "base/utf8.h"
#include "formula/name.h"

/* What becomes of an open bracket and its contents when it is closed. */
typedef enum { WHOLE, ROUND, SQUARE, BARS, CALL, ROOT } group_kind; /* WHOLE: all of the text */

/* The text between two brackets: a row of terms, each a product of factors. The last factor waits for an exponent, for
 * primes; the last product waits for a `/`, which makes it a numerator. */
typedef struct {
    group_kind kind;
    qdot_formula_id row, product, over, factor; /* over: a fraction that has no denominator yet; 0: none */
    qdot_formula_id head, power; /* the function of a CALL; the power whose exponent the group is, 0: it is none */
} group;

typedef struct {
    qdot_formula *f;
    qdot_notation_kind notation;
    const char *at;
    qdot_vec(group) groups;
} reader;

typedef struct {
    const char *typed;
    qdot_formula_sign sign;
} spelling;

/* The signs as they are typed; of two that begin alike the longer one stands first. */
static const spelling signs[] = {
    {"+", QDOT_SIGN_PLUS},  {"-", QDOT_SIGN_MINUS},    {"==", QDOT_SIGN_EQUALS},  {"=", QDOT_SIGN_EQUALS},
    {"!=", QDOT_SIGN_UNEQUAL}, {"<=", QDOT_SIGN_AT_MOST}, {">=", QDOT_SIGN_AT_LEAST}, {"<", QDOT_SIGN_LESS},
    {">", QDOT_SIGN_GREATER}, {",", QDOT_SIGN_COMMA},
};

static const spelling words[] = {{"and", QDOT_SIGN_AND},
                                 {"or", QDOT_SIGN_OR},
                                 {"vs", QDOT_SIGN_VERSUS},
                                 {"in", QDOT_SIGN_IN}};

static const char *const superscript[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};

enum { DIGITS = 10 };

static group *
innermost_group(reader *r)
{
    return r->groups.at + r->groups.n - 1;
}

/* The value of the superscript digit at this place, which has *n bytes; -1: there is none. */
static int
superscript_digit_value(const char *at, size_t *n)
{
    for (int i = 0; i < DIGITS; i++) {
        *n = strlen(superscript[i]);
        if (strncmp(at, superscript[i], *n) == 0)
            return i;
    }
    return -1;
}

static bool
is_digit(char c)
{
    return isdigit((unsigned char)c) != 0;
}

static bool
begins_name(const char *at)
{
    size_t n;

    return isalpha((unsigned char)*at) || *at == '_' ||
           ((unsigned char)*at >= 0x80 && strncmp(at, "√", strlen("√")) != 0 && superscript_digit_value(at, &n) < 0);
}

static bool
may_continue_name(const char *at)
{
    return begins_name(at) || is_digit(*at);
}

/* The end of an index such as `[1,2]`, which begins at `open`; NULL if it is not closed. */
static const char *
find_end_of_index(const char *open)
{
    int depth = 0;

    for (const char *c = open; *c != '\0'; c++) {
        depth += (*c == '[' || *c == '(') - (*c == ']' || *c == ')');
        if (depth == 0)
            return c + 1;
    }
    return NULL;
}

/* --- joining what was read ---------------------------------------------------------------- */

/* Remove the round brackets of an operand of a fraction, or of an exponent, if the formula is drawn and needs none. */
static qdot_formula_id
drop_round_brackets(const reader *r, qdot_formula_id id)
{
    qdot_formula_node *node = r->f->nodes.at + id;

    if (id != 0 && r->notation == QDOT_NOTATION_DRAWN && node->kind == QDOT_FORMULA_BRACKET &&
        node->what == QDOT_BRACKET_ROUND)
        *node = (qdot_formula_node){.kind = QDOT_FORMULA_ROW, .next = node->next, .child = node->child};
    return id;
}

/* Finish the last factor of a product: no power or prime can follow it any more. */
static void
finish_factor(reader *r)
{
    group *g = innermost_group(r);

    if (g->factor == 0)
        return;
    if (g->over != 0) {
        qdot_formula_append(r->f, g->over, drop_round_brackets(r, g->factor));
        g->factor = g->over;
        g->over = 0;
    }
    if (g->product == 0)
        g->product = qdot_formula_new(r->f, QDOT_FORMULA_SPAN, 0, 0);
    qdot_formula_append(r->f, g->product, g->factor);
    g->factor = 0;
}

static void
finish_term(reader *r)
{
    group *g = innermost_group(r);

    finish_factor(r);
    if (g->over != 0) { /* nothing stands after `a/`, so the denominator is empty */
        g->factor = qdot_formula_new(r->f, QDOT_FORMULA_ROW, 0, 0);
        finish_factor(r);
    }
    qdot_formula_append(r->f, g->row, g->product);
    g->product = 0;
}

/* Add a factor to the product; power (not 0): add it instead to that node, as a power's exponent or under a root. */
static void
append_factor(reader *r, qdot_formula_id id, qdot_formula_id power)
{
    if (power != 0) {
        qdot_formula_append(r->f, power, drop_round_brackets(r, id));
        return;
    }
    finish_factor(r);
    innermost_group(r)->factor = id;
}

static qdot_formula_id
make_text_node(const reader *r, qdot_formula_role role, const char *text, size_t n)
{
    return qdot_formula_add_text(r->f, 0, role, text, n);
}

/* Read a character that has no meaning in a formula: it is shown as it was typed. */
static void
read_other_character(reader *r, size_t n)
{
    append_factor(r, make_text_node(r, strchr(".:;", *r->at) != NULL ? QDOT_TEXT_WORDS : QDOT_TEXT_LABEL, r->at, n), 0);
    r->at += n;
}

static void
open_group(reader *r, group_kind kind, qdot_formula_id head, qdot_formula_id power)
{
    const qdot_formula_kind as = kind == ROOT ? QDOT_FORMULA_ROOT : QDOT_FORMULA_BRACKET;
    const unsigned shape = kind == SQUARE ? QDOT_BRACKET_SQUARE
                           : kind == BARS ? QDOT_BRACKET_BARS
                                          : QDOT_BRACKET_ROUND;

    if (power == 0)
        finish_factor(r);
    if (qdot_vec_push(&r->groups, ((group){.kind = kind,
                                           .row = qdot_formula_new(r->f, as, kind == ROOT ? 0 : shape, 0),
                                           .head = head,
                                           .power = power})) != QDOT_OK)
        r->f->failed = true;
    r->at++;
}

static void
close_group(reader *r)
{
    group g;
    qdot_formula_id id;

    finish_term(r);
    g = *innermost_group(r);
    id = g.row;
    r->groups.n--;
    if (g.kind == CALL) {
        id = qdot_formula_new(r->f, QDOT_FORMULA_APPLY, 0, 0);
        qdot_formula_append(r->f, id, g.head);
        qdot_formula_append(r->f, id, g.row);
    }
    append_factor(r, id, g.power);
}

/* --- names and numbers -------------------------------------------------------------------- */

static qdot_formula_id
make_name_node(const reader *r, const char *name, uint32_t order)
{
    const qdot_formula_id all = qdot_formula_new(r->f, QDOT_FORMULA_SPAN, 0, 0);
    const size_t from = r->f->text.n;

    if (r->notation == QDOT_NOTATION_DRAWN) {
        qdot_formula_add_name(r->f, all, name, order);
    } else {
        qdot_name_line(name, order, qdot_name_index(name, &(qdot_name_digits){0}), &r->f->text);
        qdot_formula_add_tail(r->f, all, QDOT_TEXT_NAME, from);
    }
    qdot_formula_unwrap(r->f, all);
    return all;
}

/* Whether a name before a bracket is that of a function, which is no letter of a formula: atan2, but not f1. */
static bool
is_function_name(const char *name, size_t n)
{
    qdot_text shown = {0};
    bool is;

    qdot_name_line(name, 0, false, &shown);
    is = n > 1 && memchr(name, '_', n) == NULL && isalpha((unsigned char)name[1]) &&
         strncmp(qdot_text_str(&shown), name, 2) == 0;
    qdot_text_clear(&shown);
    return is;
}

/* Read a name with its index and its primes, and the opening bracket if it is the name of a function. */
static void
read_name(reader *r, qdot_formula_id power)
{
    const char *start = r->at, *end;
    uint32_t order = 0;
    size_t n;
    char *name;

    while (may_continue_name(r->at))
        r->at++;
    n = (size_t)(r->at - start);
    if (strncmp(start, "sqrt(", n + 1) == 0 || strncmp(start, "abs(", n + 1) == 0) {
        open_group(r, *start == 's' ? ROOT : BARS, 0, power);
        return;
    }
    end = *r->at == '[' ? find_end_of_index(r->at) : NULL;
    r->at = end != NULL ? end : r->at;
    name = qdot_strndup(start, (size_t)(r->at - start));
    for (; *r->at == '\''; r->at++)
        order++;
    if (name == NULL)
        r->f->failed = true;
    else if (*r->at != '(')
        append_factor(r, make_name_node(r, name, order), power);
    else
        open_group(r, CALL, end == NULL && order == 0 && is_function_name(name, n)
                                ? make_text_node(r, QDOT_TEXT_FUNCTION, name, n)
                                : make_name_node(r, name, order), power);
    qdot_free(name);
}

/* Show the product sign as a dot before a minus or a number: a*-b would look like a difference, 2*3 like one number. */
static void
show_product_dot(reader *r)
{
    const qdot_formula_id product = innermost_group(r)->product;
    qdot_formula_node *last = r->f->nodes.at + (product != 0 ? r->f->nodes.at[product].child : 0);

    if (product != 0 && last->kind == QDOT_FORMULA_SIGN && last->what == QDOT_SIGN_TIMES)
        last->what = QDOT_SIGN_DOT;
}

/* Read a number; 1e-9 is drawn as 10^-9, 2e5 as 2 10^5. */
static void
read_number(reader *r, qdot_formula_id power)
{
    const char *start = r->at, *end;
    qdot_formula_id all, raised, exponent;
    size_t n;

    if (power == 0) {
        finish_factor(r);
        show_product_dot(r);
    }
    while (is_digit(*r->at) || *r->at == '.')
        r->at++;
    n = (size_t)(r->at - start);
    end = r->at + (*r->at == 'e' || *r->at == 'E');
    end += end > r->at && (*end == '-' || *end == '+');
    if (end == r->at || !is_digit(*end)) {
        append_factor(r, make_text_node(r, QDOT_TEXT_NUMBER, start, n), power);
        return;
    }
    for (r->at = end; is_digit(*r->at);)
        r->at++;
    if (r->notation != QDOT_NOTATION_DRAWN) {
        append_factor(r, make_text_node(r, QDOT_TEXT_NUMBER, start, (size_t)(r->at - start)), power);
        return;
    }
    all = qdot_formula_new(r->f, QDOT_FORMULA_SPAN, 0, 0);
    if (n != 1 || *start != '1') {
        qdot_formula_add_text(r->f, all, QDOT_TEXT_NUMBER, start, n);
        qdot_formula_add_sign(r->f, all, QDOT_SIGN_POINT);
    }
    raised = qdot_formula_add(r->f, all, QDOT_FORMULA_POWER, 0, 0);
    qdot_formula_add_text(r->f, raised, QDOT_TEXT_NUMBER, "10", 2);
    exponent = qdot_formula_add(r->f, raised, QDOT_FORMULA_SPAN, 0, 0);
    if (end[-1] == '-')
        qdot_formula_add_sign(r->f, exponent, QDOT_SIGN_NEGATIVE);
    qdot_formula_add_text(r->f, exponent, QDOT_TEXT_NUMBER, end, (size_t)(r->at - end));
    append_factor(r, all, power);
}

/* Read a name, a number or a bracket, as the exponent of `power` if that is a node (not 0). False: none of these is here. */
static bool
read_factor(reader *r, qdot_formula_id power)
{
    if (begins_name(r->at))
        read_name(r, power);
    else if (is_digit(*r->at))
        read_number(r, power);
    else if (*r->at == '(')
        open_group(r, ROUND, 0, power);
    else if (*r->at == '[' && power == 0)
        open_group(r, SQUARE, 0, 0);
    else
        return false;
    return true;
}

/* --- signs -------------------------------------------------------------------------------- */

/* The exponent of the last factor, within which a further `^` is read, as a^b^c is a^(b^c); 0: it has none. */
static qdot_formula_id
find_last_exponent(reader *r)
{
    qdot_formula_id id = innermost_group(r)->factor, exponent = 0;

    for (;;) {
        qdot_formula_node *node = r->f->nodes.at + id;
        const bool negative = exponent != 0 && node->kind == QDOT_FORMULA_SPAN && node->child != 0 &&
                              r->f->nodes.at[r->f->nodes.at[node->child].next].kind == QDOT_FORMULA_SIGN;

        if (node->kind != QDOT_FORMULA_POWER && !negative)
            return exponent;
        node->flags &= (uint8_t)~QDOT_FORMULA_RAISED;
        id = exponent = node->child;
    }
}

/* Make the last factor, or its exponent, the base of a power that has no exponent yet. */
static qdot_formula_id
begin_power(reader *r)
{
    const qdot_formula_id exponent = find_last_exponent(r);
    const qdot_formula_id power = exponent != 0 ? exponent : qdot_formula_new(r->f, QDOT_FORMULA_POWER, 0, 0);
    qdot_formula_id base = innermost_group(r)->factor;

    if (exponent == 0) {
        innermost_group(r)->factor = power;
    } else {
        base = qdot_formula_new(r->f, QDOT_FORMULA_ROW, 0, 0);
        qdot_formula_share(r->f, base, exponent);
        if (base == 0)
            return 0;
        if (r->f->nodes.at[base].kind == QDOT_FORMULA_ROW) { /* the brackets of the base were removed, as it was an exponent */
            r->f->nodes.at[base].kind = QDOT_FORMULA_BRACKET;
            r->f->nodes.at[base].what = QDOT_BRACKET_ROUND;
        }
        r->f->nodes.at[power] =
            (qdot_formula_node){.kind = QDOT_FORMULA_POWER, .next = r->f->nodes.at[power].next};
    }
    qdot_formula_append(r->f, power, base);
    return power;
}

/* Read `^` and the exponent after it. */
static void
read_power(reader *r)
{
    const bool negative = r->at[1] == '-';
    const char *digits = r->at + 1 + negative;
    const bool follows = begins_name(digits) || is_digit(*digits) || *digits == '(';
    qdot_formula_id power, exponent;

    if (innermost_group(r)->factor == 0 || !follows) {
        read_other_character(r, 1);
        return;
    }
    power = begin_power(r);
    r->at = digits;
    while (is_digit(*digits))
        digits++;
    if (power != 0 && r->notation == QDOT_NOTATION_LINE && !negative && digits > r->at && *digits != '.')
        r->f->nodes.at[power].flags |= QDOT_FORMULA_RAISED;
    exponent = negative ? qdot_formula_add(r->f, power, QDOT_FORMULA_SPAN, 0, 0) : power;
    if (negative)
        qdot_formula_add_sign(r->f, exponent, QDOT_SIGN_NEGATIVE);
    read_factor(r, exponent);
}

/* Read √ and the factor that follows it, as in √2; sqrt(x) is read as a name. */
static bool
read_root(reader *r)
{
    const size_t n = strlen("√");
    const bool is = strncmp(r->at, "√", n) == 0 && (begins_name(r->at + n) || is_digit(r->at[n]));

    if (is) {
        finish_factor(r);
        r->at += n;
        innermost_group(r)->factor = qdot_formula_new(r->f, QDOT_FORMULA_ROOT, 0,
                                                      r->notation == QDOT_NOTATION_LINE ? QDOT_FORMULA_BARE : 0);
        read_factor(r, innermost_group(r)->factor);
    }
    return is;
}

/* Read superscript digits, such as the exponent of sin²(x). */
static bool
read_superscript_digits(reader *r)
{
    const size_t from = r->f->text.n;
    qdot_formula_id power;
    size_t n;
    int digit = superscript_digit_value(r->at, &n);

    if (digit < 0 || innermost_group(r)->factor == 0)
        return false;
    power = begin_power(r);
    if (power != 0 && r->notation == QDOT_NOTATION_LINE)
        r->f->nodes.at[power].flags |= QDOT_FORMULA_RAISED;
    for (; digit >= 0; digit = superscript_digit_value(r->at, &n)) {
        qdot_text_char(&r->f->text, (char)('0' + digit));
        r->at += n;
    }
    qdot_formula_add_tail(r->f, power, QDOT_TEXT_NUMBER, from);
    return true;
}

static void
skip_blanks(reader *r)
{
    while (*r->at == ' ')
        r->at++;
}

static void
read_add_sign(reader *r, qdot_formula_sign sign, size_t n)
{
    finish_term(r);
    qdot_formula_add_sign(r->f, innermost_group(r)->row, sign);
    r->at += n;
    skip_blanks(r);
}

/* Read a sign: + and -, a relation, a comma. */
static bool
read_sign(reader *r)
{
    const group *g = innermost_group(r);

    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++) {
        const size_t n = strlen(signs[i].typed);

        if (strncmp(r->at, signs[i].typed, n) != 0)
            continue;
        if (signs[i].sign == QDOT_SIGN_MINUS && g->factor == 0) {
            show_product_dot(r);
            qdot_formula_add_sign(r->f, g->product != 0 ? g->product : g->row, QDOT_SIGN_NEGATIVE);
            r->at++;
        } else {
            read_add_sign(r, signs[i].sign, n);
        }
        return true;
    }
    return false;
}

/* Read blanks. Before a sign they are dropped; the word after them may be a sign, as `vs`. */
static void
read_blank(reader *r)
{
    skip_blanks(r);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        const size_t n = strlen(words[i].typed);

        if (strncmp(r->at, words[i].typed, n) == 0 && r->at[n] == ' ') {
            read_add_sign(r, words[i].sign, n);
            return;
        }
    }
    if (*r->at == '\0' || strchr("+-=!<>*/)],", *r->at) == NULL)
        read_add_sign(r, QDOT_SIGN_BESIDE, 0);
}

/* Read `*` or `/` between two factors. */
static bool
read_product(reader *r)
{
    group *g = innermost_group(r);
    qdot_formula_id above;

    if ((*r->at != '*' && *r->at != '/') || g->factor == 0)
        return false;
    finish_factor(r);
    if (*r->at == '*') {
        qdot_formula_add_sign(r->f, g->product, QDOT_SIGN_TIMES);
    } else {
        above = g->product;
        if (above != 0 && !r->f->failed) {
            qdot_formula_node *node = r->f->nodes.at + above;

            node->kind = QDOT_FORMULA_ROW;
            if (r->f->nodes.at[node->child].next == node->child)
                above = drop_round_brackets(r, node->child);
        }
        g->over = qdot_formula_new(r->f, QDOT_FORMULA_FRACTION, 0, 0);
        qdot_formula_append(r->f, g->over, above);
        g->product = 0;
    }
    r->at++;
    skip_blanks(r);
    return true;
}

static void
read_primes(reader *r)
{
    const qdot_formula_id id = qdot_formula_new(r->f, QDOT_FORMULA_PRIMES, 0, 0);
    uint32_t n = 0;

    for (; *r->at == '\''; r->at++)
        n++;
    qdot_formula_append(r->f, id, innermost_group(r)->factor);
    qdot_formula_count(r->f, id, n);
    innermost_group(r)->factor = id;
}

static void
read_next_element(reader *r)
{
    if (*r->at == ')' || *r->at == ']') {
        close_group(r);
        r->at++;
    } else if (*r->at == ' ')
        read_blank(r);
    else if (*r->at == '^')
        read_power(r);
    else if (*r->at == '\'' && innermost_group(r)->factor != 0)
        read_primes(r);
    else if (!read_factor(r, 0) && !read_root(r) && !read_superscript_digits(r) && !read_product(r) && !read_sign(r))
        read_other_character(r, qdot_utf8_length(r->at) > 1 ? qdot_utf8_length(r->at) : 1);
}

/* Whether every bracket in the typed formula is closed by a bracket of its kind. */
static bool
is_balanced(const char *typed)
{
    qdot_text open = {0};
    bool is = true;

    for (const char *c = typed; *c != '\0' && is; c++) {
        if (*c == '(' || *c == '[')
            qdot_text_char(&open, *c == '(' ? ')' : ']');
        if (*c != ')' && *c != ']')
            continue;
        is = open.n > 0 && open.at[open.n - 1] == *c;
        qdot_text_truncate(&open, open.n - is);
    }
    is = is && open.n == 0 && !open.failed;
    qdot_text_clear(&open);
    return is;
}

void
qdot_formula_read(qdot_formula *f, qdot_formula_id parent, const char *typed, qdot_notation_kind notation)
{
    reader r = {.f = f, .notation = notation, .at = typed};

    if (!is_balanced(typed)) {
        qdot_formula_add_text(f, parent, QDOT_TEXT_LABEL, typed, strlen(typed));
        return;
    }
    if (qdot_vec_push(&r.groups, ((group){.kind = WHOLE, .row = parent})) != QDOT_OK) {
        f->failed = true;
        return;
    }
    while (*r.at != '\0' && !f->failed)
        read_next_element(&r);
    if (!f->failed)
        finish_term(&r);
    qdot_free(r.groups.at);
}
