#include "lyrefit/model/pvlib_parameters.h"

#include <fmt/format.h>

#include <cmath>

#include "lyrefit/base/try.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

// k of the fit divided by k of pvlib. Converts a voltage n Ns k T / q or an energy Eg / k to
// pvlib's k.
double ConstantRatio(const Translation& translation) {
  return ThermalVoltage(1.0, translation.spec.constants) / ThermalVoltage(1.0);
}

Expected<void> CheckExpressible(const Translation& translation, const std::vector<double>& shared) {
  const TranslationSpec& spec = translation.spec;
  if (static_cast<int>(shared.size()) != translation.size()) {
    return Fail(
        fmt::format("expected {} shared parameters, found {}", translation.size(), shared.size()));
  }
  if (spec.model != Model::kSingleDiode) return Fail("pvlib's modules have one diode, not two");
  if (spec.law != TranslationLaw::kPvsyst && spec.shunt != ShuntLaw::kInverse) {
    return Fail("pvlib's De Soto module has a shunt inverse to irradiance and no other");
  }
  if (spec.law == TranslationLaw::kPvsyst && spec.shunt == ShuntLaw::kInverse) {
    return Fail("pvlib's PVsyst module has no shunt inverse to irradiance");
  }
  if (spec.shunt == ShuntLaw::kExponential &&
      shared[translation.resistance_shunt] < shared[translation.resistance_shunt_dark] *
                                                 std::exp(-shared[translation.shunt_exponent])) {
    return Fail(
        "R_sh_ref lies below R_sh_0 exp(-R_sh_exp): pvlib cuts the shunt of such a module off at "
        "0 ohm");
  }
  return {};
}

std::vector<NamedValue> DeSotoParameters(const Translation& at, const std::vector<double>& p) {
  std::vector<NamedValue> values = {
      {"alpha_sc", p[at.alpha_sc]},
      {"a_ref", p[at.n] * at.device.module_thermal_voltage_V},
      {"I_L_ref", p[at.photocurrent]},
      {"I_o_ref", p[at.saturation_current]},
      {"R_sh_ref", p[at.resistance_shunt]},
      {"R_s", p[at.resistance_series]},
      {"EgRef", p[at.bandgap] / ConstantRatio(at)},
      {"dEgdT", p[at.bandgap_slope]},
      {"irrad_ref", kReferenceIrradiance_W_m2},
      {"temp_ref", kReferenceTemperature_C},
      {"cells_in_series", static_cast<double>(at.spec.cells_in_series)}};
  if (at.adjust >= 0) values.push_back({"Adjust", p[at.adjust]});
  return values;
}

std::vector<NamedValue> PvsystParameters(const Translation& at, const std::vector<double>& p) {
  // A constant shunt is an exponential one with R_sh_0 = R_sh_ref.
  const bool constant = at.spec.shunt == ShuntLaw::kConstant;
  const int dark = constant ? at.resistance_shunt : at.resistance_shunt_dark;
  const double ratio = ConstantRatio(at);
  std::vector<NamedValue> values = {
      {"alpha_sc", p[at.alpha_sc]},
      {"gamma_ref", p[at.n] * ratio},
      {"mu_gamma", p[at.n_slope] * ratio},
      {"I_L_ref", p[at.photocurrent]},
      {"I_o_ref", p[at.saturation_current]},
      {"R_sh_ref", p[at.resistance_shunt]},
      {"R_sh_0", p[dark]},
      {"R_s", p[at.resistance_series]},
      {"cells_in_series", static_cast<double>(at.spec.cells_in_series)},
      {"R_sh_exp", constant ? kPvlibShuntExponent : p[at.shunt_exponent]},
      // Only EgRef / (k gamma) matters, and gamma is converted already.
      {"EgRef", p[at.bandgap]},
      {"irrad_ref", kReferenceIrradiance_W_m2},
      {"temp_ref", kReferenceTemperature_C},
  };
  if (at.recombination >= 0) {
    values.push_back({"d2mutau", p[at.recombination]});
    values.push_back({"NsVbi", p[at.built_in_voltage]});
  }
  return values;
}

}  // namespace

Expected<std::vector<NamedValue>> PvlibParameters(const Translation& translation,
                                                  const std::vector<double>& shared) {
  TRY(CheckExpressible(translation, shared));
  if (translation.spec.law == TranslationLaw::kPvsyst) return PvsystParameters(translation, shared);
  return DeSotoParameters(translation, shared);
}

Expected<CecModule> CecRow(const Translation& translation, const std::vector<double>& shared,
                           const std::string& name, const std::string& technology) {
  if (translation.spec.law == TranslationLaw::kPvsyst) {
    return Fail("a CEC row takes the law cec or desoto, not pvsyst");
  }
  TRY(CheckExpressible(translation, shared));
  const Translation& at = translation;
  const double gap = shared[at.bandgap];
  const double slope = shared[at.bandgap_slope];
  if (std::fabs(gap / kPvlibBandgap_eV - 1) > 1e-9 ||
      std::fabs(slope / kPvlibBandgapSlope_1_K - 1) > 1e-9) {
    return Fail(fmt::format(
        "a CEC row implies EgRef = {} eV and dEgdT = {} 1/K, found {} and {}: fit with both fixed "
        "there",
        kPvlibBandgap_eV, kPvlibBandgapSlope_1_K, gap, slope));
  }
  const TranslatedDevice reference =
      TranslateTo(at, shared, kReferenceIrradiance_W_m2, kReferenceTemperature_K);
  const KeyPoints points = ModelKeyPoints(reference.device, reference.parameters.data());
  if (std::isnan(points.max_power_W)) return Fail("the device gives no power at the reference");
  const TemperatureCoefficients coefficients = CoefficientsAtReference(at, shared);
  CecModule row;
  row.name = name;
  row.technology = technology;
  row.values = {{"N_s", static_cast<double>(at.spec.cells_in_series)},
                {"I_sc_ref", points.short_circuit_current_A},
                {"V_oc_ref", points.open_circuit_voltage_V},
                {"I_mp_ref", points.max_power_current_A},
                {"V_mp_ref", points.max_power_voltage_V},
                {"alpha_sc", shared[at.alpha_sc]},
                {"beta_oc", coefficients.beta_oc_V_K},
                {"a_ref", shared[at.n] * at.device.module_thermal_voltage_V},
                {"I_L_ref", shared[at.photocurrent]},
                {"I_o_ref", shared[at.saturation_current]},
                {"R_s", shared[at.resistance_series]},
                {"R_sh_ref", shared[at.resistance_shunt]},
                {"Adjust", at.adjust >= 0 ? shared[at.adjust] : 0.0},
                {"gamma_r", coefficients.gamma_pmp_percent_K}};
  return row;
}

}  // namespace lyrefit
