/* usage.c -- compiles the usage text of a statement to an automaton that follows its tokens. */
#include "lang/syntax/usage.h"

#include <ctype.h>

#include "lang/syntax/holes.h"

/* --- the tokens of a usage text ------------------------------------------------------ */

typedef enum { WORD, HOLE, SIGN, OPEN, CLOSE, BAR, TIGHT, MORE } piece_kind;

typedef struct {
    piece_kind kind;
    char text[QDOT_USAGE_TEXT];
} piece;

enum { PIECES = 160, TO_END = -1 };

typedef struct {
    qdot_usage *u;
    const char *word; /* first word of the statement */
    piece piece[PIECES];
    int n;
    char before[QDOT_USAGE_TEXT]; /* the word of the usage text that was compiled last */
    unsigned options;
    int depth;          /* bracket depth at the present piece of the usage text */
    int tail, tail_end; /* range of nodes: the alternatives at the end of the present piece; empty if the ends are equal */
    int alternative;
    int again;          /* node after the statement's word, to which a repetition `[| plot ...]` returns */
    bool failed;
} compiler;

static void
add_piece(compiler *c, piece_kind kind, const char *text, size_t length)
{
    if (c->n >= PIECES || length >= QDOT_USAGE_TEXT) {
        c->failed = true;
        return;
    }
    c->piece[c->n].kind = kind;
    memcpy(c->piece[c->n].text, text, length);
    c->piece[c->n++].text[length] = '\0';
}

/* The end of a placeholder's name in the usage text: NAME, T0..T1, Q', F(ARGUMENTS). */
static const char *
end_of_placeholder(const char *at)
{
    while (isupper((unsigned char)*at) || isdigit((unsigned char)*at) || *at == '\'' ||
           *at == '_')
        at++;
    if (strncmp(at, "..", 2) == 0 && isupper((unsigned char)at[2]))
        return end_of_placeholder(at + 2);
    if (*at == '(' && strchr(at, ')') != NULL)
        return strchr(at, ')') + 1;
    return at;
}

static const char *
add_next_piece(compiler *c, const char *at, bool blank)
{
    const char *end = at + 1;

    if (strncmp(at, "...", 3) == 0) {
        add_piece(c, MORE, at, 3);
        return at + 3;
    }
    if (islower((unsigned char)*at)) {
        while (islower((unsigned char)*end) || *end == '_' ||
               isdigit((unsigned char)*end))
            end++;
        add_piece(c, WORD, at, (size_t)(end - at));
    } else if (isupper((unsigned char)*at)) {
        end = end_of_placeholder(at);
        add_piece(c, HOLE, at, (size_t)(end - at));
    } else if (*at == '"' && strchr(end, '"') != NULL) {
        end = strchr(end, '"') + 1;
        add_piece(c, HOLE, at, (size_t)(end - at));
    } else if (*at == '(' && strchr(end, ')') != NULL) {
        end = strchr(end, ')') + 1;
        add_piece(c, HOLE, at, (size_t)(end - at));
    } else if (isdigit((unsigned char)*at)) {
        add_piece(c, HOLE, at, 1);
    } else if (*at == '[' || *at == ']') {
        add_piece(c, *at == '[' ? OPEN : CLOSE, at, 1);
    } else if (*at == '|') {
        const bool sign = c->n > 0 && c->piece[c->n - 1].kind == OPEN;

        add_piece(c, sign ? SIGN : blank ? BAR : TIGHT, at, 1);
    } else {
        end += at[0] == '=' && at[1] == '=';
        add_piece(c, SIGN, at, (size_t)(end - at));
    }
    return end;
}

/* --- making the automaton ------------------------------------------------------------ */

static int
append_node(compiler *c, int kind, const char *text)
{
    qdot_usage *u = c->u;
    qdot_usage_node *node = &u->node[u->n < QDOT_USAGE_NODES ? u->n : 0];

    if (u->n >= QDOT_USAGE_NODES) {
        c->failed = true;
        return 0;
    }
    *node = (qdot_usage_node){.next = u->n + 1, .other = -1, .alternative = c->alternative};
    node->kind = kind;
    strcpy(node->text, text);
    strcpy(node->before, c->before);
    node->hole = kind == QDOT_USAGE_HOLE ? qdot_hole_find(c->word, c->before, text) : -1;
    return u->n++;
}

