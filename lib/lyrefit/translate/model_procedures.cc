#include "lyrefit/translate/procedure_steps.h"

#include <cmath>
#include <utility>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/roots.h"
#include "lyrefit/base/try.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

constexpr double kDarkShunt = 4;  // R_sh_0 / R_sh_ref, PVsyst's default for crystalline silicon
constexpr double kShuntExponent = 5.5;  // R_sh_exp, PVsyst's default

// A law with the reference parameters of one device.
struct Carried {
  std::shared_ptr<const Translation> law;
  std::vector<double> shared;

  // Parameters of law->device at these conditions.
  std::vector<double> At(double g, double t_C) const {
    std::vector<double> p(law->device.size());
    Translate(*law, shared.data(), g, t_C + kZeroCelsius_K, p.data());
    return p;
  }
  KeyPoints KeyPointsAt(double g, double t_C) const {
    return ModelKeyPoints(law->device, At(g, t_C).data());
  }
};

Expected<Carried> Carry(std::shared_ptr<const Translation> law, const SingleDiodeFit& diode,
                        const TranslationInputs& in) {
  Carried carried = {std::move(law), {}};
  const Translation& at = *carried.law;
  const bool pvsyst = at.spec.law == TranslationLaw::kPvsyst;
  const double g = EquivalentIrradiance(in), t_K = in.temperature_C + kZeroCelsius_K;
  const double suns = g / kReferenceIrradiance_W_m2, dt = t_K - kReferenceTemperature_K;
  if (!(suns > 0)) return Fail("the curve was taken without light");
  std::vector<double>& shared = carried.shared;
  shared.assign(at.size(), 0);
  shared[at.photocurrent] = diode.photocurrent_A / suns - in.alpha_sc_A_K * dt;
  shared[at.alpha_sc] = in.alpha_sc_A_K;
  shared[at.resistance_series] = diode.resistance_series_ohm;
  shared[at.bandgap] = in.EgRef_eV;
  const double n = diode.nNsVth_V / (at.spec.cells_in_series * ThermalVoltage(t_K));
  shared[at.n] = pvsyst ? n - in.mu_gamma_1_K * dt : n;
  if (pvsyst) {
    shared[at.n_slope] = in.mu_gamma_1_K;
    shared[at.resistance_shunt_dark] = kDarkShunt;
    shared[at.shunt_exponent] = kShuntExponent;
  } else {
    shared[at.bandgap_slope] = in.dEgdT_1_K;
  }
  // Both laws are proportional to Io_ref and the shunts: evaluation at 1 gives the factors.
  shared[at.saturation_current] = shared[at.resistance_shunt] = 1;
  const std::vector<double> unit = carried.At(g, in.temperature_C);
  shared[at.saturation_current] = diode.saturation_current_A / unit[SaturationCurrentIndex(0)];
  shared[at.resistance_shunt] = diode.resistance_shunt_ohm / unit[kRsh];
  if (pvsyst) shared[at.resistance_shunt_dark] *= shared[at.resistance_shunt];
  if (!(shared[at.photocurrent] > 0) || !(shared[at.n] > 0) ||
      !(shared[at.saturation_current] > 0)) {
    return Fail("the diode has no parameters at 1000 W/m2 and 25 C");
  }
  return carried;
}

Expected<Carried> CarryCurve(Procedure procedure, const PreparedCurve& curve,
                             const TranslationInputs& inputs) {
  if (!curve.why_no_model.empty()) return Fail("no single diode: " + curve.why_no_model);
  if (!curve.diode) return Fail("no single diode fits the readings");
  TranslationInputs in = inputs;
  const double beta = inputs.beta_oc_V_K;
  if (procedure == Procedure::kDeSoto && curve.bandgap) in.EgRef_eV = curve.bandgap->At(beta);
  if (procedure == Procedure::kPvsyst && curve.mu_gamma) {
    in.mu_gamma_1_K = curve.mu_gamma->At(beta);
    in.EgRef_eV = curve.mu_gamma->bandgap_eV;
  }
  std::shared_ptr<const Translation> law =
      procedure == Procedure::kPvsyst ? curve.pvsyst : curve.desoto;
  if (law == nullptr) {
    TRY(law, LawOf(procedure, curve.cells_in_series));
  }
  return Carry(std::move(law), TrueDiode(*curve.diode, inputs), in);
}

double Voc(const Carried& carried, double t_C) {
  return ModelOpenCircuit(carried.law->device, carried.At(kReferenceIrradiance_W_m2, t_C).data());
}

// The value of an input between `low` and `high` with which Voc follows beta; NaN where there is
// none.
double InputForBeta(const std::shared_ptr<const Translation>& law, const SingleDiodeFit& diode,
                    const TranslationInputs& inputs, double TranslationInputs::*field, double low,
                    double high) {
  constexpr double kStep_K = 5;
  const auto beyond = [&](double value) {
    TranslationInputs tried = inputs;
    tried.*field = value;
    const auto carried = Carry(law, diode, tried);
    if (!carried) return kUnknown;
    const double warm = Voc(*carried, kReferenceTemperature_C + kStep_K);
    const double cold = Voc(*carried, kReferenceTemperature_C - kStep_K);
    return (warm - cold) / (2 * kStep_K) - inputs.beta_oc_V_K;
  };
  if (!(beyond(low) * beyond(high) < 0)) return kUnknown;
  bool lost = false;  // no device at some value in between
  const auto finite = [&](double value) {
    const double at = beyond(value);
    lost = lost || !std::isfinite(at);
    return lost ? 0 : at;
  };
  const double found = RootBetween(finite, low, high);
  return lost ? kUnknown : found;
}

