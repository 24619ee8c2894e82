# The polynomials of a table have coefficients in doubles: more digits are not known.
printf 't,c\n0,0.1\n1,0.3\n2,0.7\n3,0.2\n4,0.1\n' >c.csv
qdot -q -e 'data c from "c.csv" : t, c' -e 'numeric(c(2.35))' -e 'numeric(c(2.35), 16)' -e 'numeric(c(2.35) + pi, 25)'
qdot -q -e 'data c from "c.csv" : t, c' -e 'numeric([pi, c(3)], 17)'
