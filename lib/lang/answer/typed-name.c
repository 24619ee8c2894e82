/* typed-name.c -- names of answers, as they were typed, in the letters of formulas.
 *
 * A name goes word by word: `eom[theta1]` is eom[θ₁], `diff(T, theta')` is diff(T, θ̇): what is declared is written as in
 * formulas, words of the language stay. It is what was typed, not an expression any more.
 */
#include "lang/answer/typed-name.h"

#include <ctype.h>
#include <string.h>

#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/session/names.h"

typedef struct {
    qdot_session *session;
    qdot_style style;
    const char *at, *start;
    qdot_text *out;
    char closing[32]; /* for each open bracket the character that closes it */
    size_t depth;
} writer;

static bool
is_letter(char c)
{
    return isalpha((unsigned char)c) || c == '_';
}

static const char *
choose_by_style(const writer *w, const char *unicode, const char *latex)
{
    return w->style == QDOT_UNICODE ? unicode : latex;
}

/* What books call a value of the language in LaTeX: its letter where that is not declared, so that M is not both a mass
 * and the mass matrix. NULL: nothing else. */
static const char *
latex_symbol_of_quantity(const writer *w, const char *word)
{
    static const struct {
        const char *word, *symbol;
    } known[] = {{"mass_matrix", "M"},       {"momenta", "p"},     {"forces", "Q"},
                 {"kinetic", "T"},           {"potential_energy", "V"}, {"lagrange_function", "L"},
                 {"hamiltonian", "H"},       {"routhian", "R"}};

    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(word, known[i].word) == 0 && qdot_names_find(w->session->names, known[i].symbol) == NULL)
            return known[i].symbol;
    return NULL;
}

/* Append a word in upright letters for LaTeX; several words, as virtual_work, become text with blanks. */
static void
add_upright(qdot_text *out, const char *word, bool called)
{
    const bool several = strchr(word, '_') != NULL;

    qdot_text_add(out, called ? "\\operatorname{" : several ? "\\text{" : "\\mathrm{");
    qdot_text_add(out, called && several ? "\\text{" : "");
    for (; *word != '\0'; word++)
        qdot_text_char(out, *word == '_' ? ' ' : *word);
    qdot_text_add(out, called && several ? "}}" : "}");
}

/* Append a word that the user has not declared: a function or constant of the language. */
static void
append_undeclared_word(writer *w, const char *word, bool called)
{
    static const char *const known[] = {"sin", "cos",  "tan",  "sec",  "csc",
                                        "cot", "sinh", "cosh", "tanh", "exp",
                                        "log", "min",  "max",  "pi"};
    static const struct {
        const char *word, *sign;
    } joining[] = {{"and", "\\wedge"}, {"or", "\\vee"}, {"not", "\\neg"}};

    const char *symbol = w->style == QDOT_LATEX ? latex_symbol_of_quantity(w, word) : NULL;

    if (w->style == QDOT_UNICODE || strlen(word) == 1 || symbol != NULL) {
        qdot_text_add(w->out, symbol != NULL ? symbol : word);
        return;
    }
    for (size_t i = 0; i < sizeof joining / sizeof *joining; i++)
        if (strcmp(word, joining[i].word) == 0) {
            qdot_text_add(w->out, joining[i].sign);
            return;
        }
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(word, known[i]) == 0) {
            qdot_text_format(w->out, "\\%s", word);
            return;
        }
    add_upright(w->out, word, called);
}

/* The length of an index `[1,2]` at this place of the text; 0 if there is none. */
static size_t
length_of_index(const char *at)
{
    size_t n = *at == '[' ? 1 + strspn(at + 1, "0123456789, ") : 0;

    return n > 1 && at[n] == ']' ? n + 1 : 0;
}

/* The declared name that begins with `word` at w->at, including an index such as x[1]. */
static const qdot_name *
find_declared_name(const writer *w, const char *word, size_t *index)
{
    qdot_text spelled = {0};
    const qdot_name *name = NULL;
    size_t n = length_of_index(w->at);

    *index = 0;
    if (n > 0) {
        qdot_text_add(&spelled, word);
        for (size_t i = 0; i < n; i++)
            if (w->at[i] != ' ')
                qdot_text_char(&spelled, w->at[i]);
        if (qdot_text_status(&spelled) == QDOT_OK)
            name = qdot_names_find(w->session->names, qdot_text_str(&spelled));
        qdot_text_clear(&spelled);
        if (name != NULL) {
            *index = n;
            return name;
        }
    }
    return qdot_names_find(w->session->names, word);
}

static qdot_status
word(writer *w)
{
    qdot_pool *pool = w->session->pool;
    size_t n = 0, index, primes;
    const qdot_name *name;
    qdot_status status = QDOT_OK;
    char *text;

    while (is_letter(w->at[n]) || isdigit((unsigned char)w->at[n]))
        n++;
    text = qdot_strndup(w->at, n);
    if (text == NULL)
        return QDOT_ENOMEM;
    w->at += n;
    name = find_declared_name(w, text, &index);
    primes = strspn(w->at + index, "'");
    if (name == NULL && text[0] == 'd') { /* a derivative as dT/dtheta' */
        const qdot_name *q = find_declared_name(w, text + 1, &index);

        if (q != NULL && q->kind == QDOT_NAME_COORD) {
            qdot_text_char(w->out, 'd');
            name = q;
            primes = strspn(w->at + index, "'");
        }
    }
    if (name == NULL) {
        append_undeclared_word(w, text, *w->at == '(');
    } else if (name->kind == QDOT_NAME_COORD) {
        qdot_expr jet = qdot_symbol_jet(pool, name->value, (uint32_t)primes);

        status = jet == QDOT_NIL ? qdot_pool_check(pool)
                                 : qdot_print(pool, jet, w->style, w->out);
        w->at += index + primes;
    } else {
        qdot_print_name(w->session->pool, name->name, w->style, w->out);
        w->at += index;
    }
    qdot_free(text);
    return status;
}

