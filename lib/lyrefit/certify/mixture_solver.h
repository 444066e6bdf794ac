#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/certify/mixture.h"

namespace lyrefit {

constexpr double kSameAtom = 1e-9;  // atoms closer than this in u Vs are one

// Holds the sum of the Is of a window at one end of its range: one more row beside the points, by
// weighting with correction (Van Loan 1985, doi:10.1137/0722051). The mass is what a diode's current
// is at a voltage of minus infinity, so a row is the diode column there.
struct MassRow {
  std::size_t window = 0;
  double end_A = 0;
  double weight = 0;  // of the row
  double pull = 0;    // the multiplier so far
};

// A mixture on the way: the scaled unknowns and the residual measured - modelled, that of the rows
// behind that of the points.
struct MixtureState {
  std::vector<Atom> atoms;
  Eigen::VectorXd linear;
  Eigen::VectorXd y;
};

// The sum of squares around a state as a quadratic in the u of the atoms that may move, the linear
// unknowns following.
struct MixtureSlope {
  std::vector<int> moving;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
  Eigen::VectorXd squares;  // of the derivative columns, the natural sizes of the hessian
};

// What SolveMixture() does, at one Rs.
class MixtureSolver {
 public:
  MixtureSolver(const MixtureData& data, const std::vector<Window>& windows, double rs);

  Mixture Run(const std::vector<Atom>& start, double tolerance, double dual_gain_A);

 private:
  int size() const { return static_cast<int>(state_.atoms.size()); }
  Eigen::Index points() const { return vd_.size(); }
  Eigen::Index rows() const { return vd_.size() + static_cast<Eigen::Index>(rows_.size()); }

  // Adds atoms and slides them until no diode column gains anything, the rows as they are.
  Mixture Settle(double tolerance, double dual_gain_A);
  // What a correlation may be without opening the duality gap, or without rising above rounding.
  double AllowedExcess(double y_norm, double tolerance, double dual_gain_A) const;
  std::size_t WindowIndex(double u) const;
  const Window& WindowOf(double u) const { return windows_[WindowIndex(u)]; }
  double Within(double u) const;  // the nearest u of its window
  bool Has(double u) const;
  bool AreOne(double u0, double u1) const;  // too close to be told apart
  bool Add(double u);                       // false if there is an atom already

  double MassPerAmpere(double u) const;  // Is of a diode that takes 1 A at Vs
  std::vector<double> Masses(const std::vector<Atom>& atoms) const;
  bool UpdateRows();  // false: no end of a range of Is holds
  double RowWeight(std::size_t window) const;
  Eigen::VectorXd Target() const;
  std::vector<double> Pulls(const Eigen::VectorXd& y) const;
  MixtureState WithinRanges() const;

  Eigen::VectorXd Column(double u) const;
  Eigen::MatrixXd Columns(const std::vector<Atom>& atoms) const;
  std::vector<int> FreeTerms() const;  // strictly within their ranges
  // Least squares over the atoms there are. Those left without current are dropped.
  void SolveLinear();
  void UpdateAtoms();
  bool UpdateAtomsOnce(double* damping);
  MixtureSlope SlopeHere() const;
  double Move(const std::vector<int>& moving, const Eigen::VectorXd& step);
  void MergeNeighbours();
  bool SplitNearest(double u);
  Eigen::VectorXd CleanResidual() const;
  Mixture Finish(const Eigen::VectorXd& y, double excess, double dual_gain_A) const;
  double SlopeInRs(const MixtureState& state) const;

  const MixtureData& data_;
  const std::vector<Window> windows_;  // no end shared, so that every atom belongs to one
  const double rs_;
  const Eigen::VectorXd vd_;
  const Eigen::VectorXd target_;
  const double scale_;  // Vs; diodes are scaled by it
  const Eigen::Index terms_;
  Eigen::MatrixXd columns_;        // of the linear terms, weighted, over their sizes
  Eigen::VectorXd sizes_;          // largest of each column
  Eigen::VectorXd lower_, upper_;  // of the scaled coefficients
  std::vector<MassRow> rows_;
  MixtureState state_;
};

}  // namespace lyrefit
