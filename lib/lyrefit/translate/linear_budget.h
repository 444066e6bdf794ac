#pragma once

#include <vector>

#include "lyrefit/translate/uncertainty.h"

namespace lyrefit {

// The values of the inputs, and the model's outputs at any inputs. All outputs are NaN where the
// model returns too few.
std::vector<double> ValuesOf(const std::vector<UncertainInput>& inputs);
std::vector<double> EvaluateAt(const UncertainModel& model, const std::vector<double>& inputs);

// Range of a choice's answers for each output, including the reported values.
struct ChoiceRange {
  std::vector<double> low;
  std::vector<double> high;
  std::vector<char> against;  // falls where the first output that varies rises
};
ChoiceRange RangeOf(const OutputChoice& choice, const std::vector<double>& reported);

// The law of propagation of uncertainty (JCGM 100, clause 5): adds a line for each source, and the
// value and standard uncertainty of each output.
void AddLinearBudget(const UncertainModel& model, const UncertaintySources& sources,
                     UncertaintyBudget* budget);

// Checks each linear interval against the drawn interval (JCGM 101, clause 8). Stores in every
// output of `budget` whether both ends agree within the numerical tolerance. Where they do not, the
// output's sentence states the reasons.
void JudgeAgreement(const UncertainModel& model, const UncertaintySources& sources,
                    int significant_digits, UncertaintyBudget* budget);

}  // namespace lyrefit
