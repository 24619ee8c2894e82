# A scene with states written and read again; programs in five languages.
cat > motor.lag <<'END'
coord phi
param J, L, R, K, V
body rotor mass 1 inertia J at (0, 0) angle phi
state i' = (V - R*i - K*phi')/L
torque K*i on phi
set J = 1/10, L = 1/20, R = 2, K = 1/2, V = 6
start i = 0
scene to "again.lag"
run 0..1
save session to "session.lag"
export c eom to "motor.c"
export python eom to "motor.py"
export javascript eom to "motor.js"
export julia eom to "motor.jl"
export matlab eom to "motor.m"
END
qdot -q motor.lag
cat again.lag
qdot -q session.lag
qdot -q --json again.lag
cat > json.lag <<'END'
state z' = -z
start z = 1
run 0..1
END
qdot -q --json json.lag
