// Voltages over time of the tracer types.
#include <algorithm>
#include <cmath>

#include "faults/field_tracer.h"

namespace faults::field {
namespace {

constexpr int kFine = 4000;

// Voltages at which a rising sum over a fine voltage grid reaches equal steps.
std::vector<double> EqualSteps(const std::vector<double>& voltages, const std::vector<double>& sums,
                               int count) {
  std::vector<double> steps;
  std::size_t k = 0;
  for (int i = 0; i < count; ++i) {
    const double target = sums.back() * i / (count - 1);
    while (k + 2 < sums.size() && sums[k + 1] < target) ++k;
    const double part = (target - sums[k]) / (sums[k + 1] - sums[k]);
    steps.push_back(voltages[k] + part * (voltages[k + 1] - voltages[k]));
  }
  return steps;
}

std::vector<double> Rising(const Tracer& tracer, const Sampled& curve) {
  const int count = tracer.points * tracer.averaged;
  const double voc = OpenCircuit(curve), isc = ShortCircuit(curve);
  const double first = tracer.first_voltage * voc;
  const bool capacitor = tracer.drive == Drive::kCapacitor;
  const double last =
      capacitor ? curve.VoltageAt(tracer.last_current * isc) : tracer.last_voltage * voc;
  std::vector<double> voltages, sums;
  double sum = 0;
  for (int i = 0; i <= kFine; ++i) {
    const double v = first + (last - first) * i / kFine;
    if (i > 0 && capacitor) sum += (v - voltages.back()) / curve.CurrentAt(v);
    if (i > 0 && tracer.drive == Drive::kKnee) {
      const double along = (v - voltages.back()) / voc;
      const double fall = (curve.CurrentAt(v) - curve.CurrentAt(voltages.back())) / isc;
      sum += std::hypot(along, fall);
    }
    if (i > 0 && !capacitor && tracer.drive != Drive::kKnee) sum = i;
    voltages.push_back(v);
    sums.push_back(sum);
  }
  return EqualSteps(voltages, sums, count);
}

double Steps(Random* random) { return std::pow(2.0, -random->Index(5)); }

}  // namespace

std::vector<Instant> Instants(const Tracer& tracer, const Sampled& curve) {
  std::vector<double> up = Rising(tracer, curve);
  const double mean = (up.back() - up.front()) / (up.size() - 1);
  std::vector<double> all = up;
  if (tracer.up_and_down) all.insert(all.end(), up.rbegin(), up.rend());
  if (tracer.down) std::reverse(all.begin(), all.end());
  std::vector<Instant> instants;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int sweep = i >= up.size() ? 1 : 0;
    const std::size_t from = sweep * up.size(), to = from + up.size() - 1;
    const std::size_t before = std::max(i, from + 1) - 1, after = std::min(i + 1, to);
    const double speed = (all[after] - all[before]) / (mean * static_cast<double>(after - before));
    instants.push_back({all[i], static_cast<double>(i) / (all.size() - 1), speed, sweep});
  }
  return instants;
}

Tracer DrawTracer(Bench bench, Random* random) {
  Tracer tracer;
  tracer.drive = static_cast<Drive>(random->Index(4));
  const bool capacitor = tracer.drive == Drive::kCapacitor;
  tracer.points = static_cast<int>(random->LogUniform(60, 250));
  if (capacitor && random->Chance(0.5)) tracer.points = 40 + random->Index(20);
  if (tracer.drive == Drive::kBinned) {
    tracer.points = 80 + random->Index(40);
    tracer.averaged = 5 + random->Index(12);
  }
  tracer.down = !capacitor && random->Chance(0.25);
  tracer.writes_times = random->Chance(0.35);
  tracer.seconds = random->LogUniform(0.01, capacitor ? 0.3 : 10);
  tracer.first_voltage = random->Chance(0.2) ? -0.01 : random->Uniform(0.001, 0.03);
  tracer.last_voltage = random->Chance(0.3) ? random->Uniform(0.985, 1) : random->Uniform(1, 1.025);
  tracer.last_current = random->LogUniform(0.002, 0.08);
  if (bench == Bench::kLaboratory) {
    tracer.first_voltage = -0.005;
    tracer.last_voltage = std::max(tracer.last_voltage, 1.002);
    tracer.current_noise = tracer.voltage_noise = random->LogUniform(3e-6, 5e-5);
    return tracer;
  }
  tracer.current_noise = random->LogUniform(2e-5, 4e-4);
  tracer.voltage_noise = random->LogUniform(2e-5, 3e-4);
  tracer.current_step = random->Uniform(1.2, 3) / 4096 * Steps(random);
  tracer.voltage_step = random->Uniform(1.1, 2.5) / 4096 * Steps(random);
  if (random->Chance(0.3)) {
    tracer.fine_below = random->Chance(0.5) ? 0.1 : 0.25;
    tracer.fine_gain = 1 + 5e-4 * random->Normal();
  }
  return tracer;
}

}  // namespace faults::field