std::optional<BetaAnchor> Anchor(Procedure procedure, const SingleDiodeFit& diode, int cells,
                                 const TranslationInputs& inputs, double TranslationInputs::*field,
                                 double low, double high) {
  const auto law = LawOf(procedure, cells);
  if (!law) return std::nullopt;
  const auto value = [&](double beta) {
    TranslationInputs tried = inputs;
    tried.beta_oc_V_K = beta;
    return InputForBeta(*law, diode, tried, field, low, high);
  };
  constexpr double kPart = 0.02;
  BetaAnchor anchor;
  anchor.beta_V_K = inputs.beta_oc_V_K;
  anchor.bandgap_eV = inputs.EgRef_eV;
  anchor.value = value(anchor.beta_V_K);
  anchor.slope = (value((1 + kPart) * anchor.beta_V_K) - value((1 - kPart) * anchor.beta_V_K)) /
                 (2 * kPart * anchor.beta_V_K);
  if (!std::isfinite(anchor.value) || !std::isfinite(anchor.slope)) return std::nullopt;
  return anchor;
}

}  // namespace

Expected<std::shared_ptr<const Translation>> LawOf(Procedure procedure, int cells_in_series) {
  const bool pvsyst = procedure == Procedure::kPvsyst;
  TranslationSpec spec;
  spec.cells_in_series = cells_in_series;
  spec.law = pvsyst ? TranslationLaw::kPvsyst : TranslationLaw::kDeSoto;
  spec.shunt = pvsyst ? ShuntLaw::kExponential : ShuntLaw::kInverse;
  TRY(Translation law, MakeTranslation(spec));
  return std::make_shared<const Translation>(std::move(law));
}

KeyPoints ScaledKeyPoints(const KeyPoints& measured, const KeyPoints& source,
                          const KeyPoints& target) {
  KeyPoints key{};
  for (const auto field : {&KeyPoints::short_circuit_current_A, &KeyPoints::open_circuit_voltage_V,
                           &KeyPoints::max_power_voltage_V, &KeyPoints::max_power_current_A}) {
    const double scaled = measured.*field * (target.*field / source.*field);
    key.*field = std::isfinite(scaled) ? scaled : target.*field;
  }
  key.max_power_W = key.max_power_voltage_V * key.max_power_current_A;
  key.fill_factor = key.max_power_W / (key.short_circuit_current_A * key.open_circuit_voltage_V);
  return key;
}

Expected<KeyPoints> DiodeKeyPoints(Procedure procedure, const PreparedCurve& curve,
                                   const TranslationInputs& inputs) {
  TRY(const Carried carried, CarryCurve(procedure, curve, inputs));
  const KeyPoints source = carried.KeyPointsAt(EquivalentIrradiance(inputs), inputs.temperature_C);
  const KeyPoints target =
      carried.KeyPointsAt(curve.target.irradiance_W_m2, curve.target.temperature_C);
  if (!(target.max_power_W > 0)) return Fail("the device gives no power at the target");
  const KeyPoints measured = KeyPointsBy(curve.key_points, TruePoints(curve.points, inputs));
  return ScaledKeyPoints(measured, source, target);
}

Expected<CurvePoints> DiodePoints(Procedure procedure, const PreparedCurve& curve,
                                  const TranslationInputs& inputs) {
  TRY(const Carried carried, CarryCurve(procedure, curve, inputs));
  const Device& device = carried.law->device;
  const std::vector<double> p =
      carried.At(curve.target.irradiance_W_m2, curve.target.temperature_C);
  const double voc = ModelOpenCircuit(device, p.data());
  if (!(voc > 0)) return Fail("the device gives no power at the target");
  constexpr int kPoints = 200;
  CurvePoints points;
  for (int k = 0; k < kPoints; ++k) {
    points.voltage_V.push_back(voc * (-0.02 + 1.04 * k / (kPoints - 1)));
    points.current_A.push_back(
        SolveOperatingPoint(device, p.data(), points.voltage_V.back()).current_A);
  }
  return points;
}

std::optional<BetaAnchor> AnchorBandgap(const SingleDiodeFit& diode, int cells,
                                        const TranslationInputs& inputs) {
  return Anchor(Procedure::kDeSoto, diode, cells, inputs, &TranslationInputs::EgRef_eV, 0.3, 4);
}

std::optional<BetaAnchor> AnchorMuGamma(const SingleDiodeFit& diode, int cells,
                                        const TranslationInputs& inputs) {
  return Anchor(Procedure::kPvsyst, diode, cells, inputs, &TranslationInputs::mu_gamma_1_K, -0.02,
                0.02);
}

}  // namespace lyrefit
