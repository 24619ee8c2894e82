/* lex.c -- splits the bytes of a source into tokens. */
#include "lang/source/lex.h"

#include <string.h>

#include "base/interrupt.h"
#include "base/text.h"
#include "base/utf8.h"
#include "expr/exact.h"
#include "lang/source/letters.h"
#include "lang/source/refuse.h"

typedef struct {
    qdot_source *source;
    size_t i;   /* index of the next byte */
    bool blank; /* a blank was read since the last token */
    qdot_vec(qdot_token) tokens;
    qdot_vec(uint32_t) open; /* indices of tokens that opened a bracket still open */
} lexer;

/* Spellings of operators; longer ones first if one is the beginning of another. */
static const struct {
    const char *text, *token;
} operators[] = {
    {"**", "^"},
    {"==", "=="},
    {"<=", "<="},
    {">=", ">="},
    {"..", ".."},
    {"!=", "!="},
    {"&&", "&&"},
    {"||", "||"},
    {"(", "("},
    {")", ")"},
    {"[", "["},
    {"]", "]"},
    {"{", "{"},
    {"}", "}"},
    {",", ","},
    {":", ":"},
    {".", "."},
    {"'", "'"},
    {"+", "+"},
    {"-", "-"},
    {"*", "*"},
    {"/", "/"},
    {"^", "^"},
    {"=", "="},
    {"<", "<"},
    {">", ">"},
    {"%", "%"},
    {"!", "!"},
    {"&", "&"},
    {"|", "|"},
    {"~", "~"},
    {"\xE2\x88\x92", "-"},  /* minus sign */
    {"\xC2\xB7", "*"},      /* middle dot */
    {"\xE2\x8B\x85", "*"},  /* dot operator */
    {"\xC3\x97", "*"},      /* times */
    {"\xE2\x80\xAF", "*"},  /* narrow no-break space: the product of style unicode */
    {"\xE2\x88\x9A", "sqrt"}, /* square root sign √ before its operand */
    {"\xE2\x89\xA4", "<="}, /* less or equal */
    {"\xE2\x89\xA5", ">="}, /* greater or equal */
    {"\xE2\x89\xA0", "!="}, /* not equal */
    {"\xE2\x80\xB2", "'"},  /* prime */
    {"\xE2\x80\x99", "'"},  /* apostrophe */
};

/* Characters such as ½ that are exact fractions. */
static const struct {
    const char *sign, *text;
} fractions[] = {
    {"½", "1/2"}, {"⅓", "1/3"}, {"⅔", "2/3"}, {"¼", "1/4"}, {"¾", "3/4"},
    {"⅕", "1/5"}, {"⅖", "2/5"}, {"⅗", "3/5"}, {"⅘", "4/5"}, {"⅙", "1/6"},
    {"⅚", "5/6"}, {"⅛", "1/8"}, {"⅜", "3/8"}, {"⅝", "5/8"}, {"⅞", "7/8"},
};

static bool
char_is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static qdot_status
push_token(lexer *x, qdot_token_kind kind, const char *text, size_t start, size_t end)
{
    qdot_token token = {.kind = (uint8_t)kind,
                        .glued = !x->blank && x->tokens.n > 0,
                        .text = text,
                        .start = (uint32_t)start,
                        .length = (uint32_t)(end - start)};

    if (x->tokens.n >= QDOT_LEX_TOKENS)
        return qdot_fail(QDOT_ELIMIT, "the script has more than %u words and signs",
                         QDOT_LEX_TOKENS);
    if ((x->tokens.n & 0xFFFF) == 0)
        QDOT_TRY(qdot_interrupt_check());
    x->blank = false;
    return qdot_vec_push(&x->tokens, token);
}

static const char *
text_of_last_token(const lexer *x)
{
    return x->tokens.n == 0 ? "" : x->tokens.at[x->tokens.n - 1].text;
}

static bool
is_last_token_of_kind(const lexer *x, qdot_token_kind kind)
{
    return x->tokens.n > 0 && x->tokens.at[x->tokens.n - 1].kind == kind;
}

/* Whether a sign or a number in the source contains characters beyond ASCII, such as − or ½. */
static bool
is_beyond_ascii(const lexer *x, const qdot_token *t)
{
    for (uint32_t i = 0; i < t->length && (t->kind == QDOT_TOKEN_OPERATOR || t->kind == QDOT_TOKEN_NUMBER); i++)
        if ((x->source->text[t->start + i] & 0x80) != 0)
            return true;
    return false;
}

