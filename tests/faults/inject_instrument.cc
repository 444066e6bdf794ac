#include <algorithm>
#include <cmath>

#include "faults/injection.h"
#include "faults/measure.h"

namespace faults {
namespace {

using Names = std::vector<std::string>;
constexpr Kind kFwd = Kind::kForward, kRev = Kind::kReverse, kUpDown = Kind::kUpDown;
constexpr Kind kDark = Kind::kDark, kFamG = Kind::kIrradiances, kFamGT = Kind::kConditions;

bool Clip(const Shape&, double strength, Scene* scene) {
  const auto exact = ExactCurrents(scene->device, scene->effects, scene->plan);
  scene->effects.clip_A = (1 - strength) * *std::max_element(exact.begin(), exact.end());
  return true;
}

bool Outliers(const Shape& shape, double strength, Scene* scene) {
  const int readings = static_cast<int>(scene->plan.settings.size());
  Random random(static_cast<std::uint64_t>(shape.parts[0] * 1e15));
  const int count = 1 + random.Index(std::max(1, std::min(5, readings / 30)));
  scene->outliers.clear();
  for (int i = 0; i < count; ++i) {
    const int point = (readings * i + random.Index(readings)) / count;
    scene->outliers.push_back({point, random.Sign() * strength});
  }
  return true;
}

bool Quantisation(const Shape&, double strength, Scene* scene) {
  std::vector<double> sigmas = scene->Sigmas();
  std::nth_element(sigmas.begin(), sigmas.begin() + sigmas.size() / 2, sigmas.end());
  scene->resolution_A = strength * sigmas[sigmas.size() / 2];
  scene->noise.resolution_A = 0;
  return scene->noise.type != NoiseType::kProportional &&
         scene->noise.type != NoiseType::kQuantised;
}

bool CurrentOffset(const Shape& shape, double strength, Scene* scene) {
  scene->effects.current_offset_A = shape.sign * strength * scene->device.photocurrent;
  return true;
}

// States a wrong temperature, one bypass group too many, or one to three cells too many of a few
// without bypass diodes. `strength` is the n that then seems to be.
bool WrongCellsOrTemperature(const Shape& shape, double strength, Scene* scene) {
  constexpr double kHottest = 1.25, kLargestStrength = 0.86;
  constexpr int kFew = 8;
  const Device& device = scene->device;
  const double factor = device.ideality / strength;  // divisor of n
  if (shape.parts[0] < 0.5 && factor < kHottest) {
    scene->stated_kelvin = kReferenceK * factor;
    return true;
  }
  const int groups = device.substrings;
  if (groups == 0 && device.cells > kFew) return false;
  const int more = groups > 0 ? device.cells / groups : 1 + static_cast<int>(3 * shape.parts[1]);
  scene->stated_cells = device.cells + more;
  if (groups > 0) scene->stated_groups = groups + 1;
  return device.ideality * device.cells < kLargestStrength * scene->stated_cells;
}

Names OffsetTwins(const Shape&, const Scene& scene) {
  if (scene.plan.kind == kDark) return {"voltage_offset"};
  return scene.plan.kind == kFamG ? Names{"sensor_offset", "voltage_offset"}
                                  : Names{"sensor_offset"};
}

Names VoltageTwins(const Shape& shape, const Scene& scene) {
  if (scene.plan.kind == kDark) return {"current_offset"};
  if (scene.plan.kind == kFamG) return {"current_offset", "sensor_offset"};
  return shape.misfit < 12 ? Names{"temp_offset", "bandgap"} : Names{};
}

Names OutlierTwins(const Shape&, const Scene& scene) {
  return scene.outliers.size() == 1 ? Names{"transient"} : Names{};
}

}  // namespace

const std::vector<Injection>& InstrumentInjections() {
  static const std::vector<Injection> injections = {
      {"clip",
       {kFwd, kRev, kUpDown, kDark, kFamG, kFamGT},
       1e-4,
       0.4,
       Clip,
       nullptr,
       [](const Scene& s) {
         return Size{"A", s.effects.clip_A};
       }},
      {"outliers", {kFwd, kRev, kUpDown, kDark, kFamG, kFamGT}, 1, 80, Outliers, OutlierTwins},
      {"quantisation",
       {kFwd, kRev, kUpDown, kDark, kFamG, kFamGT},
       2.5,
       30,
       Quantisation,
       nullptr,
       [](const Scene& s) {
         return Size{"A", s.resolution_A};
       }},
      {"current_offset",
       {kDark, kFamG, kFamGT},
       1e-6,
       0.05,
       CurrentOffset,
       OffsetTwins,
       [](const Scene& s) {
         return Size{"A", s.effects.current_offset_A};
       }},
      {"voltage_offset",
       {kDark, kFamG, kFamGT},
       1e-5,
       0.08,
       Signed<&Effects::voltage_offset>,
       VoltageTwins,
       [](const Scene& s) {
         return Size{"V", -s.effects.voltage_offset * s.device.cells};  // added by the instrument
       }},
      {"temperature_or_cells", {kFwd, kRev, kUpDown}, 0.5, 0.86, WrongCellsOrTemperature},
  };
  return injections;
}

}  // namespace faults
