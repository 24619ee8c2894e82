# sources.mk -- which files make qdot. Written by ./bootstrap sources; do not edit.

base_sources = \
	lib/base/interrupt.c \
	lib/base/memory.c \
	lib/base/status.c \
	lib/base/text.c \
	lib/base/utf8.c

base_headers = \
	lib/base/interrupt.h \
	lib/base/memory.h \
	lib/base/status.h \
	lib/base/text.h \
	lib/base/utf8.h

num_sources = \
	lib/num/cholesky.c \
	lib/num/ldlt.c \
	lib/num/row-space.c \
	lib/num/saddle.c \
	lib/num/series.c \
	lib/num/structure.c \
	lib/num/sum.c

num_headers = \
	lib/num/cholesky.h \
	lib/num/ldlt.h \
	lib/num/row-space.h \
	lib/num/saddle.h \
	lib/num/series.def \
	lib/num/series.h \
	lib/num/structure.h \
	lib/num/sum.h

expr_sources = \
	lib/expr/calculus.c \
	lib/expr/construct.c \
	lib/expr/expand.c \
	lib/expr/function.c \
	lib/expr/order.c \
	lib/expr/pool.c \
	lib/expr/print-name.c \
	lib/expr/print.c \
	lib/expr/printed.c \
	lib/expr/product.c \
	lib/expr/root.c \
	lib/expr/scale.c \
	lib/expr/size.c \
	lib/expr/sum.c \
	lib/expr/tensor.c \
	lib/expr/ufun.c \
	lib/expr/walk.c

expr_headers = \
	lib/expr/calculus.h \
	lib/expr/expr.h \
	lib/expr/function.def \
	lib/expr/pool.h \
	lib/expr/print-name.h \
	lib/expr/print.h \
	lib/expr/printed.h \
	lib/expr/tensor.h \
	lib/expr/walk.h

ode_sources = \
	lib/ode/companion.c \
	lib/ode/dop853.c \
	lib/ode/integrate.c \
	lib/ode/method.c \
	lib/ode/stepper.c \
	lib/ode/taylor.c \
	lib/ode/trajectory.c

ode_headers = \
	lib/ode/companion.h \
	lib/ode/dop853.def \
	lib/ode/dop853.h \
	lib/ode/integrate.h \
	lib/ode/method.h \
	lib/ode/stepper.h \
	lib/ode/system.h \
	lib/ode/taylor.h \
	lib/ode/trajectory.h

normal_sources = \
	lib/normal/ball.c \
	lib/normal/collect.c \
	lib/normal/constant.c \
	lib/normal/decide.c \
	lib/normal/domain.c \
	lib/normal/factor.c \
	lib/normal/field.c \
	lib/normal/form.c \
	lib/normal/ideal.c \
	lib/normal/items.c \
	lib/normal/lattice.c \
	lib/normal/less.c \
	lib/normal/linear.c \
	lib/normal/logarithm.c \
	lib/normal/map.c \
	lib/normal/null-space.c \
	lib/normal/positive.c \
	lib/normal/prepare.c \
	lib/normal/proportion.c \
	lib/normal/prove.c \
	lib/normal/range.c \
	lib/normal/ratio.c \
	lib/normal/rationalize.c \
	lib/normal/rewrite.c \
	lib/normal/sample.c \
	lib/normal/simplify.c \
	lib/normal/solve-factors.c \
	lib/normal/solve.c \
	lib/normal/split.c \
	lib/normal/squares.c \
	lib/normal/trig-form.c \
	lib/normal/unify.c \
	lib/normal/value.c \
	lib/normal/zero.c

normal_headers = \
	lib/normal/ball.h \
	lib/normal/constant.h \
	lib/normal/decide.h \
	lib/normal/domain.h \
	lib/normal/factor.h \
	lib/normal/field.h \
	lib/normal/form.h \
	lib/normal/ideal.h \
	lib/normal/items.h \
	lib/normal/lattice.h \
	lib/normal/map.h \
	lib/normal/null-space.h \
	lib/normal/positive.h \
	lib/normal/prepare.h \
	lib/normal/prove.h \
	lib/normal/rationalize.h \
	lib/normal/rewrite.h \
	lib/normal/sample.h \
	lib/normal/simplify.h \
	lib/normal/solve.h \
	lib/normal/split.h \
	lib/normal/unify.h \
	lib/normal/value.h \
	lib/normal/zero.h

