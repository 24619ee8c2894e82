/* notation.c -- reads textbook formulas such as d/dt dL/dq' from the texts of answers, and writes them. */
#include "lang/answer/notation.h"

#include <ctype.h>
#include <string.h>

#include "formula/write.h"

typedef struct {
    qdot_formula *f;
    qdot_notation_kind notation;
} writer;

typedef struct {
    const char *plain;
    qdot_formula_sign sign;
} spelling;

static const spelling signs[] = {
    {" = ", QDOT_SIGN_EQUALS}, {" + ", QDOT_SIGN_PLUS}, {" - ", QDOT_SIGN_MINUS},
    {"-", QDOT_SIGN_NEGATIVE}, {".", QDOT_SIGN_POINT},  {", ", QDOT_SIGN_COMMA},
    {" ", QDOT_SIGN_BESIDE},
};

static const spelling words[] = {{"sum", QDOT_SIGN_SUM},
                                 {"delta", QDOT_SIGN_DELTA},
                                 {"left", QDOT_SIGN_LEFT},
                                 {"right", QDOT_SIGN_RIGHT}};

static const struct {
    const char *plain, *letter;
} greek[] = {{"lambda", "λ"}, {"omega", "ω"}};

#define COUNT(table) (sizeof(table) / sizeof *(table))

static bool
text_begins_with(const char *at, const char *word)
{
    return strncmp(at, word, strlen(word)) == 0;
}

static const spelling *
find_spelling(const spelling *table, size_t count, const char *at)
{
    for (size_t i = 0; i < count; i++)
        if (text_begins_with(at, table[i].plain))
            return &table[i];
    return NULL;
}

static void
add_name(const writer *w, qdot_formula_id parent, const char *name)
{
    qdot_formula_add_text(w->f, parent, QDOT_TEXT_NAME, name, strlen(name));
}

static void
add_number(const writer *w, qdot_formula_id parent, const char *number)
{
    qdot_formula_add_text(w->f, parent, QDOT_TEXT_NUMBER, number, strlen(number));
}

static void
add_one_half(const writer *w, qdot_formula_id parent)
{
    if (w->notation != QDOT_NOTATION_DRAWN) {
        add_number(w, parent, "½");
        return;
    }
    parent = qdot_formula_add(w->f, parent, QDOT_FORMULA_FRACTION, 0, QDOT_FORMULA_SMALL);
    add_number(w, parent, "1");
    add_number(w, parent, "2");
}

/* Append a letter with `dots` dots above it (a time derivative). */
static void
add_letter(const writer *w, qdot_formula_id parent, char letter, size_t dots)
{
    static const char *const marks[] = {"", "\u0307", "\u0308"};
    char name[8] = {letter};

    if (w->notation != QDOT_NOTATION_DRAWN) {
        strcat(name, marks[dots]);
    } else if (dots > 0) {
        parent = qdot_formula_add(w->f, parent, QDOT_FORMULA_ACCENT, 0, 0);
        qdot_formula_count(w->f, parent, (uint32_t)dots);
    }
    add_name(w, parent, name);
}

/* Append one letter or word of the notation; returns the text after it. */
static const char *
add_letter_or_word(const writer *w, qdot_formula_id parent, const char *at)
{
    const spelling *word = find_spelling(words, COUNT(words), at);
    size_t primes;

    if (word != NULL) {
        qdot_formula_add_sign(w->f, parent, word->sign);
        return at + strlen(word->plain);
    }
    if (text_begins_with(at, "1/2")) {
        add_one_half(w, parent);
        return at + 3;
    }
    if (*at == '0') {
        add_number(w, parent, "0");
        return at + 1;
    }
    for (size_t i = 0; i < COUNT(greek); i++)
        if (text_begins_with(at, greek[i].plain)) {
            add_name(w, parent, greek[i].letter);
            qdot_formula_add_sign(w->f, parent, QDOT_SIGN_BLANK);
            return at + strlen(greek[i].plain);
        }
    primes = strspn(at + 1, "'");
    add_letter(w, parent, *at, primes <= 2 ? primes : 0);
    return at + 1 + primes;
}

