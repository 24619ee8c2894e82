/* data.c -- the statement `data`: a function of one or two arguments, given by a table in a file. */
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/unit.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/declare/data-points.h"
#include "lang/declare/declare.h"
#include "lang/session/bind.h"
#include "lang/session/function-body.h"
#include "lang/session/session.h"
#include "lang/session/units.h"
#include "lang/session/values.h"
#include "lang/syntax/record.h"

static qdot_status declare_data(qdot_record *r);

QDOT_STATEMENT(data) = {
    .word = "data",
    .group = QDOT_DECLARING,
    .usage = "data NAME from \"FILE\" : COLUMN, ... [cubic|linear|steps] [hold|periodic]",
    .summary = "a function of one or two arguments, the first columns; its values are the last one. A cubic spline unless "
               "`linear` or `steps`; an error outside the table unless it holds its ends or is periodic",
    .example = "data drive from \"drive.csv\" : t, F",
    .nameable = true,
    .handler = declare_data,
};

enum { MOST_COLUMNS = 3 };

/* The columns of the statement while they are read. */
typedef struct {
    qdot_record *record;
    const qdot_filled *parts[MOST_COLUMNS];
    const qdot_token *names[MOST_COLUMNS];
    qdot_data_column columns[MOST_COLUMNS];
    qdot_expr units[MOST_COLUMNS]; /* a number in the unit of the column; nil: it has none */
    size_t n;
} reading;

/* --- columns ---------------------------------------------------------------------------- */

/* Read what the statement takes of the number x in a column: a x + b. */
static qdot_status
read_scale(reading *d, size_t k)
{
    qdot_record *r = d->record;
    qdot_session *session = r->cursor.session;
    qdot_pool *pool = session->pool;
    qdot_data_column *column = &d->columns[k];
    const bool time = strcmp(column->name, "t") == 0;
    const qdot_expr x = time ? QDOT_T : qdot_symbol_get(pool, QDOT_FORMAL, column->name), zero = QDOT_ZERO;
    qdot_formals f = {.list = qdot_list(pool, 1, &x), .names = qdot_calloc(1, sizeof *f.names), .n = 1};
    qdot_expr e = QDOT_NIL, slope;
    qdot_status status = f.names ? qdot_pool_check(pool) : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        f.names[0] = d->names[k];
        status = qdot_formals_enter(session, &f);
    }
    if (status == QDOT_OK)
        status = qdot_record_scalar(r, d->parts[k], &e);
    qdot_formals_leave(session, &f);
    QDOT_TRY(status);
    qdot_record_blame(r, d->parts[k]);
    slope = qdot_diff(pool, e, x);
    QDOT_TRY(qdot_pool_check(pool));
    if (slope == QDOT_ZERO || qdot_expr_contains(pool, slope, x)) {
        (void)qdot_fail(QDOT_EINVAL, "a column is a name or a multiple of it");
        return qdot_hint("%s, %s*1e-3, %s - 5", column->name, column->name, column->name);
    }
    d->units[k] = qdot_expr_has_units(pool, slope) ? slope : QDOT_NIL;
    QDOT_TRY(qdot_session_number(session, qdot_session_bind(session, slope), &column->a, NULL));
    return qdot_session_number(session, qdot_session_bind(session, qdot_subs(pool, e, 1, &x, &zero)), &column->b, NULL);
}

static qdot_status
read_columns(reading *d)
{
    qdot_record *r = d->record;

    for (const qdot_filled *part = qdot_record_hole(r, NULL, "COLUMN"); part != NULL; part = qdot_record_next(r, part, "COLUMN")) {
        if (d->n == MOST_COLUMNS) {
            qdot_record_blame(r, part);
            return qdot_fail(QDOT_ENOTBUILT, "not built yet: data of more than two arguments");
        }
        d->parts[d->n] = part;
        d->names[d->n] = qdot_record_own_name(r, part);
        if (d->names[d->n] == NULL)
            return qdot_record_expected(r, part->from, "the name of a column");
        d->columns[d->n].name = d->names[d->n]->text;
        for (size_t k = 0; k < d->n; k++)
            if (strcmp(d->columns[k].name, d->columns[d->n].name) == 0) {
                qdot_record_blame(r, part);
                return qdot_fail(QDOT_ENAME, "the column `%s` is named twice", d->columns[k].name);
            }
        QDOT_TRY(read_scale(d, d->n++));
    }
    if (d->n >= 2)
        return QDOT_OK;
    return qdot_record_expected(r, d->parts[0]->to, "`,` and the column of the values: `t, F`");
}

