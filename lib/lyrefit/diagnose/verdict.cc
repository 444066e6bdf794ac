#include "lyrefit/diagnose/verdict.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/diagnose/describe.h"
#include "lyrefit/diagnose/evidence.h"
#include "lyrefit/diagnose/known_effects.h"
#include "lyrefit/effects/catalogue.h"

namespace lyrefit {
namespace {

Cause QuantisationCause(const Effect& effect, const Measurement& measurement) {
  Cause cause = MakeCause(effect, "values", 0);
  const Grids& grids = measurement.values.grids;
  const double step =
      (grids.lit > 0 ? grids.lit : grids.dark) * measurement.readings.scale.current_A;
  cause.strength = {{"q", "resolution", "A", step, step, step, false}};
  cause.sentence += "; " + StrengthText(cause.strength.front());
  return cause;
}

Cause UnknownCause(const Selection& selection, double whiteness_after) {
  const Effect& effect = *FindEffect("unknown_structure");
  Cause cause = MakeCause(effect, "fit", std::min(selection.unknown_p, whiteness_after));
  cause.separate_by = {effect.separate_by};
  return cause;
}

// `nameless`: structure alone, without a cause that fits it.
std::string VerdictSentence(const Verdict& verdict, bool nameless) {
  if (nameless) {
    return "Something is there that noise does not explain, and none of the known causes fits.";
  }
  if (!verdict.found) return "Nothing to find: what the base model leaves is noise.";
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

// Root mean square of what the causes certainly leave beyond the noise, in parts of Isc.
double Left(const Selection& selection) {
  const Workbench& bench = selection.bench;
  std::vector<double> currents;
  double noise = 0;
  for (std::size_t k = 0; k < selection.extended.current.size(); ++k) {
    currents.push_back(bench.readings->points[k].current);
    if (bench.used[k] != 0) noise += bench.sigma[k] * bench.sigma[k];
  }
  const double departure = Departure(bench, selection.extended, currents);
  const double left = std::max(departure * departure - noise / std::max(bench.count(), 1), 0.0);
  // A rough path has some six independent pieces in a sweep: its size is known to a third.
  constexpr double kReach = 1.96, kPieces = 6;
  return std::sqrt(left) * (1 - kReach / std::sqrt(2 * kPieces));
}

// Whether what the causes leave is certainly not noise.
bool Remains(const Selection& selection, double whiteness_after) {
  constexpr double kCertain = 1e-3;
  return selection.unknown_p < kCertain || whiteness_after < kCertain ||
         selection.bench.correlation >= 0.5;
}

}  // namespace

Verdict Decide(const Measurement& measurement, const Selection& selection,
               const DiagnoseOptions& options, double whiteness_after) {
  Verdict verdict;
  verdict.causes = DescribeCauses(selection, measurement.values);
  const Effect& quantisation = *FindEffect("quantisation");
  if (IsWanted(quantisation, options) && IsCoarse(measurement, selection.noise)) {
    verdict.causes.push_back(QuantisationCause(quantisation, measurement));
  }
  std::stable_sort(verdict.causes.begin(), verdict.causes.end(),
                   [](const Cause& a, const Cause& b) { return a.corrected_p < b.corrected_p; });
  const bool material = Left(selection) > options.floor_current;
  // A shape that is not understood bends n, which then says nothing.
  const bool understood = verdict.causes.empty() || !material;
  if (understood && IsWanted(*FindEffect("temperature_or_cells"), options)) {
    for (Cause& cause : CheckTemperatureAndCells(selection)) verdict.causes.push_back(cause);
  }
  constexpr double kNeverNoise = 1e-6;
  const bool unknown = material && (selection.unknown || whiteness_after < kNeverNoise);
  const bool nameless = unknown && verdict.causes.empty();
  if (nameless) {
    verdict.unexplained = true;
    verdict.causes.push_back(UnknownCause(selection, whiteness_after));
  }
  verdict.found = !verdict.causes.empty();
  if (verdict.found && material && Remains(selection, whiteness_after)) verdict.unexplained = true;
  for (const Inseparable& open : InseparableCauses()) {
    if (!open.applies(measurement.readings.traits)) continue;
    verdict.cannot_be_excluded.push_back({open.id, open.biases, open.sentence, open.separate_by});
  }
  verdict.sentence = VerdictSentence(verdict, nameless);
  return verdict;
}

}  // namespace lyrefit
