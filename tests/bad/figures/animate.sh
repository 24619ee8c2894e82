# What `animate` refuses, and why.
scene='coord x; particle a mass 1 at (x, 0); start x'"'"' = 1; run 0..5; '
for line in \
    'coord x; particle a mass 1 at (x, 0); animate to "x.html"' \
    "$scene animate" \
    "$scene animate to" \
    "$scene animate to \"x.mp4\"" \
    "$scene animate to \"x\"" \
    "$scene animate b to \"x.html\"" \
    "$scene animate from 1 to 6 to \"x.html\"" \
    "$scene animate from 1 to 1 to \"x.html\"" \
    "$scene animate speed 0 to \"x.html\"" \
    "$scene animate trail -1 to \"x.html\"" \
    "$scene animate speed 1 speed 2 to \"x.html\"" \
    "$scene animate title x to \"x.html\"" \
    "$scene animate every 2 to \"x.html\"" \
    "$scene animate to \"folder/x.html\"" \
    "$scene coord y; animate to \"x.html\"" \
    'coord x; lagrangian x'"'"'^2/2; start x = 1; run 0..5; animate to "x.html"'; do
    qdot -q -e "$line" | grep -v '^ \|^run1'
    echo
done
ls *.html *.mp4 x 2>/dev/null
