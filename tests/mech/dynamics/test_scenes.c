/* The rows of the scenes that define the mission, each a decision. */
#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/dynamics/quantity.h"
#include "mech/geometry/metric.h"
#include "mech/kit.h"

static qdot_expr
Q(kit *k, const char *q)
{
    return qdot_mech_force(k->scene, E(k, "%s", q));
}

static qdot_expr
eom(kit *k, const char *q)
{
    return qdot_mech_equation(k->scene, E(k, "%s", q));
}

static void
line_elements_of_the_textbook_body(kit *k)
{
    coords(k, "r>0 theta phi z u v");
    SAME(k, qdot_mech_ds2(k->scene, E(k, "(r*cos(theta), r*sin(theta))")),
         "dr^2 + r^2*dtheta^2");
    SAME(k, qdot_mech_speed2(k->scene, E(k, "(r*cos(theta), r*sin(theta), z)")),
         "r'^2 + r^2*theta'^2 + z'^2");
    SAME(k,
         qdot_mech_speed2(k->scene, E(k, "(r*sin(theta)*cos(phi), r*sin(theta)*sin(phi), "
                                         "r*cos(theta))")),
         "r'^2 + r^2*theta'^2 + r^2*sin(theta)^2*phi'^2");
    SAME(k, qdot_mech_ds2(k->scene, E(k, "(u*v, (u^2 - v^2)/2)")),
         "(u^2 + v^2)*(du^2 + dv^2)");
    SAME(k, qdot_mech_ds2(k->scene, E(k, "(r + t^2, r*t)")),
         "(1 + t^2)*dr^2 + 2*(2*t + r*t)*dr*dt + (4*t^2 + r^2)*dt^2");
    SAME(k, qdot_mech_speed2(k->scene, E(k, "dr^2 + r^2*dphi^2")), "r'^2 + r^2*phi'^2");
}
TEST(line_elements_of_the_textbook)

static void
metric_of_a_place_and_of_a_line_element_body(kit *k)
{
    qdot_expr g;

    coords(k, "r>0 theta phi");
    g = qdot_mech_metric(k->scene, E(k, "(r*cos(phi), r*sin(phi))"));
    must(qdot_pool_check(k->pool));
    assert_int_equal(qdot_expr_count(k->pool, g), 4);
    SAME(k, qdot_expr_arg(k->pool, g, 0), "1");
    SAME(k, qdot_expr_arg(k->pool, g, 1), "0");
    SAME(k, qdot_expr_arg(k->pool, g, 3), "r^2");
    g = qdot_mech_metric(k->scene, E(k, "dr^2 + 2*r*dr*dphi + sinh(r)^2*dphi^2"));
    SAME(k, qdot_expr_arg(k->pool, g, 1), "r");
    SAME(k, qdot_expr_arg(k->pool, g, 3), "sinh(r)^2");
    assert_int_equal(qdot_mech_metric(k->scene, E(k, "dr^2 + dr*dphi*dtheta")), QDOT_NIL);
    assert_int_equal(qdot_pool_check(k->pool), QDOT_ETYPE);
}
TEST(metric_of_a_place_and_of_a_line_element)

static void
bead_on_a_wire_by_arc_length_body(kit *k)
{
    coords(k, "s");
    function(k, "x", "s");
    function(k, "y", "s");
    assume(k, "diff(x(s), s)^2 + diff(y(s), s)^2", "1");
    particle(k, "bead", "m", "(x(s), y(s))");
    gravity(k, "(0, -g)");
    READS(k, qdot_mech_kinetic(k->scene), "1/2*m*s'^2");
    READS(k, lhs(k, eom(k, "s")), "m*s''");
    SAME(k, rhs(k, eom(k, "s")), "-m*g*diff(y(s), s)");
}
TEST(bead_on_a_wire_by_arc_length)

