/* canonical.c -- compiles derivatives of H and makes the Taylor series program of Hamilton's equations. */
#include "sim/form/canonical.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "mech/dynamics/quantity.h"
#include "mech/hamilton/hamilton.h"
#include "sim/model/switch.h"

/* The largest systems for which Hamilton's equations are used: beyond, the inverse of M costs too much. */
enum { most_coordinates = 6, most_coupled = 2 };

typedef struct {
    qdot_scene *scene;
    const qdot_plan *plan;
    qdot_canonical *c;
    qdot_expr *p;                         /* [n] symbols of the momenta */
    qdot_expr *slope, *pull, *Q, *before; /* [n] each: dH/dp, -dH/dq, other applied forces Q, momenta dL/dq' */
} builder;

/* Whether Hamilton's equations are worthwhile; not if M is constant, as momenta are then velocities
 * up to factors. */
static bool
is_suitable_plan(const qdot_plan *p)
{
    bool moves = false;

    if (p->constraints || p->n_states > 0 || p->n > most_coordinates || !p->smooth
        || p->share || (p->mode && p->mode->atoms.n > 0))
        return false;
    for (size_t b = 0; b < p->structure.blocks; b++)
        if (p->blocks[b].n > most_coupled)
            return false;
    for (size_t i = 0; i < p->n * p->n; i++)
        moves = moves || !qdot_expr_is_constant(p->pool, p->M[i]);
    return moves;
}

/* Derive H and the forces; *there: the velocities can be expressed by momenta. */
static qdot_status
derive_hamiltonian(builder *b, bool *there)
{
    qdot_pool *pool = b->plan->pool;
    const qdot_expr H = qdot_plan_substitute(b->plan, qdot_hamilton_hamiltonian(b->scene));
    const qdot_expr V = b->scene->lagrangian == QDOT_NIL ? qdot_mech_potential(b->scene)
                                                         : QDOT_ZERO;
    const qdot_status status = qdot_pool_check(pool);

    *there = status == QDOT_OK;
    if (status == QDOT_EDOMAIN || status == QDOT_ESINGULAR || status == QDOT_ELIMIT)
        return QDOT_OK;
    QDOT_TRY(status);
    for (size_t i = 0; i < b->plan->n; i++) {
        const qdot_expr q = b->plan->inputs[i];
        const qdot_expr Q = qdot_add(pool, qdot_mech_force(b->scene, q), qdot_diff(pool, V, q));

        b->p[i] = qdot_symbol_of(pool, QDOT_MOMENTUM, q);
        b->slope[i] = qdot_diff(pool, H, b->p[i]);
        b->pull[i] = qdot_neg(pool, qdot_diff(pool, H, q));
        b->Q[i] = qdot_plan_substitute(b->plan, qdot_expand(pool, Q));
        b->before[i] = qdot_plan_substitute(b->plan, qdot_mech_momentum(b->scene, q));
    }
    return qdot_pool_check(pool);
}

static bool
moves(const builder *b, size_t i)
{
    return b->pull[i] != QDOT_ZERO || b->Q[i] != QDOT_ZERO;
}

/* Order the coordinates: first those whose momenta change, then those with constant momenta. */
static qdot_status
order_momenta(builder *b)
{
    qdot_canonical *c = b->c;
    size_t at = 0;

    c->n = b->plan->n;
    c->place = qdot_calloc(c->n, sizeof *c->place);
    if (!c->place)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < c->n; i++)
        c->moving += moves(b, i);
    for (int still = 0; still < 2; still++)
        for (size_t i = 0; i < c->n; i++)
            if (moves(b, i) != still)
                c->place[i] = at++;
    return QDOT_OK;
}

static qdot_status
make_tapes(builder *b)
{
    const qdot_plan *p = b->plan;
    qdot_canonical *c = b->c;
    const size_t n = c->n;
    qdot_expr *in = qdot_calloc(5 * n + 1, sizeof *in), *out = in ? in + 2 * n + 1 : NULL;
    qdot_expr *Q = in ? out + 2 * n : NULL;
    bool applied = false;
    qdot_status status = in ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < n && in; i++) {
        const size_t at = c->place[i];

        in[i] = p->inputs[i];
        in[n + 1 + at] = b->p[i];
        out[i] = b->slope[i];
        if (at < c->moving) {
            out[n + at] = b->pull[i];
            Q[at] = b->Q[i];
            applied = applied || b->Q[i] != QDOT_ZERO;
        }
    }
    if (in)
        in[n] = QDOT_T;
    if (status == QDOT_OK)
        status = qdot_tape_new(p->pool, 2 * n + 1, in, n + c->moving, out, &c->rates);
    if (status == QDOT_OK && applied)
        status = qdot_tape_new(p->pool, 2 * n + 1, p->inputs, c->moving, Q, &c->forces);
    for (size_t i = 0; i < n && in; i++)
        out[c->place[i]] = b->before[i];
    if (status == QDOT_OK)
        status = qdot_tape_new(p->pool, 2 * n + 1, p->inputs, n, out, &c->momenta);
    qdot_free(in);
    return status;
}

