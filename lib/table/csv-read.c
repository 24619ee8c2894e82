/* csv-read.c -- reads rows of numbers from CSV text, line by line. */
#include "table/csv-read.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/utf8.h"
#include "parallel/ranks.h"

enum { FILE_LIMIT = 1 << 28, SHOWN = 40 };

/* A part of a line of the file: from one address to another. */
typedef struct {
    const char *at, *end;
} piece;

typedef struct {
    const char *name;
    piece line; /* the present line, without line end and comment */
    size_t number; /* number of the present line, from 1 */
    char separator; /* ',', ';' or ' ' (blanks and tabs) between cells; 0: not known yet */
    char mark;      /* '.' or ',' within numbers; 0: none had one yet */
    qdot_vec(double) values;
    qdot_vec(qdot_csv_place) places;
    size_t columns, rows;
    qdot_csv *csv; /* the result: receives the column names */
} reader;

/* --- reporting errors ---------------------------------------------------------------------- */

qdot_status
qdot_csv_fail(const char *name, const qdot_csv_place *place, const char *format, ...)
{
    char message[300];
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    return qdot_fail(QDOT_EINVAL, "%.150s:%zu:%zu: %s", name, place->line, place->column, message);
}

static qdot_csv_place
place_in_file(const reader *r, const char *at)
{
    return (qdot_csv_place){r->number,
                            1 + qdot_utf8_columns(r->line.at, (size_t)(at - r->line.at))};
}

/* --- reading cells -------------------------------------------------------------------------- */

static bool
is_blank(char c)
{
    return c == ' ' || c == '\t';
}

static void
strip_blanks(piece *p)
{
    while (p->at < p->end && is_blank(*p->at))
        p->at++;
    while (p->at < p->end && is_blank(p->end[-1]))
        p->end--;
}

/* Take the next cell of the line, which begins at *at, and move past its separator; false if there is none. */
static bool
next_cell(const reader *r, const char **at, piece *cell)
{
    const char *c = *at, *const end = r->line.end;
    char quote = 0;

    if (c > end)
        return false;
    if (r->separator == ' ') {
        while (c < end && is_blank(*c))
            c++;
        if (c == end)
            return false;
    }
    cell->at = c;
    while (c < end && (quote || (r->separator == ' ' ? !is_blank(*c) : *c != r->separator))) {
        if (*c == '"' || *c == '\'')
            quote = quote == *c ? 0 : quote ? quote : *c;
        c++;
    }
    cell->end = c;
    *at = c + 1;
    strip_blanks(cell);
    if (cell->end - cell->at > 1 && (*cell->at == '"' || *cell->at == '\'')
        && cell->end[-1] == *cell->at) {
        cell->at++;
        cell->end--;
        strip_blanks(cell);
    }
    return true;
}

/* Whether a cell is a decimal number such as 1, -.5, 2.5e-3 or, as many countries write it, 0,5; *mark: '.' or ',' if it has
 * one, else 0. */
static bool
read_decimal_number(piece p, char *mark)
{
    const char *c = p.at;
    size_t digits = 0;

    *mark = 0;
    c += c < p.end && (*c == '+' || *c == '-');
    for (; c < p.end && *c >= '0' && *c <= '9'; c++)
        digits++;
    if (c < p.end && (*c == '.' || *c == ','))
        *mark = *c++;
    for (; c < p.end && *c >= '0' && *c <= '9'; c++)
        digits++;
    if (digits == 0)
        return false;
    if (c < p.end && strchr("eEdD", *c) != NULL) {
        c++;
        c += c < p.end && (*c == '+' || *c == '-');
        if (c == p.end)
            return false;
        for (; c < p.end && *c >= '0' && *c <= '9'; c++)
            continue;
    }
    return c == p.end;
}

static bool
is_decimal_number(piece p)
{
    char mark;

    return read_decimal_number(p, &mark);
}

/* Whether a cell contains a word for a missing number, such as nan or n/a. */
static bool
is_missing_number(piece p)
{
    static const char *const words[] = {"nan", "inf", "-inf", "+inf", "na", "n/a", "null", "none", "-"};

    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strlen(words[i]) == (size_t)(p.end - p.at)
            && strncasecmp(words[i], p.at, strlen(words[i])) == 0)
            return true;
    return false;
}

