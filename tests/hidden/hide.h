#pragma once

#include <array>
#include <string>
#include <vector>

#include "hidden/scene.h"

namespace hidden {

// Random properties of an effect that are drawn before its strength is determined.
struct Shape {
  std::array<double, 4> parts;  // each 0..1
  double sign = 1;
  double misfit = 0;  // requested misfit, in noise standard deviations
};

// Size of an effect for a user, in A, V, K or W/m2 of the whole device.
struct Size {
  const char* unit = nullptr;  // nullptr: no such figure
  double value = 0;
};

// Sets one number of the effects to the strength, with the sign of the shape.
template <double Effects::*kField>
bool Signed(const Shape& shape, double strength, Scene* scene) {
  scene->effects.*kField = shape.sign * strength;
  return true;
}

enum class Wish { kAny, kModule, kCrystalline };

// An effect that can be injected into a scene.
struct Hide {
  const char* name;
  std::vector<Kind> kinds;
  double low;  // lower limit of the strength
  double high;
  // Injects the effect; false if the device cannot have it.
  bool (*apply)(const Shape& shape, double strength, Scene* scene);
  // Further names that the data cannot distinguish from this effect.
  std::vector<std::string> (*twins)(const Shape& shape, const Scene& scene) = nullptr;
  Size (*size)(const Scene& scene) = nullptr;
  Wish wish = Wish::kAny;
};

// The identifiable effects.
const std::vector<Hide>& Hides();
const Hide* FindHide(const std::string& name);
bool Shows(const Hide& hide, Kind kind);

// Effects that the parameters of the base model absorb. Any claim about them is a false alarm.
const std::vector<Hide>& Absorbed();

const std::vector<Hide>& DeviceHides();
const std::vector<Hide>& SweepHides();
const std::vector<Hide>& InstrumentHides();
const std::vector<Hide>& ConditionHides();

Shape DrawShape(Random* random);

// Strength at which the misfit is `misfit` within two percent. Negative if the effect cannot reach
// it.
double StrengthFor(const Hide& hide, const Shape& shape, const Scene& scene, double misfit);

}  // namespace hidden