static void compile(compiler *c, int from, int to);

/* The index of the piece after the end of the bracketed group of the usage text that begins at piece i. */
static int
piece_after_group(const compiler *c, int i, int to)
{
    int depth = 0;

    do {
        depth += c->piece[i].kind == OPEN;
        depth -= c->piece[i].kind == CLOSE;
        i++;
    } while (depth > 0 && i < to);
    return i;
}

/* The first piece of that kind and text in [from, to), outside of bracketed groups; `to` if there is none. */
static int
find_piece(const compiler *c, int from, int to, piece_kind kind, const char *text)
{
    while (from < to && (c->piece[from].kind != kind ||
                         (text != NULL && strcmp(c->piece[from].text, text) != 0)))
        from = c->piece[from].kind == OPEN ? piece_after_group(c, from, to) : from + 1;
    return from < to ? from : to;
}

/* Let the jumps TO_END among the nodes [start, last] lead to the node after all nodes compiled so far. */
static void
direct_jumps_to_end(compiler *c, int start, int last)
{
    for (int i = start; i <= last; i++)
        if (c->u->node[i].next == TO_END)
            c->u->node[i].next = c->u->n;
}

/* Compile the alternatives of the usage text in the pieces [from, to), cut at each separator. */
static void
compile_alternatives(compiler *c, int from, int to, piece_kind kind, const char *separator)
{
    const int start = c->u->n;
    char before[QDOT_USAGE_TEXT];
    int last = -1; /* index of the latest node that jumps to the end */

    strcpy(before, c->before);
    for (;;) {
        const int end = find_piece(c, from, to, kind, separator);
        const int fork = end < to ? append_node(c, QDOT_USAGE_FORK, "") : -1;

        strcpy(c->before, before); /* no alternative stands behind a word of another */
        compile(c, from, end);
        if (end >= to)
            break;
        last = append_node(c, QDOT_USAGE_FORK, "");
        c->u->node[last].next = TO_END;
        c->u->node[fork].other = c->u->n;
        from = end + 1;
    }
    direct_jumps_to_end(c, start, last);
}

/* The most options and clauses of a statement that may come in any order. */
enum { MEMBERS = 24 };
typedef struct {
    struct {
        int from, to;   /* range of pieces of the usage text that it consists of */
        int first;      /* first of several alternatives, one of which is required; -1: an option */
    } at[MEMBERS];
    int n;
} members;

static void
add_option_or_clause(compiler *c, members *m, int from, int to, int first)
{
    if (m->n >= MEMBERS) {
        c->failed = true;
        return;
    }
    m->at[m->n].from = from;
    m->at[m->n].to = to;
    m->at[m->n++].first = first;
}

/* Collect the options [a] [b] [c] of a usage text, from piece i on; returns the index after them. */
static int
collect_options(compiler *c, int i, int to, members *m)
{
    int k;

    for (; i < to && c->piece[i].kind == OPEN; i = k) {
        k = piece_after_group(c, i, to);
        add_option_or_clause(c, m, i + 1, k - 1, -1);
    }
    return i;
}

/* Whether a clause `word PLACEHOLDER` begins at piece i that is not an alternative of the statement. */
static bool
is_clause(const compiler *c, int i, int to)
{
    return i + 1 < to && c->piece[i].kind == WORD && c->piece[i + 1].kind == HOLE &&
           strcmp(c->piece[i].text, c->word) != 0;
}

/* Clauses from i on, with the options among them; i: there are less than two, or no one between an operand and options
 * that end the usage: `EXPR, ... every DT [to "FILE"]`. */
static int
collect_clauses(compiler *c, int i, int to, members *m)
{
    const bool behind = i > 0 && (c->piece[i - 1].kind == HOLE || c->piece[i - 1].kind == MORE);
    const int start = i;
    int clauses = 0, k;

    while (i < to) {
        if (c->piece[i].kind == OPEN) {
            i = collect_options(c, i, to, m);
            continue;
        }
        if (!is_clause(c, i, to))
            break;
        for (k = i + 1; k < to && c->piece[k].kind != WORD && c->piece[k].kind != OPEN; k++)
            if (c->piece[k].kind != HOLE && strcmp(c->piece[k].text, ",") != 0)
                return start;
        add_option_or_clause(c, m, i, k, m->n);
        clauses++;
        i = k;
    }
    return clauses + (behind && i == to && m->n > 1) < 2 ? start : i;
}

