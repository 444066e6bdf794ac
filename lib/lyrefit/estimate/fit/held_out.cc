#include "lyrefit/estimate/fit/held_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/parallel.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/estimate/refine/coarsen.h"
#include "lyrefit/estimate/refine/refine.h"
#include "lyrefit/estimate/refine/separable.h"
#include "lyrefit/model/model_points.h"

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

namespace {

constexpr double kLevel = 0.05;

std::string Capital(Model model) {
  return model == Model::kSingleDiode ? "SD" : model == Model::kDoubleDiode ? "DD" : "TD";
}

// Reasons why the data do not support `rich` over `simple`; empty if they do.
std::string Objection(const CandidateReport& simple, const CandidateReport& rich) {
  std::vector<std::string> reasons;
  if (!(rich.aicc < simple.aicc)) {
    reasons.push_back(std::isnan(rich.aicc) || std::isnan(simple.aicc)
                          ? "too few points for AICc"
                          : fmt::format("AICc rises by {:.1f}", rich.aicc - simple.aicc));
  }
  if (!(rich.f_p_value < kLevel)) {
    reasons.push_back(std::isnan(rich.f_p_value)
                          ? "no degrees of freedom for the F-test"
                          : fmt::format("F-test p = {:.2g}", rich.f_p_value));
  }
  if (!rich.identifiable) reasons.push_back("the added diode may be absent");
  if (!(rich.held_out_rmse_A < simple.held_out_rmse_A)) {
    reasons.push_back(fmt::format("held-out RMSE does not fall ({:.3g} to {:.3g} A)",
                                  simple.held_out_rmse_A, rich.held_out_rmse_A));
  }
  return fmt::format("{}", fmt::join(reasons, ", "));
}

// Whether every diode is needed. The best fit with one diode less must be outside the 95 % limit
// that also bounds the profile of a saturation current.
bool DiodesIdentifiable(double simple_rmse, double rich_rmse, int degrees_of_freedom) {
  if (degrees_of_freedom < 1) return false;
  const double t = StudentT95(degrees_of_freedom);
  const double ratio = simple_rmse / rich_rmse;
  return (ratio * ratio - 1) * degrees_of_freedom > t * t;
}

CandidateReport Judge(const FitReport& report, const FitOptions& options, const FitReport* simpler,
                      const ProgressReporter& progress) {
  CandidateReport candidate;
  candidate.model = report.model;
  candidate.rmse_A = report.rmse.refined.Of(report.objective);
  candidate.aicc = report.criteria.aicc;
  candidate.held_out_rmse_A = HeldOutRmse(report, options, progress);
  if (simpler != nullptr) {
    const double simple = simpler->rmse.refined.Of(report.objective);
    const int extra = report.criteria.parameters - simpler->criteria.parameters;
    const int degrees = report.criteria.points - report.criteria.parameters;
    candidate.f_p_value = FTestPValue(simple * simple, candidate.rmse_A * candidate.rmse_A,
                                      std::max(extra, 1), degrees);
    candidate.identifiable = DiodesIdentifiable(simple, candidate.rmse_A, degrees);
  }
  return candidate;
}

// The options without those for diodes that the model lacks.
FitOptions ForModel(FitOptions options, Model model, const IvCurve& curve) {
  options.model = model;
  const Device device = MakeDevice(model, curve.conditions);
  const Device largest = MakeDevice(Model::kTripleDiode, curve.conditions);
  const auto lacks = [&](const std::string& key) {
    return largest.Find(key).has_value() && !device.Find(key).has_value();
  };
  for (auto it = options.fixed.begin(); it != options.fixed.end();) {
    it = lacks(it->first) ? options.fixed.erase(it) : std::next(it);
  }
  auto& overrides = options.bounds.overrides;
  for (auto it = overrides.begin(); it != overrides.end();) {
    it = lacks(it->first) ? overrides.erase(it) : std::next(it);
  }
  return options;
}

}  // namespace

Expected<FitReport> FitAuto(const IvCurve& curve, const FitOptions& options,
                            const Observer& observer) {
  std::vector<FitReport> fits;
  ModelChoice choice;
  std::string sentence;
  const ProgressReporter progress(observer, 0);
  for (const Model model : {Model::kSingleDiode, Model::kDoubleDiode, Model::kTripleDiode}) {
    FitOptions own = ForModel(options, model, curve);
    own.polish = true;
    own.intervals = Intervals::kNone;  // only the chosen model needs them
    own.errors = {};
    auto fit = Fit(curve, own, observer);
    if (!fit && fits.empty()) return fit;
    if (!fit) {
      sentence += fmt::format(" {} was not tried: {}.", Capital(model), fit.error().message);
      break;
    }
    fits.push_back(std::move(*fit));
    const bool first = fits.size() == 1;
    choice.candidates.push_back(
        Judge(fits.back(), own, first ? nullptr : &fits[fits.size() - 2], progress));
    if (fits.back().interrupted || progress.stop().requested()) {
      sentence += " The comparison was interrupted.";
      break;
    }
  }
  std::size_t chosen = 0;
  for (std::size_t k = 1; k < choice.candidates.size(); ++k) {
    const CandidateReport& rich = choice.candidates[k];
    const std::string objection = Objection(choice.candidates[chosen], rich);
    if (objection.empty() && chosen + 1 == k) {
      chosen = k;
      sentence += fmt::format(
          " {} earns its extra diode: AICc falls by {:.1f}, F-test p = {:.2g}, held-out RMSE falls "
          "from {:.3g} to {:.3g} A.",
          Capital(rich.model), choice.candidates[k - 1].aicc - rich.aicc, rich.f_p_value,
          choice.candidates[k - 1].held_out_rmse_A, rich.held_out_rmse_A);
    } else {
      sentence += fmt::format(" {} is not supported: {}.", Capital(rich.model),
                              objection.empty() ? "the model before it is not" : objection);
    }
  }
  choice.chosen = choice.candidates[chosen].model;
  choice.sentence = fmt::format("The data support {}.", Capital(choice.chosen)) + sentence;
  const bool interrupted = fits.back().interrupted || progress.stop().requested();
  FitOptions final_options = ForModel(options, choice.chosen, curve);
  final_options.polish = true;
  auto final_fit = interrupted ? Expected<FitReport>(std::move(fits[chosen]))
                               : Fit(curve, final_options, observer);
  if (!final_fit) return final_fit;
  FitReport report = std::move(*final_fit);
  report.interrupted = report.interrupted || interrupted;
  report.choice = std::move(choice);
  return report;
}

}  // namespace lyrefit
