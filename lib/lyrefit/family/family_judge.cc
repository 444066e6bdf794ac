#include "lyrefit/family/family_judge.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/parallel.h"
#include "lyrefit/estimate/fit/estimate_parameters.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/estimate/refine/other_optima.h"
#include "lyrefit/family/key_point_errors.h"
#include "lyrefit/model/extended_set.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/translation.h"

namespace lyrefit {
namespace {

constexpr IntervalRules kRules = {
    /*thorough=*/false, /*judge_open_ends=*/false, /*judge_absent_diodes=*/false,
    "only a lower limit is known",
    "the data do not fix it: nothing shows it, or another parameter takes its place"};

KeyPoints AtReference(const Translation& translation, const std::vector<double>& shared) {
  if (translation.extended) {
    return ModelKeyPoints(UnderConditions(*translation.extended, 1, kReferenceTemperature_K),
                          ExtendedParameters(translation, shared.data()).data());
  }
  const TranslatedDevice at =
      TranslateTo(translation, shared, kReferenceIrradiance_W_m2, kReferenceTemperature_K);
  return ModelKeyPoints(at.device, at.parameters.data());
}

// A joint fit that is being judged, in reporting units.
struct Judged {
  const ReportedFit& fit;
  const FamilyOptions& options;
  double variance = 0;  // of the noise, at weight 1
  int degrees = 1;      // of freedom
  double t = 2;         // Student's, for 95 %
  JointSpread spread;
  std::vector<FitPoint> local_optima;  // other optima that the data allow
  std::vector<double> stretch = {};    // of the standard errors by errors that conditions share
  std::optional<KeyPointRowsOf> rows = {};  // of key points with errors that show
  std::optional<KeyPointErrorSizes> sizes = {};

