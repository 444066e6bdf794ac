#include "lyrefit/estimate/fit/judge_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/curve/dark.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/estimate/fit/usable.h"

namespace lyrefit {
namespace {

using Sentences = std::vector<std::string>;

void WarnOfStops(const FitReport& report, Sentences* out) {
  if (!report.usable) out->push_back("the fit is not usable: " + report.not_usable_because);
  out->insert(out->end(), report.doubts.begin(), report.doubts.end());
  if (report.interrupted) {
    out->push_back("interrupted: this is the best so far, not the end of the search");
  }
  if (report.polished && report.refine.termination == "no convergence") {
    out->push_back("the polish stopped before it converged; do not trust the last digits");
  }
  if (!report.polished && !report.interrupted) {
    out->push_back("not polished: the parameters are those of the search's best candidate");
  }
}

void WarnOfBounds(const FitReport& report, Sentences* out) {
  if (report.steepest_n > 0) out->push_back(StepsLeftOut(report.steepest_n));
  for (const Estimate& e : report.estimates) {
    const bool absent_diode = !e.identifiable && e.at_bound == BoundSide::kLower &&
                              e.info.name.rfind("saturation_current", 0) == 0;
    if (e.at_bound == BoundSide::kNone || absent_diode) continue;
    const double bound = e.at_bound == BoundSide::kLower ? e.bounds.lower : e.bounds.upper;
    std::string text =
        fmt::format("{} sits at its {} bound {:.6g}", e.info.symbol, ToText(e.at_bound), bound);
    if (e.info.symbol == "Rsh" && e.at_bound == BoundSide::kUpper) text += ": no shunt is visible";
    const bool ideality = e.info.symbol[0] == 'n';
    if (ideality && report.estimates.size() == 5) {
      text += ": temperature or number of cells may be wrong, or one diode is not enough";
    } else if (ideality) {
      text += ": the data would take it further, where it has no physical meaning";
    }
    out->push_back(text);
  }
}

// Above this an ideality of one diode is none of recombination in one junction.
void WarnOfIdeality(const FitReport& report, Sentences* out) {
  constexpr double kMost = 2.2;
  if (!report.curve.cells_known) return;  // then it is that of all cells together
  for (const Estimate& e : report.estimates) {
    if (e.info.symbol[0] != 'n' || !(e.refined > kMost) || e.at_bound != BoundSide::kNone) continue;
    out->push_back(fmt::format(
        "{} = {:.3g} is above 2: {}", e.info.symbol, e.refined,
        IsDark(report.curve)
            ? "tunnelling, a barrier or another junction is in it"
            : "collection, ions, a barrier or another junction is in it; Voc over light, "
              "or the dark curve, has the ideality of the junction"));
  }
}

void WarnOfRichModel(const FitReport& report, Sentences* out) {
  std::string absent;
  for (const Estimate& e : report.estimates) {
    if (e.identifiable || e.info.name.rfind("saturation_current", 0) != 0) continue;
    absent += (absent.empty() ? "" : ", ") + e.info.symbol;
  }
  const bool judged = report.no_intervals_because.empty();
  if (absent.empty() || !judged || report.model == Model::kSingleDiode) return;
  out->push_back(fmt::format(
      "{} may be 0: the data do not support this many diodes; --model auto decides", absent));
}

void WarnOfProfiles(const FitReport& report, Sentences* out) {
  const RefineReport& refine = report.refine;
  if (refine.winner >= 0 && refine.starts[refine.winner].origin == "profile") {
    out->push_back(
        "a profile came upon a lower optimum than the polish had found, which is reported here; "
        "without profiles (--intervals none or symmetric) the parameters differ");
  }
  std::string unsettled;
  for (const Estimate& e : report.estimates) {
    if (e.interval != IntervalMethod::kUnsettled) continue;
    unsettled += (unsettled.empty() ? "" : ", ") + e.info.symbol;
  }
  if (unsettled.empty()) return;
  out->push_back(fmt::format(
      "the profile of {} did not settle: the interval ends where it is known to be too wide",
      unsettled));
}

void WarnOfNoIntervals(const FitReport& report, Sentences* out) {
  if (report.no_intervals_because.empty() || !report.usable) return;
  out->push_back("no intervals: " + report.no_intervals_because);
}

void WarnOfData(const FitReport& report, Sentences* out) {
  const int copies = static_cast<int>(report.curve.size()) - report.criteria.points;
  if (copies > 0) {
    out->push_back(fmt::format(
        "{} of {} readings are exact copies of others, which tell nothing new: the {} different "
        "ones count for standard errors and intervals",
        copies, report.curve.size(), report.criteria.points));
  }
  const int spare = report.criteria.points - report.criteria.parameters;
  if (spare < 3) {
    out->push_back(fmt::format("{} points for {} parameters leave {} to judge the fit by",
                               report.criteria.points, report.criteria.parameters, spare));
  }
  if (IsDark(report.curve)) return;
  if (std::isnan(report.measured.open_circuit_voltage_V)) {
    out->push_back("the curve does not reach open circuit: n, Is and Rs rest on extrapolation");
  }
  if (std::isnan(report.measured.short_circuit_current_A)) {
    out->push_back("the curve does not reach short circuit: Iph and Rsh rest on extrapolation");
  }
}

// Warns of a current that rises with voltage by more than the noise, which is impossible for a
// passive device.
void WarnOfRisingCurrent(const FitReport& report, Sentences* out) {
  constexpr double kNoises = 6;
  constexpr double kVisible = 2e-3;  // of the largest current; of a lit curve, of those delivered
  const IvCurve& curve = report.curve;
  const double noise = NoiseFromDifferences(curve.voltage_V, report.residual_A);
  const bool dark = IsDark(curve);
  double lowest = HUGE_VAL, worst = 0, at = 0, largest = 0;
  for (const int k : OrderByVoltage(curve.voltage_V)) {
    lowest = std::min(lowest, curve.current_A[k]);
    largest = std::max(largest, dark ? std::fabs(curve.current_A[k]) : curve.current_A[k]);
    if (curve.current_A[k] - lowest <= worst) continue;
    worst = curve.current_A[k] - lowest;
    at = curve.voltage_V[k];
  }
  if (worst <= kNoises * noise || worst <= kVisible * largest) return;
  out->push_back(
      fmt::format("the current rises with voltage by {:.2g} A up to {:.4g} V, which no passive "
                  "device does: {} changed during the sweep",
                  worst, at, dark ? "the instrument" : "the light or the instrument"));
}

void WarnOfResiduals(const FitReport& report, Sentences* out) {
  if (!(report.residuals.runs_p_value < 0.01)) return;
  const bool allowed_for = report.errors && report.errors->Taken() == ErrorsTaken::kPath;
  const char* of_intervals = !report.no_intervals_because.empty() ? ""
                             : allowed_for                        ? "; the intervals allow for it"
                                           : "; the intervals are too narrow";
  out->push_back(fmt::format(
      "the residuals are not random ({} runs of one sign where {:.0f} are expected, p = {:.1g}): "
      "the model misses something, or {}{}",
      report.residuals.runs, report.residuals.expected_runs, report.residuals.runs_p_value,
      IsDark(report.curve) ? "the device warmed" : "the light wandered", of_intervals));
}

}  // namespace

std::vector<std::string> FindWarnings(const FitReport& report) {
  Sentences warnings;
  WarnOfStops(report, &warnings);
  WarnOfNoIntervals(report, &warnings);
  WarnOfBounds(report, &warnings);
  WarnOfIdeality(report, &warnings);
  WarnOfRichModel(report, &warnings);
  WarnOfProfiles(report, &warnings);
  WarnOfRisingCurrent(report, &warnings);
  WarnOfResiduals(report, &warnings);
  WarnOfData(report, &warnings);
  return warnings;
}

}  // namespace lyrefit
