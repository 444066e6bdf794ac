#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/law/effect.h"

namespace lyrefit {

// Of the photocurrents of a module's cells, relative to their mean: cells are sorted into classes
// of half a percent. A substring's plateau is that of its weakest cell.
constexpr double kCellScatter = 0.004;
constexpr double kSubstringScatter = 0.003;

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
