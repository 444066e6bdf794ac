#pragma once

#include <vector>

namespace lyrefit {

// Crowding of a population in the unit box: each candidate's mean distance to the others, and the
// largest distance of all. Both are updated after each move. A move costs O(N d), a query O(1), and
// the memory is O(N d), because no distances are stored. The sums are updated by differences. Their
// rounding drift is far below the uncertainty in the choice of the threshold, and the same in every
// run.
class Crowding {
 public:
  // `unit` holds `candidates` rows of `dimensions` unit-box coordinates.
  Crowding(int candidates, int dimensions, const std::vector<double>& unit);

  // Sets the position of candidate `i` to the `dimensions` coordinates at `unit`.
  void Move(int i, const double* unit);

  double MeanDistance(int i) const { return sum_[i] / (candidates_ - 1); }  // Dis_i, Eq. 24
  double LargestDistance() const { return largest_; }                       // Dis_max, Eq. 25

 private:
  void FindDistances(int i, std::vector<double>* distance);
  void FindLargest();
  static int FarthestOf(const std::vector<double>& distance);

  int candidates_;
  int dimensions_;
  int stride_;                      // number of candidates, rounded up to whole vectors
  std::vector<double> coordinate_;  // all candidates' values of dimension 0, then of 1, ...;
                                    // stride_ apart
  std::vector<double> point_;
  std::vector<double> sum_;
  std::vector<double> bound_;  // upper bound of each candidate's distances
  std::vector<double> past_;
  std::vector<double> fresh_;
  double largest_ = 0;
  int end_a_ = 0;  // the two candidates that are farthest apart
  int end_b_ = 0;
};

}  // namespace lyrefit
