#include "lyrefit/certify/mixture_solver.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/dense.h"
#include "lyrefit/certify/correlation.h"
#include "lyrefit/estimate/refine/bounded_linear.h"

namespace lyrefit {
namespace {

constexpr int kMostRounds = 40;             // rounds of adding an atom and moving all
constexpr double kMixtureRounding = 1e-16;  // relative
constexpr int kMostCorrections = 12;        // corrections of the multipliers of Is
constexpr double kRowWeight = 100;          // weight of a row of Is against a diode column
constexpr double kMassRounding = 1e-14;     // relative distance at which Is counts as at its bound
constexpr double kFaintest = 1e-150;        // Is per ampere: its square does not underflow

std::vector<Window> Apart(std::vector<Window> windows) {
  for (std::size_t w = 1; w < windows.size(); ++w) {
    const double end = windows[w - 1].upper;
    if (windows[w].lower <= end) windows[w].lower = std::nextafter(end, kInfinity);
  }
  return windows;
}

}  // namespace

MixtureSolver::MixtureSolver(const MixtureData& data, const std::vector<Window>& windows, double rs)
    : data_(data),
      windows_(Apart(windows)),
      rs_(rs),
      vd_(data.JunctionVoltage(rs)),
      target_(data.WeightedTarget()),
      scale_(vd_.maxCoeff()),
      terms_(static_cast<Eigen::Index>(data.terms.size())),
      columns_(vd_.size(), terms_),
      sizes_(terms_),
      lower_(terms_),
      upper_(terms_) {
  for (Eigen::Index j = 0; j < terms_; ++j) {
    const LinearTerm& term = data.terms[j];
    const Eigen::VectorXd column = term.Column(vd_);
    sizes_[j] = std::max(column.cwiseAbs().maxCoeff(), 1e-300);
    columns_.col(j) = data.weight.cwiseProduct(column) / sizes_[j];
    lower_[j] = term.lower * sizes_[j];
    upper_[j] = term.upper * sizes_[j];
  }
  state_.linear = Eigen::VectorXd::Zero(terms_).cwiseMax(lower_).cwiseMin(upper_);
}

// Solves first without the ranges of Is. Each violated range is then enforced by a row, and the
// rows are corrected until the dual value has converged.
Mixture MixtureSolver::Run(const std::vector<Atom>& start, double tolerance, double dark_bound_A) {
  for (const Atom& atom : start) Add(atom.u);
  SolveLinear();
  Mixture best = Settle(tolerance, dark_bound_A);
  int idle = 0;
  for (int round = 0; round < kMostCorrections && idle < 2 && UpdateRows(); ++round) {
    SolveLinear();
    Mixture next = Settle(tolerance, dark_bound_A);
    idle = next.relative_gap < 0.5 * best.relative_gap ? 0 : idle + 1;
    if (next.relative_gap < best.relative_gap) best = std::move(next);
    if (best.relative_gap <= tolerance) break;
  }
  return best;
}

Mixture MixtureSolver::Settle(double tolerance, double dark_bound_A) {
  Mixture best;
  for (int round = 0; round < kMostRounds; ++round) {
    UpdateAtoms();
    if (round % 3 == 2) MergeNeighbours();
    const Eigen::VectorXd y = CleanResidual();
    const Eigen::VectorXd at_points = y.head(points());
    const double allowed = AllowedExcess(at_points.norm(), tolerance, dark_bound_A);
    const Correlation1D correlation =
        BoundCorrelation(vd_, scale_, data_.weight.cwiseProduct(at_points), windows_, state_.atoms,
                         allowed, Pulls(y));
    if (round == 0 || correlation.bound < best.excess) {
      best = Finish(y, correlation.bound, dark_bound_A);
    }
    const double u = Within(correlation.best_u);
    if (correlation.best <= allowed || !Add(u)) break;
    SolveLinear();
    if (!Has(u) && !SplitNearest(u)) break;
  }
  return best;
}

double MixtureSolver::AllowedExcess(double y_norm, double tolerance, double dark_bound_A) const {
  if (y_norm <= 10 * kMixtureRounding * target_.norm()) return y_norm;  // an exact fit
  return std::max(0.25 * tolerance * y_norm * y_norm / dark_bound_A, kMixtureRounding * y_norm);
}

std::size_t MixtureSolver::WindowIndex(double u) const {
  std::size_t index = 0;
  while (index + 1 < windows_.size() && u > windows_[index].upper) ++index;
  return index;
}

bool MixtureSolver::Has(double u) const {
  return std::any_of(state_.atoms.begin(), state_.atoms.end(),
                     [u](const Atom& atom) { return atom.u == u; });
}

bool MixtureSolver::AreOne(double u0, double u1) const {
  return std::fabs(u1 - u0) * scale_ < kSameAtom && WindowIndex(u0) == WindowIndex(u1);
}

double MixtureSolver::Within(double u) const {
  const Window& window = WindowOf(u);
  return std::min(std::max(u, window.lower), window.upper);
}

bool MixtureSolver::Add(double u) {
  u = Within(u);
  for (const Atom& atom : state_.atoms) {
    if (AreOne(atom.u, u)) return false;
  }
  state_.atoms.push_back({u, 0});
  std::sort(state_.atoms.begin(), state_.atoms.end(),
            [](const Atom& a, const Atom& b) { return a.u < b.u; });
  return true;
}

double MixtureSolver::MassPerAmpere(double u) const {
  return std::exp(-u * scale_) / -std::expm1(-u * scale_);
}

std::vector<double> MixtureSolver::Masses(const std::vector<Atom>& atoms) const {
  std::vector<double> masses(windows_.size(), 0);
  for (const Atom& atom : atoms) {
    masses[WindowIndex(atom.u)] += atom.current_A * MassPerAmpere(atom.u);
  }
  return masses;
}

// Weight of the row of Is of a window, relative to the points. It is large enough for its
// correction to converge in a few rounds, and small enough to keep rounding errors invisible.
double MixtureSolver::RowWeight(std::size_t window) const {
  double mass = 0;
  for (const Atom& atom : state_.atoms) {
    if (WindowIndex(atom.u) == window) mass = std::max(mass, MassPerAmpere(atom.u));
  }
  if (mass == 0) mass = MassPerAmpere(windows_[window].lower);
  return kRowWeight / std::max(mass, kFaintest);
}

bool MixtureSolver::UpdateRows() {
  const std::vector<double> masses = Masses(state_.atoms);
  const std::vector<double> pulls = Pulls(state_.y);
  std::vector<MassRow> next;
  for (std::size_t w = 0; w < windows_.size(); ++w) {
    const Window& window = windows_[w];
    const auto row = std::find_if(rows_.begin(), rows_.end(),
                                  [w](const MassRow& other) { return other.window == w; });
    const bool fixed = window.saturation_lower_A == window.saturation_upper_A;
    if (row != rows_.end()) {
      const bool upper = row->end_A == window.saturation_upper_A;
      if (fixed || (upper ? pulls[w] > 0 : pulls[w] < 0)) {
        next.push_back({w, row->end_A, RowWeight(w), pulls[w]});
      }
    } else if (masses[w] > window.saturation_upper_A * (1 + kMassRounding)) {
      next.push_back({w, window.saturation_upper_A, RowWeight(w), 0});
    } else if (masses[w] < window.saturation_lower_A * (1 - kMassRounding)) {
      next.push_back({w, window.saturation_lower_A, RowWeight(w), 0});
    }
  }
  const bool held = !next.empty() || !rows_.empty();
  rows_ = std::move(next);
  return held;
}

Eigen::VectorXd MixtureSolver::Target() const {
  Eigen::VectorXd target(rows());
  target.head(points()) = target_;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const MassRow& row = rows_[i];
    target[points() + static_cast<Eigen::Index>(i)] =
        row.weight * row.end_A - row.pull / row.weight;
  }
  return target;
}

