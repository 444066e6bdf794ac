#include "lyrefit/fit/quoted_model.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "lyrefit/law/quote.h"

namespace lyrefit {
namespace {

ModelShape QuotedShape(const RefineProblem& problem, ModelShape shape) {
  const Extension& extension = *problem.device.extension;
  for (std::size_t e = 0; e < extension.uses.size(); ++e) {
    const int first = extension.law.Offset(static_cast<int>(e));
    const std::vector<ParameterRange> ranges =
        ReportedRanges(*extension.uses[e].effect, extension.readings.scale,
                       problem.lower.data() + first, problem.upper.data() + first);
    for (std::size_t k = 0; k < ranges.size(); ++k) {
      FitParameter& parameter = shape.parameters[first + k];
      parameter.lower = ranges[k].low;
      parameter.upper = ranges[k].high;
      parameter.step = parameter.fixed() ? 1 : 0.1 * (parameter.upper - parameter.lower);
    }
  }
  return shape;
}

}  // namespace

QuotedModel::QuotedModel(const RefineProblem& problem)
    : FitModel(QuotedShape(problem, CurveModel(problem).shape())),
      problem_(problem),
      own_(problem) {}

bool QuotedModel::Evaluate(int block, const double* p, const double* local, double* residuals,
                           double* slopes, double* local_slopes) const {
  const int count = problem_.device.size();
  const std::vector<double> own = Inner(problem_.device, std::vector<double>(p, p + count));
  if (!own_.Evaluate(block, own.data(), local, residuals, slopes, local_slopes)) return false;
  if (slopes == nullptr) return true;
  const Extension& extension = *problem_.device.extension;
  for (std::size_t e = 0; e < extension.uses.size(); ++e) {
    const int first = extension.law.Offset(static_cast<int>(e));
    const int size = extension.uses[e].effect->size();
    const Eigen::MatrixXd chain =
        OwnByReported(*extension.uses[e].effect, extension.readings.scale, own.data() + first);
    for (std::size_t r = 0; r < problem_.voltage_V.size(); ++r) {
      Eigen::Map<Eigen::RowVectorXd> row(slopes + r * count + first, size);
      row = (row * chain).eval();
    }
  }
  return true;
}

double QuotedModel::MeanSquare(const FitPoint& point) const {
  return lyrefit::MeanSquare(problem_, Inner(problem_.device, point.p));
}

namespace {

// Parameters of an effect that do not descend, and the values its probes give them.
struct Settings {
  std::vector<int> parameters;
  std::set<std::vector<double>> values;
};

// Of all effects but the one that parameter i is such a parameter of.
std::vector<Settings> FindSettings(const RefineProblem& problem, int i) {
  const Extension& extension = *problem.device.extension;
  std::vector<Settings> all;
  for (std::size_t e = 0; e < extension.uses.size(); ++e) {
    const Effect& effect = *extension.uses[e].effect;
    const int first = extension.law.Offset(static_cast<int>(e));
    Settings settings;
    for (int k = 0; k < effect.size(); ++k) {
      if (!effect.parameters[k].searched || problem.fixed(first + k)) continue;
      settings.parameters.push_back(first + k);
    }
    const std::vector<int>& own = settings.parameters;
    if (own.empty() || effect.probes == nullptr) continue;
    if (std::find(own.begin(), own.end(), i) != own.end()) continue;
    for (const Probe& probe : effect.probes(extension.readings.traits)) {
      std::vector<double> values;
      values.reserve(own.size());
      for (const int k : own) {
        values.push_back(std::min(std::max(probe[k - first], problem.lower[k]), problem.upper[k]));
      }
      settings.values.insert(std::move(values));
    }
    all.push_back(std::move(settings));
  }
  return all;
}

// The refits of one parameter's profile, in the units of reports.
class QuotedRefits {
 public:
  QuotedRefits(const RefineProblem& problem, int i, std::function<bool()> stop)
      : problem_(problem), i_(i), held_(problem), settings_(FindSettings(problem, i)) {
    how_.small = true;
    how_.let_in = false;
    how_.max_rounds = 10;
    how_.max_iterations = how_.first_iterations = 200;
    how_.stop = std::move(stop);
  }

  RefineEnd Refit(double value, FitPoint start, double enough, double tolerance) {
    held_.Fix(i_, value);
    start.p[i_] = value;
    how_.enough = enough;
    how_.function_tolerance = how_.first_tolerance = tolerance;
    RefineEnd end = RefineModel(held_, start, how_);
    for (const Settings& settings : settings_) TryOthers(settings, &end);
    return end;
  }

 private:
  // What descends does not find its way from one setting to a better one.
  void TryOthers(const Settings& settings, RefineEnd* end) {
    constexpr int kMost = 3;
    for (int times = 0; times < kMost && end->mean_square > how_.enough; ++times) {
      FitPoint lowest = *end;
      double least = end->mean_square * (1 - 1e-9);
      for (const std::vector<double>& values : settings.values) {
        FitPoint other = *end;
        std::vector<double> own = Inner(problem_.device, end->p);
        for (std::size_t k = 0; k < values.size(); ++k) own[settings.parameters[k]] = values[k];
        other.p = Reported(problem_.device, std::move(own));
        other.p[i_] = end->p[i_];
        const double mean_square = held_.MeanSquare(other);
        if (!(mean_square < least)) continue;
        least = mean_square;
        lowest = std::move(other);
      }
      if (!(least < end->mean_square * (1 - 1e-9))) return;
      *end = RefineModel(held_, std::move(lowest), how_);
    }
  }

  const RefineProblem& problem_;
  const int i_;
  QuotedModel held_;
  const std::vector<Settings> settings_;
  RefineOptions how_;
};

}  // namespace

ProfileSide FindQuotedSide(const RefineProblem& problem, const RefineEnd& best,
                           const ProfileQuery& query, const std::function<bool()>& stop) {
  RefineEnd quoted = best;
  quoted.p = Reported(problem.device, best.p);
  QuotedRefits refits(problem, query.parameter, stop);
  const auto refit = [&](double value, const FitPoint& start, double enough, double tolerance) {
    return refits.Refit(value, start, enough, tolerance);
  };
  ProfileSide side = FindProfileSide(QuotedModel(problem), quoted, query, {refit, nullptr});
  if (!side.better.empty()) side.better = Inner(problem.device, side.better);
  return side;
}

std::vector<bool> FindFlat(const RefineProblem& problem, const std::vector<double>& quoted) {
  const int count = problem.device.size(), points = static_cast<int>(problem.voltage_V.size());
  std::vector<double> residuals(points), slopes(static_cast<std::size_t>(points) * count);
  std::vector<bool> flat(count, false);
  const QuotedModel model(problem);
  if (!model.Evaluate(0, quoted.data(), nullptr, residuals.data(), slopes.data(), nullptr)) {
    return flat;
  }
  for (const Settings& settings : FindSettings(problem, /*i=*/-1)) {
    for (const int k : settings.parameters) {
      bool none = true;
      for (int r = 0; r < points; ++r) none = none && slopes[r * count + k] == 0;
      flat[k] = none;
    }
  }
  return flat;
}

}  // namespace lyrefit
