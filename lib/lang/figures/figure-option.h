/* figure-option.h -- the options of a figure, which stand behind its operands in any order. */
#ifndef QDOT_LANG_FIGURE_OPTION_H
#define QDOT_LANG_FIGURE_OPTION_H

#include "lang/syntax/record.h"
#include "show/figure.h"

/* Of the whole figure: to "FILE", size W, H, keep. */
typedef struct {
    const char *path; /* NULL: not said */
    double width, height;
    bool keep;
} qdot_figure_choice;

/* Of one panel: from A to B, range A..B, log x|y|xy, title TEXT, labels TEXT, TEXT. */
typedef struct {
    qdot_figure_range range[2];
    bool logs, log[2]; /* logs: said */
    const char *title, *labels[3];
    size_t n_labels;
} qdot_panel_choice;

/* The options as usage texts have them. */
#define QDOT_FIGURE_USAGE                                                                 \
    "[from A to B] [range A..B] [log x|y|xy] [title \"TEXT\"] [labels \"X\", ...] [size W, H] " \
    "[keep] [to \"FILE\"]"
/* Those among the parts [from, to) of a statement. Errors: QDOT_EINVAL. */
QDOT_MUST_CHECK qdot_status qdot_figure_option_find(qdot_record *r, const qdot_filled *from,
                                                    const qdot_filled *to, qdot_figure_choice *figure,
                                                    qdot_panel_choice *panel);
/* Whether an option begins at the token. */
bool qdot_figure_option_is(const qdot_token *token);
/* Read the options that stand here, up to something else. Errors: QDOT_ESYNTAX, QDOT_EINVAL. */
QDOT_MUST_CHECK qdot_status qdot_figure_option_read(qdot_cursor *c, qdot_figure_choice *figure,
                                                    qdot_panel_choice *panel);
/* The options, for `expected ...`. */
#define QDOT_FIGURE_OPTIONS                                                              \
    "`from`, `range`, `log`, `title`, `labels`, `size`, `keep`, `to` or the end of the " \
    "statement"
/* Put what was said of a panel into it. */
void qdot_figure_option_apply(const qdot_panel_choice *choice, qdot_panel *panel);

#endif
