#include <cmath>

#include "faults/injection.h"

namespace faults {
namespace {

using Names = std::vector<std::string>;
constexpr Kind kFwd = Kind::kForward, kRev = Kind::kReverse, kUpDown = Kind::kUpDown;

// On one forward sweep a drift is identifiable only if the light rises, faster than any shunt
// lowers the current.
bool Drift(const Shape& shape, double strength, Scene* scene) {
  scene->effects.drift = scene->plan.kind == kFwd ? strength : shape.sign * strength;
  return true;
}

bool IrradianceStep(const Shape& shape, double strength, Scene* scene) {
  scene->effects.step = shape.sign * strength;
  scene->effects.step_at = -0.4 + 0.8 * shape.parts[0];
  return true;
}

bool Transient(const Shape& shape, double strength, Scene* scene) {
  scene->effects.dip = (shape.parts[2] < 0.8 ? 1 : -1) * strength;
  scene->effects.dip_at = -0.42 + 0.84 * shape.parts[0];
  scene->effects.dip_width = 0.015 + 0.085 * shape.parts[1];
  return true;
}

double CellRate(const Scene& scene) { return scene.plan.Rate() / scene.device.cells; }

// The strength is the charging current beside the knee, constant, from diffusion, or both.
bool Capacitance(const Shape& shape, double strength, Scene* scene) {
  const double constant = shape.parts[0] < 0.35 ? 1 : shape.parts[0] < 0.6 ? 0 : shape.parts[1];
  const double n_vt = scene->device.ideality * kBoltzmannOverCharge * kReferenceK;
  const double by_rate = strength / CellRate(*scene);
  scene->effects.capacitance = constant * by_rate * scene->device.photocurrent;
  scene->effects.diffusion_s = (1 - constant) * by_rate * n_vt;
  return true;
}

bool TimingSkew(const Shape& shape, double strength, Scene* scene) {
  scene->effects.skew_s = shape.sign * strength / CellRate(*scene);
  return true;
}

Names DriftTwins(const Shape&, const Scene& scene) {
  return scene.plan.kind == kUpDown ? Names{} : Names{"temp_drift"};
}

Names StepTwins(const Shape&, const Scene& scene) {
  const bool at_turn = scene.plan.kind == kUpDown && std::fabs(scene.effects.step_at) < 0.04;
  return at_turn ? Names{"capacitance"} : Names{};
}

Names TransientTwins(const Shape&, const Scene& scene) {
  const double readings = scene.effects.dip_width * scene.plan.settings.size();
  return readings < 1.2 ? Names{"outliers"} : Names{};
}

Names TemperatureDriftTwins(const Shape&, const Scene& scene) {
  return scene.plan.kind == kUpDown ? Names{} : Names{"drift"};
}

Names CapacitanceTwins(const Shape&, const Scene& scene) {
  Names names;
  if (scene.effects.capacitance > 0) names.push_back("irr_step");
  if (scene.effects.diffusion_s > 0) names.push_back("timing_skew");
  return names;
}

Names SkewTwins(const Shape&, const Scene& scene) {
  return scene.effects.skew_s > 0 ? Names{"capacitance"} : Names{};
}

}  // namespace

const std::vector<Injection>& SweepInjections() {
  static const std::vector<Injection> injections = {
      {"drift",
       {kFwd, kRev, kUpDown},
       1e-5,
       0.4,
       Drift,
       DriftTwins,
       [](const Scene& s) {
         return Size{s.plan.kind == kUpDown ? "1" : nullptr, s.effects.drift};
       }},
      {"irr_step",
       {kFwd, kRev, kUpDown},
       1e-5,
       0.4,
       IrradianceStep,
       StepTwins,
       [](const Scene& s) {
         return Size{"1", s.effects.step};
       }},
      {"transient",
       {kFwd, kRev, kUpDown},
       1e-5,
       0.6,
       Transient,
       TransientTwins,
       [](const Scene& s) {
         return Size{"1", s.effects.dip};
       }},
      {"temp_drift",
       {kRev, kUpDown},
       1e-3,
       30,
       Signed<&Effects::temperature_drift_K>,
       TemperatureDriftTwins,
       [](const Scene& s) {
         return Size{s.plan.kind == kUpDown ? "K" : nullptr, s.effects.temperature_drift_K};
       }},
      {"capacitance",
       {kUpDown},
       1e-6,
       0.1,
       Capacitance,
       CapacitanceTwins,
       [](const Scene& s) {
         const bool plain = s.effects.diffusion_s == 0;
         return Size{plain ? "F" : nullptr, s.effects.capacitance / s.device.cells};
       }},
      {"timing_skew",
       {kUpDown},
       1e-7,
       0.03,
       TimingSkew,
       SkewTwins,
       [](const Scene& s) {
         return Size{"s", -s.effects.skew_s};  // delay of the voltage after the current
       }},
  };
  return injections;
}

}  // namespace faults
