/* utf8.c -- decodes UTF-8 strictly: overlong forms and surrogates are errors. */
#include "base/utf8.h"

uint32_t
qdot_utf8_decode(const char *text, size_t *length)
{
    const unsigned char *s = (const unsigned char *)text;
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    size_t n = s[0] < 0x80 ? 1 : s[0] < 0xC2 ? 0 : s[0] < 0xE0 ? 2 : s[0] < 0xF0 ? 3 : s[0] < 0xF5 ? 4 : 0;
    uint32_t c;

    *length = 0;
    if (n == 0 || s[0] == 0)
        return 0;
    c = n == 1 ? s[0] : s[0] & (0xFFu >> (n + 1));
    for (size_t i = 1; i < n; i++) {
        if ((s[i] & 0xC0) != 0x80)
            return 0;
        c = c << 6 | (s[i] & 0x3F);
    }
    if (c < least[n] || (c >= 0xD800 && c < 0xE000) || c > 0x10FFFF)
        return 0;
    *length = n;
    return c;
}

size_t
qdot_utf8_length(const char *text)
{
    size_t n;

    (void)qdot_utf8_decode(text, &n);
    return n;
}

size_t
qdot_utf8_columns(const char *text, size_t bytes)
{
    size_t columns = 0;

    for (size_t i = 0, n; i < bytes; i += n > 0 ? n : 1) {
        const uint32_t c = qdot_utf8_decode(text + i, &n);

        columns += !((c >= 0x300 && c < 0x370) || (c >= 0x20D0 && c < 0x2100));
    }
    return columns;
}

void
qdot_utf8_mend(char *text)
{
    char *to = text;

    while (*text != '\0') {
        const size_t n = qdot_utf8_length(text);

        for (size_t i = 0; i < n; i++)
            *to++ = text[i];
        text += n > 0 ? n : 1;
    }
    *to = '\0';
}
