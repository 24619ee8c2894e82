/* hdf5-read.c -- columns of a file that hdf5.c has written.
 *
 * Only what that writes is understood: a superblock of version 2, object headers of version 2 in one
 * block each, links, attributes, data sets in one block. Another file is refused.
 *
 * Source  as hdf5.c
 */
#include "table/hdf5-read.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/interrupt.h"
#include "base/memory.h"

enum { SUPERBLOCK = 48, DATASPACE = 1, DATATYPE = 3, LINK = 6, LAYOUT = 8, ATTRIBUTE = 12, HEAD = 4 };

typedef struct {
    const char *path;
    const unsigned char *at; /* [n] the bytes of the file */
    size_t n;
} file;

static qdot_status
fail_unknown_format(const file *f)
{
    return qdot_fail(QDOT_EINVAL, "%.200s is no file of rows that qdot has written", f->path);
}

static uint64_t
read_little_endian(const unsigned char *at, int bytes)
{
    uint64_t x = 0;

    for (int i = 0; i < bytes; i++)
        x |= (uint64_t)at[i] << 8 * i;
    return x;
}

/* Read a regular file (a pipe would block, a device may not end); Ctrl-C is tested between blocks. */
static qdot_status
read_regular_file(const char *path, qdot_text *out)
{
    enum { BLOCK = 1 << 24 };
    qdot_status status = QDOT_OK;
    bool whole = true, more = true;
    struct stat info;
    FILE *from;

    if (stat(path, &info) == 0 && !S_ISREG(info.st_mode))
        return qdot_fail(QDOT_EIO, "%.200s cannot be read: it is no regular file", path);
    from = fopen(path, "rbe");
    if (from == NULL)
        return qdot_fail(QDOT_EIO, "%.200s cannot be read", path);
    while (status == QDOT_OK && whole && more) {
        const size_t before = out->n;

        status = qdot_interrupt_check();
        whole = qdot_text_add_stream(out, from, before + BLOCK);
        more = out->n > before;
    }
    fclose(from);
    QDOT_TRY(status);
    if (!whole)
        return qdot_fail(QDOT_EIO, "%.200s cannot be read", path);
    return qdot_text_status(out);
}

/* --- messages of an HDF5 object ------------------------------------------------------- */

/* Goes through the messages of an HDF5 object header, one by one. */
typedef struct {
    const unsigned char *at, *end; /* start of the next message, and end of all messages */
    int type;
    const unsigned char *body;
    size_t size;
} messages;

static qdot_status
open_object(const file *f, uint64_t address, messages *m)
{
    uint64_t n;

    if (address > f->n || f->n - address < 10 || memcmp(f->at + address, "OHDR\2\2", 6) != 0)
        return fail_unknown_format(f);
    n = read_little_endian(f->at + address + 6, 4);
    if (n > f->n - address - 10)
        return fail_unknown_format(f);
    *m = (messages){.at = f->at + address + 10};
    m->end = m->at + n;
    return QDOT_OK;
}

static bool
next_message(messages *m)
{
    if (m->end - m->at < HEAD)
        return false;
    m->type = m->at[0];
    m->size = (size_t)read_little_endian(m->at + 1, 2);
    m->body = m->at + HEAD;
    if ((size_t)(m->end - m->body) < m->size)
        return false;
    m->at = m->body + m->size;
    return true;
}

/* --- reading columns ------------------------------------------------------------------ */

