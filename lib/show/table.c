/* table.c -- columns as aligned text. */
#include "show/show.h"

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/utf8.h"

enum { GAP = 2, LONGEST = 64 };

/* The number as it will stand, - for none; its length. */
static size_t
write_cell(qdot_text *cell, double x, int digits)
{
    qdot_text_truncate(cell, 0);
    if (isnan(x))
        qdot_text_char(cell, '-');
    else
        qdot_text_double(cell, x, digits);
    return cell->n;
}

static void
add_blanks(qdot_text *out, size_t n)
{
    static const char blanks[LONGEST + 1] =
        "                                                                ";

    for (; n > LONGEST; n -= LONGEST)
        qdot_text_add_n(out, blanks, LONGEST);
    qdot_text_add_n(out, blanks, n);
}

/* Everything right-aligned: numbers of one column then stand under each other. mark NULL: the first
 * of a row. */
static void
aligned_add_cell(qdot_text *out, const char *text, size_t taken, size_t width, const char *mark)
{
    qdot_text_add(out, mark != NULL ? mark : "");
    add_blanks(out, width - taken + (mark == NULL ? 0 : GAP));
    qdot_text_add(out, text);
}

static qdot_status
columns_measure(size_t columns, const qdot_column *column, size_t rows, int digits,
                qdot_text *cell, size_t *width)
{
    for (size_t j = 0; j < columns; j++) {
        width[j] = qdot_utf8_columns(column[j].label, strlen(column[j].label));
        for (size_t i = 0; i < rows; i++) {
            size_t n = write_cell(cell, column[j].at[i], digits);

            width[j] = n > width[j] ? n : width[j];
        }
        QDOT_TRY(qdot_interrupt_check());
    }
    return QDOT_OK;
}

static qdot_status
table_add_rows(size_t columns, const qdot_column *column, size_t rows, int digits,
               const char *mark, const size_t *width, qdot_text *cell, qdot_text *out)
{
    for (size_t j = 0; j < columns; j++)
        aligned_add_cell(out, column[j].label,
                         qdot_utf8_columns(column[j].label, strlen(column[j].label)), width[j],
                         j == 0 ? NULL : mark);
    qdot_text_char(out, '\n');
    for (size_t i = 0; i < rows; i++) {
        for (size_t j = 0; j < columns; j++) {
            size_t n = write_cell(cell, column[j].at[i], digits);

            aligned_add_cell(out, qdot_text_str(cell), n, width[j], j == 0 ? NULL : mark);
        }
        qdot_text_char(out, '\n');
        if (i % 1024 == 1023)
            QDOT_TRY(qdot_interrupt_check());
    }
    QDOT_TRY(qdot_text_status(cell));
    return qdot_text_status(out);
}

qdot_status
qdot_table_text(size_t columns, const qdot_column *column, size_t rows, int digits,
                const char *mark, qdot_text *out)
{
    qdot_text cell = {0};
    size_t *width;
    qdot_status status;

    if (columns == 0)
        return qdot_fail(QDOT_EINVAL, "a table needs a column");
    if ((width = qdot_calloc(columns, sizeof *width)) == NULL)
        return QDOT_ENOMEM;
    status = columns_measure(columns, column, rows, digits, &cell, width);
    if (status == QDOT_OK)
        status = table_add_rows(columns, column, rows, digits, mark, width, &cell, out);
    qdot_text_clear(&cell);
    qdot_free(width);
    return status;
}
