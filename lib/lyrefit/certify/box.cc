#include "lyrefit/certify/box.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>

#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

// k / q in volt per kelvin as a quotient of whole numbers.
WideInterval BoltzmannOverCharge(ConstantSet constants) {
  const auto quotient = [](double above, double below) {
    return WideInterval(above) / WideInterval(below);
  };
  switch (constants) {
    case ConstantSet::kCodata:
      return quotient(1380649, 16021766340);
    case ConstantSet::kLiterature:
      return quotient(13806503, 160217646000);
    case ConstantSet::kPaper:
      return quotient(138065, 1602170000);
  }
  LOG(FATAL) << "unknown set of constants";
}

}  // namespace

WideInterval SafeThermalVoltage(const Conditions& conditions, ConstantSet constants) {
  return WideInterval(conditions.cells_in_series) * WideInterval(conditions.cell_temperature_K) *
         BoltzmannOverCharge(constants);
}

Window SafeWindow(double n_lower, double n_upper, const WideInterval& thermal_voltage_V) {
  const WideInterval one(1);
  return {Lower(Hull(one / (WideInterval(n_upper) * thermal_voltage_V))),
          Upper(Hull(one / (WideInterval(n_lower) * thermal_voltage_V)))};
}

double SafeRmse(double half_sum_of_squares, std::size_t points) {
  const Interval mean = 2.0 * Interval(half_sum_of_squares) / static_cast<double>(points);
  return std::max(0.0, Lower(sqrt(mean)));
}

double SafeGap(double rmse, double lower) {
  return rmse > 0 ? std::max(0.0, Upper(1.0 - Interval(lower) / rmse)) : 0;
}

double SafeUpperRmse(const IvCurve& curve, const WideInterval& thermal_voltage_V,
                     double photocurrent_A, double resistance_series_ohm,
                     const WideInterval& conductance_shunt_S,
                     const std::vector<SafeDiode>& diodes) {
  WideInterval sum(0);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const WideInterval current(curve.current_A[k]);
    const WideInterval vd =
        WideInterval(curve.voltage_V[k]) + WideInterval(resistance_series_ohm) * current;
    WideInterval residual = WideInterval(photocurrent_A) - conductance_shunt_S * vd - current;
    for (const SafeDiode& diode : diodes) {
      const WideInterval exponent = vd / (WideInterval(diode.n) * thermal_voltage_V);
      residual -= WideInterval(diode.saturation_current_A) * (exp(exponent) - WideInterval(1));
    }
    sum += square(residual);
  }
  return Upper(Hull(sqrt(sum / WideInterval(static_cast<double>(curve.size())))));
}

namespace {

Expected<void> CheckPair(const char* name, double lower, double upper) {
  if (lower <= upper) return {};
  return Fail(fmt::format("{0}-lower = {1:g} is above {0}-upper = {2:g}", name, lower, upper));
}

Expected<void> CheckDiode(const DiodeRanges& diode, std::size_t number) {
  const bool n = diode.n_lower >= 0.01 && diode.n_lower <= diode.n_upper && diode.n_upper <= 100;
  const bool is = diode.is_lower_A >= 0 && diode.is_lower_A <= diode.is_upper_A &&
                  diode.is_lower_A < kInfinity && diode.is_upper_A > 0;
  if (n && is) return {};
  return Fail(
      fmt::format("diode {}: n in [{:g}, {:g}] and Is in [{:g}, {:g}] A cannot be proved: n "
                  "has to lie in [0.01, 100], Is may not be fixed to 0",
                  number, diode.n_lower, diode.n_upper, diode.is_lower_A, diode.is_upper_A));
}

Window WindowOf(const CertifyOptions& options, double n_lower, double n_upper,
                double thermal_voltage_V, const WideInterval& safe_V) {
  if (options.rigorous) return SafeWindow(n_lower, n_upper, safe_V);
  return {1 / (n_upper * thermal_voltage_V), 1 / (n_lower * thermal_voltage_V)};
}

}  // namespace

