#include "lyrefit/diagnose/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/diagnose/decision_constants.h"
#include "lyrefit/diagnose/describe.h"
#include "lyrefit/diagnose/known_effects.h"
#include "lyrefit/effects/catalogue.h"

namespace lyrefit {
namespace {

Cause QuantisationCause(const Effect& effect, const Measurement& measurement) {
  Cause cause = MakeCause(effect, "values", 1);
  const Grids& grids = measurement.values.grids;
  const double step =
      (grids.lit > 0 ? grids.lit : grids.dark) * measurement.readings.scale.current_A;
  cause.strength = {{"q", "resolution", "A", step, step, step, false}};
  cause.in_words = {
      fmt::format("steps of {:.2g} % of Isc", 100 * step / measurement.readings.scale.current_A)};
  cause.sentence += "; " + cause.in_words.front();
  return cause;
}

// Whether coarse voltage bins blur the curve by more than the floor, in root mean square current.
bool HasMaterialBins(const Measurement& measurement, const Noise& noise, double floor) {
  if (!HasCoarseBins(measurement, noise)) return false;
  double sum = 0;
  for (const double rounding : measurement.values.bin_rounding) sum += rounding * rounding;
  return std::sqrt(sum / static_cast<double>(measurement.readings.points.size())) > floor;
}

Cause BinsCause(const Effect& effect, const Measurement& measurement) {
  Cause cause = MakeCause(effect, "values", 1);
  const double bin = measurement.values.voltage_bin * measurement.readings.scale.cells;
  cause.strength = {{"b", "bin", "V", bin, bin, bin, false}};
  cause.in_words = {fmt::format("steps of {:.3g} V", bin)};
  cause.sentence += "; " + cause.in_words.front();
  return cause;
}

Cause UnknownCause(const Selection& selection, double whiteness_after) {
  const Effect& effect = *FindEffect("unknown_structure");
  // What is certainly not white is there; a p-value says no more.
  Cause cause = MakeCause(effect, "fit", whiteness_after < kNeverNoise ? 1 : selection.incomplete);
  cause.separate_by = {effect.separate_by};
  return cause;
}

// Probability of a cause and of those that draw the same curve by another wrong number.
double ProbabilityOfSet(const Cause& cause) {
  double sum = cause.probability;
  for (const Alternative& other : cause.alternatives) {
    const std::vector<std::string>& same = cause.equivalents;
    if (std::find(same.begin(), same.end(), other.id) != same.end()) sum += other.probability;
  }
  return sum;
}

// Whether the residuals of the extended model are certainly not noise.
bool Remains(const Selection& selection, double whiteness_after) {
  return selection.incomplete > 0.5 || whiteness_after < kRemains ||
         selection.weighted.correlation >= 0.5;
}

// Whether nothing but wrong readings is named, and the model misses the others nearly as much: wrong
// are a few among many that it describes.
bool AreWrongReadingsAmongMisses(const Verdict& verdict, const Sized& left) {
  constexpr double kNearly = 0.5;
  return verdict.causes.size() == 1 && verdict.causes.front().id == "outliers" &&
         left.value > kNearly * verdict.lack_of_fit.value;
}

}  // namespace

Verdict Decide(const Measurement& measurement, const Selection& selection, const AtReadings& at,
               const DiagnoseOptions& options, double whiteness_after) {
  Verdict verdict;
  verdict.causes = DescribeCauses(selection, at, measurement.values);
  const Effect& quantisation = *FindEffect("quantisation");
  const auto wanted = [&](const Effect& effect) {
    return IsWanted(effect, options) && WhyExcluded(effect, options) == nullptr;
  };
  if (wanted(quantisation) && IsCoarse(measurement, at.noise)) {
    verdict.causes.push_back(QuantisationCause(quantisation, measurement));
  }
  const Effect& bins = *FindEffect("voltage_bins");
  if (wanted(bins) && HasMaterialBins(measurement, at.noise, options.floor_current)) {
    verdict.causes.push_back(BinsCause(bins, measurement));
  }
  verdict.below_floor = DescribeBelow(selection);
  verdict.lack_of_fit = LeftBy(selection.base_weighted, selection.base);
  const Sized left = LeftBy(selection.weighted, selection.extended);
  const bool exceeds = options.floor_current > 0 ? left.low_95 > options.floor_current : true;
  // n is meaningful only if the shape of the curve is explained: unexplained structure changes n.
  double none = selection.none;
  const bool understood =
      options.floor_current > 0 ? left.value <= options.floor_current : verdict.causes.empty();
  if (understood && IsWanted(*FindEffect("temperature_or_cells"), options)) {
    const bool shorted = IsWanted(*FindEffect("bypass_short"), options);
    for (Cause& cause : CheckTemperatureAndCells(selection, shorted)) {
      none = std::max(none - ProbabilityOfSet(cause), 0.0);
      verdict.causes.push_back(cause);
    }
  }
  const bool unknown = exceeds && (selection.incomplete > 0.5 || whiteness_after < kNeverNoise);
  if (exceeds && AreWrongReadingsAmongMisses(verdict, left)) {
    Cause cause = UnknownCause(selection, whiteness_after);
    cause.probability = 1;  // its size is above the floor by more than its error
    for (const std::string& words : verdict.causes.front().in_words) cause.sentence += "; " + words;
    verdict.causes = {cause};
    verdict.unexplained = true;
  } else if (unknown && verdict.causes.empty()) {
    verdict.unexplained = true;
    verdict.causes.push_back(UnknownCause(selection, whiteness_after));
  }
  verdict.found = !verdict.causes.empty();
  verdict.probability_none = none;
  if (verdict.found && exceeds && Remains(selection, whiteness_after)) verdict.unexplained = true;
  const Floors floors{options.floor_current, options.floor_power};
  if (!verdict.found && MissesTooMuch(verdict, floors)) verdict.unexplained = true;
  for (const Inseparable& open : InseparableCauses()) {
    if (!open.applies(measurement.readings.traits)) continue;
    verdict.cannot_be_excluded.push_back({open.id, open.biases, open.sentence, open.separate_by});
  }
  return verdict;
}

}  // namespace lyrefit
