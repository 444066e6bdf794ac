# Stated probabilities beside the share that is true, from tables of `fault_study calibration --csv`:
#   gnuplot -e "laboratory='lab.csv'; field='field.csv'; real='real.csv'" tests/faults/calibration.gp > calibration.svg
set terminal svg size 900,400 font 'DejaVu Sans,12' background '#ffffff'
set datafile separator comma
set multiplot layout 1,3
set xlabel 'stated, %'
set ylabel 'true, %'
set xrange [0:100]
set yrange [0:100]
set size square
set grid lc rgb '#dddddd'
set key outside bottom center horizontal samplen 1
rows(table, what) = sprintf("< grep ',%s,' %s", what, table)
diagonal(x) = x
titles = '"equation of a device" "cell by cell" "real sweeps"'
tables = sprintf('%s %s %s', laboratory, field, real)
do for [k=1:3] {
  table = word(tables, k)
  set title word(titles, k)
  plot diagonal(x) with lines lc rgb '#888888' dt 2 notitle, \
       rows(table, 'all') using (100*$6):(100*$7):(100*$8):(100*$9) with yerrorbars pt 7 ps 0.5 \
         lc rgb '#0072b2' title 'every finding', \
       rows(table, 'named') using (100*$6+1):(100*$7):(100*$8):(100*$9) with yerrorbars pt 5 ps 0.5 \
         lc rgb '#d55e00' title 'first named'
}
unset multiplot
