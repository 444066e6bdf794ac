#pragma once

#include <string>

#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// The law of model/translation.h that is fitted before any cause: De Soto's, as in `fit --family`.
// If the temperatures differ, alpha and EgRef are free parameters unless stated. A stated band gap
// slope is used unchanged: without it, errors of temperature and voltage would be harder to detect.
Law StartingLaw(const Readings& readings, Model model);

// Selects the variant of `law` that fits the readings better. Several irradiances select Rsh
// constant or in inverse proportion to light. Several temperatures, with a stated band gap and no
// stated slope, select De Soto's slope or none. Rsh in inverse proportion is selected only if a
// constant shunt beside it gains nothing. A shunt that merely grows with light is left to be found
// as a cause.
Law ChooseLaw(const WeightedData& weighted, const Law& law);

// Assumptions of a base law, as text.
std::string DescribeLaw(const Readings& readings, const Law& law);

}  // namespace lyrefit
