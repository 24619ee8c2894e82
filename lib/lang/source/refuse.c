/* refuse.c -- refuses characters that the language does not have, with error messages and hints. */
#include "lang/source/refuse.h"

#include <stdint.h>
#include <string.h>

#include "base/text.h"
#include "base/utf8.h"
#include "lang/source/latex-line.h"
#include "lang/source/letters.h"

enum { SHOWN = 120 }; /* longest line in a hint, in bytes */

/* Characters that are not accepted and have one spelling: the hint is the line with it. */
static const struct {
    const char *text, *ours;
} spelled[] = {
    {"–", "-"}, {"—", "-"}, {"÷", "/"}, {"∨", "or"}, {"¬", "not "}, {"⟨", "("}, {"⟩", ")"}, {"→", "="}, {"≈", "="}, {"≡", "="}, {"≠", "!="},
};

/* Other characters that are not accepted, with a hint. */
static const struct {
    const char *text, *hint;
} foreign[] = {
    {"∑", "as in sum(k^2, k, 1, 3)"},
    {"∇", "gradient(f, R), divergence(F, R), curl(F, R), laplacian(f, R) are functions"},
    {"$", "write the formula without `$`"},
    {"∈", "a domain is declared, as in coord 0 < u < 1"},
    {"`", "a text stands in double quotes: \"text\""},
    {"±", "numbers are compared within a tolerance, as in check 3.14 == pi within 1e-2"},
};

/* Find the line that contains the byte `at`: it is [*from, *to), without blanks at its ends. */
static void
find_line_at(const char *text, size_t at, size_t *from, size_t *to)
{
    *from = *to = at;
    while (*from > 0 && text[*from - 1] != '\n' && text[*from - 1] != ';')
        --*from;
    while (strchr(" \t", text[*from]) != NULL && *from < at)
        ++*from;
    *to = at + strcspn(text + at, "\n\r#");
    while (*to > at && strchr(" \t;", text[*to - 1]) != NULL)
        --*to;
}

/* Move *from past blanks; returns the length of [*from, to) without blanks at its end. */
static int
trim_blanks(const char *text, size_t *from, size_t to)
{
    while (*from < to && text[*from] == ' ')
        ++*from;
    while (to > *from && text[to - 1] == ' ')
        to--;
    return (int)(to - *from);
}

/* Refuse “text”; the hint is the line with straight quotes. */
static qdot_status
refuse_quotes(const char *text, size_t at)
{
    qdot_text line = {0};
    size_t from, to;

    find_line_at(text, at, &from, &to);
    for (size_t i = from; i < to; i++)
        if (strncmp(text + i, "“", 3) == 0 || strncmp(text + i, "”", 3) == 0) {
            qdot_text_char(&line, '"');
            i += 2;
        } else {
            qdot_text_char(&line, text[i]);
        }
    qdot_fail(QDOT_ESYNTAX, "`%.3s` is no quote of the language", text + at);
    qdot_hint("write %s", line.n <= SHOWN ? qdot_text_str(&line) : "\"");
    qdot_text_clear(&line);
    return QDOT_ESYNTAX;
}

/* Give as a hint the line with `ours` in place of each `theirs`. */
static qdot_status
hint_at_spelling(const char *text, size_t at, const char *theirs, const char *ours)
{
    const size_t n = strlen(theirs);
    qdot_text line = {0};
    size_t from, to;

    find_line_at(text, at, &from, &to);
    while (from < to)
        if (to - from >= n && memcmp(text + from, theirs, n) == 0) {
            qdot_text_add(&line, ours);
            from += n;
        } else {
            qdot_text_char(&line, text[from++]);
        }
    qdot_hint("write %s", line.n <= SHOWN ? qdot_text_str(&line) : ours);
    qdot_text_clear(&line);
    return QDOT_ESYNTAX;
}

/* Whether the byte may be part of a name or of its primes. */
static bool
may_be_in_name(char c)
{
    return c != '\0' && (qdot_letters_latin((unsigned char)c) || (c & 0x80) != 0 ||
                         strchr("_'0123456789", c) != NULL);
}

