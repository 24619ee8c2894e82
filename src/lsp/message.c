/* message.c -- reads the JSON of a message, mending what stands for no character. */
#include "message.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "base/utf8.h"

enum { FLAGS = JSON_ALLOW_NUL | JSON_DECODE_ANY };

static const char replacement[] = "\xEF\xBF\xBD"; /* U+FFFD */

/* The unit of UTF-16 that the escape \uXXXX at `text` stands for; 0: it is no such escape. */
static unsigned
escaped_unit(const char *text)
{
    char digits[5] = "", *end;
    unsigned unit;

    if (text[0] != '\\' || text[1] != 'u')
        return 0;
    strncpy(digits, text + 2, 4);
    unit = (unsigned)strtoul(digits, &end, 16);
    return end == digits + 4 ? unit : 0;
}

static bool
is_high(unsigned unit)
{
    return unit >= 0xD800 && unit < 0xDC00;
}

static bool
is_low(unsigned unit)
{
    return unit >= 0xDC00 && unit < 0xE000;
}

/* Append what one character or escape at `text` is read as; returns its bytes. */
static size_t
mend_character(const char *text, qdot_text *to)
{
    const unsigned unit = escaped_unit(text);
    const bool half = is_high(unit) || is_low(unit);
    size_t n = qdot_utf8_length(text);

    if (is_high(unit) && is_low(escaped_unit(text + 6)))
        n = 12;
    else if (half || n == 0) {
        qdot_text_add(to, replacement);
        return half ? 6 : 1;
    } else if (*text == '\\' && text[1] != '\0') {
        n = 2;
    }
    qdot_text_add_n(to, text, n);
    return n;
}

json_t *
qdot_message_read(const char *text, size_t length)
{
    json_t *message = json_loadb(text, length, FLAGS, NULL);
    qdot_text mended = {0};
    char *own;

    if (message != NULL || memchr(text, '\0', length) != NULL)
        return message;
    own = qdot_strndup(text, length);
    for (size_t i = 0; own != NULL && i < length;)
        i += mend_character(own + i, &mended);
    qdot_free(own);
    if (!mended.failed)
        message = json_loadb(qdot_text_str(&mended), mended.n, FLAGS, NULL);
    qdot_text_clear(&mended);
    return message;
}