/* Read the HDF5 data set at `address` as the next column. */
static qdot_status
read_column(const file *f, uint64_t address, const unsigned char *name, size_t length,
            qdot_hdf5_columns *out)
{
    qdot_hdf5_column c = {.label = qdot_malloc(length + 1)};
    uint64_t rows = 0, size = 0, where = 0;
    bool texts = false;
    messages m;

    if (c.label == NULL)
        return QDOT_ENOMEM;
    memcpy(c.label, name, length);
    c.label[length] = '\0';
    QDOT_TRY(qdot_vec_push(&out->at, c));
    QDOT_TRY(open_object(f, address, &m));
    while (next_message(&m)) {
        if (m.type == DATASPACE && m.size == 12)
            rows = read_little_endian(m.body + 4, 8);
        if (m.type == DATATYPE && m.size >= 8) {
            texts = m.body[0] == 0x13;
            size = read_little_endian(m.body + 4, 4);
        }
        if (m.type == LAYOUT && m.size == 18)
            where = read_little_endian(m.body + 2, 8);
    }
    if (size == 0 || (out->at.n > 1 && rows != out->rows) || (!texts && size != 8)
        || (rows > 0 && (where > f->n || rows > (f->n - where) / size)))
        return fail_unknown_format(f);
    out->rows = (size_t)rows;
    c.size = texts ? (size_t)size : 0;
    c.bytes = qdot_malloc((size_t)(rows * size) + 1);
    if (c.bytes == NULL)
        return QDOT_ENOMEM;
    if (rows > 0)
        memcpy(c.bytes, f->at + where, (size_t)(rows * size));
    out->at.at[out->at.n - 1] = c;
    for (uint64_t i = 0; texts && i < rows; i++) /* every text must end with NUL within its field */
        if (c.bytes[(i + 1) * size - 1] != '\0')
            return fail_unknown_format(f);
    return QDOT_OK;
}

/* Read a message of a header if it links to a column or is the requested text attribute. */
static qdot_status
read_message(const file *f, const messages *m, qdot_hdf5_columns *out)
{
    const unsigned char *b = m->body;
    size_t name, type;

    if (m->type == LINK && m->size > 13) {
        name = (size_t)read_little_endian(b + 3, 2);
        if (m->size != 13 + name)
            return fail_unknown_format(f);
        if (name == strlen("parameters") && memcmp(b + 5, "parameters", name) == 0)
            return QDOT_OK;
        return read_column(f, read_little_endian(b + 5 + name, 8), b + 5, name, out);
    }
    if (m->type != ATTRIBUTE || m->size < 9)
        return QDOT_OK;
    name = (size_t)read_little_endian(b + 2, 2);
    type = (size_t)read_little_endian(b + 4, 2);
    if (name == 0 || 9 + name + type + 4 > m->size || b[9 + name - 1] != '\0')
        return fail_unknown_format(f);
    if (strcmp((const char *)b + 9, out->fact) == 0 && m->body[m->size - 1] == '\0')
        qdot_text_add(&out->text, (const char *)b + 9 + name + type + 4);
    return qdot_text_status(&out->text);
}

qdot_status
qdot_hdf5_read(const char *path, const char *fact, qdot_hdf5_columns *out)
{
    qdot_text bytes = {0};
    qdot_status status = read_regular_file(path, &bytes);
    const file f = {path, (const unsigned char *)bytes.at, bytes.n};
    messages m = {0};

    out->fact = fact;
    if (status == QDOT_OK
        && (f.n < SUPERBLOCK || memcmp(f.at, "\211HDF\r\n\032\n\2\10\10", 11) != 0
            || read_little_endian(f.at + 28, 8) > f.n))
        status = fail_unknown_format(&f);
    if (status == QDOT_OK)
        status = open_object(&f, read_little_endian(f.at + 36, 8), &m);
    while (status == QDOT_OK && next_message(&m))
        status = read_message(&f, &m, out);
    qdot_text_clear(&bytes);
    return status;
}

void
qdot_hdf5_columns_clear(qdot_hdf5_columns *c)
{
    for (size_t i = 0; i < c->at.n; i++) {
        qdot_free(c->at.at[i].label);
        qdot_free(c->at.at[i].bytes);
    }
    qdot_free(c->at.at);
    qdot_text_clear(&c->text);
    *c = (qdot_hdf5_columns){0};
}

double
qdot_hdf5_number(const qdot_hdf5_column *c, size_t row)
{
    const uint64_t bits = read_little_endian((const unsigned char *)c->bytes + 8 * row, 8);
    double x;

    memcpy(&x, &bits, sizeof x);
    return x;
}
