/* statement.h -- the statements of the language: one table that parses, completes and
 * helps.
 *
 * A statement is a row of statement.c. Its handler gets a cursor behind the statement's word,
 * reads its operands, checks that nothing is left (qdot_cursor_expect_end) and only then
 * acts, so that a statement that fails changes nothing. A trailing `for` and blocks are
 * the matter of script.c: a handler sees each pass as a statement of its own
 * that ends before `for`.
 *
 * Tests  tests/script/, tests/bad/, tests/lang/test_session.c
 */
#ifndef QDOT_LANG_STATEMENT_H
#define QDOT_LANG_STATEMENT_H

#include "lang/language/cursor.h"

typedef struct {
    const char *word, *group;
    const char *usage, *summary, *example;
    qdot_status (*run)(qdot_cursor *c); /* NULL: not built yet */
    bool alone; /* a value of the language that as a whole statement says more */
} qdot_statement;

/* Row of a word, NULL if there is none; row i, NULL past the end. Rows of a group are
 * together. */
const qdot_statement *qdot_statement_find(const char *word);
const qdot_statement *qdot_statement_at(size_t i);
/* Whether it declares a scene. */
bool qdot_statement_declares(const qdot_statement *row);

/* --- handlers, by file -------------------------------------------------------------- */

/* declare.c, declare-function.c */
qdot_status qdot_declare_param(qdot_cursor *c);
qdot_status qdot_declare_coord(qdot_cursor *c);
qdot_status qdot_declare_function(qdot_cursor *c);
qdot_status qdot_declare_assume(qdot_cursor *c);
qdot_status qdot_declare_definition(qdot_cursor *c); /* at the name */
/* objects.c */
qdot_status qdot_object_particle(qdot_cursor *c);
qdot_status qdot_object_body(qdot_cursor *c);
qdot_status qdot_object_gravity(qdot_cursor *c);
qdot_status qdot_object_potential(qdot_cursor *c);
qdot_status qdot_object_spring(qdot_cursor *c);
qdot_status qdot_object_damper(qdot_cursor *c);
qdot_status qdot_object_dissipation(qdot_cursor *c);
qdot_status qdot_object_force(qdot_cursor *c);
qdot_status qdot_object_torque(qdot_cursor *c);
qdot_status qdot_object_lagrangian(qdot_cursor *c);
qdot_status qdot_object_constraint(qdot_cursor *c);
/* remove.c */
qdot_status qdot_remove(qdot_cursor *c);
/* ask.c, check.c, derive.c */
qdot_status qdot_ask_expression(qdot_cursor *c); /* at its first token */
qdot_status qdot_ask_print(qdot_cursor *c);
qdot_status qdot_ask_show(qdot_cursor *c);
qdot_status qdot_ask_vars(qdot_cursor *c);
qdot_status qdot_ask_scene(qdot_cursor *c);
qdot_status qdot_ask_forces(qdot_cursor *c);
qdot_status qdot_ask_dof(qdot_cursor *c);
qdot_status qdot_ask_cyclic(qdot_cursor *c);
qdot_status qdot_check(qdot_cursor *c);
qdot_status qdot_derive_all(qdot_cursor *c);
/* constraints.c */
qdot_status qdot_ask_reactions(qdot_cursor *c);
/* equilibria.c */
qdot_status qdot_equilibria_all(qdot_cursor *c);
qdot_status qdot_equilibria_modes(qdot_cursor *c);
/* event.c */
qdot_status qdot_event_declare(qdot_cursor *c);
qdot_status qdot_event_list(qdot_cursor *c);
/* set.c, run.c, race.c, table.c, plot.c, workprecision.c */
qdot_status qdot_set_values(qdot_cursor *c);
qdot_status qdot_set_start(qdot_cursor *c);
qdot_status qdot_run_statement(qdot_cursor *c);
qdot_status qdot_run_plan_statement(qdot_cursor *c);
qdot_status qdot_race_statement(qdot_cursor *c);
qdot_status qdot_table_statement(qdot_cursor *c);
qdot_status qdot_plot_statement(qdot_cursor *c);
qdot_status qdot_workprecision_statement(qdot_cursor *c);
qdot_status qdot_table_save(qdot_cursor *c);
/* undo.c */
qdot_status qdot_undo_back(qdot_cursor *c);
qdot_status qdot_undo_again(qdot_cursor *c);
/* reset.c, settings.c */
qdot_status qdot_reset(qdot_cursor *c);
qdot_status qdot_settings_include(qdot_cursor *c);
qdot_status qdot_settings_style(qdot_cursor *c);
qdot_status qdot_settings_timing(qdot_cursor *c);
qdot_status qdot_settings_quit(qdot_cursor *c);
/* help.c */
qdot_status qdot_help(qdot_cursor *c);

#endif
