"""test_formula.py -- formulas in SymPy and compiled, against each other and against SymPy's own mechanics."""
import copy
import gc
import pickle
import unittest

import numpy
import qdot
from scenes import pendulum

try:
    import sympy
except ImportError:
    sympy = None

FORMULAS = """
    a*x^2 - b/x + 3/7
    sin(a*x)*cos(b*y) - tan(x)
    sec(x) + csc(x) + cot(x)
    asin(x/4) + acos(y/4) + atan(x*y) + atan2(y, x)
    sinh(x) + cosh(y) - tanh(x*y)
    asinh(x) + acosh(1 + y) + atanh(x/3)
    exp(-a*x) + log(y) + erf(x) + erfc(y)
    sqrt(x)*y^(1/3) + x^y
    abs(x - y) + sign(y - x) + floor(3*x) + mod(5*x, y)
    min(x, y)*max(x, a)
    if(x < y, x, y^2)
    if(x < y and y < 2, 1, if(x > 1 or y > 1, 2, 3))
    elliptic_K(x/2) + elliptic_E(x/2) + elliptic_E(y, x/2) + elliptic_F(y, x/2)
    elliptic_Pi(1/5, x/2)
    0.1*x + 1e-7*y + pi
""".strip().splitlines()


class Compiled(unittest.TestCase):
    def test_values_are_broadcast(self):
        f = pendulum().derive("T").lambdify("theta'", "l")
        self.assertEqual(f(1, 2), 2)
        self.assertEqual(f(numpy.ones((2, 1)), numpy.ones((1, 3))).shape, (2, 3))
        self.assertEqual(f([], 1).shape, (0,))
        speed = numpy.linspace(-1, 1, 100001)
        self.assertTrue(numpy.allclose(f(speed, 2), 2 * speed**2, rtol=1e-15))

    def test_components_come_in_front(self):
        s = qdot.System("coord x, y")
        for text, shape in ("[x, y, 1]", (3,)), ("(x, y)", (2,)), ("[x, y; 1, 2; 3, 4]", (3, 2)), ("x", ()):
            f = s.derive(text).lambdify("x", "y")
            self.assertEqual(f.shape, shape)
            self.assertEqual(f(1, 2).shape, shape)
            self.assertEqual(f([1, 2, 3, 4], 5).shape, (*shape, 4))
        self.assertEqual(s.derive("[x, y; 1, 2]").lambdify("x", "y")(3, 4).tolist(), [[3, 4], [1, 2]])

    def test_arguments_are_names_one_by_one(self):
        formula = qdot.System("coord x, y").derive("x*y")
        for arguments in ("x, y",), ("", "x", "y"), ("x", "y", "x"):
            with self.subTest(arguments=arguments), self.assertRaises(qdot.Error):
                formula.lambdify(*arguments)
        for argument in None, 3, 1.5, ["x", "y"]:
            with self.subTest(argument=argument), self.assertRaises(TypeError):
                formula.lambdify(argument, "y")

    def test_values_are_real_numbers(self):
        f = qdot.System("coord x").derive("2*x").lambdify("x")
        for value in 1j, "1", [1, None], numpy.array(None), numpy.array(["2020"], dtype="M8[D]"):
            with self.subTest(value=value), self.assertRaisesRegex(TypeError, "values of x are real numbers"):
                f(value)
        masked = numpy.ma.array([1.0, 2.0], mask=[False, True])
        self.assertEqual(numpy.isnan(f(masked)).tolist(), [False, True])
        for array in numpy.arange(6)[::-2], numpy.asfortranarray(numpy.ones((2, 3))), numpy.float32(3):
            self.assertTrue((f(array) == 2 * array).all())

    def test_formulas_may_be_nested_deeply(self):
        n = 3000
        formula = qdot.System("coord x").derive(n * "sin(" + "x" + n * ")")
        value = 1.0
        for _ in range(n):
            value = numpy.sin(value)
        self.assertAlmostEqual(formula.lambdify("x")(1.0), value, 12)
        for call in formula.tree, formula.sympy if sympy else formula.tree:
            with self.assertRaisesRegex(qdot.LimitError, "nested more deeply"):
                call()

    def test_copies_are_the_same_and_pickles_are_refused(self):
        s = qdot.System("coord x")
        formula = s.derive("2*x")
        f = formula.lambdify("x")
        self.assertIs(copy.deepcopy(formula), formula)
        with self.assertRaisesRegex(TypeError, "Formula cannot be pickled"):
            pickle.dumps(formula)
        with self.assertRaisesRegex(TypeError, "Function cannot be pickled"):
            pickle.dumps(f)
        copies = copy.copy(f), copy.deepcopy(f)
        del f
        gc.collect()
        s.number("1")  # what is to be freed is
        self.assertEqual([g(2) for g in copies], [4, 4])

    def test_an_argument_goes_before_a_value(self):
        s = qdot.System("param a = 3; coord x")
        formula = s.derive("a*x")
        self.assertEqual(formula.lambdify("x")(2), 6)
        self.assertEqual(formula.lambdify("x", "a")(2, 5), 10)
        f = formula.lambdify("x")
        s.set(a=7)
        self.assertEqual(f(2), 6)
        del s
        gc.collect()
        self.assertEqual(f(2), 6)

    def test_what_is_undefined_is_nan(self):
        f = qdot.System("coord x").derive("sqrt(x)").lambdify("x")
        self.assertTrue(numpy.isnan(f(-1)))

    def test_what_cannot_be_compiled_is_an_error(self):
        s = pendulum()
        with self.assertRaises(qdot.UnsetError):
            s.derive("T").lambdify("l")
        with self.assertRaises(qdot.KindError):
            s.derive("eom").lambdify("theta")
        with self.assertRaisesRegex(TypeError, "2, not 1"):
            s.derive("T").lambdify("theta'", "l")(1)

    def test_accelerations_are_functions_of_the_state(self):
        f = pendulum().derive("accel[theta]").lambdify("theta")
        self.assertAlmostEqual(f(1), -9.81 * numpy.sin(1), 14)


