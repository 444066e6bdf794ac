#pragma once

#include "lyrefit/certify/relaxation.h"

namespace lyrefit {

// Relaxation of the solved-current problem of one curve: half the sum of squares of weight (J - I).
// J is the root of J = g(V + J Rs) at each voltage, I the measured current, and g the law of a
// mixture. The law is a constant less leaks and diodes, so it is concave and falls.
//
// For reference currents J' and any Rs, with s the mean slope -g' between V + J' Rs and V + J Rs,
//
//   J - J' = (g(V + J' Rs) - J') / (1 + Rs s).
//
// With reference slopes s' in place of s the right-hand side is linear in the mixture. It is a
// problem of mixture.h with V + J' Rs as junction voltages. Its residuals p differ from the true
// residuals r only by a factor:
//
//   r = (1 - e) p + e r',     r' = J' - I,     e = Rs (s - s') / (1 + Rs s).
//
// Its dual vectors prove a bound D with |p|^2 / 2 >= D + |p - y|^2 / 2. Minimising over p point by
// point proves
//
//   |r|^2 / 2 >= D - sum over points of h |r' - y| |y| + (h y)^2 / 2,   h >= |e| / (1 - |e|).
//
// Only mixtures as good as the best one known need bounding. Their currents are known to within its
// residuals, and so are their slopes (solved_part.h), which bounds e. Where r' is close to the
// dual vector y, the loss is of second order in e. There e itself is small, because Rs times slopes
// is known to within the noise.
class SolvedRelaxation : public Relaxation {
 public:
  // `data` is that of CurveData() and must outlive this object.
  explicit SolvedRelaxation(const MixtureData& data) : data_(data) {}
  MixturePtr At(const std::vector<Window>&, double, const std::vector<Atom>&,
                Incumbent*) const override {
    return nullptr;  // parts share no solutions: each has its own references
  }
  void Bound(const BranchPart* parent, BranchPart* part, Incumbent* incumbent) const override;
  double Beyond(double rs) const override;
  bool SplitsWindows(const BranchPart& part, double target) const override;
  double Scale() const override;
  Eigen::Index Points() const override { return data_.target_A.size(); }

 private:
  const MixtureData& data_;
};

// The problem linearised around reference currents J' (A) and slopes s' (S) at one Rs (ohm).
MixtureData Linearise(const MixtureData& data, double rs, const Eigen::VectorXd& reference_A,
                      const Eigen::VectorXd& slope_S);

// A mixture with a low solved-current sum of squares at one Rs, by Gauss-Newton over mixtures.
// `value` is half that sum of squares.
struct SolvedMixture {
  Mixture mixture;
  Eigen::VectorXd current_A;  // J
  Eigen::VectorXd slope_S;    // at the junction voltages V + J Rs
  double value = kInfinity;
  int steps = 0;
};
SolvedMixture SolveSolvedMixture(const MixtureData& data, const std::vector<Window>& windows,
                                 double rs, const std::vector<Atom>& start, double tolerance);

}  // namespace lyrefit
