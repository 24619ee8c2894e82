# What `report` refuses, and why; a browser is looked for only once the page is made.
for line in \
    'report to "x.html"' \
    'coord x; report' \
    'coord x; report to "x.txt"' \
    'coord x; report a to "x.html"' \
    'coord x; report title x to "x.html"' \
    'coord x; particle a mass 1 at (x, 0); report to "folder/x.html"'; do
    qdot -q -e "$line"
    echo
done
mkdir none
program=$(command -v qdot)
PATH=$PWD/none "$program" -q -e 'coord x; particle a mass 1 at (x, 0); report to "x.pdf"'
ls x.* 2>/dev/null
