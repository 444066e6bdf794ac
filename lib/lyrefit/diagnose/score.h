#pragma once

#include <cstdint>
#include <vector>

#include "lyrefit/diagnose/candidate.h"
#include "lyrefit/diagnose/noise.h"
#include "lyrefit/diagnose/null_distribution.h"
#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// What the list's corrected p-value really is worth. Linear null_statistics know the weights; in truth these
// come from the same few readings, which makes extremes more frequent than they say. Found from
// null_statistics that estimate their noise anew.
struct Calibration {
  std::vector<double> null_statistics;  // -ln of the corrected p-value of each such null, rising; empty: none
  double Corrected(double p) const;
};

// What statistics are worth, by null_statistics (noise through the projections of one law) that count for the
// whole list, boundaries and grids of probes included. One cause more or less in the law, or some
// readings less, hardly change it: it serves all steps and their repetitions.
struct ScoreCalibration {
  std::vector<const Effect*> effects;  // that were testable
  ListDistribution list;                        // in that order
  Calibration calibration;
};

// From `draws` linear null_statistics; where there is a `noise` to estimate, calibrated by a fifth as many
// that do so.
ScoreCalibration CalibrateScores(const WeightedData& weighted, const Prepared& prepared,
                         const NoiseEstimator* noise, int draws, std::uint64_t seed);

// With their p-values. An effect that was not testable when worth was found counts for all its
// directions.
std::vector<Score> JudgeScores(const Prepared& prepared, const ScoreCalibration& calibration);

// The score of what is found in that way (one effect a way beside probes); null: there is none.
const Score* FindScore(const std::vector<Score>& scores, FoundBy found_by);

// p-value of a statistic that an effect reached in a fit, its directions and the list counted.
double CorrectedP(const Score& score, double statistic, int degrees,
                  const Calibration& calibration);

// An effect whose linear score is below this will not come near the best when fitted.
double HopelessStatistic(const std::vector<Score>& scores);

// Statistic of the last of so many effects that can be fitted, the best first; 0 where `most` is 0
// or there are no more.
double LeastOfTheBest(const std::vector<Score>& scores, int most);

}  // namespace lyrefit
