#include "lyrefit/certify/mixture.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "lyrefit/certify/correlation.h"

namespace lyrefit {
namespace {

constexpr int kMostRounds = 40;      // of adding an atom and sliding
constexpr int kMostSlides = 30;      // Newton steps between two such rounds
constexpr double kNeighbours = 0.5;  // atoms closer than this in u Vs may be one in truth
constexpr double kSameAtom = 1e-9;   // atoms closer than this in u Vs are one
constexpr double kRounding = 1e-16;  // relative

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
      const Correlation1D correlation = BoundCorrelation(vd_, scale_, y, windows_, atoms_, allowed);
      if (round == 0 || correlation.bound < best.excess) {
        best = Finish(y, correlation.bound, price_A);
      }
      if (correlation.best <= allowed || !Add(correlation.best_u)) break;
      SolveLinear();
    }
    return best;
  }

 private:
  int size() const { return static_cast<int>(atoms_.size()); }

  // What a correlation may be without opening the duality gap, or without rising above rounding.
  double AllowedExcess(double y_norm, double tolerance, double price_A) const {
    if (y_norm <= 10 * kRounding * data_.current_A.norm()) return y_norm;  // an exact fit
    return std::max(0.25 * tolerance * y_norm * y_norm / price_A, kRounding * y_norm);
  }

  const Window* WindowOf(double u) const {
    for (const Window& window : windows_) {
      if (u <= window.upper) return &window;
    }
    return &windows_.back();
  }

  // False if there is an atom already.
  bool Add(double u) {
    const Window* window = WindowOf(u);
    u = std::min(std::max(u, window->lower), window->upper);
    for (const Atom& atom : atoms_) {
      if (std::fabs(atom.u - u) * scale_ < kSameAtom) return false;
    }
    atoms_.push_back({u, 0});
    std::sort(atoms_.begin(), atoms_.end(), [](const Atom& a, const Atom& b) { return a.u < b.u; });
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
  bool SlideOnce(double* damping);
  Eigen::VectorXd CleanResidual() const;
  Mixture Finish(const Eigen::VectorXd& y, double excess, double price_A) const;

  const MixtureData& data_;
  const std::vector<Window>& windows_;
  const double rs_;
  const Eigen::VectorXd vd_;
  const double scale_;  // Vs; everything here is scaled by it
  std::vector<Atom> atoms_;
  double photocurrent_ = 0;
  double shunt_ = 0;
  Eigen::VectorXd y_;
};

// Least squares over the columns in `active`; zeros elsewhere.
Eigen::VectorXd SolveActive(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                            const std::vector<int>& active) {
  Eigen::MatrixXd columns(a.rows(), active.size());
  for (std::size_t i = 0; i < active.size(); ++i) columns.col(i) = a.col(active[i]);
  const Eigen::VectorXd solution = columns.colPivHouseholderQr().solve(b);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(a.cols());
  for (std::size_t i = 0; i < active.size(); ++i) x[active[i]] = solution[i];
  return x;
}

// Non-negative least squares (Lawson and Hanson 1974, chapter 23) from a feasible start; its zeros
// may enter at once, without being priced, since rounding hides what a column next to another one
// has to give.
Eigen::VectorXd SolveNonNegative(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                 Eigen::VectorXd x) {
  const int count = static_cast<int>(a.cols());
  std::vector<int> active(count);
  std::iota(active.begin(), active.end(), 0);
  for (int round = 0; round < 6 * count; ++round) {
    while (!active.empty()) {
      const Eigen::VectorXd target = SolveActive(a, b, active);
      double reach = 1;
      int blocking = -1;
      for (const int i : active) {
        if (target[i] > 0) continue;
        const double fraction = x[i] > 0 ? x[i] / (x[i] - target[i]) : 0;
        if (blocking >= 0 && fraction >= reach) continue;
        reach = fraction;
        blocking = i;
      }
      x += reach * (target - x);
      if (blocking < 0) break;
      x[blocking] = 0;
      active.erase(std::find(active.begin(), active.end(), blocking));
    }
    const Eigen::VectorXd y = b - a * x;
    int best = -1;
    double strongest = 1e-15 * b.norm();
    for (int i = 0; i < count; ++i) {
      if (std::find(active.begin(), active.end(), i) != active.end()) continue;
      const double pull = a.col(i).dot(y) / a.col(i).norm();
      if (pull <= strongest) continue;
      strongest = pull;
      best = i;
    }
    if (best < 0) break;
    active.push_back(best);
  }
  return x;
}

