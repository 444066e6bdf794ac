#include "lyrefit/model/two_junctions.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "lyrefit/base/dual.h"
#include "lyrefit/base/roots.h"
#include "lyrefit/model/term.h"

namespace lyrefit {
namespace {

constexpr double kLeastConductancePerVolt = 1e-13;  // of the photocurrent
constexpr double kSmallestSaturation_A = 1e-300;

struct Junction {
  double photocurrent;
  double saturation;
  double per_volt;  // 1 / (n Vt)
  double conductance;
};

Junction JunctionOf(double thermal_voltage_V, const double* p, int j) {
  Junction junction{};
  junction.photocurrent = p[JunctionPhotocurrent(j)];
  junction.saturation = std::max(p[JunctionSaturation(j)], kSmallestSaturation_A);
  junction.per_volt = 1 / (std::max(p[JunctionIdeality(j)], kSmallestIdeality) * thermal_voltage_V);
  const double least = kLeastConductancePerVolt * (std::fabs(junction.photocurrent) + 1e-6);
  junction.conductance = std::max(1 / p[JunctionShunt(j)], least);
  return junction;
}

// F(u): the delivered current with its derivative by the junction voltage.
Dual<1> CurrentAt(const Junction& junction, double u) {
  const Dual<1> voltage(u, 0);
  return DiodeCurrent(junction.saturation, junction.per_volt, voltage) -
         voltage * junction.conductance + junction.photocurrent;
}

struct JunctionPoint {
  double voltage;
  double fall;  // -dF/du, in siemens
};

// The voltage at which a junction delivers `current`. F falls and is concave, so Newton's steps
// from the right stay there. The diode alone, or the shunt alone, carries less than both: each
// gives a start at the right of the root.
JunctionPoint VoltageOf(const Junction& junction, double current) {
  constexpr int kMostSteps = 100;
  const double through = junction.photocurrent - current;
  double u = 0;
  if (through > 0) {
    u = std::min(std::log1p(through / junction.saturation) / junction.per_volt,
                 through / junction.conductance);
  }
  for (int k = 0;; ++k) {
    const Dual<1> at = CurrentAt(junction, u);
    const double step = (at.a - current) / at.v[0];
    if (k == kMostSteps || !(std::fabs(step) > 1e-15 * (std::fabs(u) + 1e-3))) {
      return {u - step, -at.v[0]};
    }
    // Near the root, a step is as short as the rounding error of the diode's current allows.
    if (k > 0 && std::fabs(step) < 1e-9 / junction.per_volt) return {u - step, -at.v[0]};
    u -= step;
  }
}

struct TwoPoints {
  Junction junction[2];
  JunctionPoint point[2];
  double resistance;  // -dV/dI