/* Whether one of the options has the form `word PLACEHOLDER`, like a clause. */
static bool
has_option_like_clause(const compiler *c, const members *m)
{
    for (int k = 0; k < m->n; k++)
        if (is_clause(c, m->at[k].from, m->at[k].to))
            return true;
    return false;
}

/* Collect the clauses after options in a usage text, as in `[title TEXT] to "FILE"`. */
static int
collect_clauses_after_options(compiler *c, int i, int to, members *m)
{
    while (is_clause(c, i, to)) {
        int k = i + 1;

        while (k < to && (c->piece[k].kind == HOLE || c->piece[k].kind == TIGHT))
            k++;
        add_option_or_clause(c, m, i, k, m->n);
        i = k;
    }
    return i;
}

/* Collect the alternatives [a|b|c) of a usage text that end its clauses. */
static void
collect_final_alternatives(compiler *c, members *m)
{
    const int first = m->n;

    for (int i = c->tail; i < c->tail_end;) {
        const int end = find_piece(c, i, c->tail_end, BAR, NULL);

        add_option_or_clause(c, m, i, end, first);
        i = end + 1;
    }
    c->tail = c->tail_end;
}

/* Compile options and clauses that may come in any order, each at most once. */
static void
compile_options_and_clauses(compiler *c, const members *m)
{
    const int start = c->u->n;
    char before[QDOT_USAGE_TEXT];

    for (int k = 0; k <= m->n; k++)
        (void)append_node(c, QDOT_USAGE_FORK, ""); /* the last of these forks leads to the end */
    strcpy(before, c->before);
    for (int k = 0; k < m->n && !c->failed; k++) {
        const uint64_t own = (uint64_t)1 << (c->options++ & 63);

        c->u->node[start + k].next = c->u->n;
        c->u->node[start + k].other = start + k + 1;
        c->u->node[start + k].enters = own;
        for (int i = m->at[k].first; i >= 0 && i < m->n; i++)
            if (m->at[i].first == m->at[k].first)
                c->u->node[start + i].needs |= own;
        for (int i = 0; i < k && m->at[k].first >= 0; i++)
            if (m->at[i].first < 0)
                c->u->node[start + i].later |= own;
        strcpy(c->before, before);
        c->depth++;
        compile(c, m->at[k].from, m->at[k].to);
        c->depth--;
        c->u->node[append_node(c, QDOT_USAGE_FORK, "")].next = start;
    }
    c->u->node[start + m->n].next = c->u->n;
    strcpy(c->before, before);
    c->failed = c->failed || c->options > 64;
}

/* Compile a list X, Y, ... of a usage text: the pieces [from, comma), which end before the last comma. */
static void
compile_list(compiler *c, int from, int comma)
{
    const int start = c->u->n;
    const unsigned options = c->options;
    int fork;

    compile_alternatives(c, from, comma, SIGN, ",");
    fork = append_node(c, QDOT_USAGE_FORK, "");
    (void)append_node(c, QDOT_USAGE_SIGN, ",");
    c->u->node[fork].next = fork + 1;
    c->u->node[fork].other = fork + 3;
    fork = append_node(c, QDOT_USAGE_FORK, "");
    c->u->node[fork].next = start;
    for (unsigned k = options; k < c->options && k < 64; k++)
        c->u->node[fork].forgets |= (uint64_t)1 << k;
}

/* Compile the alternatives a|b|c of a usage text at piece i; returns the index after them. */
static int
compile_words(compiler *c, int i, int to)
{
    int end = i + 1;

    while (end + 1 < to && c->piece[end].kind == TIGHT)
        end += 2;
    if (end > i + 1) {
        compile_alternatives(c, i, end, TIGHT, NULL);
    } else {
        const bool word = c->piece[i].kind == WORD;

        (void)append_node(c, word ? QDOT_USAGE_WORD : QDOT_USAGE_HOLE, c->piece[i].text);
        if (word)
            strcpy(c->before, c->piece[i].text);
        if (word && strcmp(c->piece[i].text, c->word) == 0)
            c->again = c->u->n;
    }
    return end;
}