std::vector<double> MixtureSolver::Pulls(const Eigen::VectorXd& y) const {
  std::vector<double> pulls(windows_.size(), 0);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const MassRow& row = rows_[i];
    pulls[row.window] = -row.weight * y[points() + static_cast<Eigen::Index>(i)];
  }
  return pulls;
}

Eigen::VectorXd MixtureSolver::Column(double u) const {
  Eigen::VectorXd column(rows());
  column.head(points()) = data_.weight.cwiseProduct(DiodeColumn(vd_, scale_, u));
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const bool in_window = rows_[i].window == WindowIndex(u);
    column[points() + static_cast<Eigen::Index>(i)] =
        in_window ? rows_[i].weight * MassPerAmpere(u) : 0;
  }
  return column;
}

Eigen::MatrixXd MixtureSolver::Columns(const std::vector<Atom>& atoms) const {
  Eigen::MatrixXd a =
      Eigen::MatrixXd::Zero(rows(), terms_ + static_cast<Eigen::Index>(atoms.size()));
  a.topLeftCorner(points(), terms_) = columns_;
  for (std::size_t j = 0; j < atoms.size(); ++j) {
    a.col(terms_ + static_cast<Eigen::Index>(j)) = Column(atoms[j].u);
  }
  return a;
}

std::vector<int> MixtureSolver::FreeTerms() const {
  std::vector<int> free;
  for (int j = 0; j < terms_; ++j) {
    if (state_.linear[j] > lower_[j] && state_.linear[j] < upper_[j]) free.push_back(j);
  }
  return free;
}

