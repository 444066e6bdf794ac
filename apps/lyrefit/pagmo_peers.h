#pragma once

#include <cstdint>
#include <pagmo/algorithm.hpp>
#include <vector>

namespace lyrefit {

// What an algorithm has to be made for.
struct PagmoPlan {
  unsigned generations = 1;
  unsigned seed = 0;
  unsigned population = 0;
  std::int64_t evaluations = 0;  // after the first candidates
  int dimensions = 0;
  double level = 1;  // objective of the best first candidate
};

struct PagmoPeer {
  const char* name;
  int per_candidate;  // evaluations of a generation: so many a candidate ...
  int fixed;     // ... and so many on top
  pagmo::algorithm (*make)(const PagmoPlan&);
};

// The algorithms of pagmo2 for one objective within bounds.
const std::vector<PagmoPeer>& PagmoPeers();

}  // namespace lyrefit
