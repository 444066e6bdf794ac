#pragma once

#include <optional>
#include <string>

#include "lyrefit/study/problem_summary.h"

namespace lyrefit {

// Share of a problem's runs that must hit for a configuration to be sufficient.
constexpr double kEnoughShare = 0.96;

// The smallest sufficient number of hits out of `runs` runs.
int EnoughHits(int runs);

// A way to solve a problem: an algorithm and a level of polish.
struct Configuration {
  const AlgorithmSummary* algorithm = nullptr;
  PolishLevel level = PolishLevel::kSearch;
  // Results of the algorithm at the level.
  const LevelSummary& figures() const { return *algorithm->At(level); }
  // True if enough of its runs hit.
  bool IsEnough() const { return figures().hits >= EnoughHits(figures().runs); }
};

// The result for one problem, by a fixed rule. A search is sufficient at a level from a budget on
// if its hits are sufficient at that and every larger budget. Of the sufficient configurations, the
// one with the least median time of a run wins. If starts from the shape alone are sufficient, the
// level "all starts" is ignored, since it includes these starts.
struct SearchVerdict {
  // Starts from the shape, if they were compared, sufficient or not.
  std::optional<Configuration> shape;
  std::optional<Configuration> search;  // the winner; random points count as a search
  // If none is sufficient: the one with the most hits, then the least time.
  std::optional<Configuration> best;
  // Best configuration of random points, unless it is the winner.
  std::optional<Configuration> random;
  int needed = 0;                // sufficient number of hits
  bool shape_is_enough = false;  // starts from the shape are sufficient
  bool shape_wins = false;       // they are sufficient, and no sufficient search is faster
};
SearchVerdict JudgeProblem(const ProblemSummary& summary);

// Median time of as many runs as are needed so that one of them hits with probability kEnoughShare,
// in seconds. The share of runs that hit is the estimate of the hit probability. Infinite without a
// hit.
double TimeToBeSure(const Configuration& way);

// The default fit against pagmo2's algorithms with the best candidate's own polish. Each is
// repeated until a hit has probability kEnoughShare.
struct PeerRatio {
  Configuration self;
  std::optional<Configuration> peer;  // the configuration with the least TimeToBeSure
  int repeats = 0;                    // number of runs of the peer; 0: it never hits
  // TimeToBeSure of the peer divided by that of the default fit; NaN if it never hits.
  double times = kUnknown;
};
// Empty if the default fit was not compared.
std::optional<PeerRatio> CompareWithPeers(const ProblemSummary& summary);

// The result for a problem in one sentence without a full stop. Its text follows from the rule of
// JudgeProblem alone. Example:
// "strings_4: no search is needed: starts from the curve's shape alone hit 50 of 50 (8 ms); of
// the searches random reaches 48 of 50 with the best candidate's own polish from 1000
// evaluations (310 ms)"
std::string VerdictText(const ProblemSummary& summary);

// "default (50 of 50, 10 ms) is 12 times faster than pagmo:cmaes@1000 (45 of 50, 60 ms), run 2
// times". Empty if the default fit or all peers were not compared.
std::string PeerText(const ProblemSummary& summary);

}  // namespace lyrefit