/* Push the end of a statement; empty statements leave no token. */
static qdot_status
push_statement_end(lexer *x, size_t start, size_t end)
{
    size_t first = x->tokens.n;
    bool shown = false;

    if (x->tokens.n == 0 || is_last_token_of_kind(x, QDOT_TOKEN_END) ||
        (is_last_token_of_kind(x, QDOT_TOKEN_OPERATOR) && strcmp(text_of_last_token(x), "{") == 0))
        return QDOT_OK;
    for (; first > 0 && x->tokens.at[first - 1].kind != QDOT_TOKEN_END; first--)
        shown = shown || is_beyond_ascii(x, &x->tokens.at[first - 1]);
    for (; shown && first < x->tokens.n; first++)
        x->tokens.at[first].shown = true;
    return push_token(x, QDOT_TOKEN_END, "", start, end);
}

/* Whether a newline counts as a blank here, because a ( or [ is open. */
static bool
is_in_bracket(const lexer *x)
{
    return x->open.n > 0 && x->tokens.at[x->open.at[x->open.n - 1]].text[0] != '{';
}

static qdot_status
close_bracket(lexer *x, const char *text)
{
    static const char pairs[] = "()[]{}";
    const qdot_token *opened;

    if (x->open.n == 0)
        return qdot_refuse_close(x->source->text, x->i);
    opened = &x->tokens.at[x->open.at[x->open.n - 1]];
    if (strchr(pairs, opened->text[0])[1] != text[0]) {
        char closer = strchr(pairs, opened->text[0])[1];

        qdot_fail(QDOT_ESYNTAX, "`%s` does not close `%s`", text, opened->text);
        return qdot_hint("a `%c` is missing", closer);
    }
    x->open.n--;
    return QDOT_OK;
}

static qdot_status
read_operator(lexer *x, bool *found)
{
    const char *text = x->source->text + x->i;

    *found = false;
    for (size_t k = 0; k < sizeof operators / sizeof *operators; k++) {
        const char *token = operators[k].token;
        size_t length = strlen(operators[k].text);

        if (strncmp(text, operators[k].text, length) != 0)
            continue;
        *found = true;
        if (strchr(")]}", token[0]) != NULL) {
            QDOT_TRY(close_bracket(x, token));
            if (token[0] == '}')
                QDOT_TRY(push_statement_end(x, x->i, x->i));
        }
        QDOT_TRY(push_token(x, QDOT_TOKEN_OPERATOR, token, x->i, x->i + length));
        if (strchr("([{", token[0]) != NULL) {
            if (x->open.n >= QDOT_LEX_BRACKETS)
                return qdot_fail(QDOT_ELIMIT, "more than %u open brackets",
                                 QDOT_LEX_BRACKETS);
            QDOT_TRY(qdot_vec_push(&x->open, (uint32_t)(x->tokens.n - 1)));
        }
        x->i += length;
        return QDOT_OK;
    }
    return QDOT_OK;
}

static qdot_status
lex_number(lexer *x)
{
    const char *text = x->source->text;
    size_t start = x->i, i = start;
    const char *copy;

    while (char_is_digit(text[i]))
        i++;
    if (text[i] == '.' && char_is_digit(text[i + 1])) {
        i++;
        while (char_is_digit(text[i]))
            i++;
    }
    if (text[i] == 'e' || text[i] == 'E') {
        size_t k = i + 1;

        if (text[k] == '+' || text[k] == '-')
            k++;
        if (char_is_digit(text[k])) {
            while (char_is_digit(text[k]))
                k++;
            i = k;
        }
    }
    if (text[i] == '.' && char_is_digit(text[i + 1])) {
        x->i = i;
        return qdot_fail(QDOT_ESYNTAX, "a number has one decimal point");
    }
    copy = qdot_arena_strndup(x->source->arena, text + start, i - start);
    if (copy == NULL)
        return QDOT_ENOMEM;
    QDOT_TRY(push_token(x, QDOT_TOKEN_NUMBER, copy, start, i));
    x->i = i;
    return QDOT_OK;
}

