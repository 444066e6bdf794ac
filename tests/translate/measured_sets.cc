#include "translate/measured_sets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/model/translation.h"
#include "lyrefit/read/read_curve_set.h"

namespace shown {
namespace {

using lyrefit::IvCurve;

lyrefit::KeyPoints KeyOf(const IvCurve& curve) {
  return lyrefit::FindKeyPoints(curve.voltage_V, curve.current_A);
}

constexpr double kLeast_W_m2 = 150;

// Keeps every `every`-th curve that reaches open circuit and has enough light.
void Keep(int every, MeasuredSet* set) {
  std::vector<IvCurve> kept;
  for (std::size_t i = 0; i < set->curves.size(); i += every) {
    const IvCurve& curve = set->curves[i];
    const bool whole = std::isfinite(KeyOf(curve).open_circuit_voltage_V);
    if (whole && curve.conditions.irradiance_W_m2 >= kLeast_W_m2) kept.push_back(curve);
  }
  set->curves = kept;
}

}  // namespace

lyrefit::Expected<MeasuredSet> SandiaSet(const std::string& data, int every) {
  MeasuredSet set;
  set.name = "Sandia, Mitsubishi PV-UE125MF5N";
  TRY(lyrefit::CurveSet read, lyrefit::ReadCurveSet(data + "/field/sandia_pvue125"));
  set.curves = std::move(read.curves);
  set.options = ReadyOptions(false);
  set.options.coefficients.alpha_A_K = 0.0054;
  set.options.coefficients.beta_V_K = -0.0774;
  Keep(every, &set);
  return set;
}

lyrefit::Expected<MeasuredSet> NistSet(const std::string& data, const NistDay& of, int every) {
  constexpr double kIsc_A = 8.6, kAlpha = 5.3e-4, kVoc_V = 37.0, kBeta = -3.51e-3;
  const double fold_V = of.ideality * 60 * 0.02569;  // n Ns Vth
  MeasuredSet set;
  set.name = fmt::format("NIST, ground array, {}, n = {:g}", of.day, of.ideality);
  TRY(lyrefit::CurveSet read, lyrefit::ReadCurveSet(data + "/field/nist_ground_" + of.day));
  set.curves = std::move(read.curves);
  for (IvCurve& curve : set.curves) {
    const lyrefit::KeyPoints key = KeyOf(curve);
    const double voc = std::isfinite(key.open_circuit_voltage_V)
                           ? key.open_circuit_voltage_V
                           : *std::max_element(curve.voltage_V.begin(), curve.voltage_V.end());
    const double isc = std::isfinite(key.short_circuit_current_A)
                           ? key.short_circuit_current_A
                           : *std::max_element(curve.current_A.begin(), curve.current_A.end());
    double t = 0, suns = isc / kIsc_A;
    for (int pass = 0; pass < 20 && suns > 0; ++pass) {
      t = (voc - kVoc_V - fold_V * std::log(suns)) / (kVoc_V * kBeta);
      suns = isc / (kIsc_A * (1 + kAlpha * t));
    }
    curve.conditions.irradiance_W_m2 = 1000 * suns;
    curve.conditions.cell_temperature_K =
        lyrefit::kZeroCelsius_K + lyrefit::kReferenceTemperature_C + t;
    curve.conditions.cells_in_series = 60;
    curve.irradiance_known = curve.temperature_known = true;
  }
  set.options = ReadyOptions(false);
  set.options.coefficients.alpha_A_K = kIsc_A * kAlpha;
  set.options.coefficients.beta_V_K = kVoc_V * kBeta;
  Keep(every, &set);
  return set;
}

std::vector<Sweep> Steady(std::vector<Sweep> sweeps) {
  constexpr double kMissed = 5e-3;
  const auto moving = [](const Sweep& sweep) {
    return !sweep.made.fit || !sweep.made.fit->usable ||
           sweep.made.fit->rmse.refined.solved_current_A >
               kMissed * sweep.key.short_circuit_current_A;
  };
  sweeps.erase(std::remove_if(sweeps.begin(), sweeps.end(), moving), sweeps.end());
  return sweeps;
}

double LikeScatter(const std::vector<Sweep>& sweeps) {
  constexpr double kLight = 0.02, kHeat_K = 1;
  double squares = 0;
  int count = 0;
  for (const Sweep& from : sweeps) {
    for (const Sweep& to : sweeps) {
      const lyrefit::TranslationInputs &a = from.made.inputs.values, &b = to.made.inputs.values;
      if (&from == &to || std::fabs(std::log(b.irradiance_W_m2 / a.irradiance_W_m2)) > kLight ||
          std::fabs(b.temperature_C - a.temperature_C) > kHeat_K) {
        continue;
      }
      lyrefit::PreparedCurve curve = from.made.curve;
      curve.target = {b.irradiance_W_m2, b.temperature_C};
      const auto key = lyrefit::TranslatedKeyPoints(lyrefit::Procedure::kIec1, curve, a);
      if (!key) continue;
      const double off = key->max_power_W / to.key.max_power_W - 1;
      squares += off * off;
      ++count;
    }
  }
  return count > 0 ? std::sqrt(squares / count / 2) : 0;
}

Conditions ConditionsOf(double like_scatter) {
  Conditions at;
  at.light_percent = 100 * 2 * std::sqrt(2.0) * like_scatter;
  return at;
}

}  // namespace shown
