# A ball that hops on a floor at 5, 1e-7 high, a hundred times: radau rounds where it is at every blow, and so do the runs
# that tell its error, alike. The error stated covers what becomes of it.
printf 'coord h\nparticle b mass 1 at h\ngravity -9.81\nevent floor: h = 5 falling then h'"'"' = -h'"'"'\nstart h = 5 + 1e-7\nrun 0..0.02867 method radau\nvalue(h, 0.02867)\n' |
    qdot -q --json - | tail -n 1 |
    sed 's/.*"value":\([^,]*\),"error":\([^,]*\),.*/\1 \2/' |
    awk '{ d = $1 - 5.000000037215493375; if (d < 0) d = -d; print (d <= $2 && $2 < 1e-10 ? "covered" : "beyond") }'