tape_sources = \
	lib/tape/angle.c \
	lib/tape/code.c \
	lib/tape/constant.c \
	lib/tape/finish.c \
	lib/tape/keymap.c \
	lib/tape/lower.c \
	lib/tape/tape.c \
	lib/tape/taylor-order.c \
	lib/tape/taylor.c

tape_headers = \
	lib/tape/angle.h \
	lib/tape/code.h \
	lib/tape/constant.h \
	lib/tape/keymap.h \
	lib/tape/operation.def \
	lib/tape/shake.h \
	lib/tape/tape.h \
	lib/tape/taylor-steps.h \
	lib/tape/taylor.h

mech_sources = \
	lib/mech/accel.c \
	lib/mech/alike.c \
	lib/mech/body.c \
	lib/mech/constraint.c \
	lib/mech/dalembert.c \
	lib/mech/derived.c \
	lib/mech/energy.c \
	lib/mech/equilibrium-numeric.c \
	lib/mech/equilibrium.c \
	lib/mech/freedom.c \
	lib/mech/generic.c \
	lib/mech/geometry.c \
	lib/mech/hamilton.c \
	lib/mech/kinematics.c \
	lib/mech/label.c \
	lib/mech/lagrange.c \
	lib/mech/mass-matrix.c \
	lib/mech/metric.c \
	lib/mech/modes.c \
	lib/mech/momentum.c \
	lib/mech/nested.c \
	lib/mech/noether.c \
	lib/mech/numeric.c \
	lib/mech/recursive.c \
	lib/mech/scene-print.c \
	lib/mech/scene-replace.c \
	lib/mech/scene.c \
	lib/mech/stability.c \
	lib/mech/virtual-work.c

mech_headers = \
	lib/mech/dalembert.h \
	lib/mech/derived.h \
	lib/mech/equilibrium.h \
	lib/mech/geometry.h \
	lib/mech/hamilton.h \
	lib/mech/noether.h \
	lib/mech/quantity.h \
	lib/mech/scene.h

sim_sources = \
	lib/sim/bind.c \
	lib/sim/blocks.c \
	lib/sim/bonds.c \
	lib/sim/constraints.c \
	lib/sim/describe.c \
	lib/sim/direct.c \
	lib/sim/domain.c \
	lib/sim/drift.c \
	lib/sim/held.c \
	lib/sim/nearest-search.c \
	lib/sim/nearest.c \
	lib/sim/plan.c \
	lib/sim/residual.c \
	lib/sim/run.c \
	lib/sim/shifted.c \
	lib/sim/start.c \
	lib/sim/substitute.c \
	lib/sim/tied.c \
	lib/sim/value.c

sim_headers = \
	lib/sim/bind.h \
	lib/sim/blocks.h \
	lib/sim/bonds.h \
	lib/sim/constraints.h \
	lib/sim/direct.h \
	lib/sim/domain.h \
	lib/sim/drift.h \
	lib/sim/held.h \
	lib/sim/integrated.h \
	lib/sim/nearest.h \
	lib/sim/plan.h \
	lib/sim/residual.h \
	lib/sim/run.h \
	lib/sim/shifted.h \
	lib/sim/start.h \
	lib/sim/substitute.h \
	lib/sim/tied.h

show_sources = \
	lib/show/csv.c \
	lib/show/figure.c \
	lib/show/gnuplot.c \
	lib/show/sink.c \
	lib/show/table.c

show_headers = \
	lib/show/gnuplot.h \
	lib/show/show.h \
	lib/show/sink.h

