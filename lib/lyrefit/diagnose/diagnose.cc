#include "lyrefit/diagnose/diagnose.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "lyrefit/base/version.h"
#include "lyrefit/curve/check_readings.h"
#include "lyrefit/diagnose/describe.h"
#include "lyrefit/diagnose/evidence.h"
#include "lyrefit/diagnose/extended_report.h"
#include "lyrefit/diagnose/held_out.h"
#include "lyrefit/diagnose/make_readings.h"
#include "lyrefit/diagnose/select.h"
#include "lyrefit/diagnose/values.h"
#include "lyrefit/effects/catalogue.h"

namespace lyrefit {
namespace {

Expected<std::vector<const Effect*>> Candidates(const DataTraits& traits,
                                                const DiagnoseOptions& options) {
  for (const std::string& id : options.effects) {
    if (FindEffect(id) == nullptr) return Fail("there is no effect '" + id + "'");
  }
  const auto wanted = [&](const Effect* effect) {
    const std::vector<std::string>& ids = options.effects;
    return ids.empty() || std::find(ids.begin(), ids.end(), effect->id) != ids.end();
  };
  std::vector<const Effect*> candidates;
  for (const Effect* effect : Catalogue()) {
    const std::string id = effect->id;
    const bool scored = effect->probes != nullptr || id == "outliers" || id == "unknown_structure";
    if (!scored || !wanted(effect) || effect->why_not(traits)) continue;
    if (options.base == Model::kDoubleDiode && id == "second_diode") continue;
    candidates.push_back(effect);
  }
  return candidates;
}

// Noise that is correlated from reading to reading makes every test see effects: where the
// residuals of the extended model show it, everything is done again with it taken out.
Autocorrelation SelectWhitened(const Measurement& measurement, const DeviceNotes& notes,
                               const ValueFindings& values, const SelectOptions& options,
                               Selection* selection) {
  // More than the largest is rather structure that no cause took away than noise.
  constexpr double kNotable = 0.08, kSure = 1, kLargest = 0.5;
  const Readings& readings = measurement.readings;
  const std::vector<char> used(readings.points.size(), 1);
  *selection = SelectCauses(readings, measurement.dark, notes, used, values, 0, options);
  std::vector<double> whitened;
  for (std::size_t k = 0; k < readings.points.size(); ++k) {
    whitened.push_back((selection->extended.current[k] - readings.points[k].current) /
                       selection->bench.sigma[k]);
  }
  const Autocorrelation correlation =
      EstimateAutocorrelation(readings, whitened, selection->bench.used,
                              FreeCount(selection->bench, selection->extended.law));
  const bool coarse = IsCoarse(readings, measurement.dark, selection->noise, values.grids);
  if (!coarse && correlation.value > kNotable &&
      correlation.value > kSure * correlation.standard_error) {
    *selection = SelectCauses(readings, measurement.dark, notes, used, values,
                              std::min(correlation.value, kLargest), options);
  }
  return correlation;
}

void DescribePoints(const CurveSet& set, const Measurement& measurement, const Selection& selection,
                    Diagnosis* diagnosis) {
  const Readings& readings = measurement.readings;
  const double scale = readings.scale.current_A;
  for (std::size_t c = 0; c < set.curves.size(); ++c) {
    const IvCurve& curve = set.curves[c];
    diagnosis->curves.push_back({curve.name, curve.conditions.irradiance_W_m2,
                                 curve.conditions.cell_temperature_K - kZeroCelsius_K,
                                 measurement.dark[c] != 0, static_cast<int>(curve.size())});
  }
  std::size_t in_curve = 0;
  for (std::size_t k = 0; k < readings.points.size(); ++k) {
    const Reading& r = readings.points[k];
    if (k == 0 || r.curve != readings.points[k - 1].curve) in_curve = 0;
    const IvCurve& curve = set.curves[r.curve];
    DiagnosedPoint point;
    point.curve = r.curve;
    point.segment = r.segment;
    point.voltage_V = curve.voltage_V[in_curve];
    point.current_A = curve.current_A[in_curve];
    point.sigma_A = selection.bench.sigma[k] * scale;
    point.before_A = selection.base.current[k] * scale;
    point.after_A = selection.extended.current[k] * scale;
    point.time_s = curve.time_s.empty() ? kUnknown : curve.time_s[in_curve];
    diagnosis->points.push_back(point);
    ++in_curve;
  }
}

Cause QuantisationCause(const Readings& readings, const ValueFindings& values) {
  Cause cause = MakeCause("quantisation", "values", 0);
  const double finest = values.grids.lit > 0 ? values.grids.lit : values.grids.dark;
  const double step = finest * readings.scale.current_A;
  cause.strength = {{"q", "resolution", "A", step, step, step, false}};
  cause.sentence += "; " + StrengthText(cause.strength.front());
  return cause;
}

Cause UnknownCause(const Selection& selection, double whiteness_after) {
  Cause cause =
      MakeCause("unknown_structure", "fit", std::min(selection.unknown_p, whiteness_after));
  cause.separate_by = {FindEffect(cause.id)->separate_by};
  return cause;
}

std::string VerdictSentence(const Verdict& verdict) {
  if (verdict.unexplained && verdict.causes.front().id == "unknown_structure") {
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

// Whether what the causes leave is certainly not noise.
bool Remains(const Selection& selection, double whiteness_after) {
  constexpr double kCertain = 1e-3;
  return selection.unknown_p < kCertain || whiteness_after < kCertain ||
         selection.bench.correlation >= 0.5;
}

Verdict Decide(const Measurement& measurement, const Selection& selection,
               const ValueFindings& values, const DiagnoseOptions& options,
               double whiteness_after) {
  const Readings& readings = measurement.readings;
  Verdict verdict;
  verdict.causes = DescribeCauses(selection, values);
  const auto wanted = [&](const char* id) {
    return options.effects.empty() ||
           std::find(options.effects.begin(), options.effects.end(), id) != options.effects.end();
  };
  if (wanted("quantisation") &&
      IsCoarse(readings, measurement.dark, selection.noise, values.grids)) {
    verdict.causes.push_back(QuantisationCause(readings, values));
  }
  if (wanted("temperature_or_cells")) {
    for (Cause& cause : CheckTemperatureAndCells(selection)) verdict.causes.push_back(cause);
  }
  std::stable_sort(verdict.causes.begin(), verdict.causes.end(),
                   [](const Cause& a, const Cause& b) { return a.corrected_p < b.corrected_p; });
  constexpr double kNeverNoise = 1e-6;
  const bool unknown = selection.unknown || whiteness_after < kNeverNoise;
  if (unknown && verdict.causes.empty()) {
    verdict.unexplained = true;
    verdict.causes.push_back(UnknownCause(selection, whiteness_after));
  }
  verdict.found = !verdict.causes.empty();
  if (verdict.found && Remains(selection, whiteness_after)) verdict.unexplained = true;
  for (const Inseparable& open : InseparableCauses()) {
    if (!open.applies(readings.traits)) continue;
    verdict.cannot_be_excluded.push_back({open.id, open.biases, open.sentence, open.separate_by});
  }
  verdict.sentence = VerdictSentence(verdict);
  return verdict;
}

void DescribeGain(const Selection& selection, Gain* gain) {
  gain->rmse_before_A = RmseOf(selection.bench, selection.base.current);
  gain->rmse_after_A = RmseOf(selection.bench, selection.extended.current);
  gain->shifts = DescribeShifts(selection);
  gain->gain = gain->folds > 1 && gain->held_out_gain_A2 > gain->held_out_gain_error_A2;
  if (selection.causes.empty() && selection.outliers.empty()) {
    gain->sentence = "no cause that can be modelled was found, so there is nothing to gain";
  } else if (gain->folds < 2) {
    gain->sentence = "not measured on readings that were not fitted";
  } else if (gain->gain) {
    gain->sentence = "the gain holds on readings that were not fitted";
  } else {
    gain->sentence = "no gain on readings that were not fitted: within its standard error";
  }
}

void AddWarnings(const Selection& selection, const Measurement& measurement, Diagnosis* diagnosis) {
  diagnosis->warnings = diagnosis->doubts;
  diagnosis->warnings.insert(diagnosis->warnings.end(), measurement.warnings.begin(),
                             measurement.warnings.end());
  if (selection.bench.correlation > 0) {
    diagnosis->warnings.push_back(
        "the noise of neighbouring readings is correlated; p-values allow for it, but trust them "
        "less");
  }
  if (selection.unknown_p < diagnosis->level && !selection.unknown) {
    diagnosis->warnings.push_back(
        "structure remains in the residuals that no further cause explains");
  }
  if (selection.noise.lit.constant < 1e-6 && selection.noise.lit.relative < 1e-6) {
    diagnosis->warnings.push_back(
        "the readings have almost no noise, as if they were computed: p-values say little");
  }
}

bool Stopped(const Observer& observer, const char* stage, std::int64_t at, Diagnosis* diagnosis) {
  Progress progress;
  progress.stage = stage;
  progress.iteration = at;
  progress.iterations = 3;
  diagnosis->interrupted = diagnosis->interrupted || StopRequested(observer, progress);
  return diagnosis->interrupted;
}

}  // namespace

Expected<Diagnosis> Diagnose(const CurveSet& set, const DiagnoseOptions& options,
                             const Observer& observer) {
  const auto begin = std::chrono::steady_clock::now();
  if (auto valid = ValidateOptions(options, kDiagnoseOptionRows); !valid) {
    return tl::unexpected(valid.error());
  }
  if (options.base == Model::kTripleDiode) return Fail("the base of a diagnosis is sd or dd");
  const auto doubts = JudgeReadings(set.curves);
  if (!doubts) return tl::unexpected(doubts.error());
  auto measurement = MakeReadings(set);
  if (!measurement) return tl::unexpected(measurement.error());
  const Readings& readings = measurement->readings;
  auto candidates = Candidates(readings.traits, options);
  if (!candidates) return tl::unexpected(candidates.error());
  SelectOptions select;
  select.level = options.level;
  select.draws = options.draws;
  select.largest_causes = options.largest_causes;
  select.seed = options.seed;
  select.second_diode = options.base == Model::kDoubleDiode;
  select.candidates = *candidates;
  const DeviceNotes& notes = set.curves.front().notes;
  ValueFindings values = LookAtValues(readings, measurement->dark);
  if (!options.effects.empty() &&
      std::find(options.effects.begin(), options.effects.end(), "clip") == options.effects.end()) {
    values.clip_level = 0;
    values.clipped.clear();
  }
  Diagnosis diagnosis;
  diagnosis.version = Version();
  diagnosis.doubts = *doubts;
  diagnosis.name = set.curves.size() == 1 || set.name.empty() ? set.curves.front().name : set.name;
  diagnosis.source = set.source.empty() ? set.curves.front().source : set.source;
  diagnosis.base = ToText(options.base);
  diagnosis.base_sentence =
      std::string(select.second_diode ? "two diodes (n2 = 2) and six" : "one diode and five") +
      " parameters for all readings, photocurrent in proportion to light, Rsh that does not know "
      "the light";
  diagnosis.seed = options.seed;
  diagnosis.level = options.level;
  diagnosis.cells_in_series = readings.scale.cells;
  AppendNonDefaults(options, kDiagnoseOptionRows, &diagnosis.non_default_options);
  Selection selection;
  const Autocorrelation correlation =
      SelectWhitened(*measurement, notes, values, select, &selection);
  if (!selection.base.usable) return Fail(diagnosis.name + ": no diode model fits these readings");
  FindRivals(select, &selection);
  diagnosis.trials = DescribeTrials(readings, selection, *candidates);
  if (options.held_out && !Stopped(observer, "held out", 1, &diagnosis)) {
    MeasureHeldOut(readings, measurement->dark, notes, values, select, selection, options.folds,
                   options.threads, &diagnosis.gain, &diagnosis.trials);
  }
  diagnosis.evidence = DescribeEvidence(selection, values, correlation);
  diagnosis.verdict =
      Decide(*measurement, selection, values, options, diagnosis.evidence.whiteness_after_p_value);
  DescribeGain(selection, &diagnosis.gain);
  DescribePoints(set, *measurement, selection, &diagnosis);
  AddWarnings(selection, *measurement, &diagnosis);
  for (const IvCurve& curve : set.curves) {
    for (const std::string& sentence : curve.assumptions) {
      auto& all = diagnosis.assumptions;
      if (std::find(all.begin(), all.end(), sentence) == all.end()) all.push_back(sentence);
    }
  }
  const bool search = options.extend && !Stopped(observer, "search", 2, &diagnosis);
  diagnosis.extended = ExtendedReport(set, selection, search, options.seed, observer);
  diagnosis.interrupted = diagnosis.interrupted || diagnosis.extended.interrupted;
  diagnosis.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return diagnosis;
}

Expected<Diagnosis> Diagnose(const IvCurve& curve, const DiagnoseOptions& options,
                             const Observer& observer) {
  CurveSet set;
  set.name = curve.name;
  set.source = curve.source;
  set.curves = {curve};
  return Diagnose(set, options, observer);
}

}  // namespace lyrefit
