#include "lyrefit/read/read_pan.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/data_sheet_values.h"
#include "lyrefit/curve/technology.h"
#include "lyrefit/model/default_values.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/pvlib_parameters.h"
#include "lyrefit/model/translation.h"

namespace lyrefit {
namespace {

constexpr double kAlikePower = 0.01;
constexpr double kAlikePowerTempco_percent_K = 0.05;
constexpr double kSmallestTempco_1_K = 2e-5;  // relative alpha_sc; a muISC in %/K is below

// Photocurrent and saturation current at the reference, from Isc and Voc. Error: the shunt takes
// more than Isc.
Expected<void> SolveCurrents(const PanObject& pan, const PanPoints& points,
                             NamedParameters* module) {
  const Translation& at = module->translation;
  std::vector<double>& p = module->shared;
  const double a = p[at.n] * at.device.module_thermal_voltage_V;
  const double rsh = p[at.resistance_shunt];
  const double low = points.isc * p[at.resistance_series], high = points.voc;
  const auto collected = [&](double junction_V) {
    if (at.recombination < 0) return 1.0;
    if (junction_V >= p[at.built_in_voltage]) return 0.0;
    return 1 - p[at.recombination] / (p[at.built_in_voltage] - junction_V);
  };
  const double ratio = collected(high) / collected(low);
  const double short_circuit = points.isc + low / rsh;
  const double saturation =
      (ratio * short_circuit - high / rsh) / (std::expm1(high / a) - ratio * std::expm1(low / a));
  const double photocurrent = (short_circuit + saturation * std::expm1(low / a)) / collected(low);
  const bool possible = low < high && collected(high) > 0 && saturation > 0 && photocurrent > 0;
  if (!possible || !std::isfinite(saturation) || !std::isfinite(photocurrent)) {
    return pan.Refuse(*pan.Find("Voc"),
                      "a voltage that Isc, RSerie, RShunt, Gamma and the technology allow");
  }
  p[at.photocurrent] = photocurrent;
  p[at.saturation_current] = saturation;
  return {};
}

// Compares the model with the rest of what the file states.
Expected<void> Compare(const PanObject& pan, const PanPoints& points, NamedParameters* module) {
  const TranslatedDevice at = TranslateTo(module->translation, module->shared,
                                          kReferenceIrradiance_W_m2, kReferenceTemperature_K);
  const double power_W = ModelKeyPoints(at.device, at.parameters.data()).max_power_W;
  const double stated_W = points.imp * points.vmp;
  if (!(std::fabs(power_W / stated_W - 1) <= kAlikePower)) {
    module->warnings.push_back(fmt::format(
        "The model of {} gives {:.5g} W at 1000 W/m2 and 25 C, its Imp and Vmp {:.5g} W: its "
        "parameters are not those of its data sheet.",
        module->name, power_W, stated_W));
  }
  const double alpha_A_K = std::fabs(module->shared[module->translation.alpha_sc]);
  if (alpha_A_K > 0 && alpha_A_K < kSmallestTempco_1_K * points.isc) {
    module->warnings.push_back(fmt::format(
        "The muISC of {}, {} mA/K, is next to none beside an Isc of {:g} A: is it in percent?",
        module->name, pan.Text("muISC"), points.isc));
  }
  TRY(const auto stated, TakePowerTempco(pan));
  if (!stated) return {};
  const double given =
      CoefficientsAtReference(module->translation, module->shared).gamma_pmp_percent_K;
  if (std::fabs(given - *stated) <= kAlikePowerTempco_percent_K) return {};
  module->warnings.push_back(fmt::format(
      "The power of the model of {} changes by {:.3f} %/K, muPmpReq says {:.3f}: with another band "
      "gap than the {:g} eV of its technology, or it was not fitted to that.",
      module->name, given, *stated, module->shared[module->translation.bandgap]));
  return {};
}

}  // namespace

Expected<NamedParameters> ReadPanParameters(const std::string& text, const std::string& path) {
  TRY(const PanObject pan, ParsePan(text, path));
  TRY(CheckPanReference(pan));
  NamedParameters module;
  module.name = std::filesystem::path(path).filename().string();
  TranslationSpec spec;
  spec.law = TranslationLaw::kPvsyst;
  spec.shunt = ShuntLaw::kExponential;
  TRY(spec.cells_in_series, TakePanCells(pan));
  TRY(const auto loss, pan.Number({"D2MuTau", "a voltage in V", 0, false}));
  spec.recombination = loss.value_or(0) > 0;
  TRY(module.translation, MakeTranslation(spec));
  const Translation& at = module.translation;
  std::vector<double>& p = module.shared;
  p.resize(at.size());
  TRY(const PanPoints points, TakePanPoints(pan));
  TRY(p[at.n], pan.Required({"Gamma", "an ideality", 0}));
  TRY(p[at.n_slope], pan.Required({"muGamma", "a coefficient in 1/K", -0.1, false, 0.1}));
  TRY(p[at.resistance_series], pan.Required({"RSerie", "a resistance in ohm", 0, false}));
  TRY(p[at.resistance_shunt], pan.Required({"RShunt", "a resistance in ohm", 0}));
  TRY(p[at.resistance_shunt_dark], pan.Required({"Rp_0", "a resistance in ohm", 0}));
  TRY(const auto exponent, pan.Number({"Rp_Exp", "an exponent", 0}));
  p[at.shunt_exponent] = exponent.value_or(kPvlibShuntExponent);
  TRY(p[at.alpha_sc], TakeCurrentTempco(pan, points.isc));
  const std::string technology = pan.Text("Technol");
  const auto known = FindTechnology(technology);
  if (known == nullptr) {
    module.warnings.push_back(
        fmt::format("The technology {} of {} is not known: it counts as silicon.",
                    Quoted(technology), module.name));
  }
  const Technology& usual = known != nullptr ? *known : Silicon();
  p[at.bandgap] = usual.pvsyst_bandgap_eV();
  if (spec.recombination) {
    p[at.recombination] = *loss;
    p[at.built_in_voltage] = spec.cells_in_series * usual.junctions * kDefaultBuiltIn_V;
  }
  TRY(SolveCurrents(pan, points, &module));
  if (const auto same = PvlibParameters(at, p); !same) return Fail(same.error().message, path);
  TRY(Compare(pan, points, &module));
  return module;
}

Expected<ModuleSheet> ReadPanSheet(const std::string& text, const std::string& path) {
  TRY(const PanObject pan, ParsePan(text, path));
  TRY(CheckPanReference(pan));
  ModuleSheet module;
  module.name = NameOfPan(pan);
  DataSheet& sheet = module.sheet;
  sheet.technology = pan.Text("Technol");
  TRY(sheet.cells_in_series, TakePanCells(pan));
  TRY(const PanPoints p, TakePanPoints(pan));
  TRY(const double alpha, TakeCurrentTempco(pan, p.isc));
  TRY(double beta, TakeVoltageTempco(pan, p.voc));
  const bool stated = !std::isnan(beta);
  const auto model = ReadPanParameters(text, path);
  module.has_model = model.has_value();
  if (!stated && model) {
    beta = CoefficientsAtReference(model->translation, model->shared).beta_oc_V_K;
    module.assumptions.push_back(fmt::format(
        "muVocSpec is not stated: beta_oc of {:.4g} V/K is that of the file's own model (RSerie, "
        "RShunt, Gamma, muGamma)",
        beta));
  }
  sheet.values = {p.isc, p.voc, p.imp, p.vmp, alpha, beta};
  const auto half = [&](const char* key) { return HalfUnit(pan.Text(key)); };
  sheet.half_unit = {half("Isc"), half("Voc"),          half("Imp"),
                     half("Vmp"), 1e-3 * half("muISC"), stated ? 1e-3 * half("muVocSpec") : 0};
  TRY(sheet.gamma_pmp_percent_K, TakePowerTempco(pan));
  TRY(module.rated_power_W, pan.Number({"PNom", "a power in W", 0}));
  if (const auto fits = CheckDataSheetPoints(sheet.values); !fits) {
    return Fail(fits.error().message, path);
  }
  return module;
}

}  // namespace lyrefit
