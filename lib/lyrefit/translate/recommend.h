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

// Which of the results to believe, by rules that follow from what each procedure assumes and from
// how they did on measured curves (README of the module):
//   1. a cause is in the curve, or its shunt leaks more than healthy ones: the extended model, the
//      only one that knows
//   2. further curves, the target between them: procedure 3, which assumes nothing
//   3. a small step (10 % of light, 5 K): procedure 1, without a stated beta procedure 4
//   4. a larger one: De Soto, whose shunt goes with the light; without a stated beta, and not far in
//      light, procedure 4 for crystalline silicon
//   5. what there is, in the order of 4, 2, 1, PVsyst, extended
Recommendation Recommend(const Preparation& made, const std::vector<TranslatedResult>& results);

}  // namespace lyrefit