static void
flexing_wire_body(kit *k)
{
    coords(k, "s");
    function(k, "x", "s, t");
    function(k, "y", "s, t");
    particle(k, "bead", "m", "(x(s, t), y(s, t))");
    gravity(k, "(0, -g)");
    SAME(k, qdot_mech_kinetic(k->scene),
         "m/2*((diff(x(s, t), s)*s' + diff(x(s, t), t))^2 + "
         "(diff(y(s, t), s)*s' + diff(y(s, t), t))^2)");
    SAME(k, lhs(k, eom(k, "s")),
         "m*((diff(x(s, t), s)^2 + diff(y(s, t), s)^2)*s'' "
         "+ (diff(x(s, t), s)*diff(diff(x(s, t), s), s)"
         " + diff(y(s, t), s)*diff(diff(y(s, t), s), s))*s'^2"
         "+ 2*(diff(x(s, t), s)*diff(diff(x(s, t), s), t)"
         " + diff(y(s, t), s)*diff(diff(y(s, t), s), t))*s'"
         "+ diff(x(s, t), s)*diff(diff(x(s, t), t), t)"
         " + diff(y(s, t), s)*diff(diff(y(s, t), t), t))");
    SAME(k, rhs(k, eom(k, "s")), "-m*g*diff(y(s, t), s)");
}
TEST(flexing_wire)

static void
pendulum_with_a_multiplier_body(kit *k)
{
    qdot_dof dof;

    coords(k, "x y");
    particle(k, "bob", "m", "(x, y)");
    gravity(k, "(0, -g)");
    constraint(k, "rod", "x^2 + y^2", "L^2");
    SAME(k, lhs(k, eom(k, "x")), "m*x''");
    SAME(k, rhs(k, eom(k, "x")), "lambda[rod]*2*x");
    SAME(k, rhs(k, eom(k, "y")), "-m*g + lambda[rod]*2*y");
    SAME(k, qdot_mech_constraint_derivative(k->scene, 0, 1), "2*x*x' + 2*y*y'");
    SAME(k, qdot_mech_constraint_derivative(k->scene, 0, 2),
         "2*x*x'' + 2*y*y'' + 2*x'^2 + 2*y'^2");
    must(qdot_mech_dof(k->scene, &dof));
    assert_int_equal(dof.freedom, 1);
    assert_true(dof.cartesian);
    assert_int_equal(dof.dimension, 2);
    SAME(k, qdot_mech_accel(k->scene, E(k, "x")),
         "(-x*(x'^2 + y'^2) + g*x*y)/(x^2 + y^2)");
}
TEST(pendulum_with_a_multiplier)

static void
pendulum_by_its_angle_body(kit *k)
{
    coords(k, "theta");
    particle(k, "bob", "m", "(L*sin(theta), -L*cos(theta))");
    gravity(k, "(0, -g)");
    READS(k, qdot_mech_kinetic(k->scene), "1/2*m*L^2*theta'^2");
    SAME(k, Q(k, "theta"), "-m*g*L*sin(theta)");
    SAME(k, qdot_mech_virtual_work(k->scene), "-m*g*L*sin(theta)*delta_theta");
    SAME(k, lhs(k, eom(k, "theta")), "m*L^2*theta''");
    SAME(k, rhs(k, eom(k, "theta")), "-m*g*L*sin(theta)");
    SAME(k, qdot_mech_accel(k->scene, E(k, "theta")), "-g/L*sin(theta)");
    SAME(k, qdot_mech_energy(k->scene), "1/2*m*L^2*theta'^2 - m*g*L*cos(theta)");
}
TEST(pendulum_by_its_angle)

