/* hdf5.c -- a table in the format of HDF5, written directly.
 *
 * The file is a superblock of version 2, then object headers of version 2 with their messages: the
 * root group, the group of parameters and a data set for each column, whose numbers follow in one
 * block. Linking the library instead would load 4 MB at each start of the program.
 *
 * Source  The HDF Group, HDF5 File Format Specification 3.0, II.A, IV.A; the checksum is lookup3 by
 *         B. Jenkins (2006).
 */
#include "table/hdf5.h"

#include <stdint.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/sink.h"

enum {
    SUPERBLOCK = 48,
    LINK_INFO = 2,
    GROUP_INFO = 10,
    LINK = 6,
    DATASPACE = 1,
    DATATYPE = 3,
    FILL = 5,
    LAYOUT = 8,
    ATTRIBUTE = 12,
    MOST_TEXT = 60000 /* longest text in bytes: an HDF5 message has at most 65535 */
};

#define NOWHERE UINT64_MAX

/* --- writing bytes ---------------------------------------------------------------------- */

static void
append_integer(qdot_text *out, uint64_t x, int n)
{
    for (int i = 0; i < n; i++)
        qdot_text_char(out, (char)(x >> 8 * i & 0xff));
}

static void
append_double(qdot_text *out, double x)
{
    uint64_t bits;

    memcpy(&bits, &x, sizeof bits);
    append_integer(out, bits, 8);
}

static uint32_t
rotate_left(uint32_t x, int k)
{
    return x << k | x >> (32 - k);
}

static uint32_t
read_word(const unsigned char *key, size_t n)
{
    uint32_t x = 0;

    for (size_t i = 0; i < 4 && i < n; i++)
        x |= (uint32_t)key[i] << 8 * i;
    return x;
}

/* The lookup3 checksum (Jenkins) of n bytes, with the initial value 0. */
static uint32_t
checksum(const char *text, size_t n)
{
    const unsigned char *key = (const unsigned char *)text;
    uint32_t a = 0xdeadbeef + (uint32_t)n, b = a, c = a;

    for (; n > 12; n -= 12, key += 12) {
        a += read_word(key, 4);
        b += read_word(key + 4, 4);
        c += read_word(key + 8, 4);
        a -= c, a ^= rotate_left(c, 4), c += b;
        b -= a, b ^= rotate_left(a, 6), a += c;
        c -= b, c ^= rotate_left(b, 8), b += a;
        a -= c, a ^= rotate_left(c, 16), c += b;
        b -= a, b ^= rotate_left(a, 19), a += c;
        c -= b, c ^= rotate_left(b, 4), b += a;
    }
    if (n == 0)
        return c;
    a += read_word(key, n);
    b += n > 4 ? read_word(key + 4, n - 4) : 0;
    c += n > 8 ? read_word(key + 8, n - 8) : 0;
    c ^= b, c -= rotate_left(b, 14);
    a ^= c, a -= rotate_left(c, 11);
    b ^= a, b -= rotate_left(a, 25);
    c ^= b, c -= rotate_left(b, 16);
    a ^= c, a -= rotate_left(c, 4);
    b ^= a, b -= rotate_left(a, 14);
    c ^= b, c -= rotate_left(b, 24);
    return c;
}

/* --- messages of an HDF5 object --------------------------------------------------------- */

static void
begin_message(qdot_text *header, int type, size_t size)
{
    append_integer(header, (uint64_t)type, 1);
    append_integer(header, size, 2);
    append_integer(header, 0, 1);
}

/* Append the HDF5 type of IEEE 754 doubles, least significant byte first: 20 bytes. */
static void
append_double_type(qdot_text *out)
{
    append_integer(out, 0x11, 1);
    append_integer(out, 0x003f20, 3);
    append_integer(out, 8, 4);
    append_integer(out, 0, 2);
    append_integer(out, 64, 2);
    append_integer(out, 52, 1);
    append_integer(out, 11, 1);
    append_integer(out, 0, 1);
    append_integer(out, 52, 1);
    append_integer(out, 1023, 4);
}

/* Append the HDF5 type of a UTF-8 text of `size` bytes, including its NUL: 8 bytes. */
static void
append_text_type(qdot_text *out, size_t size)
{
    append_integer(out, 0x13, 1);
    append_integer(out, 0x10, 3);
    append_integer(out, size, 4);
}

/* Append a fact about the table as an HDF5 attribute. */
static void
append_attribute(qdot_text *header, const qdot_table_fact *fact)
{
    size_t name = strlen(fact->name) + 1, length = fact->text == NULL ? 0 : strlen(fact->text);
    bool number = fact->text == NULL;
    size_t type = number ? 20 : 8, size;

    length = length > MOST_TEXT ? MOST_TEXT : length;
    size = number ? 8 : length + 1;
    begin_message(header, ATTRIBUTE, 9 + name + type + 4 + size);
    append_integer(header, 3, 1);
    append_integer(header, 0, 1);
    append_integer(header, name, 2);
    append_integer(header, type, 2);
    append_integer(header, 4, 2);
    append_integer(header, 1, 1);
    qdot_text_add_n(header, fact->name, name);
    if (number)
        append_double_type(header);
    else
        append_text_type(header, size);
    append_integer(header, 2, 4); /* dataspace message, version 2, scalar */
    if (number) {
        append_double(header, fact->number);
    } else {
        qdot_text_add_n(header, fact->text, length);
        append_integer(header, 0, 1);
    }
}

