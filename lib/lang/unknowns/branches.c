/* branches.c -- answers with branches of solutions, as table rows and in words: their extent and stability. */
#include "lang/unknowns/branches.h"

#include <math.h>
#include <stdio.h>

#include <gsl/gsl_poly.h>

#include "base/number-text.h"
#include "lang/answer/table-answer.h"
#include "lang/answer/write.h"
#include "lang/session/output.h"
#include "lang/session/row-tables.h"

enum { SHOWN_DIGITS = 6 }; /* significant digits of values in a table */
/* Of the size of a coordinate: below, it is 0 in words; an error is none beside it. Digits of places in
 * words. */
static const double small = 1e-9, nothing = 1e-20, digits = 5e-7;
/* changes smaller than this, relative to the sizes of the coordinates, are not mentioned in the text */
static const double tiny = 1e-5;

static const char *
name_of_quantity(const qdot_branches *b, size_t i)
{
    return b->names[i];
}

static const char *
unit_of_quantity(const qdot_branches *b, size_t i)
{
    return b->units != NULL ? b->units[i] : NULL;
}

/* --- tables of branches -------------------------------------------------------------------- */

static qdot_status
fill_branch_table(const qdot_branches *b, qdot_row_table *t)
{
    const size_t n = b->found->n, k = b->n_columns;

    for (size_t i = 0; i < b->found->branches.n; i++) {
        const qdot_branch *branch = &b->found->branches.at[i];

        for (size_t j = 0; j < branch->n; j++) {
            const double *y = branch->y + j * b->found->width;
            double *row;

            QDOT_TRY(qdot_row_table_add(t));
            row = t->values + (t->rows - 1) * t->n;
            row[0] = (double)i + 1;
            row[1] = y[n];
            for (size_t q = 0; q < k; q++)
                row[QDOT_BRANCH_BEFORE + q] = y[b->columns[q]];
            if (branch->stability[j] != QDOT_STABILITY_UNDECIDED)
                row[QDOT_BRANCH_BEFORE + k] = branch->stability[j] != QDOT_UNSTABLE;
            if (branch->mark[j] > 0)
                row[QDOT_BRANCH_BEFORE + k + 1] = (double)branch->mark[j];
        }
    }
    return QDOT_OK;
}

static qdot_status
fill_bifurcation_table(const qdot_branches *b, qdot_row_table *t)
{
    const size_t n = b->found->n;

    for (size_t i = 0; i < b->found->bifurcations.n; i++) {
        const qdot_bifurcation *one = &b->found->bifurcations.at[i];
        double *row, *error;

        QDOT_TRY(qdot_row_table_add(t));
        row = t->values + (t->rows - 1) * t->n;
        error = t->errors + (t->rows - 1) * t->n;
        for (size_t q = 0; q < t->n; q++) {
            row[q] = one->y[q == 0 ? n : b->columns[q - 1]];
            error[q] = one->error[q == 0 ? n : b->columns[q - 1]];
        }
        t->reasons[t->rows - 1] = qdot_strdup(qdot_bifurcation_name(one->kind));
        if (t->reasons[t->rows - 1] == NULL)
            return QDOT_ENOMEM;
    }
    return QDOT_OK;
}

qdot_status
qdot_branches_keep(qdot_session *session, const qdot_branches *b, const char *name,
                   const char *marks)
{
    const size_t k = b->n_columns, n = k + QDOT_BRANCH_BEFORE + QDOT_BRANCH_BEHIND;
    const char **labels = qdot_calloc(n, sizeof *labels);
    qdot_row_table *all, *points;
    qdot_status status = QDOT_OK;

    if (labels == NULL)
        return QDOT_ENOMEM;
    labels[0] = "branch";
    labels[1] = name_of_quantity(b, b->found->n);
    for (size_t q = 0; q < k; q++)
        labels[QDOT_BRANCH_BEFORE + q] = name_of_quantity(b, b->columns[q]);
    labels[QDOT_BRANCH_BEFORE + k] = "stable";
    labels[QDOT_BRANCH_BEFORE + k + 1] = "bifurcation";
    all = qdot_row_table_new(name, n, n, labels);
    points = qdot_row_table_new(marks, 0, k + 1, labels + 1);
    qdot_free(labels);
    if (all == NULL || points == NULL)
        status = QDOT_ENOMEM;
    for (size_t q = 0; q <= k && status == QDOT_OK; q++) {
        const char *unit = unit_of_quantity(b, q == 0 ? b->found->n : b->columns[q - 1]);

        if (unit != NULL)
            status = qdot_row_table_set_unit(all, 1 + q, unit);
        if (unit != NULL && status == QDOT_OK)
            status = qdot_row_table_set_unit(points, q, unit);
    }
    if (status == QDOT_OK)
        status = fill_branch_table(b, all);
    if (status == QDOT_OK)
        status = fill_bifurcation_table(b, points);
    if (status != QDOT_OK) {
        qdot_row_table_release(all);
        qdot_row_table_release(points);
        return status;
    }
    points->note = "type";
    points->uses++;
    all->marks = points;
    all->drawn = b->n_drawn;
    status = qdot_row_tables_keep(session, points);
    if (status != QDOT_OK) {
        qdot_row_table_release(all);
        return status;
    }
    return qdot_row_tables_keep(session, all);
}