static qdot_status
fail_at_cell(const reader *r, piece cell)
{
    const qdot_csv_place place = place_in_file(r, cell.at);
    const int shown = cell.end - cell.at > SHOWN ? SHOWN : (int)(cell.end - cell.at);

    if (cell.at == cell.end) {
        (void)qdot_csv_fail(r->name, &place, "a number is missing");
        return qdot_hint("take the row out: each has a number in every column");
    }
    (void)qdot_csv_fail(r->name, &place, "`%.*s` is not a number", shown, cell.at);
    if (is_missing_number(cell))
        return qdot_hint("take the row out: each has a number in every column");
    return qdot_hint("`#` begins a comment; the names of columns are above the first row");
}

/* Read the number in a cell. */
static qdot_status
read_cell(reader *r, piece cell, double *x)
{
    char buffer[64];
    const size_t n = (size_t)(cell.end - cell.at);
    char *own = n < sizeof buffer ? buffer : NULL, *allocated = NULL, mark;
    qdot_csv_place place = place_in_file(r, cell.at);

    if (r->csv->gaps && (n == 0 || is_missing_number(cell))) {
        *x = NAN;
        return QDOT_OK;
    }
    if (!read_decimal_number(cell, &mark))
        return fail_at_cell(r, cell);
    if (mark != 0 && r->mark != 0 && mark != r->mark) {
        (void)qdot_csv_fail(r->name, &place, "`%.*s` has a decimal %s, numbers before it a decimal %s", n > SHOWN ? SHOWN : (int)n,
                            cell.at, mark == ',' ? "comma" : "point", mark == ',' ? "point" : "comma");
        return qdot_hint("one of the two in the whole file, and none between thousands");
    }
    r->mark = mark != 0 ? mark : r->mark;
    if (own == NULL)
        own = allocated = qdot_malloc(n + 1);
    if (own == NULL)
        return QDOT_ENOMEM;
    memcpy(own, cell.at, n);
    own[n] = '\0';
    for (char *c = own; *c != '\0'; c++)
        *c = *c == ',' ? '.' : *c == 'd' || *c == 'D' ? 'e' : *c;
    *x = strtod(own, NULL);
    qdot_free(allocated);
    if (isfinite(*x))
        return QDOT_OK;
    return qdot_csv_fail(r->name, &place, "`%.*s` is too large for a double",
                         n > SHOWN ? SHOWN : (int)n, cell.at);
}

/* --- reading lines --------------------------------------------------------------------------- */

/* Whether a line is numbers between blanks or tabs, some of them with a decimal comma. */
static bool
has_commas_within_numbers(piece line)
{
    const reader r = {.line = line, .separator = ' '};
    const char *at = line.at;
    size_t cells = 0, commas = 0;
    piece cell;

    while (next_cell(&r, &at, &cell)) {
        char mark;

        if (!(read_decimal_number(cell, &mark) && mark != '.' && cell.end[-1] != ',' && *cell.at != ',') && !is_missing_number(cell))
            return false;
        cells++;
        commas += mark == ',';
    }
    return cells > 1 && commas > 0;
}

static char
find_separator(piece line)
{
    static const char in_order[] = {';', ','};

    if (memchr(line.at, ';', (size_t)(line.end - line.at)) == NULL && has_commas_within_numbers(line))
        return ' ';
    for (size_t i = 0; i < sizeof in_order; i++)
        if (memchr(line.at, in_order[i], (size_t)(line.end - line.at)))
            return in_order[i];
    return ' ';
}

/* Whether the line has a cell that is a number. */
static bool
has_number(reader *r)
{
    const char *at = r->line.at;
    bool found = false;
    piece cell;

    r->separator = find_separator(r->line);
    while (!found && next_cell(r, &at, &cell))
        found = is_decimal_number(cell);
    return found;
}

/* Read the names of the columns from the first line of words before the first row of numbers. */
static qdot_status
read_column_names(reader *r)
{
    const char *at = r->line.at;
    piece cell;

    if (r->csv->names.n > 0)
        return QDOT_OK;
    while (next_cell(r, &at, &cell)) {
        qdot_csv_name name = {qdot_strndup(cell.at, (size_t)(cell.end - cell.at)), place_in_file(r, cell.at)};

        if (name.word == NULL || qdot_vec_push(&r->csv->names, name) != QDOT_OK) {
            qdot_free(name.word);
            return QDOT_ENOMEM;
        }
    }
    return QDOT_OK;
}