static void
double_pendulum_in_angles_body(kit *k)
{
    symbolic_double_pendulum(k);
    SAME(k, qdot_mech_kinetic(k->scene),
         "1/2*(m1 + m2)*L1^2*theta1'^2 + 1/2*m2*L2^2*theta2'^2"
         " + m2*L1*L2*cos(theta2 - theta1)*theta1'*theta2'");
    SAME(k, Q(k, "theta1"), "-(m1 + m2)*g*L1*sin(theta1)");
    SAME(k, Q(k, "theta2"), "-m2*g*L2*sin(theta2)");
    SAME(k, qdot_mech_virtual_work(k->scene),
         "-(m1 + m2)*g*L1*sin(theta1)*delta_theta1 - m2*g*L2*sin(theta2)*delta_theta2");
    SAME(k, lhs(k, eom(k, "theta1")),
         "(m1 + m2)*L1^2*theta1'' + m2*L1*L2*theta2''*cos(theta2 - theta1)"
         " + m2*L1*L2*theta2'^2*sin(theta1 - theta2)");
    SAME(k, rhs(k, eom(k, "theta1")), "-(m1 + m2)*g*L1*sin(theta1)");
    SAME(k, lhs(k, eom(k, "theta2")),
         "m2*L2^2*theta2'' + m2*L1*L2*theta1''*cos(theta2 - theta1)"
         " + m2*L1*L2*theta1'^2*sin(theta2 - theta1)");
    SAME(k, qdot_mech_momentum(k->scene, E(k, "theta2")),
         "m2*L2^2*theta2' + m2*L1*L2*cos(theta1 - theta2)*theta1'");
    /* The accelerations put back make every residual vanish. */
    for (int i = 1; i <= 2; i++) {
        qdot_expr e = eom(k, i == 1 ? "theta1" : "theta2"), from[2], to[2];

        for (int j = 0; j < 2; j++) {
            from[j] = E(k, "theta%d''", j + 1);
            to[j] = qdot_mech_accel(k->scene, E(k, "theta%d", j + 1));
        }
        e = qdot_sub(k->pool, lhs(k, e), rhs(k, e));
        SAME(k, qdot_subs(k->pool, e, 2, from, to), "0");
    }
}
TEST(double_pendulum_in_angles)

static void
double_pendulum_in_cartesian_coordinates_body(kit *k)
{
    qdot_dof dof;

    coords(k, "x1 y1 x2 y2");
    particle(k, "a", "m1", "(x1, y1)");
    particle(k, "b", "m2", "(x2, y2)");
    gravity(k, "(0, -g)");
    constraint(k, "rod1", "x1^2 + y1^2", "L1^2");
    constraint(k, "rod2", "(x2 - x1)^2 + (y2 - y1)^2", "L2^2");
    must(qdot_mech_dof(k->scene, &dof));
    assert_int_equal(dof.coordinates, 4);
    assert_int_equal(dof.independent, 2);
    assert_int_equal(dof.freedom, 2);
    SAME(k, lhs(k, eom(k, "y1")), "m1*y1''");
    SAME(k, rhs(k, eom(k, "y1")), "-m1*g + 2*lambda[rod1]*y1 - 2*lambda[rod2]*(y2 - y1)");
    SAME(k, rhs(k, eom(k, "x2")), "2*lambda[rod2]*(x2 - x1)");
}
TEST(double_pendulum_in_cartesian_coordinates)

static void
spherical_pendulum_body(kit *k)
{
    qdot_cyclic *list;
    size_t n;
    bool conserved;

    coords(k, "theta phi");
    particle(k, "bob", "m",
             "(l*sin(theta)*cos(phi), l*sin(theta)*sin(phi), -l*cos(theta))");
    gravity(k, "(0, 0, -g)");
    must(qdot_mech_cyclic(k->scene, &list, &n));
    assert_int_equal(n, 1);
    assert_int_equal(list[0].coordinate, E(k, "phi"));
    assert_int_equal(list[0].rate, QDOT_NIL);
    SAME(k, list[0].momentum, "m*l^2*sin(theta)^2*phi'");
    qdot_free(list);
    must(qdot_mech_energy_conserved(k->scene, &conserved));
    assert_true(conserved);
    SAME(k, lhs(k, eom(k, "theta")), "m*l^2*(theta'' - sin(theta)*cos(theta)*phi'^2)");
}
TEST(spherical_pendulum)

static void
cyclic_momentum_under_an_applied_torque_has_a_rate_body(kit *k)
{
    qdot_cyclic *list;
    size_t n;

    coords(k, "r>0 phi");
    particle(k, "p", "m", "(r*cos(phi), r*sin(phi))");
    must(qdot_scene_potential(k->scene, E(k, "-K/r")));
    torque(k, "-c*phi'", "phi");
    must(qdot_mech_cyclic(k->scene, &list, &n));
    assert_int_equal(n, 1);
    SAME(k, list[0].rate, "-c*phi'");
    SAME(k, list[0].momentum, "m*r^2*phi'");
    qdot_free(list);
}
TEST(cyclic_momentum_under_an_applied_torque_has_a_rate)

