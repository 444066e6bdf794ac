#include "lyrefit/estimate/refine/coarsen.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/dense.h"
#include "lyrefit/base/groups.h"

namespace lyrefit {
namespace {

constexpr int kBins = 256;  // with equal numbers of points, for the path length of the curve
// Groups of equal length along the curve.
constexpr int kScatteredGroups = 64;  // of four points each, for the measured-current objective
constexpr int kSmoothGroups = 30;
constexpr int kNodes = 4;  // points of a smooth group

// Weight, mean and covariance of a group of points.
struct Moments {
  double weight = 0;
  double voltage = 0, current = 0;
  double vv = 0, vi = 0, ii = 0;
};

Moments FindMoments(const RefineProblem& problem, const std::vector<int>& order, int begin,
                    int end) {
  Moments m;
  for (int at = begin; at < end; ++at) {
    const int k = order[at];
    m.weight += problem.weights[k];
    m.voltage += problem.weights[k] * problem.voltage_V[k];
    m.current += problem.weights[k] * problem.current_A[k];
  }
  if (!(m.weight > 0)) return m;
  m.voltage /= m.weight;
  m.current /= m.weight;
  for (int at = begin; at < end; ++at) {
    const int k = order[at];
    const double part = problem.weights[k] / m.weight;
    const double v = problem.voltage_V[k] - m.voltage;
    const double i = problem.current_A[k] - m.current;
    m.vv += part * v * v;
    m.vi += part * v * i;
    m.ii += part * i * i;
  }
  return m;
}

// Groups of the points in `order`. Noise would lengthen a path from point to point, so the length
// is that of the path through the means of the bins.
Grouping CutIntoGroups(const RefineProblem& problem, const std::vector<int>& order, int groups) {
  const Grouping bins = EqualGroups(static_cast<int>(order.size()), kBins);
  std::vector<double> length(kBins, 0);
  Moments last = FindMoments(problem, order, bins[0], bins[1]);
  for (int bin = 1; bin < kBins; ++bin) {
    const Moments here = FindMoments(problem, order, bins[bin], bins[bin + 1]);
    length[bin] = length[bin - 1] +
                  std::fabs(here.voltage - last.voltage) / problem.voltage_scale_V +
                  std::fabs(here.current - last.current) / problem.current_scale_A;
    last = here;
  }
  GroupRule rule;
  for (const double way : length) {
    rule.place.push_back(std::floor(groups * way / (length.back() * (1 + 1e-12))));
  }
  Grouping first;
  for (const int bin : GroupByRule(kBins, rule)) first.push_back(bins[bin]);
  return first;
}

struct Points {
  std::vector<double> voltage_V, current_A, weights;
  void Add(double voltage, double current, double weight) {
    voltage_V.push_back(voltage);
    current_A.push_back(current);
    weights.push_back(weight);
  }
};

// Four points with the weight, the mean and the covariance of voltage and current of a group.
void AddScattered(const Moments& m, Points* points) {
  const double spread = std::sqrt(m.vv);
  const double slope = m.vv > 0 ? m.vi / m.vv : 0;
  const double scatter = std::sqrt(std::max(m.ii - slope * m.vi, 0.0));  // around the line
  for (const double side : {-1.0, 1.0}) {
    for (const double sign : {-1.0, 1.0}) {
      points->Add(m.voltage + side * spread, m.current + side * slope * spread + sign * scatter,
                  m.weight / 4);
    }
  }
}

// The Gauss quadrature of a group: nodes and weights whose sums equal those of the group's points
// for every polynomial of degree 2 kNodes - 1 (Golub and Welsch; the recurrence by Lanczos' process
// on the points themselves). The currents at the nodes are those of the closest polynomial of
// degree kNodes - 1. If the model current is such a polynomial within the group, the sum of squared
// residuals is kept up to a constant. Returns this constant: the weighted sum of squares of the
// currents around the polynomial.
double AddSmooth(const RefineProblem& problem, const Moments& m, const std::vector<int>& order,
                 int begin, int end, Points* points) {
  const int count = end - begin;
  Eigen::VectorXd root(count), x(count), rest(count);
  for (int k = 0; k < count; ++k) {
    const int point = order[begin + k];
    root[k] = std::sqrt(problem.weights[point]);
    x[k] = problem.voltage_V[point] - m.voltage;
    rest[k] = root[k] * problem.current_A[point];
  }
  const double reach = std::max(x.cwiseAbs().maxCoeff(), 1e-300);
  x /= reach;
  constexpr double kSamePlace = 1e-9;  // reach; nodes closer than this are not separated
  const int most = std::min(kNodes, count);
  Eigen::MatrixXd basis(count, most);
  Eigen::MatrixXd recurrence = Eigen::MatrixXd::Zero(most, most);
  Eigen::VectorXd along(most);  // components of the currents along the basis polynomials
  Eigen::VectorXd next = root;
  int nodes = 0;
  while (nodes < most) {
    const double length = next.norm();
    if (nodes > 0 && !(length > kSamePlace)) break;
    if (nodes > 0) recurrence(nodes, nodes - 1) = recurrence(nodes - 1, nodes) = length;
    basis.col(nodes) = next / length;
    along[nodes] = basis.col(nodes).dot(rest);
    rest -= along[nodes] * basis.col(nodes);
    next = x.cwiseProduct(basis.col(nodes));
    recurrence(nodes, nodes) = basis.col(nodes).dot(next);
    ++nodes;
    for (int again = 0; again < 2; ++again) {
      next -= basis.leftCols(nodes) * (basis.leftCols(nodes).transpose() * next).eval();
    }
  }
  // The nodes are the eigenvalues of the recurrence. They lie within [-1, 1], so those of the
  // shifted matrix are its singular values.
  constexpr double kShift = 2;
  recurrence.diagonal().array() += kShift;
  const RightSingular found = FindRightSingular(recurrence.topLeftCorner(nodes, nodes));
  for (int k = nodes - 1; k >= 0; --k) {
    const auto vector = found.vectors.col(k);
    const double current = vector.dot(along.head(nodes)) / (vector[0] * std::sqrt(m.weight));
    points->Add(m.voltage + reach * (found.values[k] - kShift), current,
                m.weight * vector[0] * vector[0]);
  }
  return rest.squaredNorm();
}

// Splits the heaviest point of the first group, where no diode conducts yet, into two points of
// half the weight. Their distance in current adds `squares` to the sum of squares.
void AddConstant(double squares, Points* points) {
  const auto first = points->weights.begin();
  const std::ptrdiff_t most = std::min<std::ptrdiff_t>(kNodes, points->weights.end() - first);
  const std::ptrdiff_t k = std::max_element(first, first + most) - first;
  const double off = std::sqrt(squares / points->weights[k]);
  const double current = points->current_A[k];
  points->weights[k] /= 2;
  points->current_A[k] = current + off;
  points->Add(points->voltage_V[k], current - off, points->weights[k]);
}

}  // namespace

// Effects act on single readings, and correlated errors on neighbours, so neither allows
// coarsening.
bool CanCoarsen(const RefineProblem& problem) {
  return problem.voltage_V.size() > kFewPoints && problem.device.effects == nullptr &&
         problem.errors == nullptr;
}

RefineProblem WithPoints(const RefineProblem& problem, std::vector<double> voltage_V,
                         std::vector<double> current_A, std::vector<double> weights) {
  RefineProblem other =
      MakeRefineProblem(problem.device, problem.objective, std::move(voltage_V),
                        std::move(current_A), std::move(weights), problem.lower, problem.upper);
  other.kernel = problem.kernel;
  other.current_scale_A = problem.current_scale_A;
  other.voltage_scale_V = problem.voltage_scale_V;
  return other;
}

RefineProblem Coarsen(const RefineProblem& problem) {
  if (!CanCoarsen(problem)) return problem;
  const bool smooth = problem.objective == Objective::kSolvedCurrent;
  const std::vector<int> order = RisingOrder(problem.voltage_V);
  const Grouping first = CutIntoGroups(problem, order, smooth ? kSmoothGroups : kScatteredGroups);
  Points points;
  double squares = 0;
  for (int g = 0; g < GroupCount(first); ++g) {
    const Moments m = FindMoments(problem, order, first[g], first[g + 1]);
    if (!(m.weight > 0)) continue;
    if (smooth) squares += AddSmooth(problem, m, order, first[g], first[g + 1], &points);
    if (!smooth) AddScattered(m, &points);
  }
  if (smooth) AddConstant(squares, &points);
  return WithPoints(problem, std::move(points.voltage_V), std::move(points.current_A),
                    std::move(points.weights));
}

}  // namespace lyrefit
