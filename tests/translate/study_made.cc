#include <algorithm>
#include <cmath>
#include <cstdio>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/random.h"
#include "lyrefit/translate/key_point_noise.h"
#include "lyrefit/translate/translate.h"
#include "translate/carried.h"
#include "translate/made_worlds.h"
#include "translate/measured_sets.h"
#include "translate/study.h"

namespace shown {
namespace {

using lyrefit::Procedure;

// What the field does not know: light by 3 %, temperature by 1 K and another 2.5 K at 1000 W/m2
// (k = 2), alpha and beta of the data sheet by 20 % and 5 %.
constexpr double kLight_percent = 3, kSensor_K = 1, kOffset_K = 2.5;

void Misread(std::uint64_t seed, MadeCase* made) {
  lyrefit::RandomStream random(seed, 99);
  lyrefit::Conditions& at = made->curve.conditions;
  const double suns = at.irradiance_W_m2 / 1000;
  at.irradiance_W_m2 *= 1 + kLight_percent / 200 * random.Normal();
  at.cell_temperature_K += kSensor_K / 2 * random.Normal() + kOffset_K / 2 * suns * random.Normal();
  *made->coefficients.alpha_A_K *= 1 + 0.10 * random.Normal();
  *made->coefficients.beta_V_K *= 1 + 0.025 * random.Normal();
}

std::vector<Carried> CarryWorld(const std::string& world, const Light& light, int cases,
                                bool misread, const StudyOptions& options) {
  std::vector<std::vector<Carried>> parts(cases);
  lyrefit::ParallelFor(cases, options.threads, [&](int i) {
    const std::uint64_t seed = 1000 * options.seed + i;
    MadeCase made = MakeHealthy(world, light, seed);
    if (misread) Misread(seed, &made);
    lyrefit::TranslateOptions how = ReadyOptions(false);
    how.coefficients = made.coefficients;
    const std::vector<Sweep> ready = MakeReady({made.curve}, how, 1);
    if (ready.empty()) return;
    Conditions at = {0, 0, 0, 0};
    if (misread) {
      const double suns = made.curve.conditions.irradiance_W_m2 / 1000;
      at = {kLight_percent, std::hypot(kSensor_K, kOffset_K * suns), 5, 20};
    }
    parts[i] = CarryOne(ready[0], {}, made.power_stc_W, at);
    for (Carried& row : parts[i]) row.from = row.to = i;
  });
  std::vector<Carried> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

// The size of a procedure that makes its errors on a set likeliest.
void PrintSizes(const std::string& set, const std::vector<Carried>& all) {
  std::printf("| %s |", set.c_str());
  for (const Procedure procedure : {Procedure::kIec1, Procedure::kIec2, Procedure::kIec4,
                                    Procedure::kDeSoto, Procedure::kPvsyst}) {
    const Sizes sizes = FittedSizes(all, procedure);
    std::printf(" %.1f, %.2f |", 100 * sizes.light, 100 * sizes.temperature);
  }
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int StudySizes(const StudyOptions& options) {
  std::printf(
      "Size (k = 2, %%) of Pmax per e-fold of light and per 10 K, fitted to one set at a time\n\n"
      "| set | iec1 | iec2 | iec4 | desoto | pvsyst |\n|---|---|---|---|---|---|\n");
  for (const auto& set :
       {SandiaSet(options.data, options.every), NistSet(options.data, {"2015-07-20", 1.0}, 1),
        NistSet(options.data, {"2015-07-20", 1.1}, 1),
        NistSet(options.data, {"2015-07-20", 1.2}, 1),
        NistSet(options.data, {"2015-07-01", 1.1}, options.every)}) {
    if (!set) {
      std::fprintf(stderr, "%s\n", set.error().ToString().c_str());
      return 1;
    }
    const auto sweeps = Steady(MakeReady(set->curves, set->options, options.threads));
    PrintSizes(set->name, CarryPairs(sweeps, ConditionsOf(LikeScatter(sweeps)),
                                     {options.pairs, options.seed, options.threads, {}}));
  }
  const int cases = options.cases > 0 ? options.cases : 400;
  for (const std::string& world : Worlds()) {
    PrintSizes(world, CarryWorld(world, {}, cases, false, options));
  }
  return 0;
}

int StudyMade(const StudyOptions& options) {
  const int cases = options.cases > 0 ? options.cases : 400;
  for (const std::string& world : Worlds()) {
    for (const bool misread : {false, true}) {
      std::printf(
          "## %s, %s\n\n", world.c_str(),
          misread ? "light, temperature, alpha and beta as sure as in the field"
                  : "all inputs exact: U is of the procedure and of what is read off the curve");
      PrintTable(CarryWorld(world, {}, cases, misread, options));
      std::printf("\n");
    }
    std::printf("## %s, all inputs exact, light of 50 to 200 W/m2\n\n", world.c_str());
    PrintTable(CarryWorld(world, {50, 200}, cases, false, options));
    std::printf("\n");
  }
  return 0;
}

}  // namespace shown
