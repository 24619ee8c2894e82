/* switch.c -- finds and freezes the functions that switch in the equations. */
#include "sim/model/switch.h"

#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/walk.h"
#include "mech/dynamics/dalembert.h"
#include "mech/dynamics/energy.h"
#include "mech/dynamics/quantity.h"
#include "sim/model/layer.h"
#include "sim/model/substitute.h"
#include "tape/constant.h"

void
qdot_switches_clear(qdot_switches *s)
{
    qdot_free(s->surfaces.at);
    qdot_free(s->atoms.at);
    qdot_free(s->pucks.at);
    *s = (qdot_switches){0};
}

static bool
moves(const qdot_pool *pool, qdot_expr e)
{
    return (qdot_expr_node(pool, e)->holds
            & (QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_TIME
               | QDOT_HAS_MULTIPLIER))
           != 0;
}

static bool
is_function(const qdot_pool *pool, qdot_expr e, qdot_fun_id id)
{
    return qdot_expr_kind(pool, e) == QDOT_FUN && qdot_expr_node(pool, e)->op == id;
}

static bool
is_relation(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_kind(pool, e) == QDOT_REL;
}

/* Whether the node itself switches; `if` does by the relations in it. */
static bool
is_atom(const qdot_pool *pool, qdot_expr e)
{
    static const qdot_fun_id ids[] = {QDOT_ABS, QDOT_SIGN,  QDOT_MIN,
                                      QDOT_MAX, QDOT_FLOOR, QDOT_MOD};

    if (!moves(pool, e))
        return false;
    if (is_relation(pool, e))
        return true;
    for (size_t i = 0; i < sizeof ids / sizeof *ids; i++)
        if (is_function(pool, e, ids[i]))
            return true;
    return false;
}

/* u or -u, whichever prints without a sign in front; *turned: it is -u. */
static qdot_expr
upright(qdot_pool *pool, qdot_expr u, bool *turned)
{
    *turned = qdot_expr_is_negative(pool, u);
    return *turned ? qdot_neg(pool, u) : u;
}

static qdot_status collect(qdot_switches *s, qdot_expr e);

/* Add a surface after those inside it, which may be new; a difference is put in canonical order.
 *  */
static qdot_status
add_surface(qdot_switches *s, qdot_expr u, bool steps)
{
    char name[32];
    qdot_expr side;
    bool turned;

    if (!steps)
        u = upright(s->pool, u, &turned);
    QDOT_TRY(qdot_pool_check(s->pool));
    if (!moves(s->pool, u)) /* what moved cancelled */
        return QDOT_OK;
    QDOT_TRY(collect(s, u));
    for (size_t i = 0; i < s->surfaces.n; i++)
        if (s->surfaces.at[i].u == u && s->surfaces.at[i].steps == steps)
            return QDOT_OK;
    /* a space is in no name of a user */
    snprintf(name, sizeof name, "side %zu", s->surfaces.n + 1);
    side = qdot_symbol_get(s->pool, QDOT_FORMAL, name);
    QDOT_TRY(qdot_pool_check(s->pool));
    return qdot_vec_push(&s->surfaces, ((qdot_surface){.u = u, .steps = steps, .side = side}));
}

static qdot_status
add_atom(qdot_switches *s, qdot_expr e)
{
    qdot_pool *pool = s->pool;
    uint32_t n = qdot_expr_count(pool, e);
    qdot_expr a = qdot_expr_arg(pool, e, 0), b = n > 1 ? qdot_expr_arg(pool, e, 1) : a;

    for (size_t i = 0; i < s->atoms.n; i++)
        if (s->atoms.at[i] == e)
            return QDOT_OK;
    QDOT_TRY(qdot_vec_push(&s->atoms, e));
    if (is_relation(pool, e))
        return add_surface(s, qdot_sub(pool, a, b), false);
    if (is_function(pool, e, QDOT_ABS) || is_function(pool, e, QDOT_SIGN))
        return add_surface(s, a, false);
    if (is_function(pool, e, QDOT_FLOOR))
        return add_surface(s, a, true);
    if (is_function(pool, e, QDOT_MOD))
        return add_surface(s, qdot_div(pool, a, b), true);
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = i + 1; j < n; j++)
            QDOT_TRY(add_surface(s,
                                 qdot_sub(pool, qdot_expr_arg(pool, e, i),
                                          qdot_expr_arg(pool, e, j)),
                                 false));
    return QDOT_OK;
}

