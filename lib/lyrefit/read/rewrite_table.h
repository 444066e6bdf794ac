#pragma once

#include "lyrefit/read/text_encoding.h"

namespace lyrefit {

// A text in which every reading has its own line. Three layouts are rewritten, and `remark` says so;
// other text is returned unchanged:
//   - the reply of a source meter: the whole buffer in one line, five numbers a reading (voltage,
//     current, resistance, time, status); a resistance that was not measured is 9.91e37,
//   - the scan of an inverter: rows of currents without voltages, below lines that state the first
//     voltage and the interval ("Start_V", "Interval_V"),
//   - a measurement a line with all pixels in it: ten settings, a field that begins with
//     "hysteresis$", results, then the current densities and the voltages of each pixel.
// The scan tells the setup of the measurement, so does the line of pixels. Lines of the second layout
// keep their numbers.
DecodedText RewriteTable(DecodedText text);

}  // namespace lyrefit
