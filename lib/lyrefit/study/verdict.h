#pragma once

#include <optional>

#include "lyrefit/study/problem_summary.h"

namespace lyrefit {

// Share of a problem's runs that must hit for a way to be enough.
constexpr double kEnoughShare = 0.96;

// The fewest hits of so many runs that are enough.
int EnoughHits(int runs);

// How a problem was solved: by whom, how far polished.
struct Configuration {
  const AlgorithmSummary* compared = nullptr;  // by whom
  PolishLevel level = PolishLevel::kSearch;
  // What the compared came to at the level.
  const LevelSummary& figures() const { return *compared->At(level); }
  // Whether so many of its runs hit.
  bool IsEnough() const { return figures().hits >= EnoughHits(figures().runs); }
};

// What the figures of one problem say, by rule. A search is enough at a level from a budget on if
// its hits are enough there and at every larger budget; of the ways that are, the least median time
// of a run wins. Where starts from the shape alone are enough, "all starts", which has them, says
// nothing of a search and does not count.
struct SearchVerdict {
  std::optional<Configuration> shape;      // where it was a compared, enough or not
  std::optional<Configuration> search;     // the winner, random points among the searches
  std::optional<Configuration> best;       // where none is enough: the most hits, then the least time
  std::optional<Configuration> random;     // that of random points, where they are not the winner
  int needed = 0;                // hits that are enough
  bool shape_is_enough = false;  // that way is
  bool shape_wins = false;       // it is enough, and no search that is enough is faster
};
SearchVerdict JudgeProblem(const ProblemSummary& pool);

// Median time of so many runs that with a probability of kEnoughShare one of them hits, going by
// the share of those that did; infinite without a hit.
double TimeToBeSure(const Configuration& way);

// The fit with its default settings against pagmo2's algorithms with the best candidate's own polish,
// each run as often as it takes to be sure.
struct PeerRatio {
  Configuration self;
  std::optional<Configuration> peer;  // that of least TimeToBeSure
  int repeats = 0;          // of the peer; 0: it never hits
  double times = kUnknown;  // its TimeToBeSure by that of the default fit; NaN where it never hits
};
// Nothing where the default fit was no compared.
std::optional<PeerRatio> CompareWithPeers(const ProblemSummary& pool);

}  // namespace lyrefit
