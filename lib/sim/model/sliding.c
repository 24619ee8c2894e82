/* sliding.c -- motion along surfaces: solves for q'', multipliers and shares together; keeps states
 * at u = 0. */
#include "sim/model/sliding.h"

#include <math.h>
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/integrated.h"
#include "normal/solve/linear.h"
#include "sim/model/massless.h"
#include "sim/model/puck.h"
#include "sim/model/switch.h"

/* With more coordinates than this, M^-1 f is not formed symbolically. */
enum { MOST_SOLVED = 3 };

bool
qdot_sliding_is(const qdot_switches *s, const int64_t *side)
{
    for (size_t i = 0; i < s->surfaces.n && side; i++)
        if (side[i] == QDOT_SIDE_SLIDES
            || (s->surfaces.at[i].puck > 0 && qdot_puck_is_held(side[i])))
            return true;
    return false;
}

/* An unknown s: in place of sign u (friction ratio) or the reaction of a contact; or of component c of a disc. */
typedef struct {
    size_t surface, c;
    const qdot_puck *puck; /* the sliding disc to which the surface belongs; NULL: none */
} unknown;

/* The linear system being filled; unknowns: q'', then multipliers, then friction ratios and contact reactions. */
typedef struct {
    qdot_plan *p;
    qdot_scene *scene;
    size_t n, m, k, size;
    unknown *of; /* [k] the unknown friction ratios */
    qdot_expr *A, *b, *x;
    bool *massless; /* [n] whether the coordinate is massless */
    bool some_massless;
    /* Friction ratios already known from massless coordinates' equations: their surfaces, symbols, values. */
    size_t n_settled, *settled;
    qdot_expr *symbols, *values;
} sliding;

static qdot_expr
symbol_of_ratio(const sliding *s, size_t j)
{
    const unknown *u = &s->of[j];

    return u->puck ? u->puck->share[u->c] : s->p->mode->surfaces.at[u->surface].side;
}

/* The address, in p->share, of the friction ratio of component c of a disc. */
static qdot_expr *
address_of_ratio(const qdot_plan *p, const qdot_puck *puck, size_t c)
{
    return p->share + p->mode->surfaces.n + puck->first + c;
}

static bool
contains_ratio(const sliding *s, qdot_expr e)
{
    for (size_t j = 0; j < s->k; j++)
        if (qdot_expr_contains(s->p->pool, e, symbol_of_ratio(s, j)))
            return true;
    return qdot_expr_contains_any(s->p->pool, e, s->n_settled, s->symbols);
}

static qdot_status
fail_sliding(const char *why)
{
    return qdot_fail(QDOT_EFAILED, "%s", why);
}

/* The time derivative df/dt along the motion; parameters that events set are constant. */
static qdot_expr
time_derivative(const qdot_plan *p, qdot_expr f)
{
    const qdot_expr zero = QDOT_ZERO;

    f = qdot_ddt(p->pool, f);
    for (size_t i = p->n - p->n_states; i < p->n && f != QDOT_NIL; i++)
        f = qdot_subs(p->pool, f, 1, &p->inputs[p->n + i], &zero);
    return f;
}

static bool
contains_kind(const qdot_plan *p, qdot_expr e, uint32_t what)
{
    return e != QDOT_NIL && (qdot_expr_node(p->pool, e)->holds & what) != 0;
}

/* Fill row r of the system with the equation that the time derivative of f (of order `times`) is 0. */
static qdot_status
fill_row(sliding *s, size_t r, qdot_expr f, int times)
{
    const qdot_plan *p = s->p;
    qdot_expr *zeros = qdot_calloc(p->n, sizeof *zeros);

    if (!zeros)
        return QDOT_ENOMEM;
    for (; times > 0; times--)
        f = time_derivative(p, f);
    for (size_t i = 0; i < s->n && f != QDOT_NIL; i++) {
        zeros[i] = QDOT_ZERO;
        if (i < s->n - p->n_states)
            s->A[r * s->size + i] = qdot_diff(p->pool, f, p->inputs[2 * p->n + 1 + i]);
    }
    if (f != QDOT_NIL)
        f = qdot_subs(p->pool, f, p->n, p->inputs + 2 * p->n + 1, zeros);
    qdot_free(zeros);
    if (f != QDOT_NIL)
        s->b[r] = qdot_neg(p->pool, f);
    return qdot_pool_check(p->pool);
}

