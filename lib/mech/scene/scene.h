/* scene.h -- the declarations of a user: coordinates, r(q, t), masses, forces, constraints.
 *
 * A scene owns its arrays and texts and borrows the pool; texts stay valid until the scene is
 * freed, even those of removed things. Nothing is derived here; mech/dynamics/quantity.h derives
 * on demand and keeps the results until the scene changes (qdot_scene.version).
 * Vectors are VECs of 2 or 3 components; in one dimension plain scalars.
 */
#ifndef QDOT_MECH_SCENE_H
#define QDOT_MECH_SCENE_H

#include "base/text.h"
#include "mech/scene/things.h"

qdot_scene *qdot_scene_new(qdot_pool *pool); /* returns NULL if memory runs out */
void qdot_scene_free(qdot_scene *scene);

/* Adders: check kinds and dimensions (QDOT_ETYPE), name clashes among labels (QDOT_ENAME), and
 * that L is not stated beside particles (QDOT_EINVAL). Names are copied; NULL where allowed. On
 * error the scene is unchanged. */
QDOT_MUST_CHECK qdot_status qdot_scene_coordinate(qdot_scene *s, qdot_expr q);
QDOT_MUST_CHECK qdot_status qdot_scene_particle(qdot_scene *s, const char *name, qdot_expr mass,
                                                qdot_expr position);
/* Plane: angle given, which determines the rotation; inertia a scalar. Space: no angle, rotation
 * a 3x3 MAT; inertia a VEC of three moments or a symmetric MAT; about (nil: the centre of mass)
 * body-fixed: the parallel axis theorem is applied. Its name is not checked. */
QDOT_MUST_CHECK qdot_status qdot_scene_body(qdot_scene *s, const char *name,
                                            const qdot_body *body, qdot_expr about);

/* A gravity, potential or dissipation with its label (NULL: none). A gravity without label takes
 * the place of the one without label before. */
QDOT_MUST_CHECK qdot_status qdot_scene_term(qdot_scene *s, qdot_scene_kind kind,
                                            const char *name, qdot_expr e);
/* Declare a field, a potential, a spring or another term without label. */
QDOT_MUST_CHECK qdot_status qdot_scene_gravity(qdot_scene *s, qdot_expr field);
QDOT_MUST_CHECK qdot_status qdot_scene_potential(qdot_scene *s, qdot_expr V);
QDOT_MUST_CHECK qdot_status qdot_scene_spring(qdot_scene *s, const qdot_link *spring);
QDOT_MUST_CHECK qdot_status qdot_scene_damper(qdot_scene *s, const qdot_link *damper);
QDOT_MUST_CHECK qdot_status qdot_scene_dissipation(qdot_scene *s, qdot_expr D);
/* Declare a force; QDOT_EINVAL if it acts on a material point but `on` is no body. */
QDOT_MUST_CHECK qdot_status qdot_scene_force(qdot_scene *s, const qdot_force *force);
QDOT_MUST_CHECK qdot_status qdot_scene_torque(qdot_scene *s, const qdot_torque *torque);
/* State L; in place of an H stated before. */
QDOT_MUST_CHECK qdot_status qdot_scene_lagrangian(qdot_scene *s, qdot_expr L);
/* State H(q, p, t), without velocities; L: the Lagrangian that follows from it, or nil (mech/hamilton/hamilton-stated.c). */
QDOT_MUST_CHECK qdot_status qdot_scene_hamiltonian(qdot_scene *s, qdot_expr H, qdot_expr L);
/* Fail if the scene states its Lagrangian or H, because then the declaration named by `what` would have no effect. */
QDOT_MUST_CHECK qdot_status qdot_scene_need_no_lagrangian(const qdot_scene *s, const char *what);
/* f = left - right; scalars, or VECs of equal size (one constraint a component: "pin, 1").
 * Components proved to hold identically are left out and named in s->dropped. Without label the
 * constraint is called by its number. QDOT_EINVAL: no coordinate in it, or a third derivative. */
QDOT_MUST_CHECK qdot_status qdot_scene_constraint(qdot_scene *s, const char *label,
                                                  qdot_expr left, qdot_expr right);
/* The derivative of the given order (0, 1, 2) by t of constraint function f number i; how high depends on its kind. */
qdot_expr qdot_mech_constraint_derivative(qdot_scene *s, size_t i, unsigned order);
/* A state z' = rate. The first call, with rate nil, makes z a coordinate of the scene, so that the
 * right sides of several states may hold one another; the second gives its right side. QDOT_ENAME: it has one already. */
