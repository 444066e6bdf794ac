#pragma once

#include <array>
#include <string>
#include <vector>

#include "hidden/scene.h"

namespace hidden {

// What an effect's draw settles before its strength is known.
struct Shape {
  std::array<double, 4> parts;  // each 0..1
  double sign = 1;
  double misfit = 0;  // the wanted one
};

// The size a person would read off, in A, V, K, W/m2 of the whole device.
struct Size {
  const char* unit = nullptr;  // nullptr: no plain figure
  double value = 0;
};

// Puts in what is one number of the effects, with the sign of the shape.
template <double Effects::*kField>
bool Signed(const Shape& shape, double strength, Scene* scene) {
  scene->effects.*kField = shape.sign * strength;
  return true;
}

enum class Wish { kAny, kModule, kCrystalline };

// An effect that can be hidden in a scene.
struct Hide {
  const char* name;
  std::vector<Kind> kinds;
  double low;  // strength
  double high;
  // Puts it in; false where the device has no room for it.
  bool (*apply)(const Shape& shape, double strength, Scene* scene);
  // Names the data cannot tell from it, besides its own.
  std::vector<std::string> (*twins)(const Shape& shape, const Scene& scene) = nullptr;
  Size (*size)(const Scene& scene) = nullptr;
  Wish wish = Wish::kAny;
};

// What can be found.
const std::vector<Hide>& Hides();
const Hide* FindHide(const std::string& name);
bool Shows(const Hide& hide, Kind kind);

// What the base model's parameters absorb: naming it, or anything else, is a false alarm.
const std::vector<Hide>& Absorbed();

const std::vector<Hide>& DeviceHides();
const std::vector<Hide>& SweepHides();
const std::vector<Hide>& InstrumentHides();
const std::vector<Hide>& ConditionHides();

Shape DrawShape(Random* random);

// Strength at which the misfit is the wanted one, within two percent; negative where the effect
// cannot reach it.
double StrengthFor(const Hide& hide, const Shape& shape, const Scene& scene, double misfit);

}  // namespace hidden
