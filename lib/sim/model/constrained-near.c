/* constrained-near.c -- how independent constraints are at a place, and which are not. */
#include <math.h>
#include <string.h>

#include "sim/model/constrained-parts.h"

/* The length of a name, without its component if `label`. */
static size_t
length_of_name(const char *name, bool label)
{
    const char *comma = label ? strrchr(name, ',') : NULL;

    return comma ? (size_t)(comma - name) : strlen(name);
}

/* "rod", and of a vector constraint's component "pin, 1": pin[1]. Without it if `label`. */
static void
add_name(qdot_text *to, const char *name, size_t length, bool label)
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
    size_t count = 0, names = 0;

    for (size_t k = 0; k < c->m; k++)
        count += rows[k];
    for (int pass = 0; pass < 2; pass++) {
        const char *before = NULL;
        size_t said = 0;

        if (pass == 1)
            qdot_text_add(to, names == 1 ? "constraint " : "constraints ");
        for (size_t k = 0; k < c->m; k++) {
            const char *name = c->rows[k].name;
            const size_t n = length_of_name(name, count > many);

            if (!rows[k] || (before && strncmp(before, name, n + 1) == 0 && count > many))
                continue;
            before = name;
            names += pass == 0;
            if (pass == 1) {
                qdot_text_add(to, said == 0 ? "" : said + 1 == names ? " and " : ", ");
                add_name(to, name, n, count > many);
            }
            said++;
        }
    }
}

qdot_status
qdot_constrained_without_direction(const qdot_constraints *c, size_t row)
{
    qdot_text name = {0};

    add_name(&name, c->rows[row].name, strlen(c->rows[row].name), false);
    if (qdot_text_status(&name) == QDOT_OK)
        qdot_fail(QDOT_ESINGULAR, "constraint %.300s has no direction here",
                  qdot_text_str(&name));
    qdot_text_clear(&name);
    return QDOT_ESINGULAR;
}

size_t
qdot_constrained_dependent(const qdot_constraints *c, qdot_saddle *s, const size_t *row,
                           double below, qdot_text *names)
{
    double *part = s->w; /* scratch of n + m */
    bool *in = qdot_calloc(c->m + 1, sizeof *in);
    size_t count = 0;

    if (!in)
        return 0;
    qdot_saddle_parts(s, below, part);
    for (size_t k = 0; k < s->m; k++)
        if (part[k] > QDOT_CONSTRAINED_PART) {
            in[row ? row[k] : k] = true;
            count++;
        }
    qdot_constrained_name(c, in, names);
    qdot_free(in);
    return count;
}

qdot_status
qdot_constrained_look_beside(const qdot_plan *plan, qdot_saddle *s, const size_t *row,
                             const double *in)
{
    static const double beside = 1e-3;
    const qdot_constraints *c = plan->constraints;
    const size_t inputs = 2 * plan->n + 1, outputs = qdot_tape_outputs(c->metric);
    double *room = qdot_calloc(inputs + outputs + qdot_tape_work(c->metric) + 1, sizeof *room);
    double *out = room + inputs;
    unsigned long seed = 12345;

    if (!room)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < inputs; i++) {
        seed = seed * 1103515245 + 12345;
        room[i] = in[i] * (1 + beside * (1 + (double)(seed >> 16 & 0x7fff) / 0x8000));
    }
    qdot_tape_eval(c->metric, room, out, out + outputs);
    for (size_t k = 0, at = 0; k < c->n_slopes; k++) {
        const double slope = out[c->n_masses + k];

        while (at < s->m && (row ? row[at] : at) < c->slopes[k].row)
            at++;
        if (at < s->m && (row ? row[at] : at) == c->slopes[k].row && isfinite(slope))
            s->widest[at] += slope * slope;
    }
    qdot_free(room);
    return QDOT_OK;
}

bool
qdot_constrained_near(qdot_constrained *h, double t, const double *y, qdot_text *names)
{
    static const double near = 1e-3;
    qdot_constrained_level *all = h->at[QDOT_ACCELERATION];
    size_t failed;
    qdot_status status;

    qdot_constrained_load(h, t, y);
    qdot_constrained_metric(h, all);
    status = qdot_saddle_factor_fully(&all->saddle, &failed);
    if (status == QDOT_EINTR)
        return false;
    if (status == QDOT_OK ? all->saddle.rank == 0 || all->saddle.quality > near
                          : failed < h->plan->n)
        return false;
    return qdot_constrained_dependent(h->c, &all->saddle, all->row, near, names) > 0;
}

double
qdot_constrained_independence(qdot_constrained *h, double t, const double *y)
{
    qdot_constrained_level *all = h->at[QDOT_ACCELERATION];

    qdot_constrained_load(h, t, y);
    qdot_constrained_metric(h, all);
    return qdot_saddle_independence(&all->saddle);
}
