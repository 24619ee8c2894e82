/* gates.c -- finds the switching functions in equations, and which of them affect the equations at present. */
#include "sim/model/gates.h"

#include <string.h>

#include "expr/build.h"
#include "expr/elementary.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "sim/model/layer.h"

void
qdot_gates_clear(qdot_gates *g)
{
    qdot_free(g->gates.at);
    qdot_free(g->arguments.at);
    qdot_free(g->pairs.at);
    qdot_free(g->roots.at);
    qdot_free(g->decides);
    *g = (qdot_gates){0};
}

bool
qdot_gates_moves(const qdot_pool *pool, qdot_expr e)
{
    return (qdot_expr_node(pool, e)->holds
            & (QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_TIME
               | QDOT_HAS_MULTIPLIER))
           != 0;
}

static qdot_gate_kind
kind_of_gate(const qdot_pool *pool, qdot_expr e)
{
    if (!qdot_gates_moves(pool, e))
        return QDOT_GATE_PASSES;
    if (qdot_expr_kind(pool, e) == QDOT_REL)
        return QDOT_GATE_RELATION;
    if (qdot_expr_kind(pool, e) == QDOT_LOGIC)
        return QDOT_GATE_LOGIC;
    if (qdot_expr_kind(pool, e) != QDOT_FUN)
        return QDOT_GATE_PASSES;
    switch (qdot_expr_node(pool, e)->op) {
    case QDOT_IF: return QDOT_GATE_IF;
    case QDOT_MIN:
    case QDOT_MAX: return QDOT_GATE_EXTREME;
    case QDOT_ABS:
    case QDOT_SIGN:
    case QDOT_FLOOR:
    case QDOT_MOD: return QDOT_GATE_VALUE;
    default: return QDOT_GATE_PASSES;
    }
}

bool
qdot_gates_is_switch(const qdot_pool *pool, qdot_expr e)
{
    const qdot_gate_kind kind = kind_of_gate(pool, e);

    return kind == QDOT_GATE_RELATION || kind == QDOT_GATE_EXTREME || kind == QDOT_GATE_VALUE;
}

qdot_expr
qdot_gates_upright(qdot_pool *pool, qdot_expr u, bool *turned)
{
    *turned = qdot_expr_is_negative(pool, u);
    return *turned ? qdot_neg(pool, u) : u;
}

/* --- finding gates, the switching functions ------------------------------------------ */

typedef struct {
    qdot_pool *pool;
    size_t m;
    const qdot_surface *at;
    qdot_gates *g;
    qdot_walk *walk; /* for each node of the expression: index of its gate + 1; 0: the node is no gate */
} finder;

static size_t
gate_of_node(const finder *f, qdot_expr e)
{
    const size_t k = (size_t)qdot_walk_get(f->walk, e);

    return k == 0 ? SIZE_MAX : k - 1;
}

static qdot_status
append_comparison(finder *f, qdot_expr u, bool steps)
{
    qdot_gate_pair pair = {.surface = SIZE_MAX, .turned = 1, .u = u};
    bool turned = false;

    if (!steps)
        u = qdot_gates_upright(f->pool, u, &turned);
    for (size_t i = 0; i < f->m && pair.surface == SIZE_MAX; i++)
        if (f->at[i].u == u && f->at[i].steps == steps)
            pair.surface = i;
    pair.turned = turned ? -1 : 1;
    QDOT_TRY(qdot_pool_check(f->pool));
    pair.sign = qdot_expr_node(f->pool, pair.u)->sign;
    return qdot_vec_push(&f->g->pairs, pair);
}

static qdot_status
append_comparisons(finder *f, qdot_expr e, qdot_gate_kind kind)
{
    qdot_pool *pool = f->pool;
    const uint32_t n = qdot_expr_count(pool, e);
    const qdot_expr a = n > 0 ? qdot_expr_arg(pool, e, 0) : QDOT_NIL;

    if (kind == QDOT_GATE_RELATION)
        return append_comparison(f, qdot_sub(pool, a, qdot_expr_arg(pool, e, 1)), false);
    if (kind == QDOT_GATE_VALUE && qdot_expr_is_function(pool, e, QDOT_MOD))
        return append_comparison(f, qdot_div(pool, a, qdot_expr_arg(pool, e, 1)), true);
    if (kind == QDOT_GATE_VALUE)
        return append_comparison(f, a, qdot_expr_is_function(pool, e, QDOT_FLOOR));
    for (uint32_t i = 0; i < n && kind == QDOT_GATE_EXTREME; i++)
        for (uint32_t j = i + 1; j < n; j++)
            QDOT_TRY(append_comparison(f, qdot_sub(pool, qdot_expr_arg(pool, e, i), qdot_expr_arg(pool, e, j)),
                                       false));
    return QDOT_OK;
}

