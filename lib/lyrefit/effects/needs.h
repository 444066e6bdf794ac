#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/law/effect.h"

namespace lyrefit {

// How well a plateau's level says a light, relative to the full light, beside the fit's own error:
// photocurrents of a module's cells differ by some parts in a thousand (they are sorted into
// classes of half a percent, and a substring's plateau is that of its weakest cell), and the module
// departs from its diode model: by 1 to 2 parts in a thousand of what the five parameters leave of
// it, by several times that from plateau to plateau, where they absorb nothing.
constexpr double kCellScatter = 0.007;
constexpr double kSubstringScatter = 0.0063;

// Reasons that several effects share. Nothing: the data can show the effect.
using WhyNot = std::optional<std::string>;
WhyNot NeedsLight(const DataTraits& traits);
WhyNot NeedsOneLitCondition(const DataTraits& traits);  // effects during a sweep
WhyNot NeedsModule(const DataTraits& traits);           // strings of cells, one lit condition
WhyNot NeedsBypassDiodes(const DataTraits& traits);
WhyNot NeedsBypassedModule(const DataTraits& traits);  // the same, in its own voltages
WhyNot NeedsUpDown(const DataTraits& traits);
WhyNot NeedsLightLevels(const DataTraits& traits);   // two levels of light, dark counts
WhyNot NeedsIrradiances(const DataTraits& traits);   // a family over irradiance
WhyNot NeedsTemperatures(const DataTraits& traits);  // a family over temperature

// Probes with one parameter each.
std::vector<Probe> Strengths(const std::vector<double>& values);

}  // namespace lyrefit
