/* figure-option.h -- the options of a figure, which follow its operands in any order. */
#ifndef QDOT_LANG_FIGURE_OPTION_H
#define QDOT_LANG_FIGURE_OPTION_H

#include "lang/syntax/record.h"
#include "show/figure.h"

/* Options of the whole figure: to "FILE", size W, H, keep. */
typedef struct {
    const char *path; /* NULL: not said */
    double width, height;
    bool keep;
} qdot_figure_choice;

/* Options of one panel: from A to B, range A..B, log x|y|xy, title TEXT, labels TEXT, TEXT. */
typedef struct {
    qdot_figure_range range[2];
    bool logs, log[2]; /* logs: said */
    const char *title, *labels[3];
    size_t n_labels;
} qdot_panel_choice;

/* The options as they occur in the usages of statements. */
#define QDOT_FIGURE_USAGE                                                                 \
    "[from A to B] [range A..B] [log x|y|xy] [title \"TEXT\"] [labels \"X\", ...] [size W, H] " \
    "[keep] [to \"FILE\"]"
/* Take the options among the parts [from, to) of a statement. Errors: QDOT_EINVAL. */
QDOT_MUST_CHECK qdot_status qdot_figure_option_find(qdot_record *r, const qdot_filled *from,
                                                    const qdot_filled *to, qdot_figure_choice *figure,
                                                    qdot_panel_choice *panel);
/* Whether an option begins at the token. */
bool qdot_figure_option_is(const qdot_token *token);
/* Read all options at the cursor. Errors: QDOT_ESYNTAX, QDOT_EINVAL. */
QDOT_MUST_CHECK qdot_status qdot_figure_option_read(qdot_cursor *c, qdot_figure_choice *figure,
                                                    qdot_panel_choice *panel);
/* The list of options in messages `expected ...`. */
#define QDOT_FIGURE_OPTIONS                                                              \
    "`from`, `range`, `log`, `title`, `labels`, `size`, `keep`, `to` or the end of the " \
    "statement"
/* Apply the options of a panel to it. */
void qdot_figure_option_apply(const qdot_panel_choice *choice, qdot_panel *panel);

#endif
