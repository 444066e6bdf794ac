// What the sky and the junctions' charge do while the sweep runs.
#include <cmath>

#include "hidden/field_case.h"

namespace hidden::field {
namespace {

void UpAndDown(Random* random, Tracer* tracer) {
  tracer->up_and_down = true;
  tracer->writes_times = random->Chance(0.7);
  if (tracer->drive == Drive::kCapacitor) tracer->drive = Drive::kEven;
}

struct Moment {
  double time;
  double u;  // voltage / open circuit
};

// A moment at which the light matters: before the knee has passed altogether.
Moment DrawMoment(Random* random, const Setup& setup) {
  Lit lit(setup.module);
  const std::vector<Instant> instants = Instants(setup.tracer, lit.Whole());
  const double voc = OpenCircuit(lit.Whole());
  const double wanted = random->Uniform(0.1, 0.95);
  const int sweep = setup.tracer.up_and_down ? random->Index(2) : 0;
  Moment best{0.5, 0};
  for (const Instant& now : instants) {
    const double u = now.voltage / voc;
    if (now.sweep != sweep || std::fabs(u - wanted) > std::fabs(best.u - wanted)) continue;
    best = {now.time, u};
  }
  return best;
}

// Falls with rising voltage, where a group's bypass diode would make it fall.
bool LooksLikeShade(const Setup& setup, double u) {
  const Tracer& tracer = setup.tracer;
  if (tracer.up_and_down || tracer.writes_times) return false;
  if ((setup.sky.size > 0) != tracer.down) return false;
  const double groups = static_cast<double>(setup.module.groups.size());
  const double nearest = std::round(u * groups) / groups;
  return nearest > 0 && nearest < 1 && std::fabs(u - nearest) < 0.03;
}

void LightStep(Random* random, Setup* setup, Truth* truth) {
  if (random->Chance(0.25)) UpAndDown(random, &setup->tracer);
  const Moment moment = DrawMoment(random, *setup);
  setup->sky.cloud = Cloud::kStep;
  setup->sky.at = moment.time;
  setup->sky.size = random->Sign() * random->LogUniform(0.03, 0.3);
  truth->accepted = {"irr_step"};
  if (LooksLikeShade(*setup, moment.u)) {
    truth->accepted.push_back("substrings");
    truth->accepted.push_back("shading");
  }
  truth->figures = {{"step", setup->sky.size}};
}

void LightDip(Random* random, Setup* setup, Truth* truth) {
  if (random->Chance(0.25)) UpAndDown(random, &setup->tracer);
  setup->sky.cloud = Cloud::kDip;
  setup->sky.at = DrawMoment(random, *setup).time;
  setup->sky.size = random->LogUniform(0.03, 0.4);
  setup->sky.width = random->LogUniform(0.03, 0.15);
  setup->sky.skew = random->Uniform(-0.5, 0.5);
  truth->accepted = {"transient"};
  truth->figures = {{"dip", setup->sky.size}};
}

void LightDrift(Random* random, Setup* setup, Truth* truth) {
  if (random->Chance(0.33)) UpAndDown(random, &setup->tracer);
  setup->sky.cloud = Cloud::kDrift;
  setup->sky.size = random->Sign() * random->LogUniform(0.01, 0.12);
  if (random->Chance(0.5)) setup->sky.skew = random->Uniform(-1.5, 1.5);
  truth->accepted = {"drift"};
  truth->figures = {{"drift", setup->sky.size}};
}

void Hysteresis(Random* random, Setup* setup, Truth* truth) {
  UpAndDown(random, &setup->tracer);
  const int parts = random->Index(3);
  if (parts != 0) setup->charge.constant = random->LogUniform(1e-3, 2e-2);
  if (parts != 1) setup->charge.diffusion = random->LogUniform(5e-4, 8e-3);
  truth->accepted = {"capacitance", "timing_skew"};
}

}  // namespace

const std::vector<Fault>& SweepFaults() {
  static const std::vector<Fault> kFaults = {{"light_step", LightStep},
                                             {"light_dip", LightDip},
                                             {"light_drift", LightDrift},
                                             {"hysteresis", Hysteresis}};
  return kFaults;
}

}  // namespace hidden::field