/* Whether f contains a velocity of a massless coordinate. */
static bool
contains_massless_velocity(const sliding *s, qdot_expr f)
{
    for (size_t i = 0; i < s->n; i++)
        if (s->massless[i] && qdot_expr_contains(s->p->pool, f, s->p->inputs[s->p->n + i]))
            return true;
    return false;
}

/* Fill the rows M q'' - sum B s = f0; an equation of a massless coordinate is differentiated until
 * it contains q''. */
static qdot_status
fill_force_rows(sliding *s)
{
    const qdot_plan *p = s->p;
    qdot_expr *symbols = qdot_calloc(2 * s->k, sizeof *symbols), *zeros = symbols + s->k;
    qdot_status status = symbols ? QDOT_OK : QDOT_ENOMEM;

    for (size_t j = 0; j < s->k && symbols; j++) {
        symbols[j] = symbol_of_ratio(s, j);
        zeros[j] = QDOT_ZERO;
    }
    for (size_t i = 0; i < s->n && status == QDOT_OK; i++) {
        if (s->massless[i]) {
            status = fill_row(s, i, p->f[i], contains_massless_velocity(s, p->f[i]) ? 1 : 2);
            continue;
        }
        for (size_t j = 0; j < s->n && status == QDOT_OK; j++) {
            s->A[i * s->size + j] = p->M[i * s->n + j];
            if (contains_ratio(s, p->M[i * s->n + j]))
                status = fail_sliding("a mass switches there");
        }
        for (size_t j = 0; j < s->k && status == QDOT_OK; j++) {
            qdot_expr B = qdot_diff(p->pool, p->f[i], symbols[j]);

            status = qdot_pool_check(p->pool);
            if (status == QDOT_OK && contains_ratio(s, B))
                status = fail_sliding("forces contain products of expressions that switch there");
            s->A[i * s->size + s->n + s->m + j] = qdot_neg(p->pool, B);
        }
        s->b[i] = qdot_subs(p->pool, p->f[i], s->k, symbols, zeros);
    }
    qdot_free(symbols);
    return status == QDOT_OK ? qdot_pool_check(p->pool) : status;
}

static qdot_status
fill_constraint_rows(sliding *s)
{
    const qdot_plan *p = s->p;

    for (size_t c = 0; c < s->m; c++) {
        const qdot_constraint *from = s->scene->constraints.at + c;
        const size_t r = s->n + c;
        qdot_expr mu, f = qdot_plan_substitute(p, qdot_integrated_rate(s->scene, c, &mu));

        QDOT_TRY(qdot_pool_check(p->pool));
        QDOT_TRY(qdot_switches_freeze(p->mode, p->side, p->share, 1, &f, &f));
        if (contains_ratio(s, f))
            return fail_sliding("a constraint switches there");
        QDOT_TRY(fill_row(s, r, f, QDOT_ACCELERATION - (int)from->kind));
        for (size_t i = 0; i < s->n; i++)
            s->A[i * s->size + r] = qdot_neg(p->pool, s->A[r * s->size + i]);
    }
    return qdot_pool_check(p->pool);
}

/* The function that an unknown share keeps at 0: u of its surface, with the other switches frozen,
 * or a component of w. */
static qdot_status
find_held_function(const qdot_plan *p, const unknown *of, qdot_expr *u)
{
    const size_t i = of->surface;
    const qdot_expr *from = of->puck ? &of->puck->rest[of->c] : &p->mode->surfaces.at[i].u;

    QDOT_TRY(qdot_switches_freeze(p->mode, p->side, p->share, 1, from, u));
    if (p->mode->surfaces.at[i].steps || contains_kind(p, *u, QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER)
        || !contains_kind(p, *u, QDOT_HAS_VELOCITY | QDOT_HAS_COORD))
        return fail_sliding("no motion can be held there");
    return QDOT_OK;
}

