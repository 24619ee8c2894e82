/* switch-freeze.c -- rewrites expressions for a given side of every switching surface. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "sim/model/switch.h"

#include <string.h>

#include "base/memory.h"
#include "sim/model/layer.h"

typedef struct {
    const qdot_switches *s;
    const int64_t *side;   /* [surfaces] the sides; NULL: the symbols of sides stay */
    const int64_t *corner; /* [surfaces] the side to use where `side` is QDOT_SIDE_SLIDES */
    qdot_gates gates;   /* gates of the expressions that are rewritten */
    uint8_t *open;
    qdot_expr *to; /* [gates] replacement of each gate */
} freezer;

/* Argument k of a switching function, rewritten for the given sides. */
static qdot_expr
frozen_argument(const freezer *f, const qdot_gate *gate, uint32_t k)
{
    const size_t of = f->gates.arguments.at[gate->first + k];

    return of == SIZE_MAX ? qdot_expr_arg(f->s->pool, gate->node, k) : f->to[of];
}

static int64_t
side_of_surface(const freezer *f, size_t surface)
{
    return f->side[surface] == QDOT_SIDE_SLIDES ? f->corner[surface] : f->side[surface];
}

/* Whether the motion slides along the surface of a comparison, so that u = 0. */
static bool
is_sliding_comparison(const freezer *f, const qdot_gate_pair *pair)
{
    return pair->surface != SIZE_MAX && f->side && f->side[pair->surface] == QDOT_SIDE_SLIDES;
}

/* The side of a comparison's u as a number or a symbol; for a constant u, its sign or floor. */
static qdot_expr
side_of_comparison(const freezer *f, const qdot_gate_pair *pair, bool steps)
{
    qdot_pool *pool = f->s->pool;
    qdot_expr side;

    if (pair->surface == SIZE_MAX)
        return qdot_fun1(pool, steps ? QDOT_FLOOR : QDOT_SIGN, pair->u);
    side = f->side ? qdot_expr_int(pool, side_of_surface(f, pair->surface))
                   : f->s->surfaces.at[pair->surface].side;
    return pair->turned < 0 ? qdot_neg(pool, side) : side;
}

static qdot_expr
rebuild_with_frozen_arguments(const freezer *f, const qdot_gate *gate)
{
    qdot_expr few[32] = {0}, *args = gate->n > 32 ? qdot_malloc(gate->n * sizeof *args) : few, e;

    if (!args)
        return qdot_pool_fail(f->s->pool);
    for (uint32_t k = 0; k < gate->n; k++)
        args[k] = frozen_argument(f, gate, k);
    e = qdot_rebuild(f->s->pool, gate->node, args);
    if (args != few)
        qdot_free(args);
    return e;
}

/* A power with a layer at surface i (sim/model/layer.h): 0 inside; if held there, its value at the boundary. */
static qdot_expr
freeze_layer_power(const freezer *f, size_t i, int only, qdot_expr power, qdot_expr exponent)
{
    qdot_pool *pool = f->s->pool;
    const qdot_surface *surface = &f->s->surfaces.at[i];

    if (!f->side)
        return qdot_fun(pool, QDOT_IF, 3,
                        (qdot_expr[]){qdot_rel(pool, QDOT_EQ, surface->side, QDOT_ZERO), QDOT_ZERO, power});
    if (f->side[i] == QDOT_SIDE_SLIDES && only != -f->corner[i])
        return qdot_pow(pool, qdot_layers_rim(pool, surface), exponent);
    return f->side[i] == 0 || f->side[i] == QDOT_SIDE_SLIDES ? QDOT_ZERO : power;
}

/* Argument k of a product, frozen. |u| as a divisor is u or -u even where u is held at 0: then u/|u| is the sign of u on
 * the side of this mode. */
static qdot_expr
freeze_factor(const freezer *f, const qdot_gate *gate, uint32_t k)
{
    const size_t of = f->gates.arguments.at[gate->first + k];
    const qdot_gate *base = of == SIZE_MAX ? NULL : &f->gates.gates.at[of];
    int64_t power;

    if (base && base->kind == QDOT_GATE_VALUE && base->op == QDOT_ABS
        && is_sliding_comparison(f, &f->gates.pairs.at[base->pair])
        && qdot_expr_to_int(f->s->pool, frozen_argument(f, gate, k + 1), &power) && power < 0)
        return qdot_mul(f->s->pool, side_of_comparison(f, &f->gates.pairs.at[base->pair], false),
                        frozen_argument(f, base, 0));
    return frozen_argument(f, gate, k);
}

