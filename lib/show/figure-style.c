/* figure-style.c -- how the curves of a panel differ: in colours, dashes, dots and marks. */

#include "show/figure-parts.h"

/* Okabe and Ito's palette, told apart by eyes that do not see all colours, its yellow darkened; then six more. Those
 * with a name can be asked for: any two of them stay apart. On a terminal its own colour that is nearest. */
static const struct {
    const char *rgb, *name, *terminal;
} colours[] = {{"#0072b2", "blue", "34"},   {"#d55e00", "red", "31"},    {"#009e73", "green", "32"},
               {"#cc79a7", "pink", "35"},   {"#56b4e9", "cyan", "36"},   {"#e69f00", "orange", "33"},
               {"#000000", "black", "39"},  {"#8a6d00", NULL, "34"},     {"#7f7f7f", NULL, "31"},
               {"#332288", NULL, "32"},     {"#882255", NULL, "35"},     {"#6b8e23", NULL, "36"},
               {"#44aa99", NULL, "33"},     {"#aa4499", NULL, "39"}};

/* Dash patterns: several curves of a panel must be distinguishable in black and white, too. */
static const char *const dashes[] = {"1", "(12,5)", "(3,4)", "(12,4,3,4)", "(12,4,3,4,3,4)"};

enum { COLOURS = sizeof colours / sizeof *colours, DASHES = sizeof dashes / sizeof *dashes };

const char *
qdot_figure_colour_name(size_t i)
{
    return i < COLOURS ? colours[i].name : NULL;
}

static bool
is_chosen_colour(const qdot_panel *panel, size_t colour)
{
    for (size_t k = 0; k < panel->n_colours; k++)
        if (panel->colours[k] == colour)
            return true;
    return false;
}

/* The index in `colours` of curve k's colour: the chosen one, or the next that no curve has been given. */
static size_t
index_of_colour(const qdot_panel *panel, size_t k)
{
    const size_t look = panel->curves[k].look;
    size_t left = k - panel->n_colours;

    if (k < panel->n_colours)
        return panel->colours[k];
    for (size_t i = 0; i < COLOURS && panel->n_colours > 0 && look == 0; i++)
        if (!is_chosen_colour(panel, i) && left-- == 0)
            return i;
    return (look > 0 ? look - 1 : k) % COLOURS;
}

const char *
qdot_figure_terminal_colour(const qdot_panel *panel, size_t k)
{
    return colours[index_of_colour(panel, k)].terminal;
}

qdot_figure_style
qdot_figure_style_of(const qdot_panel *panel, size_t k)
{
    const qdot_curve *curve = &panel->curves[k];
    const bool alone = curve->rows == 1 || curve->points;
    const size_t look = curve->look > 0 ? curve->look - 1 : k;
    qdot_figure_style s = {.look = look, .colour = colours[index_of_colour(panel, k)].rgb, .dash = NULL};

    s.line = !alone && (!panel->points || panel->lines);
    s.dots = !alone && panel->points;
    s.marks = alone || (panel->marks && !panel->points);
    if ((panel->n > 1 || curve->look > 0) && s.line && !s.marks)
        s.dash = dashes[look % DASHES];
    return s;
}
