#pragma once

#include <cstdint>
#include <vector>

#include "lyrefit/diagnose/candidate.h"
#include "lyrefit/diagnose/noise.h"
#include "lyrefit/diagnose/null_distribution.h"
#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// Correction of the list's corrected p-values. Linear null statistics treat the weights as known.
// In fact the weights are estimated from the same readings, which makes extreme values more
// frequent. The correction comes from null statistics that re-estimate the noise.
struct Calibration {
  std::vector<double> null_statistics;  // -ln of corrected p per draw, ascending; or empty
  double Corrected(double p) const;
};

// Calibration of scores by simulated null statistics: noise projected off the parameters of one
// law. It covers the whole list, with bounds and grids of probes. A changed number of causes or
// readings hardly changes it, so that one calibration serves all steps and their repetitions.
struct ScoreCalibration {
  std::vector<const Effect*> effects;  // the testable ones
  ListDistribution list;               // in the order of `effects`
  Calibration calibration;
};

// Simulates `draws` linear null statistics. With `noise`, a fifth as many re-estimate the noise and
// give `calibration`. `noise` may be null.
ScoreCalibration CalibrateScores(const WeightedData& weighted, const Prepared& prepared,
                                 const NoiseEstimator* noise, int draws, std::uint64_t seed);

// Scores of all candidates with p-values. An effect that was not testable when the calibration was
// computed is corrected by its number of directions.
std::vector<Score> JudgeScores(const Prepared& prepared, const ScoreCalibration& calibration);

// The first score whose effect has this FoundBy value; at most one effect has a value other than a
// fit's. Null if there is none.
const Score* FindScore(const std::vector<Score>& scores, FoundBy found_by);

// p-value of a statistic of a fitted effect, corrected for its directions and the list.
double CorrectedP(const Score& score, double statistic, int degrees,
                  const Calibration& calibration);

// A tenth of the best statistic: effects with a smaller linear score cannot become the best by a
// fit.
double HopelessStatistic(const std::vector<Score>& scores);

// Statistic of effect number `most` among those that can be fitted, best first. 0 if `most` is 0 or
// there are no more than that.
double LeastOfTheBest(const std::vector<Score>& scores, int most);

}  // namespace lyrefit
