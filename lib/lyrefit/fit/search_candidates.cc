#include "lyrefit/fit/search_candidates.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "lyrefit/fit/probe_starts.h"
#include "lyrefit/refine/curve_model.h"
#include "lyrefit/refine/linear_part.h"
#include "lyrefit/refine/solve.h"

namespace lyrefit {
namespace {

constexpr double kStill = 1e-6;  // relative change of the sum of squares
constexpr int kMostSteps = 30;

class CountedCurve : public CurveModel {
 public:
  CountedCurve(const RefineProblem& problem, std::int64_t* evaluations)
      : CurveModel(problem, GiveUp::kAbsurd), evaluations_(evaluations) {}

  bool Evaluate(int block, const double* p, const double* local, double* residuals, double* slopes,
                double* local_slopes) const override {
    ++*evaluations_;
    return CurveModel::Evaluate(block, p, local, residuals, slopes, local_slopes);
  }
  double MeanSquare(const FitPoint& point) const override {
    ++*evaluations_;
    return CurveModel::MeanSquare(point);
  }

 private:
  std::int64_t* evaluations_;
};

std::vector<int> EasyParameters(const Device& device) {
  std::vector<int> easy = {kIph, kRsh};
  for (int d = 0; d < DiodeCount(device); ++d) easy.push_back(SaturationCurrentIndex(d));
  return easy;
}

SearchSpace SpaceOf(const FitJob& job, std::vector<double> fixed) {
  if (job.variants.empty()) return {job.bounds, fixed};
  fixed.resize(job.base_size());
  return {{job.bounds.begin(), job.bounds.begin() + job.base_size()},
          fixed,
          *job.problem.device.effects,
          job.variants};
}

// Search space without the parameters that are solved for; their fixed value is never read.
SearchSpace SpaceOfCandidates(const FitJob& job) {
  std::vector<double> fixed = job.fixed;
  if (job.options.candidates == SearchVariables::kHard) {
    for (const int i : EasyParameters(job.problem.device)) fixed[i] = 0;
  }
  return SpaceOf(job, std::move(fixed));
}

}  // namespace

SearchSpace CompleteSpace(const FitJob& job) { return SpaceOf(job, job.fixed); }

SearchCandidates::SearchCandidates(const FitJob& job, const RefineProblem& problem)
    : problem_(problem),
      hard_(job.options.candidates == SearchVariables::kHard),
      space_(SpaceOfCandidates(job)),
      box_(space_.box()),
      effects_(job.effects()),
      p_(problem.device.size()) {
  if (hard_) {
    easy_ = problem;
    easy_.lower.assign(p_.size(), 0);
    easy_.upper.assign(p_.size(), 0);
    for (const int i : EasyParameters(problem.device)) {
      easy_.lower[i] = problem.lower[i];
      easy_.upper[i] = problem.upper[i];
    }
  }
}

void SearchCandidates::Suggest(const std::vector<PolishStart>& starts) {
  struct Place {
    const PolishStart* start;
    double mean_square;
    int rank;  // within its variant
  };
  std::vector<Place> places;
  for (const PolishStart& start : starts) {
    places.push_back({&start, MeanSquare(problem_, start.p), 0});
    ++evaluations_;
    if (!std::isfinite(places.back().mean_square)) places.pop_back();
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.mean_square < b.mean_square; });
  std::map<int, int> of_variant;
  for (Place& place : places) place.rank = of_variant[place.start->variant]++;
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.rank < b.rank; });
  for (const Place& place : places) {
    box_.suggested.push_back(space_.FromParameters(place.start->p.data(), place.start->variant));
  }
}

Expected<void> SearchCandidates::Check() const {
  if (!box_.lower.empty()) return {};
  return Fail("candidates hard leaves nothing to search: Rs and every n are fixed");
}

std::vector<double> SearchCandidates::DeviceAt(const double* x) {
  space_.ToParameters(x, p_.data());
  if (hard_) SolveEasy();
  return p_;
}

double SearchCandidates::RmseAt(const double* x) {
  space_.ToParameters(x, p_.data());
  if (hard_) return std::sqrt(SolveEasy());
  ++evaluations_;
  return std::sqrt(MeanSquare(problem_, p_));
}

// Mean square with the best values of the easy parameters (Iph, Is, Rsh) at the other parameters of
// `p_`.
double SearchCandidates::SolveEasy() {
  std::vector<double> idealities;
  idealities.reserve(DiodeCount(problem_.device));
  for (int d = 0; d < DiodeCount(problem_.device); ++d) {
    idealities.push_back(p_[IdealityIndex(d)]);
  }
  const double rs = p_[kRs];
  const std::size_t base = p_.size() - static_cast<std::size_t>(effects_);
  const bool measured = problem_.objective == Objective::kMeasuredCurrent;
  std::vector<double> typical;
  if (!measured) {
    const std::vector<double> place(p_.begin() + static_cast<std::ptrdiff_t>(base), p_.end());
    typical = TypicalDevice(problem_, place, idealities);
    typical[kRs] = rs;
  }
  if (effects_ > 0) {
    p_ = std::move(typical);
    return Descend();
  }
  ++evaluations_;
  p_ = ToParameters(problem_, SolveLinearPart(problem_, problem_.weights, rs, idealities), rs,
                    idealities);
  ++evaluations_;
  const double linear = MeanSquare(problem_, p_);
  if (measured) return linear;
  ++evaluations_;
  if (!(linear < MeanSquare(problem_, typical))) {
    p_ = std::move(typical);
  } else {  // the logarithm of Is has no gradient at 0
    for (int d = 0; d < DiodeCount(problem_.device); ++d) {
      const int is = SaturationCurrentIndex(d);
      if (!(p_[is] > 0)) p_[is] = typical[is];
    }
  }
  return Descend();
}

// Descends from `p_` in the easy parameters and returns the mean square.
double SearchCandidates::Descend() {
  const CountedCurve curve(easy_, &evaluations_);
  std::vector<bool> held;
  for (std::size_t i = 0; i < p_.size(); ++i) {
    held.push_back(easy_.lower[i] == easy_.upper[i] || !(p_[i] > 0));
  }
  const Coordinates coordinates(curve.shape(), p_, held);
  SolveOptions how;
  how.bounded = how.small = true;
  how.max_iterations = kMostSteps;
  how.function_tolerance = kStill;
  how.trust_radius = 1e4;
  how.unit_A = problem_.current_scale_A;
  if (coordinates.size() > 0) {
    const SolveEnd end = SolveModel(curve, coordinates, {}, how);
    coordinates.ToParameters(end.theta.data(), p_.data());
  }
  for (const int i : EasyParameters(problem_.device)) {  // removes rounding
    p_[i] = std::min(std::max(p_[i], problem_.lower[i]), problem_.upper[i]);
  }
  return curve.MeanSquare({p_, {}});
}

}  // namespace lyrefit
