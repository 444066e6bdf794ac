#include "lyrefit/certify/mixture.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/dense.h"
#include "lyrefit/certify/correlation.h"
#include "lyrefit/certify/non_negative.h"

namespace lyrefit {
namespace {

constexpr int kMostRounds = 40;             // of adding an atom and sliding
constexpr int kMostSlides = 30;             // Newton steps between two such rounds
constexpr double kNeighbours = 0.5;         // atoms closer than this in u Vs may be one in truth
constexpr double kSameAtom = 1e-9;          // atoms closer than this in u Vs are one
constexpr double kMixtureRounding = 1e-16;  // relative

// A mixture on the way: the scaled unknowns and the residual measured - modelled.
struct State {
  std::vector<Atom> atoms;
  double photocurrent = 0;
  double shunt = 0;
  Eigen::VectorXd y;
};

// The sum of squares around a state as a quadratic in the u of the atoms that may move, the linear
// unknowns following.
struct Slope {
  std::vector<int> moving;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
  Eigen::VectorXd squares;  // of the derivative columns, the natural sizes of the hessian
};

class Solver {
 public:
  Solver(const MixtureData& data, const std::vector<Window>& windows, double rs)
      : data_(data),
        windows_(windows),
        rs_(rs),
        vd_(data.voltage_V + rs * data.current_A),
        scale_(vd_.maxCoeff()) {}

  Mixture Run(const std::vector<Atom>& start, double tolerance, double price_A) {
    for (const Atom& atom : start) Add(atom.u);
    SolveLinear();
    Mixture best;
    for (int round = 0; round < kMostRounds; ++round) {
      Slide();
      if (round % 3 == 2) MergeNeighbours();
      const Eigen::VectorXd y = CleanResidual();
      const double allowed = AllowedExcess(y.norm(), tolerance, price_A);
      const Correlation1D correlation =
          BoundCorrelation(vd_, scale_, y, windows_, state_.atoms, allowed);
      if (round == 0 || correlation.bound < best.excess) {
        best = Finish(y, correlation.bound, price_A);
      }
      if (correlation.best <= allowed || !Add(correlation.best_u)) break;
      SolveLinear();
      if (!Has(correlation.best_u) && !SplitNearest(correlation.best_u)) break;
    }
    return best;
  }

 private:
  int size() const { return static_cast<int>(state_.atoms.size()); }

  // What a correlation may be without opening the duality gap, or without rising above rounding.
  double AllowedExcess(double y_norm, double tolerance, double price_A) const {
    if (y_norm <= 10 * kMixtureRounding * data_.current_A.norm()) return y_norm;  // an exact fit
    return std::max(0.25 * tolerance * y_norm * y_norm / price_A, kMixtureRounding * y_norm);
  }

  const Window* WindowOf(double u) const {
    for (const Window& window : windows_) {
      if (u <= window.upper) return &window;
    }
    return &windows_.back();
  }

  bool Has(double u) const {
    return std::any_of(state_.atoms.begin(), state_.atoms.end(),
                       [u](const Atom& atom) { return atom.u == u; });
  }

  // False if there is an atom already.
  bool Add(double u) {
    const Window* window = WindowOf(u);
    u = std::min(std::max(u, window->lower), window->upper);
    for (const Atom& atom : state_.atoms) {
      if (std::fabs(atom.u - u) * scale_ < kSameAtom) return false;
    }
    state_.atoms.push_back({u, 0});
    std::sort(state_.atoms.begin(), state_.atoms.end(),
              [](const Atom& a, const Atom& b) { return a.u < b.u; });
    return true;
  }

  Eigen::MatrixXd Columns(const std::vector<Atom>& atoms) const {
    Eigen::MatrixXd a(vd_.size(), 2 + atoms.size());
    a.col(0).setOnes();
    a.col(1) = -vd_ / scale_;
    for (std::size_t j = 0; j < atoms.size(); ++j) {
      a.col(2 + j) = DiodeColumn(vd_, scale_, atoms[j].u);
    }
    return a;
  }

  // Non-negative least squares over the atoms there are. Those left without current are dropped.
  void SolveLinear();
  void Slide();
  void MergeNeighbours();
  bool SplitNearest(double u);
  Slope SlopeHere() const;
  double Move(const std::vector<int>& moving, const Eigen::VectorXd& step);
  bool SlideOnce(double* damping);
  Eigen::VectorXd CleanResidual() const;
  Mixture Finish(const Eigen::VectorXd& y, double excess, double price_A) const;