@unittest.skipUnless(sympy, "no SymPy")
class SymPy(unittest.TestCase):
    def test_formulas_have_the_values_of_what_is_compiled(self):
        s = qdot.System("param a = 1/3, b = 0.7; coord x, y > 0")
        x, y = (sympy.Function(name)(sympy.Symbol("t")) for name in ("x", "y"))
        a, b = sympy.symbols("a b")
        random = numpy.random.default_rng(1)
        for text in FORMULAS:
            formula = s.derive(text)
            there = formula.sympy()
            f = formula.lambdify("x", "y")
            for px, py in random.uniform(0.3, 1.9, (5, 2)):
                at = {x: px, y: py, a: sympy.Rational(1, 3), b: sympy.Rational(7, 10)}
                value = complex(there.subs(at).evalf(20))
                self.assertAlmostEqual(value.imag, 0, 12)
                self.assertLess(abs(f(px, py) - value.real), 1e-12 * max(1, abs(value)), (text, px, py))

    def test_equations_of_motion_are_those_of_sympy(self):
        s = qdot.System("""
            param m1, m2, L1, L2, g > 0
            coord theta1, theta2
            r1 = (L1*sin(theta1), -L1*cos(theta1))
            r2 = r1 + (L2*sin(theta2), -L2*cos(theta2))
            particle a mass m1 at r1
            particle b mass m2 at r2
            gravity (0, -g)""")
        from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols

        q = dynamicsymbols("theta1 theta2")
        lagrangian = s.derive("L").sympy()
        theirs = LagrangesMethod(lagrangian, q).form_lagranges_equations()
        accelerations = [c.diff(dynamicsymbols._t, 2) for c in q]
        for equation, their in zip(s.derive("eom").sympy(), theirs):
            self.assertIsInstance(equation, sympy.Eq)
            ours = equation.lhs - equation.rhs
            factor = [sympy.simplify(ours.coeff(x) or ours.expand().coeff(x)) for x in accelerations]
            self.assertTrue(any(factor))
            self.assertEqual(sympy.simplify(ours - their), 0)

    def test_shapes(self):
        s = qdot.System("param m; coord x, y; function W(x), F(t)")
        t = sympy.Symbol("t")
        x, y = (sympy.Function(name)(t) for name in "xy")
        m = sympy.Symbol("m")
        for text, expected in (
            ("0.1", sympy.Rational(1, 10)),
            ("[x, m]", [x, m]),
            ("(x, y)", sympy.Matrix([x, y])),
            ("[x, y; 1, m]", sympy.Matrix([[x, y], [1, m]])),
            ("x'' - m", x.diff(t, 2) - m),
            ("x < 3", x < 3),
            ("if(x > 0, x, -x)", sympy.Piecewise((x, x > 0), (-x, True))),
            ("F(t)", sympy.Function("F")(t)),
            ("diff(W(x), x)", sympy.Derivative(sympy.Function("W")(x), x)),
            ("dx", sympy.Symbol("dx")),
            ("t^2", t**2),
        ):
            self.assertEqual(s.derive(text).sympy(), expected, text)

    def test_an_integral_that_is_not_elementary(self):
        s = qdot.System("param a")
        there = s.derive("integral(exp(-x^3), x, 0, a)").sympy().subs("a", 1)
        self.assertAlmostEqual(there.evalf(), 0.807511182139672, 12)

    def test_a_slope_at_a_place_is_that(self):
        s = qdot.System("coord x; function W(x)")
        slope = s.derive("diff(W(x), x)").sympy()
        there = s.derive("W'(2*x)").sympy()
        u = sympy.Symbol("u")
        W = sympy.Function("W")
        x = sympy.Function("x")(sympy.Symbol("t"))
        self.assertEqual(slope.subs(W(x), x**3).doit(), 3 * x**2)
        self.assertEqual(there.replace(W, sympy.Lambda(u, u**3)).doit(), 12 * x**2)

    def test_names_may_stand_for_symbols_of_ones_own(self):
        m = sympy.Symbol("m", positive=True)
        s = qdot.System("param m; coord x; particle p mass m at (x, 0)")
        self.assertIn(m, s.derive("T").sympy({"m": m}).free_symbols)

    def test_arguments_may_be_sympys(self):
        s = pendulum()
        t = sympy.Symbol("t")
        theta = sympy.Function("theta")(t)
        f = s.derive("T + V").lambdify(theta, theta.diff(t), sympy.Symbol("m"))
        self.assertAlmostEqual(f(1, 2, 3), 3 * 2 - 3 * 9.81 * numpy.cos(1), 12)

    def test_values_and_names_may_be_sympys(self):
        s = qdot.System("param a; coord x; particle p mass 1 at (x, 0)")
        t = sympy.Symbol("t")
        x = sympy.Function("x")(t)
        s.set({sympy.Symbol("a"): sympy.E**2 / 3 + sympy.sqrt(2)})
        s.start({x: sympy.pi, x.diff(t): sympy.Integer(4)})
        self.assertAlmostEqual(s.number("a"), numpy.e**2 / 3 + numpy.sqrt(2), 14)
        self.assertEqual(s.run("0..1").values(["x", "x'"], 0).tolist(), [numpy.pi, 4])
        for value in sympy.oo, sympy.I, sympy.nan, sympy.zoo:
            with self.subTest(value=value), self.assertRaises(qdot.InvalidError):
                s.set(a=value)

    def test_integers_of_any_length(self):
        self.assertEqual(qdot.System().derive("10^5000 + 1").sympy(), sympy.Integer(10) ** 5000 + 1)

    def test_parameters_of_another_system_do_not_move(self):
        one = qdot.System("coord x").derive("x")
        self.assertEqual(one.sympy(), sympy.Function("x")(sympy.Symbol("t")))
        self.assertEqual(qdot.System("param x").derive("x").sympy(), sympy.Symbol("x"))


if __name__ == "__main__":
    unittest.main()