lang_sources = \
	lib/lang/algebra.c \
	lib/lang/answer.c \
	lib/lang/ask.c \
	lib/lang/bind.c \
	lib/lang/builtin.c \
	lib/lang/carry.c \
	lib/lang/check.c \
	lib/lang/cursor.c \
	lib/lang/declare-function.c \
	lib/lang/declare.c \
	lib/lang/derive.c \
	lib/lang/draw.c \
	lib/lang/equilibria.c \
	lib/lang/evaluate.c \
	lib/lang/furnish.c \
	lib/lang/help.c \
	lib/lang/hints.c \
	lib/lang/letters.c \
	lib/lang/lex.c \
	lib/lang/loop.c \
	lib/lang/names.c \
	lib/lang/number.c \
	lib/lang/parse.c \
	lib/lang/plot.c \
	lib/lang/quantities.c \
	lib/lang/read.c \
	lib/lang/redirect.c \
	lib/lang/report.c \
	lib/lang/resolve.c \
	lib/lang/session.c \
	lib/lang/source.c \
	lib/lang/start.c \
	lib/lang/statement.c \
	lib/lang/words.c \
	lib/lang/workbench.c

lang_headers = \
	lib/lang/algebra.h \
	lib/lang/answer.h \
	lib/lang/ask.h \
	lib/lang/carry.h \
	lib/lang/code.h \
	lib/lang/declare.h \
	lib/lang/draw.h \
	lib/lang/equilibria.h \
	lib/lang/names.h \
	lib/lang/number.h \
	lib/lang/read.h \
	lib/lang/redirect.h \
	lib/lang/session.h \
	lib/lang/statement.h

program_sources = \
	src/main.c \
	src/prompt.c \
	src/prompt.h \
	src/signals.c \
	src/signals.h

unit_tests = \
	tests/base/test_memory \
	tests/base/test_text \
	tests/base/test_utf8 \
	tests/expr/test_calculus \
	tests/expr/test_expand \
	tests/expr/test_function \
	tests/expr/test_order \
	tests/expr/test_pool \
	tests/expr/test_print \
	tests/expr/test_product \
	tests/expr/test_sum \
	tests/expr/test_tensor \
	tests/expr/test_walk \
	tests/lang/test_evaluate \
	tests/lang/test_lex \
	tests/lang/test_names \
	tests/lang/test_read \
	tests/lang/test_session \
	tests/mech/test_equilibrium \
	tests/mech/test_geometry \
	tests/mech/test_hamilton \
	tests/mech/test_noether \
	tests/mech/test_numeric \
	tests/mech/test_scene \
	tests/mech/test_scenes \
	tests/normal/test_decide \
	tests/normal/test_simplify \
	tests/normal/test_solve \
	tests/normal/test_verdicts \
	tests/num/test_cholesky \
	tests/num/test_ldlt \
	tests/num/test_row-space \
	tests/num/test_saddle \
	tests/num/test_series \
	tests/num/test_structure \
	tests/num/test_sum \
	tests/ode/test_companion \
	tests/ode/test_dop853 \
	tests/ode/test_integrate \
	tests/ode/test_method \
	tests/ode/test_taylor \
	tests/ode/test_trajectory \
	tests/show/test_csv \
	tests/show/test_figure \
	tests/show/test_table \
	tests/sim/test_constraints \
	tests/sim/test_equations \
	tests/sim/test_operations \
	tests/sim/test_run \
	tests/sim/test_start \
	tests/sim/test_taylor \
	tests/src/test_options \
	tests/src/test_prompt \
	tests/tape/test_constant \
	tests/tape/test_tape \
	tests/tape/test_taylor

