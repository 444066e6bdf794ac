#pragma once

#include <vector>

#include "lyrefit/law/parameter.h"
#include "lyrefit/search/search.h"

namespace lyrefit {

// The box a search sees: one side for each parameter that is not fixed. A linear parameter is
// searched as it is, so that published boxes mean what they mean in the literature; a logarithmic
// one by ln(value / lower end), from 0.
class SearchSpace {
 public:
  // `fixed[i]` is the value of a fixed parameter, NaN for the others.
  SearchSpace(const std::vector<ParameterBounds>& bounds, const std::vector<double>& fixed);

  const Box& box() const { return box_; }
  int dimensions() const { return static_cast<int>(parameter_.size()); }
  // Device parameters of a point of the box, into `p` (as many as there are bounds).
  void ToParameters(const double* x, double* p) const;

 private:
  std::vector<double> fixed_;
  std::vector<int> parameter_;    // of each side
  std::vector<double> log_base_;  // lower end of a logarithmic side, 0 for a linear one
  Box box_;
};

}  // namespace lyrefit