void Solver::SolveLinear() {
  const Eigen::MatrixXd a = Columns(atoms_);
  Eigen::VectorXd x(a.cols());
  x[0] = photocurrent_;
  x[1] = shunt_;
  for (int j = 0; j < size(); ++j) x[2 + j] = atoms_[j].current_A;
  x = SolveNonNegative(a, data_.current_A, x);
  photocurrent_ = x[0];
  shunt_ = x[1];
  std::vector<Atom> left;
  for (int j = 0; j < size(); ++j) {
    if (x[2 + j] > 0) left.push_back({atoms_[j].u, x[2 + j]});
  }
  atoms_ = left;
  y_ = data_.current_A - a * x;
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
    if ((atoms_[j + 1].u - atoms_[j].u) * scale_ > kNeighbours) continue;
    const Solver before = *this;
    const Atom &a = atoms_[j], &b = atoms_[j + 1];
    const double weight = a.current_A / (a.current_A + b.current_A);
    atoms_[j].u = weight * a.u + (1 - weight) * b.u;
    atoms_.erase(atoms_.begin() + j + 1);
    SolveLinear();
    Slide();
    if (y_.squaredNorm() <= before.y_.squaredNorm() * (1 + 1e-13)) {
      --j;
      continue;
    }
    atoms_ = before.atoms_;
    photocurrent_ = before.photocurrent_;
    shunt_ = before.shunt_;
    y_ = before.y_;
  }
}

// One Newton step of the atoms' u, the linear unknowns following. False when nothing moves any
// more.
bool Solver::SlideOnce(double* damping) {
  const Eigen::MatrixXd a = Columns(atoms_);
  std::vector<int> linear;
  if (photocurrent_ > 0) linear.push_back(0);
  if (shunt_ > 0) linear.push_back(1);
  std::vector<int> moving;
  Eigen::VectorXd gradient(size());
  Eigen::MatrixXd slopes(vd_.size(), size());
  Eigen::VectorXd bends(size());
  for (int j = 0; j < size(); ++j) {
    linear.push_back(2 + j);
    const double u = atoms_[j].u;
    const double scale = 1 / -std::expm1(-u * scale_);
    const Eigen::ArrayXd e = scale * ((vd_.array() - scale_) * u).exp();
    slopes.col(j) = -(vd_.array() * e).matrix();
    bends[j] = -(vd_.array().square() * e * y_.array()).sum();
    gradient[j] = -atoms_[j].current_A * slopes.col(j).dot(y_);
    const Window* window = WindowOf(u);
    const bool pressed =
        (u <= window->lower && gradient[j] >= 0) || (u >= window->upper && gradient[j] <= 0);
    if (!pressed) moving.push_back(j);
  }
  if (moving.empty()) return false;
  const int m = static_cast<int>(moving.size());
  const int l = static_cast<int>(linear.size());
  Eigen::MatrixXd columns(a.rows(), l);
  for (int i = 0; i < l; ++i) columns.col(i) = a.col(linear[i]);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  Eigen::MatrixXd b(a.rows(), m);
  for (int i = 0; i < m; ++i) b.col(i) = atoms_[moving[i]].current_A * slopes.col(moving[i]);
  // Mixed block A'B - diag(slope . y), then reduced to the moving atoms.
  Eigen::MatrixXd mixed = columns.transpose() * b;
  for (int i = 0; i < m; ++i) {
    const int row =
        static_cast<int>(std::find(linear.begin(), linear.end(), 2 + moving[i]) - linear.begin());
    mixed(row, i) -= slopes.col(moving[i]).dot(y_);
  }
  const Eigen::MatrixXd r = qr.matrixQR().topRows(l);
  const Eigen::MatrixXd w = r.triangularView<Eigen::Upper>().transpose().solve(mixed);
  Eigen::MatrixXd hessian = b.transpose() * b - w.transpose() * w;
  Eigen::VectorXd g(m);
  for (int i = 0; i < m; ++i) {
    hessian(i, i) -= atoms_[moving[i]].current_A * bends[moving[i]];
    g[i] = gradient[moving[i]];
  }
  const double before = y_.squaredNorm();
  const std::vector<Atom> atoms_before = atoms_;
  const double photocurrent_before = photocurrent_;
  const double shunt_before = shunt_;
  const Eigen::VectorXd y_before = y_;
  for (int attempt = 0; attempt < 12; ++attempt) {
    Eigen::MatrixXd damped = hessian;
    for (int i = 0; i < m; ++i) damped(i, i) += *damping * b.col(i).squaredNorm();
    const Eigen::LLT<Eigen::MatrixXd> llt(damped);
    if (llt.info() == Eigen::Success) {
      const Eigen::VectorXd step = llt.solve(g);
      double largest = 0;
      for (int i = 0; i < m; ++i) {
        Atom& atom = atoms_[moving[i]];
        const Window* window = WindowOf(atom.u);
        const double u = std::min(std::max(atom.u - step[i], window->lower), window->upper);
        largest = std::max(largest, std::fabs(u - atom.u) * scale_);
        atom.u = u;
      }
      std::sort(atoms_.begin(), atoms_.end(),
                [](const Atom& p, const Atom& q) { return p.u < q.u; });
      for (int j = size() - 1; j > 0; --j) {
        if ((atoms_[j].u - atoms_[j - 1].u) * scale_ < kSameAtom) {
          atoms_.erase(atoms_.begin() + j);
        }
      }
      SolveLinear();
      const double after = y_.squaredNorm();
      if (after <= before * (1 + 1e-15)) {
        *damping = *damping > 1e-9 ? *damping * 0.1 : 0;
        return largest > 1e-13 && (after < before * (1 - 1e-15) || largest > 1e-9);
      }
      atoms_ = atoms_before;
      photocurrent_ = photocurrent_before;
      shunt_ = shunt_before;
      y_ = y_before;
    }
    *damping = std::max(*damping * 10, 1e-6);
  }
  return false;
}