/* The length in bytes of the name that begins at byte `at`. */
static size_t
name_length(const char *text, size_t at)
{
    size_t n = 0;

    while (may_be_in_name(text[at + n]) && strncmp(text + at + n, "∂", 3) != 0)
        n++;
    return n;
}

/* Refuse ∂T/∂x, with a hint at the notation for a partial derivative. */
static qdot_status
refuse_partial(const char *text, size_t at)
{
    const size_t of = at + strlen("∂"), n = name_length(text, of);
    const size_t by = of + n + strlen("/∂");

    qdot_fail(QDOT_ESYNTAX, "`∂` has no meaning here");
    if (text[of] == '(') { /* ∂(...)/∂x */
        const size_t close = of + strcspn(text + of, ")\n"), under = close + strlen(")/∂");

        if (strncmp(text + close, ")/∂", under - close) == 0 && memchr(text + of + 1, '(', close - of - 1) == NULL && name_length(text, under) > 0)
            return qdot_hint("write diff(%.*s, %.*s)", (int)(close - of - 1), text + of + 1, (int)name_length(text, under), text + under);
    }
    if (n == 0 || strncmp(text + of + n, "/∂", by - of - n) != 0)
        return qdot_hint("a partial derivative is diff(E, x), as in diff(t^2, t)");
    return qdot_hint("write diff(%.*s, %.*s)", (int)n, text + of,
                     (int)name_length(text, by), text + by);
}

/* Refuse @: in f = @(x) x^2 a function was meant, in theta@5 a value at a time. */
static qdot_status
refuse_at(const char *text, size_t at)
{
    const size_t close = at + strcspn(text + at, ")\n");
    size_t from, to, name, body = close + 1;
    int n;

    find_line_at(text, at, &from, &to);
    qdot_fail(QDOT_ESYNTAX, "`@` has no meaning here");
    if (to - from > SHOWN)
        return QDOT_ESYNTAX;
    name = name_length(text, from);
    if (text[at + 1] == '(' && name > 0 && close < to) {
        n = trim_blanks(text, &body, to);
        return qdot_hint("write %.*s%.*s = %.*s", (int)name, text + from,
                         (int)(close - at), text + at + 1, n, text + body);
    }
    for (name = at; name > 0 && may_be_in_name(text[name - 1]);)
        name--;
    if (name == at) /* it is a function handle, or a macro like @variables x y */
        return strncmp(text + at, "@param", 6) == 0
                   ? qdot_hint("parameters are declared by `param`, as in param m, g")
               : strncmp(text + at, "@var", 4) == 0
                   ? qdot_hint("coordinates are declared by `coord`, as in coord x, y")
                   : qdot_hint("a function is given by its name; `run 0..20` integrates the scene");
    return qdot_hint("write value(%.*s, %.*s)", (int)(at - name), text + name,
                     (int)(to - at - 1), text + at + 1);
}

/* Refuse ∧ between conditions or forms. */
static qdot_status
refuse_wedge(const char *text, size_t at)
{
    size_t from, to, left = at, right = at + strlen("∧"), begin;

    find_line_at(text, at, &from, &to);
    qdot_fail(QDOT_ESYNTAX, "`∧` has no meaning here");
    while (left > from && text[left - 1] == ' ')
        left--;
    for (begin = left; begin > from && may_be_in_name(text[begin - 1]);)
        begin--;
    while (right < to && text[right] == ' ')
        right++;
    if (text[begin] == 'd' && left > begin + 1 && text[right] == 'd' && name_length(text, right) > 1)
        return qdot_hint("write wedge(%.*s, %.*s)", (int)(left - begin), text + begin, (int)name_length(text, right), text + right);
    return hint_at_spelling(text, at, "∧", "and");
}