/* Append the letter or digit at the next byte to `name`, Greek ones spelled out; false if there is none. */
static bool
append_letter(lexer *x, qdot_text *name, bool first)
{
    const char *text = x->source->text + x->i;
    size_t length;
    uint32_t c = qdot_utf8_decode(text, &length);
    const char *greek;

    if (length == 0)
        return false;
    greek = qdot_letters_greek(c);
    if (greek != NULL)
        qdot_text_add(name, greek);
    else if (qdot_letters_latin(c) ||
             (!first && (c == '_' || (c < 0x80 && char_is_digit((char)c)))))
        qdot_text_add_n(name, text, length);
    else if (!first && qdot_letters_subscript(c) >= 0)
        qdot_text_char(name, (char)('0' + qdot_letters_subscript(c)));
    else
        return false;
    x->i += length;
    return true;
}

/* The number of dots over the letter just read (time derivatives), which become primes. */
static unsigned
read_dots(lexer *x)
{
    size_t length;
    uint32_t c = qdot_utf8_decode(x->source->text + x->i, &length);
    unsigned dots = length == 0 ? 0 : c == 0x307 ? 1 : c == 0x308 ? 2 : c == 0x20DB ? 3 : 0;

    x->i += dots > 0 ? length : 0;
    return dots;
}

/* Push n tokens `'`, all at the bytes [start, end). */
static qdot_status
push_primes(lexer *x, unsigned n, size_t start, size_t end)
{
    for (unsigned i = 0; i < n; i++)
        QDOT_TRY(push_token(x, QDOT_TOKEN_OPERATOR, "'", start, end));
    return QDOT_OK;
}

/* Lex a name; dots over its first letter become primes after it: θ̇₁ is theta1'. */
static qdot_status
lex_name(lexer *x, qdot_text *name)
{
    size_t start = x->i;
    const char *copy;
    unsigned dots;

    qdot_text_truncate(name, 0);
    dots = qdot_letters_dotted(x->source->text + x->i, &copy);
    if (dots > 0) {
        qdot_text_char(name, *copy);
        x->i += (size_t)qdot_utf8_length(x->source->text + x->i);
    } else if (append_letter(x, name, true)) {
        dots = read_dots(x);
    } else {
        return QDOT_OK;
    }
    while (append_letter(x, name, false))
        ;
    QDOT_TRY(qdot_text_status(name));
    copy = qdot_arena_strndup(x->source->arena, name->at, name->n);
    if (copy == NULL)
        return QDOT_ENOMEM;
    QDOT_TRY(push_token(x, QDOT_TOKEN_NAME, copy, start, x->i));
    return push_primes(x, dots, start, x->i);
}

/* The value of the superscript digit at `text`, -1 if there is none; *length: its bytes. */
static int
superscript_digit_value(const char *text, size_t *length)
{
    uint32_t c = qdot_utf8_decode(text, length);

    return *length > 0 ? qdot_letters_superscript(c) : -1;
}

static bool
ends_last_token_operand(const lexer *x)
{
    return !x->blank && x->tokens.n > 0 &&
           (is_last_token_of_kind(x, QDOT_TOKEN_NAME) || is_last_token_of_kind(x, QDOT_TOKEN_NUMBER) ||
            (is_last_token_of_kind(x, QDOT_TOKEN_OPERATOR) && strchr(")]'", text_of_last_token(x)[0]) != NULL));
}

/* Lex superscripts after an operand: x⁻¹² as x^-12, x⁽⁴⁾ as x''''. */
static qdot_status
read_superscripts(lexer *x, bool *found)
{
    static const char minus[] = "⁻", open[] = "⁽", close[] = "⁾";
    const char *text = x->source->text;
    size_t start = x->i, i = start, length;
    bool order = strncmp(text + i, open, sizeof open - 1) == 0;
    bool negative = strncmp(text + i, minus, sizeof minus - 1) == 0;
    uint64_t n = 0;
    qdot_text digits = {0};
    const char *copy;
    int digit;

    *found = false;
    if (!ends_last_token_operand(x))
        return QDOT_OK;
    i += order ? sizeof open - 1 : negative ? sizeof minus - 1 : 0;
    while ((digit = superscript_digit_value(text + i, &length)) >= 0) {
        qdot_text_char(&digits, (char)('0' + digit));
        n = n < 1000 ? 10 * n + (uint64_t)digit : n;
        i += length;
    }
    if (digits.n == 0 || (order && strncmp(text + i, close, sizeof close - 1) != 0)) {
        qdot_text_clear(&digits);
        return QDOT_OK;
    }
    copy = qdot_arena_strndup(x->source->arena, digits.at, digits.n);
    qdot_text_clear(&digits);
    if (copy == NULL)
        return QDOT_ENOMEM;
    *found = true;
    x->i = i + (order ? sizeof close - 1 : 0);
    if (order && n <= QDOT_LEX_PRIMES)
        return push_primes(x, (unsigned)n, start, x->i);
    if (order)
        return qdot_fail(QDOT_ELIMIT, "a derivative of order %s", copy);
    QDOT_TRY(push_token(x, QDOT_TOKEN_OPERATOR, "^", start, x->i));
    if (negative)
        QDOT_TRY(push_token(x, QDOT_TOKEN_OPERATOR, "-", start, x->i));
    return push_token(x, QDOT_TOKEN_NUMBER, copy, start, x->i);
}

