#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/study/comparison.h"

// Problems of many local optima, where what counts is how often a search ends in the best one and what it
// costs: all devices of a problem are summed up as one. All of it follows from the runs.
namespace lyrefit {

// How far a run is taken.
enum class PolishLevel {
  kSearch,  // not beyond the search
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
// All of them, the least polished first.
constexpr std::array<PolishLevel, 4> kPolishLevels = {PolishLevel::kSearch, PolishLevel::kPlain,
                                                      PolishLevel::kOwn, PolishLevel::kHybrid};

// A hit, and relative to each other two ends in the same local optimum: of RMSE, relative.
constexpr double kHit = 1e-6;

// Runs that ended elsewhere than in the best known optimum. Excess: RMSE / reference - 1.
// Deviation: the largest of any parameter of the effects (of the device, where there are none) from
// its value at the reference, relative to that; 1 where that is 0 and the run's is not.
struct Failures {
  int runs = 0;                        // that ended elsewhere
  int local_optima = 0;                      // ends of one device within kHit of each other are one
  int commonest = 0;                   // runs in the one that most ended in; of several the lowest
  std::string commonest_device;        // where that happened
  double commonest_excess = kUnknown;  // of that local optimum
  double median_excess = kUnknown;     // over these runs
  double worst_excess = kUnknown;      // over these runs
  double median_deviation = kUnknown;  // NaN of levels whose parameters are not kept
  double worst_deviation = kUnknown;   // over these runs
  std::string worst_parameter;         // the key of the one that deviates so
};

// What the runs of one compared came to at one level of polish.
struct LevelSummary {
  int runs = 0;               // every run of every device
  int hits = 0;               // within kHit of the device's reference
  RunSpread excess;           // over the runs; its counts are those of the hits
  double seconds = kUnknown;  // median of a run: the search and this level's polish
  Failures failures;
};

// One compared over all devices of a problem.
struct AlgorithmSummary {
  std::string name;  // see ComparedAlgorithm
  std::string algorithm;
  AlgorithmKind kind = AlgorithmKind::kSearch;
  std::int64_t budget = 0;              // 0: none
  double evaluations = kUnknown;        // median of a run
  double curve_evaluations = kUnknown;  // the same
  // By PolishLevel; only the last one of algorithms that are no searches. Empty: not known.
  std::array<std::optional<LevelSummary>, 4> levels;

  // By name instead of position.
  const std::optional<LevelSummary>& At(PolishLevel level) const {
    return levels[static_cast<std::size_t>(level)];
  }
};

// All devices of a problem as one.
struct ProblemSummary {
  std::string name;                           // see ProblemResult::problem
  std::vector<const ProblemResult*> devices;  // of the comparison, in its order
  int certified = 0;                          // of them
  std::vector<AlgorithmSummary> algorithms;    // in the order of the comparison
};

// Every problem of the comparison that has a name to be pooled under, in the order of the first
// device of each; none in a plain study. They point into the comparison.
std::vector<ProblemSummary> SummariseProblems(const Comparison& comparison);

// What one run came to at a level: RMSE in ampere, and seconds with the search. NaN: not known.
double RmseAt(const RunRecord& run, PolishLevel level);
double SecondsAt(const RunRecord& run, PolishLevel level);

// See Failures.
struct Deviation {
  double value = kUnknown;  // relative
  int parameter = -1;       // whose it is: position; -1: none
};
Deviation LargestDeviation(const ProblemResult& device, const std::vector<double>& parameters);

}  // namespace lyrefit
