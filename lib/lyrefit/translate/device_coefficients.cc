#include "lyrefit/translate/device_coefficients.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/file.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/technology.h"
#include "lyrefit/model/translation.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/translate/take_coefficients.h"

namespace lyrefit {
namespace {

constexpr std::uintmax_t kLargestFile = 1U << 20;

constexpr double kEpsilon_V = 1.232;  // n Eg / q of crystalline silicon, IEC 60891:2021

// Reads a coefficient per kelvin, in percent if the text ends with a percent sign.
Expected<void> ReadPerKelvin(const std::string& text, std::optional<double>* absolute,
                             std::optional<double>* percent) {
  const bool sign = !text.empty() && text.back() == '%';
  const auto value = ParseNumber(sign ? text.substr(0, text.size() - 1) : text);
  if (!value || !std::isfinite(*value)) {
    return Fail(
        fmt::format("expected a number per kelvin, or in percent such as -0.3%, found '{}'", text));
  }
  (sign ? *percent : *absolute) = value;
  (sign ? *absolute : *percent).reset();
  return {};
}

std::vector<std::string> PerKelvinTexts(const std::optional<double>& absolute,
                                        const std::optional<double>& percent) {
  if (absolute) return {NumberText(*absolute)};
  if (percent) return {NumberText(*percent) + "%"};
  return {};
}

void KeepOr(const std::optional<double>& read, std::optional<double>* kept) {
  if (!*kept) *kept = read;
}

// Sets the absolute or relative coefficient only if neither is set.
void KeepPair(const std::optional<double>& absolute, const std::optional<double>& percent,
              std::optional<double>* kept_absolute, std::optional<double>* kept_percent) {
  if (*kept_absolute || *kept_percent) return;
  *kept_absolute = absolute;
  if (!absolute) *kept_percent = percent;
}

bool IsEmpty(const StatedCoefficients& c) {
  for (const auto* value : {&c.alpha_A_K, &c.alpha_percent_K, &c.beta_V_K, &c.beta_percent_K,
                            &c.kappa_ohm_K, &c.resistance_series_ohm, &c.b1, &c.b2, &c.epsilon_V,
                            &c.EgRef_eV, &c.dEgdT_1_K, &c.mu_gamma_1_K}) {
    if (*value) return false;
  }
  return true;
}

Expected<StatedCoefficients> CoefficientsOf(const nlohmann::json& object, const std::string& text,
                                            const std::string& path) {
  const JsonFields fields(object, text, path);
  StatedCoefficients c;
  TRY(c.alpha_A_K, fields.Number({"alpha_sc_A_K", "alpha_sc", "alpha_Isc_A_per_K"}));
  TRY(c.alpha_percent_K, fields.Number({"alpha_sc_percent_K"}));
  TRY(c.beta_V_K, fields.Number({"beta_oc_V_K", "beta_oc", "beta_voc", "beta_Voc_V_per_K"}));
  TRY(c.beta_percent_K, fields.Number({"beta_oc_percent_K"}));
  TRY(c.kappa_ohm_K, fields.Number({"kappa_ohm_K"}));
  TRY(c.resistance_series_ohm, fields.Number({"resistance_series_ohm"}));
  TRY(c.b1, fields.Number({"B1", "b1"}));
  TRY(c.b2, fields.Number({"B2", "b2"}));
  TRY(c.epsilon_V, fields.Number({"epsilon_V"}));
  TRY(c.EgRef_eV, fields.Number({"EgRef_eV", "EgRef"}));
  TRY(c.dEgdT_1_K, fields.Number({"dEgdT_1_K", "dEgdT"}));
  TRY(c.mu_gamma_1_K, fields.Number({"mu_gamma_1_K", "mu_gamma"}));
  return c;
}

// Voc at 1000 W/m2 and 25 C, estimated by the diode's logarithm and by beta in percent or V/K.
double VocAtReference(const StatedCoefficients& stated, const TranslationInputs& at, double voc,
                      double nNsVth_V, double beta_percent) {
  const double lit = voc + nNsVth_V * std::log(1000 / EquivalentIrradiance(at));
  const double dt = at.temperature_C - kReferenceTemperature_C;
  if (stated.beta_V_K) return lit - *stated.beta_V_K * dt;
  return lit / (1 + beta_percent / 100 * dt);
}

// Replaces a missing value by 0.
double Finite(double value) { return std::isfinite(value) ? value : 0; }

class Settling {
 public:
  Settling(const StatedCoefficients& stated, const std::string& technology,
           const PreparedCurve& curve, TranslationInputs values)
      : stated_(stated) {
    settled_.values = values;
    const Technology* const known = FindTechnology(technology);
    if (technology.empty()) {
      Assume("nobody stated the technology: crystalline silicon was assumed");
    } else if (known == nullptr || std::isnan(known->sheets.beta_percent_K)) {
      Assume(fmt::format("usual coefficients of '{}' are not known: they are those of c-Si",
                         technology));
    }
    technology_ = known != nullptr ? *known : Silicon();
    const bool sheets = !std::isnan(technology_.sheets.beta_percent_K);
    usual_ = sheets ? technology_.sheets : Silicon().sheets;
    settled_.usual_gamma_percent_K = usual_.gamma_percent_K;
    settled_.usual_of = sheets ? technology_.name : Silicon().name;
    settled_.crystalline_silicon = technology_.silicon;
    const CurvePoints points = TruePoints(curve.points, values);
    key_ = KeyPointsBy(KeyPointMethod::kInterpolated, points);
    const double t1_K = values.temperature_C + kZeroCelsius_K;
    thermal_V_ = curve.cells_in_series * ThermalVoltage(t1_K);
    nNsVth_V_ = 1.1 * thermal_V_;
    if (!curve.diode) return;
    diode_ = TrueDiode(*curve.diode, values);
    // The fitted nNsVth is clamped: a fault distorts it, and then it does not describe Voc(G).
    constexpr double kLowest = 0.9, kHighest = 1.5;
    nNsVth_V_ = thermal_V_ * std::clamp(diode_->nNsVth_V / thermal_V_, kLowest, kHighest);
  }

