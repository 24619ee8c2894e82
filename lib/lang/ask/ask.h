/* ask.h -- answers an expression that was entered as a statement. */
#ifndef QDOT_LANG_ASK_H
#define QDOT_LANG_ASK_H

#include "lang/answer/sheet.h"
#include "lang/language/cursor.h"

/* `name = value`; of a list each member, `eom[theta]`, `solve(...)[1]`; a tensor by its components; numbers
 * of runs with their errors. over: the LIST of coordinates its entries go by, or nil. */
QDOT_MUST_CHECK qdot_status qdot_ask_answer(qdot_session *session, const char *name,
                                            qdot_expr value, qdot_expr over);

/* Append a point as [x = 1.25 ± 3e-17, y = 2]; numbers from runs are given with their errors. */
QDOT_MUST_CHECK qdot_status qdot_ask_print_point(qdot_sheet *sheet, qdot_expr equations);

/* Answer each member of a LIST, under the name of that member. */
QDOT_MUST_CHECK qdot_status qdot_ask_list(qdot_session *session, const char *name, qdot_expr list,
                                          qdot_expr over);

/* Answer the expression from the cursor to its end. */
QDOT_MUST_CHECK qdot_status qdot_ask_expression(qdot_cursor *c);
/* Answer a claim such as a == b that was typed without the word `check`, from the cursor to its end. */
QDOT_MUST_CHECK qdot_status qdot_check(qdot_cursor *c);

#endif
