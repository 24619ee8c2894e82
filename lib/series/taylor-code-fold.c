/* taylor-code-fold.c -- chooses the sums and products that are computed only inside their single reader. */
#include "series/taylor-generator.h"

enum {
    /* the most terms of a sum: with more, terms would wait for each other longer than in separate sums */
    most_terms = 12,
    most_depth = 8 /* deepest nesting of steps that are computed inside others */
};

typedef struct {
    uint32_t reader; /* the last step that reads the row */
    unsigned readers;
    bool wanted;     /* whether some reader needs the row itself, not only as a term of a sum */
} use;

static bool
step_is_linear(qdot_recurrence op)
{
    return op >= QDOT_T_NEG && op <= QDOT_T_SCALEOFF;
}

static bool
step_is_product(qdot_recurrence op)
{
    return op == QDOT_T_MUL || op == QDOT_T_MADD || op == QDOT_T_MSUB || op == QDOT_T_NMADD;
}

/* Whether a step uses its operand x, y or z only by adding its order k to a sum, perhaps with a factor. */
static bool
is_only_added(const qdot_taylor_step *s, int which)
{
    switch (s->op) {
    case QDOT_T_NEG:
    case QDOT_T_DIV:
    case QDOT_T_SQRT: return which == 0;
    case QDOT_T_ADD:
    case QDOT_T_SUB: return which < 2;
    case QDOT_T_SCALE: return which == 1;
    case QDOT_T_SCALEADD:
    case QDOT_T_SCALESUB:
    case QDOT_T_SCALEOFF: return which > 0;
    case QDOT_T_MADD:
    case QDOT_T_MSUB:
    case QDOT_T_NMADD: return which == 2;
    default: return false;
    }
}

static void
find_readers(const qdot_generator *g, use *uses)
{
    const qdot_taylor *t = g->t;

    for (size_t i = t->still; i < t->length + t->n_links; i++) {
        const qdot_taylor_step *s = t->steps + i;
        const double *const rows[] = {s->x, s->y, s->z};

        for (int k = 0; k < 3; k++) {
            use *u;

            if (!rows[k])
                continue;
            u = uses + qdot_code_row(g, rows[k]);
            u->reader = (uint32_t)i;
            u->readers++;
            u->wanted = u->wanted || !is_only_added(s, k);
        }
    }
    for (size_t i = 0; i < t->outputs; i++)
        uses[qdot_code_row(g, t->output[i])].wanted = true;
    for (size_t k = 0; k < t->n_blocks; k++) {
        const qdot_taylor_block *b = t->blocks + k;

        for (size_t i = 0; i < b->n; i++)
            uses[qdot_code_row(g, b->f[i])].wanted = true;
        for (size_t c = 0; c < b->n_couplings; c++)
            uses[qdot_code_row(g, b->couplings[c].M)].wanted = true;
    }
}

/* The number of terms of a step's sum before other steps are folded into it. */
static int
count_own_terms(const qdot_generator *g, const qdot_taylor_step *s)
{
    return step_is_linear(s->op) ? (s->op == QDOT_T_NEG || s->op == QDOT_T_SCALE ? 1 : 2)
                            : 2 * g->lag + 2;
}

/* Choose the steps that are folded into others, going forward, so that what a step contains is known when it is reached. */
static void
choose_folds(qdot_generator *g, const use *uses, int *terms, int *depth)
{
    const qdot_taylor *t = g->t;

    for (size_t i = t->still; i < t->length; i++) {
        terms[i] = count_own_terms(g, t->steps + i);
        g->n_slots += qdot_recurrence_looks_back(t->steps[i].op) ? QDOT_CODE_FACTORS : 0;
    }
    for (size_t i = t->still; i < t->length; i++) {
        const qdot_taylor_step *s = t->steps + i;
        const uint32_t row = qdot_code_row(g, s->to);
        const use *u = uses + row;
        size_t into = u->reader;

        g->maker[row] = (uint32_t)i;
        if (!step_is_linear(s->op) && !step_is_product(s->op))
            continue;
        if (u->wanted || u->readers != 1 || into >= t->length
            || g->row_vector[row] != QDOT_CODE_NONE
            || terms[into] + terms[i] - 1 > most_terms || depth[i] == most_depth)
            continue;
        terms[into] += terms[i] - 1;
        depth[into] = depth[into] > depth[i] ? depth[into] : depth[i] + 1;
        g->folded[row] = true;
        g->n_slots += QDOT_CODE_FOLDED_SLOTS;
    }
}

qdot_status
qdot_code_fold(qdot_generator *g)
{
    const size_t rows = g->t->rows, length = g->t->length;
    use *uses = qdot_calloc(rows + 1, sizeof *uses);
    int *terms = qdot_calloc(2 * length + 2, sizeof *terms);

    g->fold_slots = QDOT_CODE_SLOTS + g->n_slots;
    if (uses && terms) {
        find_readers(g, uses);
        choose_folds(g, uses, terms, terms + length + 1);
    }
    qdot_free(terms);
    qdot_free(uses);
    return uses && terms ? QDOT_OK : QDOT_ENOMEM;
}

/* The product a b of two factors, computed once for all orders from the first that needs it; not inside a loop. */
qdot_operand
qdot_code_composed(qdot_generator *g, qdot_operand a, qdot_operand b)
{
    enum { scratch = 0 };
    qdot_code_composition new = {a, b};
    qdot_operand to;

    for (size_t i = 0; i < g->compositions.n; i++) {
        const qdot_code_composition *c = g->compositions.at + i;

        if (c->a.reg == a.reg && c->a.offset == a.offset && c->b.reg == b.reg
            && c->b.offset == b.offset)
            return qdot_code_work(g->fold_slots + i);
    }
    to = qdot_code_work(g->fold_slots + g->compositions.n);
    if (g->k >= QDOT_CODE_ANY) /* no: in a loop over orders the product would be valid for one order only */
        g->m.status = qdot_fail(QDOT_EINVAL, "a factor is not known before a loop");
    if (qdot_vec_push(&g->compositions, new) != QDOT_OK) {
        g->m.status = QDOT_ENOMEM;
        return to;
    }
    do_one(g, QDOT_ASM_LOAD, scratch, 0, a);
    do_one(g, QDOT_ASM_MUL, scratch, scratch, b);
    do_one(g, QDOT_ASM_STORE, scratch, 0, to);
    return to;
}