static void
append_link(qdot_text *header, const char *name, uint64_t address)
{
    size_t n = strlen(name);

    begin_message(header, LINK, 13 + n);
    append_integer(header, 1, 1);
    append_integer(header, 0x11, 1); /* link flags: hard link, character set stated, name length in 2 bytes */
    append_integer(header, 1, 1);
    append_integer(header, n, 2);
    qdot_text_add_n(header, name, n);
    append_integer(header, address, 8);
}

static void
append_group_messages(qdot_text *header)
{
    begin_message(header, LINK_INFO, 18);
    append_integer(header, 0, 2);
    append_integer(header, NOWHERE, 8);
    append_integer(header, NOWHERE, 8);
    begin_message(header, GROUP_INFO, 2);
    append_integer(header, 0, 2);
}

static bool
is_text_column(const qdot_dataset *t, size_t j)
{
    return t->columns[j].kind == QDOT_CELL_TEXT;
}

static const char *
entry_text(const qdot_dataset *t, size_t j, size_t i)
{
    const char *text = qdot_table_at(t, i, j).text;

    return text != NULL ? text : "";
}

/* The number of bytes of an entry of a column: of a double, or of the longest text and its NUL. */
static size_t
entry_size(const qdot_dataset *t, size_t j)
{
    size_t size = 1;

    if (!is_text_column(t, j))
        return sizeof(double);
    for (size_t i = 0; i < t->rows; i++) {
        const size_t n = strlen(entry_text(t, j, i)) + 1;

        size = n > size ? n : size;
    }
    return size;
}

static void
append_data_set(qdot_text *header, const qdot_dataset *t, size_t j, uint64_t address)
{
    const size_t rows = t->rows, size = entry_size(t, j);
    const bool texts = is_text_column(t, j);

    begin_message(header, DATASPACE, 12);
    append_integer(header, 0x01000102, 4); /* dataspace message: version 2, one dimension, fixed size */
    append_integer(header, rows, 8);
    begin_message(header, DATATYPE, texts ? 8 : 20);
    if (texts)
        append_text_type(header, size);
    else
        append_double_type(header);
    begin_message(header, FILL, 2);
    append_integer(header, 0x0a03, 2);
    begin_message(header, LAYOUT, 18);
    append_integer(header, 0x0103, 2); /* layout message: version 3, contiguous */
    append_integer(header, rows > 0 ? address : NOWHERE, 8);
    append_integer(header, rows * size, 8);
}

/* Append an HDF5 object header and the messages in it. */
static void
append_object(qdot_text *out, const qdot_text *messages)
{
    size_t from = out->n;

    qdot_text_add(out, "OHDR");
    append_integer(out, 2, 1);
    append_integer(out, 2, 1); /* header flags: size in 4 bytes, no time stamps */
    append_integer(out, messages->n, 4);
    qdot_text_add_n(out, qdot_text_str(messages), messages->n);
    if (!out->failed)
        append_integer(out, checksum(out->at + from, out->n - from), 4);
}

enum { OBJECT = 14 }; /* bytes of an object header besides its messages */

/* --- laying out the file ---------------------------------------------------------------- */

/* Append a column's name: its label without forbidden characters, with the column's number if it
 * was used before. */
static void
append_column_name(const qdot_dataset *t, size_t j, qdot_text *out)
{
    const char *label = t->columns[j].name;

    for (const char *c = label; *c != '\0'; c++)
        if (*c == '/')
            qdot_text_add(out, "\u2215");
        else
            qdot_text_char(out, *c);
    for (size_t i = 0; i < j; i++)
        if (strcmp(t->columns[i].name, label) == 0 || strcmp(label, "parameters") == 0) {
            qdot_text_format(out, " (%zu)", j + 1);
            break;
        }
}

/* The addresses of object headers and of numbers in the HDF5 file. */
typedef struct {
    /* addresses: parameters, first column's header, first column's numbers, end of file */
    uint64_t parameters, headers, numbers, end;
    const uint64_t *columns; /* addresses of the columns' headers; NULL: not known yet */
} places;

/* Append the messages of the root group: facts, links to the parameters and to the columns. */
static void
append_root_messages(const qdot_dataset *t, const places *at, qdot_text *messages)
{
    qdot_text name = {0};

    append_group_messages(messages);
    for (size_t i = 0; i < t->n_facts; i++)
        append_attribute(messages, &t->facts[i]);
    append_link(messages, "parameters", at->parameters);
    for (size_t j = 0; j < t->n; j++) {
        append_column_name(t, j, &name);
        append_link(messages, qdot_text_str(&name), at->columns != NULL ? at->columns[j] : 0);
        qdot_text_truncate(&name, 0);
    }
    messages->failed |= name.failed;
    qdot_text_clear(&name);
}

