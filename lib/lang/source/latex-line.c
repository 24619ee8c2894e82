/* latex-line.c -- translates a line of LaTeX into the language of the program, for a hint. */
#include "lang/source/latex-line.h"

#include <ctype.h>
#include <string.h>

enum { DEEPEST = 20 };

typedef struct {
    const char *at, *to;
    int depth;
} reader;

static void translate_sequence(reader *r, char closer, qdot_text *out);

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

/* Translate a LaTeX argument: a group in braces, or a single letter, digit or command. */
static void
translate_argument(reader *r, qdot_text *out)
{
    skip_blanks(r);
    if (r->at < r->to && *r->at == '{') {
        r->at++;
        translate_sequence(r, '}', out);
    } else if (r->at < r->to && *r->at == '\\') {
        reader one = {r->at, r->at + 1, r->depth};

        while (one.to < r->to && isalpha((unsigned char)*one.to))
            one.to++;
        r->at = one.to;
        translate_sequence(&one, '\0', out);
    } else if (r->at < r->to) {
        qdot_text_char(out, *r->at++);
    }
}

/* Translate a LaTeX argument, with brackets around it unless it is a single name or number. */
static void
translate_bracketed_argument(reader *r, qdot_text *out)
{
    qdot_text text = {0};
    bool simple = true;

    translate_argument(r, &text);
    for (size_t i = 0; i < text.n; i++)
        simple = simple &&
                 (is_word_char(text.at[i]) || text.at[i] == '\'' || text.at[i] == '_');
    qdot_text_format(out, simple ? "%s" : "(%s)", qdot_text_str(&text));
    qdot_text_clear(&text);
}

/* Translate a function, and also its argument if that has no brackets, as in \sin\theta. */
static void
translate_function_call(reader *r, const char *name, qdot_text *out)
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
        translate_argument(r, &text);
    }
    skip_blanks(r);
    if (r->at < r->to && *r->at == '(') {
        r->at++;
        qdot_text_char(out, '(');
        translate_sequence(r, ')', out);
    } else {
        qdot_text_char(out, '(');
        translate_argument(r, out);
    }
    qdot_text_char(out, ')');
    if (text.n > 0)
        qdot_text_format(out, "^%s", qdot_text_str(&text));
    qdot_text_clear(&text);
}

/* Whether the n letters at `name` are one of the words in `words`, which are separated by blanks. */
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
translate_command(reader *r, bool operand, qdot_text *out)
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
        translate_bracketed_argument(r, out);
        qdot_text_char(out, '/');
        translate_bracketed_argument(r, out);
    } else if (strcmp(word, "dot") == 0 || strcmp(word, "ddot") == 0) {
        translate_bracketed_argument(r, out);
        qdot_text_add(out, n == 3 ? "'" : "''");
    } else if (strcmp(word, "sqrt") == 0) {
        qdot_text_add(out, "sqrt(");
        translate_argument(r, out);
        qdot_text_char(out, ')');
    } else if (is_among(name, n,
                        "sin cos tan sec csc cot sinh cosh tanh exp log ln arcsin arccos "
                        "arctan")) {
        translate_function_call(r, strcmp(word, "ln") == 0 ? "log" : word, out);
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
        translate_bracketed_argument(r, out);
        return true;
    }
    if (c == '_') {
        qdot_text_char(out, c);
        translate_argument(r, out);
        return true;
    }
    if (c == '(' || c == '[' || c == '{') {
        qdot_text_add(out, operand ? "*" : "");
        qdot_text_char(out, c == '{' ? '(' : c);
        translate_sequence(r, c == '(' ? ')' : c == '[' ? ']' : '}', out);
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
translate_sequence(reader *r, char closer, qdot_text *out)
{
    bool operand = false;

    if (++r->depth > DEEPEST)
        r->at = r->to;
    for (skip_blanks(r); r->at < r->to && *r->at != closer; skip_blanks(r)) {
        if (*r->at == '\\') {
            r->at++;
            operand = translate_command(r, operand, out);
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
        translate_sequence(&r, '\0', out);
}
