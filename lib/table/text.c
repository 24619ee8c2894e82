/* text.c -- writes a table as text in aligned columns. */
#include "table/text.h"

#include <string.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/utf8.h"

/* The number of table rows written between two tests of the interrupt flag (Ctrl-C). */
enum { OFTEN = 1024 };

typedef struct {
    const qdot_dataset *t;
    const qdot_table_text_options *options;
    size_t *width; /* [columns] width of the cells, not counting the blanks before them */
    qdot_text cell;
} text_writer;

static void
text_add_blanks(qdot_text *out, size_t n)
{
    static const char blanks[] = "                                                                ";
    const size_t most = sizeof blanks - 1;

    for (; n > most; n -= most)
        qdot_text_add_n(out, blanks, most);
    qdot_text_add_n(out, blanks, n);
}

/* Write the cell of a row (of the headings for row == rows) into w->cell; returns its width in
 * terminal columns. */
static size_t
text_write_cell(text_writer *w, size_t row, size_t column)
{
    qdot_text_truncate(&w->cell, 0);
    if (row == w->t->rows)
        qdot_table_add_head(w->t, column, &w->cell);
    else
        qdot_table_print_cell(w->t, row, column, w->options->digits, "-", &w->cell);
    return qdot_utf8_columns(qdot_text_str(&w->cell), w->cell.n);
}

static qdot_status
text_measure_widths(text_writer *w)
{
    for (size_t j = 0; j < w->t->n; j++) {
        w->width[j] = w->t->columns[j].width;
        for (size_t i = 0; i <= w->t->rows; i++) {
            const size_t own = text_write_cell(w, i, j);

            w->width[j] = own > w->width[j] ? own : w->width[j];
        }
        QDOT_TRY(qdot_interrupt_check());
    }
    return QDOT_OK;
}

/* Nothing stands behind a last column that is aligned on the left, and a row ends where only empty cells aligned on
 * the right would follow: that of a triangle. */
static void
text_add_row(text_writer *w, size_t row, qdot_text *out)
{
    size_t end = out->n;

    for (size_t j = 0; j < w->t->n; j++) {
        const qdot_table_column *c = &w->t->columns[j];
        const size_t free = w->width[j] - text_write_cell(w, row, j);

        qdot_text_add(out, j > 0 ? w->options->mark : "");
        text_add_blanks(out, (j > 0 ? c->gap : 0) + (c->left ? 0 : free));
        qdot_text_add_n(out, qdot_text_str(&w->cell), w->cell.n);
        text_add_blanks(out, c->left && j + 1 < w->t->n ? free : 0);
        if (c->left || w->cell.n > 0)
            end = out->n;
    }
    qdot_text_truncate(out, end);
    qdot_text_char(out, '\n');
}

static qdot_status
text_write(const qdot_dataset *t, const qdot_table_text_options *options, qdot_text *out)
{
    text_writer w = {.t = t, .options = options, .width = qdot_calloc(t->n + 1, sizeof *w.width)};
    qdot_status status = w.width != NULL ? text_measure_widths(&w) : QDOT_ENOMEM;

    if (status == QDOT_OK)
        text_add_row(&w, t->rows, out);
    for (size_t i = 0; i < t->rows && status == QDOT_OK; i++) {
        text_add_row(&w, i, out);
        if (i % OFTEN == OFTEN - 1)
            status = qdot_interrupt_check();
    }
    if (status == QDOT_OK)
        status = qdot_text_status(&w.cell);
    qdot_text_clear(&w.cell);
    qdot_free(w.width);
    return status;
}

qdot_status
qdot_table_text(const qdot_dataset *t, const qdot_table_text_options *options, qdot_text *out)
{
    qdot_dataset shown;
    qdot_status status = qdot_table_select(t, options->in, &shown);

    if (status == QDOT_OK)
        status = text_write(&shown, options, out);
    qdot_free(shown.columns);
    return status == QDOT_OK ? qdot_text_status(out) : status;
}
