#pragma once

#include <string>
#include <vector>

#include "lyrefit/translate/prepare.h"
#include "lyrefit/translate/translation_report.h"

namespace lyrefit {

struct Recommendation {
  int result = -1;  // position; -1: nothing was computed
  std::string reason;
};

// Selects a result by rules based on the assumptions of each procedure and its errors on measured
// curves (README of the module):
//   1. a diagnosed cause, or a shunt below that of normal modules: the extended model, the only
//      procedure that includes them
//   2. a target between measured curves: procedure 3, which assumes nothing of the device
//   3. a small step (10 % of irradiance, 5 K): procedure 1, without a stated beta procedure 4
//   4. a larger step: De Soto, whose shunt follows the irradiance; without a stated beta, and for a
//      moderate change of irradiance, procedure 4 for crystalline silicon
//   5. else the first computed of De Soto, 4, 2, 1, PVsyst, extended, 3
Recommendation Recommend(const Preparation& made, const std::vector<TranslatedResult>& results);

}  // namespace lyrefit
