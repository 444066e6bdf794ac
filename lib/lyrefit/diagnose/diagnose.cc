#include "lyrefit/diagnose/diagnose.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lyrefit/base/median.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/curve/check_readings.h"
#include "lyrefit/curve/sweep_order.h"
#include "lyrefit/diagnose/average.h"
#include "lyrefit/diagnose/choose_base.h"
#include "lyrefit/diagnose/describe.h"
#include "lyrefit/diagnose/evidence.h"
#include "lyrefit/diagnose/experiment_design.h"
#include "lyrefit/diagnose/extended_report.h"
#include "lyrefit/diagnose/held_out.h"
#include "lyrefit/diagnose/known_effects.h"
#include "lyrefit/diagnose/measurement.h"
#include "lyrefit/diagnose/select.h"
#include "lyrefit/diagnose/verdict.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/model/effects/catalogue.h"

namespace lyrefit {
namespace {

constexpr double kPollPeriod_s = 0.02;  // shortest time between calls of the observer by polls

// Selects causes, and repeats the selection with whitened noise if the residuals of the extended
// model are correlated. Without whitening, correlated noise makes every test see effects.
Autocorrelation SelectWhitened(const Measurement& measurement, const SelectOptions& options,
                               Selection* selection) {
  // A larger correlation is rather structure that no cause explains than noise.
  constexpr double kNotable = 0.08, kSure = 1, kLargest = 0.5;
  const Readings& readings = measurement.readings;
  const std::vector<char> used(readings.points.size(), 1);
  *selection = SelectCauses(measurement, used, 0, options);
  if (!selection->base.usable || options.progress.Stopped()) return {};
  std::vector<double> whitened;
  for (std::size_t k = 0; k < readings.points.size(); ++k) {
    whitened.push_back((selection->extended.current[k] - readings.points[k].current) /
                       selection->weighted.sigma[k]);
  }
  const Autocorrelation correlation =
      EstimateAutocorrelation(readings, whitened, selection->weighted.used,
                              FreeCount(selection->weighted, selection->extended.law));
  const bool coarse = IsCoarse(measurement, selection->noise);
  if (!measurement.has_path() && !coarse && correlation.value > kNotable &&
      correlation.value > kSure * correlation.standard_error) {
    Selection again =
        SelectCauses(measurement, used, std::min(correlation.value, kLargest), options);
    if (again.base.usable) *selection = std::move(again);
  }
  return correlation;
}

void DescribePoints(const CurveSet& set, const Measurement& measurement, const AtReadings& at,
                    Diagnosis* diagnosis) {
  const Readings& readings = measurement.readings;
  const double scale = readings.scale.current_A;
  for (const IvCurve& curve : set.curves) {
    diagnosis->curves.push_back({curve.name, curve.conditions.irradiance_W_m2,
                                 curve.conditions.cell_temperature_K - kZeroCelsius_K, false,
                                 static_cast<int>(curve.size())});
  }
  for (std::size_t k = 0; k < readings.points.size(); ++k) {
    const Reading& r = readings.points[k];
    const IvCurve& curve = set.curves[r.curve];
    diagnosis->curves[r.curve].dark = r.dark;
    DiagnosedPoint point;
    point.curve = r.curve;
    point.segment = r.segment;
    point.voltage_V = curve.voltage_V[r.index];
    point.current_A = curve.current_A[r.index];
    point.sigma_A = at.weighted.sigma[k] * scale;
    point.before_A = at.base[k] * scale;
    point.after_A = at.extended[k] * scale;
    point.without_A = at.without[k] * scale;
    point.time_s = curve.time_s.empty() ? kUnknown : curve.time_s[r.index];
    diagnosis->points.push_back(point);
  }
  // The instrument limit applies to the base model's currents as well.
  for (const int k : measurement.values.at_lower) {
    DiagnosedPoint& point = diagnosis->points[k];
    point.before_A = std::max(point.before_A, measurement.values.lower_limit * scale);
  }
}

void DescribeGain(const Selection& selection, const AtReadings& at, bool field, Gain* gain) {
  gain->rmse_before_A = RmseOf(at.weighted, at.base);
  gain->rmse_after_A = RmseOf(at.weighted, at.extended);
  gain->shifts = DescribeShifts(selection);
  gain->gain = gain->folds > 1 && gain->held_out_gain_A2 > gain->held_out_gain_error_A2;
  if (selection.causes.empty() && selection.outliers.empty()) {
    gain->sentence = "no cause that can be modelled was found, so there is nothing to gain";
  } else if (gain->folds < 2) {
    gain->sentence = "not measured on readings that were not fitted";
  } else {
    const std::string held_out = gain->by_sweeps ? "whole sweeps" : "readings";
    gain->sentence =
        gain->gain ? "the gain holds on " + held_out + " that were not fitted"
                   : "no gain on " + held_out + " that were not fitted: within its standard error";
    if (field && !gain->by_sweeps) {
      gain->sentence +=
          "; they are of the sweep that was fitted, and within one sweep nothing held out tells a "
          "fault from the model's own error, which is in it as well (three sweeps or more would)";
    }
  }
}

void AddWarnings(const Selection& selection, const Measurement& measurement, Diagnosis* diagnosis) {
  diagnosis->warnings = diagnosis->doubts;
  diagnosis->warnings.insert(diagnosis->warnings.end(), measurement.warnings.begin(),
                             measurement.warnings.end());
  if (selection.weighted.correlation > 0) {
    diagnosis->warnings.push_back(
        "the noise of neighbouring readings is correlated; p-values allow for it, but trust them "
        "less");
  }
  if (!selection.at_rest.empty()) {
    diagnosis->warnings.push_back(
        std::to_string(selection.at_rest.size()) +
        " readings at ends of a sweep, where its voltage stood still, are left out beside what "
        "depends on its rate");
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

SelectOptions MakeSelectOptions(const Readings& readings, const DiagnoseOptions& options,
                                const std::vector<const Effect*>& candidates,
                                const ProgressReporter& progress) {
  SelectOptions select;
  select.level = options.level;
  select.draws = options.draws;
  select.largest_causes = options.largest_causes;
  select.seed = options.seed;
  select.floors = {options.floor_current, options.floor_power};
  select.base = StartingLaw(readings, options.base);
  select.candidates = candidates;
  select.progress = progress;
  return select;
}

Diagnosis BeginDiagnosis(const CurveSet& set, const Measurement& measurement,
                         const DiagnoseOptions& options) {
  Diagnosis diagnosis;
  diagnosis.version = Version();
  diagnosis.name = set.curves.size() == 1 || set.name.empty() ? set.curves.front().name : set.name;
  diagnosis.source = set.source.empty() ? set.curves.front().source : set.source;
  diagnosis.base = ToText(options.base);
  diagnosis.seed = options.seed;
  diagnosis.level = options.level;
  diagnosis.floor_current = options.floor_current;
  diagnosis.floor_power = options.floor_power;
  diagnosis.cells_in_series = measurement.readings.scale.cells;
  diagnosis.non_default_options = NonDefaults(options, kDiagnoseOptionTable);
  for (const IvCurve& curve : set.curves) {
    for (const std::string& sentence : SentencesOf(curve.assumptions)) {
      auto& all = diagnosis.assumptions;
      if (std::find(all.begin(), all.end(), sentence) == all.end()) all.push_back(sentence);
    }
  }
  return diagnosis;
}

void ForgetLimits(ValueFindings* values) {
  values->clip_level = 0;
  values->clipped.clear();
  values->limited = false;
  values->at_lower.clear();
  values->at_voltage_limit.clear();
}

// Result of the selection on readings or, in a long measurement, on averages of them.
struct Outcome {
  Selection found;
  AtReadings at;
  Autocorrelation correlation;
};

Outcome SearchCauses(const Measurement& measurement, const SelectOptions& select,
                     const DiagnoseOptions& options, const std::vector<const Effect*>& known,
                     Diagnosis* diagnosis) {
  const bool is_long = IsLong(measurement.readings);
  const Averaged averaged =
      is_long ? Average(measurement, select.base, select.progress) : Averaged();
  const Measurement& seen = is_long ? averaged.measurement : measurement;
  Outcome outcome;
  outcome.correlation = SelectWhitened(seen, select, &outcome.found);
  if (!outcome.found.base.usable) return outcome;
  FindFittedCandidates(select, &outcome.found);
  outcome.at =
      is_long ? AtItsReadings(outcome.found, averaged, measurement) : AtItsReadings(outcome.found);
  diagnosis->trials =
      DescribeTrials(measurement.readings, outcome.found, known, select.candidates, options);
  if (options.held_out && !select.progress.Stopped()) {
    MeasureHeldOut(seen, select, outcome.found, options.folds, options.threads, &diagnosis->gain,
                   &diagnosis->trials);
  }
  return outcome;
}

Expected<void> CheckOptions(const DiagnoseOptions& options) {
  TRY(ValidateOptions(options, kDiagnoseOptionTable));
  TRY(ValidateThreads(options.threads));
  if (options.base == Model::kTripleDiode) return Fail("the base of a diagnosis is sd or dd");
  return {};
}

// Makes the measurement from curves in order. `disorder`: warnings about their order.
Expected<Measurement> TakeIn(const CurveSet& set, const std::vector<std::string>& disorder,
                             const DiagnoseOptions& options) {
  TRY(Measurement measurement, MakeMeasurement(set));
  measurement.warnings.insert(measurement.warnings.begin(), disorder.begin(), disorder.end());
  measurement.errors = options.noise;
  if (!IsWanted(*FindEffect("clip"), options)) ForgetLimits(&measurement.values);
  return measurement;
}

void DescribeEvidenceAndVerdict(const Measurement& measurement, const Outcome& outcome,
                                const DiagnoseOptions& options, Diagnosis* diagnosis) {
  const Selection& found = outcome.found;
  const AtReadings& at = outcome.at;
  const Readings& readings = measurement.readings;
  diagnosis->base_sentence = DescribeLaw(readings, found.base.law);
  Evidence& evidence = diagnosis->evidence;
  evidence = DescribeEvidence(found, at, measurement.values, outcome.correlation);
  if (measurement.noise_is_stated()) {
    evidence.noise_stated_A = UpperMedian(at.weighted.sigma) * readings.scale.current_A;
  }
  evidence.whiteness_p_value = Whiteness(found.base_weighted, found.base);
  evidence.whiteness_after_p_value = Whiteness(found.weighted, found.extended);
  diagnosis->verdict = Decide(measurement, found, at, options, evidence.whiteness_after_p_value);
}

void MarkInterrupted(Diagnosis* diagnosis) {
  diagnosis->interrupted = true;
  Verdict& verdict = diagnosis->verdict;
  verdict.sentence = verdict.found ? "Stopped early; so far: " + verdict.sentence
                                   : "Stopped early: nothing was found so far.";
}

}  // namespace

Expected<void> ReadBaseModel(const std::string& text, DiagnoseOptions* options) {
  const std::optional<Model> model = FromText<Model>(text);
  if (!model || *model == Model::kTripleDiode) {
    return Fail("expected sd or dd, found '" + text + "'");
  }
  options->base = *model;
  return {};
}

Expected<void> ReadEffectIds(const std::string& text, DiagnoseOptions* options) {
  options->effects.clear();
  if (text.empty()) return {};
  TRY(options->effects, SplitList(text));
  return {};
}

std::vector<std::string> OwnEffectIds(const DiagnoseOptions& options) {
  if (options.own_effects.empty()) return {"none"};
  std::vector<std::string> ids;
  for (const Effect* own : options.own_effects) ids.push_back(own->id);
  return {JoinList(ids)};
}

Expected<Diagnosis> Diagnose(const CurveSet& taken, const DiagnoseOptions& options,
                             const Observer& observer) {
  const Instant begin = Now();
  TRY(CheckOptions(options));
  TRY(const auto known, KnownEffects(options));
  TRY(auto doubts, JudgeReadings(taken.curves));
  std::vector<std::string> disorder;
  const CurveSet set = InOrder(taken, &disorder);
  TRY(const Measurement measurement, TakeIn(set, disorder, options));
  const Readings& readings = measurement.readings;
  const ProgressReporter progress(observer, kPollPeriod_s);
  progress.Begin("base fit", 3);
  const SelectOptions select =
      MakeSelectOptions(readings, options, Candidates(known, readings.traits, options), progress);
  Diagnosis diagnosis = BeginDiagnosis(set, measurement, options);
  diagnosis.doubts = std::move(doubts);
  const Outcome outcome = SearchCauses(measurement, select, options, known, &diagnosis);
  const Selection& found = outcome.found;
  if (!found.base.usable || !found.extended.usable) {
    return Fail(diagnosis.name + (progress.Stopped() ? ": stopped before the base model was fitted"
                                                     : ": no diode model fits these readings"));
  }
  DescribeEvidenceAndVerdict(measurement, outcome, options, &diagnosis);
  DescribeGain(found, outcome.at, measurement.has_path(), &diagnosis.gain);
  if (options.plan && !progress.Stopped()) {
    diagnosis.plan = MakePlan(found, options.seed, options.threads);
  }
  DescribePoints(set, measurement, outcome.at, &diagnosis);
  AddWarnings(found, measurement, &diagnosis);
  if (progress.Stopped()) MarkInterrupted(&diagnosis);
  diagnosis.extended = ExtendedReport(
      set, found, outcome.at, options.extend && !diagnosis.interrupted, options.seed, observer);
  diagnosis.interrupted = diagnosis.interrupted || diagnosis.extended.interrupted;
  diagnosis.seconds = SecondsSince(begin);
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
