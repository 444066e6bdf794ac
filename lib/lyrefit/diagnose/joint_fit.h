#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/diagnose/follow_up.h"

namespace lyrefit {

// Readings already measured, followed by those of one further measurement.
struct Joint {
  std::vector<PlannedCurve> curves;
  std::vector<double> unknown;  // as FollowUp::unknown
  Readings readings;
  std::vector<double> sigma;
  std::vector<char> used;
  ErrorModel errors;  // of all readings
  int taken = 0;      // number of readings already measured
};

// Computes the further readings from `truth`, without noise. `unknown`: true values of the
// unknowns, in standard deviations. The noise of a further reading is that of the used reading with
// the nearest current, times `deviation`. Empty if the law of `truth` cannot be evaluated.
std::optional<Joint> TakeFurther(const WeightedData& measured, double deviation,
                                 const FollowUp& follow_up, const LawFit& truth,
                                 const std::vector<double>& unknown);

// Adds noise to the further readings.
void Disturb(RandomStream* random, Joint* joint);

// Draws one error for each reading, including the rough path.
std::vector<double> DrawErrors(const ErrorModel& errors, RandomStream* random);

struct FurtherEnd {
  bool usable = false;
  double sum = 0;         // squared whitened residuals of all readings, and squared unknowns
  Eigen::VectorXd after;  // whitened residuals of the further readings
};

// Fits a law to all readings of `joint`, from each of `starts`, and keeps the smallest sum.
FurtherEnd FitJoint(const Joint& joint, const Law& law,
                    const std::vector<std::vector<double>>& starts);

}  // namespace lyrefit
