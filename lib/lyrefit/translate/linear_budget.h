#pragma once

#include <vector>

#include "lyrefit/translate/uncertainty.h"

namespace lyrefit {

// What the model gives at the inputs' values, and an answer of all its results anywhere else; NaN
// where it gives too few.
std::vector<double> ValuesOf(const std::vector<UncertainInput>& inputs);
std::vector<double> EvaluateAt(const UncertainModel& model, const std::vector<double>& inputs);

// Between which the answers of a choice lie, of each result, the reported ones among them.
struct ChoiceRange {
  std::vector<double> low;
  std::vector<double> high;
  std::vector<char> against;  // falls while the first result that varies rises
};
ChoiceRange RangeOf(const OutputChoice& choice, const std::vector<double>& reported);

// The law of propagation: a line for each source, and value and standard uncertainty of each
// result.
void AddLinearBudget(const UncertainModel& model, const UncertaintySources& sources,
                     UncertaintyBudget* budget);

}  // namespace lyrefit
