#include "lyrefit/model/model_points.h"

#include <glog/logging.h>

#include <algorithm>

#include "lyrefit/base/dual.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/roots.h"
#include "lyrefit/model/device_effects.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/solve.h"

namespace lyrefit {

OperatingPoint SolveOperatingPoint(const Device& device, const double* p, double voltage_V) {
  const PreparedDevice prepared = Prepare(device, p);
  const double limit = JunctionVoltageLimit(prepared, voltage_V);
  OperatingPoint point;
  point.junction_voltage_V = voltage_V + prepared.rs * prepared.largest_current;
  SolveTogether<1>(prepared, limit, &voltage_V, &point.junction_voltage_V, &point.current_A);
  BentCurrent<double> bent;
  PreparedBent<1>(prepared, &point.junction_voltage_V, &bent);
  point.conductance_S = bent.slope;
  return point;
}

OperatingPoint KnownOperatingPoint(const Device& device, const double* p, double voltage_V,
                                   double current_A) {
  OperatingPoint point;
  point.current_A = current_A;
  point.junction_voltage_V = voltage_V + current_A * p[device.resistance_series];
  point.conductance_S = JunctionCurrent(device, p, Dual<1>(point.junction_voltage_V, 0)).v[0];
  return point;
}

double Rmse(const Device& device, Objective objective, const double* p,
            const std::vector<double>& voltage_V, const std::vector<double>& current_A) {
  return std::sqrt(MeanSquare(device, objective, p, MakePointSet(voltage_V, current_A)));
}

namespace {

// Key points of a device with effects, from a fine sweep from short circuit to 5 % beyond the
// base's Voc.
KeyPoints ExtendedKeyPoints(const Device& device, const double* p) {
  constexpr int kPoints = 2000;
  Device base = device;
  base.effects = nullptr;
  const double voc = ModelOpenCircuit(base, p);
  if (!(voc > 0)) return FindKeyPoints({}, {});
  std::vector<double> voltage_V;
  for (int k = 0; k <= kPoints; ++k) voltage_V.push_back(1.05 * voc * k / kPoints);
  return FindKeyPoints(voltage_V, ExtendedCurrents(device, p, voltage_V));
}

}  // namespace

double ModelOpenCircuit(const Device& device, const double* p) {
  if (device.effects != nullptr) return ExtendedKeyPoints(device, p).open_circuit_voltage_V;
  // At open circuit no current flows through Rs: the junction voltage is V.
  const auto junction = [&](double v) { return JunctionCurrent(device, p, v); };
  if (!(p[kIph] > 0)) return kUnknown;
  double above = device.module_thermal_voltage_V;
  for (int k = 0; k < 60 && junction(above) > 0; ++k) above *= 2;
  return junction(above) > 0 ? kUnknown : RootBetween(junction, 0, above);
}

KeyPoints ModelKeyPoints(const Device& device, const double* p) {
  if (device.effects != nullptr) return ExtendedKeyPoints(device, p);
  KeyPoints points{kUnknown, kUnknown, kUnknown, kUnknown, kUnknown, kUnknown};
  points.short_circuit_current_A = SolveOperatingPoint(device, p, 0).current_A;
  // In the dark the current at V = 0 is zero except for rounding.
  if (!(points.short_circuit_current_A > 1e-15 * p[kIph])) return points;
  const double voc = ModelOpenCircuit(device, p);
  if (std::isnan(voc)) return points;
  // As functions of the junction voltage Vj, I = F(Vj) and V = Vj - I Rs are explicit. At the
  // maximum power point dP/dVj = I + (Vj - 2 I Rs) F'(Vj) is 0; it has the sign of dP/dV.
  const double rs = p[device.resistance_series];
  const auto power_slope = [&](double v) {
    const Dual<1> current = JunctionCurrent(device, p, Dual<1>(v, 0));
    return current.a + (v - 2 * current.a * rs) * current.v[0];
  };
  // Junction voltage at short circuit.
  const double lowest = points.short_circuit_current_A * rs;
  const double junction_V = RootBetween(power_slope, lowest, voc);
  points.open_circuit_voltage_V = voc;
  points.max_power_current_A = JunctionCurrent(device, p, junction_V);
  points.max_power_voltage_V = junction_V - points.max_power_current_A * rs;
  points.max_power_W = points.max_power_voltage_V * points.max_power_current_A;
  points.fill_factor = points.max_power_W / (points.short_circuit_current_A * voc);
  return points;
}

namespace {

// Junction voltages of short circuit, open circuit and maximum power.
struct JunctionVoltages {
  double short_V;
  double open_V;
  double power_V;
};

// A root near `at` by Newton's steps on `f`, which returns a value and its slope; NaN if they do not
// converge.
template <class F>
double RootNear(const F& f, double at) {
  constexpr int kMost = 30;
  constexpr double kSettled = 1e-14;
  for (int k = 0; k < kMost; ++k) {
    const Dual<1> value = f(at);
    const double step = value.a / value.v[0];
    at -= step;
    if (!std::isfinite(at)) break;
    if (std::fabs(step) <= kSettled * std::fabs(at)) return at;
  }
  return kUnknown;
}

// By Newton's steps; by ModelKeyPoints if they do not converge to physical values.
JunctionVoltages FindJunctionVoltages(const Device& device, const double* p,
                                      const KeyPointValues& near) {
  const double rs = p[device.resistance_series];
  const auto current = [&](double v) { return JunctionCurrent(device, p, Dual<1>(v, 0)); };
  const auto short_circuit = [&](double v) { return Dual<1>(v, 0) - current(v) * rs; };
  const auto power = [&](double v) {
    const Dual<1, Dual<1>> both = JunctionCurrent(device, p, Dual<1, Dual<1>>(Dual<1>(v, 0), 0));
    const Dual<1>& at = both.a;
    return at + (Dual<1>(v, 0) - 2 * at * rs) * both.v[0];
  };
  JunctionVoltages found;
  found.short_V = rs == 0 ? 0 : RootNear(short_circuit, near[kIscRow] * rs);
  found.open_V = RootNear(current, near[kVocRow]);
  found.power_V = RootNear(power, near[kVmpRow] + near[kPmpRow] / near[kVmpRow] * rs);
  if (found.short_V >= 0 && found.short_V <= found.power_V && found.power_V <= found.open_V &&
      p[kIph] > 0) {
    return found;
  }
  const KeyPoints points = ModelKeyPoints(device, p);
  return {points.short_circuit_current_A * rs, points.open_circuit_voltage_V,
          points.max_power_voltage_V + points.max_power_current_A * rs};
}

// Key points of a device with at most N parameters, as functions of these and of the junction
// voltage, which is unknown number N.
template <int N>
class KeyPointSlopes {
 public:
  KeyPointSlopes(const Device& device, const double* p) : device_(device) {
    for (int k = 0; k < N; ++k) p_[k] = k < device.size() ? Number(p[k], k) : Number(0.0);
  }

