#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/diagnose/noise.h"
#include "lyrefit/diagnose/workbench.h"

namespace lyrefit {

// One way an effect could show: the direction in which it would move the whitened currents, less
// what the present law absorbs.
struct Direction {
  int probe = 0;     // of the effect's probes
  double kept = 0;   // part of the signature's norm the law cannot absorb
  double norm = 0;   // of what is kept, at the probe's strength
  double score = 0;  // its length along the residual, signed: positive if the effect helps
};

// How an effect scores on the residuals of a law.
struct Score {
  const Effect* effect = nullptr;
  bool testable = false;
  std::string why_not;
  std::vector<Direction> directions;  // the best first
  double statistic = 0;               // F(1, dof - 1) of the best direction
  double p_value = 1;                 // all its directions counted, by simulated nulls
  double corrected_p = 1;             // the whole catalogue counted
  double charge = 0;                  // 2 ln of its effective number of directions
  double catalogue = 1;               // how many such effects the whole list is worth
  double kept = 0;                    // of its best kept direction
  int outlier = -1;                   // of `outliers`: the reading
};

// What the list's corrected p-value really is worth. Linear nulls know the weights; in truth these
// come from the same few readings, which makes extremes more frequent than they say. Found from
// nulls that estimate their noise anew.
struct Calibration {
  std::vector<double> nulls;  // -ln of the corrected p-value of each such null, rising; empty: none
  double Corrected(double p) const;
};

// Standard normal numbers for the nulls of a measurement, a row a reading and a column a null.
// Every scoring of it may use the same.
using NullDraws = Eigen::MatrixXf;
NullDraws MakeNullDraws(std::size_t readings, int draws, std::uint64_t seed, std::uint64_t run = 0);

// Every effect of `candidates` beside the residuals of `fit` and beside simulated nulls (noise
// through the same projections), which count for the whole list, boundaries and grids of probes
// included. "unknown_structure" is scored on smooth waves along each stretch, "outliers" on single
// readings.
class ScoreSheet {
 public:
  ScoreSheet(const Workbench& bench, const LawFit& fit,
             const std::vector<const Effect*>& candidates,
             const Eigen::Ref<const NullDraws>& draws);
  ScoreSheet(ScoreSheet&&) noexcept;
  ScoreSheet& operator=(ScoreSheet&&) noexcept;
  ~ScoreSheet();

  std::vector<Score> Scores(const Calibration& calibration = {}) const;

  // From `draws` nulls of their own, on the bench of the sheet.
  Calibration Calibrate(const Workbench& bench, const NoiseEstimator& noise, int draws,
                        std::uint64_t seed) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// The scores of a sheet that nothing else is asked.
std::vector<Score> ScoreEffects(const Workbench& bench, const LawFit& fit,
                                const std::vector<const Effect*>& candidates,
                                const Eigen::Ref<const NullDraws>& draws,
                                const Calibration& calibration = {});

// The same without nulls, where scores decide only what is fitted: what a list counts for hardly
// changes with one cause more or less, so that charges are taken from `known` scores. No p-values.
std::vector<Score> Rescore(const Workbench& bench, const LawFit& fit,
                           const std::vector<const Effect*>& candidates,
                           const std::vector<Score>& known);

// p-value of a statistic that an effect reached in a fit, its directions and the list counted.
double CorrectedP(const Score& score, double statistic, int degrees,
                  const Calibration& calibration);

// An effect whose linear score is below this will not come near the best when fitted.
double HopelessStatistic(const std::vector<Score>& scores);

// What an effect's probe does to the fitted currents, whitened.
Eigen::VectorXd Signature(const Workbench& bench, const LawFit& fit, const Effect& effect,
                          const Probe& probe, LawWorkspace* workspace);

}  // namespace lyrefit