static void
kanes_form_is_virtual_work_body(kit *k)
{
    qdot_link spring = {.name = "s", .stiffness = E(k, "kk"), .rest = E(k, "a")};
    qdot_link damper = {.name = "d", .stiffness = E(k, "c")};

    coords(k, "q1 q2 r>0");
    particle(k, "a", "m1", "(r*cos(q1) + t^2, r*sin(q1))");
    particle(k, "b", "m2", "(r*cos(q1) + b*sin(q2), r*sin(q1) - b*cos(q2)*t)");
    gravity(k, "(G*t, -g)");
    force(k, "(F*t, q1'*c)", "(r*cos(q1 + w*t), q2*sin(r) + t)");
    force(k, "(0, F2)", "(q1*q2, r^2*t)");
    spring.at[0] = E(k, "(r*cos(q1), r*sin(q1))");
    spring.at[1] = E(k, "(0, h*q2)");
    must(qdot_scene_spring(k->scene, &spring));
    damper.at[0] = E(k, "(r*cos(q1), r*sin(q1))");
    damper.at[1] = E(k, "(w*t, h)");
    must(qdot_scene_damper(k->scene, &damper));
    must(qdot_scene_potential(k->scene, E(k, "K*q1^2*q2*sin(w*t)")));
    must(qdot_scene_dissipation(k->scene, E(k, "c*q1'^2*r")));
    torque(k, "tau*sin(t)", "q2");
    for (int i = 0; i < 3; i++) {
        qdot_expr q = k->scene->coordinates.at[i];

        same_at(k, qdot_mech_force(k->scene, q), qdot_mech_force_kane(k->scene, q), i);
    }
}
TEST(kanes_form_is_virtual_work)

static void
knife_edge_body(kit *k)
{
    qdot_dof dof;
    bool conserved;

    coords(k, "x y phi");
    must(declare_body(k->scene, "skate", E(k, "m"), E(k, "I"), QDOT_NIL,
                         E(k, "(x, y)"), E(k, "phi"), QDOT_NIL));
    constraint(k, "blade", "x'*sin(phi) - y'*cos(phi)", "0");
    assert_int_equal(k->scene->constraints.at[0].kind, QDOT_VELOCITY);
    SAME(k, rhs(k, eom(k, "x")), "lambda[blade]*sin(phi)");
    SAME(k, rhs(k, eom(k, "y")), "-lambda[blade]*cos(phi)");
    SAME(k, rhs(k, eom(k, "phi")), "0");
    SAME(k, lhs(k, eom(k, "phi")), "I*phi''");
    must(qdot_mech_dof(k->scene, &dof));
    assert_int_equal(dof.freedom, 2);
    must(qdot_mech_energy_conserved(k->scene, &conserved));
    assert_true(conserved);
    SAME(k, qdot_mech_accel(k->scene, E(k, "x")),
         "-sin(phi)*phi'*(x'*cos(phi) + y'*sin(phi))");
}
TEST(knife_edge)

static void
acceleration_and_moving_constraints_body(kit *k)
{
    bool conserved;

    coords(k, "x y");
    function(k, "a", "t");
    particle(k, "p", "m", "(x, y)");
    constraint(k, "prog", "x''", "a(t)");
    constraint(k, "floor", "y", "b*sin(w*t)");
    assert_int_equal(k->scene->constraints.at[0].kind, QDOT_ACCELERATION);
    assert_int_equal(k->scene->constraints.at[1].kind, QDOT_HOLONOMIC);
    SAME(k, rhs(k, eom(k, "x")), "lambda[prog]");
    SAME(k, qdot_mech_constraint_derivative(k->scene, 1, 2), "y'' + b*w^2*sin(w*t)");
    SAME(k, qdot_mech_accel(k->scene, E(k, "x")), "a(t)");
    SAME(k, qdot_mech_accel(k->scene, E(k, "y")), "-b*w^2*sin(w*t)");
    must(qdot_mech_energy_conserved(k->scene, &conserved));
    assert_false(conserved);
}
TEST(acceleration_and_moving_constraints)

