#pragma once

#include <Eigen/Core>
#include <vector>

namespace lyrefit {

constexpr double kTail = 0.02;  // below it, p-values follow the tail of the F distribution

double TailOf(double statistic, int degrees);

// p-value of a statistic by the simulated null statistics of one candidate.
class NullDistribution {
 public:
  // `null_statistics`: one per draw. `smallest`, one per draw, is lowered to the p-value of the
  // draw if that is smaller.
  NullDistribution(const Eigen::Ref<const Eigen::VectorXf>& null_statistics, int degrees,
                   Eigen::VectorXd* smallest);

  double Of(double statistic) const;

  // Effective number of independent directions that would give these null statistics.
  double Directions() const;

 private:
  double Tail(double statistic) const;

  std::vector<float> null_statistics_;  // in descending order
  int degrees_;
  int edge_;
  double edge_tail_;
};

// Null distribution of the whole list of candidates.
struct ListDistribution {
  std::vector<NullDistribution> laws;  // of the testable candidates, in order
  Eigen::VectorXd smallest;            // smallest p-value of each draw, ascending
  int edge = 0;

  ListDistribution() = default;
  ListDistribution(const Eigen::MatrixXf& null_statistics, int degrees);  // draws x candidates

  double Catalogue() const;  // effective number of independent candidates
  double Corrected(double p) const;
};

}  // namespace lyrefit
