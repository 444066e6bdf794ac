#include <algorithm>
#include <cmath>
#include <cstdio>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/random.h"
#include "lyrefit/translate/key_point_noise.h"
#include "lyrefit/translate/translate.h"
#include "translate/carried.h"
#include "translate/measured_sets.h"
#include "translate/study.h"
#include "translate/translation_simulators.h"

namespace shown {
namespace {

using lyrefit::Procedure;

// Expanded uncertainties (k = 2) in the field: irradiance 3 %, back sensor 1 K, data-sheet alpha 20
// % and beta 5 %. `Warmer` states how much warmer than the sensor the cells are at 1000 W/m2.
constexpr double kLight_percent = 3, kSensor_K = 1;

struct Warmer {
  const char* name;
  double mean_K, spread_K;  // of a normal distribution
};

// Correction of a back sensor and its expanded uncertainty, both at 1000 W/m2.
struct SensorAnswer {
  const char* name;
  double correction_K, expanded_K;
};
constexpr SensorAnswer kCorrected = {"corrected by 2.5 K, U 1.5 K", 2.5, 1.5};

// Stated inputs and uncertainties of the translation.
struct Told {
  SensorAnswer answer = kCorrected;
  bool beta = true;
  double epsilon_percent = lyrefit::UncertaintyOptions().epsilon_percent;
};

void Misread(std::uint64_t seed, const Warmer& of, SyntheticCase* made) {
  lyrefit::RandomStream random(seed, 99);
  lyrefit::Conditions& at = made->curve.conditions;
  const double suns = at.irradiance_W_m2 / 1000;
  at.irradiance_W_m2 *= 1 + kLight_percent / 200 * random.Normal();
  at.cell_temperature_K +=
      kSensor_K / 2 * random.Normal() - suns * (of.mean_K + of.spread_K * random.Normal());
  *made->coefficients.alpha_A_K *= 1 + 0.10 * random.Normal();
  *made->coefficients.beta_V_K *= 1 + 0.025 * random.Normal();
}

std::vector<Carried> CarryWorld(const std::string& world, const Light& light, int cases,
                                const Warmer* misread, const StudyOptions& options,
                                const Told& told = {}) {
  std::vector<std::vector<Carried>> parts(cases);
  lyrefit::ParallelFor(cases, options.threads, [&](int i) {
    const std::uint64_t seed = 1000 * options.seed + i;
    SyntheticCase made = MakeReferenceSweeps(world, light, seed);
    if (misread != nullptr) Misread(seed, *misread, &made);
    lyrefit::TranslateOptions how = ReadyOptions(false);
    how.coefficients = made.coefficients;
    if (!told.beta) how.coefficients.beta_V_K.reset();
    if (misread != nullptr) how.uncertainty.cell_correction_K = told.answer.correction_K;
    const std::vector<Sweep> ready = MakeReady({made.curve}, how, 1);
    if (ready.empty()) return;
    Conditions at = {0, 0, 0, 0, told.epsilon_percent};
    if (misread != nullptr) {
      const double suns = made.curve.conditions.irradiance_W_m2 / 1000;
      at = {kLight_percent, std::hypot(kSensor_K, told.answer.expanded_K * suns), 5, 20,
            told.epsilon_percent};
    }
    if (!told.beta) at.beta_percent = -1;
    parts[i] = CarryOne(ready[0], {}, made.stc, at);
    for (Carried& row : parts[i]) row.from = row.to = i;
  });
  std::vector<Carried> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

// Prints the maximum-likelihood procedure uncertainties of a set.
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

constexpr Warmer kUsual = {"drawn about 2.5 K, k = 2 of 1.5 K", 2.5, 0.75};

}  // namespace

int StudySensors(const StudyOptions& options) {
  const int cases = options.cases > 0 ? options.cases : 200;
  const SensorAnswer answers[] = {{"as read, U 2.5 K", 0, 2.5}, kCorrected};
  for (const Warmer& warmer : {kUsual, Warmer{"always 2.5 K", 2.5, 0}, Warmer{"always 3 K", 3, 0},
                               Warmer{"always 1 K", 1, 0}}) {
    for (const SensorAnswer& answer : answers) {
      std::vector<Carried> together;
      for (const std::string& world : Worlds()) {
        const auto all = CarryWorld(world, {}, cases, &warmer, options, {answer});
        together.insert(together.end(), all.begin(), all.end());
      }
      std::printf("## cells warmer than the sensor: %s; temperature %s; all worlds\n\n",
                  warmer.name, answer.name);
      PrintHeld(together);
      std::printf("\n");
      std::fflush(stdout);
    }
  }
  return 0;
}

int StudyBeta(const StudyOptions& options) {
  const int cases = options.cases > 0 ? options.cases : 200;
  for (const std::string& world : Worlds()) {
    for (const Warmer* misread : {static_cast<const Warmer*>(nullptr), &kUsual}) {
      for (const double epsilon_percent : {2.0, Told().epsilon_percent}) {
        std::printf("## %s, beta not stated, %s, epsilon within %g %%\n\n", world.c_str(),
                    misread != nullptr ? "light and temperature as in the field" : "the rest exact",
                    epsilon_percent);
        PrintHeld(
            CarryWorld(world, {}, cases, misread, options, {kCorrected, false, epsilon_percent}));
        std::printf("\n");
        std::fflush(stdout);
      }
    }
  }
  return 0;
}

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
    PrintSizes(world, CarryWorld(world, {}, cases, nullptr, options));
  }
  return 0;
}

int StudySynthetic(const StudyOptions& options) {
  const int cases = options.cases > 0 ? options.cases : 400;
  for (const std::string& world : Worlds()) {
    for (const Warmer* misread : {static_cast<const Warmer*>(nullptr), &kUsual}) {
      std::printf(
          "## %s, %s\n\n", world.c_str(),
          misread != nullptr
              ? "light, temperature, alpha and beta as sure as in the field"
              : "all inputs exact: U is of the procedure and of what is read off the curve");
      const auto all = CarryWorld(world, {}, cases, misread, options);
      PrintTable(all);
      std::printf("\n");
      PrintHeld(all);
      std::printf("\n");
    }
    std::printf("## %s, all inputs exact, light of 50 to 200 W/m2\n\n", world.c_str());
    PrintTable(CarryWorld(world, {50, 200}, cases, nullptr, options));
    std::printf("\n");
  }
  return 0;
}

}  // namespace shown
