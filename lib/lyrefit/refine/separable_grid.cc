#include <algorithm>
#include <cmath>
#include <cstdio>

#include "lyrefit/refine/bounded_linear.h"
#include "lyrefit/refine/linear_part.h"
#include "lyrefit/refine/separable.h"

namespace lyrefit {
namespace {

constexpr int kIdealities = 5;

// Even steps in 1/n between the bounds of a diode's n: 1, 1.14, 1.33, 1.6, 2 for [1, 2].
std::vector<double> IdealityGrid(double lower, double upper) {
  if (lower == upper) return {lower};
  std::vector<double> grid;
  const double low = std::max(lower, 0.1);
  for (int k = 0; k < kIdealities; ++k) {
    const double t = static_cast<double>(k) / (kIdealities - 1);
    grid.push_back(1 / ((1 - t) / low + t / upper));
  }
  return grid;
}

std::vector<double> SeriesResistanceGrid(const RefineProblem& problem, double hint) {
  const double lower = problem.lower[kRs];
  const double upper = problem.upper[kRs];
  if (lower == upper) return {lower};
  std::vector<double> grid = {0};
  for (double part = 0.5; part > 0.01; part /= 2) grid.push_back(part * problem.resistance_scale());
  for (const double part : {1.0, 0.5, 0.25}) {
    if (hint > 0) grid.push_back(part * hint);
  }
  for (double& rs : grid) rs = std::min(std::max(rs, lower), upper);
  std::sort(grid.begin(), grid.end());
  grid.erase(std::unique(grid.begin(), grid.end()), grid.end());
  return grid;
}

// All combinations of n at one Rs after the other; the Gram matrix of all columns is built once an
// Rs.
class Grid {
 public:
  Grid(const RefineProblem& problem, double rs_hint) : problem_(problem) {
    for (int d = 0; d < DiodeCount(problem.device); ++d) {
      const int n = IdealityIndex(d);
      for (const double value : IdealityGrid(problem.lower[n], problem.upper[n])) {
        if (std::find(idealities_.begin(), idealities_.end(), value) == idealities_.end()) {
          idealities_.push_back(value);
        }
      }
    }
    for (const double rs : SeriesResistanceGrid(problem, rs_hint)) {
      rs_ = rs;
      linear_ = MakeLinearColumns(problem, problem.weights, rs, idealities_);
      gram_ = linear_.columns.transpose() * linear_.columns;
      atb_ = linear_.columns.transpose() * linear_.target;
      Combine();
    }
  }

  std::vector<SeparableStart> Best(int count) {
    std::stable_sort(starts_.begin(), starts_.end(),
                     [](const auto& a, const auto& b) { return a.mean_square < b.mean_square; });
    std::vector<SeparableStart> best;
    for (const SeparableStart& start : starts_) {
      if (static_cast<int>(best.size()) == count) break;
      const bool seen = std::any_of(best.begin(), best.end(), [&](const SeparableStart& taken) {
        for (int d = 0; d < DiodeCount(problem_.device); ++d) {
          if (taken.p[IdealityIndex(d)] != start.p[IdealityIndex(d)]) return false;
        }
        return true;
      });
      if (seen) continue;
      best.push_back(start);
      best.back().origin = Origin(start.p);
    }
    return best;
  }

 private:
  // Rising combinations of the n of the grid that every diode's bounds allow.
  void Combine() {
    const int diode = static_cast<int>(chosen_.size());
    if (diode == DiodeCount(problem_.device)) {
      Solve();
      return;
    }
    const int n = IdealityIndex(diode);
    const int first = diode == 0 || !SameRange(diode) ? 0 : chosen_.back() + 1;
    for (int k = first; k < static_cast<int>(idealities_.size()); ++k) {
      if (idealities_[k] < problem_.lower[n] || idealities_[k] > problem_.upper[n]) continue;
      chosen_.push_back(k);
      Combine();
      chosen_.pop_back();
    }
  }

  bool SameRange(int diode) const {
    const int n = IdealityIndex(diode);
    const int previous = IdealityIndex(diode - 1);
    return !problem_.fixed(n) && problem_.lower[n] == problem_.lower[previous] &&
           problem_.upper[n] == problem_.upper[previous];
  }

  void Solve() {
    const int size = 2 + static_cast<int>(chosen_.size());
    std::vector<int> column = {0, 1};
    for (const int k : chosen_) column.push_back(2 + k);
    SmallMatrix gram(size, size);
    SmallVector atb(size), lower, upper;
    LinearPart part;
    part.scale.resize(size);
    std::vector<double> idealities;
    for (int a = 0; a < size; ++a) {
      atb[a] = atb_[column[a]];
      part.scale[a] = linear_.scale[column[a]];
      for (int b = 0; b < size; ++b) gram(a, b) = gram_(column[a], column[b]);
    }
    for (const int k : chosen_) idealities.push_back(idealities_[k]);
    LinearBounds(problem_, part.scale, &lower, &upper);
    part.x = SolveBoundedLinear(gram, atb, lower, upper);
    SeparableStart start;
    start.p = ToParameters(problem_, part, rs_, idealities);
    start.mean_square = MeanSquare(problem_, start.p);
    starts_.push_back(std::move(start));
  }

  std::string Origin(const std::vector<double>& p) const {
    char text[32];
    std::string origin = "grid n = ";
    for (int d = 0; d < DiodeCount(problem_.device); ++d) {
      std::snprintf(text, sizeof text, "%s%.3g", d > 0 ? ", " : "", p[IdealityIndex(d)]);
      origin += text;
    }
    std::snprintf(text, sizeof text, "; Rs = %.3g ohm", p[kRs]);
    return origin + text;
  }

  const RefineProblem& problem_;
  std::vector<double> idealities_;
  double rs_ = 0;
  LinearPart linear_;
  Eigen::MatrixXd gram_;
  Eigen::VectorXd atb_;
  std::vector<int> chosen_;
  std::vector<SeparableStart> starts_;
};

}  // namespace

std::vector<SeparableStart> SeparableStarts(const RefineProblem& problem, double rs_hint,
                                            int count) {
  if (problem.device.extension != nullptr) return {};
  return Grid(problem, rs_hint).Best(count);
}

}  // namespace lyrefit
