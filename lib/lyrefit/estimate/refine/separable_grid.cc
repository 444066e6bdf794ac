#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "lyrefit/estimate/refine/bounded_linear.h"
#include "lyrefit/estimate/refine/linear_part.h"
#include "lyrefit/estimate/refine/separable.h"

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

// The n of all diodes' grids.
std::vector<double> Idealities(const RefineProblem& problem) {
  std::vector<double> idealities;
  for (int d = 0; d < DiodeCount(problem.device); ++d) {
    const int n = IdealityIndex(d);
    for (const double value : IdealityGrid(problem.lower[n], problem.upper[n])) {
      if (std::find(idealities.begin(), idealities.end(), value) == idealities.end()) {
        idealities.push_back(value);
      }
    }
  }
  return idealities;
}

// The columns of all n at one Rs; every combination of n uses their Gram matrix.
struct GridColumns {
  double rs;
  LinearPart linear;
  Eigen::MatrixXd gram;
  Eigen::VectorXd atb;
};

GridColumns ColumnsAt(const RefineProblem& problem, const std::vector<double>& idealities,
                      double rs) {
  GridColumns at;
  at.rs = rs;
  at.linear = MakeLinearColumns(problem, problem.weights, rs, idealities);
  at.gram = at.linear.columns.transpose() * at.linear.columns;
  at.atb = at.linear.columns.transpose() * at.linear.target;
  return at;
}

// The least-squares solution of the linear unknowns for the `chosen` n.
SeparableStart SolveFor(const RefineProblem& problem, const std::vector<double>& idealities,
                        const GridColumns& at, const std::vector<int>& chosen) {
  const int size = 2 + static_cast<int>(chosen.size());
  std::vector<int> column = {0, 1};
  for (const int k : chosen) column.push_back(2 + k);
  SmallMatrix gram(size, size);
  SmallVector atb(size), lower, upper;
  LinearPart part;
  part.scale.resize(size);
  std::vector<double> n;
  n.reserve(chosen.size());
  for (int a = 0; a < size; ++a) {
    atb[a] = at.atb[column[a]];
    part.scale[a] = at.linear.scale[column[a]];
    for (int b = 0; b < size; ++b) gram(a, b) = at.gram(column[a], column[b]);
  }
  for (const int k : chosen) n.push_back(idealities[k]);
  LinearBounds(problem, part.scale, &lower, &upper);
  part.x = SolveBoundedLinear(gram, atb, lower, upper);
  SeparableStart start;
  start.p = ToParameters(problem, part, at.rs, n);
  start.mean_square = MeanSquare(problem, start.p);
  return start;
}

bool HasRangeOfTheLast(const RefineProblem& problem, int diode) {
  const int n = IdealityIndex(diode);
  const int previous = IdealityIndex(diode - 1);
  return !problem.fixed(n) && problem.lower[n] == problem.lower[previous] &&
         problem.upper[n] == problem.upper[previous];
}

// Ascending combinations of those n of the grid that every diode's bounds allow.
void Combine(const RefineProblem& problem, const std::vector<double>& idealities,
             const GridColumns& at, std::vector<int>* chosen, std::vector<SeparableStart>* starts) {
  const int diode = static_cast<int>(chosen->size());
  if (diode == DiodeCount(problem.device)) {
    starts->push_back(SolveFor(problem, idealities, at, *chosen));
    return;
  }
  const int n = IdealityIndex(diode);
  const bool rising = diode > 0 && HasRangeOfTheLast(problem, diode);
  for (int k = rising ? chosen->back() + 1 : 0; k < static_cast<int>(idealities.size()); ++k) {
    if (idealities[k] < problem.lower[n] || idealities[k] > problem.upper[n]) continue;
    chosen->push_back(k);
    Combine(problem, idealities, at, chosen, starts);
    chosen->pop_back();
  }
}

std::string Origin(int diodes, const std::vector<double>& p) {
  char text[32];
  std::string origin = "grid n = ";
  for (int d = 0; d < diodes; ++d) {
    std::snprintf(text, sizeof text, "%s%.3g", d > 0 ? ", " : "", p[IdealityIndex(d)]);
    origin += text;
  }
  std::snprintf(text, sizeof text, "; Rs = %.3g ohm", p[kRs]);
  return origin + text;
}

// The starts of the lowest mean square, each with a different set of n.
std::vector<SeparableStart> Best(std::vector<SeparableStart> starts, int diodes, int count) {
  std::stable_sort(starts.begin(), starts.end(),
                   [](const auto& a, const auto& b) { return a.mean_square < b.mean_square; });
  std::vector<SeparableStart> best;
  for (const SeparableStart& start : starts) {
    if (static_cast<int>(best.size()) == count) break;
    const bool seen = std::any_of(best.begin(), best.end(), [&](const SeparableStart& taken) {
      for (int d = 0; d < diodes; ++d) {
        if (taken.p[IdealityIndex(d)] != start.p[IdealityIndex(d)]) return false;
      }
      return true;
    });
    if (seen) continue;
    best.push_back(start);
    best.back().origin = Origin(diodes, start.p);
  }
  return best;
}

}  // namespace

// Tries all combinations of n at each Rs.
std::vector<SeparableStart> SeparableStarts(const RefineProblem& problem, double rs_hint,
                                            int count) {
  if (problem.device.effects != nullptr) return {};
  const std::vector<double> idealities = Idealities(problem);
  std::vector<SeparableStart> starts;
  for (const double rs : SeriesResistanceGrid(problem, rs_hint)) {
    const GridColumns columns = ColumnsAt(problem, idealities, rs);
    std::vector<int> chosen;
    Combine(problem, idealities, columns, &chosen, &starts);
  }
  return Best(std::move(starts), DiodeCount(problem.device), count);
}

}  // namespace lyrefit