  SettledInputs Settle() {
    AlphaAndBeta();
    ShapeOfTheCurve();
    Junction();
    return std::move(settled_);
  }

 private:
  void Assume(std::string sentence) { settled_.assumptions.push_back(std::move(sentence)); }

  void AlphaAndBeta() {
    TranslationInputs& at = settled_.values;
    const double beta_percent = stated_.beta_percent_K.value_or(usual_.beta_percent_K);
    voc_stc_ = VocAtReference(stated_, at, key_.open_circuit_voltage_V, nNsVth_V_, beta_percent);
    const double isc_stc = key_.short_circuit_current_A * 1000 / EquivalentIrradiance(at);
    const double alpha_percent = stated_.alpha_percent_K.value_or(usual_.alpha_percent_K);
    at.alpha_sc_A_K = stated_.alpha_A_K.value_or(Finite(alpha_percent / 100 * isc_stc));
    at.beta_oc_V_K = stated_.beta_V_K.value_or(Finite(beta_percent / 100 * voc_stc_));
    if (!stated_.alpha_A_K && !stated_.alpha_percent_K) {
      settled_.alpha_scatter = usual_.alpha_scatter / std::max(0.01, std::fabs(alpha_percent));
      Assume(fmt::format("nobody stated alpha: {:g} +- {:g} %/K, as {} has it",
                         usual_.alpha_percent_K, usual_.alpha_scatter, settled_.usual_of));
    }
    if (!stated_.beta_V_K && !stated_.beta_percent_K) {
      settled_.beta_scatter = usual_.beta_scatter / std::fabs(usual_.beta_percent_K);
      Assume(fmt::format("nobody stated beta: {:g} +- {:g} %/K, as {} has it",
                         usual_.beta_percent_K, usual_.beta_scatter, settled_.usual_of));
    }
  }

  void ShapeOfTheCurve() {
    TranslationInputs& at = settled_.values;
    const double rs = diode_ ? std::max(0.0, diode_->resistance_series_ohm) : 0;
    at.resistance_series_ohm = stated_.resistance_series_ohm.value_or(rs);
    const double imp = key_.max_power_current_A, t1_K = at.temperature_C + kZeroCelsius_K;
    const double kappa =
        (key_.open_circuit_voltage_V - key_.max_power_voltage_V - at.resistance_series_ohm * imp) /
        (t1_K * imp);
    at.kappa_ohm_K = stated_.kappa_ohm_K.value_or(std::max(0.0, Finite(kappa)));
    const double at_25 = nNsVth_V_ * kReferenceTemperature_K / t1_K / voc_stc_;
    at.b1 = stated_.b1.value_or(Finite(at_25));
    at.b2 = stated_.b2.value_or(at.b1 * at.b1);
    std::string derived;
    const auto add = [&](bool is_stated, const char* name) {
      if (!is_stated) derived += (derived.empty() ? "" : ", ") + std::string(name);
    };
    add(stated_.resistance_series_ohm.has_value(), "Rs");
    add(stated_.kappa_ohm_K.has_value(), "kappa");
    add(stated_.b1.has_value(), "B1");
    add(stated_.b2.has_value(), "B2");
    if (!derived.empty()) Assume("nobody stated " + derived + ": taken from the curve's own shape");
  }