/* Add a node of the expression to the list of gates if it is a switching function. */
static qdot_status
add_gate(finder *f, qdot_expr e)
{
    qdot_gates *g = f->g;
    const uint32_t n = qdot_expr_kind(f->pool, e) == QDOT_SYM ? 0 : qdot_expr_count(f->pool, e);
    const qdot_gate_kind kind = kind_of_gate(f->pool, e);
    const qdot_gate gate = {.node = e, .kind = kind, .op = qdot_expr_node(f->pool, e)->op, .n = n,
                            .first = g->arguments.n, .pair = g->pairs.n};
    bool some = kind != QDOT_GATE_PASSES && kind != QDOT_GATE_IF && kind != QDOT_GATE_LOGIC;

    for (uint32_t k = 0; k < n && !some; k++)
        some = gate_of_node(f, qdot_expr_arg(f->pool, e, k)) != SIZE_MAX;
    if (!some && !qdot_layers_hold(f->pool, f->m, f->at, e))
        return QDOT_OK;
    for (uint32_t k = 0; k < n; k++)
        QDOT_TRY(qdot_vec_push(&g->arguments, gate_of_node(f, qdot_expr_arg(f->pool, e, k))));
    QDOT_TRY(append_comparisons(f, e, kind));
    g->branches |= kind == QDOT_GATE_IF || kind == QDOT_GATE_LOGIC || kind == QDOT_GATE_EXTREME;
    QDOT_TRY(qdot_vec_push(&g->gates, gate));
    qdot_walk_set(f->walk, e, g->gates.n);
    return QDOT_OK;
}

qdot_status
qdot_gates_find(qdot_pool *pool, size_t m, const qdot_surface *at, size_t n, const qdot_expr *e,
                bool deciding, qdot_gates *g)
{
    const size_t most = n + (deciding ? m : 0);
    qdot_expr *roots = qdot_calloc(most + 1, sizeof *roots);
    qdot_walk walk;
    finder f = {pool, m, at, g, &walk};
    qdot_status status = roots ? QDOT_OK : QDOT_ENOMEM;
    size_t count = 0;

    *g = (qdot_gates){.surfaces = m};
    g->decides = qdot_calloc(m + 1, sizeof *g->decides);
    if (!g->decides)
        status = QDOT_ENOMEM;
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        if (e[i] != QDOT_NIL)
            roots[count++] = e[i];
    for (size_t i = 0; i < m && deciding && status == QDOT_OK; i++)
        roots[count++] = at[i].u;
    if (status == QDOT_OK)
        status = qdot_walk_begin_n(pool, count, roots, &walk);
    if (status == QDOT_OK) {
        for (size_t i = 0; i < walk.n && status == QDOT_OK; i++)
            status = add_gate(&f, walk.at[i]);
        for (size_t i = 0; i < n && status == QDOT_OK; i++)
            if (e[i] != QDOT_NIL && gate_of_node(&f, e[i]) != SIZE_MAX)
                status = qdot_vec_push(&g->roots, gate_of_node(&f, e[i]));
        for (size_t i = 0; i < m && status == QDOT_OK; i++)
            g->decides[i] = deciding ? gate_of_node(&f, at[i].u) : SIZE_MAX;
        qdot_walk_end(&walk);
    }
    qdot_free(roots);
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    if (status != QDOT_OK)
        qdot_gates_clear(g);
    return status;
}

/* --- finding which gates are open: which of them matter ------------------------------ */

int
qdot_gates_sign(const qdot_gate_pair *pair, const int64_t *side, const int64_t *corner,
                bool *known)
{
    const uint8_t s = pair->sign;
    int64_t own;

    *known = true;
    if (pair->surface == SIZE_MAX) {
        if (s & QDOT_GE0 && s & (QDOT_NE0 | QDOT_LE0))
            return s & QDOT_NE0 ? 1 : 0;
        *known = (s & QDOT_NEG) == QDOT_NEG;
        return -1;
    }
    own = side ? side[pair->surface] : QDOT_SIDE_OPEN;
    if (own == QDOT_SIDE_SLIDES && corner)
        own = corner[pair->surface];
    *known = own != QDOT_SIDE_SLIDES && own != QDOT_SIDE_OPEN && own != QDOT_SIDE_IDLE;
    return pair->turned * ((own > 0) - (own < 0));
}

typedef struct {
    const qdot_gates *g;
    const int64_t *side, *corner;
    uint8_t *open;
    bool again;
} opening;

