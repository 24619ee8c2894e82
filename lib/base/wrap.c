/* wrap.c -- breaks lines of text at blanks, and splits tables that are too wide. */
#include "base/wrap.h"

#include <stdbool.h>
#include <string.h>

#include "base/memory.h"
#include "base/utf8.h"

/* A part of the text whose lines are being broken. */
typedef struct {
    const char *at;
    size_t n;
} piece;

/* The number of terminal columns of a part; colour codes and the control characters that mark table cells take none. */
static size_t
count_piece_columns(piece p)
{
    size_t columns = 0, from = 0, i = 0;

    while (i < p.n) {
        const bool code = p.at[i] == '\033';

        if (!code && p.at[i] != QDOT_WRAP_CELL[0]) {
            i++;
            continue;
        }
        columns += qdot_utf8_columns(p.at + from, i - from);
        while (code && i < p.n && p.at[i] != 'm')
            i++;
        from = ++i;
    }
    return from < p.n ? columns + qdot_utf8_columns(p.at + from, p.n - from) : columns;
}

/* The length in bytes of the colour code, cell mark or letter at byte i; *columns: the terminal
 * columns that it takes. */
static size_t
length_of_character_at(const char *text, size_t n, size_t i, size_t *columns)
{
    const char *end = text[i] == '\033' ? memchr(text + i, 'm', n - i) : NULL;
    size_t letter = qdot_utf8_length(text + i);

    *columns = 0;
    if (end != NULL)
        return (size_t)(end - text) + 1 - i;
    letter = letter == 0 || letter > n - i ? 1 : letter;
    if (text[i] != QDOT_WRAP_CELL[0])
        *columns = qdot_utf8_columns(text + i, letter);
    return letter;
}

size_t
qdot_wrap_cut(const char *text, size_t n, size_t room)
{
    size_t columns = 0, behind_sign = 0, i = 0;

    while (i < n) {
        size_t own;
        const size_t bytes = length_of_character_at(text, n, i, &own);

        if (columns > 0 && columns + own > room)
            return behind_sign > 0 ? behind_sign : i;
        columns += own;
        i += bytes;
        if (own > 0 && strchr(",;:)]}/*_=", text[i - 1]) != NULL && 2 * columns > room)
            behind_sign = i;
    }
    return n;
}

static size_t
count_blanks_at(piece p, size_t i)
{
    size_t n = 0;

    while (i + n < p.n && p.at[i + n] == ' ')
        n++;
    return n;
}

static size_t
count_letters_at(piece p, size_t i)
{
    size_t n = 0;

    while (i + n < p.n && p.at[i + n] != ' ')
        n++;
    return n;
}

static void
add_blanks(qdot_text *out, size_t n)
{
    qdot_text_format(out, "%*s", (int)n, "");
}

/* End a line, without the blanks at its end, and begin the next one with `indent` blanks. */
static void
begin_next_line(qdot_text *out, size_t indent)
{
    while (out->n > 0 && out->at[out->n - 1] == ' ')
        qdot_text_truncate(out, out->n - 1);
    qdot_text_char(out, '\n');
    add_blanks(out, indent);
}

/* Append a piece of text without the control characters that mark table cells. */
static void
add_without_cell_marks(qdot_text *out, piece p)
{
    for (size_t i = 0, from = 0; i <= p.n; i++)
        if (i == p.n || p.at[i] == QDOT_WRAP_CELL[0]) {
            qdot_text_add_n(out, p.at + from, i - from);
            from = i + 1;
        }
}

/* --- breaking lines ------------------------------------------------------------------- */

enum { USUAL_INDENT = 2, LEAST_ROOM = 16 };

/* The indent, in columns, of the lines that continue `line`. */
static size_t
continuation_indent(piece line, size_t width)
{
    const size_t left = count_blanks_at(line, 0);
    const size_t usual = (2 * left <= width ? left : 0) + USUAL_INDENT;

    for (size_t i = left; i < line.n;) {
        const size_t letters = count_letters_at(line, i), blanks = count_blanks_at(line, i + letters);
        const size_t columns = count_piece_columns((piece){line.at, i + letters + blanks});

        if (blanks >= 2 && i + letters + blanks < line.n)
            return columns + LEAST_ROOM <= width ? columns : usual;
        i += letters + blanks;
    }
    return usual;
}

