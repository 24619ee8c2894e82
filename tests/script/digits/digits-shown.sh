# As many digits are shown as are known, whatever the number begins with.
printf '%s\n' 'coord x' 'particle p mass 1 at x' 'run 0..1 digits 30' \
    "value(x' + 123e-33, 1)" "value(x' + 325e-33, 1)" "value(x' + 1001e-33, 1)" "value(x' + 999e-33, 1)" |
    qdot -q --json - | sed -n 's,.*"value":"\([0-9.]*\)e.*,\1,p'
