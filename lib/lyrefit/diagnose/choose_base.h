#pragma once

#include <string>

#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// The law of law/translation.h that is fitted before any cause is thought of: `fit --family`'s
// De Soto, with alpha and EgRef free where nobody stated them. Where curves under several
// irradiances or temperatures have a say, they choose: Rsh constant or in inverse proportion to
// light, the band gap with De Soto's slope or, where the gap is stated, without. A slope that is
// stated is believed: without it, errors of the temperatures and voltages have less to be told by.
Law StartingLaw(const Readings& readings, Model model);

// `law` as the readings have it. Rsh in inverse proportion only where a constant shunt beside it
// would add nothing: one that merely grows with light is a finding.
Law ChooseLaw(const WeightedData& weighted, const Law& law);

// What a base law assumes, in words.
std::string DescribeLaw(const Readings& readings, const Law& law);

}  // namespace lyrefit