static void
append_superblock(uint64_t end, qdot_text *out)
{
    qdot_text_add_n(out, "\211HDF\r\n\032\n", 8);
    append_integer(out, 0x080802, 4); /* superblock version 2, addresses and lengths of 8 bytes */
    append_integer(out, 0, 8);
    append_integer(out, NOWHERE, 8);
    append_integer(out, end, 8);
    append_integer(out, SUPERBLOCK, 8);
    if (!out->failed)
        append_integer(out, checksum(out->at, out->n), 4);
}

/* The header of each column in turn: where it is, and the numbers that it has; out: NULL: only
 * find where. */
static bool
append_column_headers(const qdot_dataset *t, places *at, uint64_t *where, qdot_text *out)
{
    qdot_text messages = {0};
    uint64_t header = at->headers, numbers = at->numbers;
    bool failed = false;

    for (size_t j = 0; j < t->n; j++) {
        qdot_text_truncate(&messages, 0);
        append_data_set(&messages, t, j, numbers);
        if (t->columns[j].unit != NULL)
            append_attribute(&messages, &(qdot_table_fact){"units", t->columns[j].unit, 0});
        if (out != NULL)
            append_object(out, &messages);
        where[j] = header;
        header += OBJECT + messages.n;
        numbers += t->rows * entry_size(t, j);
        failed |= messages.failed;
    }
    at->end = at->numbers == 0 ? header : numbers;
    qdot_text_clear(&messages);
    return failed;
}

/* Append all object headers; their sizes do not depend on the addresses that they contain. */
static qdot_status
append_headers(const qdot_dataset *t, qdot_text *out)
{
    qdot_text messages = {0}, parameters = {0};
    places at = {0};
    uint64_t *columns = qdot_calloc(t->n + 1, sizeof *columns);
    bool failed = false;

    if (columns == NULL)
        return QDOT_ENOMEM;
    append_group_messages(&parameters);
    for (size_t i = 0; i < t->n_parameters; i++)
        append_attribute(&parameters, &t->parameters[i]);
    append_root_messages(t, &at, &messages);
    at.parameters = SUPERBLOCK + OBJECT + messages.n;
    at.headers = at.parameters + OBJECT + parameters.n;
    failed |= append_column_headers(t, &at, columns, NULL);
    at.numbers = at.end;
    failed |= append_column_headers(t, &at, columns, NULL);
    at.columns = columns;
    qdot_text_truncate(&messages, 0);
    append_superblock(at.end, out);
    append_root_messages(t, &at, &messages);
    append_object(out, &messages);
    append_object(out, &parameters);
    failed |= messages.failed || parameters.failed;
    failed |= append_column_headers(t, &at, columns, out);
    out->failed |= failed;
    qdot_text_clear(&messages);
    qdot_text_clear(&parameters);
    qdot_free(columns);
    return qdot_text_status(out);
}

/* Append one entry of a column; a text is padded with NULs. */
static void
append_entry(const qdot_dataset *t, size_t j, size_t i, size_t size, qdot_text *out)
{
    const char *text;
    size_t n;

    if (!is_text_column(t, j)) {
        append_double(out, qdot_table_at(t, i, j).value);
        return;
    }
    text = entry_text(t, j, i);
    n = strlen(text);
    qdot_text_add_n(out, text, n);
    for (; n < size; n++)
        qdot_text_char(out, '\0');
}

static qdot_status
write_entries(const qdot_dataset *t, qdot_sink *sink, qdot_text *text)
{
    enum { CHUNK = 8192 };

    for (size_t j = 0; j < t->n; j++) {
        const size_t size = entry_size(t, j);

        for (size_t i = 0; i < t->rows; i++) {
            append_entry(t, j, i, size, text);
            if (i % CHUNK != CHUNK - 1 && i + 1 < t->rows)
                continue;
            QDOT_TRY(qdot_text_status(text));
            QDOT_TRY(qdot_interrupt_check());
            QDOT_TRY(qdot_sink_put(sink, text->at, text->n));
            qdot_text_truncate(text, 0);
        }
    }
    return QDOT_OK;
}

static qdot_status
write_file_of_columns(const qdot_dataset *t, const char *path)
{
    qdot_text text = {0};
    qdot_sink sink;
    qdot_status status = append_headers(t, &text);

    if (status == QDOT_OK)
        status = qdot_sink_open(&sink, path);
    if (status == QDOT_OK) {
        status = qdot_sink_put(&sink, text.at, text.n);
        qdot_text_truncate(&text, 0);
        if (status == QDOT_OK)
            status = write_entries(t, &sink, &text);
        if (status == QDOT_OK)
            status = qdot_sink_close(&sink);
        else
            qdot_sink_abandon(&sink);
    }
    qdot_text_clear(&text);
    return status;
}

qdot_status
qdot_table_hdf5(const qdot_dataset *t, const char *path)
{
    qdot_dataset shown;
    qdot_status status = qdot_table_select(t, QDOT_IN_FILES, &shown);

    if (status == QDOT_OK)
        status = write_file_of_columns(&shown, path);
    qdot_free(shown.columns);
    return status;
}
