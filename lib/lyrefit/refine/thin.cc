#include "lyrefit/refine/thin.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace lyrefit {
namespace {

constexpr int kBins = 256;   // of equally many points: what the shape of the curve is read from
constexpr int kGroups = 64;  // of equal length along the curve

// Weight, mean and covariance of a group of points.
struct Moments {
  double weight = 0;
  double voltage = 0, current = 0;
  double vv = 0, vi = 0, ii = 0;
};

using Iterator = std::vector<int>::const_iterator;

Moments FindMoments(const RefineProblem& problem, Iterator begin, Iterator end) {
  Moments m;
  for (Iterator k = begin; k != end; ++k) {
    m.weight += problem.weights[*k];
    m.voltage += problem.weights[*k] * problem.voltage_V[*k];
    m.current += problem.weights[*k] * problem.current_A[*k];
  }
  if (!(m.weight > 0)) return m;
  m.voltage /= m.weight;
  m.current /= m.weight;
  for (Iterator k = begin; k != end; ++k) {
    const double part = problem.weights[*k] / m.weight;
    const double v = problem.voltage_V[*k] - m.voltage;
    const double i = problem.current_A[*k] - m.current;
    m.vv += part * v * v;
    m.vi += part * v * i;
    m.ii += part * i * i;
  }
  return m;
}

std::vector<int> VoltageOrder(const std::vector<double>& voltage_V) {
  std::vector<int> order(voltage_V.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return voltage_V[a] < voltage_V[b]; });
  return order;
}

// Where the groups begin in `order`, and its end. Noise would lengthen a path from point to point,
// so the length is that of the path through the means of the bins.
std::vector<Iterator> CutIntoGroups(const RefineProblem& problem, const std::vector<int>& order) {
  const auto bin_begin = [&](int bin) {
    return order.begin() + static_cast<std::ptrdiff_t>(order.size()) * bin / kBins;
  };
  std::vector<double> length(kBins, 0);
  Moments last = FindMoments(problem, bin_begin(0), bin_begin(1));
  for (int bin = 1; bin < kBins; ++bin) {
    const Moments here = FindMoments(problem, bin_begin(bin), bin_begin(bin + 1));
    length[bin] = length[bin - 1] +
                  std::fabs(here.voltage - last.voltage) / problem.voltage_scale_V +
                  std::fabs(here.current - last.current) / problem.current_scale_A;
    last = here;
  }
  std::vector<Iterator> begins = {order.begin()};
  int group = 0;
  for (int bin = 1; bin < kBins; ++bin) {
    const int own = static_cast<int>(kGroups * length[bin] / (length.back() * (1 + 1e-12)));
    if (own <= group) continue;
    group = own;
    begins.push_back(bin_begin(bin));
  }
  begins.push_back(order.end());
  return begins;
}

}  // namespace

RefineProblem Thin(const RefineProblem& problem) {
  if (problem.voltage_V.size() <= kFewPoints) return problem;
  const std::vector<int> order = VoltageOrder(problem.voltage_V);
  const std::vector<Iterator> begins = CutIntoGroups(problem, order);
  std::vector<double> voltage, current, weights;
  for (std::size_t g = 0; g + 1 < begins.size(); ++g) {
    const Moments m = FindMoments(problem, begins[g], begins[g + 1]);
    if (!(m.weight > 0)) continue;
    const double spread = std::sqrt(m.vv);
    const double slope = m.vv > 0 ? m.vi / m.vv : 0;
    const double scatter = std::sqrt(std::max(m.ii - slope * m.vi, 0.0));  // around the line
    for (const double side : {-1.0, 1.0}) {
      for (const double sign : {-1.0, 1.0}) {
        voltage.push_back(m.voltage + side * spread);
        current.push_back(m.current + side * slope * spread + sign * scatter);
        weights.push_back(m.weight / 4);
      }
    }
  }
  RefineProblem thin =
      MakeRefineProblem(problem.device, problem.objective, std::move(voltage), std::move(current),
                        std::move(weights), problem.lower, problem.upper);
  thin.kernel = problem.kernel;
  thin.current_scale_A = problem.current_scale_A;
  thin.voltage_scale_V = problem.voltage_scale_V;
  return thin;
}

}  // namespace lyrefit
