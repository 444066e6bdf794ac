#include "lyrefit/diagnose/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lyrefit/base/median.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/diagnose/expectation.h"
#include "lyrefit/diagnose/reference_parts.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

std::vector<Expected<FittedSweep>> FitAll(const std::vector<IvCurve>& curves, int threads) {
  std::vector<Expected<FittedSweep>> fits(curves.size());
  ParallelFor(static_cast<int>(curves.size()), threads,
              [&](int i) { fits[i] = FitSweep(curves[i]); });
  return fits;
}

// Median residual of the references at u = V / Voc, in fractions of Isc. 0 if fewer than half of
// them have readings there.
double CommonAt(const std::vector<const SweepState*>& references, double u) {
  std::vector<double> values;
  for (const SweepState* r : references) {
    const std::vector<double>& place = r->place;
    const auto above = std::lower_bound(place.begin(), place.end(), u);
    if (above == place.end() || (above == place.begin() && *above > u)) continue;
    const std::size_t k = above - place.begin();
    const double step = k > 0 ? place[k] - place[k - 1] : 0;
    const double part = step > 0 ? (u - place[k - 1]) / step : 1;
    values.push_back(k > 0 ? r->off[k - 1] + part * (r->off[k] - r->off[k - 1]) : r->off[0]);
  }
  if (2 * values.size() < references.size() || values.empty()) return 0;
  return Median(std::move(values));
}

void TakeCommonOff(const IvCurve& curve, const SweepState& state,
                   const std::vector<const SweepState*>& references, ReferenceComparison* result) {
  result->without_common = curve;
  double squares = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const double common = CommonAt(references, curve.voltage_V[k] / state.voc_V);
    result->without_common.current_A[k] -= common * state.isc_A;
    squares += common * common;
  }
  result->common = std::sqrt(squares / static_cast<double>(curve.size()));
  result->without_common.assumptions.push_back(fmt::format(
      "what the single diodes of {} reference sweeps miss alike ({:.2g} % of Isc) is taken off the "
      "readings",
      references.size(), 100 * result->common));
}

// `voltage`: Voc beyond what that current takes, if it is known and lower; else null.
std::string LightSentence(const ReferenceRow& row, const ReferenceRow* voltage) {
  const double percent = 100 * row.power;
  if (percent < 0 && voltage != nullptr) {
    return fmt::format(
        "current per light {:+.2g} % and Voc {:+.2g} % beyond what that takes: polarisation of "
        "this "
        "face (PID-p), degradation of all cells by light and heat, or dirt on warmer cells",
        percent, 100 * voltage->power);
  }
  return fmt::format("current per light {:+.2g} %: {}", percent,
                     percent < 0 ? "soiling, a shade on all cells alike, or the light's sensor"
                                 : "the light's sensor, or reference sweeps that were soiled");
}

// `light`: a row of the current per light that differs, or null; `voltage`: see LightSentence; `whom`:
// name of the reference set in the sentence.
std::string SentenceOf(const ReferenceComparison& c, const ReferenceRow* light,
                       const ReferenceRow* voltage, const std::string& whom) {
  if (!c.differs) {
    const auto& fill = *std::find_if(c.rows.begin(), c.rows.end(),
                                     [](const ReferenceRow& row) { return row.symbol == "FF"; });
    return fmt::format(
        "The sweep agrees with {} (p = {:.2g}): the fill factor is {:.2f} %, {:.2f} % is "
        "expected.",
        whom, c.p_value, fill.now, fill.expected);
  }
  std::string text = fmt::format("The sweep differs from {} (p = {:.1g}): ", whom, c.p_value);
  for (std::size_t i = 0; i < c.causes.size(); ++i) {
    text += (i > 0 ? "; or " : "") + c.causes[i].sentence;
  }
  if (light != nullptr) {
    text += (c.causes.empty() ? "" : "; and ") + LightSentence(*light, voltage);
  }
  if (c.causes.empty() && light == nullptr) text += "no known cause explains the difference";
  return text + ".";
}

void NameSweeps(const std::vector<const SweepState*>& references, const Expectation& e,
                ReferenceComparison* result) {
  for (const int i : e.used) result->references.push_back(references[i]->name);
  for (const int i : e.outliers) {
    result->left_out.push_back(references[i]->name + ": unlike the other reference sweeps");
  }
  static const char* const kRegressors[] = {"Isc", "Voc"};
  for (int k = 1; k < e.regressors; ++k) result->regressed_on.push_back(kRegressors[k - 1]);
  const std::size_t far = references.size() - e.used.size() - e.outliers.size();
  if (far > 0) {
    result->left_out.push_back(fmt::format("{} more: the nearest in Isc and Voc were taken", far));
  }
  if (e.degrees < 2 * kQuantities) {
    result->warnings.push_back(
        fmt::format("{} reference sweeps show only large differences: with 15 and more all "
                    "parameters are judged together",
                    e.used.size()));
  }
}

