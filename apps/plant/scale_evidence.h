#pragma once

#include <vector>

#include "plant/scale.h"
#include "plant/scale_causes.h"

namespace lyrefit {

// Which cause explains how far a string's figures are from what is expected. Bayesian choice among
// causes whose effect on the figures is computed: each cause is a list of sizes with a prior. The
// errors of the figures are independent of each other and follow Student's t.

// What is known of a string when causes are sought.
struct ScaleContext {
  StringFigures expected;           // or what its neighbours have
  double cells = kUnknown;          // in series, of the whole string
  double temperature_K = kUnknown;  // of the cells
  int modules = 0;                  // in series; 0: not known
  int strings = 0;                  // in parallel; 0: not known
  int bypass_diodes = 3;            // of a module
  bool shared = false;              // the deviation is that of a whole combiner from its plan
};

// One size of one cause.
struct ScaleHypothesis {
  ScaleCause cause = ScaleCause::kNone;
  ScaleVector shift{};  // of the logarithms
  ScaleVector width{};  // standard deviations that add to those of the errors
  double prior = 0;     // probability
  double size = 0;      // see ScaleSize
  double count = 0;
  double of = 0;
};

// All hypotheses for a string, kNone and kSomethingElse among them; the priors add up to 1.
std::vector<ScaleHypothesis> HypothesesFor(const ScaleContext& context);

// Errors of the logarithms.
struct ScaleErrors {
  ScaleVector sizes{};  // standard deviations
  double degrees = 1;   // of freedom of them
};

struct ScaleVerdict {
  ScaleCause cause = ScaleCause::kNone;
  std::vector<ScaleCause> alternatives;  // causes within reach of it, the most probable first
  double probability = kUnknown;         // of the cause, against all others
  double p_value = 1;                    // of a healthy string
  ScaleHypothesis mean;                  // shift and size averaged over the sizes of the cause
};

// p-value of the deviation of a healthy string, corrected for the two tests: all quantities together
// (F), and the largest alone (t). Unknown quantities do not count.
double HealthyPValue(const ScaleVector& deviation, const ScaleErrors& errors);

// The most probable cause. kNone unless the p-value is below `level` and a healthy string is less
// probable than 5 %. A healthy string is thus claimed at a rate below `level`, as far as the errors
// are right. kSomethingElse if no cause reaches half of the probability of a deviation of any form.
ScaleVerdict JudgeScale(const ScaleVector& deviation, const ScaleErrors& errors,
                        const std::vector<ScaleHypothesis>& hypotheses, double level);

}  // namespace lyrefit