/* Refuse ∫ E dx. */
static qdot_status
refuse_integral(const char *text, size_t at)
{
    size_t from, to, body = at + strlen("∫"), d;
    int n;

    find_line_at(text, at, &from, &to);
    qdot_fail(QDOT_ESYNTAX, "`∫` has no meaning here");
    for (d = to; d > body && may_be_in_name(text[d - 1]);)
        d--;
    n = trim_blanks(text, &body, d);
    if (n > 0 && n <= SHOWN && text[d] == 'd' && to > d + 1)
        return qdot_hint("write integral(%.*s, %.*s)", n, text + body, (int)(to - d - 1), text + d + 1);
    return qdot_hint("as in integral(t^2, t, 0, 1)");
}

/* Refuse 30°; the hint has the angle in radians. */
static qdot_status
refuse_degrees(const char *text, size_t at)
{
    size_t from = at;

    while (from > 0 && strchr("0123456789.", text[from - 1]) != NULL)
        from--;
    if (from == at && at > 0 && text[at - 1] == '[') { /* [°], [°C] as units */
        qdot_fail(QDOT_ESYNTAX, "there is no unit `°`");
        if (strncmp(text + at, "°C", 3) == 0)
            return qdot_hint("20 degrees Celsius are `293.15 [K]`; a difference of them is in [K]");
        return qdot_hint("did you mean `deg`?");
    }
    qdot_fail(QDOT_ESYNTAX, "an angle is in radians");
    return qdot_hint("write %.*s*pi/180", (int)(at - from), text + from);
}

/* Refuse a question mark, as in ?word or A ? B : C. */
static qdot_status
refuse_question(const char *text, size_t at)
{
    size_t from, to, after = at + 1, other;
    const char *colon;
    int n[3];

    find_line_at(text, at, &from, &to);
    qdot_fail(QDOT_ESYNTAX, "`?` has no meaning here");
    if (from == at && to == at + 1)
        return qdot_hint("write help");
    if (to - from > SHOWN)
        return QDOT_ESYNTAX;
    if (from == at)
        return qdot_hint("write help %.*s", (int)(to - at - 1), text + at + 1);
    colon = memchr(text + at, ':', to - at);
    if (colon == NULL)
        return qdot_hint("`help` lists the statements; a choice is if(CONDITION, A, B)");
    other = (size_t)(colon - text) + 1;
    n[0] = trim_blanks(text, &from, at);
    n[1] = trim_blanks(text, &after, other - 1);
    n[2] = trim_blanks(text, &other, to);
    return qdot_hint("write if(%.*s, %.*s, %.*s)", n[0], text + from, n[1], text + after,
                     n[2], text + other);
}

qdot_status
qdot_refuse_backslash(const char *text, size_t at)
{
    qdot_text line = {0};
    size_t from, to;

    find_line_at(text, at, &from, &to);
    qdot_fail(QDOT_ESYNTAX, "`\\` goes at the end of a line");
    qdot_latex_line(text + from, text + to, &line);
    if (line.n > 0 && line.n <= SHOWN)
        qdot_hint("write %s", qdot_text_str(&line));
    else
        qdot_hint("names are written without it: theta, or θ");
    qdot_text_clear(&line);
    return QDOT_ESYNTAX;
}

qdot_status
qdot_refuse_open(const char *text, size_t open)
{
    size_t from, to;
    const char closer = text[open] == '(' ? ')' : text[open] == '[' ? ']' : '}';
    char missing[8];
    size_t n = 0;

    find_line_at(text, open, &from, &to);
    for (size_t i = to; i-- > open && n + 1 < sizeof missing;) /* close the brackets that are still open at the end */
        if (strchr("([{", text[i]) != NULL) {
            size_t depth = 1;

            for (size_t k = i + 1; k < to && depth > 0; k++)
                depth +=
                    (strchr("([{", text[k]) != NULL) - (strchr(")]}", text[k]) != NULL);
            if (depth > 0)
                missing[n++] = text[i] == '(' ? ')' : text[i] == '[' ? ']' : '}';
        }
    missing[n] = '\0';
    qdot_fail(QDOT_ESYNTAX, "`%c` is never closed", text[open]);
    if (n == 0 || to - from > SHOWN || closer == '}')
        return qdot_hint("a `%c` is missing", closer);
    return qdot_hint("write %.*s%s", (int)(to - from), text + from, missing);
}

