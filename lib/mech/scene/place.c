/* place.c -- whether a place is fixed in a body or moves within it.
 *
 *     fixed in the body:  dP/dt = v(P),  v(P) = r' + omega x (P - r)
 */
#include "expr/calculus.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "mech/scene/access.h"
#include "mech/scene/scene.h"
#include "normal/prove/decide.h"

/* Whether the body's position and rotation contain every coordinate on which the position of the point depends. */
static bool
body_has_coordinates_of_point(qdot_scene *s, const qdot_body *b, qdot_expr place)
{
    for (size_t i = 0; i < s->coordinates.n; i++) {
        qdot_expr q = s->coordinates.at[i];

        if (qdot_expr_contains(s->pool, place, q) &&
            !qdot_expr_contains(s->pool, b->position, q) &&
            !qdot_expr_contains(s->pool, b->rotation, q))
            return false;
    }
    return true;
}

/* Decide whether a point P is fixed in a body: dP/dt equals the body's velocity at P, component by component. */
static qdot_status
decide_fixed_in_body(qdot_scene *s, const qdot_body *b, qdot_expr place, qdot_verdict *verdict)
{
    qdot_pool *pool = s->pool;
    qdot_expr rate = qdot_ddt(pool, place), v = qdot_scene_velocity(s, b->name, place);
    qdot_facts facts = qdot_scene_facts(s);

    QDOT_TRY(qdot_pool_check(pool));
    *verdict = QDOT_PROVED;
    for (uint32_t d = 0; d < qdot_mech_dimension(pool, place); d++) {
        qdot_decision seen;

        QDOT_TRY(qdot_decide_equal(pool, qdot_mech_component(pool, rate, d),
                                   qdot_mech_component(pool, v, d), &facts, &seen));
        if (seen.verdict == QDOT_REFUTED) {
            *verdict = QDOT_REFUTED;
            return QDOT_OK;
        }
        if (seen.verdict == QDOT_UNDECIDED)
            *verdict = QDOT_UNDECIDED;
    }
    return QDOT_OK;
}

qdot_status
qdot_scene_moves_within(qdot_scene *s, qdot_expr place, const char *body, qdot_text *out)
{
    qdot_vec(const char *) moving = {0};
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < s->particles.n; i++)
        if (s->particles.at[i].position == place)
            return QDOT_OK;
    for (size_t i = 0; i < s->bodies.n && status == QDOT_OK; i++) {
        const qdot_body *b = &s->bodies.at[i];
        qdot_verdict fixed;

        if ((body && b != qdot_scene_find_body(s, body)) ||
            (!body && !body_has_coordinates_of_point(s, b, place)) ||
            qdot_mech_dimension(s->pool, b->position) != qdot_mech_dimension(s->pool, place))
            continue;
        status = decide_fixed_in_body(s, b, place, &fixed);
        if (status == QDOT_OK && fixed == QDOT_PROVED) {
            moving.n = 0;
            break;
        }
        if (status == QDOT_OK && fixed == QDOT_REFUTED)
            status = qdot_vec_push(&moving, b->name);
    }
    for (size_t i = 0; i < moving.n && status == QDOT_OK; i++)
        qdot_text_format(out, "%s%s", i > 0 ? ", " : "", moving.at[i]);
    qdot_free(moving.at);
    return status == QDOT_OK ? qdot_text_status(out) : status;
}
