# normalise.sed -- what differs from run to run or from machine to machine, made the same.

# CPU times: `cpu 0.0031 s`, `CPU time: 12 ms`, `"cpu":0.001`, `0.0031 s cpu`
s/\([Cc][Pp][Uu][_a-z]*[": =a-z]*\)[0-9][0-9.]*\(e[-+]*[0-9]*\)\{0,1\}\( *\(us\|µs\|ms\|s\|min\)\)\{0,1\}\>/\1TIME/g
s/[0-9][0-9.]*\(e[-+]*[0-9]*\)\{0,1\} *\(us\|µs\|ms\|s\|min\) \([Cc][Pp][Uu]\)/TIME \3/g

# Rounding: what is left of an exact zero depends on the machine's sin and cos. A tolerance
# is what was asked for and stays.
s/\(tol[a-z]*["]*[ :=]*[0-9.]*\)e-/\1E-/g
s/-\{0,1\}[0-9][0-9.]*e-1[2-9]/TINY/g
s/-\{0,1\}[0-9][0-9.]*e-[2-9][0-9]/TINY/g
s/-\{0,1\}[0-9][0-9.]*e-[1-3][0-9][0-9]/TINY/g
s/\(tol[a-z]*["]*[ :=]*[0-9.]*\)E-/\1e-/g