/* Append a letter or word, with `^2` as a superscript if it follows. */
static const char *
add_letter_with_power(const writer *w, qdot_formula_id parent, const char *at)
{
    const qdot_formula_id base = qdot_formula_new(w->f, QDOT_FORMULA_SPAN, 0, 0);

    at = add_letter_or_word(w, base, at);
    if (!text_begins_with(at, "^2")) {
        qdot_formula_append(w->f, parent, base);
        return at;
    }
    parent =
        qdot_formula_add(w->f, parent, QDOT_FORMULA_POWER, 0,
                         w->notation == QDOT_NOTATION_LINE ? QDOT_FORMULA_RAISED : 0);
    qdot_formula_append(w->f, parent, base);
    add_number(w, parent, "2");
    return at + 2;
}

/* Begin the numerator or denominator of a derivative with d (whole: a total derivative) or the partial sign. */
static qdot_formula_id
begin_derivative_side(const writer *w, qdot_formula_id fraction, bool whole)
{
    const qdot_formula_id row = qdot_formula_add(w->f, fraction, QDOT_FORMULA_ROW, 0, 0);

    if (whole) {
        add_name(w, row, "d");
    } else {
        qdot_formula_add_sign(w->f, row, QDOT_SIGN_PARTIAL);
        qdot_formula_add_sign(w->f, row, QDOT_SIGN_BLANK);
    }
    return row;
}

/* Append a derivative dV/dq or dT/dq', with partial signs, or d/dt; returns the text after it. */
static const char *
add_derivative(const writer *w, qdot_formula_id parent, const char *at)
{
    const qdot_formula_id fraction =
        qdot_formula_add(w->f, parent, QDOT_FORMULA_FRACTION, 0, 0);
    const bool whole = at[1] == '/';
    const qdot_formula_id up = begin_derivative_side(w, fraction, whole);

    if (!whole)
        (void)add_letter_or_word(w, up, at + 1);
    return add_letter_or_word(w, begin_derivative_side(w, fraction, whole), at + (whole ? 3 : 4));
}

/* Whether a derivative `dX/dY` or `d/dt` begins at this place of the text. */
static bool
is_derivative(const char *at)
{
    return at[0] == 'd' && (text_begins_with(at + 1, "/d") ||
                            (isalpha((unsigned char)at[1]) && text_begins_with(at + 2, "/d")));
}

void
qdot_notation_add(qdot_formula *f, qdot_formula_id parent, const char *formula,
                  qdot_notation_kind notation)
{
    const qdot_formula_id all = parent;
    const writer w = {f, notation};

    if (notation == QDOT_NOTATION_SCRIPT) {
        add_name(&w, parent, formula);
        return;
    }
    while (*formula != '\0') {
        const spelling *sign = find_spelling(signs, COUNT(signs), formula);

        if (*formula == '(') {
            parent = qdot_formula_add(f, all, QDOT_FORMULA_BRACKET, QDOT_BRACKET_ROUND,
                                      QDOT_FORMULA_FIXED);
            formula++;
        } else if (*formula == ')') {
            parent = all;
            formula++;
        } else if (sign != NULL) {
            qdot_formula_add_sign(f, parent, sign->sign);
            formula += strlen(sign->plain);
        } else {
            formula = is_derivative(formula) ? add_derivative(&w, parent, formula)
                                        : add_letter_with_power(&w, parent, formula);
        }
    }
}

void
qdot_notation_print(const char *formula, qdot_notation_kind notation, qdot_text *out)
{
    qdot_formula f = {0};
    const qdot_formula_id all = qdot_formula_new(&f, QDOT_FORMULA_SPAN, 0, 0);

    qdot_notation_add(&f, all, formula, notation);
    if (qdot_formula_status(&f) != QDOT_OK ||
        qdot_formula_write_line(&f, all, notation, out) != QDOT_OK)
        out->failed = true;
    qdot_formula_clear(&f);
}
