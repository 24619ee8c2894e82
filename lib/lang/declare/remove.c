/* remove.c -- the statement `remove`: things of the scene, by label or by kind and number, states, runs, tables. */
#include <string.h>

#include "base/spelling.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "lang/answer/answer.h"
#include "lang/language/function.h"
#include "lang/session/labels.h"
#include "lang/session/names.h"
#include "lang/session/row-tables.h"
#include "lang/session/runs.h"
#include "lang/session/scales.h"
#include "lang/session/values.h"
#include "lang/syntax/record.h"

static qdot_status carry_out_remove(qdot_record *r);

QDOT_STATEMENT(remove) = {
    .word = "remove",
    .group = QDOT_DECLARING,
    .usage = "remove NAME | remove KIND [K]",
    .summary = "take a thing out of the scene again: by its label; a state by its name; the only one of its kind (gravity, "
               "potential, spring, damper, dissipation, force, torque), or the K-th; forget a run or table by its name",
    .example = "remove d1",
    .handler = carry_out_remove,
};

/* Give a notice of the things removed in addition, because they acted on a removed thing. */
static qdot_status
give_notice_of_removed(qdot_session *session, const char *label)
{
    const qdot_scene *scene = session->scene;
    qdot_text list = {0};
    qdot_status status;

    if (scene->dropped.n == 0)
        return QDOT_OK;
    for (size_t i = 0; i < scene->dropped.n; i++)
        qdot_text_format(&list, "%s%s", i > 0 ? ", " : "", scene->dropped.at[i]);
    status = qdot_text_status(&list);
    if (status == QDOT_OK)
        status = qdot_answer_notice(session, "with %s was removed what acted on it: %s", label,
                                    qdot_text_str(&list));
    qdot_text_clear(&list);
    return status;
}

/* Kinds of things that may be removed without a label, with the words for them. */
static const struct {
    const char *word, *singular, *plural;
    qdot_scene_kind kind;
} kinds[] = {{"gravity", "field of gravity", "fields of gravity", QDOT_GRAVITY},
             {"potential", "potential", "potentials", QDOT_POTENTIAL},
             {"spring", "spring", "springs", QDOT_SPRING},
             {"damper", "damper", "dampers", QDOT_DAMPER},
             {"dissipation", "dissipation", "dissipations", QDOT_DISSIPATION},
             {"force", "force", "forces", QDOT_FORCE},
             {"torque", "torque", "torques", QDOT_TORQUE}};
enum { KINDS = sizeof kinds / sizeof *kinds };

/* Fail with a list of candidates: "there are 2 potentials: 1: `potential x^2`, 2: ..." */
static qdot_status
refuse_ambiguous(const qdot_scene *scene, size_t row)
{
    enum { LONGEST = 80, MOST = 380 };
    size_t n = qdot_scene_count(scene, kinds[row].kind);
    qdot_text list = {0}, line = {0};
    qdot_status status = QDOT_OK;

    for (size_t k = 0; k < n && status == QDOT_OK; k++) {
        qdot_text_clear(&line);
        status = qdot_scene_print_at(scene, kinds[row].kind, k, &line);
        if (status != QDOT_OK)
            break;
        if (list.n > MOST) {
            qdot_text_add(&list, ", ...");
            break;
        }
        qdot_text_format(&list, "%s%zu: `%.*s%s`", k > 0 ? ", " : "", k + 1,
                         line.n - 1 > LONGEST ? LONGEST : (int)line.n - 1,
                         qdot_text_str(&line), line.n - 1 > LONGEST ? "..." : "");
    }
    if (status == QDOT_OK)
        status = qdot_text_status(&list);
    if (status == QDOT_OK) {
        (void)qdot_fail(QDOT_EINVAL, "there %s %zu %s: %s", n == 1 ? "is" : "are", n,
                        n == 1 ? kinds[row].singular : kinds[row].plural,
                        qdot_text_str(&list));
        status = qdot_hint("remove %s %zu", kinds[row].word, n);
    }
    qdot_text_clear(&list);
    qdot_text_clear(&line);
    return status;
}

/* Remove the only thing of a kind (`remove potential`), or one by its number (`remove potential 2`). */
static qdot_status
remove_thing_of_kind(qdot_record *r, const qdot_filled *number, size_t row)
{
    qdot_scene *scene = r->cursor.session->scene;
    size_t n = qdot_scene_count(scene, kinds[row].kind);
    int64_t k = 1;

    r->cursor.error_at = r->start->start;
    if (number != NULL)
        QDOT_TRY(qdot_record_integer(r, number, &k));
    if (n == 0)
        return qdot_fail(QDOT_EINVAL, "the scene has no %s", kinds[row].plural);
    if (k < 1 || (size_t)k > n || (n > 1 && number == NULL))
        return refuse_ambiguous(scene, row);
    return qdot_scene_remove_at(scene, kinds[row].kind, (size_t)k - 1);
}

