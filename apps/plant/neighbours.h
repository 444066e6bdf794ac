#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/batch/addition.h"
#include "lyrefit/batch/count_rows.h"
#include "lyrefit/batch/result_row.h"
#include "plant/additions.h"
#include "plant/deviation_bins.h"

namespace lyrefit {

// Comparison of strings of one combiner at similar irradiance (IEC 62446-1, 7.2: strings under like
// conditions are compared, and those that differ are investigated).
//
// A group is a sequence of adjacent curves whose ids have the same levels above the last. The peers
// of a string are the others of its group whose irradiance is within `like_light` (relative) of its
// own. At least four are required. The deviation in Isc / G, Voc, FF and Pmax / G is the string's
// value divided by the median of its peers, minus 1. Temperatures are assumed equal, and nothing is
// translated. Without a stated irradiance there is no comparison.
//
// The usual scatter is estimated from all groups. It is s = 1.4826 x the median of |deviation| over
// the whole plant, or over the string's own group if that is larger. A string is flagged if one of
// its four deviations exceeds t s. The factor t is chosen so that a string without a fault is
// flagged at the rate `level`. It is the quantile of Student's t at level / 8 (four quantities, two
// sides) with 0.37 (deviations - groups) degrees of freedom. Here 0.37 is the efficiency of a
// median of absolute deviations. The rate holds if strings without a fault scatter normally and
// most strings have no fault. In groups that scatter more than the plant the rate is lower.

enum NeighbourQuantity { kIscPerLight, kVoc, kFillFactor, kPmaxPerLight, kNeighbourQuantities };

struct Neighbour {
  double irradiance_W_m2 = kUnknown;
  std::array<double, kNeighbourQuantities> values{kUnknown, kUnknown, kUnknown, kUnknown};
};

struct NeighbourDeviation {
  int peers = 0;  // 0: not compared
  std::array<double, kNeighbourQuantities> parts{kUnknown, kUnknown, kUnknown, kUnknown};
};

constexpr int kLeastPeers = 4;

std::vector<NeighbourDeviation> DeviationsAmong(const std::vector<Neighbour>& group,
                                                double like_light);

// Scatter of deviations over the plant, counted in bins of 1 % in constant memory.
class NeighbourScatter {
 public:
  void Add(const std::vector<NeighbourDeviation>& group);

  // Values of |deviation| above which a string of this group is flagged; infinite if there are too
  // few data.
  std::array<double, kNeighbourQuantities> Limits(const std::vector<NeighbourDeviation>& group,
                                                  double level) const;

 private:
  struct Count {
    DeviationBins bins;
    std::int64_t groups = 0;
  };
  std::array<Count, kNeighbourQuantities> counts_;
};

// The columns of the comparison, and the cells of one string.
std::vector<ResultColumn> NeighbourColumns();
std::vector<ResultCell> NeighbourCells(const NeighbourDeviation& deviation,
                                       const std::array<double, kNeighbourQuantities>& limits);

// Adds the comparison to rows that are together; larger groups cannot be one combiner.
class NeighbourAddition final : public BatchAddition {
 public:
  NeighbourAddition(PlantOptions options, PlantResults* results)
      : options_(std::move(options)), results_(results) {}

  void AddOptions(BatchJson* options) const override;
  Expected<std::vector<ResultFile>> Begin(const BatchTaskType& task, const std::string& folder,
                                          BatchJson* options) const override;
  Expected<void> Open(const RowsInput& input) override;
  std::vector<ResultColumn> Columns() const override { return NeighbourColumns(); }
  void Learn(const RowGroup& group) override;
  Expected<void> Add(RowGroup* group) override;
  AddedReport Report() const override;

 private:
  // What is learned of one run.
  struct State {
    double level = 0;
    double like_light = 0;
    bool of_pixels = false;
    RowReader reader;
    NeighbourScatter scatter;
    std::int64_t compared = 0, flagged = 0;
  };
  std::vector<NeighbourDeviation> Deviations(const RowGroup& group) const;

  const PlantOptions options_;
  PlantResults* const results_;
  State state_;
};

}  // namespace lyrefit
