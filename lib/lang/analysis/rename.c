/* rename.c -- another name in place of one that a script declares. */
#include <string.h>

#include "base/utf8.h"
#include "lang/analysis/fix.h"
#include "lang/analysis/names.h"
#include "lang/functions/builtin.h"
#include "lang/functions/quantity.h"
#include "lang/session/names.h"
#include "lang/source/source.h"
#include "lang/syntax/statement.h"

/* Whether the name is the word of a statement, a value, a function or a constant of the language. Words of options are names elsewhere,
 * as x and y. */
static bool
is_of_language(const char *name)
{
    static const char *const words[] = {"pi", "t", "true", "false", "infinity", "lambda", "and", "or", "not", "for"};

    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(name, words[i]) == 0)
            return true;
    return qdot_statement_find(name) != NULL || qdot_builtin_find(name) != NULL || qdot_quantity_find(name) != NULL;
}

/* The one name that the text is, spelled in letters; NULL with QDOT_ENAME: it is none. The caller's. */
static qdot_status
read_new_name(const char *text, char **name)
{
    qdot_source *source = NULL;
    size_t at;
    qdot_status status = qdot_source_new("", text, strlen(text), &source, &at);

    *name = NULL;
    if (status == QDOT_OK &&
        (source->tokens.n != 2 || source->tokens.at[0].kind != QDOT_TOKEN_NAME || source->tokens.at[0].length != strlen(text)))
        status = QDOT_ENAME;
    if (status == QDOT_OK) {
        *name = qdot_strdup(source->tokens.at[0].text);
        status = *name != NULL ? QDOT_OK : QDOT_ENOMEM;
    }
    qdot_source_free(source);
    return status == QDOT_OK || status == QDOT_ENOMEM
               ? status
               : qdot_fail(QDOT_ENAME, "`%.100s` is no name: a letter, then letters, digits, _", text);
}

static qdot_status
find_renameable(const qdot_analysis *a, const qdot_occurrence_list *list, size_t at, const qdot_occurrence **found)
{
    const qdot_occurrence *place = qdot_names_at_byte(list, at);
    bool label = false, other = false, declared = false;

    if (place == NULL)
        return qdot_fail(QDOT_ENAME, "no name stands here");
    for (size_t i = 0; i < list->n; i++)
        if (qdot_names_are_same(&list->at[i], place)) {
            declared = declared || list->at[i].declares;
            label = label || (list->at[i].declares && list->at[i].role == QDOT_ROLE_LABEL);
            other = other || (list->at[i].declares && list->at[i].role != QDOT_ROLE_LABEL);
        }
    if (place->role != QDOT_ROLE_LOCAL && !declared)
        return is_of_language(place->name) ? qdot_fail(QDOT_ENAME, "`%.100s` is a word of the language", place->name)
                                           : qdot_fail(QDOT_ENAME, "`%.100s` is not declared in this script", place->name);
    if (label && other)
        return qdot_fail(QDOT_ENAME, "`%.100s` is a label and the name of something else: rename one of them by hand", place->name);
    (void)a;
    *found = place;
    return QDOT_OK;
}

qdot_status
qdot_names_renameable(const qdot_analysis *a, size_t at, qdot_occurrence *found)
{
    qdot_occurrence_list list = {0};
    const qdot_occurrence *place;
    qdot_status status = qdot_names_of_source(a, a->source, &list);

    if (status == QDOT_OK)
        status = find_renameable(a, &list, at, &place);
    if (status == QDOT_OK)
        *found = *place;
    qdot_free(list.at);
    return status;
}

/* Whether the name of `place` stands in the piece. */
static bool
stands_in_piece(const qdot_occurrence_list *list, const qdot_occurrence *place, size_t piece)
{
    for (size_t i = 0; i < list->n; i++)
        if (list->at[i].piece == piece && qdot_names_are_same(&list->at[i], place))
            return true;
    return false;
}

/* Whether the new name stands for something else in the text already; an argument or index of another statement is no matter. */
static qdot_status
check_new_name(const qdot_analysis *a, const qdot_occurrence_list *list, const qdot_occurrence *place, const char *name)
{
    if (is_of_language(name))
        return qdot_fail(QDOT_ENAME, "`%.100s` is a word of the language", name);
    for (size_t i = 0; i < list->n; i++)
        if (strcmp(list->at[i].name, name) == 0 &&
            (list->at[i].role != QDOT_ROLE_LOCAL || stands_in_piece(list, place, list->at[i].piece)))
            return qdot_fail(QDOT_ENAME, "`%.100s` stands in this script already", name);
    if (qdot_names_find(a->session->names, name) != NULL || qdot_names_is_family(a->session->names, name))
        return qdot_fail(QDOT_ENAME, "`%.100s` is declared already", name);
    return QDOT_OK;
}

/* Choose the places of the name out of the list, and see that the text says the same with the new one. */
static qdot_status
choose_places(const qdot_analysis *a, const qdot_occurrence_list *list, const qdot_occurrence *place, const char *name,
              qdot_occurrence_list *places)
{
    qdot_edit_list edits = {0};
    size_t after = 0;
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < list->n; i++)
        if (qdot_names_are_same(&list->at[i], place))
            QDOT_TRY(qdot_vec_push(places, list->at[i]));
    for (size_t i = 0; i < places->n && status == QDOT_OK; i++)
        status = qdot_vec_push(&edits, ((qdot_edit){places->at[i].at, (char *)name})); /* the name is borrowed */
    if (status == QDOT_OK)
        status = qdot_fix_errors_with(a, &edits, &after);
    qdot_free(edits.at);
    QDOT_TRY(status);
    if (after > qdot_fix_errors(a))
        return qdot_fail(QDOT_ENAME, "with `%.100s` in place of `%.100s` the script would not mean the same", name, place->name);
    return QDOT_OK;
}

qdot_status
qdot_names_rename(const qdot_analysis *a, size_t at, const char *name, qdot_occurrence_list *places)
{
    qdot_occurrence_list list = {0};
    const qdot_occurrence *place;
    char *spelled = NULL;
    qdot_status status = read_new_name(name, &spelled);

    if (status == QDOT_OK)
        status = qdot_names_of_source(a, a->source, &list);
    if (status == QDOT_OK)
        status = find_renameable(a, &list, at, &place);
    if (status == QDOT_OK && strcmp(spelled, place->name) != 0)
        status = check_new_name(a, &list, place, spelled);
    if (status == QDOT_OK)
        status = choose_places(a, &list, place, name, places);
    qdot_free(list.at);
    qdot_free(spelled);
    return status;
}
