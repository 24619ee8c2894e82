/* paper.h -- the usual size of printing paper in the country where the user lives. */
#ifndef QDOT_BASE_PAPER_H
#define QDOT_BASE_PAPER_H

/* "letter" if the locale of LC_ALL, LC_PAPER or LANG, the first of these that is set, names a country that uses US
 * letter; otherwise "A4".
 *
 * Source  Unicode CLDR, supplemental data, paperSize
 * Tests   tests/script/files/report.sh
 */
const char *qdot_paper_name(void);

#endif
