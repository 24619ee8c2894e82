/* motion.c -- finds by how many orders each row of a motion leads, and which rows contain unknown
 * coefficients. */
#include "series/motion.h"

#include <string.h>

#include "series/alike.h"

/* The largest numbers of rows that a step of the program reads, and that it writes. */
enum { READS = 3, WRITES = 4 };

static void
list_rows_read(const qdot_program_step *s, qdot_program_row rows[READS])
{
    rows[0] = s->x;
    rows[1] = s->y;
    rows[2] = s->z;
}

static void
list_rows_written(const qdot_program_step *s, qdot_program_row rows[WRITES])
{
    rows[0] = s->to;
    rows[1] = s->second;
    rows[2] = s->third;
    rows[3] = s->d;
}

/* The number of orders by which a step must read its operands ahead of its result. */
static int
orders_read_ahead(const qdot_program_step *s)
{
    return s->op == QDOT_T_RATE;
}

/* Find the lead of each step (by how many orders it is ahead): the largest lead asked of its rows. */
static void
find_leads(qdot_program *p)
{
    qdot_program_row rows[WRITES];

    for (size_t i = p->length; i-- > p->still;) {
        qdot_program_step *s = p->steps.at + i;

        s->lead = 0;
        list_rows_written(s, rows);
        for (int k = 0; k < WRITES; k++)
            if (rows[k] != QDOT_NO_ROW && p->rows.at[rows[k]].lead > s->lead)
                s->lead = (signed char)p->rows.at[rows[k]].lead;
        for (int k = 0; k < WRITES; k++)
            if (rows[k] != QDOT_NO_ROW)
                p->rows.at[rows[k]].lead = s->lead;
        if (s->lead > p->lead)
            p->lead = s->lead;
        list_rows_read(s, rows);
        for (int k = 0; k < READS; k++) {
            qdot_program_row_info *row = p->rows.at + rows[k];

            if (row->lead < s->lead + orders_read_ahead(s))
                row->lead = s->lead + orders_read_ahead(s);
        }
    }
}

/* Record the order (lead) to which an input is known; newest [rows]: rows that contain unknowns. */
static qdot_status
record_known_row(qdot_motion *m, qdot_program_row at, int known, bool solved, bool *newest)
{
    qdot_program_row_info *row;

    if (at == QDOT_NO_ROW)
        return QDOT_OK;
    row = m->program.rows.at + at;
    if (row->lead > known)
        return qdot_fail(QDOT_ENOTBUILT,
                         "not built yet: a series that is read before it is known");
    row->lead = known;
    newest[at] = solved;
    return QDOT_OK;
}

static qdot_status
record_known_unknown(qdot_motion *m, const qdot_motion_unknown *u, bool *newest)
{
    const bool solved = u->value == QDOT_NO_ROW;

    QDOT_TRY(record_known_row(m, u->row, 0, solved, newest));
    QDOT_TRY(record_known_row(m, u->once, solved ? 1 : 0, solved, newest));
    return record_known_row(m, u->twice, solved ? 2 : 0, solved, newest);
}

/* Mark those operands that a step reads at their newest order. */
static void
mark_newest_operands(qdot_program *p, bool *newest)
{
    qdot_program_row rows[WRITES];

    for (size_t i = p->still; i < p->length; i++) {
        qdot_program_step *s = p->steps.at + i;

        s->newest = 0;
        list_rows_read(s, rows);
        for (int k = 0; k < READS; k++)
            if (newest[rows[k]] && p->rows.at[rows[k]].lead == s->lead + orders_read_ahead(s))
                s->newest |= (unsigned char)(QDOT_X_NEWEST << k);
        list_rows_written(s, rows);
        for (int k = 0; k < WRITES; k++)
            if (rows[k] != QDOT_NO_ROW)
                newest[rows[k]] = s->newest != 0;
    }
}

/* Whether the sums of a step contain lower orders of its own results or of its operands. */
static bool
sums_lower_orders(const qdot_program_step *s)
{
    return qdot_recurrence_looks_back(s->op) && s->op > QDOT_T_NMADD;
}

static bool
sums_lower_orders_of(const qdot_program_step *s, int operand)
{
    return qdot_recurrence_looks_back(s->op) && (operand < 2 || s->op > QDOT_T_NMADD);
}

/* A step is kept if a row of it is read at lower orders, by a step that leads less, or by one
 * that is kept; read [rows]. */
