/* script.h -- carries out texts and files of statements.
 *
 * Tests  tests/script/, tests/bad/, tests/lang/session/test_session.c
 */
#ifndef QDOT_LANG_SCRIPT_H
#define QDOT_LANG_SCRIPT_H

#include "lang/session/parts.h"
#include "lang/workbench/look.h"

/* Carry out a text. `name` is what errors call it ("a.lag", "-e", "prompt"). Stops at the
 * first error, which is reported on err (and as JSON on out). Returns the exit status so far: 0, 1 a
 * statement failed or a check was refuted, 2 a syntax error. */
int qdot_script_run_text(qdot_session *session, const char *name, const char *text,
                         size_t length);
/* As qdot_script_run_text, for a part of an input: errors count its lines on from the `before` lines that precede it. */
int qdot_script_run_part(qdot_session *session, const char *name, uint32_t before, const char *text, size_t length);
/* As qdot_script_run_text, for a file ("-": standard input); an error if it is unreadable, a
 * directory, or not UTF-8. */
int qdot_script_run_file(qdot_session *session, const char *path);

/* Whether the text typed so far at the prompt is incomplete: it has an open bracket or ends in a backslash. */
bool qdot_script_is_incomplete(const char *text, size_t length);

/* For the prompt: whether the text runs a scene or another script, whose answers a person wants to
 * see as they come. */
bool qdot_script_takes_long(const char *text, size_t length);

/* The value of the error position if an included file has reported the error already. */
#define QDOT_SCRIPT_REPORTED SIZE_MAX

/* Lex and carry out a text, reporting the first error; `before`: lines of the same input that precede it. */
QDOT_MUST_CHECK qdot_status qdot_script_carry_out(qdot_session *session, const char *name, uint32_t before,
                                                  const char *text, size_t length);
/* The same from a file; *opened: whether its text could be read (errors before that
 * are not reported yet). */
QDOT_MUST_CHECK qdot_status qdot_script_carry_out_file(qdot_session *session,
                                                       const char *path, bool *opened);


/* As qdot_script_carry_out, but every statement is only parsed by its usage; its loop has no passes, nothing is evaluated
 * beyond what decides how an expression is read, no file is opened. */
QDOT_MUST_CHECK qdot_status qdot_script_look_at(qdot_session *session, const char *name, uint32_t before, const char *text,
                                                size_t length, const qdot_look *look);

#endif
