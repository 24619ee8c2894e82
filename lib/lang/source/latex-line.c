/* latex-line.c -- translates a line of LaTeX into our language, for a hint. */
#include "lang/source/latex-line.h"

#include <ctype.h>
#include <string.h>

enum { DEEPEST = 20 };

typedef struct {
    const char *at, *to;
    int depth;
} reader;

static void sequence(reader *r, char closer, qdot_text *out);

static void
skip_blanks(reader *r)
{
    while (r->at < r->to && strchr(" \t~", *r->at) != NULL)
        r->at++;
}

static bool
is_word_char(char c)
{
    return isalnum((unsigned char)c) || c == '.' || (c & 0x80) != 0;
}

/* Translate the argument at r: a group in braces, or a single letter, digit or command. */
static void
argument(reader *r, qdot_text *out)
{
    skip_blanks(r);
    if (r->at < r->to && *r->at == '{') {
        r->at++;
        sequence(r, '}', out);
    } else if (r->at < r->to && *r->at == '\\') {
        reader one = {r->at, r->at + 1, r->depth};

        while (one.to < r->to && isalpha((unsigned char)*one.to))
            one.to++;
        r->at = one.to;
        sequence(&one, '\0', out);
    } else if (r->at < r->to) {
        qdot_text_char(out, *r->at++);
    }
}

/* Translate the argument, in brackets unless it is a single name or number. */
static void
add_factor(reader *r, qdot_text *out)
{
    qdot_text text = {0};
    bool simple = true;

    argument(r, &text);
    for (size_t i = 0; i < text.n; i++)
        simple = simple &&
                 (is_word_char(text.at[i]) || text.at[i] == '\'' || text.at[i] == '_');
    qdot_text_format(out, simple ? "%s" : "(%s)", qdot_text_str(&text));
    qdot_text_clear(&text);
}

/* Translate the argument of a function without brackets, as in \sin\theta. */
static void
add_call(reader *r, const char *name, qdot_text *out)
{
    qdot_text text = {0};

    skip_blanks(r);
    while (strncmp(r->at, "\\left", 5) == 0)
        r->at += 5;
    qdot_text_add(out, name);
    if (r->at < r->to && *r->at == '(')
        return;
    if (r->at < r->to && *r->at == '^') { /* an exponent before the argument: \sin^2 x */
        r->at++;
        argument(r, &text);
    }
    skip_blanks(r);
    if (r->at < r->to && *r->at == '(') {
        r->at++;
        qdot_text_char(out, '(');
        sequence(r, ')', out);
    } else {
        qdot_text_char(out, '(');
        argument(r, out);
    }
    qdot_text_char(out, ')');
    if (text.n > 0)
        qdot_text_format(out, "^%s", qdot_text_str(&text));
    qdot_text_clear(&text);
}

/* Whether the n letters are one of the words, which are separated by blanks. */
static bool
is_among(const char *name, size_t n, const char *words)
{
    for (const char *w = words; *w != '\0'; w += strcspn(w, " "), w += *w == ' ')
        if (strcspn(w, " ") == n && strncmp(w, name, n) == 0)
            return true;
    return false;
}

/* Translate the command at r, after its backslash. Returns whether it is an operand. */
static bool
command(reader *r, bool operand, qdot_text *out)
{
    const char *name = r->at;
    size_t n = 0;
    char word[16];

    while (name + n < r->to && isalpha((unsigned char)name[n]))
        n++;
    r->at += n > 0 ? n : r->at < r->to;
    if (n == 0 || n >= sizeof word ||
        is_among(name, n,
                 "left right quad qquad mathrm mathbf text displaystyle big Big"))
        return operand;
    memcpy(word, name, n);
    word[n] = '\0';
    if (is_among(name, n, "cdot times")) {
        qdot_text_char(out, '*');
        return false;
    }
    qdot_text_add(out, operand ? "*" : "");
    if (strcmp(word, "frac") == 0 || strcmp(word, "dfrac") == 0 ||
        strcmp(word, "tfrac") == 0) {
        add_factor(r, out);
        qdot_text_char(out, '/');
        add_factor(r, out);
    } else if (strcmp(word, "dot") == 0 || strcmp(word, "ddot") == 0) {
        add_factor(r, out);
        qdot_text_add(out, n == 3 ? "'" : "''");
    } else if (strcmp(word, "sqrt") == 0) {
        qdot_text_add(out, "sqrt(");
        argument(r, out);
        qdot_text_char(out, ')');
    } else if (is_among(name, n,
                        "sin cos tan sec csc cot sinh cosh tanh exp log ln arcsin arccos "
                        "arctan")) {
        add_call(r, strcmp(word, "ln") == 0 ? "log" : word, out);
    } else {
        qdot_text_add(out, strncmp(word, "var", 3) == 0 ? word + 3 : word);
    }
    return true;
}

/* Translate one letter or sign that begins no command; returns whether an operand ends with it. */
static bool
translate_sign(reader *r, bool operand, qdot_text *out)
{
    const char c = *r->at++;

    if (c == '^') {
        qdot_text_char(out, c);
        add_factor(r, out);
        return true;
    }
    if (c == '_') {
        qdot_text_char(out, c);
        argument(r, out);
        return true;
    }
    if (c == '(' || c == '[' || c == '{') {
        qdot_text_add(out, operand ? "*" : "");
        qdot_text_char(out, c == '{' ? '(' : c);
        sequence(r, c == '(' ? ')' : c == '[' ? ']' : '}', out);
        qdot_text_char(out, c == '[' ? ']' : ')');
        return true;
    }
    if (strchr("=+-<>,", c) != NULL && operand)
        qdot_text_format(out, c == ',' ? "%c " : " %c ", c);
    else if (c != '$' && c != '&' && c != '}')
        qdot_text_char(out, c);
    return c == '\'' || c == ')' || c == ']';
}

static void
sequence(reader *r, char closer, qdot_text *out)
{
    bool operand = false;

    if (++r->depth > DEEPEST)
        r->at = r->to;
    for (skip_blanks(r); r->at < r->to && *r->at != closer; skip_blanks(r)) {
        if (*r->at == '\\') {
            r->at++;
            operand = command(r, operand, out);
        } else if (is_word_char(*r->at)) {
            qdot_text_add(out, operand ? "*" : "");
            while (r->at < r->to && is_word_char(*r->at))
                qdot_text_char(out, *r->at++);
            operand = true;
        } else {
            operand = translate_sign(r, operand, out);
        }
    }
    r->at += r->at < r->to;
    r->depth--;
}

void
qdot_latex_line(const char *from, const char *to, qdot_text *out)
{
    reader r = {from, to, 0};

    while (r.at < r.to)
        sequence(&r, '\0', out);
}
