// Faults of the sweep: varying light, junction charge and the tracer.
#include <algorithm>
#include <cmath>

#include "faults/field_case.h"

namespace faults::field {
namespace {

void UpAndDown(Random* random, Tracer* tracer) {
  tracer->up_and_down = true;
  tracer->writes_times = random->Chance(0.7);
  if (tracer->drive == Drive::kCapacitor) tracer->drive = Drive::kEven;
}

struct Moment {
  double time;
  double u;  // voltage / open-circuit voltage
};

// A time before the end of the knee, where the current still depends on the light.
Moment DrawMoment(Random* random, const Rig& rig) {
  Lit lit(rig.module);
  const std::vector<Instant> instants = Instants(rig.tracer, lit.Whole());
  const double voc = OpenCircuit(lit.Whole());
  const double wanted = random->Uniform(0.1, 0.95);
  const int sweep = rig.tracer.up_and_down ? random->Index(2) : 0;
  Moment best{0.5, 0};
  for (const Instant& now : instants) {
    const double u = now.voltage / voc;
    if (now.sweep != sweep || std::fabs(u - wanted) > std::fabs(best.u - wanted)) continue;
    best = {now.time, u};
  }
  return best;
}

// The light step lowers the current with rising voltage, near a voltage where a bypass diode would.
bool LooksLikeShade(const Rig& rig, double u, double nearly) {
  const Tracer& tracer = rig.tracer;
  if (tracer.up_and_down || tracer.writes_times) return false;
  if ((rig.sky.size > 0) != tracer.down) return false;
  const double groups = static_cast<double>(rig.module.groups.size());
  const double nearest = std::round(u * groups) / groups;
  return nearest > 0 && nearest < 1 && std::fabs(u - nearest) < nearly;
}

void LightStep(Random* random, Rig* rig, Truth* truth) {
  if (random->Chance(0.25)) UpAndDown(random, &rig->tracer);
  const Moment moment = DrawMoment(random, *rig);
  rig->sky.cloud = Cloud::kStep;
  rig->sky.at = moment.time;
  rig->sky.size = random->Sign() * random->LogUniform(0.03, 0.3);
  truth->accepted = {"irr_step"};
  if (LooksLikeShade(*rig, moment.u, 0.03)) {
    truth->accepted.push_back("substrings");
    truth->accepted.push_back("shading");
  }
  truth->figures = {{"step", rig->sky.size}};
}

// Edge of a cloud: the light goes over to another level within a part of the sweep.
void LightEdge(Random* random, Rig* rig, Truth* truth) {
  constexpr double kNearly = 0.08;  // of Voc: a slow step is placed no better
  const Moment moment = DrawMoment(random, *rig);
  rig->sky.cloud = Cloud::kEdge;
  rig->sky.at = moment.time;
  rig->sky.size = random->Sign() * random->LogUniform(0.08, 0.5);
  rig->sky.width = random->LogUniform(0.02, 0.12);
  truth->accepted = {"irr_step"};
  if (LooksLikeShade(*rig, moment.u, kNearly)) {
    truth->accepted.insert(truth->accepted.end(), {"substrings", "shading"});
  }
  truth->figures = {{"step", rig->sky.size}};
}

void LightDip(Random* random, Rig* rig, Truth* truth) {
  if (random->Chance(0.25)) UpAndDown(random, &rig->tracer);
  rig->sky.cloud = Cloud::kDip;
  rig->sky.at = DrawMoment(random, *rig).time;
  rig->sky.size = random->LogUniform(0.03, 0.4);
  rig->sky.width = random->LogUniform(0.03, 0.15);
  rig->sky.skew = random->Uniform(-0.5, 0.5);
  truth->accepted = {"transient"};
  truth->figures = {{"dip", rig->sky.size}};
}

void LightDrift(Random* random, Rig* rig, Truth* truth) {
  if (random->Chance(0.33)) UpAndDown(random, &rig->tracer);
  rig->sky.cloud = Cloud::kDrift;
  rig->sky.size = random->Sign() * random->LogUniform(0.01, 0.12);
  if (random->Chance(0.5)) rig->sky.skew = random->Uniform(-1.5, 1.5);
  truth->accepted = {"drift"};
  truth->figures = {{"drift", rig->sky.size}};
}

void Hysteresis(Random* random, Rig* rig, Truth* truth) {
  UpAndDown(random, &rig->tracer);
  const int parts = random->Index(3);
  if (parts != 0) rig->charge.constant = random->LogUniform(1e-3, 2e-2);
  if (parts != 1) rig->charge.diffusion = random->LogUniform(5e-4, 8e-3);
  truth->accepted = {"hysteresis", "capacitance", "timing_skew"};
}

// Slow charge as in perovskites, whose time constants fall with the current.
void FallingHysteresis(Random* random, Rig* rig, Truth* truth) {
  Hysteresis(random, rig, truth);
  rig->charge.constant = random->LogUniform(5e-3, 5e-2);
  rig->charge.fall = random->LogUniform(2, 20);
}

// One sweep cannot distinguish a range switch from a step of the light: both names are accepted.
void RangeSwitch(Random* random, Rig* rig, Truth* truth) {
  if (random->Chance(0.4)) UpAndDown(random, &rig->tracer);
  rig->tracer.averaged = 1;
  rig->tracer.fine_below = random->Uniform(0.25, 0.95);
  rig->tracer.fine_gain = 1 + random->Sign() * random->LogUniform(0.006, 0.06);
  truth->accepted = {"range_switch"};
  if (!rig->tracer.up_and_down) truth->accepted.push_back("irr_step");
  truth->figures = {{"gain", rig->tracer.fine_gain - 1}};
}

void VoltageBins(Random* random, Rig* rig, Truth* truth) {
  rig->tracer.averaged = 1;
  rig->tracer.voltage_bin = random->LogUniform(2.5e-3, 1.2e-2);
  truth->accepted = {"voltage_bins"};
}

void Limits(Random* random, Rig* rig, Truth* truth) {
  rig->tracer.averaged = 1;
  rig->tracer.current_step = 0;
  rig->tracer.last_voltage = 1.02;
  rig->tracer.last_current = 0.002;
  if (rig->tracer.drive == Drive::kCapacitor) rig->tracer.drive = Drive::kKnee;
  rig->tracer.points = std::max(rig->tracer.points, 100);
  const bool voltage = random->Chance(0.5);
  if (voltage) rig->tracer.voltage_end = random->Uniform(0.88, 0.94);
  if (!voltage) rig->tracer.least_current = random->Uniform(0.25, 0.6);
  truth->accepted = {"clip"};
}

}  // namespace

const std::vector<Fault>& SweepFaults() {
  static const std::vector<Fault> kFaults = {{"light_step", LightStep},
                                             {"light_dip", LightDip},
                                             {"light_drift", LightDrift},
                                             {"hysteresis", Hysteresis},
                                             {"falling_hysteresis", FallingHysteresis},
                                             {"range_switch", RangeSwitch},
                                             {"voltage_bins", VoltageBins},
                                             {"limits", Limits},
                                             {"light_edge", LightEdge}};
  return kFaults;
}

}  // namespace faults::field