script_tests = \
	tests/script/check.lag \
	tests/script/conserved.lag \
	tests/script/declarations.lag \
	tests/script/definitions.lag \
	tests/script/derive.lag \
	tests/script/equilibria.lag \
	tests/script/fall.sh \
	tests/script/flexing.lag \
	tests/script/geometry.lag \
	tests/script/hamilton.lag \
	tests/script/help.lag \
	tests/script/identities.sh \
	tests/script/include.lag \
	tests/script/json.lag \
	tests/script/loops.lag \
	tests/script/names.lag \
	tests/script/order.lag \
	tests/script/pendulum.lag \
	tests/script/refuted.lag \
	tests/script/reset.lag \
	tests/script/run.sh \
	tests/script/several.sh \
	tests/script/solve.lag \
	tests/script/styles.lag \
	tests/script/text.lag \
	tests/script/to-file.sh \
	tests/script/values.lag \
	tests/bad/acceleration-position.lag \
	tests/bad/as-number.lag \
	tests/bad/bad-method.lag \
	tests/bad/bad-tolerance.lag \
	tests/bad/bare-power.lag \
	tests/bad/big-d.lag \
	tests/bad/binary.lag \
	tests/bad/block-without-for.lag \
	tests/bad/bound-coordinate.lag \
	tests/bad/christoffel-index.lag \
	tests/bad/compare-run.lag \
	tests/bad/curvature-none.lag \
	tests/bad/define-coordinate.lag \
	tests/bad/defined-by-itself.lag \
	tests/bad/dimensions.lag \
	tests/bad/division-symbolic.lag \
	tests/bad/division.lag \
	tests/bad/double-operator.lag \
	tests/bad/eigenvalues-complex.lag \
	tests/bad/empty-brackets.lag \
	tests/bad/entry-range.lag \
	tests/bad/equilibria-time.lag \
	tests/bad/equilibria-unset.lag \
	tests/bad/family-and-vector.lag \
	tests/bad/foreign-function.lag \
	tests/bad/foreign-index.lag \
	tests/bad/function-by-itself.lag \
	tests/bad/generated.sh \
	tests/bad/gravity-dimension.lag \
	tests/bad/hamiltonian-singular.lag \
	tests/bad/help-unknown.lag \
	tests/bad/history.lag \
	tests/bad/huge-decimal.lag \
	tests/bad/huge-power.lag \
	tests/bad/include-error.lag \
	tests/bad/include-itself.lag \
	tests/bad/include-missing.lag \
	tests/bad/interrupt.sh \
	tests/bad/lagrangian-beside.lag \
	tests/bad/laplacian-oblique.lag \
	tests/bad/log-zero.lag \
	tests/bad/lone-point.lag \
	tests/bad/loop-half.lag \
	tests/bad/loop-limit.lag \
	tests/bad/mathematica.lag \
	tests/bad/mismatched.lag \
	tests/bad/missing-option.lag \
	tests/bad/missing-times.lag \
	tests/bad/misspelled-option.lag \
	tests/bad/misspelled-word.lag \
	tests/bad/modes-at.lag \
	tests/bad/modes-damped.lag \
	tests/bad/modes-unstable.lag \
	tests/bad/momentum-index.lag \
	tests/bad/newton-dot.lag \
	tests/bad/no-coordinate.lag \
	tests/bad/no-run.lag \
	tests/bad/not-built-option.lag \
	tests/bad/not-built.lag \
	tests/bad/not-utf8.lag \
	tests/bad/number-times.lag \
	tests/bad/operator-end.lag \
	tests/bad/outside-run.lag \
	tests/bad/pi-redefined.lag \
	tests/bad/picture-kind.lag \
	tests/bad/prime-of-product.lag \
	tests/bad/redeclared-coordinate.lag \
	tests/bad/redeclared-parameter.lag \
	tests/bad/reserved.lag \
	tests/bad/reset-in-loop.lag \
	tests/bad/same-label.lag \
	tests/bad/second-decimal.lag \
	tests/bad/semicolon-list.lag \
	tests/bad/set-circle.lag \
	tests/bad/set-coordinate.lag \
	tests/bad/set-domain.lag \
	tests/bad/show-unknown.lag \
	tests/bad/singular-mass.lag \
	tests/bad/solve-beyond.lag \
	tests/bad/solve-for-sum.lag \
	tests/bad/start-domain.lag \
	tests/bad/start-parameter.lag \
	tests/bad/string-number.lag \
	tests/bad/to-ending.lag \
	tests/bad/too-long.lag \
	tests/bad/trailing.lag \
	tests/bad/unclosed.lag \
	tests/bad/unfinished-string.lag \
	tests/bad/unknown-function.lag \
	tests/bad/unknown-label.lag \
	tests/bad/unknown-name.lag \
	tests/bad/unset.lag \
	tests/bad/vector-mass.lag \
	tests/bad/vector-vs-scalar-check.lag \
	tests/bad/write-nowhere.lag \
	tests/bad/wrong-arguments.lag \
	examples/acceleration-constraint.lag \
	examples/bead-on-wire.lag \
	examples/chain.lag \
	examples/conserved.lag \
	examples/curvature.lag \
	examples/cylindrical.lag \
	examples/damped-oscillator.lag \
	examples/degrees-of-freedom.lag \
	examples/double-pendulum-cartesian.lag \
	examples/double-pendulum.lag \
	examples/elastic-pendulum.lag \
	examples/equilibria.lag \
	examples/flexing-wire.lag \
	examples/foucault.lag \
	examples/generalized-momenta.lag \
	examples/geometry.lag \
	examples/hamiltonian.lag \
	examples/heavy-top.lag \
	examples/kepler.lag \
	examples/kinetic-energy.lag \
	examples/knife-edge.lag \
	examples/line-element.lag \
	examples/magnetic-field.lag \
	examples/metrics.lag \
	examples/modes.lag \
	examples/moving-constraint.lag \
	examples/pendulum-cartesian.lag \
	examples/pendulum.lag \
	examples/polar.lag \
	examples/rolling-wheel.lag \
	examples/rotating-hoop.lag \
	examples/routh.lag \
	examples/spherical-pendulum.lag \
	examples/spherical.lag \
	examples/stated-lagrangian.lag \
	examples/static-equilibrium.lag \
	examples/swinging-atwood.lag \
	examples/vector-operators.lag \
	examples/velocity.lag \
	examples/virtual-work.lag