/* --- branches as JSON ---------------------------------------------------------------------- */

/* Set the columns for p and the unknowns of points y, which are `stride` numbers apart: columns [1
 * + b->n_columns]. */
static void
fill_columns(const qdot_branches *b, const double *y, size_t stride, qdot_table_column *columns)
{
    for (size_t q = 0; q <= b->n_columns; q++) {
        const size_t k = q == 0 ? b->found->n : b->columns[q - 1];

        columns[q] = (qdot_table_column){
            .name = name_of_quantity(b, k), .unit = unit_of_quantity(b, k), .digits = SHOWN_DIGITS, .values = y + k, .stride = stride};
    }
}

/* Write the points of branch i as JSON; columns [2 + b->n_columns] are work space. */
static qdot_status
write_branch_as_json(qdot_session *session, const qdot_branches *b, size_t i, qdot_table_column *columns)
{
    const qdot_branch *branch = &b->found->branches.at[i];
    double *stable = qdot_calloc(branch->n + 1, sizeof *stable);
    qdot_text name = {0};
    qdot_status status = stable != NULL ? QDOT_OK : QDOT_ENOMEM;

    for (size_t j = 0; j < branch->n && status == QDOT_OK; j++)
        stable[j] = branch->stability[j] == QDOT_STABILITY_UNDECIDED ? NAN
                    : branch->stability[j] == QDOT_UNSTABLE          ? 0
                                                                     : 1;
    fill_columns(b, branch->y, b->found->width, columns);
    columns[1 + b->n_columns] =
        (qdot_table_column){.name = "stable", .kind = QDOT_CELL_FLAG, .field = "stable", .values = stable};
    qdot_text_format(&name, "branch[%zu]", i + 1);
    if (status == QDOT_OK)
        status = qdot_text_status(&name);
    if (status == QDOT_OK) {
        const qdot_dataset t = {
            .name = qdot_text_str(&name), .n = 2 + b->n_columns, .rows = branch->n, .columns = columns};

        status = qdot_answer_rows(session, "continue", &t);
    }
    qdot_text_clear(&name);
    qdot_free(stable);
    return status;
}

static qdot_status
write_bifurcations_as_json(qdot_session *session, const qdot_branches *b, qdot_table_column *columns)
{
    qdot_dataset t = {.name = "bifurcation"};
    qdot_status status;

    columns[0] = (qdot_table_column){.name = "type", .kind = QDOT_CELL_TEXT, .field = "type"};
    fill_columns(b, NULL, 0, columns + 1);
    status = qdot_table_begin(&t, 2 + b->n_columns, columns);
    for (size_t i = 0; i < b->found->bifurcations.n && status == QDOT_OK; i++) {
        const qdot_bifurcation *one = &b->found->bifurcations.at[i];

        qdot_table_add_text(&t, qdot_bifurcation_name(one->kind));
        qdot_table_add_number(&t, one->y[b->found->n], NAN);
        for (size_t q = 0; q < b->n_columns; q++)
            qdot_table_add_number(&t, one->y[b->columns[q]], NAN);
    }
    if (status == QDOT_OK)
        status = qdot_answer_rows(session, "continue", &t);
    qdot_table_clear(&t);
    return status;
}

