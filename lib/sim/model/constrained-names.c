/* constrained-names.c -- writes the names of constraints that depend on each other. */
#include <string.h>

#include "sim/model/constrained-parts.h"
#include "sim/model/constrained.h"

/* The length of a constraint's name; if `label`, without the number of its component. */
static size_t
length_of_name(const char *name, bool label)
{
    const char *comma = label ? strrchr(name, ',') : NULL;

    return comma ? (size_t)(comma - name) : strlen(name);
}

/* Append a constraint's name: "rod", or for component 1 of a vector pin[1]; if `label`, without the component. */
static void
append_constraint_name(qdot_text *to, const char *name, size_t length, bool label)
{
    const char *comma = strrchr(name, ',');

    if (label || !comma)
        qdot_text_format(to, "%.*s", (int)length, name);
    else
        qdot_text_format(to, "%.*s[%s]", (int)(comma - name), name,
                         comma + 1 + strspn(comma + 1, " "));
}

void
qdot_constrained_name(const qdot_constraints *c, const bool *rows, qdot_text *to)
{
    enum { many = 4 };
    size_t count = 0, names = 0, of_scene = 0;

    for (size_t k = 0; k < c->m; k++) {
        count += rows[k];
        of_scene += rows[k] && c->rows[k].multiplier != QDOT_NIL;
    }
    for (int pass = 0; pass < 2; pass++) {
        const char *before = NULL;
        size_t said = 0;

        if (pass == 1)
            qdot_text_add(to, of_scene == 0 ? "the " : names == 1 ? "constraint " : "constraints ");
        for (size_t k = 0; k < c->m; k++) {
            const char *name = c->rows[k].name;
            const size_t n = length_of_name(name, count > many);

            if (!rows[k] || (before && strncmp(before, name, n + 1) == 0 && count > many))
                continue;
            before = name;
            names += pass == 0;
            if (pass == 1) {
                qdot_text_add(to, said == 0 ? "" : said + 1 == names ? " and " : ", ");
                append_constraint_name(to, name, n, count > many);
            }
            said++;
        }
    }
}

/* Append the names of dependent constraints; returns `is` or `are`, depending on their number. */
static const char *
append_dependent_names(const qdot_constraints *c, const bool *rows, qdot_text *names)
{
    size_t count = 0;

    for (size_t k = 0; k < c->m; k++)
        count += rows[k];
    if (count == 0)
        qdot_text_add(names, "constraints");
    else
        qdot_constrained_name(c, rows, names);
    return count == 1 ? "has no direction" : "stop being independent";
}

void
qdot_constrained_say_dependent(const qdot_constraints *c, const bool *rows, qdot_text *to)
{
    const char *became = append_dependent_names(c, rows, to);

    qdot_text_format(to, " %s", became);
}

qdot_status
qdot_constrained_fail_dependent(const qdot_constraints *c, const bool *rows)
{
    qdot_text names = {0};
    const char *became = append_dependent_names(c, rows, &names);

    if (qdot_text_status(&names) == QDOT_OK)
        qdot_fail(QDOT_ESINGULAR, "%.300s %s here", qdot_text_str(&names), became);
    qdot_text_clear(&names);
    return QDOT_ESINGULAR;
}

qdot_status
qdot_constrained_without_direction(const qdot_constraints *c, size_t row)
{
    bool *rows = qdot_calloc(c->m, sizeof *rows);
    qdot_status status = QDOT_ENOMEM;

    if (rows) {
        rows[row] = true;
        status = qdot_constrained_fail_dependent(c, rows);
    }
    qdot_free(rows);
    return status;
}

bool
qdot_constrained_dependent(const qdot_constraints *c, qdot_saddle *s, const size_t *row,
                           double below, bool *rows)
{
    double *part = s->w; /* s->w [n + m] used as scratch */
    bool some = false;

    memset(rows, 0, c->m * sizeof *rows);
    qdot_saddle_parts(s, below, part);
    for (size_t k = 0; k < s->m; k++)
        if (part[k] > QDOT_CONSTRAINED_PART)
            rows[row ? row[k] : k] = some = true;
    return some;
}
