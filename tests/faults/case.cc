#include "faults/case.h"

#include <algorithm>

namespace faults {
namespace {

constexpr int kDraws = 12;

NoiseType DrawNoiseType(const Request& request, Random* random) {
  if (request.noise) return *request.noise;
  return static_cast<NoiseType>(random->Index(kNoiseTypes - 1));
}

DeviceWish WishFor(const std::vector<const Injection*>& injections, Kind kind, Random* random) {
  DeviceWish wish;
  wish.module = random->Chance(kind == Kind::kReverse ? 0.25 : 0.45);
  for (const Injection* injection : injections) {
    wish.module |= injection->wish == Wish::kModule;
    wish.crystalline |= injection->wish == Wish::kCrystalline;
  }
  wish.bypass = kind != Kind::kReverse;
  return wish;
}

Scene DrawScene(Kind kind, NoiseType noise, const DeviceWish& wish, Random* random) {
  Scene scene;
  scene.device = DrawDevice(wish, random);
  scene.plan = DrawPlan(kind, scene.device, random);
  scene.noise = DrawNoise(noise, scene.device.photocurrent, random);
  return scene;
}

// Injects the effect into `scene`, with the strength at which it alone has the requested misfit.
std::optional<Cause> Hidden(const Injection& injection, double misfit, const Scene& clean,
                            Scene* scene, Random* random) {
  Shape shape = DrawShape(random);
  shape.misfit = misfit;
  Cause cause;
  cause.name = injection.name;
  const bool by_values = cause.name == "temperature_or_cells";
  cause.strength = by_values ? random->Uniform(injection.low, injection.high)
                             : StrengthFor(injection, shape, clean, misfit);
  if (cause.strength < 0 || !injection.apply(shape, cause.strength, scene)) return std::nullopt;
  Scene alone = clean;
  injection.apply(shape, cause.strength, &alone);
  cause.misfit = Misfit(alone);
  cause.acceptable = {cause.name};
  if (injection.twins != nullptr) {
    for (const std::string& twin : injection.twins(shape, *scene)) cause.acceptable.push_back(twin);
  }
  if (injection.size != nullptr) cause.size = injection.size(*scene);
  return cause;
}

}  // namespace

std::optional<Case> MakeCase(const Request& request) {
  for (int draw = 0; draw < kDraws; ++draw) {
    Random random(SeedOf(request.seed, draw, static_cast<int>(request.kind)));
    Case made;
    made.kind = request.kind;
    made.noise = DrawNoiseType(request, &random);
    const DeviceWish wish = WishFor(request.injections, request.kind, &random);
    const Scene clean = DrawScene(request.kind, made.noise, wish, &random);
    Scene scene = clean;
    for (const Injection* injection : request.injections) {
      std::optional<Cause> cause = Hidden(*injection, request.misfit, clean, &scene, &random);
      if (!cause) break;
      made.causes.push_back(*cause);
    }
    if (made.causes.size() < request.injections.size()) continue;
    made.measurement = Take(scene, &random);
    return made;
  }
  return std::nullopt;
}

Case MakeNull(Kind kind, NoiseType noise, std::uint64_t seed) {
  Random random(SeedOf(seed, 1000 + static_cast<int>(kind), static_cast<int>(noise)));
  Case made;
  made.kind = kind;
  made.noise = noise;
  DeviceWish wish = WishFor({}, kind, &random);
  wish.second_diode = made.second_diode = random.Chance(0.2);
  Scene scene = DrawScene(kind, noise, wish, &random);
  if (!made.second_diode && random.Chance(0.4)) {
    const Injection& injection = Absorbed()[random.Index(static_cast<int>(Absorbed().size()))];
    Scene with = scene;
    if (Shows(injection, kind) &&
        injection.apply(DrawShape(&random), random.Uniform(0.1, 1), &with)) {
      scene = with;
      made.absorbed = injection.name;
    }
  }
  made.measurement = Take(scene, &random);
  return made;
}

}  // namespace faults