static qdot_status
fill_system(sliding *s)
{
    QDOT_TRY(fill_force_rows(s));
    QDOT_TRY(fill_constraint_rows(s));
    for (size_t j = 0; j < s->k; j++) {
        const qdot_surface *x = &s->p->mode->surfaces.at[s->of[j].surface];
        const size_t r = s->n + s->m + j;
        qdot_expr u;

        QDOT_TRY(find_held_function(s->p, &s->of[j], &u));
        if (contains_ratio(s, u))
            return fail_sliding("one switch is inside another");
        QDOT_TRY(fill_row(s, r, u, contains_kind(s->p, u, QDOT_HAS_VELOCITY) ? 1 : 2));
        for (size_t i = 0; i < s->n && x->contact; i++) { /* add the reaction force of the contact to the equations */
            const qdot_expr slope = s->A[r * s->size + i];

            s->A[i * s->size + r] =
                x->reaction > 0 ? qdot_neg(s->p->pool, slope) : slope;
        }
    }
    return QDOT_OK;
}

static bool
is_creeping(const sliding *s, size_t j)
{
    return s->p->side[s->of[j].surface] == QDOT_SIDE_CREEPS;
}

/* Keep the shares of a mode; of a puck s G s for its surface, which is watched, and where it creeps
 * the direction s/|s| for its shares. */
static void
store_ratios(sliding *s)
{
    qdot_plan *p = s->p;

    for (size_t j = 0; j < s->k; j++) {
        const unknown *u = &s->of[j];

        *(u->puck ? address_of_ratio(p, u->puck, u->c) : &p->share[u->surface]) =
            s->x[s->n + s->m + j];
    }
    for (size_t j = 0; j < s->k; j++) {
        const qdot_puck *puck = s->of[j].puck;
        qdot_expr square;

        if (!puck || s->of[j].c > 0)
            continue;
        square = qdot_puck_square(p->pool, puck, address_of_ratio(p, puck, 0));
        p->share[puck->surface] = square;
        for (size_t c = 0; c < puck->k && is_creeping(s, j); c++)
            *address_of_ratio(p, puck, c) = qdot_mul(p->pool, *address_of_ratio(p, puck, c),
                                                     qdot_puck_inverse_root(p->pool, square));
    }
}

/* Add the reactions of the contacts to f[i], which does not contain them. */
static void
add_contact_reactions(sliding *s, size_t i)
{
    qdot_plan *p = s->p;

    for (size_t j = 0; j < s->k; j++) {
        const size_t r = s->n + s->m + j;

        if (p->mode->surfaces.at[s->of[j].surface].contact)
            p->f[i] = qdot_sub(p->pool, p->f[i], qdot_mul(p->pool, s->A[i * s->size + r], s->x[r]));
    }
}

/* Put the shares found into f, or take q'' itself. Where pucks creep only their shares: the others are
 * to be found anew. */
static qdot_status
insert_ratios(sliding *s, bool all)
{
    qdot_plan *p = s->p;
    qdot_expr *symbols = qdot_calloc(2 * s->k, sizeof *symbols), *to = symbols + s->k;
    size_t k = 0;

    if (!symbols)
        return QDOT_ENOMEM;
    store_ratios(s);
    for (size_t j = 0; j < s->k; j++) {
        const unknown *u = &s->of[j];

        if (!all && !is_creeping(s, j))
            continue;
        symbols[k] = symbol_of_ratio(s, j);
        to[k++] = u->puck ? *address_of_ratio(p, u->puck, u->c) : p->share[u->surface];
    }
    for (size_t i = 0; i < s->n; i++) {
        if (all && s->m == 0 && s->n <= MOST_SOLVED && !s->some_massless) {
            p->f[i] = s->x[i];
            for (size_t j = 0; j < s->n; j++)
                p->M[i * s->n + j] = i == j ? QDOT_ONE : QDOT_ZERO;
        } else {
            p->f[i] = qdot_subs(p->pool, p->f[i], k, symbols, to);
            if (all) /* otherwise the contacts are still among the rows to be solved */
                add_contact_reactions(s, i);
        }
    }
    qdot_free(symbols);
    return qdot_pool_check(p->pool);
}

