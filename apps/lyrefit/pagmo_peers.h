#pragma once

#include <cstdint>
#include <pagmo/algorithm.hpp>
#include <vector>

namespace lyrefit {

// Settings for the construction of an algorithm.
struct PagmoPlan {
  unsigned generations = 1;
  unsigned seed = 0;
  unsigned population = 0;
  std::int64_t evaluations = 0;  // budget after the first candidates
  int dimensions = 0;
  double level = 1;  // objective of the best first candidate
};

struct PagmoPeer {
  const char* name;
  int per_candidate;  // evaluations of a generation for each candidate
  int fixed;          // further evaluations of a generation
  pagmo::algorithm (*make)(const PagmoPlan&);
};

// The algorithms of pagmo2 for one objective within bounds.
const std::vector<PagmoPeer>& PagmoPeers();

}  // namespace lyrefit
