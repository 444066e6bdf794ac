#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/read/table_curve.h"

namespace lyrefit {

// The file of a multi-flash tester (Sinton FMT, .mfr): settings as `Key = "value"` below heads
// `[Section]`, and arrays of detector voltages. Each of some 20 to 40 flashes is measured at one
// load while its light decays, one flash at open circuit and one at short circuit.
bool IsMultiFlash(std::string_view text);

struct MultiFlash {
  std::vector<RawCurve> curves;          // by rising light; at the end the Suns-Voc trace
  std::optional<std::size_t> at_target;  // the curve at the light that the file aims at
};

// Converts the arrays by the constants of the file, and joins the readings of all flashes at equal
// light to curves at 0.1, 0.2, 0.4, 0.6, 0.8, 1 and 1.2 times the target light, as far as most
// flashes reach it. The readings keep the temperature at which they were measured. Errors, with the
// line: a constant or an array that is missing, is no number or has another size than stated.
Expected<MultiFlash> ReadMultiFlash(std::string_view text, const std::string& file);

}  // namespace lyrefit