Expected<void> CheckRanges(const CertifyOptions& options) {
  if (!(options.n_lower < options.n_upper)) {
    return Fail(fmt::format("n-lower = {:g} must be below n-upper = {:g}", options.n_lower,
                            options.n_upper));
  }
  TRY(CheckPair("rs", options.rs_lower_ohm, options.rs_upper_ohm));
  TRY(CheckPair("iph", options.iph_lower_A, options.iph_upper_A));
  TRY(CheckPair("is", options.is_lower_A, options.is_upper_A));
  TRY(CheckPair("rsh", options.rsh_lower_ohm, options.rsh_upper_ohm));
  std::size_t largest = 0;
  for (const Model model : options.models) {
    largest = std::max(largest, static_cast<std::size_t>(model));
  }
  if (!options.diodes.empty() && options.diodes.size() < largest) {
    return Fail(fmt::format("there are ranges of {} diodes, a model has {}", options.diodes.size(),
                            largest));
  }
  for (std::size_t d = 0; d < options.diodes.size(); ++d) {
    TRY(CheckDiode(options.diodes[d], d + 1));
  }
  return {};
}

CertifyOptions WithEveryDiode(CertifyOptions options) {
  if (options.diodes.empty()) {
    options.diodes.assign(
        static_cast<std::size_t>(Model::kTripleDiode),
        {options.n_lower, options.n_upper, options.is_lower_A, options.is_upper_A});
    return options;
  }
  for (const DiodeRanges& diode : options.diodes) {
    options.n_lower = std::min(options.n_lower, diode.n_lower);
    options.n_upper = std::max(options.n_upper, diode.n_upper);
  }
  return options;
}

Window AnyDiode(const CertifyOptions& options, double thermal_voltage_V,
                const WideInterval& safe_V) {
  return WindowOf(options, options.n_lower, options.n_upper, thermal_voltage_V, safe_V);
}

std::vector<Window> BoxOf(const CertifyOptions& options, int diodes, double thermal_voltage_V,
                          const WideInterval& safe_V) {
  std::vector<Window> box;
  for (int d = 0; d < diodes; ++d) {
    const DiodeRanges& diode = options.diodes[static_cast<std::size_t>(d)];
    Window window = WindowOf(options, diode.n_lower, diode.n_upper, thermal_voltage_V, safe_V);
    window.saturation_lower_A = diode.is_lower_A;
    window.saturation_upper_A = diode.is_upper_A;
    box.push_back(window);
  }
  return box;
}

void SetRanges(const CertifyOptions& options, MixtureData* data) {
  LinearTerm& light = data->terms[kPhotocurrentTerm];
  LinearTerm& shunt = data->terms[kShuntTerm];
  light.lower = options.iph_lower_A;
  light.upper = options.iph_upper_A;
  // Conductance ranges are rounded outwards.
  if (options.rsh_upper_ohm < kInfinity) {
    shunt.lower = Lower(Interval(1) / Interval(options.rsh_upper_ohm));
  }
  if (options.rsh_lower_ohm > 0) {
    shunt.upper = Upper(Interval(1) / Interval(options.rsh_lower_ohm));
  }
}

ModelRanges RangesOfModel(const CertifyOptions& options, int diodes, double rs_upper_ohm,
                          double reference_voltage_V) {
  ModelRanges ranges;
  ranges.n_lower = options.n_lower;
  ranges.n_upper = options.n_upper;
  ranges.rs_lower = options.rs_lower_ohm;
  ranges.rs_upper = rs_upper_ohm;
  ranges.reference_voltage_V = reference_voltage_V;
  ranges.iph_lower_A = options.iph_lower_A;
  ranges.iph_upper_A = options.iph_upper_A;
  ranges.rsh_lower_ohm = options.rsh_lower_ohm;
  ranges.rsh_upper_ohm = options.rsh_upper_ohm;
  ranges.diodes.assign(options.diodes.begin(), options.diodes.begin() + diodes);
  return ranges;
}

}  // namespace lyrefit