/* Write `[`; after a word or a bracket it begins an index, which LaTeX sets as a subscript. */
static void
write_opening_bracket(writer *w)
{
    bool index =
        w->at > w->start && (is_letter(w->at[-1]) || isdigit((unsigned char)w->at[-1]) ||
                             w->at[-1] == ')' || w->at[-1] == ']');
    bool below = *w->at == '[' && index && w->style == QDOT_LATEX;

    if (w->depth < sizeof w->closing)
        w->closing[w->depth++] = below ? '}' : *w->at == '[' ? ']' : ')';
    if (below)
        qdot_text_add(w->out, "_{");
    else if (w->style == QDOT_LATEX)
        qdot_text_format(w->out, "\\left%c", *w->at);
    else
        qdot_text_char(w->out, *w->at);
    w->at++;
}

static void
write_closing_bracket(writer *w)
{
    char closing = w->depth > 0 ? w->closing[--w->depth] : *w->at;

    if (w->style == QDOT_LATEX && closing != '}')
        qdot_text_add(w->out, "\\right");
    qdot_text_char(w->out, closing);
    w->at++;
}

/* Write ^2 as ² or ^{2}; other exponents keep the sign ^. */
static void
write_power(writer *w)
{
    static const char *const superscript[] = {"⁰", "¹", "²", "³", "⁴",
                                              "⁵", "⁶", "⁷", "⁸", "⁹"};
    size_t n = strspn(w->at + 1, "0123456789");

    w->at++;
    if (w->style == QDOT_LATEX && *w->at == '(' && w->depth < sizeof w->closing) {
        w->closing[w->depth++] = '}'; /* x^(1/3): the brackets become LaTeX braces */
        qdot_text_add(w->out, "^{");
        w->at++;
        return;
    }
    if (n == 0 || w->at[n] == '.') {
        qdot_text_char(w->out, '^');
        return;
    }
    qdot_text_add(w->out, choose_by_style(w, "", "^{"));
    for (; n > 0; n--, w->at++)
        if (w->style == QDOT_UNICODE)
            qdot_text_add(w->out, superscript[*w->at - '0']);
        else
            qdot_text_char(w->out, *w->at);
    qdot_text_add(w->out, choose_by_style(w, "", "}"));
}

static qdot_status
write_next_token(writer *w)
{
    static const struct {
        const char *plain, *unicode, *latex;
    } words[] = {{"<=", "≤", "\\le "}, {">=", "≥", "\\ge "}, {"*", "\u202F", " "}, {"==", "=", "="},
                 {"-", "−", "-"},      {"'", "′", "'"},      {"%", "%", "\\%"}};

    if (is_letter(*w->at))
        return word(w);
    if (*w->at == '^') {
        write_power(w);
        return QDOT_OK;
    }
    if (*w->at == '(' || *w->at == '[') {
        write_opening_bracket(w);
        return QDOT_OK;
    }
    if (*w->at == ')' || *w->at == ']') {
        write_closing_bracket(w);
        return QDOT_OK;
    }
    if (*w->at == '*' && strchr("0123456789.", w->at[1]) != NULL) {
        qdot_text_add(w->out, choose_by_style(w, "·", " \\cdot "));
        w->at++;
        return QDOT_OK;
    }
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        size_t n = strlen(words[i].plain);

        if (strncmp(w->at, words[i].plain, n) == 0) {
            qdot_text_add(w->out, choose_by_style(w, words[i].unicode, words[i].latex));
            w->at += n;
            return QDOT_OK;
        }
    }
    qdot_text_char(w->out, *w->at++);
    return QDOT_OK;
}

qdot_status
qdot_typed_name_print(qdot_session *session, const char *name, qdot_style style, qdot_text *out)
{
    writer w = {.session = session,
                .style = style == QDOT_LATEX ? QDOT_LATEX : QDOT_UNICODE,
                .at = name,
                .start = name,
                .out = out};
    qdot_status status = QDOT_OK;

    if (style == QDOT_PLAIN || strchr(name, '"') != NULL) {
        qdot_text_add(out, name);
        return qdot_text_status(out);
    }
    while (*w.at != '\0' && status == QDOT_OK)
        status = write_next_token(&w);
    return status == QDOT_OK ? qdot_text_status(out) : status;
}

qdot_status
qdot_typed_name_add(qdot_session *session, const char *name, qdot_style style, qdot_formula *f,
                    qdot_formula_id parent, unsigned flags)
{
    const size_t from = f->nodes.n;
    qdot_text text = {0};
    qdot_status status = qdot_typed_name_print(session, name, style, &text);

    if (status == QDOT_OK && style == QDOT_LATEX)
        qdot_formula_add_latex(f, parent, qdot_text_str(&text), text.n);
    else if (status == QDOT_OK)
        qdot_formula_add_text(f, parent, QDOT_TEXT_WORDS, qdot_text_str(&text), text.n);
    for (size_t i = from; i < f->nodes.n; i++)
        f->nodes.at[i].flags |= (uint8_t)flags;
    f->failed = f->failed || text.failed;
    qdot_text_clear(&text);
    return status == QDOT_OK ? qdot_formula_status(f) : status;
}
