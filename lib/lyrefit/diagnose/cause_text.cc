#include "lyrefit/diagnose/cause_text.h"

#include <fmt/format.h>

#include <cmath>

#include "lyrefit/diagnose/effect_size.h"
#include "lyrefit/effects/fitted_effect.h"

namespace lyrefit {
namespace {

// The largest change of the current by the effect.
std::vector<std::string> LargestChange(const WeightedData& weighted, const LawFit& fit, int index) {
  const Readings& readings = *weighted.readings;
  const LawFit rest = TakenOut(fit, index);
  const std::vector<Reading>& points = readings.points;
  std::vector<double> without(points.size());
  LawWorkspace workspace;
  if (!EvaluateLaw(rest.law, readings, rest.p.data(), &workspace, without.data(), nullptr)) {
    return {};
  }
  // Where the device delivers power, if any reading is there: beyond, currents grow without limit.
  const auto change = [&](std::size_t k) { return fit.current[k] - without[k]; };
  const auto delivers = [&](std::size_t k) {
    return points[k].current > 0 && points[k].voltage > 0;
  };
  std::size_t most = points.size();
  for (const bool anywhere : {false, true}) {
    if (most < points.size()) break;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (!anywhere && !delivers(k)) continue;
      if (most == points.size() || std::fabs(change(k)) > std::fabs(change(most))) most = k;
    }
  }
  if (most == points.size() || !(std::fabs(change(most)) > 0)) return {};
  const double percent = 100 * std::fabs(change(most));
  return {fmt::format("it {} up to {:.{}f} % of Isc, most at {:.4g} V",
                      change(most) < 0 ? "takes" : "adds", percent, percent < 10 ? 1 : 0,
                      points[most].voltage * readings.scale.cells)};
}

}  // namespace

std::vector<std::string> InWords(const WeightedData& weighted, const LawFit& fit, int index,
                                 const std::vector<CauseParameter>& strength) {
  const Effect& effect = *fit.law.effects[index];
  if (effect.in_words == nullptr) return LargestChange(weighted, fit, index);
  return effect.in_words(
      {*weighted.readings, fit.law, fit.p, index, fit.p.data() + fit.law.Offset(index), strength});
}

}  // namespace lyrefit