static qdot_expr
freeze_product(const freezer *f, const qdot_gate *gate)
{
    qdot_pool *pool = f->s->pool;
    qdot_expr product = frozen_argument(f, gate, 0);

    for (uint32_t k = 1; k + 1 < gate->n; k += 2) {
        const qdot_expr exponent = frozen_argument(f, gate, k + 1);
        qdot_expr power = qdot_pow(pool, freeze_factor(f, gate, k), exponent);
        size_t surface;
        int only;

        if (qdot_layers_has(pool, f->gates.surfaces, f->s->surfaces.at, gate->node, k, &surface, &only))
            power = freeze_layer_power(f, surface, only, power, exponent);
        product = qdot_mul(pool, product, power);
    }
    return product;
}

static qdot_expr
freeze_relation(const freezer *f, const qdot_gate *gate)
{
    qdot_pool *pool = f->s->pool;

    return qdot_rel(pool, gate->op, side_of_comparison(f, &f->gates.pairs.at[gate->pair], false), QDOT_ZERO);
}

/* The argument that min or max selects on the given sides; of equal ones the first. */
static qdot_expr
freeze_extreme(const freezer *f, const qdot_gate *gate)
{
    qdot_pool *pool = f->s->pool;
    const qdot_gate_pair *pair = f->gates.pairs.at + gate->pair + gate->n * (gate->n - 1) / 2;
    qdot_expr best = frozen_argument(f, gate, gate->n - 1);

    for (uint32_t i = gate->n - 1; i-- > 0;) {
        qdot_expr kept = frozen_argument(f, gate, i);

        pair -= gate->n - 1 - i;
        for (uint32_t j = i + 1; j < gate->n; j++) {
            const qdot_gate_pair *p = pair + j - i - 1;
            qdot_expr side = is_sliding_comparison(f, p) ? QDOT_ZERO : side_of_comparison(f, p, false), first;

            if (gate->op == QDOT_MIN)
                side = qdot_neg(pool, side);
            first = qdot_rel(pool, QDOT_LE, QDOT_ZERO, side);
            kept = first == QDOT_TRUE    ? kept
                   : first == QDOT_FALSE ? best
                                         : qdot_fun(pool, QDOT_IF, 3, (qdot_expr[]){first, kept, best});
        }
        best = kept;
    }
    return best;
}

static qdot_expr
freeze_value(const freezer *f, const qdot_gate *gate)
{
    qdot_pool *pool = f->s->pool;
    const qdot_gate_pair *pair = &f->gates.pairs.at[gate->pair];

    switch (gate->op) {
    case QDOT_ABS:
        return is_sliding_comparison(f, pair) ? QDOT_ZERO : qdot_mul(pool, side_of_comparison(f, pair, false), frozen_argument(f, gate, 0));
    case QDOT_SIGN: return side_of_comparison(f, pair, false);
    case QDOT_FLOOR: return side_of_comparison(f, pair, true);
    default: /* the remaining case is mod */
        return qdot_sub(pool, frozen_argument(f, gate, 0),
                        qdot_mul(pool, frozen_argument(f, gate, 1), side_of_comparison(f, pair, true)));
    }
}

/* Whether a switching function stays unchanged because one of its surfaces has no side in this mode. */
static bool
stays_unfrozen(const freezer *f, const qdot_gate *gate)
{
    const size_t pairs = gate->kind == QDOT_GATE_EXTREME ? gate->n * (gate->n - 1) / 2
                         : gate->kind == QDOT_GATE_RELATION || gate->kind == QDOT_GATE_VALUE;

    for (size_t k = 0; k < pairs && f->side; k++) {
        const size_t surface = f->gates.pairs.at[gate->pair + k].surface;

        if (surface != SIZE_MAX && f->side[surface] == QDOT_SIDE_OPEN)
            return true;
    }
    return false;
}

static qdot_expr
freeze_gate(const freezer *f, size_t i)
{
    const qdot_gate *gate = &f->gates.gates.at[i];
    const uint8_t condition = gate->kind == QDOT_GATE_IF && f->gates.arguments.at[gate->first] != SIZE_MAX
                                  ? f->open[f->gates.arguments.at[gate->first]]
                                  : f->open[i];
    const uint8_t truth = condition & (QDOT_GATE_FALSE | QDOT_GATE_TRUE);

    if (stays_unfrozen(f, gate))
        return gate->node;
    switch (gate->kind) {
    case QDOT_GATE_IF:
        if (truth == QDOT_GATE_TRUE || truth == QDOT_GATE_FALSE)
            return frozen_argument(f, gate, truth == QDOT_GATE_TRUE ? 1 : 2);
        return rebuild_with_frozen_arguments(f, gate);
    case QDOT_GATE_LOGIC:
    case QDOT_GATE_RELATION:
        if (truth == QDOT_GATE_TRUE || truth == QDOT_GATE_FALSE)
            return truth == QDOT_GATE_TRUE ? QDOT_TRUE : QDOT_FALSE;
        return gate->kind == QDOT_GATE_LOGIC ? rebuild_with_frozen_arguments(f, gate) : freeze_relation(f, gate);
    case QDOT_GATE_EXTREME: return freeze_extreme(f, gate);
    case QDOT_GATE_VALUE: return freeze_value(f, gate);
    case QDOT_GATE_PASSES: break;
    }
    return qdot_expr_kind(f->s->pool, gate->node) == QDOT_PROD ? freeze_product(f, gate) : rebuild_with_frozen_arguments(f, gate);
}