// `looks`: number of sweeps compared in this way. `used` receives the references in the regression.
ReferenceComparison Compare(const FittedSweep& sweep,
                            const std::vector<const SweepState*>& references, double level,
                            int looks, std::vector<const SweepState*>* used) {
  const Expectation e = Expect(references, sweep.state);
  const Difference d = Differ(e, sweep.state);
  for (const int i : e.used) used->push_back(references[i]);
  ReferenceComparison result;
  result.name = sweep.state.name;
  NameSweeps(references, e, &result);
  result.rows = DescribeDifference(sweep, e, d);
  const std::vector<ReferenceRow> light = DescribeLight(sweep.state, *used);
  result.rows.insert(result.rows.end(), light.begin(), light.end());
  for (ReferenceRow& row : result.rows) row.differs = row.corrected_p * looks < level;
  const bool by_light = !light.empty() && result.rows.back().differs;
  const double light_p = light.empty() ? 1 : light.front().corrected_p;
  result.p_value = std::min(1.0, looks * std::min(d.p_value, light_p));
  result.differs = result.p_value < level;
  if (looks * d.p_value < level) result.causes = ExplainDifference(sweep, e, d);
  const std::vector<ReferenceRow> key_points =
      by_light ? DescribeKeyPoints(sweep.state, *used) : std::vector<ReferenceRow>();
  const bool lower =
      !key_points.empty() && key_points[1].z < 0 && key_points[1].corrected_p < level;
  result.sentence = SentenceOf(
      result, by_light ? &result.rows.back() : nullptr, lower ? &key_points[1] : nullptr,
      fmt::format(
          fmt::runtime(looks > 1 ? "the {} sweeps nearest to it" : "its {} reference sweeps"),
          result.references.size()));
  return result;
}

// Compares the key points with those of few references, at stated lights and temperatures; nothing if
// one is unknown.
std::optional<ReferenceComparison> CompareKeyPoints(
    const SweepState& now, const std::vector<const SweepState*>& references, double level) {
  ReferenceComparison result;
  result.name = now.name;
  result.rows = DescribeKeyPoints(now, references);
  if (result.rows.empty()) return std::nullopt;
  for (ReferenceRow& row : result.rows) {
    row.differs = row.corrected_p < level;
    result.p_value = std::min(result.p_value, row.corrected_p);
  }
  for (const SweepState* r : references) result.references.push_back(r->name);
  result.differs = result.p_value < level;
  result.causes = ExplainKeyPoints(result.rows);
  const std::string whom = "its " + Plural(references.size(), "reference sweep");
  const ReferenceRow& fill = result.rows[2];
  if (!result.differs || !result.causes.empty()) {
    result.sentence = SentenceOf(result, nullptr, nullptr, whom);
  } else {
    result.sentence = fmt::format("The sweep differs from {} (p = {:.1g}): fill factor {:+.1f} %.",
                                  whom, result.p_value, 100 * fill.power);
  }
  const std::string to_tell = DecidingMeasurement(result.causes);
  if (!to_tell.empty()) result.sentence += " To tell: " + to_tell + ".";
  result.warnings.push_back(fmt::format(
      "{}: judged by what sweeps of one module usually differ by {}",
      Plural(references.size(), "reference sweep"),
      now.setup == Setup::kFlash || now.setup == Setup::kLaboratory ? "indoors"
                                                                    : "outdoors (--setup)"));
  return result;
}

// Whether Isc and Voc of the sweep lie within the range of the references, or at most 20 % beyond.
Expected<void> CheckReach(const SweepState& sweep,
                          const std::vector<const SweepState*>& references) {
  constexpr double kReach = 1.2;
  const auto check = [&](double SweepState::*field, const char* what,
                         const char* unit) -> Expected<void> {
    double low = references.front()->*field, high = low;
    for (const SweepState* r : references) {
      low = std::min(low, r->*field);
      high = std::max(high, r->*field);
    }
    const double value = sweep.*field;
    if (value <= kReach * high && value * kReach >= low) return {};
    return Fail(
        fmt::format("{}: {} {:.4g} {} is more than 20 % beyond the reference sweeps' {:.4g} "
                    "to {:.4g} {}; compare it with sweeps under like light",
                    sweep.name, what, value, unit, low, high, unit));
  };
  TRY(check(&SweepState::isc_A, "Isc", "A"));
  return check(&SweepState::voc_V, "Voc", "V");
}

