#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/diagnose/follow_up.h"

namespace lyrefit {

// Readings that were taken and, behind them, those of one further measurement.
struct Joint {
  std::vector<PlannedCurve> curves;
  std::vector<double> unknown;  // as FollowUp::unknown
  Readings readings;
  std::vector<double> sigma;
  std::vector<char> used;
  ErrorModel errors;  // of all
  int taken = 0;      // how many readings are old
};

// The further readings as `truth` gives them, without noise. `unknown`: what turned out, in
// standard deviations. The noise of a further reading is that of the used one whose current comes
// nearest, times `deviation`. Nothing where the truth has no such currents.
std::optional<Joint> TakeFurther(const WeightedData& measured, double deviation,
                                 const FollowUp& follow_up, const LawFit& truth,
                                 const std::vector<double>& unknown);

// Adds noise to the further readings.
void Disturb(RandomStream* random, Joint* joint);

// Errors of each reading, drawn.
std::vector<double> DrawErrors(const ErrorModel& errors, RandomStream* random);

struct FurtherEnd {
  bool usable = false;
  double sum = 0;         // of squared whitened residuals, old and new, and of the unknowns
  Eigen::VectorXd after;  // whitened residuals of the further readings
};

// A law fitted to all of them, from the best of `starts`.
FurtherEnd FitJoint(const Joint& joint, const Law& law,
                    const std::vector<std::vector<double>>& starts);

}  // namespace lyrefit
