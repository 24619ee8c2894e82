/* paper.c -- finds the usual size of printing paper from the country of the locale. */
#include "base/paper.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* The locale that determines the paper: the first of LC_ALL, LC_PAPER, LANG that is set and not empty, else "C". */
static const char *
get_paper_locale(void)
{
    static const char *const variables[] = {"LC_ALL", "LC_PAPER", "LANG"};

    for (size_t i = 0; i < sizeof variables / sizeof *variables; i++) {
        const char *value = getenv(variables[i]);

        if (value != NULL && value[0] != '\0')
            return value;
    }
    return "C";
}

const char *
qdot_paper_name(void)
{
    static const char letter[] = "BZ CA CL CO CR GT MX NI PA PH PR SV US VE";
    const char *country = strchr(get_paper_locale(), '_'); /* the country is what follows `_`, as in en_US.UTF-8 */

    for (const char *c = letter; country != NULL && c < letter + sizeof letter; c += 3)
        if (strncmp(country + 1, c, 2) == 0)
            return "letter";
    return "A4";
}
