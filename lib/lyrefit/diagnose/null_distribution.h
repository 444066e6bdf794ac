#pragma once

#include <Eigen/Core>
#include <vector>

namespace lyrefit {

constexpr double kTail = 0.02;  // below it p-values follow the F distribution's tail

double TailOf(double statistic, int degrees);

// p-value of a statistic given those of the null_statistics.
class NullDistribution {
 public:
  // Lowers what stands in `smallest` to the p-values of the null_statistics themselves.
  NullDistribution(const Eigen::Ref<const Eigen::VectorXf>& null_statistics, int degrees, Eigen::VectorXd* smallest);

  double Of(double statistic) const;

  // How many independent directions would give such null_statistics.
  double Directions() const;

 private:
  double Tail(double statistic) const;

  std::vector<float> null_statistics_;  // falling
  int degrees_;
  int edge_;
  double edge_tail_;
};

// The whole list under its null_statistics.
struct ListDistribution {
  std::vector<NullDistribution> laws;  // of the testable candidates, in order
  Eigen::VectorXd smallest;   // rising: the smallest p-value of each null
  int edge = 0;

  ListDistribution() = default;
  ListDistribution(const Eigen::MatrixXf& null_statistics, int degrees);  // null_statistics x candidates

  double Catalogue() const;  // how many such effects it is worth
  double Corrected(double p) const;
};

}  // namespace lyrefit