/* Add the program's inputs: q [n], q' [n], t, p [n]; the rows of q' are those that compute dH/dp. */
static qdot_status
add_input_rows(qdot_canonical *c, qdot_program_builder *b, qdot_program_row *in, qdot_program_row *out)
{
    const qdot_program_row n = (qdot_program_row)c->n, moving = (qdot_program_row)c->moving;
    qdot_program_row *Q = out + 2 * n;

    for (qdot_program_row i = 0; i < n; i++) {
        in[i] = i;
        in[n + 1 + i] = 2 * n + 1 + i;
    }
    in[n] = 2 * n;
    qdot_program_append(b, c->rates, in, out);
    if (c->forces) {
        for (qdot_program_row i = 0; i < n; i++)
            in[n + i] = out[i];
        in[2 * n] = 2 * n;
        qdot_program_append(b, c->forces, in, Q);
    }
    for (qdot_program_row i = 0; i < n; i++) {
        const qdot_motion_unknown q = {out[i], n + i, i, QDOT_NO_ROW};

        QDOT_TRY(qdot_vec_push(&c->motion.unknowns, q));
    }
    for (qdot_program_row i = 0; i < moving; i++) {
        if (c->forces)
            out[n + i] = qdot_program_operation(b, QDOT_OP_ADD, out[n + i], Q[i], Q[i]);
        QDOT_TRY(qdot_motion_give(&c->motion, out[n + i], 2 * n + 1 + i, QDOT_NO_ROW));
    }
    return QDOT_OK;
}

static qdot_status
make_series_program(qdot_canonical *c)
{
    const size_t inputs = 3 * c->n + 1, moving = 2 * c->n + 1 + c->moving;
    qdot_program_row *rows = qdot_calloc(inputs + 3 * c->n, sizeof *rows);
    qdot_program_builder *b = NULL;
    qdot_status status;

    if (!rows)
        return QDOT_ENOMEM;
    status = qdot_program_begin(inputs, moving, false, &c->motion.program, &b);
    if (status == QDOT_OK)
        status = qdot_motion_complete(&c->motion, b, add_input_rows(c, b, rows, rows + inputs));
    qdot_free(rows);
    return status;
}

static qdot_status
build_canonical_form(builder *b, bool *there)
{
    const size_t n = b->plan->n;

    b->p = qdot_calloc(5 * n, sizeof *b->p);
    if (!b->p)
        return QDOT_ENOMEM;
    b->slope = b->p + n;
    b->pull = b->slope + n;
    b->Q = b->pull + n;
    b->before = b->Q + n;
    QDOT_TRY(derive_hamiltonian(b, there));
    if (!*there)
        return QDOT_OK;
    QDOT_TRY(order_momenta(b));
    QDOT_TRY(make_tapes(b));
    return make_series_program(b->c);
}

qdot_status
qdot_canonical_new(qdot_scene *scene, const qdot_plan *plan, qdot_canonical **canonical)
{
    builder b = {.scene = scene, .plan = plan};
    bool there = false;
    qdot_status status;

    *canonical = NULL;
    if (!is_suitable_plan(plan))
        return QDOT_OK;
    b.c = qdot_calloc(1, sizeof *b.c);
    if (!b.c)
        return QDOT_ENOMEM;
    status = build_canonical_form(&b, &there);
    qdot_free(b.p);
    if (status != QDOT_OK || !there) {
        qdot_canonical_free(b.c);
        return status;
    }
    *canonical = b.c;
    return QDOT_OK;
}

void
qdot_canonical_free(qdot_canonical *c)
{
    if (!c)
        return;
    qdot_free(c->place);
    qdot_tape_free(c->momenta);
    qdot_tape_free(c->rates);
    qdot_tape_free(c->forces);
    qdot_motion_clear(&c->motion);
    qdot_free(c);
}
