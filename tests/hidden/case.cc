#include "hidden/case.h"

#include <algorithm>

namespace hidden {
namespace {

constexpr int kDraws = 12;

NoiseType DrawNoiseType(const Request& request, Random* random) {
  if (request.noise) return *request.noise;
  return static_cast<NoiseType>(random->Index(kNoiseTypes - 1));
}

DeviceWish WishFor(const std::vector<const Hide*>& hides, Kind kind, Random* random) {
  DeviceWish wish;
  wish.module = random->Chance(kind == Kind::kReverse ? 0.25 : 0.45);
  for (const Hide* hide : hides) {
    wish.module |= hide->wish == Wish::kModule;
    wish.crystalline |= hide->wish == Wish::kCrystalline;
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
std::optional<Cause> Hidden(const Hide& hide, double misfit, const Scene& clean, Scene* scene,
                            Random* random) {
  Shape shape = DrawShape(random);
  shape.misfit = misfit;
  Cause cause;
  cause.name = hide.name;
  const bool by_values = cause.name == "temperature_or_cells";
  cause.strength =
      by_values ? random->Uniform(hide.low, hide.high) : StrengthFor(hide, shape, clean, misfit);
  if (cause.strength < 0 || !hide.apply(shape, cause.strength, scene)) return std::nullopt;
  Scene alone = clean;
  hide.apply(shape, cause.strength, &alone);
  cause.misfit = Misfit(alone);
  cause.acceptable = {cause.name};
  if (hide.twins != nullptr) {
    for (const std::string& twin : hide.twins(shape, *scene)) cause.acceptable.push_back(twin);
  }
  if (hide.size != nullptr) cause.size = hide.size(*scene);
  return cause;
}

}  // namespace

std::optional<Case> MakeCase(const Request& request) {
  for (int draw = 0; draw < kDraws; ++draw) {
    Random random(SeedOf(request.seed, draw, static_cast<int>(request.kind)));
    Case made;
    made.kind = request.kind;
    made.noise = DrawNoiseType(request, &random);
    const DeviceWish wish = WishFor(request.hides, request.kind, &random);
    const Scene clean = DrawScene(request.kind, made.noise, wish, &random);
    Scene scene = clean;
    for (const Hide* hide : request.hides) {
      std::optional<Cause> cause = Hidden(*hide, request.misfit, clean, &scene, &random);
      if (!cause) break;
      made.causes.push_back(*cause);
    }
    if (made.causes.size() < request.hides.size()) continue;
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
    const Hide& hide = Absorbed()[random.Index(static_cast<int>(Absorbed().size()))];
    Scene with = scene;
    if (Shows(hide, kind) && hide.apply(DrawShape(&random), random.Uniform(0.1, 1), &with)) {
      scene = with;
      made.absorbed = hide.name;
    }
  }
  made.measurement = Take(scene, &random);
  return made;
}

}  // namespace hidden