void MixtureSolver::SolveLinear() {
  const Eigen::MatrixXd a = Columns(state_.atoms);
  const Eigen::VectorXd target = Target();
  Eigen::VectorXd x(a.cols()), lower(a.cols()), upper(a.cols());
  x.head(terms_) = state_.linear;
  lower.head(terms_) = lower_;
  upper.head(terms_) = upper_;
  lower.tail(size()).setZero();
  upper.tail(size()).setConstant(kInfinity);
  for (int j = 0; j < size(); ++j) x[terms_ + j] = state_.atoms[j].current_A;
  x = SolveBoundedColumns(a, target, lower, upper, x);
  state_.linear = x.head(terms_);
  std::vector<Atom> left;
  for (int j = 0; j < size(); ++j) {
    if (x[terms_ + j] > 0) left.push_back({state_.atoms[j].u, x[terms_ + j]});
  }
  state_.atoms = left;
  state_.y = Residual(target, a, x);
}

// The residual, projected to remove rounding errors along the active columns. If the change is
// small, the derivatives of diode columns inside their windows are removed too, so that the
// correlation has its maximum at the atom. The rows of Is are scaled to the size of the points for
// this.
Eigen::VectorXd MixtureSolver::CleanResidual() const {
  const Eigen::Index extra = rows() - points();
  Eigen::MatrixXd a = Columns(state_.atoms);
  Eigen::VectorXd residual = state_.y;
  a.bottomRows(extra) /= kRowWeight;
  residual.tail(extra) *= kRowWeight;
  std::vector<Eigen::VectorXd> active;
  for (const int j : FreeTerms()) active.push_back(a.col(j));
  for (int j = 0; j < size(); ++j) active.push_back(a.col(terms_ + j));
  if (active.empty()) return state_.y;
  const std::size_t plain = active.size();
  for (int j = 0; j < size(); ++j) {
    const Window& window = WindowOf(state_.atoms[j].u);
    if (state_.atoms[j].u <= window.lower || state_.atoms[j].u >= window.upper) continue;
    const Eigen::ArrayXd e = ((vd_.array() - scale_) * state_.atoms[j].u).exp();
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(rows());
    slope.head(points()) =
        (data_.weight.array() * vd_.array() * e / vd_.cwiseAbs().maxCoeff()).matrix();
    active.push_back(std::move(slope));
  }
  Eigen::VectorXd y = residual;
  for (const std::size_t count : {active.size(), plain}) {
    Eigen::MatrixXd columns(rows(), count);
    for (std::size_t i = 0; i < count; ++i) columns.col(i) = active[i];
    y = WithoutColumns(columns, residual);
    if ((y - residual).norm() <= 1e-5 * residual.norm()) break;
  }
  y.tail(extra) /= kRowWeight;
  return y;
}

