#include "trend/years_instruments.h"

#include <algorithm>
#include <cmath>

#include "faults/field_case.h"

namespace years {
namespace {

using faults::Random;
using faults::field::Point;
using faults::field::Sampled;

double Rounded(double value, double step) { return step * std::round(value / step); }

// Voltage of a reading over the open-circuit voltage: a third of the readings up to 0.7.
double Place(int i, int points) {
  const int knee = points * 11 / 30;
  return i < knee ? 0.005 + 0.695 * i / knee : 0.7 + 0.305 * (i - knee) / (points - 1 - knee);
}

faults::field::Sky DrawSky(const Instant& now, Random* random) {
  faults::field::Sky sky;
  const double calm = random->LogUniform(5e-5, 4e-4);
  sky.wander = faults::field::DrawWander(calm + 0.015 * now.restless * random->Unit(), random);
  if (now.sky == Sky::kBroken && random->Chance(0.04)) {
    sky.cloud = random->Chance(0.5) ? faults::field::Cloud::kDrift : faults::field::Cloud::kStep;
    sky.at = random->Uniform(0.1, 0.9);
    sky.size = 0.05 * random->Normal();
  }
  return sky;
}

// Voltage above the maximum at which the module gives `power`.
Operating Throttled(const Operating& maximum, double power, LitModule* module) {
  double low = 0, high = maximum.current;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (middle * module->AtCurrent(middle).voltage > power ? high : low) = middle;
  }
  return {low, module->AtCurrent(low).voltage};
}

}  // namespace

Instruments DrawInstruments(const Design& design, int points, Random* random) {
  Instruments drawn;
  drawn.points = points;
  drawn.light_gain = 1 + 0.02 * random->Normal();
  drawn.light_drift = -0.005 + 0.003 * random->Normal();
  drawn.light_offset_Wm2 = random->Normal();
  drawn.light_cosine = 0.03 * random->Normal();
  drawn.kelvin_offset = 1.3 * random->Normal();
  drawn.kelvin_gap = random->Uniform(1, 3);
  drawn.current_gain = 1 + 0.002 * random->Normal();
  drawn.voltage_gain = 1 + 0.001 * random->Normal();
  drawn.departure = faults::field::DrawDeparture(random);
  LitModule module(design, State{}, 1, 298.15);
  const double largest = module.LargestPhotocurrent();
  const Sampled curve =
      faults::field::Sample([&](double current) { return module.AtCurrent(current); }, -largest,
                            1.02 * largest, 1e-6 * largest);
  faults::field::SettleDeparture(curve, random->LogUniform(2e-4, 8e-4), &drawn.departure);
  return drawn;
}

Shown Sensed(const Instruments& instruments, const Instant& now, double years, Random* random) {
  const double grazing = std::pow(1 - std::clamp(now.incidence, 0.0, 1.0), 2);
  const double gain = instruments.light_gain * (1 + instruments.light_drift * years) *
                      (1 + instruments.light_cosine * grazing);
  // The sensor's time differs from that of the sweep by a second or two.
  const double late = std::clamp(0.1 * now.restless * random->Normal(), -0.3, 0.3);
  const double light = now.light * gain * (1 + late + instruments.light_noise * random->Normal());
  const double celsius = now.kelvin - kKelvin + instruments.kelvin_offset -
                         instruments.kelvin_gap * now.light / 1000 +
                         (instruments.kelvin_noise + 3 * now.restless) * random->Normal();
  return {std::max(light + instruments.light_offset_Wm2, 0.0), celsius};
}

Sweep Trace(const Instruments& instruments, const Instant& now, LitModule* module, Random* random) {
  const faults::field::Sky sky = instruments.steady ? faults::field::Sky{} : DrawSky(now, random);
  const double voc = module->OpenCircuit(), isc = module->ShortCircuit();
  const int points = instruments.points;
  Sweep sweep;
  double guess = isc;
  for (int i = 0; i < points; ++i) {
    const double u = Place(i, points), voltage = u * voc;
    const Point at =
        module->AtVoltage(voltage, sky.WanderingLight(double(i) / (points - 1)), guess);
    guess = i + 1 < points ? at.current + (Place(i + 1, points) * voc - voltage) / at.slope : 0;
    double current = at.current;
    if (instruments.departure.size != 0) {
      current += isc * instruments.departure.At(u, 1 - current / isc);
    }
    sweep.voltage.push_back(
        Rounded(instruments.voltage_gain * (voltage + instruments.noise * voc * random->Normal()),
                instruments.voltage_step_V));
    sweep.current.push_back(
        Rounded(instruments.current_gain * (current + instruments.noise * isc * random->Normal()),
                instruments.current_step_A));
  }
  return sweep;
}

void Spoil(Sweep* sweep, Random* random) {
  const int kind = random->Index(4), points = static_cast<int>(sweep->current.size());
  const int from = random->Index(points);
  const double factor = random->Uniform(0.3, 0.9);
  for (int i = 0; i < points; ++i) {
    double& current = sweep->current[i];
    if (kind == 0 && i >= from) current *= factor;
    if (kind == 1 && random->Chance(0.1)) current *= random->Uniform(0, 3);
    if (kind == 2) current *= factor * random->Uniform(0.97, 1.03);
    if (kind == 3) current = 0;
  }
}

Inverter DrawInverter(double rated_W, Random* random) {
  Inverter inverter;
  inverter.tracking = random->LogUniform(0.002, 0.008);
  if (random->Chance(0.5)) inverter.limit_W = random->Uniform(0.75, 0.95) * rated_W;
  inverter.curtailed_W = random->Uniform(0.3, 0.6) * rated_W;
  return inverter;
}

Held Hold(const Inverter& inverter, const Operating& maximum, bool curtailed, LitModule* module,
          Random* random) {
  const bool fails = random->Chance(inverter.failing);
  const double away = fails ? random->Uniform(-0.3, 0.12) : inverter.tracking * random->Normal();
  const double limit = std::min(inverter.limit_W, curtailed ? inverter.curtailed_W : 1e9);
  Held held{maximum, fails ? Mode::kFailing : Mode::kTracking};
  if (maximum.power() > limit) {
    held.at = Throttled(maximum, limit, module);
    held.mode = inverter.limit_W > limit ? Mode::kCurtailed : Mode::kClipped;
  } else {
    held.at.voltage = std::min(maximum.voltage * (1 + away), 0.98 * module->OpenCircuit());
    held.at.current = module->AtVoltage(held.at.voltage, 1, maximum.current).current;
  }
  held.at.voltage =
      Rounded(held.at.voltage * (1 + inverter.noise * random->Normal()), inverter.voltage_step_V);
  held.at.current =
      Rounded(held.at.current * (1 + inverter.noise * random->Normal()), inverter.current_step_A);
  return held;
}

}  // namespace years
