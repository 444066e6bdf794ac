#pragma once

#include "lyrefit/read/table_layout.h"
#include "lyrefit/read/table_lines.h"

namespace lyrefit {

// Finds a column that tells devices apart ("Channel", "Pixel", "DUT") among those that are not used,
// and its values. They are few, and the rows of each cover at least half of all voltages, as the
// curve of a device does; a counter of samples does not. `rows` stands at the first row. Nothing is
// set where there is none, or one device alone.
void FindDevices(LineReader rows, TableLayout* layout);

}  // namespace lyrefit