  // Standard error of a function of this gradient; t of them are half of its 95 % interval.
  double StandardError(const Eigen::VectorXd& gradient) const {
    const Eigen::VectorXd weight = TransposedTimes(rows->influence, gradient);
    return sizes->HalfWidth95(*rows, weight) / t;
  }
};

// Other optima of a fit with effects whose sum of squares rises by less than t^2 variances, in
// reporting units.
std::vector<FitPoint> FindMoreOptima(const ReportedFit& fit, const ProgressReporter& progress) {
  progress.Begin("other optima", 0);
  JointOptions how;
  how.stop = progress.stop();
  const EffectSpan effects = SpanOf(fit.family.translation);
  const double degrees = JointDegrees(fit.problem, fit.family.free_parameters, 0);
  const double t = StudentT95(static_cast<int>(degrees));
  const double rise = t * t * (fit.end.squares / degrees);
  const double highest =
      (fit.end.squares + fit.end.prior_squares + rise) / fit.internal.shape().points;
  std::vector<FitPoint> local_optima = FindOtherOptima(
      fit.internal, effects, fit.internal.Pack(fit.end.point), {}, {highest, HowToRefine(how)});
  for (FitPoint& other : local_optima) other.p = Reported(effects, std::move(other.p));
  return local_optima;
}

// Takes the errors of key points as their residuals show them, with those that conditions share.
void TakeErrorsOfKeyPoints(Judged* judged) {
  constexpr double kExactPart = 1e-6;  // of the errors that weigh: rounding
  const ReportedFit& fit = judged->fit;
  const double noise = std::sqrt(judged->variance);
  if (!judged->options.intervals || !fit.family.curves.key_points ||
      !(noise > kExactPart * fit.problem.key_point_scale_A)) {
    return;
  }
  judged->rows = RowsOfKeyPoints(fit.problem, fit.end.point, fit.end.active);
  if (!judged->rows) return;
  judged->sizes.emplace(*judged->rows, noise, judged->options.key_point_errors);
  Spread& spread = judged->spread;
  const std::vector<double> own = spread.standard_error;
  const auto count = static_cast<Eigen::Index>(own.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    double& error = spread.standard_error[i];
    if (std::isfinite(error)) error = judged->StandardError(Eigen::VectorXd::Unit(count, i));
  }
  judged->stretch = StretchOf(spread.standard_error, own);
}

Judged SpreadOf(const ReportedFit& fit, const FamilyOptions& options,
                const ProgressReporter& progress) {
  Judged judged{fit, options, 0, 1, 2, {}, {}};
  if (options.intervals && fit.family.translation.extended) {
    judged.local_optima = FindMoreOptima(fit, progress);
  }
  const double noise_A = fit.problem.noise_A;
  const JointSpread known = FindJointSpread(fit.problem, fit.model, fit.best, noise_A * noise_A);
  const double degrees = JointDegrees(fit.problem, fit.family.free_parameters, known.local_degrees);
  judged.variance = fit.end.squares / degrees;
  judged.degrees = static_cast<int>(degrees);
  judged.t = StudentT95(judged.degrees);
  judged.spread = FindJointSpread(fit.problem, fit.model, fit.best, judged.variance);
  TakeErrorsOfKeyPoints(&judged);
  return judged;
}

// The shared parameters with their bounds.
std::vector<Estimate> ParametersOf(const ReportedFit& fit) {
  const Translation& at = fit.family.translation;
  std::vector<Estimate> parameters(at.size());
  for (int i = 0; i < at.size(); ++i) {
    parameters[i].info = at.parameters[i];
    parameters[i].bounds =
        ReportedBounds(SpanOf(at), fit.family.bounds[i], fit.end.point.shared, i);
    parameters[i].fixed = !std::isnan(fit.family.fixed[i]);
  }
  return parameters;
}

EstimateReport EstimatesOf(const Judged& judged, const std::vector<double>& searched,
                           const ProgressReporter& progress) {
  const ReportedFit& fit = judged.fit;
  EstimateProblem problem{fit.model, ParametersOf(fit)};
  problem.effects = SpanOf(fit.family.translation);
  problem.further = {"dG", "dT"};
  problem.errors = [&](const RefineEnd&) {
    return EstimateErrors{judged.variance, judged.degrees, judged.spread, judged.stretch};
  };
  problem.several_optima = !judged.local_optima.empty();
  problem.refits = HowToRefine({});
  problem.intervals = kRules;
  EstimateOptions options;
  options.intervals = judged.options.intervals ? Intervals::kProfile : Intervals::kNone;
  options.threads = judged.options.threads;
  return JudgeParameters(problem, {fit.best, judged.local_optima, {}}, searched, options, progress)
      .report;
}

Interval Derived(const Judged& judged, const std::vector<double>& refined,
                 const std::function<double(const std::vector<double>&)>& value) {
  std::function<double(const Eigen::VectorXd&)> standard_error;
  if (judged.sizes) {
    standard_error = [&](const Eigen::VectorXd& gradient) {
      return judged.StandardError(gradient);
    };
  }
  return DerivedInterval(judged.spread, judged.fit.end.active, judged.fit.family.translation.size(),
                         judged.t, refined, value, standard_error);
}

// Coefficients of the short-circuit current, the open-circuit voltage and the maximum power.
std::vector<Coefficient> Coefficients(const Judged& judged, const std::vector<double>& refined) {
  const auto derived = [&](double TemperatureCoefficients::*field) {
    return Derived(judged, refined, [&, field](const std::vector<double>& shared) {
      return CoefficientsAtReference(judged.fit.family.translation, shared).*field;
    });
  };
  return {{"alpha_isc", "A/K", derived(&TemperatureCoefficients::alpha_sc_A_K)},
          {"beta_voc", "V/K", derived(&TemperatureCoefficients::beta_oc_V_K)},
          {"gamma_pmp", "%/K", derived(&TemperatureCoefficients::gamma_pmp_percent_K)}};
}

void DescribeSensors(const Judged& judged, JudgedFamily* family) {
  const JointProblem& problem = judged.fit.problem;
  const auto error = [&](int i) {
    return SymmetricInterval(judged.fit.best.p[i], judged.spread.standard_error[i], judged.t);
  };
  if (judged.options.irradiance_offset) {
    family->irradiance_offset_W_m2 = error(problem.irradiance_offset());
  }
  if (judged.options.temperature_offset) {
    family->temperature_offset_K = error(problem.temperature_offset());
  }
}

std::vector<CurveOffsets> OffsetsOf(const Judged& judged) {
  const std::vector<JointCurve>& curves = judged.fit.problem.curves;
  std::vector<CurveOffsets> offsets(curves.size());
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const JointLocal& local = judged.fit.end.point.local[k];
    const JointLocal& error = judged.spread.local_errors[k];
    const double irradiance = curves[k].irradiance_W_m2;
    if (curves[k].irradiance_sd > 0) {
      offsets[k].irradiance_W_m2 =
          SymmetricInterval(local[0] * irradiance, error[0] * irradiance, judged.t);
    }
    if (curves[k].temperature_sd_K > 0) {
      offsets[k].temperature_K = SymmetricInterval(local[1], error[1], judged.t);
    }
  }
  return offsets;
}

}  // namespace