/* Solve the system for its present unknowns; this also determines the friction ratios of creeping discs. */
static qdot_status
solve_system(sliding *s)
{
    qdot_facts facts = qdot_scene_facts(s->scene);
    uint32_t pivot = 0;
    size_t held_on = 0;
    qdot_status status;

    s->size = s->n + s->m + s->k;
    s->b = s->A + s->size * s->size;
    s->x = s->b + s->size;
    for (size_t i = 0; i < s->size * s->size; i++)
        s->A[i] = QDOT_ZERO;
    QDOT_TRY(fill_system(s));
    status = qdot_solve_linear(s->p->pool, (uint32_t)s->size, s->A, s->b, s->x, &pivot, &facts);
    if (status == QDOT_ESINGULAR)
        return fail_sliding("the forces that switch there do not determine the motion along it");
    QDOT_TRY(status);
    for (size_t j = 0; j < s->k; j++)
        held_on += !is_creeping(s, j);
    QDOT_TRY(insert_ratios(s, held_on == s->k));
    if (held_on == s->k)
        return QDOT_OK;
    held_on = 0;
    for (size_t j = 0; j < s->k; j++)
        if (!is_creeping(s, j))
            s->of[held_on++] = s->of[j];
    s->k = held_on;
    return s->k > 0 ? solve_system(s) : QDOT_OK;
}

/* --- coordinates without mass --------------------------------------------------------- */

/* Share j, whose slope in equation i of a massless coordinate is B, from that equation. Then u = 0 stands in its
 * place. */
static qdot_status
determine_ratio(sliding *s, size_t i, size_t j, qdot_expr B)
{
    qdot_plan *p = s->p;
    const qdot_expr symbol = symbol_of_ratio(s, j), zero = QDOT_ZERO;
    qdot_expr value, u;

    if (s->of[j].puck || contains_ratio(s, B))
        return fail_sliding(s->of[j].puck ? "friction in a plane acts on a coordinate without mass"
                                    : "forces contain products of expressions that switch there");
    QDOT_TRY(find_held_function(p, &s->of[j], &u));
    if (contains_ratio(s, u))
        return fail_sliding("one switch is inside another");
    value = qdot_neg(p->pool, qdot_div(p->pool, qdot_subs(p->pool, p->f[i], 1, &symbol, &zero), B));
    for (size_t k = 0; k < s->n; k++)
        p->f[k] = k == i ? u : qdot_subs(p->pool, p->f[k], 1, &symbol, &value);
    for (size_t k = 0; k < s->n_settled; k++)
        s->values[k] = qdot_subs(p->pool, s->values[k], 1, &symbol, &value);
    s->settled[s->n_settled] = s->of[j].surface;
    s->symbols[s->n_settled] = symbol;
    s->values[s->n_settled++] = value;
    s->k--;
    for (size_t k = j; k < s->k; k++)
        s->of[k] = s->of[k + 1];
    return qdot_pool_check(p->pool);
}

/* Whether the surface function u of unknown ratio j contains coordinate i or its velocity. */
static bool
depends_on_coordinate(const sliding *s, size_t i, size_t j)
{
    const qdot_plan *p = s->p;
    const qdot_expr u = s->p->mode->surfaces.at[s->of[j].surface].u;

    return qdot_expr_contains(p->pool, u, p->inputs[i]) || qdot_expr_contains(p->pool, u, p->inputs[p->n + i]);
}

/* Solve the equations of massless coordinates for the shares in them, first where a share holds the coordinate
 * itself. */
static qdot_status
determine_massless_ratios(sliding *s)
{
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < s->n; i++)
            for (size_t j = 0; j < s->k && s->massless[i]; j++) {
                const qdot_expr B = qdot_diff(s->p->pool, s->p->f[i], symbol_of_ratio(s, j));

                QDOT_TRY(qdot_pool_check(s->p->pool));
                if (B == QDOT_ZERO || (pass == 0 && !depends_on_coordinate(s, i, j)))
                    continue;
                QDOT_TRY(determine_ratio(s, i, j, B));
                break;
            }
    return QDOT_OK;
}

static qdot_status
find_massless_coordinates(sliding *s)
{
    const size_t surfaces = s->p->mode->surfaces.n;

    s->massless = qdot_calloc(s->n + 1, sizeof *s->massless);
    s->settled = qdot_calloc(surfaces + 1, sizeof *s->settled);
    s->symbols = qdot_calloc(2 * surfaces + 1, sizeof *s->symbols);
    if (!s->massless || !s->settled || !s->symbols)
        return QDOT_ENOMEM;
    s->values = s->symbols + surfaces;
    for (size_t i = 0; i < s->n - s->p->n_states; i++) {
        s->massless[i] = qdot_massless_is(s->scene, s->p, i);
        s->some_massless |= s->massless[i];
    }
    return QDOT_OK;
}

