# A word that is no unit: what was probably meant. Hectobar are refused, as [hbar] is Planck's constant to most.
for unit in m/s2 m/sec kph Kg degrees hours '°' '°C' hbar 'm s^-1' newtn; do
    qdot -q -e "9 [$unit]"
    echo "exit $?"
done 2>&1
qdot -q -e '1 [mbar] in [Pa]; 2 [kbar] in [Pa]; 3 [bar] in [mbar]'
