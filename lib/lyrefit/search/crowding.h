#pragma once

#include <vector>

namespace lyrefit {

// Distances between all birds in the unit box, kept up to date bird by bird: a move costs O(N d), a
// question O(1), where recomputing would cost O(N d) a question and O(N^2 d) for the largest
// distance. The sums are updated by differences; their drift is far below the threshold's own
// arbitrariness and the same in every run.
class Crowding {
 public:
  // `unit` holds `birds` rows of `dimensions` coordinates.
  Crowding(int birds, int dimensions, const std::vector<double>& unit);

  // Bird `i` now sits at `unit` (its `dimensions` coordinates).
  void Move(int i, const double* unit);

  double MeanDistance(int i) const { return sum_[i] / (birds_ - 1); }  // Dis_i, Eq. 24
  double LargestDistance() const { return largest_; }                  // Dis_max, Eq. 25

 private:
  double* Row(int i) { return &distance_[static_cast<std::size_t>(i) * stride_]; }
  void FindLargest();

  int birds_;
  int dimensions_;
  int stride_;                      // birds, rounded up to whole vectors
  std::vector<double> coordinate_;  // dimension by dimension, stride_ apart
  std::vector<double> distance_;    // birds_ rows, stride_ apart
  std::vector<double> sum_;
  std::vector<double> fresh_;
  double largest_ = 0;
  int end_a_ = 0;  // the two birds that are farthest apart
  int end_b_ = 0;
};

}  // namespace lyrefit
