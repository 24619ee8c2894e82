# Names that are only in answers, S and E, are declared to write of them.
scene='param m, k > 0; coord x; hamiltonian p[x]^2/(2*m) + k*x^2/2'
qdot -q -e "$scene; check action(x) == 2*pi*sqrt(m/k)*E" 2>&1
qdot -q -e "$scene; check hamilton_jacobi == (k*x^2/2 + diff(S(x, t), x)^2/(2*m) = -diff(S(x, t), t))" 2>&1
qdot -q -e "$scene; param E > 0; function S(x, t); check action(x) == 2*pi*sqrt(m/k)*E;
check hamilton_jacobi == (k*x^2/2 + diff(S(x, t), x)^2/(2*m) = -diff(S(x, t), t)); check hamilton_jacobi[x] == (p[x]^2 = m*(2*E - k*x^2))"
