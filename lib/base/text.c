/* text.c -- a growing string, to which texts and numbers are appended. */
#include "base/text.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"
#include "base/utf8.h"

void
qdot_text_add_n(qdot_text *s, const char *text, size_t length)
{
    if (s->failed)
        return;
    if (s->n + length >= s->capacity &&
        qdot_grow(&s->at, &s->capacity, s->n + length + 1, 1) != QDOT_OK) {
        s->failed = true;
        return;
    }
    if (length > 0) /* skip memcpy for an empty text, whose pointer may be NULL */
        memcpy(s->at + s->n, text, length);
    s->n += length;
    s->at[s->n] = '\0';
}

void
qdot_text_add(qdot_text *s, const char *text)
{
    qdot_text_add_n(s, text, strlen(text));
}

bool
qdot_ends_in(const char *text, const char *ending)
{
    const size_t n = strlen(text), k = strlen(ending);

    return n > k && strcmp(text + n - k, ending) == 0;
}

bool
qdot_is_member_of(const char *name, const char *family)
{
    const size_t n = strlen(family);

    return strncmp(name, family, n) == 0 && name[n] == '[';
}

void
qdot_text_char(qdot_text *s, char c)
{
    qdot_text_add_n(s, &c, 1);
}

void
qdot_text_format(qdot_text *s, const char *format, ...)
{
    char small[256];
    va_list ap;
    int n;

    va_start(ap, format);
    n = vsnprintf(small, sizeof small, format, ap);
    va_end(ap);
    if (n < 0 || (size_t)n < sizeof small) {
        qdot_text_add_n(s, small, n < 0 ? 0 : (size_t)n);
        return;
    }
    if (s->failed || qdot_grow(&s->at, &s->capacity, s->n + (size_t)n + 1, 1) != QDOT_OK) {
        s->failed = true;
        return;
    }
    va_start(ap, format);
    vsnprintf(s->at + s->n, (size_t)n + 1, format, ap);
    va_end(ap);
    s->n += (size_t)n;
}

bool
qdot_text_add_stream(qdot_text *s, FILE *from, size_t most)
{
    char block[65536];
    size_t n;

    while (!s->failed && s->n <= most && (n = fread(block, 1, sizeof block, from)) > 0)
        qdot_text_add_n(s, block, n);
    return !ferror(from);
}

qdot_status
qdot_text_read(qdot_text *s, FILE *from, const char *path, size_t most)
{
    struct stat info;

    if (fstat(fileno(from), &info) == 0 && S_ISDIR(info.st_mode))
        return qdot_fail(QDOT_EIO, "`%s` is a directory", path);
    if (!qdot_text_add_stream(s, from, most))
        return qdot_fail(QDOT_EIO, "`%s` cannot be read: %s", path, strerror(errno));
    if (s->n > most)
        return qdot_fail(QDOT_ELIMIT, "`%s` is larger than %zu MB", path, most >> 20);
    return qdot_text_status(s);
}

void
qdot_text_truncate(qdot_text *s, size_t length)
{
    if (length < s->n) {
        s->n = length;
        s->at[length] = '\0';
    }
}

void
qdot_text_clear(qdot_text *s)
{
    qdot_free(s->at);
    *s = (qdot_text){0};
}

const char *
qdot_text_str(const qdot_text *s)
{
    return s->at != NULL ? s->at : "";
}

qdot_status
qdot_text_status(const qdot_text *s)
{
    return s->failed ? QDOT_ENOMEM : QDOT_OK;
}

void
qdot_text_double(qdot_text *s, double x, int digits)
{
    char buffer[64];

    if (isnan(x)) {
        qdot_text_add(s, "nan");
        return;
    }
    if (isinf(x)) {
        qdot_text_add(s, x > 0 ? "inf" : "-inf");
        return;
    }
    snprintf(buffer, sizeof buffer, "%.*g", digits, x);
    /* the program sets only LC_CTYPE; an embedder's locale may still write a comma */
    for (char *c = buffer; *c != '\0'; c++)
        if (*c == ',')
            *c = '.';
    qdot_text_add(s, buffer);
}

int
qdot_double_digits(double x, int least)
{
    char buffer[64];

    for (int digits = least; digits < 17; digits++) {
        snprintf(buffer, sizeof buffer, "%.*g", digits, x);
        if (strtod(buffer, NULL) == x) /* strtod reads the number in the same locale in which it was printed */
            return digits;
    }
    return 17;
}

bool
qdot_has_word(const char *text, const char *word)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
    const size_t n = strlen(word);

    for (const char *at = strstr(text, word); at != NULL; at = strstr(at + 1, word))
        if ((at == text || strchr(letters, at[-1]) == NULL) &&
            (at[n] == '\0' || strchr(letters, at[n]) == NULL))
            return true;
    return false;
}


void
qdot_text_html(qdot_text *s, const char *text, size_t n, bool quotes)
{
    for (const char *c = text; c < text + n; c++)
        switch (*c) {
        case '&': qdot_text_add(s, "&amp;"); break;
        case '<': qdot_text_add(s, "&lt;"); break;
        case '>': qdot_text_add(s, "&gt;"); break;
        case '"': qdot_text_add(s, quotes ? "&quot;" : "\""); break;
        default: qdot_text_char(s, *c);
        }
}

void
qdot_text_json(qdot_text *s, const char *text)
{
    qdot_text_char(s, '"');
    for (const char *c = text; *c != '\0';) {
        size_t n = qdot_utf8_length(c);

        if (n == 0) {
            qdot_text_add(s, "\xEF\xBF\xBD");
            c++;
        } else if (*c == '"' || *c == '\\') {
            qdot_text_char(s, '\\');
            qdot_text_char(s, *c++);
        } else if ((unsigned char)*c < 0x20 || *c == 0x7f) {
            qdot_text_format(s, "\\u%04x", (unsigned char)*c++);
        } else {
            qdot_text_add_n(s, c, n);
            c += n;
        }
    }
    qdot_text_char(s, '"');
}
