#include "faults/injection.h"

namespace faults {
namespace {

using Names = std::vector<std::string>;
constexpr Kind kFwd = Kind::kForward, kDark = Kind::kDark;
constexpr Kind kFamG = Kind::kIrradiances, kFamGT = Kind::kConditions;

bool TemperatureGradient(const Shape&, double strength, Scene* scene) {
  scene->effects.temperature_gradient_K = strength;
  return true;
}

bool Lead(const Shape&, double strength, Scene* scene) {
  scene->effects.lead_ohm = strength * scene->device.resistance;
  return true;
}

bool Gain(const Shape& shape, double strength, Scene* scene) {
  scene->effects.current_gain = shape.sign * strength / 20;
  return true;
}

bool OffsetOnOneCurve(const Shape& shape, double strength, Scene* scene) {
  scene->effects.current_offset_A = shape.sign * strength * scene->device.photocurrent / 200;
  return true;
}

// With equal voltage steps, linearly falling light has the effect of a shunt.
bool FadingLight(const Shape&, double strength, Scene* scene) {
  scene->effects.drift = -strength / 40;
  return scene->plan.even;
}

bool TemperatureOnOneCurve(const Shape& shape, double strength, Scene* scene) {
  scene->effects.temperature_offset_K = 12 * strength * shape.sign;
  const double kelvin = kReferenceK + scene->effects.temperature_offset_K;
  return scene->device.ideality * kelvin / kReferenceK > 1.02;
}

bool SensorGain(const Shape& shape, double strength, Scene* scene) {
  scene->effects.sensor_gain = shape.sign * strength / 20;
  return true;
}

}  // namespace

const std::vector<Injection>& ConditionInjections() {
  static const std::vector<Injection> injections = {
      {"temp_offset",
       {kFamGT},
       1e-3,
       25,
       Signed<&Effects::temperature_offset_K>,
       [](const Shape&, const Scene&) { return Names{"bandgap"}; },
       [](const Scene& s) {
         return Size{"K", s.effects.temperature_offset_K};
       }},
      {"temp_gradient",
       {kDark, kFamG, kFamGT},
       1e-3,
       25,
       TemperatureGradient,
       nullptr,
       [](const Scene& s) {
         return Size{"K", s.effects.temperature_gradient_K};
       }},
      {"sensor_nonlin",
       {kFamG, kFamGT},
       1e-5,
       0.4,
       Signed<&Effects::sensor_bend>,
       nullptr,
       [](const Scene& s) {
         return Size{"1", s.effects.sensor_bend};
       }},
      {"sensor_offset",
       {kFamG, kFamGT},
       1e-5,
       0.1,
       Signed<&Effects::sensor_offset>,
       [](const Shape&, const Scene& s) {
         return s.plan.kind == kFamG ? Names{"current_offset", "voltage_offset"}
                                     : Names{"current_offset"};
       },
       [](const Scene& s) {
         return Size{"W/m2", 1000 * s.effects.sensor_offset};
       }},
      {"bandgap",
       {kFamGT},
       1e-5,
       0.5,
       Signed<&Effects::bandgap_eV>,
       [](const Shape&, const Scene&) { return Names{"temp_offset"}; },
       [](const Scene& s) {
         return Size{"eV", s.effects.bandgap_eV};
       }},
      {"isc_tempco",
       {kFamGT},
       1e-7,
       0.01,
       Signed<&Effects::isc_tempco_per_K>,
       nullptr,
       [](const Scene& s) {
         return Size{"1/K", s.effects.isc_tempco_per_K};
       }},
  };
  return injections;
}

const std::vector<Injection>& Absorbed() {
  static const std::vector<Injection> injections = {
      {"lead_resistance",
       {kFwd, Kind::kReverse, Kind::kUpDown, kDark, kFamG, kFamGT},
       0.1,
       1,
       Lead},
      {"current_gain", {kFwd, Kind::kReverse, Kind::kUpDown, kDark, kFamG, kFamGT}, 0.1, 1, Gain},
      {"current_offset", {kFwd, Kind::kReverse, Kind::kUpDown}, 0.1, 1, OffsetOnOneCurve},
      {"drift", {kFwd}, 0.1, 1, FadingLight},
      {"temp_offset", {kFwd, Kind::kReverse, Kind::kUpDown}, 0.1, 1, TemperatureOnOneCurve},
      {"sensor_gain", {kFamG, kFamGT}, 0.1, 1, SensorGain},
  };
  return injections;
}

}  // namespace faults