  // Inputs of the temperature laws of the diode.
  void Junction() {
    TranslationInputs& at = settled_.values;
    at.epsilon_V = stated_.epsilon_V.value_or(kEpsilon_V);
    at.EgRef_eV = stated_.EgRef_eV.value_or(technology_.bandgap_eV);
    at.dEgdT_1_K = stated_.dEgdT_1_K.value_or(technology_.bandgap_slope_per_K);
    at.mu_gamma_1_K = stated_.mu_gamma_1_K.value_or(0);
    settled_.bandgap_stated = stated_.EgRef_eV.has_value();
    settled_.mu_gamma_stated = stated_.mu_gamma_1_K.has_value();
  }

  const StatedCoefficients& stated_;
  SettledInputs settled_;
  Technology technology_ = Silicon();
  SheetCoefficients usual_;
  KeyPoints key_{};
  std::optional<SingleDiodeFit> diode_;
  double thermal_V_ = 0;
  double nNsVth_V_ = 0;  // of a faultless junction
  double voc_stc_ = 0;
};

}  // namespace

Expected<void> ReadAlpha(const std::string& text, StatedCoefficients* coefficients,
                         const TextReaders&) {
  return ReadPerKelvin(text, &coefficients->alpha_A_K, &coefficients->alpha_percent_K);
}

Expected<void> ReadBeta(const std::string& text, StatedCoefficients* coefficients,
                        const TextReaders&) {
  return ReadPerKelvin(text, &coefficients->beta_V_K, &coefficients->beta_percent_K);
}

std::vector<std::string> AlphaTexts(const StatedCoefficients& coefficients) {
  return PerKelvinTexts(coefficients.alpha_A_K, coefficients.alpha_percent_K);
}

std::vector<std::string> BetaTexts(const StatedCoefficients& coefficients) {
  return PerKelvinTexts(coefficients.beta_V_K, coefficients.beta_percent_K);
}

Expected<void> TakeCoefficients(const nlohmann::json& document, const std::string& text,
                                const std::string& path, StatedCoefficients* coefficients) {
  const bool nested = document.contains("coefficients") && document["coefficients"].is_object();
  TRY(const StatedCoefficients read,
      CoefficientsOf(nested ? document["coefficients"] : document, text, path));
  StatedCoefficients& kept = *coefficients;
  KeepPair(read.alpha_A_K, read.alpha_percent_K, &kept.alpha_A_K, &kept.alpha_percent_K);
  KeepPair(read.beta_V_K, read.beta_percent_K, &kept.beta_V_K, &kept.beta_percent_K);
  KeepOr(read.kappa_ohm_K, &kept.kappa_ohm_K);
  KeepOr(read.resistance_series_ohm, &kept.resistance_series_ohm);
  KeepOr(read.b1, &kept.b1);
  KeepOr(read.b2, &kept.b2);
  KeepOr(read.epsilon_V, &kept.epsilon_V);
  KeepOr(read.EgRef_eV, &kept.EgRef_eV);
  KeepOr(read.dEgdT_1_K, &kept.dEgdT_1_K);
  KeepOr(read.mu_gamma_1_K, &kept.mu_gamma_1_K);
  return {};
}

Expected<void> ReadCoefficients(const std::string& path, StatedCoefficients* coefficients) {
  TRY(const std::string text, ReadTextFile(path, kLargestFile));
  TRY(const nlohmann::json document, ParseJson(text, path));
  if (!document.is_object()) return Fail("expected a JSON object with coefficients", path);
  StatedCoefficients read;
  TRY(TakeCoefficients(document, text, path, &read));
  if (IsEmpty(read)) {
    return Fail(
        "no coefficient in it: expected alpha_sc_A_K or alpha_sc_percent_K, beta_oc_V_K or "
        "beta_oc_percent_K, kappa_ohm_K, resistance_series_ohm, B1, B2, epsilon_V, EgRef_eV, "
        "dEgdT_1_K or mu_gamma_1_K",
        path);
  }
  return TakeCoefficients(document, text, path, coefficients);
}

SettledInputs SettleInputs(const StatedCoefficients& stated, const std::string& technology,
                           const PreparedCurve& curve, TranslationInputs values) {
  return Settling(stated, technology, curve, values).Settle();
}

}  // namespace lyrefit
