#include "faults/field_tracer.h"

#include <algorithm>
#include <cmath>

namespace faults::field {
namespace {

constexpr double kRung = 0.008;  // step of the logarithm of the light

double Rounded(double value, double step) {
  return step > 0 ? step * std::round(value / step) : value;
}

double GainOf(const Tracer& tracer, double current, double isc) {
  return std::fabs(current) < tracer.fine_below * isc ? tracer.fine_gain : 1;
}

struct Averaged {
  double voltage, current, time;
};

// Adds the reading of the converter: rounded, with a finer step below the range switch.
void Add(const Rig& rig, const Averaged& mean, double isc, double voc, int sweep,
         Readings* readings) {
  const Tracer& tracer = rig.tracer;
  const bool fine = std::fabs(mean.current) < tracer.fine_below * isc;
  const double step = tracer.current_step * isc * (fine ? 0.1 : 1);
  const double voltage = Rounded(std::min(mean.voltage, tracer.voltage_end * voc),
                                 std::max(tracer.voltage_step, tracer.voltage_bin) * voc);
  const double current = mean.current * GainOf(tracer, mean.current, isc);
  readings->voltage.push_back(voltage);
  readings->current.push_back(Rounded(std::max(current, tracer.least_current * isc), step));
  readings->time.push_back(mean.time);
  readings->sweep.push_back(sweep);
}

double Charging(const Rig& rig, const Sampled& curve, const Instant& now, double isc, double voc) {
  if (rig.charge.constant == 0 && rig.charge.diffusion == 0) return 0;
  const double slope = std::min(-1 / curve.PointAtVoltage(now.voltage).slope, 60 * isc / voc);
  const double delivered = std::max(curve.CurrentAt(now.voltage) / isc, 0.0);
  return now.speed * (rig.charge.constant * isc + rig.charge.diffusion * voc * slope) /
         (1 + rig.charge.fall * delivered);
}

}  // namespace

const Sampled& Lit::Rung(int rung) {
  const auto found = rungs_.find(rung);
  if (found != rungs_.end()) return found->second;
  return rungs_.emplace(rung, CurveOf(module_, std::exp(kRung * rung))).first->second;
}

// Quadratic interpolation over the logarithm of the light at fixed voltage.
double Lit::Current(double voltage, double light) {
  if (light == 1) return Rung(0).CurrentAt(voltage);
  const double place = std::log(light) / kRung;
  const int rung = static_cast<int>(std::lround(place));
  const double t = place - rung;
  const double below = Rung(rung - 1).CurrentAt(voltage), above = Rung(rung + 1).CurrentAt(voltage);
  const double here = Rung(rung).CurrentAt(voltage);
  return here + t * (above - below) / 2 + t * t * ((above + below) / 2 - here);
}

double OpenCircuit(const Sampled& curve) { return curve.VoltageAt(0); }
double ShortCircuit(const Sampled& curve) { return curve.CurrentAt(0); }

Readings Exact(const Rig& rig, Lit* lit) {
  const double isc = ShortCircuit(lit->Whole()), voc = OpenCircuit(lit->Whole());
  Readings readings;
  for (const Instant& now : Instants(rig.tracer, lit->Whole())) {
    readings.voltage.push_back(now.voltage);
    const double current = lit->Current(now.voltage, rig.sky.Light(now.time)) -
                           Charging(rig, lit->Whole(), now, isc, voc);
    readings.current.push_back(current * GainOf(rig.tracer, current, isc));
    readings.time.push_back(now.time);
    readings.sweep.push_back(now.sweep);
  }
  return readings;
}

Readings Measured(const Rig& rig, Lit* lit, Random* random) {
  const double isc = ShortCircuit(lit->Whole()), voc = OpenCircuit(lit->Whole());
  Readings readings;
  Averaged sum{0, 0, 0};
  int summed = 0;
  for (const Instant& now : Instants(rig.tracer, lit->Whole())) {
    double current = lit->Current(now.voltage, rig.sky.WanderingLight(now.time));
    current += isc * rig.departure.At(now.voltage / voc, 1 - current / isc);
    current -= Charging(rig, lit->Whole(), now, isc, voc);
    sum.current += current + rig.tracer.current_noise * isc * random->Normal();
    sum.voltage += now.voltage + rig.tracer.voltage_noise * voc * random->Normal();
    sum.time += now.time;
    if (++summed < rig.tracer.averaged) continue;
    Add(rig, {sum.voltage / summed, sum.current / summed, sum.time / summed}, isc, voc, now.sweep,
        &readings);
    sum = {0, 0, 0};
    summed = 0;
  }
  return readings;
}

}  // namespace faults::field
