#include "lyrefit/diagnose/diagnose.h"

#include <algorithm>

#include "lyrefit/base/median.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/curve/beyond_voc.h"
#include "lyrefit/curve/check_readings.h"
#include "lyrefit/curve/curve_kind.h"
#include "lyrefit/curve/sweep_order.h"
#include "lyrefit/diagnose/average.h"
#include "lyrefit/diagnose/decision_constants.h"
#include "lyrefit/diagnose/describe.h"
#include "lyrefit/diagnose/device_findings.h"
#include "lyrefit/diagnose/known_effects.h"
#include "lyrefit/diagnose/law_coordinates.h"
#include "lyrefit/diagnose/measurement.h"
#include "lyrefit/diagnose/select.h"
#include "lyrefit/diagnose/verdict.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/estimate/refine/error_sizes.h"
#include "lyrefit/read/cells.h"

namespace lyrefit {
namespace {

constexpr double kPollPeriod_s = 0.02;  // shortest time between calls of the observer by polls

// A selection of causes and the autocorrelation of its first residuals.
struct WhitenedSelection {
  Selection found;
  Autocorrelation correlation;
};

// Selects causes, and repeats the selection with whitened noise if the residuals of the extended
// model are correlated. Without whitening, correlated noise makes every test see effects.
WhitenedSelection SelectWhitened(const Measurement& measurement, const SelectOptions& options) {
  // A larger correlation is rather structure that no cause explains than noise.
  constexpr double kCorrelated = 0.08, kSure = 1, kLargest = 0.5;
  const Readings& readings = measurement.readings;
  const std::vector<char> used(readings.points.size(), 1);
  Selection first = SelectCauses(measurement, used, 0, options);
  if (!first.base.usable || options.progress.Stopped()) return {std::move(first), {}};
  std::vector<double> whitened;
  for (std::size_t k = 0; k < readings.points.size(); ++k) {
    whitened.push_back((first.extended.current[k] - readings.points[k].current) /
                       first.weighted.sigma[k]);
  }
  const Autocorrelation correlation = EstimateAutocorrelation(
      readings, whitened, first.weighted.used, FreeCount(first.weighted, first.extended.law));
  const bool coarse = IsCoarse(measurement, first.noise);
  if (!measurement.has_path() && !coarse && correlation.value > kCorrelated &&
      correlation.value > kSure * correlation.standard_error) {
    Selection again =
        SelectCauses(measurement, used, std::min(correlation.value, kLargest), options);
    if (again.base.usable) return {std::move(again), correlation};
  }
  return {std::move(first), correlation};
}

std::vector<DiagnosedCurve> DescribeCurves(const CurveSet& set, const Readings& readings) {
  std::vector<DiagnosedCurve> curves;
  for (const IvCurve& curve : set.curves) {
    curves.push_back({curve.name, curve.conditions.irradiance_W_m2,
                      curve.conditions.cell_temperature_K - kZeroCelsius_K, false,
                      static_cast<int>(curve.size())});
  }
  for (const Reading& r : readings.points) curves[r.curve].dark = r.dark;
  return curves;
}

std::vector<DiagnosedPoint> DescribePoints(const CurveSet& set, const Measurement& measurement,
                                           const AtReadings& at) {
  const Readings& readings = measurement.readings;
  const double scale = readings.scale.current_A;
  std::vector<DiagnosedPoint> points;
  points.reserve(readings.points.size());
  for (std::size_t k = 0; k < readings.points.size(); ++k) {
    const Reading& r = readings.points[k];
    const IvCurve& curve = set.curves[r.curve];
    DiagnosedPoint& point = points.emplace_back();
    point.curve = r.curve;
    point.segment = r.segment;
    point.voltage_V = curve.voltage_V[r.index];
    point.current_A = curve.current_A[r.index];
    point.sigma_A = at.weighted.sigma[k] * scale;
    point.before_A = at.base[k] * scale;
    point.after_A = at.extended[k] * scale;
    point.without_A = at.without[k] * scale;
    point.time_s = curve.time_s.empty() ? kUnknown : curve.time_s[r.index];
  }
  // The instrument limit applies to the base model's currents as well.
  for (const int k : measurement.values.at_lower) {
    if (!measurement.values.limited) break;
    points[k].before_A = std::max(points[k].before_A, measurement.values.lower_limit * scale);
  }
  return points;
}

std::string DescribeGain(const Selection& selection, const HeldOutErrors& held_out, bool field) {
  if (selection.causes.empty() && selection.outliers.empty()) {
    return "no cause that can be modelled was found, so there is nothing to gain";
  }
  if (held_out.folds < 2) return "not measured on readings that were not fitted";
  const std::string parts = held_out.by_sweeps ? "whole sweeps" : "readings";
  if (held_out.after_A > held_out.before_A) {
    return "worse on " + parts + " that were not fitted: no gain";
  }
  std::string sentence = held_out.gained() ? "the gain holds on " + parts + " that were not fitted"
                                           : "no gain on " + parts +
                                                 " that were not fitted: within its standard error";
  if (!field || held_out.by_sweeps) return sentence;
  return sentence +
         ". They are of the sweep that was fitted, so the model's own error is in them as well, "
         "and they cannot tell a fault from it. Three sweeps or more could";
}

Gain MeasureGain(const Selection& selection, const AtReadings& at, const HeldOutErrors& held_out,
                 bool field) {
  Gain gain;
  gain.rmse_before_A = RmseOf(at.weighted, at.base);
  gain.rmse_after_A = RmseOf(at.weighted, at.extended);
  gain.held_out_before_A = held_out.before_A;
  gain.held_out_after_A = held_out.after_A;
  gain.held_out_gain_A2 = held_out.gain_A2;
  gain.held_out_gain_error_A2 = held_out.gain_error_A2;
  gain.gain = held_out.gained();
  gain.folds = held_out.folds;
  gain.by_sweeps = held_out.by_sweeps;
  gain.sentence = DescribeGain(selection, held_out, field);
  gain.shifts = DescribeShifts(selection);
  return gain;
}

// `said`: the verdict says that structure remains.
std::vector<std::string> FindWarnings(const Selection& selection, const Measurement& measurement,
                                      const std::vector<std::string>& doubts, bool said) {
  std::vector<std::string> warnings = doubts;
  warnings.insert(warnings.end(), measurement.warnings.begin(), measurement.warnings.end());
  if (selection.weighted.correlation > 0) {
    warnings.emplace_back(
        "the noise of neighbouring readings is correlated; p-values allow for it, but trust them "
        "less");
  }
  if (!selection.at_rest.empty()) {
    warnings.push_back(std::to_string(selection.at_rest.size()) +
                       " readings at ends of a sweep, where its voltage stood still, are left out "
                       "beside what depends on its rate");
  }
  if (selection.incomplete > 0.5 && !selection.causes.empty() && !said) {
    warnings.emplace_back("structure remains in the residuals that no further cause explains");
  }
  if (selection.noise.lit.constant < 1e-6 && selection.noise.lit.relative < 1e-6) {
    warnings.emplace_back(
        "the readings have almost no noise, as if they were computed: p-values say little");
  }
  return warnings;
}

Expected<void> CheckOptions(const DiagnoseOptions& options) {
  TRY(ValidateOptions(options, kDiagnoseOptionTable));
  TRY(ValidateThreads(options.threads));
  if (options.base == Model::kTripleDiode) return Fail("the base of a diagnosis is sd or dd");
  return {};
}

void ForgetLimits(ValueFindings* values) {
  values->clip_level = 0;
  values->clipped.clear();
  values->limited = false;
  values->at_lower.clear();
  values->at_voltage_limit.clear();
}

// The input of a diagnosis.
struct PreparedDiagnosis {
  CurveSet set;  // its curves in order
  DiagnoseOptions options;
  JudgedSetup setup;
  std::vector<const Effect*> known;  // effects
  std::vector<std::string> doubts;   // about the readings
  Measurement measurement;
};

Expected<PreparedDiagnosis> Prepare(const CurveSet& given, const DiagnoseOptions& options) {
  TRY(CheckOptions(options));
  PreparedDiagnosis prepared;
  prepared.options = options;
  prepared.setup = SetupOf(given, options);
  TRY(prepared.known, KnownEffects(options, prepared.setup.setup));
  std::vector<std::string> disorder;
  const auto under_load = [](const IvCurve& curve) { return !curve.suns_voc_A; };
  if (std::none_of(given.curves.begin(), given.curves.end(), under_load)) {
    return Fail(
        "a Suns-Voc trace, open-circuit voltages over light: series resistance and unlike cells "
        "are "
        "not in it; give the curve under load beside it (--together)");
  }
  TRY(prepared.doubts, JudgeReadings(given.curves));
  prepared.set = InOrder(given, &disorder);
  std::stable_partition(prepared.set.curves.begin(), prepared.set.curves.end(), under_load);
  for (IvCurve& curve : prepared.set.curves) curve = WithoutBeyondVoc(std::move(curve));
  IvCurve& first = prepared.set.curves.front();
  first.notes.setup = prepared.setup.setup;
  TRY(prepared.measurement, MakeMeasurement(prepared.set));
  prepared.options.priors.where =
      CircumstancesOf(prepared.measurement.readings, first.notes.technology, options);
  std::vector<std::string>& warnings = prepared.measurement.warnings;
  warnings.insert(warnings.begin(), disorder.begin(), disorder.end());
  prepared.measurement.errors = options.noise;
  if (!IsWanted(*FindEffect("clip"), options)) ForgetLimits(&prepared.measurement.values);
  return prepared;
}

// Departure of a device from a law with the right causes: that of modules without a fault, or as
// stated.
JudgeOptions JudgeOptionsOf(const Measurement& measurement, const CausePriors& priors) {
  JudgeOptions judge;
  judge.priors = priors;
  judge.module = measurement.readings.traits.module;
  if (!measurement.has_path()) return judge;
  if (measurement.errors.kind == ErrorKind::kStated) {
    judge.departure = measurement.errors.sizes.path;
    return judge;
  }
  judge.departure = UsualErrors(1, 1).center.path;
  judge.departure_width = kDepartureWidth;
  return judge;
}

SelectOptions MakeSelectOptions(const PreparedDiagnosis& prepared,
                                const ProgressReporter& progress) {
  const DiagnoseOptions& options = prepared.options;
  const Readings& readings = prepared.measurement.readings;
  SelectOptions select;
  select.judge = JudgeOptionsOf(prepared.measurement, options.priors);
  select.probability = options.probability;
  select.largest_causes = options.largest_causes;
  select.floors = {options.floor_current, options.floor_power};
  select.base = StartingLaw(readings, options.base);
  select.candidates = Candidates(prepared.known, readings.traits, options);
  select.judge.candidates = select.candidates;
  select.progress = progress;
  return select;
}

// The selection of causes on the readings or, in a long measurement, on averages of them.
struct SelectedCauses {
  Selection found;  // unusable base: the rest is empty
  Autocorrelation correlation;
  AtReadings at;
  std::vector<const Effect*> candidates;
  HeldOutErrors held_out;
};

SelectedCauses SelectPrepared(const PreparedDiagnosis& prepared, const ProgressReporter& progress) {
  const Measurement& measurement = prepared.measurement;
  const SelectOptions select = MakeSelectOptions(prepared, progress);
  const bool is_long = IsLong(measurement.readings);
  const Averaged averaged = is_long ? Average(measurement, select.base, progress) : Averaged();
  const Measurement& seen = is_long ? averaged.measurement : measurement;
  SelectedCauses selected;
  WhitenedSelection whitened = SelectWhitened(seen, select);
  selected.found = std::move(whitened.found);
  selected.correlation = whitened.correlation;
  selected.candidates = select.candidates;
  Selection& found = selected.found;
  if (!found.base.usable) return selected;
  FindAlternatives(seen, select, &found);
  selected.at = is_long ? AtItsReadings(found, averaged, measurement) : AtItsReadings(found);
  if (prepared.options.held_out && !progress.Stopped()) {
    selected.held_out =
        MeasureHeldOut(seen, select, found, prepared.options.folds, prepared.options.threads);
  }
  return selected;
}

Evidence FindEvidence(const PreparedDiagnosis& prepared, const SelectedCauses& selected) {
  const Measurement& measurement = prepared.measurement;
  const Selection& found = selected.found;
  Evidence evidence =
      DescribeEvidence(found, selected.at, measurement.values, selected.correlation);
  if (measurement.noise_is_stated()) {
    evidence.noise_stated_A =
        UpperMedian(selected.at.weighted.sigma) * measurement.readings.scale.current_A;
  }
  evidence.whiteness_p_value = Whiteness(found.base_weighted, found.base);
  evidence.whiteness_after_p_value = Whiteness(found.weighted, found.extended);
  return evidence;
}

std::vector<std::string> AssumptionsOf(const CurveSet& set) {
  std::vector<std::string> all;
  for (const IvCurve& curve : set.curves) {
    for (const std::string& sentence : SentencesOf(curve.assumptions)) {
      if (std::find(all.begin(), all.end(), sentence) == all.end()) all.push_back(sentence);
    }
  }
  return all;
}

Diagnosis BeginDiagnosis(const PreparedDiagnosis& prepared) {
  const CurveSet& set = prepared.set;
  const DiagnoseOptions& options = prepared.options;
  Diagnosis diagnosis;
  diagnosis.version = Version();
  diagnosis.name = set.curves.size() == 1 || set.name.empty() ? set.curves.front().name : set.name;
  diagnosis.source = set.source.empty() ? set.curves.front().source : set.source;
  diagnosis.base = ToText(options.base);
  diagnosis.seed = options.seed;
  diagnosis.probability = options.probability;
  diagnosis.floor_current = options.floor_current;
  diagnosis.floor_power = options.floor_power;
  diagnosis.setup = prepared.setup;
  diagnosis.cells_in_series = prepared.measurement.readings.scale.cells;
  diagnosis.non_default_options = NonDefaults(options, kDiagnoseOptionTable);
  diagnosis.assumptions = AssumptionsOf(set);
  const std::string diodes = AssumedDiodes(prepared.measurement.readings.traits);
  if (!diodes.empty()) diagnosis.assumptions.push_back(diodes);
  diagnosis.doubts = prepared.doubts;
  return diagnosis;
}

// Everything that follows from the selection, without plan and extended model.
Diagnosis Describe(const PreparedDiagnosis& prepared, const SelectedCauses& selected) {
  const Measurement& measurement = prepared.measurement;
  const Selection& found = selected.found;
  Diagnosis diagnosis = BeginDiagnosis(prepared);
  diagnosis.base_sentence = DescribeLaw(measurement.readings, found.base.law);
  diagnosis.evidence = FindEvidence(prepared, selected);
  diagnosis.verdict = Decide(measurement, found, selected.at, prepared.options,
                             diagnosis.evidence.whiteness_after_p_value);
  DescribeRecoverable(found, &diagnosis.verdict);
  Verdict& verdict = diagnosis.verdict;
  const IvCurve& curve = prepared.set.curves.front();
  const DeviceKind kind = {curve.notes.technology, curve.irradiance_known};
  JudgeFillFactor(found, kind, prepared.options, &verdict);
  const Floors floors = {prepared.options.floor_current, prepared.options.floor_power};
  diagnosis.device_findings = FindDeviceFindings(found, kind, verdict.causes, floors);
  NameFillFactor(found, diagnosis.device_findings, selected.candidates,
                 JudgeOptionsOf(measurement, prepared.options.priors), prepared.options, &verdict);
  AddFillFactor(verdict.fill_factor, verdict.causes, &diagnosis.device_findings);
  DescribeVerdict(found, floors, diagnosis.device_findings, prepared.options.probability,
                  &diagnosis.verdict);
  diagnosis.trials = DescribeTrials(measurement.readings, found, prepared.known,
                                    selected.candidates, selected.held_out, prepared.options);
  diagnosis.gain = MeasureGain(found, selected.at, selected.held_out, measurement.has_path());
  diagnosis.curves = DescribeCurves(prepared.set, measurement.readings);
  diagnosis.points = DescribePoints(prepared.set, measurement, selected.at);
  const bool said = diagnosis.verdict.found && LeavesTooMuch(diagnosis.verdict, floors);
  diagnosis.warnings = FindWarnings(found, measurement, prepared.doubts, said);
  return diagnosis;
}

void MarkInterrupted(Diagnosis* diagnosis) {
  diagnosis->interrupted = true;
  Verdict& verdict = diagnosis->verdict;
  verdict.sentence = verdict.found ? "Stopped early; so far: " + verdict.sentence
                                   : "Stopped early: nothing was found so far.";
}

// Says what kind a single curve is where it is no plain sweep.
void AddKind(const CurveSet& set, Evidence* evidence) {
  if (set.curves.size() != 1) return;
  const KindOfMeasurement kind = KindOf(set.curves.front());
  if (!kind.words.empty() && kind.kind != CurveKind::kDark) evidence->kind += ", " + kind.words;
}

}  // namespace

Expected<void> ReadBaseModel(const std::string& text, DiagnoseOptions* options,
                             const TextReaders&) {
  const std::optional<Model> model = FromText<Model>(text);
  if (!model || *model == Model::kTripleDiode) {
    return Fail("expected sd or dd, found '" + text + "'");
  }
  options->base = *model;
  return {};
}

Expected<void> ReadEffectIds(const std::string& text, DiagnoseOptions* options,
                             const TextReaders&) {
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
  if (taken.several_devices) TRY(CheckIsOneCell(taken, "batch --task diagnose"));
  TRY(const PreparedDiagnosis prepared, Prepare(taken, options));
  const ProgressReporter progress(observer, kPollPeriod_s);
  progress.Begin("base fit", 3);
  const SelectedCauses selected = SelectPrepared(prepared, progress);
  const Selection& found = selected.found;
  if (!found.base.usable || !found.extended.usable) {
    return Fail(BeginDiagnosis(prepared).name + (progress.Stopped()
                                                     ? ": stopped before the base model was fitted"
                                                     : ": no diode model fits these readings"));
  }
  Diagnosis diagnosis = Describe(prepared, selected);
  AddKind(taken, &diagnosis.evidence);
  if (progress.Stopped()) MarkInterrupted(&diagnosis);
  diagnosis.extended =
      ExtendedReport(prepared.set, found, selected.at, options.extend && !diagnosis.interrupted,
                     options.seed, observer);
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