Expected<void> CheckOptions(const ReferenceOptions& options) {
  TRY(ValidateOptions(options, kReferenceOptionTable));
  return ValidateThreads(options.threads);
}

}  // namespace

Expected<ReferenceComparison> CompareWithReferences(const IvCurve& curve,
                                                    const std::vector<IvCurve>& reference,
                                                    const ReferenceOptions& options) {
  TRY(CheckOptions(options));
  TRY(const FittedSweep sweep, FitSweep(curve));
  const auto fits = FitAll(reference, options.threads);
  std::vector<const SweepState*> references;
  std::vector<std::string> left_out;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const Expected<FittedSweep>& fit = fits[i];
    if (reference[i].voltage_V == curve.voltage_V && reference[i].current_A == curve.current_A) {
      left_out.push_back(reference[i].name + ": it is the sweep that is compared");
    } else if (!fit) {
      left_out.push_back(fit.error().message);
    } else if (fit->state.cells != sweep.state.cells) {
      return Fail(
          fmt::format("{} has {} cells in series, the reference sweep {} has {}: compare "
                      "sweeps of one module or of its like",
                      curve.name, sweep.state.cells, fit->state.name, fit->state.cells));
    } else {
      references.push_back(&fit->state);
    }
  }
  if (references.size() < kFewestReferences) {
    if (auto few = CompareKeyPoints(sweep.state, references, options.level)) {
      few->left_out = std::move(left_out);
      few->without_common = curve;
      return std::move(*few);
    }
    return Fail(fmt::format("{} reference sweeps can be used, a comparison needs {} or more{}; {}",
                            references.size(), kFewestReferences,
                            left_out.empty() ? "" : " (" + left_out.front() + ")", kSideBySide));
  }
  TRY(CheckReach(sweep.state, references));
  std::vector<const SweepState*> used;
  ReferenceComparison result = Compare(sweep, references, options.level, 1, &used);
  result.left_out.insert(result.left_out.begin(), left_out.begin(), left_out.end());
  TakeCommonOff(curve, sweep.state, used, &result);
  return result;
}

Expected<OutlierSweeps> FindOutlierSweeps(const std::vector<IvCurve>& curves,
                                          const ReferenceOptions& options) {
  TRY(CheckOptions(options));
  const auto fits = FitAll(curves, options.threads);
  OutlierSweeps result;
  std::vector<const FittedSweep*> sweeps;
  for (const auto& fit : fits) {
    if (!fit) {
      result.rejected.push_back(fit.error().message);
    } else if (!sweeps.empty() && fit->state.cells != sweeps.front()->state.cells) {
      return Fail(
          fmt::format("{} has {} cells in series, {} has {}: these are not sweeps of one "
                      "module",
                      fit->state.name, fit->state.cells, sweeps.front()->state.name,
                      sweeps.front()->state.cells));
    } else {
      sweeps.push_back(&*fit);
    }
  }
  const int count = static_cast<int>(sweeps.size());
  if (count <= kFewestReferences) {
    return Fail(fmt::format("{} sweeps can be compared with each other, that takes {} or more; {}",
                            count, kFewestReferences + 1, kSideBySide));
  }
  // Two rounds: outliers of the first round are no references in the second.
  std::vector<char> outlier(count, 0);
  std::vector<ReferenceComparison> found(count);
  std::vector<char> compared(count, 0);
  for (const bool last : {false, true}) {
    std::vector<char> now(count, 0);
    ParallelFor(count, options.threads, [&](int i) {
      std::vector<const SweepState*> others;
      for (int k = 0; k < count; ++k) {
        if (k != i && outlier[k] == 0) others.push_back(&sweeps[k]->state);
      }
      if (others.size() < kFewestReferences || !CheckReach(sweeps[i]->state, others)) return;
      compared[i] = 1;
      if (last) {
        std::vector<const SweepState*> used;
        found[i] = Compare(*sweeps[i], others, options.level, count, &used);
      } else {
        const SweepState& state = sweeps[i]->state;
        now[i] = Differ(Expect(others, state), state).p_value < options.level ? 1 : 0;
      }
    });
    outlier = now;
  }
  for (int i = 0; i < count; ++i) {
    if (compared[i] == 0) {
      result.rejected.push_back(sweeps[i]->state.name + ": no other sweeps under like light");
      continue;
    }
    result.outlier += found[i].differs ? 1 : 0;
    result.sweeps.push_back(std::move(found[i]));
  }
  std::stable_sort(result.sweeps.begin(), result.sweeps.end(),
                   [](const auto& a, const auto& b) { return a.p_value < b.p_value; });
  return result;
}

}  // namespace lyrefit
