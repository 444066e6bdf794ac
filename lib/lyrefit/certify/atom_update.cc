#include <algorithm>
#include <cmath>

#include "lyrefit/base/dense.h"
#include "lyrefit/certify/mixture_solver.h"

// Updates of the atoms (diodes) of MixtureSolver, and the derivative of its value by Rs.
namespace lyrefit {
namespace {

constexpr int kMostSlides = 30;      // Newton steps between two additions of atoms
constexpr double kNeighbours = 0.5;  // atoms closer than this in u Vs are tried as one

}  // namespace

void MixtureSolver::UpdateAtoms() {
  double damping = 0;
  for (int step = 0; step < kMostSlides && size() > 0; ++step) {
    if (!UpdateAtomsOnce(&damping)) return;
  }
}

// Adding an atom next to another one can leave two atoms where the optimum has one. Replaces two
// neighbours by one at their mean u, weighted by current, wherever the sum of squares does not
// rise.
void MixtureSolver::MergeNeighbours() {
  for (int j = 0; j + 1 < size(); ++j) {
    const double u0 = state_.atoms[j].u, u1 = state_.atoms[j + 1].u;
    if ((u1 - u0) * scale_ > kNeighbours || WindowIndex(u0) != WindowIndex(u1)) continue;
    const MixtureState before = state_;
    const Atom &a = state_.atoms[j], &b = state_.atoms[j + 1];
    const double weight = a.current_A / (a.current_A + b.current_A);
    state_.atoms[j].u = weight * a.u + (1 - weight) * b.u;
    state_.atoms.erase(state_.atoms.begin() + j + 1);
    SolveLinear();
    UpdateAtoms();
    if (state_.y.squaredNorm() <= before.y.squaredNorm() * (1 + 1e-13)) {
      --j;
    } else {
      state_ = before;
    }
  }
}

MixtureSlope MixtureSolver::SlopeHere() const {
  const Eigen::MatrixXd a = Columns(state_.atoms);
  MixtureSlope slope;
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(rows(), size());  // at fixed Is: rows get 0
  Eigen::VectorXd gradient(size()), bends(size());
  std::vector<int> linear = FreeTerms();  // columns inside their ranges
  for (int j = 0; j < size(); ++j) {
    linear.push_back(static_cast<int>(terms_) + j);
    const double u = state_.atoms[j].u;
    const Eigen::ArrayXd e = ((vd_.array() - scale_) * u).exp() * data_.weight.array() *
                             (state_.atoms[j].current_A / -std::expm1(-u * scale_));
    slopes.col(j).head(points()) = -(vd_.array() * e).matrix();
    bends[j] = -(vd_.array().square() * e * state_.y.head(points()).array()).sum();
    gradient[j] = -slopes.col(j).dot(state_.y);
    const Window& window = WindowOf(u);
    const bool pressed =
        (u <= window.lower && gradient[j] >= 0) || (u >= window.upper && gradient[j] <= 0);
    if (!pressed) slope.moving.push_back(j);
  }
  if (slope.moving.empty()) return slope;
  const auto count = static_cast<Eigen::Index>(slope.moving.size());
  const Eigen::MatrixXd columns = a(Eigen::all, linear);
  const Eigen::MatrixXd b = slopes(Eigen::all, slope.moving);
  // Mixed second derivatives A'B - diag(slope . y), each slope per ampere of its atom.
  Eigen::MatrixXd mixed = TransposedTimes(columns, b);
  for (Eigen::Index i = 0; i < count; ++i) {
    const int j = slope.moving[i];
    const auto row = std::find(linear.begin(), linear.end(), terms_ + j) - linear.begin();
    mixed(row, i) += gradient[j] / state_.atoms[j].current_A;
  }
  slope.gradient = gradient(slope.moving);
  slope.hessian = SchurComplement(columns, b, mixed);
  slope.hessian.diagonal() -= bends(slope.moving);
  slope.squares = b.colwise().squaredNorm();
  return slope;
}

// Moves the u of the atoms by -step, clipped to their windows, and solves for the linear unknowns.
// Returns the largest move in u Vs.
double MixtureSolver::Move(const std::vector<int>& moving, const Eigen::VectorXd& step) {
  std::vector<Atom>& atoms = state_.atoms;
  double largest = 0;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    Atom& atom = atoms[moving[i]];
    const Window& window = WindowOf(atom.u);
    const double u =
        std::min(std::max(atom.u - step[static_cast<Eigen::Index>(i)], window.lower), window.upper);
    largest = std::max(largest, std::fabs(u - atom.u) * scale_);
    atom.u = u;
  }
  std::sort(atoms.begin(), atoms.end(), [](const Atom& p, const Atom& q) { return p.u < q.u; });
  for (int j = size() - 1; j > 0; --j) {
    if (AreOne(atoms[j - 1].u, atoms[j].u)) atoms.erase(atoms.begin() + j);
  }
  SolveLinear();
  return largest;
}