Interval DerivedInterval(const Spread& spread, const std::vector<bool>& active, int size, double t,
                         const std::vector<double>& shared,
                         const std::function<double(const std::vector<double>&)>& value,
                         const std::function<double(const Eigen::VectorXd&)>& standard_error) {
  constexpr double kOpen = 1e-3;  // smaller relative changes are rounding errors
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(spread.covariance.rows());
  for (int i = 0; i < size; ++i) {
    if (active[i]) continue;
    // The step is a thousandth of the standard error, or of the undetermined direction.
    const bool open = std::isnan(spread.standard_error[i]);
    const double error = open ? spread.open.row(i).norm() : spread.standard_error[i];
    const double step = std::max(1e-3 * error, 1e-5 * std::fabs(shared[i]));
    if (!(step > 0)) continue;
    std::vector<double> up = shared, down = shared;
    up[i] += step;
    down[i] -= step;
    gradient[i] = (value(up) - value(down)) / (up[i] - down[i]);
  }
  const double now = value(shared);
  for (Eigen::Index k = 0; k < spread.open.cols(); ++k) {
    const Eigen::VectorXd parts = gradient.cwiseProduct(spread.open.col(k));
    const double least = std::max(parts.cwiseAbs().sum(), std::fabs(now));
    if (std::fabs(parts.sum()) > kOpen * least) return SymmetricInterval(now, kUnknown, t);
  }
  if (standard_error) return SymmetricInterval(now, standard_error(gradient), t);
  const double variance = gradient.dot(spread.covariance * gradient);
  return SymmetricInterval(now, std::sqrt(std::max(variance, 0.0)), t);
}

Interval SymmetricInterval(double value, double standard_error, double t, ParameterKind kind,
                           const ParameterBounds& bounds) {
  const ParameterRange range = SymmetricRange(kind, value, standard_error, t, bounds);
  return {value, standard_error, range.low, range.high};
}

double JointDegrees(const JointProblem& problem, int free_parameters, double local_degrees) {
  double points = 0;
  for (const JointCurve& curve : problem.curves) points += curve.residuals();
  return std::max(points - free_parameters - local_degrees, 1.0);
}

ReportedFit::ReportedFit(const FamilyProblem& of_family, const JointProblem& of_problem,
                         const JointEnd& of_end)
    : family(of_family),
      problem(of_problem),
      end(of_end),
      internal(problem),
      model(internal, SpanOf(family.translation)),
      best(PackedEnd(problem, end)) {
  best.p = ReportedShared(family.translation, std::move(best.p));
}

JudgedEnd JudgeFamily(const ReportedFit& fit, const FamilyOptions& options,
                      const std::vector<double>& searched, const ProgressReporter& progress) {
  const Translation& at = fit.family.translation;
  const std::vector<double>& shared = fit.best.p;
  JudgedEnd family;
  family.refined.assign(shared.begin(), shared.begin() + at.size());
  family.refined = InternalShared(at, std::move(family.refined));
  const Judged judged = SpreadOf(fit, options, progress);
  family.noise_A = std::sqrt(judged.variance);
  if (options.intervals) progress.Begin("intervals", 0);
  family.estimate = EstimatesOf(judged, ReportedShared(at, searched), progress);
  if (options.intervals) family.coefficients = Coefficients(judged, family.refined);
  DescribeSensors(judged, &family);
  if (judged.sizes) {
    family.key_point_errors =
        FoundErrorsOf(*judged.sizes, options.key_point_errors, fit.problem.key_point_scale_A);
  }
  family.reference = AtReference(at, family.refined);
  family.offsets = OffsetsOf(judged);
  return family;
}

std::optional<std::vector<Interval>> Jackknife(const ReportedFit& fit,
                                               const std::vector<Estimate>& estimates, int threads,
                                               const Observer& observer) {
  const FamilyProblem& family = fit.family;
  const JointProblem& problem = fit.problem;
  const JointEnd& end = fit.end;
  const int curves = static_cast<int>(problem.curves.size());
  const int count = family.translation.size();
  std::vector<std::vector<double>> without(curves);
  const ProgressReporter progress(observer, "jackknife", curves);
  ParallelFor(curves, threads, [&](int c) {
    if (progress.Stopped()) return;
    JointProblem rest = problem;
    JointPoint start = end.point;
    rest.curves.erase(rest.curves.begin() + c);
    start.local.erase(start.local.begin() + c);
    JointOptions quick;
    quick.function_tolerance = 1e-9;
    quick.stop = progress.stop();
    without[c] = ReportedShared(family.translation, RefineJointly(rest, start, quick).point.shared);
    progress.Step();
  });
  if (progress.Stopped()) return {};
  const double t = StudentT95(std::max(curves - 1, 1));
  const std::vector<double> whole = ReportedShared(family.translation, end.point.shared);
  std::vector<Interval> intervals;
  intervals.reserve(count);
  for (int i = 0; i < count; ++i) {
    Interval interval;
    interval.value = whole[i];
    if (std::isnan(family.fixed[i]) && curves > 2) {
      const ParameterKind kind = family.translation.parameters[i].kind;
      double mean = 0, squares = 0;
      for (const auto& shared : without) mean += ToScale(kind, shared[i]) / curves;
      for (const auto& shared : without) {
        const double off = ToScale(kind, shared[i]) - mean;
        squares += off * off;
      }
      const double error = std::sqrt(squares * (curves - 1) / curves);
      interval = SymmetricInterval(whole[i], error / StepOnScale(kind, whole[i], 1), t, kind,
                                   estimates[i].bounds);
    }
    intervals.push_back(interval);
  }
  return intervals;
}

}  // namespace lyrefit
