#pragma once

#include <array>

#include "lyrefit/base/random.h"

namespace lyrefit {

// A setting in [0, 1] that is learned while a search runs: every use draws it around a value that
// lately served, and each iteration remembers the mean of the values its gaining moves used,
// weighted by what they gained. Success-history adaptation, after Tanabe and Fukunaga 2013
// (doi:10.1109/CEC.2013.6557555), but drawn uniformly within half the range: with so few moves in a
// search, wide draws learn sooner.
class LearnedSetting {
 public:
  explicit LearnedSetting(double first) { memory_.fill(first); }

  double Draw(RandomStream* random);

  // The move that used `value` made its candidate better by `gain`; what is not finite is passed over.
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