/* Fail because the file has a column of one of the names elsewhere, and none of another name. */
static qdot_status
fail_at_unknown_column(reading *d, const char *path, const qdot_csv *csv)
{
    size_t k = 0;
    qdot_text names = {0};

    while (k + 1 < d->n && qdot_csv_find(csv, d->columns[k].name) < csv->columns)
        k++;
    qdot_record_blame(d->record, d->parts[k]);
    for (size_t i = 0; i < csv->names.n; i++)
        qdot_text_format(&names, "%s`%.60s`", i > 0 ? ", " : "", csv->names.at[i].word);
    (void)qdot_csv_fail(path, &csv->places[0], "the file has no column `%s`", d->columns[k].name);
    if (!names.failed)
        (void)qdot_hint("there are %s", qdot_text_str(&names));
    qdot_text_clear(&names);
    return QDOT_ENAME;
}

/* Find the columns in the file: by the names that it has for all of them, else in its order. */
static qdot_status
find_columns(reading *d, const char *path, const qdot_csv *csv)
{
    bool named = csv->names.n == csv->columns;

    for (size_t k = 0; k < d->n && named; k++) {
        d->columns[k].at = qdot_csv_find(csv, d->columns[k].name);
        named = d->columns[k].at < csv->columns;
    }
    if (named)
        return QDOT_OK;
    for (size_t k = 0; k < d->n; k++) {
        const size_t at = csv->names.n == csv->columns ? qdot_csv_find(csv, d->columns[k].name) : csv->columns;

        if (at < csv->columns && at != k)
            return fail_at_unknown_column(d, path, csv);
        d->columns[k].at = k;
    }
    if (csv->columns == d->n)
        return QDOT_OK;
    qdot_record_blame(d->record, d->parts[d->n - 1]);
    (void)qdot_csv_fail(path, &csv->places[0], "the file has %zu column%s, %zu are named", csv->columns,
                        csv->columns == 1 ? "" : "s", d->n);
    return qdot_hint("by the names in the first line of the file, or as many as it has");
}

/* --- the function ----------------------------------------------------------------------- */

static qdot_expr
lookup(qdot_pool *pool, qdot_expr x, int64_t handle)
{
    return qdot_fun(pool, QDOT_LOOKUP, 2, (qdot_expr[]){x, qdot_expr_int(pool, handle)});
}

/* The polynomial with coefficients c [degree + 1] of w. */
static qdot_expr
polynomial(qdot_pool *pool, int degree, const qdot_expr *c, qdot_expr w)
{
    qdot_expr e = c[degree];

    for (int i = degree - 1; i >= 0; i--)
        e = qdot_add(pool, c[i], qdot_mul(pool, w, e));
    return e;
}

/* The value of table `number` at x [arguments] (num/samples.h). */
static qdot_expr
value_of_table(qdot_pool *pool, int number, size_t arguments, int degree, const qdot_expr *x)
{
    qdot_expr piece[2] = {QDOT_NIL, QDOT_NIL}, w[2] = {QDOT_NIL, QDOT_NIL}, cell, c[4], outer[4] = {QDOT_NIL};

    for (size_t k = 0; k < arguments; k++) {
        piece[k] = lookup(pool, x[k], qdot_samples_piece(number, (int)k));
        w[k] = qdot_sub(pool, x[k], lookup(pool, piece[k], qdot_samples_knot(number, (int)k)));
    }
    cell = arguments == 1 ? piece[0]
                          : qdot_add(pool, qdot_mul(pool, qdot_expr_int(pool, qdot_samples_width(number)), piece[0]), piece[1]);
    for (int i = 0; i <= degree; i++) {
        for (int j = 0; j <= (arguments == 2 ? degree : 0); j++)
            c[j] = lookup(pool, cell, qdot_samples_coefficient(number, i, j));
        outer[i] = arguments == 2 ? polynomial(pool, degree, c, w[1]) : c[0];
    }
    return polynomial(pool, degree, outer, w[0]);
}