/* With one side of every surface: that of `corner` where the motion slides. What is closed is left out: it may
 * be undefined. */
static qdot_status
freeze_at_corner(freezer *f, size_t n, const qdot_expr *e, qdot_expr *frozen)
{
    size_t root = 0;

    qdot_gates_open(&f->gates, f->side, f->corner, f->open);
    for (size_t i = 0; i < f->gates.gates.n; i++)
        f->to[i] = f->open[i] & QDOT_GATE_OPEN ? freeze_gate(f, i) : QDOT_NIL;
    for (size_t i = 0; i < n; i++) {
        const bool some = root < f->gates.roots.n && f->gates.gates.at[f->gates.roots.at[root]].node == e[i];

        frozen[i] = some ? f->to[f->gates.roots.at[root++]] : e[i];
    }
    return qdot_pool_check(f->s->pool);
}

/* The weighted mean (1 + share)/2 a + (1 - share)/2 b; share = 1 gives a, share = -1 gives b. */
static qdot_expr
weighted_mean(qdot_pool *pool, qdot_expr share, qdot_expr a, qdot_expr b)
{
    if (a == b)
        return a;
    return qdot_mul(pool, QDOT_HALF,
                    qdot_add(pool, qdot_add(pool, a, b),
                             qdot_mul(pool, share, qdot_sub(pool, a, b))));
}

/* The mean over both sides of every surface along which the motion slides, from surface `from`
 * on. */
static qdot_status
freeze_sliding_means(freezer *f, int64_t *corner, const qdot_expr *share, size_t from, size_t n,
                     const qdot_expr *e, qdot_expr *frozen)
{
    size_t i = from;
    qdot_expr *low;
    qdot_status status;

    while (i < f->gates.surfaces && f->side && f->side[i] != QDOT_SIDE_SLIDES)
        i++;
    if (!f->side || i == f->gates.surfaces)
        return freeze_at_corner(f, n, e, frozen);
    low = qdot_malloc((n + 1) * sizeof *low);
    if (!low)
        return QDOT_ENOMEM;
    corner[i] = -1;
    status = freeze_sliding_means(f, corner, share, i + 1, n, e, low);
    corner[i] = 1;
    if (status == QDOT_OK)
        status = freeze_sliding_means(f, corner, share, i + 1, n, e, frozen);
    for (size_t k = 0; k < n && status == QDOT_OK; k++)
        frozen[k] = weighted_mean(f->s->pool, share[i], frozen[k], low[k]);
    qdot_free(low);
    return status == QDOT_OK ? qdot_pool_check(f->s->pool) : status;
}

qdot_status
qdot_switches_freeze(const qdot_switches *s, const int64_t *side, const qdot_expr *share,
                     size_t n, const qdot_expr *e, qdot_expr *frozen)
{
    const size_t m = qdot_switches_own(s);
    freezer f = {.s = s, .side = side};
    qdot_expr *copy;
    int64_t *corner;
    qdot_status status;

    if (s->atoms.n == 0) {
        memcpy(frozen, e, n * sizeof *e);
        return QDOT_OK;
    }
    corner = qdot_calloc(s->surfaces.n + 1, sizeof *corner);
    copy = qdot_malloc((n + 1) * sizeof *copy); /* copy first, as `frozen` may be the same array as `e` */
    status = corner && copy ? QDOT_OK : QDOT_ENOMEM;
    if (status == QDOT_OK) {
        memcpy(copy, e, n * sizeof *e);
        status = qdot_gates_find(s->pool, m, s->surfaces.at, n, copy, false, &f.gates);
    }
    if (status == QDOT_OK) {
        f.corner = corner;
        f.open = qdot_calloc(f.gates.gates.n + m + 1, sizeof *f.open);
        f.to = qdot_calloc(f.gates.gates.n + 1, sizeof *f.to);
        status = f.open && f.to ? QDOT_OK : QDOT_ENOMEM;
    }
    if (status == QDOT_OK)
        status = freeze_sliding_means(&f, corner, share, 0, n, copy, frozen);
    qdot_gates_clear(&f.gates);
    qdot_free(f.open);
    qdot_free(f.to);
    qdot_free(corner);
    qdot_free(copy);
    return status;
}