static qdot_status
read_row(reader *r)
{
    const char *at = r->line.at;
    size_t n = 0;
    piece cell;

    while (next_cell(r, &at, &cell)) {
        double x = 0;

        if (r->separator != ' ' && at > r->line.end && cell.at == cell.end && n > 0
            && (r->rows == 0 ? !r->csv->gaps || n >= r->csv->names.n : n == r->columns))
            break; /* a separator at the end of the line is ignored */
        if (r->rows > 0 && n == r->columns) {
            const qdot_csv_place place = place_in_file(r, cell.at);

            return qdot_csv_fail(r->name, &place, "the row has more than the %zu numbers of the first",
                                 r->columns);
        }
        QDOT_TRY(read_cell(r, cell, &x));
        QDOT_TRY(qdot_vec_push(&r->values, x));
        QDOT_TRY(qdot_vec_push(&r->places, place_in_file(r, cell.at)));
        n++;
    }
    if (r->rows == 0)
        r->columns = n;
    if (n < r->columns) {
        const qdot_csv_place place = place_in_file(r, r->line.end);

        return qdot_csv_fail(r->name, &place, "the row has %zu number%s, the first has %zu", n,
                             n == 1 ? "" : "s", r->columns);
    }
    r->rows++;
    return QDOT_OK;
}

static qdot_status
read_line(reader *r, piece line)
{
    r->line = line;
    for (const char *c = line.at; c < line.end; c++) {
        if (*c == '\0') {
            const qdot_csv_place place = place_in_file(r, c);

            return qdot_csv_fail(r->name, &place, "a byte 0: this is no text file");
        }
        if (*c == '#' || *c == '%') {
            r->line.end = c;
            break;
        }
    }
    strip_blanks(&line);
    line = r->line;
    strip_blanks(&line);
    r->line.end = line.end; /* cut only the end: columns in messages count from the line's start */
    if (line.at >= line.end)
        return QDOT_OK;
    return r->rows == 0 && !has_number(r) ? read_column_names(r) : read_row(r);
}

static qdot_status
read_lines(reader *r, const char *text, size_t length)
{
    const char *const end = text + length, *at = text;

    if (length >= 2 && (memcmp(text, "\xff\xfe", 2) == 0 || memcmp(text, "\xfe\xff", 2) == 0)) {
        (void)qdot_fail(QDOT_EINVAL, "%.150s is a text in UTF-16, not in UTF-8", r->name);
        return qdot_hint("iconv -f UTF-16 -t UTF-8 turns one into the other");
    }
    if (length >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
        at += 3;
    while (at < end) {
        piece line = {at, at};

        while (line.end < end && *line.end != '\n' && *line.end != '\r')
            line.end++;
        at = line.end + 1;
        if (line.end < end && *line.end == '\r' && at < end && *at == '\n')
            at++;
        r->number++;
        if (r->number % 1024 == 0)
            QDOT_TRY(qdot_interrupt_check());
        QDOT_TRY(read_line(r, line));
    }
    if (r->rows > 0)
        return QDOT_OK;
    (void)qdot_fail(QDOT_EINVAL, "%.150s has no row of numbers", r->name);
    return qdot_hint("rows are numbers between commas, semicolons, blanks or tabs");
}

qdot_status
qdot_csv_read_text(const char *name, const char *text, size_t length, qdot_csv *csv)
{
    reader r = {.name = name, .csv = csv};
    const qdot_status status = read_lines(&r, text, length);

    csv->columns = r.columns;
    csv->rows = r.rows;
    csv->at = r.values.at;
    csv->places = r.places.at;
    return status;
}

void
qdot_csv_clear(qdot_csv *csv)
{
    qdot_free(csv->at);
    qdot_free(csv->places);
    for (size_t i = 0; i < csv->names.n; i++)
        qdot_free(csv->names.at[i].word);
    qdot_free(csv->names.at);
    *csv = (qdot_csv){0};
}

size_t
qdot_csv_find(const qdot_csv *csv, const char *name)
{
    size_t at = csv->columns, found = 0;

    for (size_t i = 0; i < csv->columns; i++)
        if (strcmp(csv->names.at[i].word, name) == 0) {
            at = i;
            found++;
        }
    return found == 1 ? at : csv->columns;
}

/* --- reading files ----------------------------------------------------------------------------- */

qdot_status
qdot_csv_read(const char *path, qdot_csv *csv)
{
    FILE *file = fopen(path, "rbe");
    qdot_text text = {0};
    qdot_status status = qdot_ranks_read(&text, file, path, FILE_LIMIT);

    if (file != NULL)
        fclose(file);
    if (status == QDOT_OK)
        status = qdot_csv_read_text(path, qdot_text_str(&text), text.n, csv);
    qdot_text_clear(&text);
    return status;
}