static qdot_status
answer_branches_as_json(qdot_session *session, const qdot_branches *b)
{
    qdot_table_column *columns = qdot_calloc(2 + b->n_columns, sizeof *columns);
    qdot_status status = columns != NULL ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < b->found->branches.n && status == QDOT_OK; i++)
        status = write_branch_as_json(session, b, i, columns);
    if (status == QDOT_OK)
        status = write_bifurcations_as_json(session, b, columns);
    if (status == QDOT_OK && !b->orbits) {
        const size_t stride = b->found->n + 1;
        const qdot_dataset t = {.name = "not followed",
                              .n = 1 + b->n_columns,
                              .rows = b->found->left.n / stride,
                              .columns = columns};

        fill_columns(b, b->found->left.at, stride, columns);
        status = qdot_answer_rows(session, "continue", &t);
    }
    qdot_free(columns);
    return status;
}

/* --- branches in words --------------------------------------------------------------------- */

static void
write_rounded_value(const qdot_branches *b, size_t i, double v, qdot_text *out)
{
    const double size = b->found->size[i];

    if (fabs(v) < small * size)
        v = 0;
    qdot_number_text(out, v, digits * fmax(fabs(v), 1e-3 * size));
}

/* The distance between points j and j + 1 of a branch, each unknown and p relative to its size. */
static double
distance_to_next_point(const qdot_branches *b, const qdot_branch *branch, size_t j)
{
    const double *y = branch->y + j * b->found->width, *z = y + b->found->width;
    double sum = 0;

    for (size_t i = 0; i <= b->found->n; i++)
        if (b->found->size[i] > 0)
            sum += pow((z[i] - y[i]) / b->found->size[i], 2);
    return sqrt(sum);
}

/* The extremum of unknown i, a maximum for sign 1, a minimum for -1, beside point j, at which it is farthest of the
 * points k ... end: that of the polynomial of the length along the branch through up to five points. */
static double
extremum_beside_point(const qdot_branches *b, const qdot_branch *branch, size_t k, size_t end, size_t j, size_t i,
                      int sign)
{
    const size_t from = j > k + 2 ? j - 2 : k, to = j + 2 < end ? j + 2 : end, n = to - from + 1;
    double s[5], v[5], c[5], low, high;

    for (size_t l = from; l <= to; l++) {
        const double step = l > from ? distance_to_next_point(b, branch, l - 1) : 0;

        s[l - from] = l > from ? s[l - 1 - from] + step : 0;
        v[l - from] = branch->y[l * b->found->width + i];
        if (l > from && !(step > 0))
            return branch->y[j * b->found->width + i];
    }
    gsl_poly_dd_init(c, s, v, n);
    low = s[j - 1 - from];
    high = s[j + 1 - from];
    for (int halvings = 0; halvings < 60; halvings++) {
        const double third = (high - low) / 3;
        const double left = gsl_poly_dd_eval(c, s, n, low + third);
        const double right = gsl_poly_dd_eval(c, s, n, high - third);

        if (sign * left < sign * right)
            low += third;
        else
            high -= third;
    }
    return gsl_poly_dd_eval(c, s, n, 0.5 * (low + high));
}

/* The value of unknown i between points k ... end of a branch that is farthest outside the range of its
 * end values. */
static double
farthest_value_outside_ends(const qdot_branches *b, const qdot_branch *branch, size_t k, size_t end, size_t i)
{
    const size_t m = b->found->width;
    const double first = branch->y[k * m + i], last = branch->y[end * m + i];
    double most = tiny * b->found->size[i];
    size_t at = k;

    for (size_t j = k + 1; j < end; j++) {
        const double v = branch->y[j * m + i],
                     beyond = fmax(v - fmax(first, last), fmin(first, last) - v);

        if (beyond > most) {
            most = beyond;
            at = j;
        }
    }
    if (at == k)
        return first;
    return extremum_beside_point(b, branch, k, end, at, i, branch->y[at * m + i] > first ? 1 : -1);
}

/* Write a range of values: `0..3.132`; `0..0.577..0` if it goes via `turn`; a single number if constant. */
static void
write_range(const qdot_branches *b, size_t i, const double *from, const double *to, double turn,
            qdot_text *out)
{
    const bool beyond = turn < fmin(from[i], to[i]) || turn > fmax(from[i], to[i]);

    write_rounded_value(b, i, from[i], out);
    if (beyond) {
        qdot_text_add(out, "..");
        write_rounded_value(b, i, turn, out);
    } else if (fabs(to[i] - from[i]) < small * b->found->size[i]) {
        return;
    }
    qdot_text_add(out, "..");
    write_rounded_value(b, i, to[i], out);
}

