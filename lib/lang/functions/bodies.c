/* bodies.c -- functions of particles and bodies: places, velocities, momenta, inertia, energy. */
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/value-kind.h"
#include "lang/functions/builtin.h"
#include "lang/session/labels.h"
#include "mech/scene/body-joint.h"
#include "mech/scene/scene.h"
#include "mech/study/bodies.h"

/* --- places and velocities ------------------------------------------------------------- */

/* Find the label spelled by the symbol `carrier`: of a body, or of a particle if particles are allowed. */
static qdot_status
label_of(qdot_session *s, qdot_expr carrier, bool particles, const char **label)
{
    const qdot_symbol *symbol = qdot_expr_symbol(s->pool, carrier);
    qdot_words known = {0};
    qdot_status status;

    if (symbol == NULL || symbol->class != QDOT_FORMAL)
        return qdot_fail(QDOT_ETYPE, "the first argument is the name of a body%s",
                         particles ? " or particle" : "");
    *label = symbol->name;
    if (qdot_scene_find_body(s->scene, *label) != NULL)
        return QDOT_OK;
    if (qdot_scene_find_particle(s->scene, *label) != NULL) {
        if (particles)
            return QDOT_OK;
        return qdot_fail(QDOT_ETYPE, "`%.200s` is a particle, not a body", *label);
    }
    qdot_fail(QDOT_ENAME, "there is no %s `%.200s`", particles ? "body or particle" : "body", *label);
    qdot_labels_add(s->scene, &known);
    status = qdot_labels_hint(*label, &known);
    qdot_free(known.at);
    return status;
}

qdot_status
qdot_call_point(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    const char *label = NULL;

    QDOT_TRY(label_of(s, args[0], n == 1, &label));
    return qdot_value_kind_give(
        s->pool, qdot_scene_point(s->scene, label, n == 2 ? args[1] : QDOT_NIL), value);
}

qdot_status
qdot_call_spin(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    const char *label = NULL;

    (void)n;
    QDOT_TRY(label_of(s, args[0], false, &label));
    return qdot_value_kind_give(s->pool, qdot_scene_spin(s->scene, label), value);
}

qdot_status
qdot_call_velocity(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    const char *label = NULL;

    (void)n;
    QDOT_TRY(label_of(s, args[0], false, &label));
    return qdot_value_kind_give(s->pool, qdot_scene_velocity(s->scene, label, args[1]),
                                value);
}

/* --- joints ----------------------------------------------------------------------------- */

static qdot_status
joint_of(qdot_session *s, qdot_expr carrier, const qdot_body_joint **joint)
{
    const qdot_symbol *symbol = qdot_expr_symbol(s->pool, carrier);
    qdot_words known = {0};
    qdot_status status;

    if (symbol == NULL || symbol->class != QDOT_FORMAL)
        return qdot_fail(QDOT_ETYPE, "the argument is the name of a joint");
    *joint = qdot_scene_find_joint(s->scene, symbol->name);
    if (*joint != NULL)
        return QDOT_OK;
    for (size_t i = 0; i < s->scene->joints.n; i++)
        (void)qdot_vec_push(&known, s->scene->joints.at[i].name); /* if memory runs out the hint lacks this name */
    (void)qdot_fail(QDOT_ENAME, "there is no joint `%.200s`", symbol->name);
    status = known.n > 0 ? qdot_labels_hint(symbol->name, &known)
                         : qdot_hint("joint hinge %.60s between ground, BODY at P", symbol->name);
    qdot_free(known.at);
    return status;
}

qdot_status
qdot_call_reaction(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    const qdot_body_joint *joint;
    qdot_expr torque;

    (void)n;
    QDOT_TRY(joint_of(s, args[0], &joint));
    return qdot_body_joint_reaction(s->scene, joint, value, &torque);
}

qdot_status
qdot_call_reaction_torque(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    const qdot_body_joint *joint;
    qdot_expr force;

    (void)n;
    QDOT_TRY(joint_of(s, args[0], &joint));
    return qdot_body_joint_reaction(s->scene, joint, &force, value);
}

/* --- momenta, inertia, energy ------------------------------------------------------------ */

/* Define the handler of a function of a particle or body and a place, both of which may be left out of `of`. */
#define OF_MASS(word, of)                                                                          \
    qdot_status qdot_call_##word(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)   \
    {                                                                                    \
        const char *label = NULL;                                                        \
                                                                                         \
        QDOT_TRY(label_of(s, args[0], true, &label));                                    \
        return qdot_value_kind_give(s->pool, of, value);                                 \
    }
#define PLACE (n == 2 ? args[1] : QDOT_NIL)
OF_MASS(momentum, ((void)n, qdot_bodies_momentum(s->scene, label)))
OF_MASS(angular_momentum, qdot_bodies_angular_momentum(s->scene, label, PLACE))
OF_MASS(inertia, qdot_bodies_inertia(s->scene, label, PLACE))
OF_MASS(energy, ((void)n, qdot_bodies_energy(s->scene, label)))
#undef PLACE
#undef OF_MASS
