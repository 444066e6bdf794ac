# The table of `fault_study power --csv TABLE` as a picture:
#   gnuplot -e "table='power.csv'" tests/faults/power.gp > power.svg
set terminal svg size 860,520 font 'DejaVu Sans,13' background '#ffffff'
set datafile separator comma
set xlabel 'misfit of the base model in noise units (middle of the band)'
set ylabel 'per cent of the cases'
set yrange [0:103]
set xrange [3:21]
set key bottom right
set grid lc rgb '#dddddd'
kinds = 'fwd rev updown dark famG famGT'
names = '"one sweep" "with reverse" "up and down" "lit and dark" "family over light" "family over light and temperature"'
colours = '#0072b2 #d55e00 #009e73 #cc79a7 #e69f00 #56b4e9'
found(k) = sprintf("< grep '^%s,all,' %s", k, table)
plot for [i=1:6] found(word(kinds, i)) using (($3+$4)/2):(100*$7/$5) with linespoints lw 2 pt 7 ps 0.6 \
       lc rgb word(colours, i) title word(names, i), \
     found('fwd') using (($3+$4)/2):6 with lines lw 2 dt 2 lc rgb '#444444' title 'ideal test, one sweep', \
     found('famGT') using (($3+$4)/2):6 with lines lw 2 dt 3 lc rgb '#444444' title 'ideal test, family'