// Replaces the atom nearest to u by two atoms, at u and at its mirror image. This is needed when
// the residual requires an atom at u, but SolveLinear() drops it. The nearest atom is then at a
// saddle point. False if the sum of squares does not fall; the state is then unchanged.
bool MixtureSolver::SplitNearest(double u) {
  const MixtureState before = state_;
  const std::size_t window = WindowIndex(u);
  int nearest = -1;
  for (int j = 0; j < size(); ++j) {
    if (WindowIndex(state_.atoms[j].u) != window) continue;
    const double distance = std::fabs(state_.atoms[j].u - u);
    if (nearest < 0 || distance < std::fabs(state_.atoms[nearest].u - u)) nearest = j;
  }
  if (nearest < 0) return false;
  const double opposite = 2 * state_.atoms[nearest].u - u;
  state_.atoms.erase(state_.atoms.begin() + nearest);
  Add(u);
  Add(std::min(std::max(opposite, windows_[window].lower), windows_[window].upper));
  SolveLinear();
  UpdateAtoms();
  if (state_.y.squaredNorm() < before.y.squaredNorm()) return true;
  state_ = before;
  return false;
}

// One damped Newton step of the atoms' u, with the linear unknowns eliminated. False when no step
// moves an atom or lowers the sum of squares.
bool MixtureSolver::UpdateAtomsOnce(double* damping) {
  constexpr int kAttempts = 12;
  const MixtureSlope slope = SlopeHere();
  if (slope.moving.empty()) return false;
  const MixtureState before = state_;
  const double square = before.y.squaredNorm();
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    Eigen::MatrixXd damped = slope.hessian;
    damped.diagonal() += *damping * slope.squares;
    Eigen::VectorXd step;
    if (SolvePositive(damped, slope.gradient, &step)) {
      const double largest = Move(slope.moving, step);
      const double after = state_.y.squaredNorm();
      if (after <= square * (1 + 1e-15)) {
        *damping = *damping > 1e-9 ? *damping * 0.1 : 0;
        return largest > 1e-13 && (after < square * (1 - 1e-15) || largest > 1e-9);
      }
      state_ = before;
    }
    *damping = std::max(*damping * 10, 1e-6);
  }
  return false;
}

double MixtureSolver::SlopeInRs(const MixtureState& state) const {
  Eigen::ArrayXd slope = Eigen::ArrayXd::Zero(points());
  for (Eigen::Index j = 0; j < terms_; ++j) {
    slope += state.linear[j] / sizes_[j] * data_.terms[j].per_volt.array();
  }
  for (const Atom& atom : state.atoms) {
    const double scale = atom.current_A / -std::expm1(-atom.u * scale_);
    slope -= scale * atom.u * ((vd_.array() - scale_) * atom.u).exp();
  }
  const Eigen::ArrayXd y = state.y.head(points()).array();
  return -(slope * data_.current_A.array() * data_.weight.array() * y).sum();
}

}  // namespace lyrefit