static bool
is_one_of_words(piece word, const char *const *words)
{
    for (; *words != NULL; words++)
        if (strlen(*words) == word.n && memcmp(*words, word.at, word.n) == 0)
            return true;
    return false;
}

/* Whether no line may be broken between two words. */
static bool
must_stay_together(piece before, piece behind)
{
    static const char *const both[] = {"=", "±", "<", ">", "<=", ">=", "==", NULL};
    static const char *const first[] = {"+", "-", "−", "*", "/", NULL};

    return is_one_of_words(before, both) || is_one_of_words(behind, both) || is_one_of_words(before, first);
}

/* The end of what begins with the word at i and stays in one line: in any case that word; more
 * only while it is not wider than `room`. */
static size_t
end_of_unbreakable_words(piece line, size_t i, size_t room)
{
    size_t end = i + count_letters_at(line, i);

    for (size_t start = i;;) {
        const size_t blanks = count_blanks_at(line, end), next = end + blanks;
        const size_t letters = count_letters_at(line, next);

        if (blanks == 0 || letters == 0 ||
            !must_stay_together((piece){line.at + start, end - start},
                                (piece){line.at + next, letters}) ||
            count_piece_columns((piece){line.at + i, next + letters - i}) > room)
            return end;
        start = next;
        end = next + letters;
    }
}

/* Append a word that begins at `column`, cut if it is too long for a line; returns the column after its end. */
static size_t
add_word(qdot_text *out, piece word, size_t column, size_t indent, size_t width)
{
    for (;;) {
        const size_t n = qdot_wrap_cut(word.at, word.n, width > column ? width - column : 1);

        qdot_text_add_n(out, word.at, n);
        if (n == word.n)
            return column + count_piece_columns(word);
        begin_next_line(out, indent);
        column = indent;
        word.at += n;
        word.n -= n;
    }
}

/* Append a line that begins at `column`, broken to the width; the lines that continue it are indented. */
static void
add_wrapped_line(qdot_text *out, piece line, size_t column, size_t indent, size_t width)
{
    const size_t room = width > indent ? width - indent : 1;
    size_t i = 0;
    bool any = false; /* whether the present line already holds a word */

    while (i < line.n) {
        const size_t blanks = count_blanks_at(line, i),
                     end = end_of_unbreakable_words(line, i + blanks, room);
        const piece chunk = {line.at + i + blanks, end - i - blanks};

        if (chunk.n == 0) /* the text ends with blanks */
            break;
        if ((any || column > indent) && column + blanks + count_piece_columns(chunk) > width) {
            begin_next_line(out, indent);
            column = indent;
        } else {
            add_blanks(out, blanks);
            column += blanks;
        }
        column = add_word(out, chunk, column, indent, width);
        any = true;
        i = end;
    }
}

static void
add_line_wrapped(qdot_text *out, piece line, size_t width)
{
    if (count_piece_columns(line) <= width)
        qdot_text_add_n(out, line.at, line.n);
    else
        add_wrapped_line(out, line, 0, continuation_indent(line, width), width);
}

/* --- folding tables ------------------------------------------------------------------- */

typedef struct {
    qdot_vec(piece) cells; /* the cells row by row; the first row is the head */
    size_t rows, n;        /* number of rows, the head included; columns */
    size_t keys;           /* number of leading columns that identify a row */
    size_t key_columns;    /* the width of all key columns together */
    size_t *width;         /* [n] width of each column */
} table;

/* Cell k of a table line; empty if the line has fewer cells. */
static piece
cell_of_line(piece line, size_t k)
{
    for (;; k--) {
        const char *mark = memchr(line.at, QDOT_WRAP_CELL[0], line.n);
        const size_t n = mark != NULL ? (size_t)(mark - line.at) : line.n;

        if (k == 0)
            return (piece){line.at, n};
        if (mark == NULL)
            return (piece){line.at, 0};
        line.at += n + 1;
        line.n -= n + 1;
    }
}

