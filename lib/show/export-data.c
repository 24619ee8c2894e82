/* export-data.c -- the tables of data of a whole exported file, and the statements that find the next knot of a motion. */
#include "show/export-data.h"

#include <string.h>

#include "num/samples.h"

typedef qdot_export_writer writer;

static qdot_status
find_tables_of_motion(const qdot_export_system *x, qdot_export_tables *tables)
{
    const qdot_tape *const tapes[] = {x->equations.tape, x->slopes.tape, x->velocities.tape, x->energy.tape,
                                      x->positions.tape, x->events.tape, x->switches.tape};

    for (size_t k = 0; k < sizeof tapes / sizeof *tapes; k++)
        QDOT_TRY(qdot_export_tables_find(tables, tapes[k]));
    for (size_t k = 0; k < x->n_events; k++)
        QDOT_TRY(qdot_export_tables_find(tables, x->event[k].effect));
    QDOT_TRY(qdot_knots_find(x->equations.tape, 0, &tables->lines));
    return x->velocities.tape == NULL ? QDOT_OK : qdot_knots_find(x->velocities.tape, 0, &tables->lines);
}

qdot_status
qdot_export_find_tables(writer *w)
{
    return w->system != NULL ? find_tables_of_motion(w->system, &w->tables)
                             : qdot_export_tables_find(&w->tables, w->value->value.tape);
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
qdot_status
qdot_export_write_tables(writer *w)
{
    const qdot_export_language *language = w->language;
    qdot_samples_view view;

    qdot_text_add(w->out, language->table_functions);
    qdot_text_add(w->out, w->tables.lines.n > 0 ? language->knot_function : "");
    for (size_t k = 0; k < w->tables.columns.n; k++) {
        qdot_text name = {0};

        (void)qdot_samples_look(w->tables.columns.at[k], &view);
        qdot_text_format(&name, "%s%zu", w->tables.prefix, k + 1);
        qdot_text_format(w->out, language->table_begin, qdot_text_str(&name));
        w->out->failed |= name.failed;
        qdot_text_clear(&name);
        qdot_export_write_numbers(w, view.n, view.at, "    ");
        qdot_text_add(w->out, language->table_end);
    }
    return qdot_text_status(w->out);
}
#pragma GCC diagnostic pop

qdot_status
qdot_export_write_knots(writer *w, const char *indent)
{
    for (size_t k = 0; k < w->tables.lines.n; k++) {
        const qdot_knots_line *line = &w->tables.lines.at[k];
        qdot_samples_view view;

        if (!qdot_samples_look(line->handle, &view))
            continue;
        qdot_text_format(w->out, "%snext = knot_after(next, t, way, ", indent);
        qdot_export_write_number(w, line->a);
        qdot_text_add(w->out, ", ");
        qdot_export_write_number(w, line->b);
        qdot_export_axis(&w->tables, &view, w->out);
        qdot_text_format(w->out, ", %d)%s\n", view.jumps, strchr(w->language->number, ';') != NULL ? ";" : "");
    }
    return qdot_text_status(w->out);
}
