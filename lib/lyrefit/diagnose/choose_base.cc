#include "lyrefit/diagnose/choose_base.h"

#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/effects/catalogue.h"

namespace lyrefit {
namespace {

LawFit Better(LawFit a, LawFit b) {
  return b.usable && (!a.usable || b.sum < a.sum) ? std::move(b) : std::move(a);
}

// Refits with a constant shunt beside the catalogue's shunt that grows with light.
LawFit WithConstantShunt(const WeightedData& weighted, const LawFit& inverse) {
  LawFit best;
  for (const double law : {0.0, 1.0}) {  // linear and exponential
    Law both = inverse.law;
    both.shunt = ShuntLaw::kConstant;
    both.effects.push_back(FindEffect("photoshunt"));
    std::vector<double> start = inverse.p;
    start.push_back(0.95 * weighted.readings->scale.resistance_ohm() / start[kRsh]);
    start[kRsh] /= 0.05;
    start.push_back(law);
    best = Better(std::move(best), FitLaw(weighted, both, start));
  }
  return best;
}

Law ChooseShunt(const WeightedData& weighted, const Law& law) {
  // Gain, in units of the noise variance, below which two more parameters are not significant.
  constexpr double kNothing = 6;
  const LawFit constant = FitBase(weighted, law);
  Law proportional = law;
  proportional.shunt = ShuntLaw::kInverse;
  const LawFit inverse = FitLaw(weighted, proportional, constant.p);
  if (!constant.usable || !inverse.usable || inverse.sum >= constant.sum) return law;
  const LawFit both = WithConstantShunt(weighted, inverse);
  if (!both.usable) return proportional;
  const double variance = NoiseVariance(weighted, both);
  return inverse.sum - both.sum > kNothing * variance ? law : proportional;
}

}  // namespace

Law StartingLaw(const Readings& readings, Model model) {
  const DataTraits& traits = readings.traits;
  const bool temperatures = traits.temperature_levels > 1;
  Law law;
  law.model = model;
  law.bandgap_slope_per_K = readings.bandgap_slope_per_K.value_or(kDeSotoBandgapSlope_per_K);
  law.free_tempco = temperatures && !traits.tempco_known;
  law.free_bandgap = temperatures && !traits.bandgap_known;
  return law;
}

Law ChooseLaw(const WeightedData& weighted, const Law& law) {
  const DataTraits& traits = weighted.readings->traits;
  Law chosen = law;
  const bool slope_stated = weighted.readings->bandgap_slope_per_K.has_value();
  if (traits.temperature_levels > 1 && !law.free_bandgap && !slope_stated) {
    Law level = law;
    level.bandgap_slope_per_K = 0;
    const LawFit sloping = FitBase(weighted, law);
    const LawFit flat = FitBase(weighted, level);
    if (flat.usable && (!sloping.usable || flat.sum < sloping.sum)) chosen = level;
  }
  return traits.irradiance_levels > 1 ? ChooseShunt(weighted, chosen) : chosen;
}

std::string DescribeLaw(const Readings& readings, const Law& law) {
  const DataTraits& traits = readings.traits;
  std::string text = fmt::format(
      "{} parameters for all readings",
      law.model == Model::kDoubleDiode ? "two diodes (n2 = 2) and six" : "one diode and five");
  if (traits.curves > 1) {
    text += law.shunt == ShuntLaw::kInverse
                ? ", photocurrent and 1/Rsh in proportion to light"
                : ", photocurrent in proportion to light, Rsh that does not know the light";
  }
  if (traits.temperature_levels > 1) {
    text += law.bandgap_slope_per_K != 0
                ? fmt::format(", De Soto's saturation current with dEgdT {:.4g} 1/K",
                              law.bandgap_slope_per_K)
                : std::string(", De Soto's saturation current with a constant band gap");
  }
  if (law.free_tempco && law.free_bandgap) {
    text += "; the band gap and the temperature coefficient of Isc are not stated and estimated";
  } else if (law.free_tempco) {
    text += "; the temperature coefficient of Isc is not stated and estimated";
  } else if (law.free_bandgap) {
    text += "; the band gap is not stated and estimated";
  }
  return text;
}

}  // namespace lyrefit