QDOT_MUST_CHECK qdot_status qdot_scene_state(qdot_scene *s, qdot_expr z, qdot_expr rate);
/* The state whose symbol is z; NULL: z is none. */
const qdot_state *qdot_scene_state_of(const qdot_scene *s, qdot_expr z);
/* The expression e with the right sides of the states in place of z'. */
qdot_expr qdot_scene_with_rates(const qdot_scene *s, qdot_expr e);
/* QDOT_ENOTBUILT if e holds the derivative of a state of order `from` (0: the state itself) or higher; `what` is e. */
QDOT_MUST_CHECK qdot_status qdot_scene_refuse_states(const qdot_scene *s, qdot_expr e, const char *what, uint32_t from);
/* QDOT_EINVAL if a state has no right side yet. */
QDOT_MUST_CHECK qdot_status qdot_scene_check_states(const qdot_scene *s);
/* QDOT_ENOTBUILT if the scene has states: `what` is not made for them. */
QDOT_MUST_CHECK qdot_status qdot_scene_need_no_states(const qdot_scene *s, const char *what);
/* Higher derivatives (qdot_higher). qdot_scene_lagrangian leaves out total time derivatives of L that are linear in the
 * highest derivatives, x x'' for -x'^2, and declares the coordinates u that the derivatives left over need.
 *   _find        the row whose coordinate is u; NULL: u is none
 *   _order       the highest derivative of the coordinate q in the stated Lagrangian; 1 where it holds none above q'
 *   _in_motion   e with the coordinates u, their velocities and accelerations in place of q'' and higher derivatives
 *   _in_jets     e with q'' and higher derivatives in their place again
 *   _refuse      QDOT_ENOTBUILT if the scene has such coordinates: `what` is not made for them */
const qdot_higher *qdot_higher_find(const qdot_scene *s, qdot_expr u);
uint32_t qdot_higher_order(const qdot_scene *s, qdot_expr q);
qdot_expr qdot_higher_in_motion(const qdot_scene *s, qdot_expr e);
qdot_expr qdot_higher_in_jets(const qdot_scene *s, qdot_expr e);
QDOT_MUST_CHECK qdot_status qdot_higher_refuse(const qdot_scene *s, const char *what);
/* Take the coordinates of the derivatives away with their Lagrangian. */
void qdot_higher_forget(qdot_scene *s);
/* Let *L, which may hold second and higher derivatives, be the Lagrangian of the scene. *L becomes what is to be stored as
 * `lagrangian` (mech/scene/things.h). QDOT_ENOTBUILT: equations of odd order, or a total derivative whose integral was not found. */
QDOT_MUST_CHECK qdot_status qdot_higher_state(qdot_scene *s, qdot_expr *L);
/* An event; everything is copied. QDOT_EINVAL: it holds neither coordinate nor time, or what a run
 * does not know; a target twice. */
QDOT_MUST_CHECK qdot_status qdot_scene_event(qdot_scene *s, const qdot_event *event);
const qdot_event *qdot_scene_find_event(const qdot_scene *s, const char *label);
/* The first event that ends a run or changes something; NULL if events are only recorded. */
const qdot_event *qdot_scene_acting_event(const qdot_scene *s);
/* Add an equation or inequality that proofs may use; turned: a < b was written b > a. QDOT_ETYPE:
 * it is neither; QDOT_EINVAL: it can never hold. */
QDOT_MUST_CHECK qdot_status qdot_scene_assume(qdot_scene *s, qdot_expr relation, bool turned);
/* Declare a parameter to be an input. Set the outputs e [n], in place of earlier ones. */
QDOT_MUST_CHECK qdot_status qdot_scene_input(qdot_scene *s, qdot_expr symbol);
QDOT_MUST_CHECK qdot_status qdot_scene_outputs(qdot_scene *s, size_t n, const qdot_expr *e);
/* Take the thing of that label out again. What was declared to act on a removed particle or body
 * goes with it, named in s->dropped. */
QDOT_MUST_CHECK qdot_status qdot_scene_remove(qdot_scene *s, const char *label);
/* Take the state z and its rate out again. QDOT_EINVAL, and nothing is changed: something reads it, which the message names. */
QDOT_MUST_CHECK qdot_status qdot_scene_remove_state(qdot_scene *s, qdot_expr z);
/* The number of items of a kind, with and without label; remove item k, counted from 0. */
size_t qdot_scene_count(const qdot_scene *s, qdot_scene_kind kind);
QDOT_MUST_CHECK qdot_status qdot_scene_remove_at(qdot_scene *s, qdot_scene_kind kind, size_t k);
/* Whether the latest of a kind equals an earlier one, both without label. QDOT_FORCE: on a
 * particle, a body or at a place; QDOT_TORQUE: also those declared with `force`. */
bool qdot_scene_said_twice(const qdot_scene *s, qdot_scene_kind kind);

/* Mark the scene as changed: `version` becomes a number that it has never had. */
void qdot_scene_changed(qdot_scene *s);

/* The arrays of declarations in a uniform form: `size` bytes an item, which may be copied byte by
 * byte. With `lagrangian`, `higher_lagrangian` and `hamiltonian` they are the state of a scene: a copy of all can be put back, with the
 * `version` that the scene had then. */