/* Whether the pieces [i, more) contain a word behind the begin of an item of a list: the items of `CONDITION, returns after T`
 * begin with words, those of `EXPR vs EXPR` do not. */
static bool
item_contains_word(const compiler *c, int i, int more)
{
    for (i = find_piece(c, i, more, WORD, NULL); i < more;
         i = find_piece(c, i + 1, more, WORD, NULL))
        if (strcmp(c->piece[i - 1].text, ",") != 0 && c->piece[i - 1].kind != WORD)
            return true;
    return false;
}

/* The last comma of the list in a usage text that begins at piece i; i if there is no list. */
static int
end_of_list(const compiler *c, int i, int to)
{
    const int more = find_piece(c, i, to, MORE, NULL);

    if (more >= to || more == i || strcmp(c->piece[more - 1].text, ",") != 0 ||
        item_contains_word(c, i, more) ||
        find_piece(c, i, more, SIGN, ":") < find_piece(c, i, more, SIGN, ","))
        return i;
    return more - 1;
}

/* The index after the relations and expressions that are read together with a placeholder of that class. */
static int
piece_after_relation(const compiler *c, int i, int to, qdot_hole_class class)
{
    if (class == QDOT_HOLE_DOMAIN)
        for (bool option; i + 1 < to; i += option ? 4 : 2) {
            option = c->piece[i].kind == OPEN;
            if (strchr("<>", c->piece[i + option].text[0]) == NULL)
                break;
        }
    else if (i + 1 < to && (strcmp(c->piece[i].text, "==") == 0 ||
                            (strcmp(c->piece[i].text, "=") == 0 && class == QDOT_HOLE_EQUATION)))
        i += 2;
    return i;
}

/* Whether the option at piece i is a placeholder directly after the statement's word: `animate [RUN]`. */
static bool
is_placeholder_after_word(const compiler *c, int i)
{
    return c->depth == 0 && i > 0 && c->piece[i - 1].kind == WORD && strcmp(c->piece[i - 1].text, c->word) == 0 &&
           c->piece[i + 1].kind == HOLE;
}

/* Compile pieces of a usage text in sequence; they contain no alternatives. */
static void
compile_sequence(compiler *c, int i, int to)
{
    while (i < to && !c->failed) {
        const piece *p = &c->piece[i];
        const int comma = p->kind == HOLE ? end_of_list(c, i, to) : i;
        members m = {.n = 0};
        int fork, behind = p->kind == WORD && c->depth == 0 ? collect_clauses(c, i, to, &m) : i;

        if (behind > i) {
            if (behind == to)
                collect_final_alternatives(c, &m);
            compile_options_and_clauses(c, &m);
            i = behind;
        } else if (comma > i) {
            compile_list(c, i, comma);
            i = comma + 2;
        } else if (p->kind == WORD && i + 1 < to && c->piece[i + 1].kind == MORE &&
                   strcmp(p->text, c->word) == 0) { /* the statement's word again: another form of the statement begins */
            (void)append_node(c, QDOT_USAGE_WORD, p->text);
            fork = append_node(c, QDOT_USAGE_FORK, "");
            c->u->node[fork].next = c->again;
            c->u->node[fork].forgets = UINT64_MAX;
            i += 2;
        } else if (p->kind == WORD ||
                   (p->kind == HOLE && i + 1 < to && c->piece[i + 1].kind == TIGHT)) {
            i = compile_words(c, i, to);
        } else if (p->kind == OPEN) {
            m.n = 0;
            if (is_placeholder_after_word(c, i)) {
                add_option_or_clause(c, &m, i + 1, piece_after_group(c, i, to) - 1, -1);
                i = piece_after_group(c, i, to);
            } else {
                i = collect_options(c, i, to, &m);
                if (c->depth == 0 && has_option_like_clause(c, &m))
                    i = collect_clauses_after_options(c, i, to, &m);
            }
            compile_options_and_clauses(c, &m);
        } else if (p->kind == SIGN) {
            (void)append_node(c, QDOT_USAGE_SIGN, p->text);
            i++;
        } else if (p->kind == MORE) { /* the sign `...`: any number of repetitions */
            fork = append_node(c, QDOT_USAGE_FORK, "");
            (void)append_node(c, QDOT_USAGE_HOLE, p->text);
            c->u->node[append_node(c, QDOT_USAGE_FORK, "")].next = fork;
            c->u->node[fork].other = c->u->n;
            i++;
        } else if (p->kind == HOLE) {
            const int hole = append_node(c, QDOT_USAGE_HOLE, p->text);

            i = piece_after_relation(c, i + 1, to, qdot_hole_at(c->u->node[hole].hole)->class);
        } else {
            c->failed = true;
        }
    }
}