/* The stability of the solutions on the branch between its points k and k + 1. */
static qdot_stability
stability_of_segment(const qdot_branch *b, size_t k)
{
    return b->mark[k] > 0 || b->stability[k] == QDOT_STABILITY_UNDECIDED ? b->stability[k + 1]
                                                                         : b->stability[k];
}

/* Whether the parameter p turns back at point k of a branch, which is a bifurcation. */
static bool
does_parameter_turn_at(const qdot_branches *b, const qdot_branch *branch, size_t k)
{
    const size_t m = b->found->width;
    const double *p = branch->y + k * m + b->found->n;

    return branch->mark[k] > 0 && (p[m] - p[0]) * (p[0] - *(p - m)) < 0;
}

/* Whether the points from .. to are too close to be described; not if they lie between two
 * different bifurcations. */
static bool
is_short_part(const qdot_branches *b, const qdot_branch *branch, size_t from, size_t to)
{
    const bool apart = branch->mark[from] > 0 && branch->mark[to] > 0 && branch->mark[from] != branch->mark[to];
    const double *y = branch->y + from * b->found->width, *z = branch->y + to * b->found->width;

    for (size_t k = 0; k <= b->n_told && !apart; k++) {
        const size_t i = k < b->n_told ? b->columns[k] : b->found->n;

        if (fabs(y[i] - z[i]) > tiny * b->found->size[i])
            return false;
    }
    return !apart;
}

/* Where the part that begins at k ends: another verdict, or p turns. A part too short for words has none:
 * it goes with what is next to it. *verdict of the part. */
static size_t
end_of_part_of_same_stability(const qdot_branches *b, const qdot_branch *branch, size_t k, qdot_stability *verdict)
{
    size_t from = k;

    *verdict = stability_of_segment(branch, k);
    for (k++; k + 1 < branch->n; k++) {
        const qdot_stability here = stability_of_segment(branch, k);
        size_t next = k + 1;

        if (here == *verdict && !does_parameter_turn_at(b, branch, k))
            continue;
        if (is_short_part(b, branch, from, k)) {
            *verdict = here;
            continue;
        }
        while (next + 1 < branch->n && stability_of_segment(branch, next) == here && !does_parameter_turn_at(b, branch, next))
            next++;
        if (next + 1 < branch->n || !is_short_part(b, branch, k, next))
            break;
        k = next;
    }
    return k < branch->n ? k : branch->n - 1;
}

static const char *
word_for_stability(qdot_stability verdict)
{
    static const char *const words[] = {
        [QDOT_STABLE] = "stable",
        [QDOT_UNSTABLE] = "unstable",
        [QDOT_STABLE_TO_FIRST_ORDER] = "stable to first order",
        [QDOT_STABILITY_UNDECIDED] = "undecided",
    };

    return words[verdict];
}

static void
add_branch(const qdot_branches *b, size_t i, qdot_dataset *t)
{
    const qdot_branch *branch = &b->found->branches.at[i];
    const size_t n = b->found->n;

    for (size_t k = 0, end; k + 1 < branch->n; k = end) {
        const double *from, *to;
        qdot_stability verdict;
        qdot_text cell = {0};

        end = end_of_part_of_same_stability(b, branch, k, &verdict);
        from = branch->y + k * b->found->width;
        to = branch->y + end * b->found->width;
        if (k == 0)
            qdot_text_format(&cell, "branch[%zu]", i + 1);
        qdot_table_add_written(t, &cell);
        if (from[n] > to[n]) {
            const double *const swap = from;

            from = to;
            to = swap;
        }
        write_range(b, n, from, to, from[n], &cell);
        qdot_table_add_written(t, &cell);
        for (size_t q = 0; q < b->n_told; q++) {
            const size_t i_q = b->columns[q];

            write_range(b, i_q, from, to, farthest_value_outside_ends(b, branch, k, end, i_q), &cell);
            qdot_table_add_written(t, &cell);
        }
        qdot_table_add_text(t, word_for_stability(verdict));
    }
}