/* Insert the friction ratios found last into the values of those found before. */
static qdot_status
insert_into_earlier_ratios(sliding *s)
{
    qdot_plan *p = s->p;

    for (size_t k = 0; k < s->n_settled; k++) {
        qdot_expr value = s->values[k];

        for (size_t i = 0; i < p->mode->surfaces.n; i++)
            value = qdot_subs(p->pool, value, 1, &p->mode->surfaces.at[i].side, &p->share[i]);
        p->share[s->settled[k]] = value;
    }
    return qdot_pool_check(p->pool);
}

static qdot_status
append_unknown(sliding *s, size_t surface)
{
    const qdot_puck *puck = qdot_puck_of(s->p->mode, surface);
    const qdot_facts facts = qdot_scene_facts(s->scene);

    for (size_t c = 0; c < (puck ? puck->k : 1); c++)
        s->of[s->k++] = (unknown){.surface = surface, .c = c, .puck = puck};
    return puck ? qdot_puck_hold(s->p->pool, puck, &facts, s->n, s->p->f) : QDOT_OK;
}

qdot_status
qdot_sliding_freeze(qdot_plan *p, qdot_scene *scene)
{
    const qdot_switches *mode = p->mode;
    const size_t surfaces = mode->surfaces.n, n = p->n, most = surfaces + mode->n_puck_symbols;
    sliding s = {.p = p, .scene = scene, .n = n, .m = scene->constraints.n};
    qdot_status status = QDOT_OK;

    if (qdot_sliding_is(mode, p->side)) {
        p->share = qdot_calloc(most, sizeof *p->share);
        s.of = qdot_calloc(most, sizeof *s.of);
        status = p->share && s.of ? QDOT_OK : QDOT_ENOMEM;
    }
    for (size_t i = 0; i < surfaces && p->share && s.of; i++)
        p->share[i] = mode->surfaces.at[i].side;
    if (status == QDOT_OK)
        status = qdot_switches_freeze(mode, p->side, p->share, n * n, p->M, p->M);
    if (status == QDOT_OK)
        status = qdot_switches_freeze(mode, p->side, p->share, n, p->f, p->f);
    for (size_t i = 0; i < surfaces && p->share && s.of && status == QDOT_OK; i++)
        if (p->side[i] == QDOT_SIDE_SLIDES
            || (mode->surfaces.at[i].puck > 0 && qdot_puck_is_held(p->side[i])))
            status = append_unknown(&s, i);
    if (status == QDOT_OK && s.k > 0) {
        const size_t size = n + s.m + s.k;

        status = find_massless_coordinates(&s);
        if (status == QDOT_OK)
            status = determine_massless_ratios(&s);
        s.A = qdot_calloc(size * (size + 2), sizeof *s.A);
        if (status == QDOT_OK && s.k > 0)
            status = s.A ? solve_system(&s) : QDOT_ENOMEM;
        if (status == QDOT_OK)
            status = insert_into_earlier_ratios(&s);
    }
    qdot_free(s.A);
    qdot_free(s.massless);
    qdot_free(s.settled);
    qdot_free(s.symbols);
    qdot_free(s.of);
    return status;
}

qdot_expr
qdot_plan_reading(const qdot_plan *p, qdot_expr e)
{
    const qdot_switches *s = p->read_switches;
    qdot_expr *share;

    e = qdot_plan_substitute(p, e);
    if (!p->read_side || e == QDOT_NIL)
        return e;
    for (size_t i = 0; i < s->pucks.n; i++)
        if (p->read_side[s->pucks.at[i].surface] == QDOT_SIDE_SLIDES
            && qdot_puck_reading(p->pool, &s->pucks.at[i], &e) != QDOT_OK)
            return qdot_pool_fail(p->pool);
    share = qdot_calloc(s->surfaces.n, sizeof *share);
    if (!share)
        return qdot_pool_fail(p->pool);
    for (size_t i = 0; i < s->surfaces.n; i++)
        share[i] = s->surfaces.at[i].side;
    if (qdot_switches_freeze(s, p->read_side, share, 1, &e, &e) != QDOT_OK)
        e = qdot_pool_fail(p->pool);
    qdot_free(share);
    return e;
}
