#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/certify/mixture.h"

namespace lyrefit {

constexpr double kSameAtom = 1e-9;  // atoms closer than this in u Vs count as one

// A row that fixes the mass of a window, the sum of its Is, at one end of its range. It is appended
// to the points and enforced by weighting with correction (Van Loan 1985, doi:10.1137/0722051). The
// current of a diode at a voltage of minus infinity is Is, so the row is the diode column there.
struct MassRow {
  std::size_t window = 0;
  double end_A = 0;
  double weight = 0;  // of the row
  double pull = 0;    // multiplier after the corrections made
};

// State of the solver: the atoms, the scaled linear unknowns, and the residual target - model. In
// `y` the rows of Is follow the points.
struct MixtureState {
  std::vector<Atom> atoms;
  Eigen::VectorXd linear;
  Eigen::VectorXd y;
};

// Quadratic model of the sum of squares around a state, in the u of the atoms that may move. The
// linear unknowns are eliminated.
struct MixtureSlope {
  std::vector<int> moving;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
  Eigen::VectorXd squares;  // squared norms of the derivative columns, the scale of the hessian
};

// Implementation of SolveMixture() at one Rs.
class MixtureSolver {
 public:
  MixtureSolver(const MixtureData& data, const std::vector<Window>& windows, double rs);

  Mixture Run(const std::vector<Atom>& start, double tolerance, double dark_bound_A);

 private:
  int size() const { return static_cast<int>(state_.atoms.size()); }
  Eigen::Index points() const { return vd_.size(); }
  Eigen::Index rows() const { return vd_.size() + static_cast<Eigen::Index>(rows_.size()); }

  // Adds and moves atoms until no diode column has a positive gain; the rows of Is are constant.
  Mixture Settle(double tolerance, double dark_bound_A);
  // The largest correlation that neither opens the duality gap nor exceeds rounding.
  double AllowedExcess(double y_norm, double tolerance, double dark_bound_A) const;
  std::size_t WindowIndex(double u) const;
  const Window& WindowOf(double u) const { return windows_[WindowIndex(u)]; }
  double Within(double u) const;  // the nearest u of its window
  bool Has(double u) const;
  bool AreOne(double u0, double u1) const;  // too close to be distinguished
  bool Add(double u);                       // false if an atom is already there

  double MassPerAmpere(double u) const;  // Is of a diode that takes 1 A at Vs
  std::vector<double> Masses(const std::vector<Atom>& atoms) const;
  bool UpdateRows();  // false: no range of Is is active
  double RowWeight(std::size_t window) const;
  Eigen::VectorXd Target() const;
  std::vector<double> Pulls(const Eigen::VectorXd& y) const;
  MixtureState WithinRanges() const;

  Eigen::VectorXd Column(double u) const;
  Eigen::MatrixXd Columns(const std::vector<Atom>& atoms) const;
  std::vector<int> FreeTerms() const;  // strictly within their ranges
  // Least squares over the present atoms and the linear terms. Atoms without current are dropped.
  void SolveLinear();
  void UpdateAtoms();
  bool UpdateAtomsOnce(double* damping);
  MixtureSlope SlopeHere() const;
  double Move(const std::vector<int>& moving, const Eigen::VectorXd& step);
  void MergeNeighbours();
  bool SplitNearest(double u);
  Eigen::VectorXd CleanResidual() const;
  Mixture Finish(const Eigen::VectorXd& y, double excess, double dark_bound_A) const;
  double SlopeInRs(const MixtureState& state) const;

  const MixtureData& data_;
  const std::vector<Window> windows_;  // made disjoint, so that every atom belongs to one
  const double rs_;
  const Eigen::VectorXd vd_;
  const Eigen::VectorXd target_;
  const double scale_;  // Vs, at which diode columns are scaled
  const Eigen::Index terms_;
  Eigen::MatrixXd columns_;        // weighted columns of the linear terms, divided by sizes_
  Eigen::VectorXd sizes_;          // largest absolute value of each column
  Eigen::VectorXd lower_, upper_;  // bounds of the scaled coefficients
  std::vector<MassRow> rows_;
  MixtureState state_;
};

}  // namespace lyrefit