static void
mark_kept_steps(qdot_program *p, bool *read)
{
    qdot_program_row rows[WRITES];

    for (size_t i = 0; i < p->outputs.n; i++)
        read[p->outputs.at[i]] = true;
    for (size_t i = p->length; i-- > p->still;) {
        qdot_program_step *s = p->steps.at + i;

        s->kept = s->newest && sums_lower_orders(s);
        list_rows_written(s, rows);
        for (int k = 0; k < WRITES; k++)
            s->kept = s->kept || (s->newest && rows[k] != QDOT_NO_ROW && read[rows[k]]);
        list_rows_read(s, rows);
        for (int k = 0; k < READS; k++)
            read[rows[k]] = read[rows[k]] || s->kept || sums_lower_orders_of(s, k)
                            || p->rows.at[rows[k]].lead > s->lead + orders_read_ahead(s);
    }
}

qdot_status
qdot_motion_arrange(qdot_motion *m)
{
    qdot_program *p = &m->program;
    bool *newest = qdot_calloc(p->rows.n + 1, sizeof *newest);
    qdot_status status = QDOT_OK;

    if (!newest)
        return QDOT_ENOMEM;
    find_leads(p);
    for (size_t i = 0; i < m->unknowns.n && status == QDOT_OK; i++)
        status = record_known_unknown(m, m->unknowns.at + i, newest);
    if (status == QDOT_OK) {
        mark_newest_operands(p, newest);
        memset(newest, 0, p->rows.n * sizeof *newest);
        mark_kept_steps(p, newest);
    }
    qdot_free(newest);
    return status;
}

qdot_status
qdot_motion_complete(qdot_motion *m, qdot_program_builder *b, qdot_status status)
{
    const qdot_status ended = qdot_program_end(b);

    if (status == QDOT_OK)
        status = ended;
    if (status == QDOT_OK)
        status = qdot_motion_arrange(m);
    if (status != QDOT_OK)
        qdot_motion_clear(m);
    return status;
}

qdot_status
qdot_motion_give(qdot_motion *m, qdot_program_row value, qdot_program_row once,
                 qdot_program_row twice)
{
    const qdot_motion_unknown u = {value, QDOT_NO_ROW, once, twice};

    return qdot_vec_push(&m->unknowns, u);
}

qdot_status
qdot_motion_solve(qdot_motion *m, qdot_motion_unknown u, qdot_program_row equation)
{
    u.value = QDOT_NO_ROW;
    QDOT_TRY(qdot_vec_push(&m->solved, (uint32_t)m->unknowns.n));
    QDOT_TRY(qdot_vec_push(&m->equations, equation));
    return qdot_vec_push(&m->unknowns, u);
}

qdot_status
qdot_motion_end_block(qdot_motion *m)
{
    if (m->blocks.n == 0)
        QDOT_TRY(qdot_vec_push(&m->blocks, 0));
    return qdot_vec_push(&m->blocks, (uint32_t)m->solved.n);
}

static void
add_product_to_equation(qdot_program_builder *b, qdot_program_row K, qdot_program_row u, qdot_motion_line *to)
{
    if (to->right == QDOT_NO_ROW)
        return;
    to->E = to->E == QDOT_NO_ROW ? qdot_program_operation(b, QDOT_OP_MSUB, K, u, to->right)
                                 : qdot_program_operation(b, QDOT_OP_MADD, K, u, to->E);
}

/* Write the equations as rows; constant factors come last, as they add nothing before the unknowns are known. */
void
qdot_motion_write(const qdot_motion *m, qdot_program_builder *b, size_t from,
                  qdot_motion_line *lines, size_t first, size_t end)
{
    for (size_t i = first; i < end; i++)
        if (lines[i].right != QDOT_NO_ROW)
            lines[i].E = QDOT_NO_ROW;
    for (int number = 0; number < 2; number++)
        for (size_t k = from; k < m->entries.n; k++) {
            const qdot_motion_entry *x = m->entries.at + k;

            if (m->program.rows.n > 0 /* none: its end fails */ && m->program.rows.at[x->at].still != number)
                continue;
            add_product_to_equation(b, x->at, lines[x->j].u, lines + x->i);
            if (x->i != x->j)
                add_product_to_equation(b, x->at, lines[x->i].u, lines + x->j);
        }
    for (size_t i = first; i < end; i++)
        if (lines[i].right != QDOT_NO_ROW && lines[i].E == QDOT_NO_ROW)
            lines[i].E = qdot_program_operation(b, QDOT_OP_NEG, lines[i].right, 0, 0);
}

void
qdot_motion_clear(qdot_motion *m)
{
    qdot_program_clear(&m->program);
    qdot_free(m->unknowns.at);
    qdot_free(m->solved.at);
    qdot_free(m->equations.at);
    qdot_free(m->blocks.at);
    qdot_free(m->entries.at);
    qdot_free(m->right.at);
    qdot_alike_free(m->alike);
    *m = (qdot_motion){0};
}
