/* export-tables.c -- writes tables of data into exported programs. */
#include "show/export-tables.h"

#include "num/samples.h"
#include "tape/instruction.h"

void
qdot_export_tables_clear(qdot_export_tables *tables)
{
    qdot_free(tables->columns.at);
    qdot_free(tables->lines.at);
}

/* The place of an array among those that are written; columns.n: it is not among them. */
static size_t
place_of_array(const qdot_export_tables *tables, const double *at)
{
    size_t k = 0;
    qdot_samples_view view;

    while (k < tables->columns.n && !(qdot_samples_look(tables->columns.at[k], &view) && view.at == at))
        k++;
    return k;
}

qdot_status
qdot_export_tables_find(qdot_export_tables *tables, const qdot_tape *tape)
{
    for (size_t k = 0; tape != NULL && k < tape->length; k++) {
        const qdot_instruction *i = &tape->code[k];
        qdot_samples_view view;

        if (i->op == QDOT_OP_LOOKUP && qdot_samples_look(tape->constant[i->z - tape->inputs], &view)
            && place_of_array(tables, view.at) == tables->columns.n)
            QDOT_TRY(qdot_vec_push(&tables->columns, tape->constant[i->z - tape->inputs]));
    }
    return QDOT_OK;
}

/* --- source text ------------------------------------------------------------------------ */

void
qdot_export_axis(const qdot_export_tables *tables, const qdot_samples_view *view, qdot_text *out)
{
    qdot_text_format(out, ", %s%zu, %zu, %d", tables->prefix, place_of_array(tables, view->at) + 1, view->n,
                     view->beyond == QDOT_SAMPLES_HOLD       ? 1
                     : view->beyond == QDOT_SAMPLES_PERIODIC ? 2
                                                             : 0);
}

void
qdot_export_lookup(const qdot_export_tables *tables, double handle, const char *x, qdot_text *out)
{
    static const char *const words[] = {
        [QDOT_SAMPLES_PIECE] = "find_piece", [QDOT_SAMPLES_KNOT] = "knot_of", [QDOT_SAMPLES_COEFFICIENT] = "entry_of"};
    qdot_samples_view view;

    if (!qdot_samples_look(handle, &view)) {
        qdot_text_add(out, "0.0");
        return;
    }
    qdot_text_format(out, "%s(%s", words[view.item], x);
    if (view.item == QDOT_SAMPLES_COEFFICIENT)
        qdot_text_format(out, ", %s%zu, %zu", tables->prefix, place_of_array(tables, view.at) + 1, view.period);
    else
        qdot_export_axis(tables, &view, out);
    if (view.item == QDOT_SAMPLES_PIECE)
        qdot_text_format(out, ", %d", view.jumps);
    qdot_text_char(out, ')');
}
