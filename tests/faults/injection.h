#pragma once

#include <array>
#include <string>
#include <vector>

#include "faults/scene.h"

namespace faults {

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
struct Injection {
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
const std::vector<Injection>& Injections();
const Injection* FindInjection(const std::string& name);
bool Shows(const Injection& injection, Kind kind);

// Effects that the parameters of the base model absorb. Any claim about them is a false alarm.
const std::vector<Injection>& Absorbed();

const std::vector<Injection>& DeviceInjections();
const std::vector<Injection>& SweepInjections();
const std::vector<Injection>& InstrumentInjections();
const std::vector<Injection>& ConditionInjections();

Shape DrawShape(Random* random);

// Strength at which the misfit is `misfit` within two percent. Negative if the effect cannot reach
// it.
double StrengthFor(const Injection& injection, const Shape& shape, const Scene& scene,
                   double misfit);

}  // namespace faults