  double Voltage(double current, double series) const {
    return point[0].voltage + point[1].voltage - current * series;
  }
};

void Settle(double current, double series, TwoPoints* at) {
  at->resistance = series;
  for (int j = 0; j < 2; ++j) {
    at->point[j] = VoltageOf(at->junction[j], current);
    at->resistance += 1 / at->point[j].fall;
  }
}

TwoPoints JunctionsOf(double thermal_voltage_V, const double* p) {
  TwoPoints at{};
  for (int j = 0; j < 2; ++j) at.junction[j] = JunctionOf(thermal_voltage_V, p, j);
  return at;
}

void FillSlopes(const double* p, double current, const TwoPoints& at, double* slopes) {
  using OfTwo = Dual<2>;
  for (int j = 0; j < 2; ++j) {
    const Junction& junction = at.junction[j];
    const JunctionPoint& point = at.point[j];
    const OfTwo diode = DiodeCurrent(OfTwo(junction.saturation, 0), OfTwo(junction.per_volt, 1),
                                     OfTwo(point.voltage));
    const double weight = 1 / (point.fall * at.resistance);
    slopes[JunctionPhotocurrent(j)] = weight;
    slopes[JunctionSaturation(j)] = weight * diode.v[0];
    slopes[JunctionIdeality(j)] = -weight * diode.v[1] * junction.per_volt / p[JunctionIdeality(j)];
    slopes[JunctionShunt(j)] = weight * point.voltage / (p[JunctionShunt(j)] * p[JunctionShunt(j)]);
  }
  slopes[kTwoJunctionSeries] = -current / at.resistance;
}

ParameterInfo InfoOf(int j, const char* symbol, const char* name, const char* unit,
                     const std::string& doc, ParameterKind kind) {
  const std::string number = std::to_string(j + 1);
  return {symbol + number, std::string(name) + "_" + number, unit, doc + " of junction " + number,
          kind};
}

}  // namespace

std::vector<ParameterInfo> TwoJunctionInfos() {
  std::vector<ParameterInfo> infos;
  for (int j = 0; j < 2; ++j) {
    infos.push_back(
        InfoOf(j, "Iph", "photocurrent", "A", "photocurrent", ParameterKind::kPhotocurrent));
    infos.push_back(InfoOf(j, "Is", "saturation_current", "A", "saturation current",
                           ParameterKind::kSaturation));
    infos.back().with[0] = JunctionIdeality(j);
    infos.push_back(InfoOf(j, "n", "n", "", "ideality", ParameterKind::kIdeality));
    infos.push_back(
        InfoOf(j, "Rsh", "resistance_shunt", "ohm", "shunt resistance", ParameterKind::kShunt));
  }
  infos.push_back({"Rs", "resistance_series", "ohm", "series resistance of the whole device",
                   ParameterKind::kSeries});
  return infos;
}

double TwoJunctionCurrent(double thermal_voltage_V, const double* p, double voltage_V,
                          double* slopes, double start_A) {
  constexpr int kMostSteps = 200;
  const double series = p[kTwoJunctionSeries];
  TwoPoints at = JunctionsOf(thermal_voltage_V, p);
  const double scale =
      std::max(at.junction[0].photocurrent, at.junction[1].photocurrent) + kSmallestSaturation_A;
  // Without a start the lower photocurrent: near the root where it limits, and at the right of it
  // beyond the knee.
  double current = std::isfinite(start_A)
                       ? start_A
                       : std::min(at.junction[0].photocurrent, at.junction[1].photocurrent);
  for (int k = 0; k < kMostSteps; ++k) {
    Settle(current, series, &at);
    const double step = (at.Voltage(current, series) - voltage_V) / at.resistance;
    current += step;
    if (!(std::fabs(step) > 1e-14 * (std::fabs(current) + scale))) break;
  }
  if (slopes != nullptr) {
    Settle(current, series, &at);
    FillSlopes(p, current, at, slopes);
  }
  return current;
}

double TwoJunctionVoltage(double thermal_voltage_V, const double* p, double current_A) {
  TwoPoints at = JunctionsOf(thermal_voltage_V, p);
  Settle(current_A, p[kTwoJunctionSeries], &at);
  return at.Voltage(current_A, p[kTwoJunctionSeries]);
}

KeyPoints TwoJunctionKeyPoints(double thermal_voltage_V, const double* p) {
  const double isc = TwoJunctionCurrent(thermal_voltage_V, p, 0);
  KeyPoints points{isc, kUnknown, kUnknown, kUnknown, kUnknown, kUnknown};
  const double voc = TwoJunctionVoltage(thermal_voltage_V, p, 0);
  if (!(voc > 0) || !(isc > 0)) return points;
  points.open_circuit_voltage_V = voc;
  // Power is concave in the current: the root of its derivative V + I dV/dI.
  const double series = p[kTwoJunctionSeries];
  TwoPoints at = JunctionsOf(thermal_voltage_V, p);
  const auto slope = [&](double current) {
    Settle(current, series, &at);
    return at.Voltage(current, series) - current * at.resistance;
  };
  const double imp = RootBetween(slope, 0, isc);
  points.max_power_current_A = imp;
  points.max_power_voltage_V = TwoJunctionVoltage(thermal_voltage_V, p, imp);
  points.max_power_W = imp * points.max_power_voltage_V;
  points.fill_factor = points.max_power_W / (isc * voc);
  return points;
}

}  // namespace lyrefit
