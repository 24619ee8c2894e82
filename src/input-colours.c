/* input-colours.c -- colours for what is typed at the prompt, while it is typed.
 *
 * Readline shows the line as it always does. Then the same characters are written over it in their
 * colours, and the cursor goes back: readline needs to know nothing of it, and what it shifts or
 * leaves in place keeps its colour.
 */
#define _XOPEN_SOURCE 700 /* for wcwidth */
#include "input-colours.h"

#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <wchar.h>

#include <readline/readline.h>

#include "base/memory.h"
#include "base/terminal.h"
#include "base/text.h"
#include "lang/workbench/highlight.h"

static qdot_session *session; /* the session; global, because readline's callbacks get no argument */
static const char *lines = "";

enum { LONG_LINE = 200 }; /* longest line that is coloured, in bytes */

static const char *const colours[] = {
    [QDOT_HIGHLIGHT_PLAIN] = "",          [QDOT_HIGHLIGHT_WORD] = QDOT_BOLD,
    [QDOT_HIGHLIGHT_NAME] = QDOT_CYAN,    [QDOT_HIGHLIGHT_NUMBER] = QDOT_MAGENTA,
    [QDOT_HIGHLIGHT_STRING] = QDOT_GREEN, [QDOT_HIGHLIGHT_COMMENT] = QDOT_GREY,
    [QDOT_HIGHLIGHT_WRONG] = QDOT_RED,
};

/* --- positions of characters on the screen ---------------------------------------------- */

typedef struct {
    int columns, rows; /* size of the terminal */
    int x, row;        /* position of the next character, row 0 is where the prompt begins */
} place;

/* The number of columns of the character at `text`, *bytes its length; negative: unknown. */
static int
character_width(const char *text, size_t *bytes)
{
    mbstate_t state = {0};
    wchar_t c;
    const size_t n = mbrtowc(&c, text, MB_CUR_MAX, &state);

    *bytes = n;
    return n == 0 || n == (size_t)-1 || n == (size_t)-2 ? -1 : wcwidth(c);
}

/* The position of a character of the given width: in the next row if it does not fit into the present one. */
static place
position_of_character(place p, int columns)
{
    if (p.x + columns > p.columns) {
        p.x = 0;
        p.row++;
    }
    return p;
}

/* The position after a character of the given width that is written at p. */
static place
position_after(place p, int columns)
{
    p = position_of_character(p, columns);
    p.x += columns;
    if (p.x == p.columns) {
        p.x = 0;
        p.row++;
    }
    return p;
}

static place
start_of_next_row(place p)
{
    p.x = 0;
    p.row++;
    return p;
}

/* Advance the position p over text; false: the text contains a character of unknown width. */
static bool
advance_over(place *p, const char *text, size_t n)
{
    for (size_t i = 0, bytes; i < n; i += bytes) {
        int columns;

        if (text[i] == '\n') {
            *p = start_of_next_row(*p);
            bytes = 1;
            continue;
        }
        columns = character_width(text + i, &bytes);
        if (columns < 0)
            return false;
        *p = position_after(*p, columns);
    }
    return true;
}

/* Advance over the prompt as it is shown (also of a search), without what readline is told to ignore. */
static bool
advance_over_prompt(place *p)
{
    const char *at = rl_display_prompt != NULL ? rl_display_prompt : "";

    while (*at != '\0') {
        const size_t n = strcspn(at, "\001");

        if (!advance_over(p, at, n))
            return false;
        at += n + strcspn(at + n, "\002");
        at += *at == '\002';
    }
    return true;
}

/* --- painting the line ------------------------------------------------------------------ */

static void
move_cursor(int rows, int x)
{
    if (rows != 0)
        fprintf(rl_outstream, rows < 0 ? "\033[%dA" : "\033[%dB", abs(rows));
    fputc('\r', rl_outstream);
    if (x > 0)
        fprintf(rl_outstream, "\033[%dC", x);
}

/* Write the line in colours from position p, where the cursor is; all characters must have known widths. */
static void
write_line(place p, const uint8_t *kinds)
{
    const char *text = rl_line_buffer;
    uint8_t now = QDOT_HIGHLIGHT_PLAIN;
    int row = p.row; /* row of the cursor; after the last column of a full row the cursor stays there */

    for (size_t i = 0, bytes; text[i] != '\0'; i += bytes) {
        int columns;

        if (text[i] == '\n') {
            p = start_of_next_row(p);
            bytes = 1;
            continue;
        }
        columns = character_width(text + i, &bytes);
        if (columns > 0 && position_of_character(p, columns).row > row) {
            p = position_of_character(p, columns);
            move_cursor(p.row - row, p.x);
            row = p.row;
        }
        if (kinds[i] != now) {
            fprintf(rl_outstream, "%s%s",
                    now != QDOT_HIGHLIGHT_PLAIN ? QDOT_COLOUR_END : "",
                    colours[kinds[i]]);
            now = kinds[i];
        }
        fwrite(text + i, 1, bytes, rl_outstream);
        p = position_after(p, columns);
    }
    fputs(now != QDOT_HIGHLIGHT_PLAIN ? QDOT_COLOUR_END : "", rl_outstream);
}

/* Find the kinds (colours) of the bytes of the line, which may continue earlier lines; NULL: no memory. */
static uint8_t *
kinds_of_line(size_t *before)
{
    qdot_text text = {0};
    uint8_t *kinds;

    qdot_text_add(&text, lines);
    *before = text.n;
    qdot_text_add(&text, rl_line_buffer);
    kinds = qdot_text_status(&text) == QDOT_OK ? qdot_malloc(text.n + 1) : NULL;
    if (kinds != NULL &&
        qdot_highlight_text(session, qdot_text_str(&text), text.n, kinds) != QDOT_OK) {
        qdot_free(kinds);
        kinds = NULL;
    }
    qdot_text_clear(&text);
    return kinds;
}

/* Whether more input is waiting: a long line that is being pasted is coloured only at its end. */
static bool
is_input_waiting(void)
{
    struct pollfd input = {.fd = fileno(rl_instream), .events = POLLIN};

    return rl_end > LONG_LINE && poll(&input, 1, 0) > 0;
}

/* Paint the colours over what readline has shown. */
static void
paint_line(void)
{
    place start = {0}, cursor, end;
    uint8_t *kinds;
    size_t before;

    rl_get_screen_size(&start.rows, &start.columns);
    if (rl_end == 0 || start.columns < 2 || !advance_over_prompt(&start))
        return;
    cursor = end = start;
    if (!advance_over(&cursor, rl_line_buffer, (size_t)rl_point) ||
        !advance_over(&end, rl_line_buffer, (size_t)rl_end) || end.row >= end.rows ||
        is_input_waiting())
        return; /* give up: a width is unknown, a part has scrolled off the screen, or more input waits */
    kinds = kinds_of_line(&before);
    if (kinds == NULL)
        return;
    fputs("\0337", rl_outstream); /* terminal code: save the cursor position */
    move_cursor(start.row - cursor.row, start.x);
    write_line(start, kinds + before);
    fputs("\0338", rl_outstream);
    fflush(rl_outstream);
    qdot_free(kinds);
}

static void
redisplay(void)
{
    rl_redisplay();
    paint_line();
}

void
qdot_input_colours_install(qdot_session *s)
{
    session = s;
    if (!qdot_terminal_has_colours(rl_outstream))
        return;
    rl_initialize(); /* initialise readline now: with our redisplay function it would not read the terminal's abilities */
    rl_redisplay_function = redisplay;
}

void
qdot_input_colours_continue(const char *before)
{
    lines = before;
}