  const MixtureData& data_;
  const std::vector<Window>& windows_;
  const double rs_;
  const Eigen::VectorXd vd_;
  const double scale_;  // Vs; everything here is scaled by it
  State state_;
};

void Solver::SolveLinear() {
  const Eigen::MatrixXd a = Columns(state_.atoms);
  Eigen::VectorXd x(a.cols());
  x[0] = state_.photocurrent;
  x[1] = state_.shunt;
  for (int j = 0; j < size(); ++j) x[2 + j] = state_.atoms[j].current_A;
  x = SolveNonNegative(a, data_.current_A, x);
  state_.photocurrent = x[0];
  state_.shunt = x[1];
  std::vector<Atom> left;
  for (int j = 0; j < size(); ++j) {
    if (x[2 + j] > 0) left.push_back({state_.atoms[j].u, x[2 + j]});
  }
  state_.atoms = left;
  state_.y = Residual(data_.current_A, a, x);
}

void Solver::Slide() {
  double damping = 0;
  for (int step = 0; step < kMostSlides && size() > 0; ++step) {
    if (!SlideOnce(&damping)) return;
  }
}

// Two atoms in the place of one come about when an atom is added next to another. Puts one between
// them where that costs nothing.
void Solver::MergeNeighbours() {
  for (int j = 0; j + 1 < size(); ++j) {
    if ((state_.atoms[j + 1].u - state_.atoms[j].u) * scale_ > kNeighbours) continue;
    const State before = state_;
    const Atom &a = state_.atoms[j], &b = state_.atoms[j + 1];
    const double weight = a.current_A / (a.current_A + b.current_A);
    state_.atoms[j].u = weight * a.u + (1 - weight) * b.u;
    state_.atoms.erase(state_.atoms.begin() + j + 1);
    SolveLinear();
    Slide();
    if (state_.y.squaredNorm() <= before.y.squaredNorm() * (1 + 1e-13)) {
      --j;
    } else {
      state_ = before;
    }
  }
}

Slope Solver::SlopeHere() const {
  const Eigen::MatrixXd a = Columns(state_.atoms);
  Slope slope;
  Eigen::MatrixXd slopes(vd_.size(), size());
  Eigen::VectorXd gradient(size()), bends(size());
  std::vector<int> linear;  // columns off zero
  if (state_.photocurrent > 0) linear.push_back(0);
  if (state_.shunt > 0) linear.push_back(1);
  for (int j = 0; j < size(); ++j) {
    linear.push_back(2 + j);
    const double u = state_.atoms[j].u;
    const Eigen::ArrayXd e =
        ((vd_.array() - scale_) * u).exp() * (state_.atoms[j].current_A / -std::expm1(-u * scale_));
    slopes.col(j) = -(vd_.array() * e).matrix();
    bends[j] = -(vd_.array().square() * e * state_.y.array()).sum();
    gradient[j] = -slopes.col(j).dot(state_.y);
    const Window* window = WindowOf(u);
    const bool pressed =
        (u <= window->lower && gradient[j] >= 0) || (u >= window->upper && gradient[j] <= 0);
    if (!pressed) slope.moving.push_back(j);
  }
  if (slope.moving.empty()) return slope;
  const auto count = static_cast<Eigen::Index>(slope.moving.size());
  const Eigen::MatrixXd columns = a(Eigen::all, linear);
  const Eigen::MatrixXd b = slopes(Eigen::all, slope.moving);
  // Mixed block A'B - diag(slope . y), each slope for a current of 1.
  Eigen::MatrixXd mixed = TransposedTimes(columns, b);
  for (Eigen::Index i = 0; i < count; ++i) {
    const int j = slope.moving[i];
    const auto row = std::find(linear.begin(), linear.end(), 2 + j) - linear.begin();
    mixed(row, i) += gradient[j] / state_.atoms[j].current_A;
  }
  slope.gradient = gradient(slope.moving);
  slope.hessian = SchurComplement(columns, b, mixed);
  slope.hessian.diagonal() -= bends(slope.moving);
  slope.squares = b.colwise().squaredNorm();
  return slope;
}

// Moves the atoms by -step within their windows and solves for the rest; returns the largest move
// in u Vs.
double Solver::Move(const std::vector<int>& moving, const Eigen::VectorXd& step) {
  std::vector<Atom>& atoms = state_.atoms;
  double largest = 0;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    Atom& atom = atoms[moving[i]];
    const Window* window = WindowOf(atom.u);
    const double u = std::min(std::max(atom.u - step[static_cast<Eigen::Index>(i)], window->lower),
                              window->upper);
    largest = std::max(largest, std::fabs(u - atom.u) * scale_);
    atom.u = u;
  }
  std::sort(atoms.begin(), atoms.end(), [](const Atom& p, const Atom& q) { return p.u < q.u; });
  for (int j = size() - 1; j > 0; --j) {
    if ((atoms[j].u - atoms[j - 1].u) * scale_ < kSameAtom) atoms.erase(atoms.begin() + j);
  }
  SolveLinear();
  return largest;
}

// An atom that may not stand beside another one although the residual asks for it: the other one
// sits on a saddle and has to go both ways at once. False if that gains nothing.
bool Solver::SplitNearest(double u) {
  const State before = state_;
  const Window* window = WindowOf(u);
  int nearest = -1;
  for (int j = 0; j < size(); ++j) {
    if (WindowOf(state_.atoms[j].u) != window) continue;
    const double distance = std::fabs(state_.atoms[j].u - u);
    if (nearest < 0 || distance < std::fabs(state_.atoms[nearest].u - u)) nearest = j;
  }
  if (nearest < 0) return false;
  const double opposite = 2 * state_.atoms[nearest].u - u;
  state_.atoms.erase(state_.atoms.begin() + nearest);
  Add(u);
  Add(std::min(std::max(opposite, window->lower), window->upper));
  SolveLinear();
  Slide();
  if (state_.y.squaredNorm() < before.y.squaredNorm()) return true;
  state_ = before;
  return false;
}

// One Newton step of the atoms' u, the linear unknowns following. False when nothing moves any
// more.
bool Solver::SlideOnce(double* damping) {
  constexpr int kAttempts = 12;
  const Slope slope = SlopeHere();
  if (slope.moving.empty()) return false;
  const State before = state_;
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

// The residual with what rounding left of it along the active columns taken out, and along the
// derivatives of the columns that touch zero inside a window, so that the correlation has its
// maximum there.
Eigen::VectorXd Solver::CleanResidual() const {
  const Eigen::MatrixXd a = Columns(state_.atoms);
  std::vector<Eigen::VectorXd> active;
  if (state_.photocurrent > 0) active.push_back(a.col(0));
  if (state_.shunt > 0) active.push_back(a.col(1));
  for (int j = 0; j < size(); ++j) active.push_back(a.col(2 + j));
  if (active.empty()) return state_.y;
  const std::size_t plain = active.size();
  for (int j = 0; j < size(); ++j) {
    const Window* window = WindowOf(state_.atoms[j].u);
    if (state_.atoms[j].u <= window->lower || state_.atoms[j].u >= window->upper) continue;
    const Eigen::ArrayXd e = ((vd_.array() - scale_) * state_.atoms[j].u).exp();
    active.push_back((vd_.array() * e / vd_.cwiseAbs().maxCoeff()).matrix());
  }
  for (const std::size_t count : {active.size(), plain}) {
    Eigen::MatrixXd columns(vd_.size(), count);
    for (std::size_t i = 0; i < count; ++i) columns.col(i) = active[i];
    Eigen::VectorXd y = WithoutColumns(columns, state_.y);
    if ((y - state_.y).norm() <= 1e-5 * state_.y.norm() || count == plain) return y;
  }
  return state_.y;
}

Mixture Solver::Finish(const Eigen::VectorXd& y, double excess, double price_A) const {
  Mixture mixture;
  mixture.rs = rs_;
  mixture.scale_voltage_V = scale_;
  mixture.photocurrent_A = state_.photocurrent;
  const double reference = data_.reference_voltage_V;
  mixture.shunt_current_A = state_.shunt * reference / scale_;
  mixture.atoms = state_.atoms;
  for (Atom& atom : mixture.atoms) {
    atom.current_A *= std::exp(-atom.u * (scale_ - reference)) * std::expm1(-atom.u * reference) /
                      std::expm1(-atom.u * scale_);
  }
  mixture.primal = 0.5 * state_.y.squaredNorm();
  mixture.y = y;
  mixture.dual = data_.current_A.dot(y) - 0.5 * y.squaredNorm();
  mixture.excess = std::max(excess, -vd_.dot(y) / scale_);
  mixture.photocurrent_excess = std::max(0.0, y.sum());
  const double lack =
      mixture.excess * price_A + mixture.photocurrent_excess * (state_.photocurrent + price_A);
  mixture.relative_gap =
      (std::fabs(mixture.primal - mixture.dual) + lack) / std::max(mixture.primal, 1e-300);
  Eigen::ArrayXd slope = Eigen::ArrayXd::Constant(vd_.size(), -state_.shunt / scale_);
  for (const Atom& atom : state_.atoms) {
    const double scale = atom.current_A / -std::expm1(-atom.u * scale_);
    slope -= scale * atom.u * ((vd_.array() - scale_) * atom.u).exp();
  }
  mixture.slope = -(slope * data_.current_A.array() * state_.y.array()).sum();
  return mixture;
}

}  // namespace

Eigen::VectorXd DiodeColumn(const Eigen::VectorXd& vd, double scale_voltage_V, double u) {
  const double floor = std::exp(-u * scale_voltage_V);
  const double scale = -1 / -std::expm1(-u * scale_voltage_V);
  return (scale * (((vd.array() - scale_voltage_V) * u).exp() - floor)).matrix();
}

Mixture SolveMixture(const MixtureData& data, const std::vector<Window>& windows, double rs,
                     const std::vector<Atom>& start, double tolerance, double price_A) {
  return Solver(data, windows, rs).Run(start, tolerance, price_A);
}

}  // namespace lyrefit