/* Fail because nothing has this label; the hint is the most similar label or kind. */
static qdot_status
report_unknown_label(const qdot_session *session, const char *label)
{
    const qdot_scene *scene = session->scene;
    const qdot_name *name = qdot_names_find(session->names, label);
    qdot_words words = {0};
    const char *nearest;
    qdot_status status;

    if (name != NULL && name->kind == QDOT_NAME_COORD) {
        (void)qdot_fail(QDOT_ENOTBUILT, "not built yet: `remove` of a coordinate");
        return qdot_hint("`undo` takes back the statements since, `reset scene` all of the scene");
    }

    for (size_t i = 0; i < KINDS; i++)
        (void)qdot_vec_push(&words, kinds[i].word); /* if memory runs out the hint lacks this word */
    nearest = qdot_spelling_nearest(label, words.n, words.at);
    (void)qdot_fail(QDOT_ENAME, "nothing in the scene is labelled %s", label);
    words.n = 0;
    qdot_labels_add(scene, &words);
    qdot_labels_add_applied(scene, &words);
    for (size_t i = 0; i < session->runs->n; i++)
        if (!qdot_scene_has_label(scene, session->runs->at[i].name))
            (void)qdot_vec_push(&words, session->runs->at[i].name);
    status = nearest != NULL ? qdot_hint("did you mean `%s`?", nearest)
                             : qdot_labels_hint(label, &words);
    qdot_free(words.at);
    return status;
}

/* Whether the definition, function or speed reads the state z. */
static bool
definition_reads(qdot_session *session, const qdot_name *name, const char *state, qdot_expr z)
{
    if (name->kind == QDOT_NAME_FUNCTION && qdot_function_mentions(session->pool, name, state))
        return true;
    return name->kind != QDOT_NAME_COORD && (qdot_reads_coordinate(session->pool, name->value, z) ||
                                             qdot_reads_coordinate(session->pool, name->formals, z));
}

/* Fail if a definition or a value given by `set` reads the state z. */
static qdot_status
refuse_readers(qdot_session *session, const char *state, qdot_expr z)
{
    const qdot_values *v = session->values;
    const qdot_name *name;
    qdot_text symbol = {0};
    qdot_expr reader = QDOT_NIL;
    qdot_status status;

    for (size_t i = 0; (name = qdot_names_at(session->names, i)) != NULL; i++)
        if (definition_reads(session, name, state, z)) {
            (void)qdot_fail(QDOT_EINVAL, "%s is read by `%s`", state, name->name);
            return qdot_hint("`%s` was declared at %s:%u; `undo` takes back the statements since", name->name, name->file, name->line);
        }
    for (size_t i = 0; i < v->set_symbols.n; i++)
        reader = qdot_reads_coordinate(session->pool, v->set_values.at[i], z) ? v->set_symbols.at[i] : reader;
    if (reader == QDOT_NIL)
        return qdot_pool_check(session->pool);
    status = qdot_print(session->pool, reader, QDOT_PLAIN, &symbol);
    if (status == QDOT_OK)
        status = qdot_fail(QDOT_EINVAL, "%s is read by the value of %s", state, qdot_text_str(&symbol));
    if (status == QDOT_EINVAL)
        status = qdot_hint("give %s another value first", qdot_text_str(&symbol));
    qdot_text_clear(&symbol);
    return status;
}

/* Remove a state with its rate, its start and its scale. */
static qdot_status
remove_state(qdot_session *session, const char *state, qdot_expr z)
{
    QDOT_TRY(refuse_readers(session, state, z));
    QDOT_TRY(qdot_scene_remove_state(session->scene, z));
    qdot_session_start_forget(session, z);
    qdot_scales_forget(session, z);
    qdot_names_remove(session->names, state);
    qdot_symbol_hide(session->pool, z);
    return QDOT_OK;
}

/* Forget the run or the table of this name; whether there was one. Numbers read from it keep their values. */
static bool
forget_run_or_table(qdot_session *session, const char *name)
{
    const size_t run = qdot_runs_index(session, name);

    if (run == session->runs->n)
        return qdot_row_tables_drop(session, name);
    qdot_runs_drop(session, run);
    return true;
}

static qdot_status
carry_out_remove(qdot_record *r)
{
    const qdot_name *name;
    qdot_scene *scene = r->cursor.session->scene;
    const qdot_filled *number = qdot_record_hole(r, NULL, "K");
    const char *label;

    QDOT_TRY(qdot_record_name(r, &r->parts.at[1], &label));
    for (size_t i = 0; i < KINDS; i++)
        if (strcmp(kinds[i].word, label) == 0 &&
            (number != NULL || !qdot_scene_has_label(scene, label)))
            return remove_thing_of_kind(r, number, i);
    if (number != NULL)
        return qdot_record_expected(r, number->from, "the end of the statement");
    r->cursor.error_at = r->start->start;
    name = qdot_names_declared(r->cursor.session->names, label);
    if (!qdot_scene_has_label(scene, label) && name != NULL && qdot_scene_state_of(scene, name->value) != NULL)
        return remove_state(r->cursor.session, label, name->value);
    if (!qdot_scene_has_label(scene, label))
        return forget_run_or_table(r->cursor.session, label) ? QDOT_OK : report_unknown_label(r->cursor.session, label);
    QDOT_TRY(qdot_scene_remove(scene, label));
    return give_notice_of_removed(r->cursor.session, label);
}
