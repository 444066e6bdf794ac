#include "lyrefit/model/single_diodes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lyrefit/model/pack.h"
#include "lyrefit/model/term.h"

namespace lyrefit {
namespace {

using every_processor::Load;

constexpr int kLanes = Block::kLanes;
constexpr int kMaxIterations = 120;
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
// exp() of packs is limited to this argument.
constexpr double kLargestArgument = 700;

// Eight devices. A device outside its range is replaced by a plain one, so that the other lanes
// converge undisturbed. Its result becomes NaN at the end.
struct Lanes {
  Pack iph, is, rs, gsh, a, per_volt, loss, pole;
  bool recombines = false;
  bool valid[kLanes];
};

bool InRange(const SingleDiodes& d, std::size_t i, double given) {
  const bool finite = std::isfinite(d.photocurrent[i]) && std::isfinite(given) &&
                      std::isfinite(d.saturation_current[i]) &&
                      std::isfinite(d.resistance_series[i]) && std::isfinite(d.nNsVth[i]);
  if (!finite || !(d.saturation_current[i] > 0) || !(d.resistance_series[i] >= 0) ||
      !(d.resistance_shunt[i] > 0) || !(d.nNsVth[i] > 0)) {
    return false;
  }
  if (d.recombination.data == nullptr || d.recombination[i] == 0) return true;
  return std::isfinite(d.recombination[i]) && d.recombination[i] > 0 && d.built_in_voltage[i] > 0;
}

// Loads devices [first, first + kLanes). The last device fills lanes beyond the end.
Lanes LoadLanes(const SingleDiodes& d, std::size_t first, const DeviceColumn* given, Pack* at) {
  Block iph, is, rs, gsh, a, loss, pole, where;
  Lanes lanes;
  for (int k = 0; k < kLanes; ++k) {
    const std::size_t i = std::min(first + static_cast<std::size_t>(k), d.size - 1);
    const double asked = given == nullptr ? 0 : (*given)[i];
    const bool valid = InRange(d, i, asked);
    const bool recombines =
        valid && d.recombination.data != nullptr && d.recombination[i] > 0 && d.photocurrent[i] > 0;
    lanes.valid[k] = valid;
    iph.lane[k] = valid ? d.photocurrent[i] : 1;
    is.lane[k] = valid ? d.saturation_current[i] : 1e-9;
    rs.lane[k] = valid ? d.resistance_series[i] : 0;
    gsh.lane[k] = valid ? 1 / d.resistance_shunt[i] : 0;
    a.lane[k] = valid ? d.nNsVth[i] : 1;
    loss.lane[k] = recombines ? d.photocurrent[i] * d.recombination[i] : 0;
    pole.lane[k] = recombines ? d.built_in_voltage[i] : std::numeric_limits<double>::max();
    where.lane[k] = valid ? asked : 0;
    lanes.recombines = lanes.recombines || recombines;
  }
  lanes.iph = Load(iph), lanes.is = Load(is), lanes.rs = Load(rs), lanes.gsh = Load(gsh);
  lanes.a = Load(a), lanes.loss = Load(loss), lanes.pole = Load(pole);
  lanes.per_volt = 1.0 / lanes.a;
  *at = Load(where);
  return lanes;
}

void StoreLanes(const Lanes& lanes, const Pack& values, std::size_t first, std::size_t size,
                double* out) {
  for (int k = 0; k < kLanes && first + static_cast<std::size_t>(k) < size; ++k) {
    out[first + static_cast<std::size_t>(k)] = lanes.valid[k] ? values[k] : kNotANumber;
  }
}

// F(Vd), F' and F''.
struct Slopes {
  Pack value, first, second;
};
Slopes JunctionCurrent(const Lanes& d, const Pack& vd) {
  const Pack grown = expm1(Smaller(vd * d.per_volt, Pack(kLargestArgument)));
  const Pack diode_slope = (grown + 1.0) * d.is * d.per_volt;
  Slopes f;
  f.value = d.iph - grown * d.is - vd * d.gsh;
  f.first = -diode_slope - d.gsh;
  f.second = -diode_slope * d.per_volt;
  if (d.recombines) {
    const Pack gap = 1.0 / Larger(d.pole - vd, d.pole * 1e-15);
    const Pack lost = d.loss * gap;
    f.value = f.value - lost;
    f.first = f.first - lost * gap;
    f.second = f.second - 2.0 * lost * gap * gap;
  }
  return f;
}

// Upper bound of the voltage at which the diode alone carries `current`; 0 if that is not positive.
Pack DiodeVoltage(const Lanes& d, const Pack& current, const Pack& saturation) {
  const Pack ratio =
      Smaller(Larger(current, Pack(0.0)) / Larger(saturation, Pack(1e-300)), Pack(1e300));
  return Larger(LogUpperBound(1.0 + ratio), Pack(0.0)) * d.a;
}
Pack RecombinationVoltage(const Lanes& d, const Pack& current) {
  return d.pole - d.loss / Larger(current, Pack(1e-300));
}

// Root of `excess`, a falling concave function, by Newton's method from the right. A step from
// anywhere lands at or right of the root, and no later step passes it. `noise`: effect of rounding
// on the root. Converged lanes stay fixed, so no bit of a device depends on its neighbours.
template <class Excess>
Pack FallOnRoot(const Lanes& d, Pack x, const Pack& noise, const Excess& excess) {
  const Pack start = x;
  Mask arrived = Pack(0.0) < Pack(0.0);
  for (int iteration = 0; iteration < kMaxIterations && !All(arrived); ++iteration) {
    const Slopes f = excess(x);
    const Pack next = Choose(arrived, x, Smaller(x - f.value / f.first, start));
    // Convergence is quadratic: the remaining error is the square of the step over 2 nNsVth.
    const Pack enough = Smaller(d.a, Magnitude(next)) * 1e-8 + noise;
    arrived = arrived | !(enough < Magnitude(next - x));
    x = next;
  }
  return x;
}

// The junction voltage at which F is `current`.
Pack JunctionAt(const Lanes& d, const Pack& current) {
  const Pack left = d.iph - current;
  Pack start = DiodeVoltage(d, left, d.is);
  // The current through the shunt is at most `left`, or `left` + Is above the photocurrent.
  const Pack through = Choose(left < Pack(0.0), left + d.is, left);
  start = Choose(Pack(0.0) < left, start, Pack(0.0));
  start = Smaller(start, Choose(Pack(0.0) < d.gsh, through / Larger(d.gsh, Pack(1e-300)), start));
  if (d.recombines) start = Smaller(start, RecombinationVoltage(d, left));
  return FallOnRoot(d, start, Pack(0.0), [&](const Pack& x) {
    Slopes f = JunctionCurrent(d, x);
    f.value = f.value - current;
    return f;
  });
}

Pack CurrentAt(const Lanes& d, const Pack& voltage) {
  // The junction gives at most Iph at positive voltages and at most Iph + Is at negative ones.
  const Pack lit = voltage + d.rs * d.iph;
  const Pack divider = 1.0 / (1.0 + d.rs * d.gsh);
  Pack start =
      Choose(lit < Pack(0.0), Smaller((lit + d.rs * d.is) * divider, Pack(0.0)), lit * divider);
  const Mask forward = (Pack(0.0) < lit) & (Pack(0.0) < d.rs);
  start = Choose(forward, Smaller(start, DiodeVoltage(d, lit, d.rs * d.is)), start);
  if (d.recombines) {
    const Pack limit = d.pole - d.rs * d.loss / Larger(lit, Pack(1e-300));
    start = Choose(forward, Smaller(start, limit), start);
  }
  const Pack vd = FallOnRoot(d, start, Magnitude(voltage) * 1e-15, [&](const Pack& x) {
    Slopes f = JunctionCurrent(d, x);
    f.value = voltage - x + d.rs * f.value;
    f.first = d.rs * f.first - 1.0;
    return f;
  });
  // Current from the flatter of the two curves that cross at the root.
  const Slopes f = JunctionCurrent(d, vd);
  const Pack steep = f.first * d.rs;
  const Pack line = (vd - voltage) / Larger(d.rs, Pack(1e-300));
  const Pack beyond = (voltage + d.rs * f.value - vd) / (1.0 - steep);
  return Choose(steep < Pack(-1.0), line, f.value + f.first * beyond);
}

// Maximum power point: root of I + (Vd - 2 I Rs) F', which has the sign of dP/dV, between 0 and
// open circuit. P is concave in V, so the root is unique. Newton's step is used inside the bracket,
// else bisection.
Pack PowerJunction(const Lanes& d, const Pack& open_circuit) {
  Pack low(0.0);
  Pack high = Larger(open_circuit, Pack(0.0));
  Pack x = high - LogUpperBound(1.0 + high * d.per_volt) * d.a;
  x = Choose(Pack(0.0) < x, x, 0.5 * high);
  Mask arrived = Pack(0.0) < Pack(0.0);
  for (int iteration = 0; iteration < kMaxIterations && !All(arrived); ++iteration) {
    const Slopes f = JunctionCurrent(d, x);
    const Pack arm = x - 2.0 * d.rs * f.value;
    const Pack slope = f.value + arm * f.first;
    const Pack bend = f.first * (2.0 - 2.0 * d.rs * f.first) + arm * f.second;
    const Mask rises = Pack(0.0) < slope;
    low = Choose(rises, x, low);
    high = Choose(rises, high, x);
    const Pack newton = x - slope / bend;
    const Mask inside = (bend < Pack(0.0)) & !(newton < low) & !(high < newton);
    const Pack next = Choose(arrived, x, Choose(inside, newton, 0.5 * (low + high)));
    arrived = arrived | (Magnitude(next - x) < d.a * 1e-9 + Magnitude(next) * 4e-16);
    x = next;
  }
  return x;
}

template <class Work>
void OverLanes(const SingleDiodes& devices, const DeviceColumn* given, const Work& work) {
  for (std::size_t first = 0; first < devices.size; first += kLanes) {
    Pack at;
    const Lanes lanes = LoadLanes(devices, first, given, &at);
    work(lanes, at, first);
  }
}

}  // namespace

void CurrentsAt(const SingleDiodes& devices, const DeviceColumn& voltage_V, double* current_A) {
  OverLanes(devices, &voltage_V, [&](const Lanes& d, const Pack& voltage, std::size_t first) {
    StoreLanes(d, CurrentAt(d, voltage), first, devices.size, current_A);
    for (std::size_t i = first; i < std::min(first + kLanes, devices.size); ++i) {
      // Without Rs no limit keeps the exponent small.
      if (devices.resistance_series[i] > 0 || !(voltage_V[i] / devices.nNsVth[i] > 600)) continue;
      current_A[i] = devices.photocurrent[i] - voltage_V[i] / devices.resistance_shunt[i] -
                     devices.saturation_current[i] * std::expm1(voltage_V[i] / devices.nNsVth[i]);
    }
  });
}

void VoltagesAt(const SingleDiodes& devices, const DeviceColumn& current_A, double* voltage_V) {
  OverLanes(devices, &current_A, [&](Lanes d, const Pack& current, std::size_t first) {
    const Mask none = !((current < d.iph + d.is) | (Pack(0.0) < d.gsh));
    const Pack asked = Choose(none, d.iph, current);
    const Pack voltage = JunctionAt(d, asked) - asked * d.rs;
    StoreLanes(d, Choose(none, Pack(kNotANumber), voltage), first, devices.size, voltage_V);
  });
}

void KeyPointsOf(const SingleDiodes& devices, const SingleDiodePoints& points) {
  OverLanes(devices, nullptr, [&](const Lanes& d, const Pack&, std::size_t first) {
    const auto store = [&](const Pack& values, double* out) {
      StoreLanes(d, values, first, devices.size, out);
    };
    const Pack v_oc = JunctionAt(d, Pack(0.0));
    const Pack vd = PowerJunction(d, v_oc);
    const Mask dark = d.iph < Pack(0.0);
    const Pack i_mp = Choose(dark, Pack(kNotANumber), JunctionCurrent(d, vd).value);
    const Pack v_mp = vd - i_mp * d.rs;
    store(CurrentAt(d, Pack(0.0)), points.i_sc);
    store(v_oc, points.v_oc);
    store(i_mp, points.i_mp);
    store(v_mp, points.v_mp);
    store(v_mp * i_mp, points.p_mp);
    store(CurrentAt(d, 0.5 * v_oc), points.i_x);
    const Pack between = Choose(dark, 0.5 * v_oc, 0.5 * (v_oc + v_mp));
    store(Choose(dark, Pack(kNotANumber), CurrentAt(d, between)), points.i_xx);
  });
}

}  // namespace lyrefit