static size_t
count_cells(piece line)
{
    size_t n = 1;

    for (size_t i = 0; i < line.n; i++)
        n += line.at[i] == QDOT_WRAP_CELL[0];
    return n;
}

/* Remove the blanks at both ends of a part of a text. */
static piece
trim_blanks(piece p)
{
    while (p.n > 0 && p.at[p.n - 1] == ' ')
        p.n--;
    while (p.n > 0 && p.at[0] == ' ') {
        p.at++;
        p.n--;
    }
    return p;
}

/* Take the next line of *text and move *text past its newline. */
static piece
take_next_line(const char **text)
{
    const piece line = {*text, strcspn(*text, "\n")};

    *text += line.n + ((*text)[line.n] == '\n');
    return line;
}

/* Read the lines of a table; false if memory runs out. */
static bool
read_table(const char **text, table *t)
{
    const piece head = {*text, strcspn(*text, "\n")};

    t->n = count_cells(head);
    t->width = qdot_calloc(t->n, sizeof *t->width);
    if (t->width == NULL)
        return false;
    while (**text != '\0') {
        const char *at = *text;
        const piece line = take_next_line(&at);

        if (count_cells(line) < 2)
            break;
        for (size_t k = 0; k < t->n; k++) {
            const piece cell = cell_of_line(line, k);
            const size_t columns = count_piece_columns(cell);

            if (qdot_vec_push(&t->cells, cell) != QDOT_OK)
                return false;
            t->width[k] = columns > t->width[k] ? columns : t->width[k];
        }
        t->rows++;
        *text = at;
    }
    return true;
}

static piece
get_cell(const table *t, size_t row, size_t k)
{
    return t->cells.at[row * t->n + k];
}

static bool
are_pieces_equal(piece a, piece b)
{
    return a.n == b.n && memcmp(a.at, b.at, a.n) == 0;
}

static void
find_key_columns(table *t)
{
    size_t alike;

    do {
        t->key_columns += t->width[t->keys++];
        alike = 0;
        for (size_t i = 2; i < t->rows && alike < t->keys; i++)
            for (alike = 0; alike < t->keys; alike++)
                if (!are_pieces_equal(get_cell(t, i, alike), get_cell(t, i - 1, alike)))
                    break;
    } while (alike == t->keys && t->keys + 1 < t->n);
}

static void
add_table_cell(qdot_text *out, const table *t, size_t row, size_t k, bool last)
{
    const piece cell = get_cell(t, row, k);

    qdot_text_add_n(out, cell.at, cell.n);
    add_blanks(out, last ? 0 : t->width[k] - count_piece_columns(cell));
}

/* Append the key columns and the columns [from, to) of all rows. */
static void
add_table_block(qdot_text *out, const table *t, size_t from, size_t to, size_t width)
{
    for (size_t i = 0; i < t->rows; i++) {
        size_t last = to, column = t->key_columns;

        while (last > from && trim_blanks(get_cell(t, i, last - 1)).n == 0)
            last--; /* leave out trailing cells that are blank */
        for (size_t k = 0; k < t->keys; k++)
            add_table_cell(out, t, i, k, last == from && k + 1 == t->keys);
        for (size_t k = from; k < last; column += t->width[k++]) {
            if (k + 1 < t->n)
                add_table_cell(out, t, i, k, k + 1 == last);
            else /* the text in the last column may be too wide for the line, so break it */
                add_wrapped_line(out, get_cell(t, i, k), column, t->key_columns + USUAL_INDENT,
                                 width);
        }
        qdot_text_char(out, '\n');
    }
}

static void
add_table_in_blocks(qdot_text *out, const table *t, size_t width)
{
    for (size_t from = t->keys, to; from < t->n; from = to) {
        size_t columns = t->key_columns + t->width[from];

        for (to = from + 1; to < t->n && columns + t->width[to] <= width; to++)
            columns += t->width[to];
        if (from > t->keys)
            qdot_text_char(out, '\n');
        add_table_block(out, t, from, to, width);
    }
}

