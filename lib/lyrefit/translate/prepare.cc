#include "lyrefit/translate/prepare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/median.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/check_readings.h"
#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/translate/extended_model.h"
#include "lyrefit/translate/field_inputs.h"
#include "lyrefit/translate/procedure_steps.h"

namespace lyrefit {
namespace {

bool Wanted(const TranslateOptions& options, Procedure procedure) {
  return options.procedures.empty() ||
         std::find(options.procedures.begin(), options.procedures.end(), procedure) !=
             options.procedures.end();
}

CurvePoints PointsOf(const IvCurve& curve) { return ByVoltage({curve.voltage_V, curve.current_A}); }

std::optional<SingleDiodeFit> DiodeOf(const Expected<FitReport>& fit, std::string* why_not) {
  if (!fit) {
    *why_not = fit.error().message;
    return std::nullopt;
  }
  if (!fit->usable) *why_not = fit->not_usable_because;
  const std::vector<double>& p = fit->refined;
  const SingleDiodeFit diode = {p[kIph], p[SaturationCurrentIndex(0)], fit->nNsVth, p[kRs],
                                p[kRsh]};
  const bool finite = diode.photocurrent_A > 0 && diode.saturation_current_A > 0 &&
                      std::isfinite(diode.nNsVth_V + diode.resistance_series_ohm);
  if (!finite) {
    if (why_not->empty()) *why_not = "the fit has no finite parameters";
    return std::nullopt;
  }
  return diode;
}

// Standard deviation of a reading's current from second differences of the residuals. Smooth misfit
// hardly affects them; those of white noise have sqrt(6) times its standard deviation.
double NoiseOf(const FitReport& fit) {
  std::vector<double> second;
  for (std::size_t i = 2; i < fit.residual_A.size(); ++i) {
    second.push_back(fit.residual_A[i] - 2 * fit.residual_A[i - 1] + fit.residual_A[i - 2]);
  }
  if (second.size() < 5) return fit.rmse.refined.solved_current_A;
  return RobustScale(std::move(second)) / std::sqrt(6.0);
}

Expected<void> RequireConditions(const IvCurve& curve) {
  if (!curve.irradiance_known) {
    return Fail("nobody stated the irradiance the curve was taken at: say --irradiance-Wm2",
                curve.source);
  }
  if (!curve.temperature_known) {
    return Fail("nobody stated the cell temperature the curve was taken at: say --temperature-C",
                curve.source);
  }
  constexpr double kDark_W_m2 = 0.01;  // a full moon gives a thousandth of a W/m2
  if (!(curve.conditions.irradiance_W_m2 > kDark_W_m2)) {
    return Fail("a dark curve is translated by no procedure", curve.source);
  }
  return {};
}

// Requires readings that deliver power and include the point of maximum power.
Expected<void> RequirePower(const IvCurve& curve) {
  const CurvePoints points = PointsOf(curve);
  const std::size_t n = points.voltage_V.size();
  std::size_t best = 0;
  const auto power = [&](std::size_t i) {
    return std::max(0.0, points.voltage_V[i]) * points.current_A[i];
  };
  for (std::size_t i = 1; i < n; ++i) {
    if (power(i) > power(best)) best = i;
  }
  if (!(power(best) > 0)) {
    return Fail("no reading delivers power: a dark curve is translated by no procedure",
                curve.source);
  }
  const double largest_A = *std::max_element(points.current_A.begin(), points.current_A.end());
  constexpr double kFallen = 0.5;
  if (best + 1 == n && points.current_A[best] > kFallen * largest_A) {
    return Fail(
        fmt::format("the readings end at {:.4g} V, {:.3g} A, before the point of maximum power",
                    points.voltage_V[best], points.current_A[best]),
        curve.source);
  }
  return {};
}

// Rejects implausible coefficients and leads, which mostly result from a wrong unit.
Expected<void> RequirePlausible(const TranslateOptions& options, const Preparation& made) {
  const CurvePoints& points = made.curve.points;
  const double isc = *std::max_element(points.current_A.begin(), points.current_A.end());
  const double voc = *std::max_element(points.voltage_V.begin(), points.voltage_V.end());
  const TranslationInputs& in = made.inputs.values;
  constexpr double kMostAlpha = 0.01, kMostBeta = 0.02;  // of Isc and Voc, 1/K
  const double isc_there = isc * 1000 / EquivalentIrradiance(in);
  if (std::fabs(in.alpha_sc_A_K) > kMostAlpha * isc_there) {
    return Fail(fmt::format("alpha of {:.4g} A/K is {:.2g} % of Isc per kelvin, of no device",
                            in.alpha_sc_A_K, 100 * in.alpha_sc_A_K / isc_there));
  }
  if (in.beta_oc_V_K > 0 || in.beta_oc_V_K < -kMostBeta * voc) {
    return Fail(fmt::format("beta of {:.4g} V/K is {:+.2g} % of Voc per kelvin, of no device",
                            in.beta_oc_V_K, 100 * in.beta_oc_V_K / voc));
  }
  if (options.lead_resistance_ohm * isc > 0.5 * voc) {
    return Fail(
        fmt::format("leads of {:g} ohm would take {:.4g} V at {:.3g} A, of {:.4g} V there are",
                    options.lead_resistance_ohm, options.lead_resistance_ohm * isc, isc, voc));
  }
  return {};
}

TranslationInputs MeasuredInputs(const IvCurve& curve, const TranslateOptions& options) {
  TranslationInputs inputs;
  inputs.irradiance_W_m2 = curve.conditions.irradiance_W_m2;
  inputs.rear_irradiance_W_m2 = options.rear_irradiance_W_m2;
  inputs.bifaciality_isc = options.bifaciality_isc;
  inputs.temperature_C = curve.conditions.cell_temperature_K - kZeroCelsius_K;
  inputs.voltage_gain = inputs.current_gain = 1;
  inputs.lead_resistance_ohm = options.lead_resistance_ohm;
  return inputs;
}

// The curve with its temperatures corrected from the sensor to the cells.
IvCurve AtCellTemperature(IvCurve curve, const UncertaintyOptions& options) {
  const double warmer_K = CellCorrection_K(options, curve.conditions.irradiance_W_m2);
  curve.conditions.cell_temperature_K += warmer_K;
  for (double& temperature_C : curve.temperature_C) temperature_C += warmer_K;
  return curve;
}

Expected<void> AddFurther(const TranslateOptions& options, Preparation* made) {
  for (const IvCurve& read : options.further) {
    TRY(Validate(read));
    const IvCurve curve = AtCellTemperature(read, options.uncertainty);
    TRY(RequireConditions(curve));
    std::string why_not;
    FurtherCurve further;
    further.points = PointsOf(curve);
    further.irradiance_W_m2 = curve.conditions.irradiance_W_m2;
    further.temperature_C = curve.conditions.cell_temperature_K - kZeroCelsius_K;
    further.diode = DiodeOf(FitOneDiode(curve, options.diagnosis.threads), &why_not);
    if (!why_not.empty()) made->warnings.push_back("a further curve: " + why_not);
    made->curve.further.push_back(std::move(further));
  }
  return {};
}

// Adds one fitted model for each cause that explains the readings as well as the first diagnosed
// cause, in place of that cause.
void AddAlternatives(const IvCurve& curve, const TranslateOptions& options,
                     const ExtendedInputs& inputs, Preparation* made) {
  constexpr std::size_t kMostFittedCandidates = 4;
  const Verdict& verdict = made->diagnosis->verdict;
  if (verdict.causes.empty()) return;
  const std::vector<std::string>& causes = made->diagnosis->extended.causes;
  for (const std::string& id : verdict.causes.front().equivalents) {
    if (made->curve.models.size() > kMostFittedCandidates) return;
    FitOptions fit = FitOptions();
    fit.search = FitOptions::SearchBesideShapes();
    fit.starts = StartsFrom::kShape;
    fit.intervals = Intervals::kNone;
    fit.random_baseline = false;
    fit.force_effects = true;
    fit.threads = options.diagnosis.threads;
    for (const std::string& cause : causes) {
      const bool replaced = cause == verdict.causes.front().id;
      const Effect* effect = FindEffect(replaced ? id : cause);
      if (effect == nullptr || effect->parameters.empty()) continue;
      fit.with.push_back({effect, {}});
    }
    if (fit.with.empty()) continue;
    const auto report = Fit(curve, fit);
    if (!report || !report->usable) continue;
    // A candidate with a clearly larger residual than the diagnosis is no equivalent.
    constexpr double kAsGood = 1.5;
    const double best = made->diagnosis->extended.rmse.refined.solved_current_A;
    if (report->rmse.refined.solved_current_A > kAsGood * best) continue;
    FitReport named = *report;
    named.causes.clear();
    for (const EffectUse& use : fit.with) named.causes.push_back(use.effect->id);
    auto model = MakeExtendedModel(curve, named, inputs);
    if (model) made->curve.models.push_back(*model);
  }
}

Expected<void> AddModels(const IvCurve& curve, const TranslateOptions& options,
                         const Observer& observer, Preparation* made) {
  if (!Wanted(options, Procedure::kExtended)) {
    made->why_no_model = "it was not asked for";
    return {};
  }
  Expected<Diagnosis> diagnosis = Diagnose(curve, options.diagnosis, observer);
  if (!diagnosis) {
    made->why_no_model = diagnosis.error().message;
    return {};
  }
  made->diagnosis = std::move(*diagnosis);
  const ExtendedInputs inputs = {made->inputs.values, !made->inputs.bandgap_stated};
  const auto model = MakeExtendedModel(curve, *made->diagnosis, inputs);
  if (!model) {
    made->why_no_model = model.error().message;
    return {};
  }
  made->curve.models.push_back(*model);
  AddAlternatives(curve, options, inputs, made);
  return {};
}

}  // namespace

Expected<FitReport> FitOneDiode(const IvCurve& curve, int threads) {
  FitOptions options;
  options.intervals = Intervals::kNone;
  options.random_baseline = false;
  options.threads = threads;
  return Fit(curve, options);
}

Expected<Preparation> Prepare(const IvCurve& read, const TranslateOptions& options,
                              const Observer& observer) {
  Preparation made;
  TRY(Validate(read));
  TRY(RequireConditions(read));
  TRY(RequirePower(read));
  TRY(made.doubts, JudgeReadings(read));
  const IvCurve curve = AtCellTemperature(read, options.uncertainty);
  made.curve.points = PointsOf(curve);
  made.curve.cells_in_series = curve.conditions.cells_in_series;
  made.curve.key_points = options.key_points;
  made.curve.target = options.target;
  TRY(made.curve.desoto, LawOf(Procedure::kDeSoto, made.curve.cells_in_series));
  TRY(made.curve.pvsyst, LawOf(Procedure::kPvsyst, made.curve.cells_in_series));
  Expected<FitReport> fit = FitOneDiode(curve, options.diagnosis.threads);
  made.curve.diode = DiodeOf(fit, &made.curve.why_no_model);
  if (fit) {
    made.curve.noise_A = NoiseOf(*fit);
    made.fit = std::move(*fit);
  }
  const std::string technology =
      curve.notes.technology.empty() ? options.technology : curve.notes.technology;
  made.inputs =
      SettleInputs(options.coefficients, technology, made.curve, MeasuredInputs(curve, options));
  made.inputs.cell_correction_K =
      CellCorrection_K(options.uncertainty, curve.conditions.irradiance_W_m2);
  TRY(RequirePlausible(options, made));
  const TranslationInputs& inputs = made.inputs.values;
  if (made.curve.diode) {
    const SingleDiodeFit diode = TrueDiode(*made.curve.diode, inputs);
    if (options.lead_resistance_ohm > 0 && diode.resistance_series_ohm < 0) {
      made.warnings.push_back("the leads are stated with more resistance than is in the curve");
    }
    const int cells = made.curve.cells_in_series;
    if (!made.inputs.bandgap_stated) made.curve.bandgap = AnchorBandgap(diode, cells, inputs);
    if (!made.inputs.mu_gamma_stated) made.curve.mu_gamma = AnchorMuGamma(diode, cells, inputs);
  }
  TRY(AddFurther(options, &made));
  TRY(AddModels(curve, options, observer, &made));
  return made;
}

}  // namespace lyrefit
