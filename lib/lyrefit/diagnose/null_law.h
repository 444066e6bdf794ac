#pragma once

#include <Eigen/Core>
#include <vector>

namespace lyrefit {

constexpr double kTail = 0.02;  // below it p-values follow the F distribution's tail

double TailOf(double statistic, int degrees);

// p-value of a statistic given those of the nulls.
class NullLaw {
 public:
  // Lowers what stands in `smallest` to the p-values of the nulls themselves.
  NullLaw(const Eigen::Ref<const Eigen::VectorXf>& nulls, int degrees, Eigen::VectorXd* smallest);

  double Of(double statistic) const;

  // How many independent directions would give such nulls.
  double Directions() const;

 private:
  double Tail(double statistic) const;

  std::vector<float> nulls_;  // falling
  int degrees_;
  int edge_;
  double edge_tail_;
};

// The whole list under its nulls.
struct ListLaw {
  std::vector<NullLaw> laws;  // of the testable candidates, in order
  Eigen::VectorXd smallest;   // rising: the smallest p-value of each null
  int edge = 0;

  ListLaw() = default;
  ListLaw(const Eigen::MatrixXf& nulls, int degrees);  // nulls x candidates

  double Catalogue() const;  // how many such effects it is worth
  double Corrected(double p) const;
};

}  // namespace lyrefit
