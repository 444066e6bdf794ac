#pragma once

#include <cstdint>
#include <limits>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// The lyrebird optimizer in four settings, variants of it, and two baselines.
enum class Algorithm {
  kMlo,        // modified lyrebird: both strategies
  kLo,         // the original lyrebird optimizer (doi:10.3390/biomimetics8060507)
  kLoMblss,    // with the memory-based learn search strategy only
  kLoDmlss,    // with the diversity-maintenance learn search strategy only
  kMloShape,   // mlo with a first population seeded by the curve's shape (Box::initial)
  kRandom,     // uniform random points: the baseline
  kDe,         // differential evolution DE/rand/1/bin (doi:10.1023/A:1008202821328)
  kMloVector,  // mlo that draws z of Eq. 20 for each coordinate, as the paper prints it
};

template <>
struct EnumTable<Algorithm> {
  static constexpr EnumText<Algorithm> kRows[] = {
      {Algorithm::kMlo, "mlo"},
      {Algorithm::kLo, "lo"},
      {Algorithm::kLoMblss, "lo+mblss"},
      {Algorithm::kLoDmlss, "lo+dmlss"},
      {Algorithm::kMloVector, "mlo+vector"},
      {Algorithm::kMloShape, "mlo+shape"},
      {Algorithm::kRandom, "random"},
      {Algorithm::kDe, "de"},
  };
};

// Settings of a search and its criteria of termination.
struct SearchOptions {
  Algorithm algorithm = Algorithm::kMlo;
  std::uint64_t seed = 0;
  std::uint64_t run = 0;               // number of the run; seed and run select the stream
  int population = 20;                 // number of candidates
  int iterations = 20;                 // each evaluates one point a candidate
  double memory_rate = 0.5;            // Pm of MBLSS; 0 switches it off
  double distance_coefficient = 0.25;  // gamma of DMLSS; 0 switches it off
  double de_scale = 0.5;               // F of differential evolution
  double de_crossover = 0.9;           // CR of differential evolution
  std::int64_t max_evaluations = std::numeric_limits<std::int64_t>::max();
  double target = -kInfinity;  // stop at or below this objective value
  double time_limit_s = kInfinity;
  int patience = 0;  // stop after so many iterations without a lower best value; 0: never
  int elites = 4;    // number of distinct candidates to return, including the best
};

// The most evaluations of a search that ends neither sooner nor by the clock.
inline std::int64_t PlannedEvaluations(const SearchOptions& options) {
  const std::int64_t all = options.population * (options.iterations + std::int64_t{1});
  return all < options.max_evaluations ? all : options.max_evaluations;
}

// The table has no row for the algorithm: structs that contain these options declare it themselves.
inline constexpr OptionRow<SearchOptions> kSearchOptionTable[] = {
    OptionRow<SearchOptions>("Search"),
    {"seed", "", "seed of the random stream", &SearchOptions::seed, 0, 1.8446744073709552e19},
    {"run", "", "number of the run under that seed", &SearchOptions::run, 0, 1e15},
    {"population", "candidates", "number of candidates", &SearchOptions::population, 4, 20000},
    {"iterations", "", "iterations, one evaluation a candidate each", &SearchOptions::iterations, 1,
     1e8},
    {"memory-rate", "", "Pm: rate of the memory-based strategy", &SearchOptions::memory_rate, 0, 1},
    {"distance-coefficient", "", "gamma: reach of the diversity strategy",
     &SearchOptions::distance_coefficient, 0, 1},
    {"de-scale", "", "F of differential evolution", &SearchOptions::de_scale, 0, 2},
    {"de-crossover", "", "CR of differential evolution", &SearchOptions::de_crossover, 0, 1},
    {"max-evaluations", "", "stop after so many evaluations", &SearchOptions::max_evaluations, 4,
     1e19},
    {"target", "", "stop at or below this objective value", &SearchOptions::target, -kInfinity,
     kInfinity},
    {"time-limit", "s", "stop after so many seconds", &SearchOptions::time_limit_s, 0, kInfinity},
    {"patience", "iterations", "stop after so many iterations without gain; 0: never",
     &SearchOptions::patience, 0, 1e8},
    {"elites", "candidates", "distinct candidates handed to the polish", &SearchOptions::elites, 1,
     1000},
};

}  // namespace lyrefit
