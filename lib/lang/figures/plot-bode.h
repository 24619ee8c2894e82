/* plot-bode.h -- `plot bode G, ... [for w = A..B]`: magnitude in decibels and phase in degrees over the angular frequency, in two
 * panels; G is a quotient of polynomials in s.
 *
 * Tests  tests/script/linear/bode.sh, tests/bad/linear/bode-*.lag
 */
#ifndef QDOT_LANG_PLOT_BODE_H
#define QDOT_LANG_PLOT_BODE_H

#include "lang/figures/plot-parts.h"

/* Whether the panel is a Bode diagram. */
bool qdot_plot_bode_is(const qdot_plot_said *said);
/* Read the quotients and the options; compute the first points of the curves. Where no range of
 * frequencies is given, it holds all zeros and poles and a decade on both sides. */
QDOT_MUST_CHECK qdot_status qdot_plot_bode(const qdot_plot_said *said, qdot_plot_panel *magnitude, qdot_plot_panel *phase,
                                           qdot_figure_choice *figure);

#endif
