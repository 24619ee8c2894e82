# normalise.sed -- what differs from run to run or from machine to machine, made the same.

# CPU times: `cpu 0.0031 s`, `CPU time: 12 ms`, `"cpu":0.001`, `0.0031 s cpu`
s/\([Cc][Pp][Uu][_a-z]*[": =a-z]*\)[0-9][0-9.]*\(e[-+]*[0-9]*\)\{0,1\}\( *\(us\|µs\|ms\|s\|min\)\)\{0,1\}\>/\1TIME/g
s/[0-9][0-9.]*\(e[-+]*[0-9]*\)\{0,1\} *\(us\|µs\|ms\|s\|min\) \([Cc][Pp][Uu]\)/TIME \3/g

# What a run costs, and its last digits, are a matter of the method; that its numbers are
# right is what `check ... within` says. `auto` may choose any of these.
s/method \(rk8pd\|dop853\|taylor\), tol/method AUTO, tol/
s/^\(  hint: auto\), .*/\1, .../
s/^  [0-9][0-9]* steps\{0,1\}, [0-9].*$/  STEPS/
s/"\(steps\|rejected\|evals\|jacobians\|factorizations\)":[0-9][0-9]*/"\1":N/g
s/^\(fit of .*\), [0-9][0-9]* steps\{0,1\}$/\1, N steps/
s/\(the fit does not converge: \)[0-9]* steps/\1N steps/
# Where a run failed or stopped is known to ten digits; how far many steps came, to none.
/ failed: .* steps: at this rate/s/\.\.[0-9.]*\(, .* failed: stopped at t = \)[0-9.]*/..N\1N/
/ \(failed\|stopped\): /s/^\([a-z]*[0-9]*: t = [^ ,]*\.\.[-0-9.]\{12\}\)[0-9]*/\1/
s/\( at t = [-0-9.]\{12\}\)[0-9]*/\1/g
s/\(a singularity: [^ ]* = \)[^ ]* there, \([^ ]* = \).*/\1N there, \2N/
s/\(does not vanish there: it is \).*/\1N/
# About where rounding hides what happens.
s/\(about t = \)[0-9.]*\( the event .* within rounding\)/\1N\2/
s/\( has no direction about t = [0-9]*\.[0-9][0-9]\)[0-9]*/\1/
# When a contact began is known to ten digits at best.
s/\(rests on .* from t = [0-9][0-9.]\{9\}\)[0-9]*/\1/
# What may be anything.
s/-\{0,1\}[0-9][0-9.]*\(e[-+]*[0-9]*\)\{0,1\} (error unknown)/N (error unknown)/g
/^  apart: /s/ [0-9][0-9]* steps\{0,1\}/ STEPS/g
/^  drift: /s/ [0-9][0-9.]*\(e[-+]*[0-9]*\)\{0,1\}\(,\|$\)/ N\2/g
s/^\(  error of the end state: at most \).*/\1N/
/^  end state:/,/^[^ ]/{
/^    /s/ = -\{0,1\}[0-9][0-9.]*\(e[-+]*[0-9]*\)\{0,1\}/ = N/g
}
s/-\{0,1\}[0-9][0-9.]*\(e[-+]*[0-9]*\)\{0,1\} ± [0-9][0-9.]*\(e[-+]*[0-9]*\)\{0,1\}/N ± ERROR/g
s/-\{0,1\}[0-9][0-9.]*\(e[-+]*[0-9]*\)\{0,1\} \([-+]\) [0-9][0-9.]*\(e[-+]*[0-9]*\)\{0,1\}\*i ± [0-9][0-9.]*\(e[-+]*[0-9]*\)\{0,1\}/N \2 N*i ± ERROR/g
# Columns of numbers with errors are as wide as the errors have digits.
s/ERROR   */ERROR  /g
s/ERROR  0   */ERROR  0  /g
/^bifurcation  /s/   */  /g

# Rounding: what is left of an exact zero depends on the machine's sin and cos. A tolerance
# is what was asked for and stays.
s/\(tol[a-z]*["]*[ :=]*[0-9.]*\)e-/\1E-/g
s/-\{0,1\}[0-9][0-9.]*e-1[2-9]/TINY/g
s/-\{0,1\}[0-9][0-9.]*e-[2-9][0-9]/TINY/g
s/-\{0,1\}[0-9][0-9.]*e-[1-3][0-9][0-9]/TINY/g
s/\(tol[a-z]*["]*[ :=]*[0-9.]*\)E-/\1e-/g

# What was done about drift off the constraints, and how little is left of it.
/^  constraints: /{
s/error \(0\|TINY\)\(, of velocities \(0\|TINY\)\)\{0,1\}/error TINY/
s/projected after [0-9][0-9]* steps\{0,1\}/projected after N steps/
}

# What Taylor series are computed by is a matter of the processor.
s/machine code for \(SSE2\|AVX2\|AVX-512\), [0-9.]* kB/CODE/
s/kernels; machine code needs AVX2/CODE/
s/kernels; machine code is for x86-64/CODE/
# So is their order.
s/^order: [0-9][0-9]*, chosen by/order: P, chosen by/
s/order [0-9][0-9]*, \(.* an order; CODE\)/order P, \1/
# So are the places where a run changes over to another method and back.
/ the scene is stiff: /s/from t = [0-9.e+-]* on/from t = N on/g
# What rounding leaves depends on the processor.
s/steps were held to .*/steps were held to N/
s/\( rows.*\), in [0-9.e+-]* s$/\1, in TIME/

# A section prints all digits of its points; eleven of them are the same on every processor.
/^poincare: [0-9]/,/^[^- 0-9]/{
/^[- 0-9]/{
s/\([0-9]*\.[0-9]\{10\}\)[0-9]*/\1/g
s/^  *//
s/   */  /g
}
}