meta_tests = \
	tests/meta/floors.test \
	tests/meta/manual.test \
	tests/meta/paths.test \
	tests/meta/sources.test \
	tests/meta/symbols.test

test_files = \
	tests/bad/acceleration-position.out \
	tests/bad/as-number.out \
	tests/bad/bad-method.out \
	tests/bad/bad-tolerance.out \
	tests/bad/bare-power.out \
	tests/bad/big-d.out \
	tests/bad/binary.out \
	tests/bad/block-without-for.out \
	tests/bad/bound-coordinate.out \
	tests/bad/christoffel-index.out \
	tests/bad/compare-run.out \
	tests/bad/curvature-none.out \
	tests/bad/define-coordinate.out \
	tests/bad/defined-by-itself.out \
	tests/bad/dimensions.out \
	tests/bad/division-symbolic.out \
	tests/bad/division.out \
	tests/bad/double-operator.out \
	tests/bad/eigenvalues-complex.out \
	tests/bad/empty-brackets.out \
	tests/bad/entry-range.out \
	tests/bad/equilibria-time.out \
	tests/bad/equilibria-unset.out \
	tests/bad/family-and-vector.out \
	tests/bad/foreign-function.out \
	tests/bad/foreign-index.out \
	tests/bad/function-by-itself.out \
	tests/bad/generated.out \
	tests/bad/gravity-dimension.out \
	tests/bad/hamiltonian-singular.out \
	tests/bad/help-unknown.out \
	tests/bad/history.out \
	tests/bad/huge-decimal.out \
	tests/bad/huge-power.out \
	tests/bad/include-error.out \
	tests/bad/include-itself.out \
	tests/bad/include-missing.out \
	tests/bad/interrupt.out \
	tests/bad/lagrangian-beside.out \
	tests/bad/laplacian-oblique.out \
	tests/bad/log-zero.out \
	tests/bad/lone-point.out \
	tests/bad/loop-half.out \
	tests/bad/loop-limit.out \
	tests/bad/mathematica.out \
	tests/bad/mismatched.out \
	tests/bad/missing-option.out \
	tests/bad/missing-times.out \
	tests/bad/misspelled-option.out \
	tests/bad/misspelled-word.out \
	tests/bad/modes-at.out \
	tests/bad/modes-damped.out \
	tests/bad/modes-unstable.out \
	tests/bad/momentum-index.out \
	tests/bad/newton-dot.out \
	tests/bad/no-coordinate.out \
	tests/bad/no-run.out \
	tests/bad/not-built-option.out \
	tests/bad/not-built.out \
	tests/bad/not-utf8.out \
	tests/bad/number-times.out \
	tests/bad/operator-end.out \
	tests/bad/outside-run.out \
	tests/bad/pi-redefined.out \
	tests/bad/picture-kind.out \
	tests/bad/prime-of-product.out \
	tests/bad/redeclared-coordinate.out \
	tests/bad/redeclared-parameter.out \
	tests/bad/reserved.out \
	tests/bad/reset-in-loop.out \
	tests/bad/same-label.out \
	tests/bad/second-decimal.out \
	tests/bad/semicolon-list.out \
	tests/bad/set-circle.out \
	tests/bad/set-coordinate.out \
	tests/bad/set-domain.out \
	tests/bad/show-unknown.out \
	tests/bad/singular-mass.out \
	tests/bad/solve-beyond.out \
	tests/bad/solve-for-sum.out \
	tests/bad/start-domain.out \
	tests/bad/start-parameter.out \
	tests/bad/string-number.out \
	tests/bad/to-ending.out \
	tests/bad/too-long.out \
	tests/bad/trailing.out \
	tests/bad/unclosed.out \
	tests/bad/unfinished-string.out \
	tests/bad/unknown-function.out \
	tests/bad/unknown-label.out \
	tests/bad/unknown-name.out \
	tests/bad/unset.out \
	tests/bad/vector-mass.out \
	tests/bad/vector-vs-scalar-check.out \
	tests/bad/write-nowhere.out \
	tests/bad/wrong-arguments.out \
	tests/examples/acceleration-constraint.out \
	tests/examples/bead-on-wire.out \
	tests/examples/chain.out \
	tests/examples/conserved.out \
	tests/examples/curvature.out \
	tests/examples/cylindrical.out \
	tests/examples/damped-oscillator.out \
	tests/examples/degrees-of-freedom.out \
	tests/examples/double-pendulum-cartesian.out \
	tests/examples/double-pendulum.out \
	tests/examples/elastic-pendulum.out \
	tests/examples/equilibria.out \
	tests/examples/flexing-wire.out \
	tests/examples/foucault.out \
	tests/examples/generalized-momenta.out \
	tests/examples/geometry.out \
	tests/examples/hamiltonian.out \
	tests/examples/heavy-top.out \
	tests/examples/kepler.out \
	tests/examples/kinetic-energy.out \
	tests/examples/knife-edge.out \
	tests/examples/line-element.out \
	tests/examples/magnetic-field.out \
	tests/examples/metrics.out \
	tests/examples/modes.out \
	tests/examples/moving-constraint.out \
	tests/examples/pendulum-cartesian.out \
	tests/examples/pendulum.out \
	tests/examples/polar.out \
	tests/examples/rolling-wheel.out \
	tests/examples/rotating-hoop.out \
	tests/examples/routh.out \
	tests/examples/spherical-pendulum.out \
	tests/examples/spherical.out \
	tests/examples/stated-lagrangian.out \
	tests/examples/static-equilibrium.out \
	tests/examples/swinging-atwood.out \
	tests/examples/vector-operators.out \
	tests/examples/velocity.out \
	tests/examples/virtual-work.out \
	tests/expr/reader.h \
	tests/expr/spec.h \
	tests/fuzz/corpus/parse/algebra.txt \
	tests/fuzz/corpus/parse/double-pendulum.txt \
	tests/fuzz/corpus/parse/flexing-wire.txt \
	tests/fuzz/corpus/parse/heavy-top.txt \
	tests/fuzz/corpus/parse/knife-edge.txt \
	tests/fuzz/corpus/parse/line-element.txt \
	tests/fuzz/corpus/parse/magnetic-field.txt \
	tests/fuzz/corpus/parse/mixed.txt \
	tests/fuzz/corpus/parse/pendulum.txt \
	tests/fuzz/corpus/parse/rotating-hoop.txt \
	tests/fuzz/corpus/parse/run.txt \
	tests/fuzz/corpus/parse/spherical.txt \
	tests/fuzz/corpus/parse/stated-lagrangian.txt \
	tests/fuzz/corpus/parse/swinging-atwood.txt \
	tests/fuzz/corpus/parse/virtual-work.txt \
	tests/fuzz/corpus/roundtrip/e01.txt \
	tests/fuzz/corpus/roundtrip/e02.txt \
	tests/fuzz/corpus/roundtrip/e03.txt \
	tests/fuzz/corpus/roundtrip/e04.txt \
	tests/fuzz/corpus/roundtrip/e05.txt \
	tests/fuzz/corpus/roundtrip/e06.txt \
	tests/fuzz/corpus/roundtrip/e07.txt \
	tests/fuzz/corpus/roundtrip/e08.txt \
	tests/fuzz/corpus/roundtrip/e09.txt \
	tests/fuzz/corpus/roundtrip/e10.txt \
	tests/fuzz/corpus/roundtrip/e11.txt \
	tests/fuzz/corpus/roundtrip/e12.txt \
	tests/fuzz/corpus/roundtrip/e13.txt \
	tests/fuzz/corpus/roundtrip/e14.txt \
	tests/fuzz/corpus/roundtrip/e15.txt \
	tests/fuzz/corpus/roundtrip/e16.txt \
	tests/fuzz/corpus/roundtrip/e17.txt \
	tests/fuzz/corpus/roundtrip/e18.txt \
	tests/fuzz/corpus/roundtrip/e19.txt \
	tests/fuzz/corpus/roundtrip/e20.txt \
	tests/fuzz/corpus/roundtrip/huge-number.txt \
	tests/fuzz/corpus/roundtrip/offset-roots.txt \
	tests/fuzz/fuzz.h \
	tests/lang/reading.h \
	tests/mech/kit.h \
	tests/normal/number.h \
	tests/normal/pairs.h \
	tests/normal/text.h \
	tests/ode/problems.h \
	tests/script/check.out \
	tests/script/conserved.out \
	tests/script/declarations.out \
	tests/script/definitions.out \
	tests/script/derive.out \
	tests/script/equilibria.out \
	tests/script/fall.out \
	tests/script/flexing.out \
	tests/script/geometry.out \
	tests/script/hamilton.out \
	tests/script/help.out \
	tests/script/identities-angles.inc \
	tests/script/identities-exp.inc \
	tests/script/identities-facts.inc \
	tests/script/identities-mechanics.inc \
	tests/script/identities-near.inc \
	tests/script/identities-open.inc \
	tests/script/identities-roots.inc \
	tests/script/identities-traps.inc \
	tests/script/identities.out \
	tests/script/include.out \
	tests/script/included.inc \
	tests/script/json.out \
	tests/script/loops.out \
	tests/script/names.out \
	tests/script/normalise.sed \
	tests/script/order.out \
	tests/script/pendulum.out \
	tests/script/refuted.out \
	tests/script/reset.out \
	tests/script/run.out \
	tests/script/several.out \
	tests/script/solve.out \
	tests/script/styles.out \
	tests/script/text.out \
	tests/script/to-file.out \
	tests/script/values.out \
	tests/sim/scenes.h \
	tests/tape/reference.h \
	tests/fuzz/fuzz-parse.c \
	tests/fuzz/fuzz-roundtrip.c \
	tests/fuzz/packages \
	tests/fuzz/run \
	tests/fuzz/words.dict