static void
find_truth_value(const opening *o, size_t i)
{
    enum { either = QDOT_GATE_FALSE | QDOT_GATE_TRUE };
    const qdot_gate *gate = &o->g->gates.at[i];
    const uint16_t op = gate->op;
    uint8_t truth = either;
    bool known;

    if (gate->kind == QDOT_GATE_RELATION) {
        const int sign = qdot_gates_sign(&o->g->pairs.at[gate->pair], o->side, o->corner, &known);
        const bool holds = op == QDOT_LT ? sign < 0 : op == QDOT_LE ? sign <= 0 : sign == 0;

        if (known)
            truth = holds ? QDOT_GATE_TRUE : QDOT_GATE_FALSE;
    } else if (gate->kind == QDOT_GATE_LOGIC) {
        /* the truth value of one argument that decides the result of `and` or `or` */
        const uint8_t decisive = op == QDOT_AND ? QDOT_GATE_FALSE : QDOT_GATE_TRUE;

        truth = op == QDOT_NOT ? 0 : (uint8_t)(either - decisive);
        for (uint32_t k = 0; k < gate->n; k++) {
            const size_t argument = o->g->arguments.at[gate->first + k];
            const uint8_t of = argument == SIZE_MAX ? either : o->open[argument] & either;

            if (op == QDOT_NOT)
                truth = (uint8_t)(((of & QDOT_GATE_FALSE) << 1) | ((of & QDOT_GATE_TRUE) >> 1));
            else if (of == decisive)
                truth = decisive;
            else if (truth != decisive)
                truth |= of;
        }
    }
    o->open[i] = truth;
}

static void
mark_gate_evaluated(opening *o, size_t of, size_t argument)
{
    if (argument == SIZE_MAX || o->open[argument] & QDOT_GATE_OPEN)
        return;
    o->open[argument] |= QDOT_GATE_OPEN;
    o->again |= argument > of;
}

static void
mark_comparison_evaluated(opening *o, size_t of, const qdot_gate_pair *pair)
{
    if (pair->surface == SIZE_MAX)
        return;
    o->open[o->g->gates.n + pair->surface] = QDOT_GATE_OPEN;
    mark_gate_evaluated(o, of, o->g->decides[pair->surface]);
}

/* Mark the arguments of max or min that may be the extreme one, and the comparisons that decide which is. */
static void
mark_extreme_arguments(opening *o, size_t i, const size_t *arguments)
{
    const qdot_gate *gate = &o->g->gates.at[i];
    const int way = gate->op == QDOT_MAX ? 1 : -1;
    const qdot_gate_pair *pair = o->g->pairs.at + gate->pair;
    bool won = false;

    for (uint32_t a = 0; a < gate->n && !won; a++) {
        bool may = true;

        won = true;
        for (uint32_t b = a + 1; b < gate->n; b++, pair++) {
            bool known;
            int sign = way * qdot_gates_sign(pair, o->side, NULL, &known);

            if (!may)
                continue;
            if (pair->surface != SIZE_MAX && o->side && o->side[pair->surface] == QDOT_SIDE_SLIDES) {
                sign = 0; /* both arguments are equal on a surface along which the motion slides */
                known = true;
            }
            mark_comparison_evaluated(o, i, pair);
            won &= known && sign >= 0;
            may = !known || sign >= 0;
        }
        if (may)
            mark_gate_evaluated(o, i, arguments[a]);
    }
}

static void
mark_arguments(opening *o, size_t i)
{
    const qdot_gate *gate = &o->g->gates.at[i];
    const size_t *arguments = o->g->arguments.at + gate->first;
    bool goes_on = true;

    switch (gate->kind) {
    case QDOT_GATE_EXTREME: mark_extreme_arguments(o, i, arguments); return;
    case QDOT_GATE_IF: {
        const uint8_t truth = arguments[0] == SIZE_MAX ? QDOT_GATE_FALSE | QDOT_GATE_TRUE
                                                       : o->open[arguments[0]];

        mark_gate_evaluated(o, i, arguments[0]);
        if (truth & QDOT_GATE_TRUE)
            mark_gate_evaluated(o, i, arguments[1]);
        if (truth & QDOT_GATE_FALSE)
            mark_gate_evaluated(o, i, arguments[2]);
        return;
    }
    case QDOT_GATE_LOGIC: /* operands of `and`, `or` are evaluated in order, up to the first that decides */
        for (uint32_t k = 0; k < gate->n && goes_on; k++) {
            mark_gate_evaluated(o, i, arguments[k]);
            if (gate->op != QDOT_NOT && arguments[k] != SIZE_MAX)
                goes_on = o->open[arguments[k]] & (gate->op == QDOT_AND ? QDOT_GATE_TRUE : QDOT_GATE_FALSE);
        }
        return;
    case QDOT_GATE_RELATION:
    case QDOT_GATE_VALUE: mark_comparison_evaluated(o, i, &o->g->pairs.at[gate->pair]); break;
    case QDOT_GATE_PASSES: break;
    }
    for (uint32_t k = 0; k < gate->n; k++)
        mark_gate_evaluated(o, i, arguments[k]);
}

void
qdot_gates_open(const qdot_gates *g, const int64_t *side, const int64_t *corner, uint8_t *open)
{
    opening o = {g, side, corner, open, true};

    memset(open, 0, g->gates.n + g->surfaces);
    for (size_t i = 0; i < g->gates.n; i++)
        find_truth_value(&o, i);
    for (size_t i = 0; i < g->roots.n; i++)
        open[g->roots.at[i]] |= QDOT_GATE_OPEN;
    while (o.again) {
        o.again = false;
        for (size_t i = g->gates.n; i-- > 0;)
            if (open[i] & QDOT_GATE_OPEN)
                mark_arguments(&o, i);
    }
}
