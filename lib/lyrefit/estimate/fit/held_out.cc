#include "lyrefit/estimate/fit/held_out.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/parallel.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/estimate/refine/coarsen.h"
#include "lyrefit/estimate/refine/refine.h"
#include "lyrefit/estimate/refine/separable.h"
#include "lyrefit/model/current.h"

namespace lyrefit {
namespace {

constexpr int kMostBlocks = 10;
constexpr int kSmallestBlock = 2;

// Limits of one refit. Nearly equal diodes give flat local optima along which a solver progresses
// slowly without a visible change of the error.
constexpr double kTolerance = 1e-10;
constexpr int kMaxIterations = 100;

struct Split {
  IvCurve kept;
  IvCurve left_out;
};

Split MakeSplit(const IvCurve& curve, int block, int blocks) {
  const std::vector<int> order = OrderByVoltage(curve.voltage_V);
  const int points = static_cast<int>(order.size());
  const int begin = 1 + (points - 2) * block / blocks;
  const int end = 1 + (points - 2) * (block + 1) / blocks;
  Split split;
  for (int k = 0; k < points; ++k) {
    IvCurve& side = k >= begin && k < end ? split.left_out : split.kept;
    side.voltage_V.push_back(curve.voltage_V[order[k]]);
    side.current_A.push_back(curve.current_A[order[k]]);
    if (!curve.sigma_A.empty()) side.sigma_A.push_back(curve.sigma_A[order[k]]);
  }
  return split;
}

}  // namespace

double HeldOutRmse(const FitReport& report, const FitOptions& options,
                   const ProgressReporter& progress) {
  const int points = static_cast<int>(report.curve.size());
  const int blocks = std::min(kMostBlocks, (points - 2) / kSmallestBlock);
  if (blocks < 2) return kUnknown;
  const int largest_block = (points - 2 + blocks - 1) / blocks;
  if (points - largest_block < report.criteria.parameters) return kUnknown;
  std::vector<double> lower, upper;
  for (const Estimate& e : report.estimates) {
    lower.push_back(e.bounds.lower);
    upper.push_back(e.bounds.upper);
  }
  std::vector<double> squares(blocks);
  progress.BeginSilently("held out", blocks);
  ParallelFor(blocks, options.threads, [&](int block) {
    const Split split = MakeSplit(report.curve, block, blocks);
    std::vector<double> weights;
    for (const double sigma : split.kept.sigma_A) weights.push_back(1 / (sigma * sigma));
    const RefineProblem problem =
        Coarsen(MakeRefineProblem(report.device, report.objective, split.kept.voltage_V,
                                  split.kept.current_A, std::move(weights), lower, upper));
    RefineOptions how;
    how.function_tolerance = kTolerance;
    how.max_iterations = kMaxIterations;
    how.stop = progress.stop();
    if (progress.Step()) return;
    RefineEnd end = Refine(problem, SeparableDescent(problem, report.refined), how);
    for (const SeparableStart& start : SeparableStarts(problem, report.refined[kRs], 1)) {
      RefineEnd other = Refine(problem, SeparableDescent(problem, start.p), how);
      if (other.mean_square < end.mean_square) end = std::move(other);
    }
    const double rmse = Rmse(report.device, report.objective, end.p.data(),
                             split.left_out.voltage_V, split.left_out.current_A);
    squares[block] = rmse * rmse * static_cast<double>(split.left_out.size());
  });
  if (progress.stop().requested()) return kUnknown;
  double sum = 0;
  for (const double square : squares) sum += square;
  return std::sqrt(sum / (points - 2));
}

}  // namespace lyrefit
