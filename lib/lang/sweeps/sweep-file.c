/* sweep-file.c -- stores the finished rows of a sweep in a file, from which it can be resumed. */
#include "lang/sweeps/sweep-file.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "lang/session/row-columns.h"
#include "table/hdf5-read.h"
#include "table/hdf5.h"

static const char fact[] = "sweep";

/* --- checksum of the sweep ------------------------------------------------------------ */

/* The hash value (64-bit FNV-1a) of an empty text, with which hashing begins. */
static const uint64_t sum_of_nothing = 14695981039346656037u;

static void
hash_bytes(uint64_t *sum, const void *bytes, size_t n)
{
    const unsigned char *at = bytes;

    for (size_t i = 0; i < n; i++)
        *sum = (*sum ^ at[i]) * 1099511628211u;
}

static void
hash_number(uint64_t *sum, double x)
{
    uint64_t bits;

    x = isnan(x) ? NAN : x; /* use one bit pattern for all NaNs */
    memcpy(&bits, &x, sizeof bits);
    for (int k = 0; k < 64; k += 8) {
        const unsigned char byte = (unsigned char)(bits >> k);

        hash_bytes(sum, &byte, 1);
    }
}

/* Write the text that identifies the sweep, with a checksum of that text and of the rows. */
static qdot_status
write_signature(const char *said, uint64_t sum, qdot_text *out)
{
    hash_bytes(&sum, said, strlen(said));
    qdot_text_format(out, "%s\nchecksum %016" PRIx64, said, sum);
    return qdot_text_status(out);
}

/* --- writing the file ----------------------------------------------------------------- */

static uint64_t
checksum_of_table(const qdot_dataset *t)
{
    uint64_t sum = sum_of_nothing;

    for (size_t i = 0; i < t->rows; i++)
        for (size_t j = 0; j < t->n; j++) {
            const qdot_table_cell cell = qdot_table_at(t, i, j);
            const char *text = cell.text != NULL ? cell.text : "";

            if (!qdot_table_shows(t, j, QDOT_IN_FILES))
                continue;
            if (t->columns[j].kind == QDOT_CELL_NUMBER)
                hash_number(&sum, cell.value);
            else
                hash_bytes(&sum, text, strlen(text) + 1);
        }
    return sum;
}

qdot_status
qdot_sweep_file_keep(const qdot_row_table *t, const bool *done, const char *said,
                     const char *path)
{
    qdot_text signed_text = {0};
    qdot_row_columns x = {0};
    qdot_status status = qdot_row_columns_of(t, done, &x);

    if (status == QDOT_OK)
        status = write_signature(said, checksum_of_table(&x.table), &signed_text);
    if (status == QDOT_OK) {
        const qdot_table_fact facts[] = {{"program", PACKAGE_STRING, 0},
                                         {fact, qdot_text_str(&signed_text), 0}};

        x.table.n_facts = 2;
        x.table.facts = facts;
        x.table.n_parameters = 0;
        status = qdot_table_hdf5(&x.table, path);
    }
    qdot_row_columns_free(&x);
    qdot_text_clear(&signed_text);
    return status;
}

/* --- reading the file ----------------------------------------------------------------- */

static qdot_status
copy_rows_from_file(const qdot_hdf5_columns *from, const char *path, qdot_row_table *t, bool *done)
{
    const qdot_hdf5_column *c = from->at.at;
    const qdot_hdf5_column *reasons = &c[1 + qdot_row_columns_count(t)];

    for (size_t at = 0; at < from->rows; at++) {
        const double row = qdot_hdf5_number(&c[0], at);
        const char *reason = reasons->bytes + at * reasons->size;
        size_t k;

        if (!(row >= 0 && row < (double)t->rows && row == floor(row)))
            return qdot_fail(QDOT_EINVAL, "%.200s has a row %g that the sweep has not", path, row);
        k = (size_t)row;
        for (size_t i = 0; i < t->n; i++) {
            t->values[k * t->n + i] = qdot_hdf5_number(&c[1 + i], at);
            t->errors[k * t->n + i] =
                i < t->n_swept
                    ? 0
                    : qdot_hdf5_number(&c[1 + t->n + i - t->n_swept], at);
        }
        if (*reason != '\0' && t->reasons[k] == NULL) {
            t->reasons[k] = qdot_strdup(reason);
            if (t->reasons[k] == NULL)
                return QDOT_ENOMEM;
        }
        done[k] = true;
    }
    return QDOT_OK;
}

static uint64_t
checksum_of_file(const qdot_hdf5_columns *from)
{
    const size_t n = from->at.n - 1;
    const qdot_hdf5_column *reasons = &from->at.at[n];
    uint64_t sum = sum_of_nothing;

    for (size_t i = 0; i < from->rows; i++) {
        const char *reason = reasons->bytes + i * reasons->size;

        for (size_t j = 0; j < n; j++)
            hash_number(&sum, qdot_hdf5_number(&from->at.at[j], i));
        hash_bytes(&sum, reason, strlen(reason) + 1);
    }
    return sum;
}

/* Check that the file belongs to this sweep (same text) and that its rows are undamaged (same checksum). */
static qdot_status
check_file(const qdot_hdf5_columns *from, const char *path, const char *said, const qdot_row_table *t)
{
    /* number of columns in the file: one of row numbers, then values, and one of reasons for failures */
    const size_t n = 1 + qdot_row_columns_count(t) + 1, length = strlen(said);
    const char *text = qdot_text_str(&from->text);
    bool good = from->at.n == n && strncmp(text, said, length) == 0
                && (text[length] == '\0' || text[length] == '\n');
    qdot_text signed_text = {0};
    qdot_status status;

    for (size_t i = 0; i < n && good; i++)
        good = (from->at.at[i].size > 0) == (i + 1 == n);
    if (!good) {
        (void)qdot_fail(QDOT_EINVAL, "%.200s holds the rows of another sweep, or of another scene", path);
        return qdot_hint("give another name, or remove the file");
    }
    status = write_signature(said, checksum_of_file(from), &signed_text);
    if (status == QDOT_OK && strcmp(text, signed_text.at) != 0) {
        (void)qdot_fail(QDOT_EINVAL, "%.200s is damaged: its rows are not those that were written", path);
        status = qdot_hint("remove the file; its rows are made anew");
    }
    qdot_text_clear(&signed_text);
    return status;
}

qdot_status
qdot_sweep_file_take(const char *path, const char *said, qdot_row_table *t, bool *done)
{
    qdot_hdf5_columns from = {0};
    qdot_status status;

    if (access(path, F_OK) != 0 && errno == ENOENT)
        return QDOT_OK;
    status = qdot_hdf5_read(path, fact, &from);
    if (status == QDOT_OK)
        status = check_file(&from, path, said, t);
    if (status == QDOT_OK)
        status = copy_rows_from_file(&from, path, t, done);
    qdot_hdf5_columns_clear(&from);
    return status;
}