  void Fill(const JunctionVoltages& at_V, double* slopes) const {
    const Number& rs = p_[device_.resistance_series];
    const auto write = [&](KeyPointRow row, const Number& value) {
      std::copy_n(value.v, device_.size(), slopes + row * device_.size());
    };
    const Number short_V(at_V.short_V, N), open_V(at_V.open_V, N), power_V(at_V.power_V, N);
    write(kIscRow, CurrentAt(JunctionVoltage(short_V - CurrentAt(short_V) * rs, at_V.short_V)));
    write(kVocRow, JunctionVoltage(CurrentAt(open_V), at_V.open_V));
    const Dual<1, Number> at = JunctionCurrent(device_, p_.data(), Dual<1, Number>(power_V, 0));
    const Number v = JunctionVoltage(at.a + (power_V - 2 * at.a * rs) * at.v[0], at_V.power_V);
    const Number current = CurrentAt(v);
    const Number terminal_V = v - current * rs;
    write(kVmpRow, terminal_V);
    write(kPmpRow, terminal_V * current);
  }

 private:
  using Number = Dual<N + 1>;
  Number CurrentAt(const Number& junction_V) const {
    return JunctionCurrent(device_, p_.data(), junction_V);
  }

  // The junction voltage as a function of the parameters, from an equation that is 0 there.
  static Number JunctionVoltage(const Number& equation, double junction_V) {
    Number v(junction_V);
    for (int k = 0; k < N; ++k) v.v[k] = -equation.v[k] / equation.v[N];
    return v;
  }

  const Device& device_;
  std::array<Number, N> p_;
};

}  // namespace

KeyPointValues KeyPointsNear(const Device& device, const double* p, const KeyPointValues& near,
                             double* slopes) {
  CHECK(device.effects == nullptr);
  const JunctionVoltages at = FindJunctionVoltages(device, p, near);
  const double rs = p[device.resistance_series];
  const double current = JunctionCurrent(device, p, at.power_V);
  const double power_V = at.power_V - current * rs;
  const KeyPointValues values = {JunctionCurrent(device, p, at.short_V), at.open_V, power_V,
                                 power_V * current};
  if (slopes == nullptr) return values;
  constexpr int kOneDiode = 5;
  if (device.size() <= kOneDiode) {
    KeyPointSlopes<kOneDiode>(device, p).Fill(at, slopes);
  } else {
    CHECK_LE(device.size(), kMostKeyPointParameters);
    KeyPointSlopes<kMostKeyPointParameters>(device, p).Fill(at, slopes);
  }
  return values;
}

}  // namespace lyrefit