/* The arguments x and the function are of the dimensions of their columns, where these have units. */
static qdot_status
give_dimensions(reading *d, const qdot_expr *x, qdot_expr function)
{
    qdot_session *session = d->record->cursor.session;

    QDOT_TRY(qdot_units_visit(session, function));
    for (size_t k = 0; k < d->n; k++) {
        if (d->units[k] == QDOT_NIL)
            continue;
        qdot_record_blame(d->record, d->parts[k]);
        QDOT_TRY(qdot_units_join(session, k + 1 < d->n ? x[k] : function, d->units[k],
                                 k + 1 < d->n ? "the argument is %s, its column %s" : "the function is %s, its column %s"));
    }
    return QDOT_OK;
}

/* Declare the function, and set its value. */
static qdot_status
declare_function(reading *d, const char *name, const qdot_filled *part, int number, int degree)
{
    qdot_record *r = d->record;
    qdot_session *session = r->cursor.session;
    const char *arguments[MOST_COLUMNS];
    qdot_expr x[MOST_COLUMNS], value;
    qdot_function_body *body = qdot_function_body_new(r->cursor.source, r->start, r->cursor.at);
    const qdot_name *known;
    qdot_status status = body ? QDOT_OK : QDOT_ENOMEM;

    for (size_t k = 0; k + 1 < d->n; k++)
        arguments[k] = d->columns[k].name;
    if (status == QDOT_OK)
        status = qdot_declare_undefined(&r->cursor, part->from, name, d->n - 1, arguments, body);
    qdot_function_body_release(body);
    QDOT_TRY(status);
    known = qdot_names_find(session->names, name);
    for (size_t k = 0; k + 1 < d->n; k++)
        x[k] = qdot_expr_arg(session->pool, known->formals, (uint32_t)k);
    value = value_of_table(session->pool, number, d->n - 1, degree, x);
    QDOT_TRY(qdot_pool_check(session->pool));
    qdot_session_set(session, known->value, value, &status);
    return status == QDOT_OK ? give_dimensions(d, x, known->value) : status;
}

/* --- the statement ----------------------------------------------------------------------- */

static qdot_status
read_how(const qdot_record *r, size_t columns, int *degree, qdot_samples_beyond *beyond)
{
    *degree = qdot_record_word(r, "steps") ? 0 : qdot_record_word(r, "linear") ? 1 : 3;
    *beyond = qdot_record_word(r, "periodic") ? QDOT_SAMPLES_PERIODIC
              : qdot_record_word(r, "hold")   ? QDOT_SAMPLES_HOLD
                                              : QDOT_SAMPLES_END;
    if (columns == 3 && *degree == 0)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: `steps` of two arguments");
    if (columns == 3 && *beyond == QDOT_SAMPLES_PERIODIC)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: periodic data of two arguments");
    return QDOT_OK;
}

static qdot_status
declare_data(qdot_record *r)
{
    const qdot_filled *const part = qdot_record_hole(r, NULL, "NAME"), *const file = qdot_record_hole(r, "from", "\"FILE\"");
    reading d = {.record = r};
    qdot_csv csv = {.gaps = true};
    qdot_data_points points = {.path = qdot_record_text(file), .csv = &csv, .columns = d.columns};
    const char *name;
    int number = 0;
    qdot_status status;

    QDOT_TRY(qdot_record_name(r, part, &name));
    QDOT_TRY(read_columns(&d));
    points.n = d.n;
    qdot_record_blame(r, d.parts[0]);
    QDOT_TRY(read_how(r, d.n, &points.degree, &points.beyond));
    qdot_record_blame(r, file);
    status = qdot_session_read_csv(r->cursor.session, points.path, &csv);
    if (status == QDOT_OK)
        status = find_columns(&d, points.path, &csv);
    if (status == QDOT_OK) {
        qdot_record_blame(r, file);
        status = qdot_data_points_add(&points, &number);
    }
    qdot_csv_clear(&csv);
    if (status == QDOT_OK)
        status = declare_function(&d, name, part, number, points.degree);
    if (status == QDOT_OK && points.left_out > 0)
        status = qdot_answer_notice(r->cursor.session, "%zu row%s of %.100s %s left out: numbers are missing in %s", points.left_out,
                                    points.left_out == 1 ? "" : "s", points.path, points.left_out == 1 ? "is" : "are",
                                    points.left_out == 1 ? "it" : "them");
    return status;
}
