#include "plant/scale.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/roots.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

constexpr double kIdeality = 1.1;        // of a typical cell
constexpr double kTypicalCell_V = 0.62;  // Voc of a cell, where the number of cells is not known
constexpr double kAlpha_1_K = 5e-4;      // of Isc
// Voc of a cell tends to 1.21 V of silicon at 0 K (Green 2003, doi:10.1002/pip.496); of materials
// with more Voc, to 0.55 V above it.
constexpr double kSiliconVoc0_V = 1.21;
constexpr double kHighestSilicon_V = 0.8;
constexpr double kAboveVoc_V = 0.55;

double ParameterOf(const TranslatedDevice& at, const char* symbol) {
  for (int i = 0; i < at.device.size(); ++i) {
    if (at.device.parameters[i].symbol == symbol) return at.parameters[i];
  }
  return kUnknown;
}

}  // namespace

ScaleVector LogsOf(const StringFigures& figures) {
  const StringFigures& f = figures;
  return {std::log(f.isc_A), std::log(f.voc_V), std::log(f.imp_A * f.vmp_V / (f.isc_A * f.voc_V)),
          std::log(f.vmp_V / f.voc_V), std::log(f.slope_ohm * f.isc_A / f.voc_V)};
}

ScaleVector Difference(const ScaleVector& one, const ScaleVector& other) {
  ScaleVector difference{};
  for (int q = 0; q < kScaleQuantities; ++q) difference[q] = one[q] - other[q];
  return difference;
}

StringFigures FiguresByPlan(const PlannedString& line, double irradiance_W_m2,
                            double temperature_K) {
  const Translation& law = line.module->translation;
  const TranslatedDevice at = TranslateTo(law, line.module->shared, irradiance_W_m2, temperature_K);
  const KeyPoints key = ModelKeyPoints(at.device, at.parameters.data());
  const double scale_V = ParameterOf(at, "n1") * at.device.module_thermal_voltage_V;
  const double voc = key.open_circuit_voltage_V, rsh = ParameterOf(at, "Rsh");
  // At open circuit the diode carries what the shunt does not.
  const double diode_A = ParameterOf(at, "Iph") - voc / rsh;
  const double slope = ParameterOf(at, "Rs") + 1 / (diode_A / scale_V + 1 / rsh);
  const double m = line.modules_in_series, s = line.strings_in_parallel;
  return {key.short_circuit_current_A * s, voc * m, key.max_power_current_A * s,
          key.max_power_voltage_V * m, slope * m / s};
}

ScaleDevice::ScaleDevice(const StringFigures& figures, int cells, double temperature_K) {
  const double per_cell = figures.voc_V / std::max(cells, 1);
  const bool plausible = cells > 0 && per_cell > 0.35 && per_cell < 1.3;
  cells_ = plausible ? cells
                     : std::max(static_cast<int>(std::lround(figures.voc_V / kTypicalCell_V)), 1);
  if (std::isfinite(temperature_K)) temperature_K_ = temperature_K;
  diode_.photocurrent = figures.isc_A;
  diode_.scale_V = kIdeality * cells_ * ThermalVoltage(temperature_K_);
  diode_.saturation = SaturationCurrent(figures.isc_A, figures.voc_V, diode_.scale_V);
  const double slope =
      std::isfinite(figures.slope_ohm) ? figures.slope_ohm : 0.08 * figures.voc_V / figures.isc_A;
  diode_.series = std::max(slope - diode_.scale_V / figures.isc_A, 0.1 * slope);
  healthy_ = LogsOfDiode(diode_);
}

double ScaleDevice::VoltageAt(const Diode& diode, double current) {
  return DiodeVoltage(diode.photocurrent - current, diode.saturation, diode.scale_V) -
         current * diode.series;
}

// A module in reverse carries the current of its string against its own: it stands on its curve
// beyond open circuit, at the current -I, and takes V(-I) = Voc + a ln(1 + I / Iph) + I Rs from the
// string. Its bypass diodes see Voc in reverse and stay off, so that they help nothing. At open
// circuit the string thus loses twice the module's Voc, and its slope is that of all modules still,
// since each is at I = 0. (Of missing modules the slope falls as Voc does.) Under current it loses
// still more, which lowers the fill factor.
ScaleVector ScaleDevice::LogsOfDiode(const Diode& diode, double reversed) {
  const auto voltage = [&](double current) {
    const double forward = (1 - reversed) * VoltageAt(diode, current);
    return reversed > 0 ? forward - reversed * VoltageAt(diode, -current) : forward;
  };
  StringFigures figures;
  figures.voc_V = voltage(0);
  const double step = 1e-4 * diode.photocurrent;
  figures.slope_ohm = (voltage(-step) - voltage(step)) / (2 * step);
  figures.isc_A = RootBetween(voltage, 0, diode.photocurrent);
  const auto power = [&](double current) { return current * voltage(current); };
  figures.imp_A = MaximumBetween(power, 0.5 * figures.isc_A, figures.isc_A);
  figures.vmp_V = voltage(figures.imp_A);
  return LogsOf(figures);
}

ScaleVector ScaleDevice::ByLight(double factor) const {
  Diode dim = diode_;
  dim.photocurrent *= factor;
  return Difference(LogsOfDiode(dim), healthy_);
}

ScaleVector ScaleDevice::ByWarmth(double kelvin) const {
  const double voc_V = VoltageAt(diode_, 0), cell_V = voc_V / cells_;
  const double at_zero_V = cell_V < kHighestSilicon_V ? kSiliconVoc0_V : cell_V + kAboveVoc_V;
  Diode warm = diode_;
  warm.photocurrent *= 1 + kAlpha_1_K * kelvin;
  warm.scale_V *= (temperature_K_ + kelvin) / temperature_K_;
  const double warm_V = voc_V - kelvin * cells_ * (at_zero_V - cell_V) / temperature_K_;
  warm.saturation = SaturationCurrent(warm.photocurrent, warm_V, warm.scale_V);
  return Difference(LogsOfDiode(warm), healthy_);
}

ScaleVector ScaleDevice::ByResistance(double ohm) const {
  Diode more = diode_;
  more.series += ohm;
  return Difference(LogsOfDiode(more), healthy_);
}

ScaleVector ScaleDevice::ByReversed(double of_modules) const {
  return Difference(LogsOfDiode(diode_, of_modules), healthy_);
}

}  // namespace lyrefit
