/* handlers.h -- the handlers of statements that parse their own tokens (statement.def). */
#ifndef QDOT_LANG_HANDLERS_H
#define QDOT_LANG_HANDLERS_H

#include "lang/language/cursor.h"

qdot_status qdot_table_statement(qdot_cursor *c);
qdot_status qdot_plot_statement(qdot_cursor *c);
qdot_status qdot_table_save(qdot_cursor *c);

#endif
