/* row-file.c -- rows of many runs in a file. */
#include "lang/files/row-file.h"

#include "lang/answer/row-answer.h"
#include "lang/figures/figure-file.h"
#include "lang/files/data-file.h"

qdot_row_table *
qdot_row_file_named(const qdot_cursor *c)
{
    const qdot_token *behind = c->at + 1;

    if (c->at->kind != QDOT_TOKEN_NAME)
        return NULL;
    if (behind->kind != QDOT_TOKEN_END && !qdot_token_is_word(behind, "to"))
        return NULL;
    return qdot_row_tables_find(c->session, c->at->text);
}

/* Column by column: numbers [columns x rows], then their labels. */
typedef struct {
    size_t n;
    double *values;
    qdot_text *labels;
    qdot_column *columns;
    char **reasons;
} columns;

static void
free_columns(columns *x)
{
    for (size_t i = 0; x->labels != NULL && i < x->n; i++)
        qdot_text_clear(&x->labels[i]);
    qdot_free(x->labels);
    qdot_free(x->values);
    qdot_free(x->columns);
    qdot_free(x->reasons);
}

static qdot_status
fill(const qdot_row_table *t, columns *x)
{
    static char none[] = "";

    x->n = 2 * t->n - t->n_swept;
    x->values = qdot_calloc(x->n * t->rows + 1, sizeof *x->values);
    x->labels = qdot_calloc(x->n, sizeof *x->labels);
    x->columns = qdot_calloc(x->n + 1, sizeof *x->columns);
    x->reasons = qdot_calloc(t->rows + 1, sizeof *x->reasons);
    if (x->values == NULL || x->labels == NULL || x->columns == NULL || x->reasons == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < x->n; i++) {
        const size_t of = i < t->n ? i : i - t->n + t->n_swept;
        double *const at = x->values + i * t->rows;

        qdot_text_format(&x->labels[i], i < t->n ? "%s" : "error of %s", t->labels[of]);
        QDOT_TRY(qdot_text_status(&x->labels[i]));
        for (size_t k = 0; k < t->rows; k++)
            at[k] = (i < t->n ? t->values : t->errors)[k * t->n + of];
        x->columns[i] = (qdot_column){qdot_text_str(&x->labels[i]), at};
    }
    x->columns[x->n].label = "reason";
    for (size_t k = 0; k < t->rows; k++)
        x->reasons[k] = t->reasons[k] != NULL ? t->reasons[k] : none;
    return QDOT_OK;
}

static qdot_status
write_file(qdot_session *session, const qdot_row_table *t, const char *path)
{
    const bool bare = qdot_ends_in(path, ".csv") || qdot_ends_in(path, ".txt");
    columns x = {0};
    qdot_status status = fill(t, &x);

    if (status == QDOT_OK && bare)
        status = qdot_data_file_write(session, NULL, x.n, x.columns, t->rows, path);
    if (status == QDOT_OK && !bare) {
        char *const **texts = qdot_calloc(x.n + 1, sizeof *texts);
        qdot_data data = {.columns = x.n + 1, .rows = t->rows, .column = x.columns};

        if (texts != NULL)
            texts[x.n] = x.reasons;
        data.texts = (char *const *const *)texts;
        status = texts != NULL ? qdot_data_file_write_texts(session, NULL, &data, path)
                               : QDOT_ENOMEM;
        qdot_free(texts);
    }
    free_columns(&x);
    return status;
}

qdot_status
qdot_row_file_statement(qdot_cursor *c, const qdot_row_table *table)
{
    const qdot_token *file;
    const char *path = NULL;

    c->at++;
    if (!qdot_cursor_accept_word(c, "to"))
        return qdot_row_answer(c->session, table);
    file = c->at;
    QDOT_TRY(qdot_figure_file_read(c, &path));
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = file->start;
    QDOT_TRY(qdot_data_file_check(path));
    return write_file(c->session, table, path);
}