// The residual with what rounding left of it along the active columns taken out, and along the
// derivatives of the columns that touch zero inside a window, so that the correlation has its
// maximum there.
Eigen::VectorXd Solver::CleanResidual() const {
  const Eigen::MatrixXd a = Columns(atoms_);
  std::vector<Eigen::VectorXd> active;
  if (photocurrent_ > 0) active.push_back(a.col(0));
  if (shunt_ > 0) active.push_back(a.col(1));
  for (int j = 0; j < size(); ++j) active.push_back(a.col(2 + j));
  if (active.empty()) return y_;
  const std::size_t plain = active.size();
  for (int j = 0; j < size(); ++j) {
    const Window* window = WindowOf(atoms_[j].u);
    if (atoms_[j].u <= window->lower || atoms_[j].u >= window->upper) continue;
    const Eigen::ArrayXd e = ((vd_.array() - scale_) * atoms_[j].u).exp();
    active.push_back((vd_.array() * e / vd_.cwiseAbs().maxCoeff()).matrix());
  }
  for (const std::size_t count : {active.size(), plain}) {
    Eigen::MatrixXd columns(vd_.size(), count);
    for (std::size_t i = 0; i < count; ++i) columns.col(i) = active[i];
    const auto qr = columns.colPivHouseholderQr();
    Eigen::VectorXd y = y_;
    for (int round = 0; round < 2; ++round) y -= columns * qr.solve(y);
    if ((y - y_).norm() <= 1e-5 * y_.norm() || count == plain) return y;
  }
  return y_;
}

Mixture Solver::Finish(const Eigen::VectorXd& y, double excess, double price_A) const {
  Mixture mixture;
  mixture.rs = rs_;
  mixture.scale_voltage_V = scale_;
  mixture.photocurrent_A = photocurrent_;
  const double reference = data_.reference_voltage_V;
  mixture.shunt_current_A = shunt_ * reference / scale_;
  mixture.atoms = atoms_;
  for (Atom& atom : mixture.atoms) {
    atom.current_A *= std::exp(-atom.u * (scale_ - reference)) * std::expm1(-atom.u * reference) /
                      std::expm1(-atom.u * scale_);
  }
  mixture.primal = 0.5 * y_.squaredNorm();
  mixture.y = y;
  mixture.dual = data_.current_A.dot(y) - 0.5 * y.squaredNorm();
  mixture.excess = std::max(excess, -vd_.dot(y) / scale_);
  mixture.photocurrent_excess = std::max(0.0, y.sum());
  const double lack =
      mixture.excess * price_A + mixture.photocurrent_excess * (photocurrent_ + price_A);
  mixture.relative_gap =
      (std::fabs(mixture.primal - mixture.dual) + lack) / std::max(mixture.primal, 1e-300);
  Eigen::ArrayXd slope = Eigen::ArrayXd::Constant(vd_.size(), -shunt_ / scale_);
  for (const Atom& atom : atoms_) {
    const double scale = atom.current_A / -std::expm1(-atom.u * scale_);
    slope -= scale * atom.u * ((vd_.array() - scale_) * atom.u).exp();
  }
  mixture.slope = -(slope * data_.current_A.array() * y_.array()).sum();
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
