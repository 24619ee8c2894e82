/* statement.h -- the statements of the language: one table that parses, completes and
 * helps.
 *
 * A statement is a row of words.c. Its handler gets a cursor behind the statement's word,
 * reads its operands, checks that nothing is left (qdot_cursor_expect_end) and only then
 * acts, so that a statement that fails changes nothing. A trailing `for` and blocks are
 * the loop's matter (statement.c): a handler sees each pass as a statement of its own
 * that ends before `for`.
 *
 * Tests  tests/script/, tests/bad/, tests/lang/test_session.c
 */
#ifndef QDOT_LANG_STATEMENT_H
#define QDOT_LANG_STATEMENT_H

#include "lang/language/read.h"

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

/* An error that has been reported already (by an included file) has this place. */
#define QDOT_STATEMENT_REPORTED SIZE_MAX

/* Lex and carry out a text, reporting the first error. */
QDOT_MUST_CHECK qdot_status qdot_statement_run_text(qdot_session *session,
                                                    const char *name, const char *text,
                                                    size_t length);
/* The same from a file; *opened: whether its text could be read (errors before that
 * are not reported yet). */
QDOT_MUST_CHECK qdot_status qdot_statement_run_file(qdot_session *session,
                                                    const char *path, bool *opened);

/* --- loops: `k = a..b, j = [1, 2, 5]` ----------------------------------------------- */

typedef struct {
    char *name;
    const qdot_token *behind; /* the token behind its range */
    bool listed;              /* values from a list, else at..last */
    long at, last;
    qdot_vec(qdot_expr) values;
    size_t next;
} qdot_loop_index;

typedef struct {
    qdot_session *session;
    const qdot_source *source;
    const qdot_token *clause; /* the first token behind `for` */
    qdot_vec(
        qdot_loop_index) indices; /* outermost first; each is bound in session->names */
    size_t error_at;
    bool open; /* counted in session->loops */
} qdot_loop;

enum { QDOT_LOOP_PASSES = 10000000 }; /* the most of one index */

/* Bind the indices to the first pass, then to the next; *more: there is such a pass. A
 * range may depend on the indices before it. After an error or the last pass nothing
 * is bound. */
QDOT_MUST_CHECK qdot_status qdot_loop_begin(qdot_loop *loop, const qdot_cursor *c,
                                            bool *more);
QDOT_MUST_CHECK qdot_status qdot_loop_next(qdot_loop *loop, bool *more);
/* Unbind what is bound and free. */
void qdot_loop_end(qdot_loop *loop);

/* --- shared by handlers ------------------------------------------------------------- */

/* Take a declared name's file and line from the token at `start`. */
void qdot_statement_place(const qdot_cursor *c, const qdot_token *start,
                          qdot_name *entry);
/* The source text of the tokens [from, to), spaces as a person would set them; an index
 * of a loop under way is replaced by its value. */
void qdot_statement_text(qdot_session *session, const qdot_token *from,
                         const qdot_token *to, qdot_text *out);
/* An option that may be given once: QDOT_EINVAL if `given`, at the option's word. */
QDOT_MUST_CHECK qdot_status qdot_statement_once(qdot_cursor *c, const char *word,
                                                bool given);

/* --- handlers, by file -------------------------------------------------------------- */

/* declare.c */
qdot_status qdot_declare_param(qdot_cursor *c);
qdot_status qdot_declare_coord(qdot_cursor *c);
qdot_status qdot_declare_function(qdot_cursor *c);
qdot_status qdot_declare_assume(qdot_cursor *c);
qdot_status qdot_declare_definition(qdot_cursor *c); /* at the name */
/* furnish.c */
qdot_status qdot_furnish_particle(qdot_cursor *c);
qdot_status qdot_furnish_body(qdot_cursor *c);
qdot_status qdot_furnish_gravity(qdot_cursor *c);
qdot_status qdot_furnish_potential(qdot_cursor *c);
qdot_status qdot_furnish_spring(qdot_cursor *c);
qdot_status qdot_furnish_damper(qdot_cursor *c);
qdot_status qdot_furnish_dissipation(qdot_cursor *c);
qdot_status qdot_furnish_force(qdot_cursor *c);
qdot_status qdot_furnish_torque(qdot_cursor *c);
qdot_status qdot_furnish_lagrangian(qdot_cursor *c);
qdot_status qdot_furnish_constraint(qdot_cursor *c);
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
/* number.c, draw.c */
qdot_status qdot_number_set(qdot_cursor *c);
qdot_status qdot_number_start(qdot_cursor *c);
qdot_status qdot_number_run(qdot_cursor *c);
qdot_status qdot_number_plan(qdot_cursor *c);
qdot_status qdot_number_race(qdot_cursor *c);
qdot_status qdot_draw_table(qdot_cursor *c);
qdot_status qdot_draw_plot(qdot_cursor *c);
qdot_status qdot_workprecision_statement(qdot_cursor *c);
qdot_status qdot_draw_save(qdot_cursor *c);
/* undo.c */
qdot_status qdot_undo_back(qdot_cursor *c);
qdot_status qdot_undo_again(qdot_cursor *c);
/* workbench.c */
qdot_status qdot_workbench_reset(qdot_cursor *c);
qdot_status qdot_workbench_include(qdot_cursor *c);
qdot_status qdot_workbench_style(qdot_cursor *c);
qdot_status qdot_workbench_timing(qdot_cursor *c);
qdot_status qdot_workbench_quit(qdot_cursor *c);
/* help.c */
qdot_status qdot_help(qdot_cursor *c);

#endif
