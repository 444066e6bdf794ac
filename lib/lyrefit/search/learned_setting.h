#pragma once

#include <array>

#include "lyrefit/base/random.h"

namespace lyrefit {

// A setting in [0, 1] that adapts during a search. Each use draws a value around one of the
// remembered values. Each iteration remembers the mean of the values that its improving moves used,
// weighted by the decrease of the objective. This is success-history adaptation after Tanabe and
// Fukunaga 2013 (doi:10.1109/CEC.2013.6557555). Unlike theirs, the draw is uniform within 0.5 of
// the remembered value, because wide draws adapt sooner in a search of few moves.
class LearnedSetting {
 public:
  explicit LearnedSetting(double first) { memory_.fill(first); }

  double Draw(RandomStream* random);

  // Records that a move with `value` lowered its candidate's objective by `gain`. Infinite and NaN
  // gains are ignored.
  void Gained(double value, double gain);

  void EndIteration();

 private:
  static constexpr int kCells = 5;

  std::array<double, kCells> memory_ = {};
  int next_ = 0;
  double gain_ = 0;
  double weighted_ = 0;
};

}  // namespace lyrefit
