#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/batch/result_row.h"

namespace lyrefit {

// Strings of one combiner at like light against each other (IEC 62446-1, 7.2: strings under like
// conditions are compared, and those that differ looked into).
//
// A group is the curves one behind the other whose ids have the same levels above the last. A string
// is compared with its peers: the others of its group whose irradiance is within `like_light` of its
// own, four at least. Its deviation in Isc / G, Voc, FF and Pmax / G is its value over the median of
// theirs, less 1. Temperatures are taken to be alike, nothing is translated. Where nobody stated the
// irradiance, light cannot be said to be alike, and nothing is compared.
//
// What scatter is usual is learned from all groups: s = 1.4826 x the median of |deviation| over the
// whole plant, or over the string's own group where that is larger. A string is flagged if one of
// the four is beyond t s, with t so that a healthy string is flagged at the rate `level`: the
// quantile of Student's t at level / 8 (four quantities, two sides) with 0.37 (deviations - groups)
// degrees of freedom, 0.37 being the efficiency of a median of absolute deviations. The rate holds
// where healthy strings scatter normally and most are healthy; groups that scatter more than the
// plant are flagged more rarely.

enum NeighbourQuantity { kIscPerLight, kVoc, kFillFactor, kPmaxPerLight, kNeighbourQuantities };

struct Neighbour {
  double irradiance_W_m2 = kUnknown;
  std::array<double, kNeighbourQuantities> values{kUnknown, kUnknown, kUnknown, kUnknown};
};

struct NeighbourDeviation {
  int peers = 0;  // 0: not compared
  std::array<double, kNeighbourQuantities> parts{kUnknown, kUnknown, kUnknown, kUnknown};
};

// Larger groups are not compared: they are no combiner's.
constexpr int kMostNeighbours = 1000;
constexpr int kLeastPeers = 4;

std::vector<NeighbourDeviation> DeviationsAmong(const std::vector<Neighbour>& group,
                                                double like_light);

// How much deviations scatter over the plant, counted in bins of 1 % in constant memory.
class NeighbourScatter {
 public:
  NeighbourScatter();
  void Add(const std::vector<NeighbourDeviation>& group);

  // Beyond which |deviation| a string of this group is flagged; infinite where too little is known.
  std::array<double, kNeighbourQuantities> Limits(const std::vector<NeighbourDeviation>& group,
                                                  double level) const;

 private:
  struct Count {
    std::vector<std::int64_t> bins;
    std::int64_t deviations = 0;
    std::int64_t groups = 0;
  };
  std::array<Count, kNeighbourQuantities> counts_;
};

// The cells of NeighbourColumns().
std::vector<ResultColumn> NeighbourColumns();
std::vector<ResultCell> NeighbourCells(const NeighbourDeviation& deviation,
                                       const std::array<double, kNeighbourQuantities>& limits);

// "site/inv/comb" of "site/inv/comb/string"; empty where there is no level above.
std::string ParentOf(const std::string& id);

}  // namespace lyrefit
