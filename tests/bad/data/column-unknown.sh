# A name that is no column is an error where the file has another of the names elsewhere; a file with other names is read in its order.
mkdir columns && cd columns || exit
printf 't,F\n0,1\n1,3\n2,4\n3,0\n' > d.csv
qdot -q -e 'data f from "d.csv" : F, time'
echo "exit $?"
qdot -q -e 'data f from "d.csv" : time, F; numeric(f(1))'
echo "exit $?"
cd .. && rm -r columns