/* Compile the alternatives of a usage text that begin at the last word before the first bar. */
static void
compile_final_alternatives(compiler *c, int from, int to)
{
    const int bar = find_piece(c, from, to, BAR, NULL);
    int last = from;

    for (int i = find_piece(c, from, bar, WORD, NULL); i < bar;
         i = find_piece(c, i + 1, bar, WORD, NULL))
        last = i;
    if (bar == to) {
        compile_sequence(c, from, to);
    } else if (last > from) {
        c->tail = last;
        c->tail_end = to;
        compile_sequence(c, from, last);
        last = c->tail;
        c->tail = c->tail_end = 0;
        if (last < to)
            compile_alternatives(c, last, to, BAR, NULL);
    } else {
        compile_alternatives(c, from, to, BAR, NULL);
    }
}

/* Compile the alternatives of a usage text: first those that begin with the statement's word. */
static void
compile(compiler *c, int from, int to)
{
    const int start = c->u->n;
    int last = -1;

    for (;;) {
        int end = find_piece(c, from, to, BAR, NULL), fork;

        while (end < to && strcmp(c->piece[end + 1].text, c->word) != 0)
            end = find_piece(c, end + 1, to, BAR, NULL);
        if (end >= to)
            break;
        fork = append_node(c, QDOT_USAGE_FORK, "");
        compile_final_alternatives(c, from, end);
        last = append_node(c, QDOT_USAGE_FORK, "");
        c->u->node[last].next = TO_END;
        c->u->node[fork].other = c->u->n;
        from = end + 1;
        c->alternative++;
    }
    compile_final_alternatives(c, from, to);
    direct_jumps_to_end(c, start, last);
}

static void
cut_into_pieces(compiler *c, const char *text)
{
    c->n = 0;
    for (const char *at = text + strspn(text, " "); *at != '\0' && !c->failed;) {
        at = add_next_piece(c, at, at > text && at[-1] == ' ');
        at += strspn(at, " ");
    }
}

static void
compile_text(compiler *c, const char *text)
{
    cut_into_pieces(c, text);
    if (!c->failed)
        compile(c, 0, c->n);
}

static compiler
begin(qdot_usage *u, const char *word, const char *usage)
{
    compiler c = {.u = u, .word = word};

    u->n = 0;
    u->word = word;
    compile_text(&c, usage);
    return c;
}

static bool
end(compiler *c)
{
    (void)append_node(c, QDOT_USAGE_END, "");
    return !c->failed;
}

bool
qdot_usage_compile(qdot_usage *u, const char *word, const char *usage)
{
    compiler c = begin(u, word, usage);

    return end(&c);
}

bool
qdot_usage_compile_with_end(qdot_usage *u, const char *word, const char *usage, bool answers)
{
    compiler c = begin(u, word, usage);

    c.word = "for"; /* the clause's own holes */
    compile_text(&c, answers ? "[to \"FILE\"] [for NAME = A..B, ...]" : "[for NAME = A..B, ...]");
    return end(&c);
}

bool
qdot_usage_has_word(const qdot_usage *u, const char *name)
{
    for (int i = 0; i < u->n; i++)
        if (u->node[i].kind == QDOT_USAGE_WORD && strcmp(u->node[i].text, name) == 0)
            return true;
    return false;
}
