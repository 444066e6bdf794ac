#pragma once

#include <array>
#include <string>
#include <vector>

#include "lyrefit/batch/result_row.h"
#include "plant/deviation_bins.h"
#include "plant/scale_evidence.h"

namespace lyrefit {

// Judges strings of one combiner by their scale, against the plan and against each other.
//
// The residual of a string is the logarithms of its figures (scale.h) less those that its plan
// expects at its light and temperature. Without a plan a typical diode through the medians of the
// combiner takes the place of the plan, so that strings of unlike light and temperature compare.
// The deviation of a string is its residual less the median residual of its peers: the strings of
// the combiner with a light within 30 %, of which at least kLeastPeers are needed. What all strings of a
// combiner share, such as rounding of the data sheet, the gain of a sensor or dirt on all, is not in
// the deviations. The median residual itself is judged against the plan, with errors of sensors and
// data sheet (kPlanErrors), and its cause holds for all strings of the combiner that have no own.
//
// Errors of deviations: the usual ones of measurements (kUsualErrors), as kUsualDegrees strings,
// and what scatters in this plant, 1.4826 x the median of |deviation| with its degrees of freedom;
// the mean of both squares. A combiner that scatters more than the plant has its own.

// A string of a combiner.
struct ScaleMember {
  std::string id;
  StringFigures measured;
  StringFigures planned;  // unknown without a plan
  double irradiance_W_m2 = kUnknown;
  double temperature_C = kUnknown;
  double cells = kUnknown;  // in series
  int modules = 0;          // in series; 0: not known
  int strings = 0;          // in parallel; 0: not known
  int bypass_diodes = 3;
  std::string module;     // its name by the plan
  std::string own_cause;  // cause that the curve itself shows; it is then not judged

  bool IsPlanned() const { return std::isfinite(planned.voc_V); }
  bool IsMeasured() const;
};

// What a string differs by.
struct ScaleResidual {
  ScaleVector residual{};   // from the plan, or from the medians of the combiner
  ScaleVector deviation{};  // from the peers
  ScaleVector common{};     // median residual of the peers
  StringFigures expected;   // figures that causes start from
  int peers = 0;            // too few: `deviation` and `common` are unknown
};

std::vector<ScaleResidual> ScaleResiduals(const std::vector<ScaleMember>& group);

// Scatter of deviations over the plant, in constant memory.
class ScaleScatter {
 public:
  void Add(const std::vector<ScaleResidual>& group);
  ScaleErrors ErrorsOf(const std::vector<ScaleResidual>& group) const;

 private:
  std::array<DeviationBins, kScaleQuantities> bins_;
  std::int64_t groups_ = 0;
};

// The columns of the comparison, and the cells of each string of a combiner.
std::vector<ResultColumn> ScaleColumns();
std::vector<std::vector<ResultCell>> ScaleCells(const std::vector<ScaleMember>& group,
                                                const std::vector<ScaleResidual>& residuals,
                                                const ScaleErrors& errors, double level);

}  // namespace lyrefit