enum { QDOT_SCENE_PARTS = 20 };
typedef struct {
    void *at;            /* address of the pointer to the array's first item */
    size_t *n, *capacity, size;
} qdot_scene_part;
qdot_scene_part qdot_scene_part_at(qdot_scene *s, size_t k);

/* Rotation matrix Rz(phi) Rx(theta) Rz(psi). */
qdot_expr qdot_scene_euler(qdot_pool *pool, qdot_expr phi, qdot_expr theta, qdot_expr psi);

/* Replace a symbol by another expression in all declarations but events. */
QDOT_MUST_CHECK qdot_status qdot_scene_replace(qdot_scene *s, qdot_expr from, qdot_expr to);
/* Whether a symbol occurs in any expression of the scene but events. */
bool qdot_scene_contains(qdot_scene *s, qdot_expr symbol);
/* Whether e holds the coordinate q, a derivative of it, its momentum or q(t - tau); whether an expression of the scene does, one
 * of an event too. */
bool qdot_reads_coordinate(qdot_pool *pool, qdot_expr e, qdot_expr q);
bool qdot_scene_reads(qdot_scene *s, qdot_expr q);
/* Whether the scene holds coordinates at an earlier time (qdot_delayed), in events too. QDOT_ENOTBUILT if e, which is called `what`,
 * holds one. */
bool qdot_scene_has_delays(const qdot_scene *s);
QDOT_MUST_CHECK qdot_status qdot_scene_refuse_delays(const qdot_scene *s, qdot_expr e, const char *what);
/* Replace every expression e of the scene by f(e); if that is nil the pool keeps the failure. */
QDOT_MUST_CHECK qdot_status qdot_scene_map(qdot_scene *s,
                                           qdot_expr (*f)(qdot_expr e, void *user), void *user);
/* Declare all that s declares in `to`, except coordinates, constraints, assumptions and events.
 */
QDOT_MUST_CHECK qdot_status qdot_scene_copy_things(const qdot_scene *s, qdot_scene *to);

/* Find a particle or body by its label, NULL if there is none; whether anything has the label; whether a particle or body
 * is a member of the family, as bob[2] of bob. */
const qdot_particle *qdot_scene_find_particle(const qdot_scene *s, const char *label);
const qdot_body *qdot_scene_find_body(const qdot_scene *s, const char *label);
/* What has mass, a particle or a body; borrowed until the scene changes. The k-th: first all particles, then the bodies. */
typedef struct {
    const char *name;
    qdot_expr mass, position;
    const qdot_body *body; /* NULL: a particle */
} qdot_massive;
qdot_massive qdot_scene_massive(const qdot_scene *s, size_t k);
bool qdot_scene_has_label(const qdot_scene *s, const char *label);
bool qdot_scene_is_family(const qdot_scene *s, const char *label);
/* QDOT_ENAME if the scene has this label already; NULL, no label, is always allowed. */
QDOT_MUST_CHECK qdot_status qdot_scene_need_new_label(const qdot_scene *s, const char *label);
/* The position of a particle or body; nil and QDOT_ENAME if there is none. */
qdot_expr qdot_scene_position(const qdot_scene *s, const char *label);
/* point(body, P): position of the body-fixed P; for a particle P must be absent. spin(body):
 * scalar in the plane, VEC in inertial axes in space. velocity(body, P): of its material at the
 * place P. */
qdot_expr qdot_scene_point(qdot_scene *s, const char *body, qdot_expr P);
qdot_expr qdot_scene_spin(qdot_scene *s, const char *body);
qdot_expr qdot_scene_velocity(qdot_scene *s, const char *body, qdot_expr place);
/* Append the labels, "a, b", of bodies within which a place moves: it contains only their
 * coordinates, and d(place)/dt is proved to differ from the velocity of the material there.
 * Nothing is appended for the place of a particle or one fixed in a body. body: test only this
 * one; NULL: all. */
QDOT_MUST_CHECK qdot_status qdot_scene_moves_within(qdot_scene *s, qdot_expr place,
                                                    const char *body, qdot_text *out);

/* Print every declaration as a statement that parses back, one per line (plain style). */
QDOT_MUST_CHECK qdot_status qdot_scene_print(const qdot_scene *s, qdot_text *out);
/* Print "state z' = rate" without an end of line. */
QDOT_MUST_CHECK qdot_status qdot_scene_print_state(const qdot_scene *s, qdot_expr z, qdot_text *out);
/* Print all declarations except the coordinates. */
QDOT_MUST_CHECK qdot_status qdot_scene_print_things(const qdot_scene *s, qdot_text *out);
/* Print a symbol with its domain, "0 < theta < pi". */
QDOT_MUST_CHECK qdot_status qdot_scene_print_domain(const qdot_scene *s, qdot_expr x,
                                                    qdot_text *out);
/* Print the line of the k-th item of a kind, counted from 0. */
QDOT_MUST_CHECK qdot_status qdot_scene_print_at(const qdot_scene *s, qdot_scene_kind kind,
                                                size_t k, qdot_text *out);

#endif