qdot_status
qdot_refuse_close(const char *text, size_t close)
{
    size_t from, to;

    find_line_at(text, close, &from, &to);
    qdot_fail(QDOT_ESYNTAX, "`%c` closes nothing", text[close]);
    if (to - from > SHOWN || close == from)
        return QDOT_ESYNTAX;
    return qdot_hint("write %.*s%.*s", (int)(close - from), text + from,
                     (int)(to - close - 1), text + close + 1);
}

qdot_status
qdot_refuse_text(const char *text, size_t open)
{
    size_t from, to;

    find_line_at(text, open, &from, &to);
    qdot_fail(QDOT_ESYNTAX, "the text has no closing quote");
    if (to - from > SHOWN)
        return QDOT_ESYNTAX;
    return qdot_hint("write %.*s\"", (int)(to - from), text + from);
}

static bool
byte_is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* Refuse `1_000` or `_x`, with a hint. */
static qdot_status
refuse_underscore(const char *text, size_t at)
{
    size_t from = at, n = 0;
    char digits[40];

    while (from > 0 && (byte_is_digit(text[from - 1]) || text[from - 1] == '_'))
        from--;
    if (from == at) {
        qdot_fail(QDOT_ESYNTAX, "a name begins with a letter");
        return QDOT_ESYNTAX;
    }
    for (; (byte_is_digit(text[from]) || text[from] == '_') && n + 1 < sizeof digits; from++)
        if (text[from] != '_')
            digits[n++] = text[from];
    digits[n] = '\0';
    qdot_fail(QDOT_ESYNTAX, "`_` is no part of a number");
    return qdot_hint("write %s", digits);
}

qdot_status
qdot_refuse(const char *text, size_t at)
{
    const char *here = text + at;
    size_t length;
    uint32_t c = qdot_utf8_decode(here, &length);
    int digit = qdot_letters_superscript(c);

    if (c < 0x20 || c == 0x7F)
        return qdot_fail(QDOT_ESYNTAX, "a control character: this is not text");
    if (digit >= 0) {
        qdot_fail(QDOT_ESYNTAX, "a raised digit has no meaning here");
        return qdot_hint("write `^%d`", digit);
    }
    if (c == 0x307 || c == 0x308) {
        qdot_fail(QDOT_ESYNTAX, "a dot over a letter has no meaning here");
        return qdot_hint("write `%s` after the name", c == 0x307 ? "'" : "''");
    }
    if (c == 0x201C || c == 0x201D)
        return refuse_quotes(text, at);
    if (c == 0xB0)
        return refuse_degrees(text, at);
    if (c == '?')
        return refuse_question(text, at);
    if (c == '@')
        return refuse_at(text, at);
    if (c == '~') { /* in other languages a ~ b is an equation, and ~a means not a */
        size_t from, to, before;

        find_line_at(text, at, &from, &to);
        for (before = at; before > from && text[before - 1] == ' ';)
            before--;
        qdot_fail(QDOT_ESYNTAX, "`~` has no meaning here");
        if (before > from && text[at + 1] != '=')
            return qdot_hint("an equation is written a = b");
        return qdot_hint("write `not (a = b)`");
    }
    if (c == 0x2202)
        return refuse_partial(text, at);
    if (c == '_') {
        return refuse_underscore(text, at);
    }
    if (c == 0x2227)
        return refuse_wedge(text, at);
    if (c == 0x222B)
        return refuse_integral(text, at);
    qdot_fail(QDOT_ESYNTAX, "`%.*s` has no meaning here", (int)length, here);
    for (size_t i = 0; i < sizeof spelled / sizeof *spelled; i++)
        if (strncmp(here, spelled[i].text, length) == 0 && spelled[i].text[length] == '\0')
            return hint_at_spelling(text, at, spelled[i].text, spelled[i].ours);
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++)
        if (strncmp(here, foreign[i].text, length) == 0 &&
            foreign[i].text[length] == '\0')
            return qdot_hint("%s", foreign[i].hint);
    return c < 0x80 ? QDOT_ESYNTAX : qdot_hint("letters of names are Latin or Greek");
}