other_files = \
	bench/chain-equations.lag \
	bench/chain-run.lag \
	bench/chain-step.lag \
	bench/chain_sympy.py \
	bench/double-pendulum.lag \
	bench/double-run.lag \
	bench/numeric \
	bench/packages \
	bench/peers/dop853.hh \
	bench/peers/names.hh \
	bench/peers/peers.cc \
	bench/peers/reference \
	bench/peers/reference.cc \
	bench/peers/scene/chain.lag \
	bench/peers/scene/double.lag \
	bench/peers/scene/kepler_polar.lag \
	bench/peers/scene/pendulum.lag \
	bench/peers/scene/spherical_pole.lag \
	bench/peers/scene/stiff_spring.lag \
	bench/peers/scenes.hh \
	bench/peers/scipy_dop853.py \
	bench/peers/table.awk \
	bench/pendulum-run.lag \
	bench/run \
	bench/symbolic/ginac-peer.cc \
	bench/symbolic/identities \
	bench/symbolic/maxima-peer.mac \
	bench/symbolic/run \
	bench/symbolic/scene \
	bench/symbolic/sympy-peer.py \
	doc/design.md \
	doc/double-pendulum.png \
	doc/methods.md \
	README.md

info_TEXINFOS = \
	doc/qdot.texi

doc_qdot_TEXINFOS =
