#include "lyrefit/diagnose/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/diagnose/describe.h"
#include "lyrefit/diagnose/evidence.h"
#include "lyrefit/diagnose/known_effects.h"
#include "lyrefit/model/effects/catalogue.h"

namespace lyrefit {
namespace {

Cause QuantisationCause(const Effect& effect, const Measurement& measurement) {
  Cause cause = MakeCause(effect, "values", 1);
  const Grids& grids = measurement.values.grids;
  const double step =
      (grids.lit > 0 ? grids.lit : grids.dark) * measurement.readings.scale.current_A;
  cause.strength = {{"q", "resolution", "A", step, step, step, false}};
  cause.sentence += "; " + StrengthText(cause.strength.front());
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
  cause.sentence += "; " + StrengthText(cause.strength.front());
  return cause;
}

Cause UnknownCause(const Selection& selection) {
  const Effect& effect = *FindEffect("unknown_structure");
  Cause cause = MakeCause(effect, "fit", selection.incomplete);
  cause.separate_by = {effect.separate_by};
  return cause;
}

// Range of the lack of fit of a single diode on sweeps of modules without a fault, in fractions of
// Isc.
constexpr double kLeastReferences = 5e-4, kMostHealthy = 2e-3;

// Whether the lack of fit exceeds both that of modules without a fault and the floor.
bool MissesTooMuch(const Verdict& verdict, const Floors& floors) {
  return floors.Any() && verdict.lack_of_fit.value > std::max(kMostHealthy, floors.current);
}

// "0.12 % of Isc, as healthy modules do (0.05 to 0.20 %)"
std::string DepartureText(double lack_of_fit, const Floors& floors) {
  const std::string usual =
      fmt::format("({:.2f} to {:.2f} %)", 100 * kLeastReferences, 100 * kMostHealthy);
  const std::string text = fmt::format("{:.2f} % of Isc", 100 * lack_of_fit);
  if (lack_of_fit < kLeastReferences) return text + " beyond their noise";
  if (lack_of_fit <= kMostHealthy) return text + ", as healthy modules do " + usual;
  return text + fmt::format(", more than healthy modules do {} but less than the floor of {:g} %",
                            usual, 100 * floors.current);
}

// Sentence if no cause is named: the lack of fit, and effects below the floors.
std::string NothingSentence(const Verdict& verdict, const Floors& floors, int curves) {
  if (!floors.Any()) return "Nothing to find: what the base model leaves is noise.";
  const double lack_of_fit = verdict.lack_of_fit.value;
  std::string present;
  if (!verdict.below_floor.empty()) {
    present =
        fmt::format("; present, but not certainly above {:g} % of Isc or {:g} % of Pmax: {}",
                    100 * floors.current, 100 * floors.power, verdict.below_floor.front().title);
  }
  if (!MissesTooMuch(verdict, floors)) {
    return "Nothing to act on: the data depart from the base model by " +
           DepartureText(lack_of_fit, floors) + present + ".";
  }
  if (present.empty()) present = ", and no cause of the catalogue explains it";
  return fmt::format(
      "The base model misses the data by {:.2f} % of Isc, more than it misses healthy modules by "
      "({:.2f} to {:.2f} %){}. To tell: {}{}.",
      100 * lack_of_fit, 100 * kLeastReferences, 100 * kMostHealthy, present,
      curves > 1 ? "diagnose each curve by itself; " : "",
      FindEffect("unknown_structure")->separate_by);
}

// `nameless`: there is structure but no cause that fits it.
std::string VerdictSentence(const Verdict& verdict, const Floors& floors, int curves,
                            bool nameless) {
  if (nameless) {
    return "Something is there that noise does not explain, and none of the known causes fits.";
  }
  if (!verdict.found) return NothingSentence(verdict, floors, curves);
  std::string text = "The data show ";
  for (std::size_t c = 0; c < verdict.causes.size(); ++c) {
    if (c > 0) text += c + 1 < verdict.causes.size() ? ", " : " and ";
    text += verdict.causes[c].title;
    if (!verdict.causes[c].equivalents.empty()) text += " (or what looks like it)";
  }
  if (verdict.unexplained) {
    text +=
        "; but structure remains that these do not explain: take the names as the nearest the "
        "catalogue has";
  }
  return text + ".";
}

// Lack of fit of a fit beyond the noise: root mean square in fractions of Isc.
Sized LeftBy(const WeightedData& weighted, const LawFit& fit) {
  double noise = 0;
  for (std::size_t k = 0; k < fit.current.size(); ++k) {
    if (weighted.used[k] != 0) noise += weighted.sigma[k] * weighted.sigma[k];
  }
  noise /= std::max(weighted.count(), 1);
  const double lack_of_fit = MissedBy(weighted, fit);
  const double left = std::sqrt(std::max(lack_of_fit * lack_of_fit - noise, 0.0));
  // A rough path has about six independent pieces in a sweep, so its size is known to about a
  // third.
  constexpr double kPieces = 6;
  const double half = left * kNormal95 / std::sqrt(2 * kPieces);
  return {left, left - half, left + half};
}

// Whether the residuals of the extended model are certainly not noise.
bool Remains(const Selection& selection, double whiteness_after) {
  constexpr double kCertain = 1e-3;
  return selection.incomplete > 0.5 || whiteness_after < kCertain ||
         selection.weighted.correlation >= 0.5;
}

}  // namespace

Verdict Decide(const Measurement& measurement, const Selection& selection, const AtReadings& at,
               const DiagnoseOptions& options, double whiteness_after) {
  Verdict verdict;
  verdict.causes = DescribeCauses(selection, at, measurement.values);
  const Effect& quantisation = *FindEffect("quantisation");
  if (IsWanted(quantisation, options) && IsCoarse(measurement, at.noise)) {
    verdict.causes.push_back(QuantisationCause(quantisation, measurement));
  }
  const Effect& bins = *FindEffect("voltage_bins");
  if (IsWanted(bins, options) && HasMaterialBins(measurement, at.noise, options.floor_current)) {
    verdict.causes.push_back(BinsCause(bins, measurement));
  }
  verdict.below_floor = DescribeBelow(selection);
  verdict.lack_of_fit = LeftBy(selection.base_weighted, selection.base);
  const Sized left = LeftBy(selection.weighted, selection.extended);
  const bool exceeds = options.floor_current > 0 ? left.low_95 > options.floor_current : true;
  // n is meaningful only if the shape of the curve is explained: unexplained structure changes n.
  const bool understood =
      options.floor_current > 0 ? left.value <= options.floor_current : verdict.causes.empty();
  if (understood && IsWanted(*FindEffect("temperature_or_cells"), options)) {
    const bool shorted = IsWanted(*FindEffect("bypass_short"), options);
    for (Cause& cause : CheckTemperatureAndCells(selection, shorted)) {
      verdict.causes.push_back(cause);
    }
  }
  constexpr double kNeverNoise = 1e-6;
  const bool unknown = exceeds && (selection.incomplete > 0.5 || whiteness_after < kNeverNoise);
  const bool nameless = unknown && verdict.causes.empty();
  if (nameless) {
    verdict.unexplained = true;
    verdict.causes.push_back(UnknownCause(selection));
  }
  verdict.found = !verdict.causes.empty();
  verdict.probability_none = selection.none;
  if (verdict.found && exceeds && Remains(selection, whiteness_after)) verdict.unexplained = true;
  const Floors floors{options.floor_current, options.floor_power};
  if (!verdict.found && MissesTooMuch(verdict, floors)) verdict.unexplained = true;
  for (const Inseparable& open : InseparableCauses()) {
    if (!open.applies(measurement.readings.traits)) continue;
    verdict.cannot_be_excluded.push_back({open.id, open.biases, open.sentence, open.separate_by});
  }
  verdict.sentence = VerdictSentence(verdict, floors, measurement.readings.traits.curves, nameless);
  return verdict;
}

}  // namespace lyrefit