static void
rotating_hoop_keeps_the_jacobi_energy_body(kit *k)
{
    bool conserved;

    coords(k, "theta");
    particle(k, "bead", "m",
             "(a*sin(theta)*cos(W*t), a*sin(theta)*sin(W*t), -a*cos(theta))");
    gravity(k, "(0, 0, -g)");
    SAME(k, qdot_mech_kinetic(k->scene), "m*a^2/2*(theta'^2 + W^2*sin(theta)^2)");
    SAME(k, qdot_mech_energy(k->scene),
         "m*a^2/2*(theta'^2 - W^2*sin(theta)^2) - m*g*a*cos(theta)");
    must(qdot_mech_energy_conserved(k->scene, &conserved));
    assert_true(conserved);
    SAME(k, lhs(k, eom(k, "theta")), "m*a^2*(theta'' - W^2*sin(theta)*cos(theta))");
}
TEST(rotating_hoop_keeps_the_jacobi_energy)

static void
heavy_top_body(kit *k)
{
    qdot_cyclic *list;
    size_t n;
    qdot_expr R;

    coords(k, "phi theta psi");
    R = qdot_scene_euler(k->pool, E(k, "phi"), E(k, "theta"), E(k, "psi"));
    must(declare_body(
        k->scene, "top", E(k, "m"), E(k, "(A, A, C)"), QDOT_NIL,
        E(k, "(l*sin(theta)*sin(phi), -l*sin(theta)*cos(phi), l*cos(theta))"), QDOT_NIL,
        R));
    gravity(k, "(0, 0, -g)");
    SAME(k, qdot_mech_kinetic(k->scene),
         "1/2*(A + m*l^2)*(theta'^2 + sin(theta)^2*phi'^2)"
         " + C/2*(psi' + phi'*cos(theta))^2");
    SAME(k, qdot_mech_potential(k->scene), "m*g*l*cos(theta)");
    must(qdot_mech_cyclic(k->scene, &list, &n));
    assert_int_equal(n, 2);
    SAME(k, list[1].momentum, "C*(psi' + phi'*cos(theta))");
    qdot_free(list);
}
TEST(heavy_top)

static void
body_about_its_tip_is_the_same_body_body(kit *k)
{
    qdot_expr R;

    coords(k, "phi theta psi");
    R = qdot_scene_euler(k->pool, E(k, "phi"), E(k, "theta"), E(k, "psi"));
    must(declare_body(
        k->scene, "top", E(k, "m"), E(k, "(A + m*l^2, A + m*l^2, C)"), E(k, "(0, 0, -l)"),
        E(k, "(l*sin(theta)*sin(phi), -l*sin(theta)*cos(phi), l*cos(theta))"), QDOT_NIL,
        R));
    SAME(k, qdot_mech_kinetic(k->scene),
         "1/2*(A + m*l^2)*(theta'^2 + sin(theta)^2*phi'^2)"
         " + C/2*(psi' + phi'*cos(theta))^2");
}
TEST(body_about_its_tip_is_the_same_body)

/* T from second moments against 1/2 m v.v + 1/2 w.I w with w in body axes, I full. */
static void
spatial_body_has_the_textbooks_energy_body(kit *k)
{
    qdot_expr R, I, e[9], w, wb, T;
    static const char *names[9] = {"I1", "I4", "I5", "I4", "I2", "I6", "I5", "I6", "I3"};

    coords(k, "phi theta psi x y z");
    R = qdot_scene_euler(k->pool, E(k, "phi"), E(k, "theta"), E(k, "psi"));
    for (int i = 0; i < 9; i++)
        e[i] = E(k, "%s", names[i]);
    I = qdot_matrix(k->pool, 3, 3, e);
    must(declare_body(k->scene, "b", E(k, "m"), I, QDOT_NIL, E(k, "(x, y, z)"),
                         QDOT_NIL, R));
    w = qdot_scene_spin(k->scene, "b");
    wb = qdot_value_mul(k->pool, qdot_transpose(k->pool, R), w);
    T = qdot_mul(k->pool, QDOT_HALF,
                 qdot_dot(k->pool, wb, qdot_value_mul(k->pool, I, wb)));
    T = qdot_add(k->pool, T, E(k, "m/2*(x'^2 + y'^2 + z'^2)"));
    same_at(k, qdot_mech_kinetic(k->scene), T, __LINE__);
}
TEST(spatial_body_has_the_textbooks_energy)

