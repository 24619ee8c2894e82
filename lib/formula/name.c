/* name.c -- splits names into letters, digits and indices, and spells Greek letters. */
#include "formula/name.h"

#include <string.h>

static const struct {
    const char *spelled, *letter;
} greek[] = {
    {"alpha", "α"},  {"beta", "β"},   {"gamma", "γ"}, {"delta", "δ"},   {"epsilon", "ε"},
    {"zeta", "ζ"},   {"eta", "η"},    {"theta", "θ"}, {"iota", "ι"},    {"kappa", "κ"},
    {"lambda", "λ"}, {"mu", "μ"},     {"nu", "ν"},    {"xi", "ξ"},      {"pi", "π"},
    {"rho", "ρ"},    {"sigma", "σ"},  {"tau", "τ"},   {"upsilon", "υ"}, {"phi", "φ"},
    {"chi", "χ"},    {"psi", "ψ"},    {"omega", "ω"}, {"Gamma", "Γ"},   {"Delta", "Δ"},
    {"Upsilon", "Υ"},
    {"Theta", "Θ"},  {"Lambda", "Λ"}, {"Xi", "Ξ"},    {"Pi", "Π"},      {"Sigma", "Σ"},
    {"Phi", "Φ"},    {"Psi", "Ψ"},    {"Omega", "Ω"},
};

static const char *const subscript[] = {"₀", "₁", "₂", "₃", "₄", "₅", "₆", "₇", "₈", "₉"};

static bool
is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* A name in its parts: letters, the digits behind them, what stands behind `_`, an index in
 * brackets: theta1, omega_0, V_eff, A[1,2]. */
struct parts {
    const char *letter; /* a Greek letter, or NULL */
    bool greek;         /* the name consists of Greek letters only: theta, deltatheta */
    size_t letters, digits_at, digits, below_at, below, index_at, index;
};

/* The row of the Greek letter that `at` begins with and behind which Greek letters, or nothing,
 * stand; -1: there is none. Names are short. */
static int
match_greek_letter(const char *at, size_t length)
{
    enum { LONGEST = 64 };
    bool ends[LONGEST + 1] = {[0] = true}; /* ends[k]: the last k letters are Greek letters */

    if (length == 0 || length > LONGEST)
        return -1;
    for (size_t k = 1; k <= length; k++)
        for (size_t i = 0; i < sizeof greek / sizeof *greek; i++) {
            size_t n = strlen(greek[i].spelled);

            if (n > k || !ends[k - n] ||
                strncmp(at + length - k, greek[i].spelled, n) != 0)
                continue;
            if (k == length)
                return (int)i;
            ends[k] = true;
        }
    return -1;
}

static bool
is_greek(const char *at, size_t length)
{
    return match_greek_letter(at, length) >= 0;
}

/* Append the letters of a name as shown: unchanged, or Greek letters for their names if `all_greek`. */
static void
add_letters(const char *at, size_t length, bool all_greek, qdot_text *out)
{
    if (!all_greek) {
        qdot_text_add_n(out, at, length);
        return;
    }
    while (length > 0) {
        const int i = match_greek_letter(at, length);
        const size_t n = strlen(greek[i].spelled);

        qdot_text_add(out, greek[i].letter);
        at += n;
        length -= n;
    }
}

const char *
qdot_name_greek(const char *letter)
{
    for (size_t i = 0; i < sizeof greek / sizeof *greek; i++)
        if (strncmp(greek[i].letter, letter, 2) == 0)
            return greek[i].spelled;
    return NULL;
}

static struct parts
split_name(const char *name)
{
    struct parts p = {0};
    size_t n = strcspn(name, "["), head = strcspn(name, "_");

    if (head == 0 || head + 1 >= n)
        head = n;
    p.letters = head;
    while (p.letters > 1 && is_digit(name[p.letters - 1]))
        p.letters--;
    p.digits_at = p.letters;
    p.digits = head - p.letters;
    if (head < n) {
        p.below_at = head + 1;
        p.below = n - head - 1;
    }
    if (name[n] == '[') {
        p.index_at = n + 1;
        p.index = strlen(name) - n - 2;
    }
    for (size_t i = 0; i < sizeof greek / sizeof *greek; i++)
        if (strlen(greek[i].spelled) == p.letters &&
            strncmp(greek[i].spelled, name, p.letters) == 0)
            p.letter = greek[i].letter;
    p.greek = p.letter != NULL || is_greek(name, p.letters);
    return p;
}

static bool
has_only_digits(const char *text, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!is_digit(text[i]))
            return false;
    return n > 0;
}

static void
append_subscript_digits(const char *digits, size_t n, qdot_text *out)
{
    for (size_t i = 0; i < n; i++)
        qdot_text_add(out, subscript[digits[i] - '0']);
}

bool
qdot_name_index(const char *name, qdot_name_digits *index)
{
    const struct parts p = split_name(name);

    index->letters = p.letters;
    index->brackets = p.index > 0;
    index->at = name + (p.index > 0 ? p.index_at : p.below_at);
    index->n = p.index > 0 ? p.index : p.below;
    return p.digits == 0 && !(p.index > 0 && p.below > 0) && has_only_digits(index->at, index->n);
}

/* --- names of several letters ------------------------------------------------------------------ */

static bool
is_long_name(const qdot_formula *f, const qdot_formula_node *node)
{
    return node->kind == QDOT_FORMULA_TEXT && node->what == QDOT_TEXT_NAME && node->n > 1 &&
           qdot_name_greek(f->text.at + node->child) == NULL;
}