// The state with the Is of every window moved to the nearest end of its range if it lies outside.
MixtureState MixtureSolver::WithinRanges() const {
  const std::vector<double> masses = Masses(state_.atoms);
  MixtureState state = state_;
  bool moved = !rows_.empty();
  for (std::size_t w = 0; w < windows_.size(); ++w) {
    const Window& window = windows_[w];
    const double mass =
        std::min(std::max(masses[w], window.saturation_lower_A), window.saturation_upper_A);
    if (mass == masses[w]) continue;
    moved = true;
    for (Atom& atom : state.atoms) {
      if (WindowIndex(atom.u) == w) atom.current_A *= mass / masses[w];
    }
    if (masses[w] == 0) {
      state.atoms.push_back({window.lower, mass / MassPerAmpere(window.lower)});
    }
  }
  if (!moved) return state;
  std::sort(state.atoms.begin(), state.atoms.end(),
            [](const Atom& a, const Atom& b) { return a.u < b.u; });
  state.y = target_ - Times(columns_, state.linear);
  for (const Atom& atom : state.atoms) {
    state.y -= atom.current_A * data_.weight.cwiseProduct(DiodeColumn(vd_, scale_, atom.u));
  }
  return state;
}

Mixture MixtureSolver::Finish(const Eigen::VectorXd& y, double excess, double dark_bound_A) const {
  const MixtureState state = WithinRanges();
  Mixture mixture;
  mixture.rs = rs_;
  mixture.scale_voltage_V = scale_;
  mixture.reference_voltage_V = data_.reference_voltage_V;
  mixture.linear = state.linear.cwiseQuotient(sizes_);
  const double reference = data_.reference_voltage_V;
  mixture.atoms = state.atoms;
  for (Atom& atom : mixture.atoms) {
    atom.current_A *= std::exp(-atom.u * (scale_ - reference)) * std::expm1(-atom.u * reference) /
                      std::expm1(-atom.u * scale_);
  }
  mixture.primal = 0.5 * state.y.squaredNorm();
  mixture.y = y.head(points());
  mixture.dual = target_.dot(mixture.y) - 0.5 * mixture.y.squaredNorm();
  mixture.excess = excess;
  mixture.saturation_pulls = Pulls(y);
  for (std::size_t w = 0; w < windows_.size(); ++w) {
    const double pull = mixture.saturation_pulls[w];
    if (pull == 0) continue;
    mixture.dual -=
        pull * (pull < 0 ? windows_[w].saturation_lower_A : windows_[w].saturation_upper_A);
  }
  const Eigen::VectorXd pulls = TransposedTimes(columns_, mixture.y);  // of the scaled columns
  mixture.pulls = pulls.cwiseProduct(sizes_);
  double lack = mixture.excess * dark_bound_A;
  for (Eigen::Index j = 0; j < terms_; ++j) {
    if (pulls[j] > 0 && upper_[j] == kInfinity) {
      lack += pulls[j] * (state.linear[j] + dark_bound_A);
    } else if (pulls[j] != 0) {
      mixture.dual -= pulls[j] * (pulls[j] < 0 ? lower_[j] : upper_[j]);
    }
  }
  mixture.relative_gap =
      (std::fabs(mixture.primal - mixture.dual) + lack) / std::max(mixture.primal, 1e-300);
  mixture.slope = SlopeInRs(state);
  return mixture;
}

}  // namespace lyrefit