static void
plane_body_and_its_points_body(kit *k)
{
    coords(k, "x y phi");
    must(declare_body(k->scene, "plate", E(k, "m"), E(k, "I"), QDOT_NIL,
                         E(k, "(x, y)"), E(k, "phi"), QDOT_NIL));
    SAME(k, qdot_mech_kinetic(k->scene), "m/2*(x'^2 + y'^2) + I/2*phi'^2");
    SAME(k, qdot_scene_spin(k->scene, "plate"), "phi'");
    for (int d = 0; d < 2; d++) {
        qdot_expr P = qdot_scene_point(k->scene, "plate", E(k, "(a, b)"));
        qdot_expr v = qdot_scene_velocity(k->scene, "plate", P);

        /* The material at a body-fixed point's place moves with that point. */
        same_at(k, qdot_expr_arg(k->pool, v, d),
                qdot_expr_arg(k->pool, qdot_ddt(k->pool, P), d), __LINE__);
    }
    must(qdot_scene_torque(k->scene, &(qdot_torque){.torque = E(k, "tau"), .body = 0}));
    SAME(k, Q(k, "phi"), "tau");
}
TEST(plane_body_and_its_points)

static void
torque_on_a_spatial_body_works_through_its_spin_body(kit *k)
{
    qdot_expr R, w, tau;

    coords(k, "phi theta psi");
    tau = E(k, "(t1, t2, t3)");
    R = qdot_scene_euler(k->pool, E(k, "phi"), E(k, "theta"), E(k, "psi"));
    must(declare_body(k->scene, "b", E(k, "m"), E(k, "(A, B, C)"), QDOT_NIL,
                         E(k, "(0, 0, 0)"), QDOT_NIL, R));
    must(qdot_scene_torque(k->scene, &(qdot_torque){.torque = tau, .body = 0}));
    w = qdot_scene_spin(k->scene, "b");
    for (int i = 0; i < 3; i++) {
        qdot_expr q = k->scene->coordinates.at[i];
        qdot_expr v = qdot_symbol_jet(k->pool, q, 1);

        same_at(k, qdot_mech_force(k->scene, q),
                qdot_dot(k->pool, tau, qdot_diff(k->pool, w, v)), i);
        same_at(k, qdot_mech_force_kane(k->scene, q), qdot_mech_force(k->scene, q), i);
    }
}
TEST(torque_on_a_spatial_body_works_through_its_spin)

/* F . d velocity(body, P) / dq', whatever P is, and not F . dP/dq. */
static void
force_on_material_works_through_its_velocity_body(kit *k)
{
    qdot_expr R, P, v, F;

    coords(k, "X Y phi theta psi");
    P = E(k, "(X + 2*theta, Y*X, 3/4)");
    F = E(k, "(F1, F2*X', F3)");
    R = qdot_scene_euler(k->pool, E(k, "phi"), E(k, "theta"), E(k, "psi"));
    must(declare_body(k->scene, "b", E(k, "m"), E(k, "(A, B, C)"), QDOT_NIL,
                         E(k, "(X, Y, a*sin(theta))"), QDOT_NIL, R));
    must(qdot_scene_force(k->scene, &(qdot_force){.force = F,
                                                  .point = P,
                                                  .on = (char *)"b",
                                                  .material = true}));
    v = qdot_scene_velocity(k->scene, "b", P);
    for (int i = 0; i < 5; i++) {
        qdot_expr q = k->scene->coordinates.at[i];
        qdot_expr w = qdot_symbol_jet(k->pool, q, 1);

        same_at(k, qdot_mech_force(k->scene, q), qdot_dot(k->pool, F, qdot_diff(k->pool, v, w)),
                i);
        same_at(k, qdot_mech_force_kane(k->scene, q), qdot_mech_force(k->scene, q), i);
    }
}
TEST(force_on_material_works_through_its_velocity)

static void
magnetic_potential_gives_lorentz_force_body(kit *k)
{
    bool conserved;

    coords(k, "x y");
    particle(k, "e", "m", "(x, y)");
    must(qdot_scene_potential(k->scene, E(k, "-c*B/2*(x*y' - y*x')")));
    SAME(k, rhs(k, eom(k, "x")), "c*B*y'");
    SAME(k, rhs(k, eom(k, "y")), "-c*B*x'");
    SAME(k, qdot_mech_momentum(k->scene, E(k, "x")), "m*x' - c*B*y/2");
    SAME(k, qdot_mech_energy(k->scene), "m/2*(x'^2 + y'^2)");
    must(qdot_mech_energy_conserved(k->scene, &conserved));
    assert_true(conserved);
}
TEST(magnetic_potential_gives_lorentz_force)

