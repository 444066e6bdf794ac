#pragma once
// Summaries of problems with many local optima. They count how often a search ends in the best
// local optimum and measure its time. All devices of a problem are summarised together. Everything
// is computed from the run records.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/study/comparison.h"

namespace lyrefit {

// The stages of a run, by increasing polish.
enum class PolishLevel {
  kSearch,  // the search alone
  kPlain,   // one bounded solve from the best candidate
  kOwn,     // the best candidate's own polish
  kHybrid,  // all starts
};

template <>
struct EnumTable<PolishLevel> {
  static constexpr EnumText<PolishLevel> kRows[] = {{PolishLevel::kSearch, "search alone"},
                                                    {PolishLevel::kPlain, "plain solve"},
                                                    {PolishLevel::kOwn, "best candidate"},
                                                    {PolishLevel::kHybrid, "all starts"}};
};
// All levels, the least polished first.
constexpr std::array<PolishLevel, 4> kPolishLevels = {PolishLevel::kSearch, PolishLevel::kPlain,
                                                      PolishLevel::kOwn, PolishLevel::kHybrid};

// Relative RMSE difference below which a run is a hit, and two end points of a device are the same
// local optimum.
constexpr double kHit = 1e-6;

// Runs that did not end in the best known optimum. Excess: RMSE / reference - 1. Deviation: the
// largest relative deviation of an effect parameter from its value at the reference. Without
// effects the parameters of the device are used. The deviation is 1 if the reference value is 0 and
// the run's is not.
struct Failures {
  int runs = 0;  // number of such runs
  // Number of distinct ones; end points of a device within kHit of each other are one.
  int local_optima = 0;
  // Runs in the most frequent local optimum; of equally frequent ones the lowest.
  int commonest = 0;
  std::string commonest_device;        // name of its device
  double commonest_excess = kUnknown;  // excess of that local optimum
  double median_excess = kUnknown;     // over these runs
  double worst_excess = kUnknown;
  double median_deviation = kUnknown;  // NaN at levels that keep no parameters
  double worst_deviation = kUnknown;
  std::string worst_parameter;  // key of the parameter with that deviation
};

// The results of one algorithm at one level of polish.
struct LevelSummary {
  int runs = 0;               // every run of every device
  int hits = 0;               // within kHit of the device's reference
  RunSpread excess;           // over the runs; its within_1e6 equals `hits`
  double seconds = kUnknown;  // median of a run: search plus the polish of this level
  Failures failures;
};

// The results of one algorithm over all devices of a problem.
struct AlgorithmSummary {
  std::string name;  // see ComparedAlgorithm
  std::string algorithm;
  AlgorithmKind kind = AlgorithmKind::kSearch;
  std::int64_t budget = 0;              // 0: none
  double evaluations = kUnknown;        // median of a run
  double curve_evaluations = kUnknown;  // median of a run
  // By PolishLevel. Algorithms that are not searches have only the last level. Empty: unknown.
  std::array<std::optional<LevelSummary>, 4> levels;

  // Summary of a level.
  const std::optional<LevelSummary>& At(PolishLevel level) const {
    return levels[static_cast<std::size_t>(level)];
  }
};

// The results of a problem over all its devices.
struct ProblemSummary {
  std::string name;                           // see ProblemResult::problem
  std::vector<const ProblemResult*> devices;  // from the comparison, in its order
  int certified = 0;                          // number of devices with a certified reference
  std::vector<AlgorithmSummary> algorithms;   // in the order of the comparison
};

// Summaries of all named problems of the comparison, in the order of the first device of each.
// Empty for a comparison without named problems. The results point into `comparison`, which must
// outlive them.
std::vector<ProblemSummary> SummariseProblems(const Comparison& comparison);

// RMSE of one run at a level in ampere, and seconds of the search plus the polish. NaN: unknown.
double RmseAt(const RunRecord& run, PolishLevel level);
double SecondsAt(const RunRecord& run, PolishLevel level);

// Failures defines the deviation.
struct Deviation {
  double value = kUnknown;  // relative
  int parameter = -1;       // position of the deviating parameter; -1: none
};
Deviation LargestDeviation(const ProblemResult& device, const std::vector<double>& parameters);

// Ranks of the searches of one budget, on one problem or on all problems. The blocks are all runs
// of all devices. The ranked figure is RMSE / reference of the device. Figures of one block within
// kHit (relative) of each other are equal.
struct SummaryRanking {
  std::string problem;  // empty: all problems together
  std::int64_t budget = 0;
  std::vector<std::string> names;  // of the algorithms, in the order of the ranks
  Ranking searched;                // of the search alone
  Ranking own;                     // of the best candidate's own polish
};

// Rankings by increasing budget. For each budget the first ranks all problems together, if there
// are several, and then each problem follows. Blocks that not every search of a budget has done are
// left out. Budgets with fewer than two searches or blocks are left out.
std::vector<SummaryRanking> RankProblems(const std::vector<ProblemSummary>& summaries);

}  // namespace lyrefit
