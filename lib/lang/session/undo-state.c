/* undo-state.c -- the state of a session as arrays of items that can be copied bytewise. */
#include "lang/session/undo-state.h"

#include <string.h>

#include "lang/session/history.h"
#include "lang/session/output.h"
#include "lang/session/row-table.h"
#include "lang/session/row-tables.h"
#include "lang/session/runs.h"
#include "lang/session/units.h"
#include "lang/session/values.h"

qdot_scene_part
qdot_undo_part(qdot_session *s, qdot_undo_state *state, int k)
{
#define PART(list) {&(list).at, &(list).n, &(list).capacity, sizeof *(list).at}
    const qdot_scene_part own[QDOT_UNDO_PARTS - QDOT_SCENE_PARTS] = {
        PART(s->values->set_symbols),  PART(s->values->set_values),    PART(s->values->start_symbols),
        PART(s->values->start_values), PART(s->values->start_errors),  PART(s->values->scale_symbols),
        PART(s->values->scale_values), PART(s->units->facts),
        PART(s->history->values),      PART(s->history->over),  PART(*s->runs),
        PART(*s->tables),       PART(state->names),
    };
#undef PART

    return k < QDOT_SCENE_PARTS ? qdot_scene_part_at(s->scene, (size_t)k)
                                : own[k - QDOT_SCENE_PARTS];
}

unsigned char *
qdot_undo_items(const qdot_scene_part *part)
{
    unsigned char *at;

    memcpy(&at, part->at, sizeof at);
    return at;
}

qdot_undo_single
qdot_undo_single_of(const qdot_session *s)
{
    return (qdot_undo_single){.lagrangian = s->scene->lagrangian,
                    .higher_lagrangian = s->scene->higher_lagrangian,
                    .hamiltonian = s->scene->hamiltonian,
                    .series = s->history->series,
                    .series_in = s->history->series_in,
                    .steady_in = s->history->steady_in,
                    .modes_at = s->history->modes_at,
                    .modes_version = s->history->modes_version,
                    .linear = s->history->linear,
                    .style = s->output->style,
                    .flat = s->output->flat,
                    .timing = s->output->timing,
                    .start_exactly = s->values->start_exactly};
}

/* --- arrays of items ------------------------------------------------------------------ */

void
qdot_undo_count(int part, const unsigned char *at, size_t n, bool more)
{
    for (size_t i = 0; i < n && part == QDOT_UNDO_RUNS; i++) {
        qdot_named_run run;

        memcpy(&run, at + i * sizeof run, sizeof run);
        if (more)
            ++*run.uses;
        else
            qdot_named_run_release(&run);
    }
    for (size_t i = 0; i < n && part == QDOT_UNDO_TABLES; i++) {
        qdot_row_table *table;

        memcpy(&table, at + i * sizeof table, sizeof table);
        if (more)
            table->uses++;
        else
            qdot_row_table_release(table);
    }
    for (size_t i = 0; i < n && part == QDOT_UNDO_NAMES; i++) {
        const qdot_name *name;

        memcpy(&name, at + i * sizeof name, sizeof name);
        if (more)
            (void)qdot_names_keep(name);
        else
            qdot_names_release(name);
    }
}

static void
copy_bytes(unsigned char *to, const unsigned char *from, size_t n)
{
    if (n > 0)
        memmove(to, from, n);
}

qdot_status
qdot_undo_copy(int part, const unsigned char *from, size_t n, size_t size, unsigned char **to)
{
    *to = qdot_malloc(n * size);
    if (*to == NULL)
        return QDOT_ENOMEM;
    copy_bytes(*to, from, n * size);
    qdot_undo_count(part, *to, n, true);
    return QDOT_OK;
}

qdot_status
qdot_undo_make_room(qdot_scene_part *part, size_t n)
{
    unsigned char *at = qdot_undo_items(part);

    QDOT_TRY(qdot_grow(&at, part->capacity, n, part->size));
    memcpy(part->at, &at, sizeof at);
    return QDOT_OK;
}

void
qdot_undo_splice(const qdot_scene_part *part, size_t at, size_t gone, const unsigned char *in,
       size_t come)
{
    unsigned char *first = qdot_undo_items(part) + at * part->size;

    copy_bytes(first + come * part->size, first + gone * part->size,
               (*part->n - at - gone) * part->size);
    copy_bytes(first, in, come * part->size);
    *part->n += come - gone;
}

void
qdot_undo_splice_kept(qdot_undo_state *kept, int k, size_t size, size_t at, size_t gone,
            const unsigned char *in, size_t come)
{
    qdot_undo_array *own = &kept->part[k];
    const qdot_scene_part part = {&own->at, &own->n, &own->capacity, size};

    qdot_undo_count(k, in, come, true);
    qdot_undo_count(k, own->at + at * size, gone, false);
    qdot_undo_splice(&part, at, gone, in, come);
}

void
qdot_undo_clear(qdot_undo_state *s)
{
    for (int k = 0; k < QDOT_UNDO_PARTS; k++) {
        qdot_undo_count(k, s->part[k].at, s->part[k].n, false);
        qdot_free(s->part[k].at);
    }
    qdot_free(s->names.at);
    *s = (qdot_undo_state){0};
}