static void
stated_lagrangian_body(kit *k)
{
    coords(k, "x y");
    must(qdot_scene_lagrangian(k->scene,
                               E(k, "m*x'^2/2*(1 + y^2) + x'*y'*a - kk*x^2/2*t")));
    torque(k, "-c*x'", "x");
    SAME(k, lhs(k, eom(k, "x")), "m*x''*(1 + y^2) + 2*m*x'*y*y' + a*y'' + kk*x*t");
    SAME(k, rhs(k, eom(k, "x")), "-c*x'");
    SAME(k, qdot_mech_energy(k->scene), "m*x'^2/2*(1 + y^2) + x'*y'*a + kk*x^2/2*t");
    SAME(k, qdot_expr_arg(k->pool, qdot_mech_mass_matrix(k->scene), 1), "a");
    assert_int_equal(qdot_mech_kinetic(k->scene), QDOT_NIL);
    assert_int_equal(qdot_pool_check(k->pool), QDOT_EINVAL);
    assert_int_equal(qdot_scene_gravity(k->scene, E(k, "(0, -g)")), QDOT_EINVAL);
}
TEST(stated_lagrangian)

static void
masses_may_vary_body(kit *k)
{
    coords(k, "x");
    function(k, "mu", "t");
    particle(k, "rocket", "mu(t)", "x");
    gravity(k, "-g");
    SAME(k, lhs(k, eom(k, "x")), "mu(t)*x'' + diff(mu(t), t)*x'");
    SAME(k, rhs(k, eom(k, "x")), "-mu(t)*g");
}
TEST(masses_may_vary)

static void
springs_and_dampers_in_one_dimension_body(kit *k)
{
    qdot_link s = {.stiffness = E(k, "kk")}, d = {.stiffness = E(k, "c")};

    coords(k, "x1 x2");
    particle(k, "a", "m", "x1");
    particle(k, "b", "m", "x2");
    s.at[0] = d.at[0] = E(k, "x1");
    s.at[1] = d.at[1] = E(k, "x2");
    must(qdot_scene_spring(k->scene, &s));
    must(qdot_scene_damper(k->scene, &d));
    SAME(k, qdot_mech_potential(k->scene), "kk/2*(x1 - x2)^2");
    SAME(k, Q(k, "x1"), "-kk*(x1 - x2) - c*(x1' - x2')");
}
TEST(springs_and_dampers_in_one_dimension)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(line_elements_of_the_textbook),
        cmocka_unit_test(metric_of_a_place_and_of_a_line_element),
        cmocka_unit_test(bead_on_a_wire_by_arc_length),
        cmocka_unit_test(flexing_wire),
        cmocka_unit_test(pendulum_with_a_multiplier),
        cmocka_unit_test(pendulum_by_its_angle),
        cmocka_unit_test(double_pendulum_in_angles),
        cmocka_unit_test(double_pendulum_in_cartesian_coordinates),
        cmocka_unit_test(spherical_pendulum),
        cmocka_unit_test(cyclic_momentum_under_an_applied_torque_has_a_rate),
        cmocka_unit_test(kanes_form_is_virtual_work),
        cmocka_unit_test(knife_edge),
        cmocka_unit_test(acceleration_and_moving_constraints),
        cmocka_unit_test(rotating_hoop_keeps_the_jacobi_energy),
        cmocka_unit_test(heavy_top),
        cmocka_unit_test(body_about_its_tip_is_the_same_body),
        cmocka_unit_test(spatial_body_has_the_textbooks_energy),
        cmocka_unit_test(plane_body_and_its_points),
        cmocka_unit_test(torque_on_a_spatial_body_works_through_its_spin),
        cmocka_unit_test(force_on_material_works_through_its_velocity),
        cmocka_unit_test(magnetic_potential_gives_lorentz_force),
        cmocka_unit_test(stated_lagrangian),
        cmocka_unit_test(masses_may_vary),
        cmocka_unit_test(springs_and_dampers_in_one_dimension),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