static qdot_status
read_fraction_character(lexer *x, bool *found)
{
    *found = false;
    for (size_t k = 0; k < sizeof fractions / sizeof *fractions && !*found; k++) {
        size_t length = strlen(fractions[k].sign), start = x->i;

        if (strncmp(x->source->text + start, fractions[k].sign, length) != 0)
            continue;
        *found = true;
        x->i += length;
        QDOT_TRY(push_token(x, QDOT_TOKEN_NUMBER, fractions[k].text, start, x->i));
    }
    return QDOT_OK;
}

qdot_expr
qdot_lex_number(qdot_pool *pool, const char *text)
{
    return strlen(text) == 3 && text[1] == '/'
               ? qdot_expr_ratio(pool, text[0] - '0', text[2] - '0')
               : qdot_expr_decimal(pool, text, strlen(text));
}

/* Lex a quoted text "...", in which \" and \\ stand for the quote and the backslash. */
static qdot_status
read_string(lexer *x, qdot_text *buffer)
{
    const char *text = x->source->text;
    size_t i = x->i + 1;
    const char *copy;

    qdot_text_truncate(buffer, 0);
    while (text[i] != '"') {
        if (i >= x->source->length || text[i] == '\n')
            return qdot_refuse_text(text, x->i);
        if (text[i] == '\\' && (text[i + 1] == '"' || text[i + 1] == '\\'))
            i++;
        if ((unsigned char)text[i] < 0x20 && text[i] != '\t') {
            x->i = i;
            return qdot_fail(QDOT_ESYNTAX, "a control character: this is not text");
        }
        qdot_text_char(buffer, text[i++]);
    }
    QDOT_TRY(qdot_text_status(buffer));
    copy = qdot_arena_strndup(x->source->arena, qdot_text_str(buffer), buffer->n);
    if (copy == NULL)
        return QDOT_ENOMEM;
    QDOT_TRY(push_token(x, QDOT_TOKEN_STRING, copy, x->i, i + 1));
    x->i = i + 1;
    return QDOT_OK;
}

/* Step over comments, blanks and ends of lines; *found: there were some. */
static qdot_status
lex_blank(lexer *x, bool *found)
{
    const char *text = x->source->text;
    char c = text[x->i];

    *found = true;
    if (c == ' ' || c == '\t' || c == '\r') {
        x->i++;
    } else if (strncmp(text + x->i, "\xC2\xA0", 2) == 0) { /* a no-break space */
        x->i += 2;
    } else if (c == '#') {
        const char *end = memchr(text + x->i, '\n', x->source->length - x->i);
        const char *nul =
            memchr(text + x->i, '\0',
                   end != NULL ? (size_t)(end - text) - x->i : x->source->length - x->i);

        if (nul != NULL) {
            x->i = (size_t)(nul - text);
            return qdot_fail(QDOT_ESYNTAX, "a control character: this is not text");
        }
        x->i = end != NULL ? (size_t)(end - text) : x->source->length;
    } else if (c == '\\') {
        size_t i = x->i + 1;

        while (text[i] == ' ' || text[i] == '\t' || text[i] == '\r')
            i++;
        if (text[i] != '\n' && i < x->source->length) {
            return qdot_refuse_backslash(text, x->i);
        }
        x->i = i < x->source->length ? i + 1 : i;
    } else if (c == '\n') {
        if (!is_in_bracket(x))
            QDOT_TRY(push_statement_end(x, x->i, x->i + 1));
        x->i++;
    } else {
        *found = false;
        return QDOT_OK;
    }
    x->blank = true;
    return QDOT_OK;
}