/* Collect all functions in e that switch. */
static qdot_status
collect(qdot_switches *s, qdot_expr e)
{
    qdot_walk walk;
    qdot_status status = qdot_walk_begin(s->pool, e, &walk);

    for (size_t i = 0; status == QDOT_OK && i < walk.n; i++)
        if (is_atom(s->pool, walk.at[i]))
            status = add_atom(s, walk.at[i]);
    qdot_walk_end(&walk);
    return status;
}

static bool
switches(const qdot_switches *s, qdot_expr e, qdot_status *status)
{
    bool found = false;
    qdot_walk walk;

    if (e == QDOT_NIL || *status != QDOT_OK)
        return false;
    *status = qdot_walk_begin(s->pool, e, &walk);
    for (size_t i = 0; *status == QDOT_OK && i < walk.n; i++)
        found = found || is_atom(s->pool, walk.at[i]);
    qdot_walk_end(&walk);
    return found;
}

/* Make s->level from T, each declared potential and a stated Lagrangian, if they switch: M, or with the time. */
static qdot_status
find_level(qdot_switches *s, qdot_scene *scene, const qdot_run_request *request, qdot_expr mass)
{
    qdot_pool *pool = s->pool;
    qdot_status status = QDOT_OK;
    qdot_expr sum = scene->lagrangian;
    bool moved = false; /* T holds terms of first degree */

    if (sum == QDOT_NIL && (switches(s, mass, &status) || !qdot_lagrangian_has(scene, QDOT_T, &moved) || moved))
        sum = qdot_mech_numeric_kinetic(scene);
    if (!switches(s, sum, &status))
        sum = QDOT_ZERO;
    for (size_t i = 0; i < scene->potentials.n; i++)
        if (switches(s, scene->potentials.at[i].e, &status))
            sum = qdot_sub(pool, sum, scene->potentials.at[i].e);
    if (status == QDOT_OK && sum != QDOT_ZERO) {
        sum = qdot_substitute(pool, sum, request->n_values, request->symbols,
                              request->values);
        s->level = switches(s, sum, &status) ? sum : QDOT_NIL;
    }
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

/* Whether a node may switch, or may after differentiation or substitution of values: also a
 * function whose value is set, and a root, which is an absolute value if its base is a square. */
static bool
may_switch(const qdot_pool *pool, qdot_expr e)
{
    if (qdot_expr_kind(pool, e) == QDOT_UFUN || is_atom(pool, e))
        return true;
    for (uint32_t i = 2; qdot_expr_kind(pool, e) == QDOT_PROD && i < qdot_expr_count(pool, e);
         i += 2) {
        long power;

        if (!qdot_expr_to_int(pool, qdot_expr_arg(pool, e, i), &power))
            return true;
    }
    return false;
}

static qdot_status
look_at(const qdot_pool *pool, size_t n, const qdot_expr *e, bool *smooth)
{
    qdot_walk walk;
    qdot_status status = qdot_walk_begin_n(pool, n, e, &walk);

    for (size_t i = 0; status == QDOT_OK && i < walk.n && *smooth; i++)
        *smooth = !may_switch(pool, walk.at[i]);
    qdot_walk_end(&walk);
    return status;
}

/* Whether nothing switches in the ingredients of the equations: positions and applied forces. So
 * M and f need not be derived, which takes long for many coordinates. */
static qdot_status
see_smooth(qdot_scene *scene, const qdot_run_request *request, bool *smooth)
{
    qdot_pool *pool = scene->pool;
    qdot_dalembert_term *terms;
    qdot_expr *e, Q;
    size_t n;
    qdot_status status;

    *smooth = false;
    QDOT_TRY(qdot_mech_dalembert(scene, &terms, &n, &Q));
    if (n > 0 && scene->constraints.n == 0)
        Q = qdot_substitute(pool, Q, request->n_values, request->symbols, request->values);
    else
        Q = QDOT_NIL;
    e = qdot_calloc(3 * n + scene->potentials.n + 1, sizeof *e);
    status = e ? qdot_pool_check(pool) : QDOT_ENOMEM;
    if (status == QDOT_OK && Q != QDOT_NIL) {
        size_t count = 0;

        for (size_t i = 0; i < n; i++) {
            e[count++] = terms[i].w;
            e[count++] = terms[i].x;
            e[count++] = terms[i].y;
        }
        for (size_t i = 0; i < scene->potentials.n; i++)
            e[count++] = scene->potentials.at[i].e;
        e[count++] = Q;
        *smooth = true;
        status = look_at(pool, count, e, smooth);
    }
    qdot_free(e);
    qdot_free(terms);
    return status;
}

/* Whether `base` is linear in t, of nothing else, and 0 at a time of the run. */
static bool
vanishes_in_time(qdot_pool *pool, const qdot_run_request *request, qdot_expr base)
{
    const qdot_expr slope = qdot_diff(pool, base, QDOT_T), now = QDOT_T;
    qdot_expr ends[2];
    double at[2];

    if (slope == QDOT_NIL || slope == QDOT_ZERO || qdot_expr_kind(pool, slope) != QDOT_NUM
        || (qdot_expr_node(pool, base)->holds & ~(uint32_t)QDOT_HAS_TIME) != 0)
        return false;
    ends[0] = qdot_subs(pool, base, 1, &now, &request->t0);
    ends[1] = qdot_subs(pool, base, 1, &now, &request->t1);
    for (size_t k = 0; k < 2; k++)
        if (ends[k] == QDOT_NIL || qdot_tape_constant(pool, ends[k], &at[k]) != QDOT_OK)
            return false;
    return at[0] * at[1] <= 0;
}

/* Collect broken powers of times that the run begins at, ends at or passes (sim/model/layer.h), as |t - a|. */
static qdot_status
collect_times(qdot_switches *s, const qdot_run_request *request, qdot_expr e)
{
    qdot_pool *pool = s->pool;
    qdot_walk walk;
    qdot_status status = qdot_walk_begin(pool, e, &walk);
    double p;

    for (size_t i = 0; status == QDOT_OK && i < walk.n; i++)
        for (uint32_t k = 1; qdot_expr_kind(pool, walk.at[i]) == QDOT_PROD && status == QDOT_OK
                             && k + 1 < qdot_expr_count(pool, walk.at[i]);
             k += 2)
            if (qdot_layers_is_broken(pool, walk.at[i], k, &p) && p > 0
                && vanishes_in_time(pool, request, qdot_expr_arg(pool, walk.at[i], k)))
                status = add_atom(s, qdot_fun1(pool, QDOT_ABS, qdot_expr_arg(pool, walk.at[i], k)));
    qdot_walk_end(&walk);
    return status;
}

qdot_status
qdot_switches_find(qdot_scene *scene, const qdot_run_request *request, qdot_switches *s)
{
    qdot_pool *pool = scene->pool;
    bool smooth = false;
    qdot_expr e[2];

    s->pool = pool;
    if (scene->coordinates.n >= QDOT_MANY_COORDINATES)
        QDOT_TRY(see_smooth(scene, request, &smooth));
    if (smooth)
        return QDOT_OK;
    e[0] = qdot_mech_numeric_mass(scene);
    e[1] = qdot_mech_numeric_forcing(scene);
    for (size_t i = 0; i < 2; i++) {
        if (e[i] != QDOT_NIL)
            e[i] = qdot_substitute(pool, e[i], request->n_values, request->symbols,
                                   request->values);
        QDOT_TRY(qdot_pool_check(pool));
        QDOT_TRY(collect(s, e[i]));
        QDOT_TRY(collect_times(s, request, e[i]));
    }
    s->mass = e[0];
    s->forcing = e[1];
    QDOT_TRY(qdot_layers_find(pool, s->surfaces.n, s->surfaces.at, 2, e));
    for (size_t k = 0; k < scene->constraints.n; k++) {
        qdot_expr f = qdot_substitute(pool, scene->constraints.at[k].f, request->n_values,
                                      request->symbols, request->values);

        QDOT_TRY(qdot_pool_check(pool));
        QDOT_TRY(collect(s, f));
    }
    QDOT_TRY(find_level(s, scene, request, e[0]));
    return s->level == QDOT_NIL ? QDOT_OK : collect(s, s->level);
}

/* --- freezing ------------------------------------------------------------------------ */

typedef struct {
    const qdot_switches *s;
    const long *side; /* NULL: symbols */
    const long *corner; /* [surfaces] the side meant by QDOT_SIDE_SLIDES */
    size_t done;       /* atoms frozen so far */
    qdot_expr *frozen; /* [atoms] */
} freezer;

static qdot_expr inner(const freezer *f, qdot_expr e);

static qdot_expr
look_up(qdot_pool *pool, qdot_expr node, void *user)
{
    const freezer *f = user;
    qdot_expr power, rest;

    for (size_t i = 0; i < f->done; i++)
        if (f->s->atoms.at[i] == node)
            return f->frozen[i];
    power = qdot_layers_power(pool, f->s->surfaces.n, f->s->surfaces.at, f->side, f->corner, node,
                              &rest);
    return power == QDOT_NIL || power == QDOT_ZERO ? power
                                                   : qdot_mul(pool, power, inner(f, rest));
}

static qdot_expr
inner(const freezer *f, qdot_expr e)
{
    return qdot_walk_map(f->s->pool, e, look_up, (void *)f);
}

/* The symbol of the side of u; for a constant u its sign or floor. */
static qdot_expr
side_of(const freezer *f, qdot_expr u, bool steps)
{
    qdot_pool *pool = f->s->pool;
    bool turned = false;

    if (!steps)
        u = upright(pool, u, &turned);
    for (size_t i = 0; i < qdot_switches_own(f->s); i++) {
        const qdot_surface *x = &f->s->surfaces.at[i];
        qdot_expr side;

        if (x->u != u || x->steps != steps)
            continue;
        side = !f->side                          ? x->side
               : f->side[i] == QDOT_SIDE_SLIDES ? qdot_expr_int(pool, f->corner[i])
                                                 : qdot_expr_int(pool, f->side[i]);
        return turned ? qdot_neg(pool, side) : side;
    }
    u = qdot_fun1(pool, steps ? QDOT_FLOOR : QDOT_SIGN, u);
    return turned ? qdot_neg(pool, u) : u;
}

/* Whether u is held at 0. */
static bool
is_held(const freezer *f, qdot_expr u)
{
    bool turned;

    u = upright(f->s->pool, u, &turned);
    for (size_t i = 0; i < qdot_switches_own(f->s) && f->side; i++)
        if (f->s->surfaces.at[i].u == u && f->side[i] == QDOT_SIDE_SLIDES)
            return true;
    return false;
}

/* The argument that min or max selects; the first of equal ones. */
static qdot_expr
chosen(const freezer *f, qdot_expr e, int way)
{
    qdot_pool *pool = f->s->pool;
    uint32_t n = qdot_expr_count(pool, e);
    qdot_expr best = inner(f, qdot_expr_arg(pool, e, n - 1));

    for (uint32_t i = n - 1; i-- > 0;) {
        qdot_expr own = inner(f, qdot_expr_arg(pool, e, i)), kept = own;

        for (uint32_t j = i + 1; j < n; j++) {
            qdot_expr u = qdot_sub(pool, qdot_expr_arg(pool, e, i), qdot_expr_arg(pool, e, j));
            qdot_expr side = is_held(f, u) ? QDOT_ZERO : side_of(f, u, false);

            if (way < 0)
                side = qdot_neg(pool, side);
            kept = qdot_fun(pool, QDOT_IF, 3,
                            (qdot_expr[]){qdot_rel(pool, QDOT_LE, QDOT_ZERO, side), kept,
                                          best});
        }
        best = kept;
    }
    return best;
}

static qdot_expr
freeze_atom(const freezer *f, qdot_expr e)
{
    qdot_pool *pool = f->s->pool;
    uint32_t n = qdot_expr_count(pool, e);
    qdot_expr a = qdot_expr_arg(pool, e, 0), b = n > 1 ? qdot_expr_arg(pool, e, 1) : a;

    if (is_relation(pool, e)) {
        qdot_rel_op op = qdot_expr_node(pool, e)->op;
        qdot_expr side = side_of(f, qdot_sub(pool, a, b), false);

        if (op == QDOT_EQ && qdot_expr_kind(pool, side) == QDOT_NUM)
            return side == QDOT_ZERO ? QDOT_TRUE : QDOT_FALSE;
        return qdot_rel(pool, op, side, QDOT_ZERO);
    }
    if (is_function(pool, e, QDOT_ABS) && is_held(f, a))
        return QDOT_ZERO;
    if (is_function(pool, e, QDOT_ABS))
        return qdot_mul(pool, side_of(f, a, false), inner(f, a));
    if (is_function(pool, e, QDOT_SIGN))
        return side_of(f, a, false);
    if (is_function(pool, e, QDOT_FLOOR))
        return side_of(f, a, true);
    if (is_function(pool, e, QDOT_MOD))
        return qdot_sub(pool, inner(f, a),
                        qdot_mul(pool, inner(f, b),
                                 side_of(f, qdot_div(pool, a, b), true)));
    return chosen(f, e, is_function(pool, e, QDOT_MAX) ? 1 : -1);
}

/* Whether a function switches on a surface whose side is left open. */
static bool
is_open(const freezer *f, qdot_expr atom)
{
    qdot_pool *pool = f->s->pool;
    const uint32_t n = qdot_expr_count(pool, atom);
    bool turned;

    for (size_t s = 0; s < qdot_switches_own(f->s) && f->side; s++) {
        const qdot_expr u = f->s->surfaces.at[s].u;

        if (f->side[s] != QDOT_SIDE_OPEN)
            continue;
        if (f->s->surfaces.at[s].steps) {
            if (is_function(pool, atom, QDOT_FLOOR) || is_function(pool, atom, QDOT_MOD))
                return true;
            continue;
        }
        if (n == 1 && upright(pool, qdot_expr_arg(pool, atom, 0), &turned) == u)
            return true;
        for (uint32_t i = 0; i < n; i++)
            for (uint32_t j = i + 1; j < n; j++)
                if (upright(pool,
                            qdot_sub(pool, qdot_expr_arg(pool, atom, i),
                                     qdot_expr_arg(pool, atom, j)),
                            &turned)
                    == u)
                    return true;
    }
    return false;
}

/* With one side of every surface: that of `corner` where the motion slides. */
static qdot_status
freeze_corner(freezer f, size_t n, const qdot_expr *e, qdot_expr *frozen)
{
    f.frozen = qdot_calloc(f.s->atoms.n, sizeof *f.frozen);
    if (!f.frozen)
        return QDOT_ENOMEM;
    for (f.done = 0; f.done < f.s->atoms.n; f.done++) {
        const qdot_expr atom = f.s->atoms.at[f.done];

        f.frozen[f.done] = is_open(&f, atom) ? atom : freeze_atom(&f, atom);
    }
    for (size_t i = 0; i < n; i++)
        frozen[i] = inner(&f, e[i]);
    qdot_free(f.frozen);
    return qdot_pool_check(f.s->pool);
}

/* (1 + share)/2 a + (1 - share)/2 b. */
static qdot_expr
mean(qdot_pool *pool, qdot_expr share, qdot_expr a, qdot_expr b)
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
freeze_means(const freezer *f, long *corner, const qdot_expr *share, size_t from, size_t n,
             const qdot_expr *e, qdot_expr *frozen)
{
    size_t i = from;
    qdot_expr *low;
    qdot_status status;

    while (i < qdot_switches_own(f->s) && f->side && f->side[i] != QDOT_SIDE_SLIDES)
        i++;
    if (!f->side || i == qdot_switches_own(f->s))
        return freeze_corner(*f, n, e, frozen);
    low = qdot_malloc((n + 1) * sizeof *low);
    if (!low)
        return QDOT_ENOMEM;
    corner[i] = -1;
    status = freeze_means(f, corner, share, i + 1, n, e, low);
    corner[i] = 1;
    if (status == QDOT_OK)
        status = freeze_means(f, corner, share, i + 1, n, e, frozen);
    for (size_t k = 0; k < n && status == QDOT_OK; k++)
        frozen[k] = mean(f->s->pool, share[i], frozen[k], low[k]);
    qdot_free(low);
    return status == QDOT_OK ? qdot_pool_check(f->s->pool) : status;
}

qdot_status
qdot_switches_freeze(const qdot_switches *s, const long *side, const qdot_expr *share,
                     size_t n, const qdot_expr *e, qdot_expr *frozen)
{
    qdot_expr *copy;
    long *corner;
    qdot_status status;

    if (s->atoms.n == 0) {
        memcpy(frozen, e, n * sizeof *e);
        return QDOT_OK;
    }
    corner = qdot_calloc(s->surfaces.n + 1, sizeof *corner);
    copy = qdot_malloc((n + 1) * sizeof *copy); /* `frozen` may be `e` */
    status = corner && copy ? QDOT_OK : QDOT_ENOMEM;
    if (status == QDOT_OK) {
        memcpy(copy, e, n * sizeof *e);
        status = freeze_means(&(freezer){.s = s, .side = side, .corner = corner}, corner, share,
                              0, n, copy, frozen);
    }
    qdot_free(corner);
    qdot_free(copy);
    return status;
}