static const qdot_formula_node *
first_child(const qdot_formula *f, const qdot_formula_node *node)
{
    return qdot_formula_at(f, qdot_formula_at(f, node->child)->next);
}

bool
qdot_name_is_long_at_begin(const qdot_formula *f, const qdot_formula_node *node)
{
    while (node->child != 0 &&
           (node->kind == QDOT_FORMULA_POWER || node->kind == QDOT_FORMULA_INDEX || node->kind == QDOT_FORMULA_ACCENT ||
            node->kind == QDOT_FORMULA_PRIMES || node->kind == QDOT_FORMULA_ROW || node->kind == QDOT_FORMULA_SPAN))
        node = first_child(f, node);
    return is_long_name(f, node);
}

bool
qdot_name_is_long_at_end(const qdot_formula *f, const qdot_formula_node *node)
{
    return is_long_name(f, node->kind == QDOT_FORMULA_ACCENT ? first_child(f, node) : node);
}

/* --- names written in a line ------------------------------------------------------------------ */

/* A copy of the next part of a name, up to the sign `between`; moves *i past it. */
static char *
copy_next_part(const char *at, size_t length, char between, size_t *i)
{
    size_t n = *i;
    char *part;

    while (n < length && at[n] != between)
        n++;
    n -= *i;
    part = qdot_strndup(at + *i + (at[*i] == ' '), n - (at[*i] == ' '));
    *i += n + 1;
    return part;
}

static void
append_index_in_line(const char *at, size_t length, char between, qdot_text *out)
{
    for (size_t i = 0; i < length;) {
        const bool first = i == 0;
        char *part = copy_next_part(at, length, between, &i);

        if (part == NULL) {
            out->failed = true;
            return;
        }
        if (!first)
            qdot_text_char(out, between);
        if (has_only_digits(part, strlen(part)) || strchr(part, '[') != NULL)
            qdot_text_add(out, part); /* x[1,2] keeps its brackets */
        else
            qdot_name_line(part, 0, qdot_name_index(part, &(qdot_name_digits){0}), out);
        qdot_free(part);
    }
}

void
qdot_name_line(const char *name, uint32_t order, bool lowered, qdot_text *out)
{
    struct parts p = split_name(name);
    bool one = (p.letter != NULL || p.letters == 1) && (p.index == 0 || lowered);

    add_letters(name, p.letters, p.greek, out);
    if (one && (order == 1 || order == 2))
        qdot_text_add(out, order == 1 ? "\u0307" : "\u0308");
    append_subscript_digits(name + p.digits_at, p.digits, out);
    if (lowered) {
        append_subscript_digits(name + (p.index > 0 ? p.index_at : p.below_at),
                                p.index > 0 ? p.index : p.below, out);
    } else if (p.below > 0) {
        qdot_text_char(out, '_');
        append_index_in_line(name + p.below_at, p.below, '_', out);
    }
    if (!lowered && p.index > 0) {
        qdot_text_char(out, '[');
        append_index_in_line(name + p.index_at, p.index, ',', out);
        qdot_text_char(out, ']');
    }
    if (!one || order > 2)
        for (uint32_t i = 0; i < order; i++)
            qdot_text_add(out, "′");
}

/* --- names as drawn formulas ------------------------------------------------------------------ */

/* Append the parts of an index, letters and numbers, with commas between them. */
static void
append_drawn_index(qdot_formula *f, qdot_formula_id below, const char *at, size_t length, char between)
{
    for (size_t i = 0; i < length;) {
        const bool first = i == 0;
        char *part = copy_next_part(at, length, between, &i);

        if (part == NULL) {
            f->failed = true;
            return;
        }
        if (!first)
            qdot_formula_add_sign(f, below, QDOT_SIGN_COMMA_BELOW);
        if (has_only_digits(part, strlen(part)))
            qdot_formula_add_text(f, below, QDOT_TEXT_NUMBER, part, strlen(part));
        else
            qdot_formula_add_name(f, below, part, 0);
        qdot_free(part);
    }
}

void
qdot_formula_add_name(qdot_formula *f, qdot_formula_id parent, const char *name, uint32_t order)
{
    const struct parts p = split_name(name);
    qdot_formula_id base, below;
    size_t from;

    if (p.digits + p.below + p.index > 0)
        parent = qdot_formula_add(f, parent, QDOT_FORMULA_INDEX, 0, 0);
    base = parent;
    if (order > 0) {
        base = qdot_formula_add(f, parent, QDOT_FORMULA_ACCENT, 0, 0);
        qdot_formula_count(f, base, order);
    }
    from = f->text.n;
    add_letters(name, p.letters, p.greek, &f->text);
    qdot_formula_add_tail(f, base, QDOT_TEXT_NAME, from);
    if (p.digits + p.below + p.index == 0)
        return;
    below = qdot_formula_add(f, parent, QDOT_FORMULA_ROW, 0, 0);
    if (p.digits > 0) {
        qdot_formula_add_text(f, below, QDOT_TEXT_NUMBER, name + p.digits_at, p.digits);
        if (p.below + p.index > 0)
            qdot_formula_add_sign(f, below, QDOT_SIGN_COMMA_BELOW);
    }
    append_drawn_index(f, below, name + p.below_at, p.below, '_');
    if (p.below > 0 && p.index > 0)
        qdot_formula_add_sign(f, below, QDOT_SIGN_COMMA_BELOW);
    append_drawn_index(f, below, name + p.index_at, p.index, ',');
}