/* Read one token of the source. */
static qdot_status
read_token(lexer *x, qdot_text *buffer)
{
    const char *text = x->source->text;
    char c = text[x->i];
    size_t start = x->i;
    bool found;

    if (qdot_utf8_length(text + x->i) == 0 && c != '\0')
        return qdot_fail(QDOT_ESYNTAX, "byte 0x%02X is not UTF-8: this is not text",
                         (unsigned char)c);
    if (char_is_digit(c) || (c == '.' && char_is_digit(text[x->i + 1])))
        return lex_number(x);
    if (c == '"')
        return read_string(x, buffer);
    if (c == ';') {
        QDOT_TRY(is_in_bracket(x) ? push_token(x, QDOT_TOKEN_OPERATOR, ";", x->i, x->i + 1)
                               : push_statement_end(x, x->i, x->i + 1));
        x->i++;
        return QDOT_OK;
    }
    QDOT_TRY(lex_name(x, buffer));
    if (x->i > start)
        return QDOT_OK;
    if (strncmp(text + x->i, "\xE2\x80\xB3", 3) == 0) { /* a double prime */
        QDOT_TRY(push_token(x, QDOT_TOKEN_OPERATOR, "'", x->i, x->i + 3));
        QDOT_TRY(push_token(x, QDOT_TOKEN_OPERATOR, "'", x->i, x->i + 3));
        x->i += 3;
        return QDOT_OK;
    }
    QDOT_TRY(read_operator(x, &found));
    if (!found)
        QDOT_TRY(read_fraction_character(x, &found));
    if (!found)
        QDOT_TRY(read_superscripts(x, &found));
    return found ? QDOT_OK : qdot_refuse(x->source->text, x->i);
}

/* The length of the prompt that begins `text`: `qdot>`, `qdot 3>`, `...>`, `In [3]:`, `...:`;
 * 0: none. */
static size_t
length_of_prompt(const char *text)
{
    static const char digits[] = "0123456789";
    size_t n;

    if (strncmp(text, "...>", 4) == 0 || strncmp(text, "...:", 4) == 0)
        return 4;
    if (strncmp(text, "qdot", 4) == 0) {
        n = text[4] == ' ' ? 5 + strspn(text + 5, digits) : 4;
        return text[n] == '>' && n != 5 ? n + 1 : 0;
    }
    if (strncmp(text, "In [", 4) != 0)
        return 0;
    n = 4 + strspn(text + 4, digits);
    return n > 4 && strncmp(text + n, "]:", 2) == 0 ? n + 2 : 0;
}

/* Step over prompts at the beginning of a line, which were pasted with it from a terminal. */
static void
skip_prompts(lexer *x)
{
    const char *text = x->source->text;

    for (;;) {
        const size_t i = x->i + strspn(text + x->i, " \t"), n = length_of_prompt(text + i);

        if (n == 0 || (i + n < x->source->length && strchr(" \t\r\n", text[i + n]) == NULL))
            return;
        x->i = i + n;
    }
}

static qdot_status
read_all_tokens(lexer *x, qdot_text *buffer)
{
    if (strncmp(x->source->text, "\xEF\xBB\xBF", 3) == 0)
        x->i = 3;
    skip_prompts(x);
    while (x->i < x->source->length) {
        bool blank;

        QDOT_TRY(lex_blank(x, &blank));
        if (!blank)
            QDOT_TRY(read_token(x, buffer));
        else if (x->source->text[x->i - 1] == '\n')
            skip_prompts(x);
    }
    if (x->open.n > 0) {
        const qdot_token *opened = &x->tokens.at[x->open.at[x->open.n - 1]];

        x->i = opened->start;
        return qdot_refuse_open(x->source->text, x->i);
    }
    QDOT_TRY(push_statement_end(x, x->source->length, x->source->length));
    /* whatever the source, its last token is an END */
    if (!is_last_token_of_kind(x, QDOT_TOKEN_END))
        return push_token(x, QDOT_TOKEN_END, "", x->source->length, x->source->length);
    return QDOT_OK;
}

qdot_status
qdot_lex(qdot_source *source, size_t *at)
{
    lexer x = {.source = source};
    qdot_text buffer = {0};
    qdot_status status = read_all_tokens(&x, &buffer);

    *at = x.i;
    qdot_text_clear(&buffer);
    qdot_free(x.open.at);
    source->tokens.at = x.tokens.at;
    source->tokens.n = x.tokens.n;
    source->tokens.capacity = x.tokens.capacity;
    return status;
}
