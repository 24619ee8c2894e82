# `digits` do not follow a power whose base passes 0: the reference is then a run in doubles. Nor a coordinate without mass.
qdot -q -e "coord x; particle p mass 1 at x; force -x - abs(x)^1.5/5 on x; start x = 1/64, x' = -1" \
    -e 'run 0..1/32 digits 20' 2>&1 | grep error
qdot -q -e "coord x; particle p mass 1 at x; force -x - abs(x)^1.5/5 on x; start x = 1/64, x' = -1" \
    -e 'workprecision 0..1/32 to "w.svg"' | awk '/^(taylor|dop853|radau) .* done/ { n++; bad += $3 > 1e-3 } END { print (n > 20 ? "many runs" : n), bad + 0, "bad" }'
qdot -q -e "coord x, y; lagrangian x'^2/2 - (x - y)^2 - y^2/2; force -y'/2 on y; start x = 1, y = 0.3; workprecision 0..1/32 to \"w.svg\"" |
    awk '/^(taylor|dop853|radau) .* done/ { n++; bad += $3 > 1e-3 } END { print (n > 20 ? "many runs" : n), bad + 0, "bad" }'
