#include "lyrefit/translate/extended_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/model/device_effects.h"
#include "lyrefit/model/extended_set.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/reporting_units.h"
#include "lyrefit/translate/procedure_steps.h"

namespace lyrefit {
namespace {

constexpr int kSweepPoints = 400;
constexpr int kCoarsePoints = 80;
constexpr double kHealthyShunt = 25;  // least Rsh Isc / Voc of modules without a leak
constexpr double kSamePeak = 0.05;    // of Vmp: a larger distance means two different peaks

double ValueOf(const FitReport& fit, const std::string& symbol) {
  for (const Estimate& estimate : fit.estimates) {
    if (estimate.info.symbol == symbol) return estimate.refined;
  }
  return kUnknown;
}

// Sorts the causes into those of the device, which act at any conditions, and those of the sweep.
std::vector<EffectUse> KeptUses(const FitReport& fit, ExtendedModel* model) {
  std::vector<EffectUse> uses;
  for (const std::string& id : fit.causes) {
    const Effect* effect = FindEffect(id);
    if (effect == nullptr) continue;
    const bool kept = effect->where == Where::kDevice;
    (kept ? model->kept : model->removed).push_back(effect->title);
    if (model->cause.empty()) model->cause = id;
    if (kept && !effect->parameters.empty()) uses.push_back({effect, {}});
  }
  return uses;
}

// Parameters of the report in the order of the device.
Expected<std::vector<double>> ReportedParameters(const FitReport& fit, const Device& device) {
  std::vector<double> values;
  for (const ParameterInfo& info : device.parameters) {
    const bool of_law = info.symbol == "alpha" || info.symbol == "Eg";  // from the inputs
    const double value = of_law ? 0 : ValueOf(fit, info.symbol);
    const bool perfect_shunt = info.symbol == "Rsh" && value > 0;
    if (!std::isfinite(value) && !perfect_shunt) {
      return Fail(fmt::format("the diagnosis has no value of {}", info.symbol));
    }
    values.push_back(value);
  }
  return values;
}

// The model's device at conditions (g, t_C), with its reference temperature from the inputs.
Device DeviceUnderConditions(const ExtendedModel& model, const TranslationInputs& in, double g,
                             double t_C) {
  Device device =
      UnderConditions(model.device, g / kReferenceIrradiance_W_m2, t_C + kZeroCelsius_K);
  auto device_effects = std::make_shared<DeviceEffects>(*device.effects);
  device_effects->readings.reference_temperature_K = in.temperature_C + kZeroCelsius_K;
  device_effects->law.bandgap_slope_per_K = in.dEgdT_1_K;
  device.effects = std::move(device_effects);
  return device;
}

// Shunt resistance at `brighter` times the irradiance. The conductance of a normal module is in
// proportion to the irradiance (De Soto's law); the rest is a constant leak. Conductance up to
// healthy_shunt_S counts as normal. Beside a leak the normal part is probably smaller, down to
// half.
double ShuntUnder(const ExtendedModel& model, double shunt_ohm, double brighter) {
  const double conductance = 1 / shunt_ohm, most = model.healthy_shunt_S;
  const double reference =
      std::min(conductance, std::max(0.5 * most, 1.5 * most - 0.5 * conductance));
  return 1 / (conductance + reference * (brighter - 1));
}

// The parameters for these inputs at irradiance `g`, corrected for gains and leads as in TrueDiode.
std::vector<double> ParametersUnder(const ExtendedModel& model, const TranslationInputs& in,
                                    double g) {
  std::vector<double> p = model.parameters;
  const double suns = EquivalentIrradiance(in) / kReferenceIrradiance_W_m2;
  const double gain = in.voltage_gain / in.current_gain;
  const double warmer =
      (model.source_temperature_C + kZeroCelsius_K) / (in.temperature_C + kZeroCelsius_K);
  const Law& law = model.device.effects->law;
  p[kIph] *= in.current_gain / suns;
  for (int d = 0; d < static_cast<int>(law.model); ++d) {
    p[SaturationCurrentIndex(d)] *= in.current_gain;
    p[IdealityIndex(d)] *= in.voltage_gain * warmer;
  }
  p[kRs] = std::max(0.0, gain * p[kRs] - in.lead_resistance_ohm);
  p[kRsh] = ShuntUnder(model, gain * p[kRsh], g / EquivalentIrradiance(in));
  p[law.TempcoAt()] = in.alpha_sc_A_K;
  p[law.BandgapAt()] = model.bandgap ? model.bandgap->At(in.beta_oc_V_K) : in.EgRef_eV;
  return p;
}

// The model at given inputs and conditions.
struct PlacedModel {
  Device device;
  std::vector<double> parameters;
  double highest_V = 0;  // beyond open circuit
};

Expected<PlacedModel> Place(const ExtendedModel& model, const TranslationInputs& in, double g,
                            double t_C) {
  if (!(EquivalentIrradiance(in) > 0)) return Fail("the curve was taken without light");
  PlacedModel placed = {DeviceUnderConditions(model, in, g, t_C), ParametersUnder(model, in, g)};
  const std::vector<double>& p = placed.parameters;
  // Voc of the diodes alone exceeds that of the device with its faults; 3 % are added for causes
  // that raise it.
  const double suns = g / EquivalentIrradiance(in);
  const double nNsVth = model.cells_in_series * p[IdealityIndex(0)] *
                        ThermalVoltage(in.temperature_C + kZeroCelsius_K);
  const double voc_source =
      DiodeVoltage(model.parameters[kIph] * in.current_gain, p[SaturationCurrentIndex(0)], nNsVth);
  placed.highest_V = 1.03 * (voc_source + nNsVth * std::max(0.0, std::log(suns)) +
                             0.005 * model.cells_in_series * std::max(0.0, in.temperature_C - t_C));
  return placed;
}

Expected<void> AddPoints(const PlacedModel& placed, const std::vector<double>& voltage_V,
                         CurvePoints* points) {
  const std::vector<double> current_A =
      ExtendedCurrents(placed.device, placed.parameters.data(), voltage_V);
  for (const double current : current_A) {
    if (!std::isfinite(current)) return Fail("the extended model has no current at the target");
  }
  points->voltage_V.insert(points->voltage_V.end(), voltage_V.begin(), voltage_V.end());
  points->current_A.insert(points->current_A.end(), current_A.begin(), current_A.end());
  return {};
}

std::vector<double> EvenVoltages(double highest_V, int count) {
  std::vector<double> voltage_V;
  voltage_V.reserve(count);
  for (int k = 0; k < count; ++k) voltage_V.push_back(highest_V * k / (count - 1));
  return voltage_V;
}

Expected<CurvePoints> Sweep(const PlacedModel& placed) {
  CurvePoints points;
  TRY(AddPoints(placed, EvenVoltages(placed.highest_V, kSweepPoints), &points));
  // Points far beyond open circuit are removed.
  const double isc = points.current_A.front();
  while (points.current_A.size() > 2 &&
         points.current_A[points.current_A.size() - 2] < -0.1 * isc) {
    points.voltage_V.pop_back();
    points.current_A.pop_back();
  }
  return points;
}

// Voltages that refine a coarse sweep around open circuit and around every peak of power that may
// be the highest.
std::vector<double> FineVoltages(const CurvePoints& coarse) {
  constexpr int kParts = kSweepPoints / kCoarsePoints + 1;
  constexpr double kMaybe = 0.99;  // of the highest; between coarse points the power rises by less
  const auto power = [&](std::size_t k) { return coarse.voltage_V[k] * coarse.current_A[k]; };
  double highest = 0;
  for (std::size_t k = 0; k < coarse.voltage_V.size(); ++k) highest = std::max(highest, power(k));
  std::vector<double> fine;
  for (std::size_t k = 0; k + 1 < coarse.voltage_V.size(); ++k) {
    const bool opens = coarse.current_A[k] >= 0 && coarse.current_A[k + 1] < 0;
    const bool peak = power(k + 1) > kMaybe * highest || power(k) > kMaybe * highest;
    const double step = coarse.voltage_V[k + 1] - coarse.voltage_V[k];
    for (int part = 1; part < kParts && (opens || peak); ++part) {
      fine.push_back(coarse.voltage_V[k] + step * part / kParts);
    }
  }
  return fine;
}

// Key points as accurate as those of kSweepPoints even points, at lower cost.
Expected<KeyPoints> KeyPointsOf(const ExtendedModel& model, const TranslationInputs& in, double g,
                                double t_C) {
  TRY(const PlacedModel placed, Place(model, in, g, t_C));
  CurvePoints points;
  TRY(AddPoints(placed, EvenVoltages(placed.highest_V, kCoarsePoints), &points));
  TRY(AddPoints(placed, FineVoltages(points), &points));
  return KeyPointsBy(KeyPointMethod::kInterpolated, points);
}

Expected<const ExtendedModel*> ModelOf(const PreparedCurve& curve, int alternative) {
  if (alternative < 0 || alternative >= static_cast<int>(curve.models.size())) {
    return Fail("the readings were not diagnosed, or the diagnosis has no model of one device");
  }
  return curve.models[alternative].get();
}

}  // namespace

Expected<std::shared_ptr<const ExtendedModel>> MakeExtendedModel(const IvCurve& curve,
                                                                 const FitReport& fit,
                                                                 const ExtendedInputs& inputs) {
  if (!fit.usable) return Fail("the extended model is not usable");
  if (fit.curves != 1) return Fail("the diagnosis is of several curves");
  auto model = std::make_shared<ExtendedModel>();
  const std::vector<EffectUse> uses = KeptUses(fit, model.get());
  CurveSet set = SetOfOne(curve);
  Conditions& at = set.curves.front().conditions;
  // The diagnosis may have used another number of cells than the stated one; nNsVth gives it.
  const double n = ValueOf(fit, "n1");
  if (std::isfinite(fit.nNsVth) && n > 0) {
    at.cells_in_series = std::max(
        1, static_cast<int>(std::lround(fit.nNsVth / (n * ThermalVoltage(at.cell_temperature_K)))));
  }
  model->source_irradiance_W_m2 = at.irradiance_W_m2;
  model->source_temperature_C = at.cell_temperature_K - kZeroCelsius_K;
  model->cells_in_series = at.cells_in_series;
  Law law;
  law.model = fit.model;
  law.shunt = ShuntLaw::kConstant;
  TRY(model->device, ExtendSet(MakeDevice(fit.model, at), law, set, at.cell_temperature_K, uses,
                               /*force=*/true));
  TRY(const auto reported, ReportedParameters(fit, model->device));
  const KeyPoints key = FindKeyPoints(curve.voltage_V, curve.current_A);
  const double voc = std::isfinite(key.open_circuit_voltage_V)
                         ? key.open_circuit_voltage_V
                         : *std::max_element(curve.voltage_V.begin(), curve.voltage_V.end());
  model->healthy_shunt_S = reported[kIph] / (kHealthyShunt * voc);
  model->parameters = Internal(model->device, reported);
  if (inputs.anchored) {
    const SingleDiodeFit diode = {reported[kIph], reported[SaturationCurrentIndex(0)],
                                  n * at.ModuleThermalVoltage(ConstantSet::kCodata), reported[kRs],
                                  reported[kRsh]};
    model->bandgap =
        AnchorBandgap(TrueDiode(diode, inputs.inputs), at.cells_in_series, inputs.inputs);
  }
  return std::shared_ptr<const ExtendedModel>(std::move(model));
}

Expected<std::shared_ptr<const ExtendedModel>> MakeExtendedModel(const IvCurve& curve,
                                                                 const Diagnosis& diagnosis,
                                                                 const ExtendedInputs& inputs) {
  return MakeExtendedModel(curve, diagnosis.extended, inputs);
}

Expected<CurvePoints> ExtendedPoints(const PreparedCurve& curve, const TranslationInputs& inputs,
                                     int alternative) {
  TRY(const ExtendedModel* model, ModelOf(curve, alternative));
  TRY(const PlacedModel placed,
      Place(*model, inputs, curve.target.irradiance_W_m2, curve.target.temperature_C));
  return Sweep(placed);
}

Expected<KeyPoints> ExtendedKeyPoints(const PreparedCurve& curve, const TranslationInputs& inputs,
                                      int alternative) {
  TRY(const ExtendedModel* model, ModelOf(curve, alternative));
  TRY(const KeyPoints target,
      KeyPointsOf(*model, inputs, curve.target.irradiance_W_m2, curve.target.temperature_C));
  if (!(target.max_power_W > 0)) return Fail("the device gives no power at the target");
  if (!model->removed.empty()) return target;
  TRY(const KeyPoints source,
      KeyPointsOf(*model, inputs, EquivalentIrradiance(inputs), inputs.temperature_C));
  const KeyPoints measured = KeyPointsBy(curve.key_points, TruePoints(curve.points, inputs));
  const bool same_peak =
      std::fabs(measured.max_power_voltage_V / source.max_power_voltage_V - 1) < kSamePeak;
  return same_peak ? ScaledKeyPoints(measured, source, target) : target;
}

}  // namespace lyrefit
