#pragma once

#include <vector>

namespace lyrefit {

// How crowded each candidate of a population is in the unit box: the mean of its distances to the others,
// and the largest distance of all, kept up to date candidate by candidate. A move costs O(N d), a question
// O(1), the memory is O(N d): no distance is stored. The sums are updated by differences; their
// drift is far below the threshold's own arbitrariness and the same in every run.
class Crowding {
 public:
  // `unit` holds `candidates` rows of `dimensions` coordinates.
  Crowding(int candidates, int dimensions, const std::vector<double>& unit);

  // Candidate `i` now sits at `unit` (its `dimensions` coordinates).
  void Move(int i, const double* unit);

  double MeanDistance(int i) const { return sum_[i] / (candidates_ - 1); }  // Dis_i, Eq. 24
  double LargestDistance() const { return largest_; }                  // Dis_max, Eq. 25

 private:
  void FindDistances(int i, std::vector<double>* distance);
  void FindLargest();
  static int FarthestOf(const std::vector<double>& distance);

  int candidates_;
  int dimensions_;
  int stride_;                      // candidates, rounded up to whole vectors
  std::vector<double> coordinate_;  // dimension by dimension, stride_ apart
  std::vector<double> point_;
  std::vector<double> sum_;
  std::vector<double> bound_;  // no distance of a candidate is larger
  std::vector<double> past_;
  std::vector<double> fresh_;
  double largest_ = 0;
  int end_a_ = 0;  // the two candidates that are farthest apart
  int end_b_ = 0;
};

}  // namespace lyrefit