/* Whether the parameter p is constant along the branch. */
static bool
has_constant_parameter(const qdot_branches *b, const qdot_branch *branch)
{
    const size_t n = b->found->n, m = b->found->width;

    for (size_t k = 0; k < branch->n; k++)
        if (fabs(branch->y[k * m + n] - branch->y[n]) > small * b->found->size[n])
            return false;
    return true;
}

/* Write why a branch ends within the range of the parameter p. */
static void
write_ends_of_branch(const qdot_branches *b, size_t i, qdot_text *out)
{
    static const char *const words[] = {
        [QDOT_END_REST] = "shrinks to an equilibrium",
        [QDOT_END_PERIOD] = "comes near an equilibrium, its period grows to infinity",
        [QDOT_END_DOMAIN] = "ends at a coordinate's domain",
        [QDOT_END_FAR] = "is not followed further",
        [QDOT_END_BLURRED] = "ends where its orbits are too unstable: their multipliers have no digits left",
        [QDOT_END_LOST] = "is lost: the equations have no value there, jump, or have a kink",
        [QDOT_END_NO_REST] = "ends",
        [QDOT_END_STOPPED] = "is broken off",
    };
    const qdot_branch *branch = &b->found->branches.at[i];
    const size_t n = b->found->n;

    if (branch->n > 1 && has_constant_parameter(b, branch)) {
        qdot_text_format(out, "branch[%zu] is vertical: at %s = ", i + 1, name_of_quantity(b, n));
        write_rounded_value(b, n, branch->y[n], out);
        qdot_text_add(out, b->orbits ? " alone all of these are orbits\n"
                                     : " alone all of these are equilibria\n");
        return;
    }
    if (branch->end[0] == QDOT_END_CLOSED || branch->end[1] == QDOT_END_CLOSED) {
        qdot_text_format(out, "branch[%zu] is closed\n", i + 1);
        return;
    }
    for (int side = 0; side < 2; side++) {
        const double *y = branch->y + (side == 0 ? 0 : branch->n - 1) * b->found->width;

        if (branch->end[side] == QDOT_END_RANGE || branch->end[side] == QDOT_END_HALF)
            continue;
        qdot_text_format(out, "branch[%zu] ", i + 1);
        if (branch->end[side] == QDOT_END_LOST && branch->reason[side][0] != '\0')
            qdot_text_format(out, "is lost: %s", branch->reason[side]);
        else if (b->orbits && branch->end[side] == QDOT_END_LOST)
            qdot_text_add(out, "is lost: no orbit is found further on");
        else
            qdot_text_add(out, words[branch->end[side]]);
        qdot_text_format(out, ", at %s = ", name_of_quantity(b, n));
        write_rounded_value(b, n, y[n], out);
        for (size_t q = 0; q < b->n_told; q++) {
            qdot_text_format(out, ", %s = ", name_of_quantity(b, b->columns[q]));
            write_rounded_value(b, b->columns[q], y[b->columns[q]], out);
        }
        qdot_text_char(out, '\n');
    }
}

static void
write_value_with_error(double value, double error, double size, qdot_text *out)
{
    if (isnan(error)) {
        qdot_number_text(out, value, digits * fmax(fabs(value), 1e-3 * size));
        return;
    }
    if (fabs(value) < small * size && fabs(value) <= error)
        value = 0;
    if (value == 0 && error < nothing * size)
        error = 0;
    qdot_number_text(out, value, error);
    qdot_number_text_error(out, error);
}

static void
add_bifurcation(const qdot_branches *b, size_t i, qdot_dataset *t)
{
    const qdot_bifurcation *one = &b->found->bifurcations.at[i];
    const size_t n = b->found->n;
    qdot_text cell = {0};
    bool first = true;

    qdot_table_add_text(t, qdot_bifurcation_name(one->kind));
    write_value_with_error(one->y[n], one->error[n], b->found->size[n], &cell);
    qdot_table_add_written(t, &cell);
    for (size_t q = 0; q < b->n_told; q++) {
        const size_t k = b->columns[q];

        write_value_with_error(one->y[k], one->error[k], b->found->size[k], &cell);
        qdot_table_add_written(t, &cell);
    }
    for (size_t k = 0; k < b->found->branches.n; k++) {
        const qdot_branch *branch = &b->found->branches.at[k];
        size_t j = 0;

        while (j < branch->n && branch->mark[j] != i + 1)
            j++;
        if (j == branch->n)
            continue;
        qdot_text_format(&cell, "%sbranch[%zu]", first ? "" : ", ", k + 1);
        first = false;
    }
    if (one->frequency > 0) {
        qdot_text_add(&cell, b->orbits ? ", multipliers at the angle " : ", angular frequency ");
        write_value_with_error(one->frequency, one->frequency_error, 1, &cell);
    }
    qdot_table_add_written(t, &cell);
}