/* Whether each word of a cell fits into `room` columns. */
static bool
words_fit_width(piece cell, size_t room)
{
    for (size_t i = 0, n; i < cell.n; i += n + count_blanks_at(cell, i + n)) {
        n = count_letters_at(cell, i);
        if (count_piece_columns((piece){cell.at + i, n}) > room)
            return false;
    }
    return true;
}

/* Append each row as lines "name value"; a value that does not fit behind its name has a line of its own. */
static void
add_rows_as_records(qdot_text *out, const table *t, size_t width)
{
    size_t names = 0;

    for (size_t k = 0; k < t->n; k++) {
        const size_t columns = count_piece_columns(trim_blanks(get_cell(t, 0, k)));

        names = columns > names ? columns : names;
    }
    for (size_t i = 1; i < t->rows; i++)
        for (size_t k = 0; k < t->n; k++) {
            const piece name = trim_blanks(get_cell(t, 0, k)),
                        cell = trim_blanks(get_cell(t, i, k));
            const size_t indent = k > 0 ? USUAL_INDENT : 0, own = indent + USUAL_INDENT;
            const size_t behind = names + 2 * USUAL_INDENT;
            const bool beside = behind < width && words_fit_width(cell, width - behind);
            const size_t column = beside ? behind : own;

            add_blanks(out, indent);
            add_wrapped_line(out, name, indent, own, width);
            if (beside)
                add_blanks(out, column - indent - count_piece_columns(name));
            else if (cell.n > 0)
                begin_next_line(out, own);
            add_wrapped_line(out, cell, column, column, width);
            qdot_text_char(out, '\n');
        }
}

/* Whether the last column, k, fits beside the key columns once it is broken between words. */
static bool
last_column_fits_wrapped(const table *t, size_t k, size_t width)
{
    const size_t left = t->key_columns + USUAL_INDENT;

    for (size_t i = 0; i < t->rows; i++) {
        const piece cell = get_cell(t, i, k);
        const size_t blanks = count_blanks_at(cell, 0);
        const piece first = {cell.at, blanks + count_letters_at(cell, blanks)};

        if (t->key_columns + count_piece_columns(first) > width || left >= width ||
            !words_fit_width(cell, width - left))
            return false;
    }
    return t->key_columns + LEAST_ROOM / 2 <= width;
}

/* Whether each column fits beside the key columns, the last one perhaps broken between words. */
static bool
columns_fit_beside_keys(const table *t, size_t width)
{
    for (size_t k = t->keys; k < t->n; k++)
        if (t->key_columns + t->width[k] > width && (k + 1 < t->n || !last_column_fits_wrapped(t, k, width)))
            return false;
    return true;
}

static void
add_table_folded(qdot_text *out, const char **text, size_t width)
{
    const char *const start = *text;
    table t = {0};
    size_t columns = 0;

    if (!read_table(text, &t)) {
        out->failed = true;
        *text = start + strlen(start);
    } else {
        find_key_columns(&t);
        for (size_t k = 0; k < t.n; k++)
            columns += t.width[k];
        if (columns <= width)
            add_without_cell_marks(out, (piece){start, (size_t)(*text - start)});
        else if (columns_fit_beside_keys(&t, width))
            add_table_in_blocks(out, &t, width);
        else
            add_rows_as_records(out, &t, width);
    }
    qdot_free(t.cells.at);
    qdot_free(t.width);
}

void
qdot_wrap(const char *text, size_t width, qdot_text *out)
{
    if (width == 0) {
        add_without_cell_marks(out, (piece){text, strlen(text)});
        return;
    }
    while (*text != '\0') {
        const piece line = {text, strcspn(text, "\n")};

        if (memchr(line.at, QDOT_WRAP_CELL[0], line.n) != NULL) {
            add_table_folded(out, &text, width);
            continue;
        }
        add_line_wrapped(out, line, width);
        qdot_text_add_n(out, line.at + line.n, line.at[line.n] == '\n');
        text += line.n + (line.at[line.n] == '\n');
    }
}
