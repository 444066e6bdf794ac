#include <algorithm>
#include <cmath>

#include "faults/injection.h"

namespace faults {
namespace {

using Names = std::vector<std::string>;
constexpr Kind kFwd = Kind::kForward, kRev = Kind::kReverse, kUpDown = Kind::kUpDown;
constexpr Kind kDark = Kind::kDark, kFamG = Kind::kIrradiances, kFamGT = Kind::kConditions;

double LowestVoltage(const Scene& scene) {  // of a cell
  return scene.plan.settings.front().voltage / scene.device.cells;
}

bool SecondDiode(const Shape&, double strength, Scene* scene) {
  return SetSecondDiode(strength * scene->device.photocurrent, &scene->device);
}

bool NonohmicShunt(const Shape& shape, double strength, Scene* scene) {
  scene->effects.shunt_strength = strength * scene->device.photocurrent;
  scene->effects.shunt_exponent = 1.5 + 1.7 * shape.parts[0];
  return true;
}

bool Breakdown(const Shape& shape, double strength, Scene* scene) {
  scene->effects.breakdown = strength * scene->device.photocurrent;
  scene->effects.breakdown_voltage = LowestVoltage(*scene) * (1.15 + 1.4 * shape.parts[0]);
  return true;
}

bool Collection(const Shape&, double strength, Scene* scene) {
  scene->effects.collection = strength;
  return scene->device.open_circuit < 0.74;
}

bool Photoshunt(const Shape& shape, double strength, Scene* scene) {
  scene->effects.photoshunt = strength * scene->device.photocurrent;
  scene->effects.photoshunt_exponential = shape.parts[0] < 0.3;
  return true;
}

bool BackContact(const Shape&, double strength, Scene* scene) {
  scene->effects.inverse_contact = strength / scene->device.photocurrent;
  return true;
}

bool RsCurrent(const Shape& shape, double strength, Scene* scene) {
  const double current = scene->device.photocurrent;
  if (shape.parts[0] < 0.4) {  // two half cells
    scene->effects.far_ohm = 5 * strength / current;
    return 10 * strength < 0.4;
  }
  scene->effects.lumped_drop = shape.sign * strength / (current * current);
  return shape.sign > 0 || strength < 0.3 * scene->device.resistance * current;
}

bool AgedContacts(const Shape& shape, double strength, Scene* scene) {
  scene->effects.far_ohm = strength / scene->device.photocurrent;
  scene->effects.far_share = 0.15 + 0.4 * shape.parts[0];
  return true;
}

bool Shading(const Shape& shape, double strength, Scene* scene) {
  const int substrings = scene->device.substrings;
  if (substrings < 2) return false;
  scene->effects.shade_depth = strength;
  scene->effects.shaded_substrings = 1 + (shape.parts[0] < 0.4 && substrings > 2);
  scene->effects.bypass_drop = 0.3 + 0.4 * shape.parts[1];
  scene->effects.bypass_ideal = shape.parts[2] < 0.4;
  return true;
}

bool Mismatch(const Shape& shape, double strength, Scene* scene) {
  constexpr double kShares[] = {1.0 / 4, 1.0 / 3, 1.0 / 2, 2.0 / 3};
  scene->effects.mismatch_deficit = strength;
  scene->effects.mismatch_share = kShares[static_cast<int>(4 * shape.parts[0])];
  return scene->device.cells > 1;
}

bool OneLightSweep(const Scene& scene) {
  return scene.plan.kind == kFwd || scene.plan.kind == kUpDown;
}

Names ShuntTwins(const Shape&, const Scene& scene) {
  if (OneLightSweep(scene)) return {"collection"};
  return scene.plan.kind == kRev ? Names{"breakdown"} : Names{};
}

Names BreakdownTwins(const Shape&, const Scene& scene) {
  const double reach = scene.effects.breakdown_voltage / LowestVoltage(scene);
  return reach > 1.7 || scene.effects.breakdown_voltage < -14 ? Names{"nonohmic_shunt"} : Names{};
}

Names CollectionTwins(const Shape& shape, const Scene& scene) {
  if (OneLightSweep(scene)) return {"nonohmic_shunt"};
  return scene.plan.kind != kRev && shape.misfit < 12 ? Names{"photoshunt"} : Names{};
}

Names PhotoshuntTwins(const Shape& shape, const Scene&) {
  return shape.misfit < 12 ? Names{"collection"} : Names{};
}

// Lumped and distributed resistance, in parts of any size, are model variants of one cause.
Names RsCurrentTwins(const Shape&, const Scene&) { return {"distributed_rs", "aged_contacts"}; }
// Under one light the part that gives less also looks like cells of less current.
Names AgedContactsTwins(const Shape&, const Scene& scene) {
  Names twins = {"distributed_rs", "rs_current"};
  if (OneLightSweep(scene) || scene.plan.kind == kRev) twins.emplace_back("mismatch");
  return twins;
}

Names MismatchTwins(const Shape&, const Scene&) { return {"shading"}; }

}  // namespace

const std::vector<Injection>& DeviceInjections() {
  static const std::vector<Injection> injections = {
      {"second_diode",
       {kFwd, kRev, kUpDown, kDark, kFamG, kFamGT},
       1e-10,
       1e-4,
       SecondDiode,
       nullptr,
       [](const Scene& s) {
         return Size{"A", s.device.saturation_2};
       },
       Wish::kCrystalline},
      {"nonohmic_shunt",
       {kFwd, kRev, kUpDown, kDark, kFamG, kFamGT},
       1e-7,
       0.4,
       NonohmicShunt,
       ShuntTwins},
      {"breakdown", {kRev}, 1e-9, 0.1, Breakdown, BreakdownTwins},
      {"collection",
       {kFwd, kRev, kUpDown, kDark, kFamG, kFamGT},
       1e-5,
       0.12,
       Collection,
       CollectionTwins,
       [](const Scene& s) {
         return Size{"V", s.effects.collection};
       },
       Wish::kCrystalline},
      {"photoshunt",
       {kDark, kFamG, kFamGT},
       1e-5,
       3,
       Photoshunt,
       PhotoshuntTwins,
       [](const Scene& s) {
         const bool plain = !s.effects.photoshunt_exponential;
         return Size{plain ? "S" : nullptr, s.effects.photoshunt / s.device.cells};
       }},
      {"back_contact", {kFwd, kRev, kUpDown, kDark, kFamG, kFamGT}, 1e-3, 60, BackContact},
      {"rs_current",
       {kFwd, kRev, kUpDown, kDark, kFamG, kFamGT},
       1e-5,
       0.2,
       RsCurrent,
       RsCurrentTwins},
      {"aged_contacts",
       {kFwd, kRev, kUpDown, kFamG, kFamGT},
       1e-4,
       1.5,
       AgedContacts,
       AgedContactsTwins,
       nullptr,
       Wish::kModule},
      {"shading", {kFwd, kUpDown}, 1e-4, 0.97, Shading, nullptr, nullptr, Wish::kModule},
      {"mismatch", {kFwd, kUpDown}, 1e-4, 0.5, Mismatch, MismatchTwins, nullptr, Wish::kModule},
  };
  return injections;
}

}  // namespace faults