/* Begin a table of texts, with the columns `first`, p, the unknowns that are described, and `last`. */
static qdot_status
begin_text_table(const qdot_branches *b, const char *first, const char *last, qdot_dataset *t)
{
    const size_t n = b->n_told + 3;
    qdot_table_column *columns = qdot_calloc(n, sizeof *columns);
    qdot_status status;

    if (columns == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++) {
        const bool quantity = i > 0 && i + 1 < n;
        const size_t k = i == 1 ? b->found->n : quantity ? b->columns[i - 2] : 0;

        columns[i] = (qdot_table_column){.name = quantity ? name_of_quantity(b, k) : i == 0 ? first : last,
                                         .unit = quantity ? unit_of_quantity(b, k) : NULL,
                                         .kind = QDOT_CELL_TEXT,
                                         .left = true,
                                         .gap = 2};
    }
    status = qdot_table_begin(t, n, columns);
    qdot_free(columns);
    return status;
}

static qdot_status
write_branches_as_text(const qdot_branches *b, qdot_text *out)
{
    qdot_dataset t = {0};
    qdot_status status = begin_text_table(b, "branch", "", &t);

    for (size_t i = 0; i < b->found->branches.n && status == QDOT_OK; i++)
        add_branch(b, i, &t);
    if (status == QDOT_OK)
        status = qdot_answer_add_table(&t, out);
    qdot_table_clear(&t);
    for (size_t i = 0; i < b->found->branches.n; i++)
        write_ends_of_branch(b, i, out);
    return status;
}

static qdot_status
write_bifurcations_as_text(const qdot_branches *b, qdot_text *out)
{
    qdot_dataset t = {0};
    qdot_status status;

    if (b->found->bifurcations.n == 0) {
        qdot_text_add(out, "no bifurcation was found\n");
        return QDOT_OK;
    }
    qdot_text_char(out, '\n');
    status = begin_text_table(b, "bifurcation", "of", &t);
    for (size_t i = 0; i < b->found->bifurcations.n && status == QDOT_OK; i++)
        add_bifurcation(b, i, &t);
    if (status == QDOT_OK)
        status = qdot_answer_add_table(&t, out);
    qdot_table_clear(&t);
    return status;
}

static void
write_degenerate_points(const qdot_branches *b, qdot_text *out)
{
    bool some = false;

    for (size_t i = 0; i < b->found->bifurcations.n; i++)
        some = some || b->found->bifurcations.at[i].kind == QDOT_NOT_SIMPLE;
    if (some)
        qdot_text_add(out, "other branches that begin at a degenerate point are not followed\n");
}

/* List the equilibria from which no branch of solutions was followed. */
static void
write_equilibria_left_out(const qdot_branches *b, qdot_text *out)
{
    const size_t n = b->found->n;

    if (b->orbits || b->found->left.n == 0)
        return;
    qdot_text_add(out, "also equilibria, but degenerate, so that no branch is followed from there: ");
    for (size_t k = 0; k < b->found->left.n; k += n + 1) {
        const double *y = b->found->left.at + k;

        qdot_text_format(out, "%s%s = ", k == 0 ? "" : "; ", name_of_quantity(b, n));
        write_rounded_value(b, n, y[n], out);
        for (size_t q = 0; q < b->n_told; q++) {
            qdot_text_format(out, ", %s = ", name_of_quantity(b, b->columns[q]));
            write_rounded_value(b, b->columns[q], y[b->columns[q]], out);
        }
    }
    qdot_text_char(out, '\n');
}

qdot_status
qdot_branches_answer(qdot_session *session, const qdot_branches *b)
{
    qdot_text text = {0};
    qdot_status status;

    if (session->output->json)
        return answer_branches_as_json(session, b);
    status = write_branches_as_text(b, &text);
    if (status == QDOT_OK)
        status = write_bifurcations_as_text(b, &text);
    write_degenerate_points(b, &text);
    write_equilibria_left_out(b, &text);
    return qdot_answer_written(session, "branches", status, &text);
}
