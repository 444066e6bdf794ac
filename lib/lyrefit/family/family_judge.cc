#include "lyrefit/family/family_judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "lyrefit/base/observer.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/family/coefficients.h"
#include "lyrefit/fit/statistics.h"
#include "lyrefit/law/extended_set.h"
#include "lyrefit/law/model_points.h"

namespace lyrefit {
namespace {

constexpr double kStrongCorrelation = 0.9;
constexpr double kLinearReach = 0.3;       // of a symmetric interval, relative to the value
constexpr double kNearPerfectShunt = 1e6;  // x V0 / I0

Interval Symmetric(double value, double standard_error, double t) {
  Interval interval;
  interval.value = value;
  interval.standard_error = standard_error;
  interval.low_95 = value - t * standard_error;
  interval.high_95 = value + t * standard_error;
  return interval;
}

KeyPoints AtReference(const Translation& translation, const std::vector<double>& shared) {
  if (translation.extended) {
    return ModelKeyPoints(UnderConditions(*translation.extended, 1, kReferenceTemperature_K),
                          ExtendedParameters(translation, shared.data()).data());
  }
  const TranslatedDevice at =
      TranslateTo(translation, shared, kReferenceIrradiance_W_m2, kReferenceTemperature_K);
  return ModelKeyPoints(at.device, at.parameters.data());
}

// A joint fit that is being reported, in reporting units.
struct Judged {
  const ReportedFit& fit;
  const FamilyOptions& options;
  double variance = 0;  // of the noise, at weight 1
  double t = 2;         // Student's, for 95 %
  JointSpread spread;
  std::vector<FitPoint> local_optima;  // other optima that the data allow
};

// With effects.
std::vector<FitPoint> FindMoreOptima(const ReportedFit& fit, const Observer& observer) {
  const ProgressReporter progress(observer, "other optima", 0);
  const double degrees = JointDegrees(fit.problem, fit.family.free_parameters, 0);
  std::vector<FitPoint> local_optima =
      FindOtherOptima(fit.problem, fit.end, StudentT95(static_cast<int>(degrees)),
                      fit.end.squares / degrees, progress.stop());
  for (FitPoint& other : local_optima) {
    other.p = ReportedShared(fit.family.translation, std::move(other.p));
  }
  return local_optima;
}

Judged SpreadOf(const ReportedFit& fit, const FamilyOptions& options, const Observer& observer) {
  Judged judged{fit, options, 0, 2, {}, {}};
  if (options.intervals && fit.family.translation.extended) {
    judged.local_optima = FindMoreOptima(fit, observer);
  }
  const double noise_A = fit.problem.noise_A;
  const JointSpread known = FindJointSpread(fit.problem, fit.model, fit.best, noise_A * noise_A);
  const double degrees = JointDegrees(fit.problem, fit.family.free_parameters, known.local_degrees);
  judged.variance = fit.end.squares / degrees;
  judged.t = StudentT95(static_cast<int>(degrees));
  judged.spread = FindJointSpread(fit.problem, fit.model, fit.best, judged.variance);
  return judged;
}

ParameterKind KindOf(const Judged& judged, int i) {
  return judged.fit.family.translation.parameters[i].kind;
}

void MarkHeld(const Judged& judged, int i, Estimate* e) {
  const Translation& at = judged.fit.family.translation;
  const double resistance = judged.fit.problem.voltage_scale_V / judged.fit.problem.current_scale_A;
  if (i == at.saturation_current_2 || i == at.n_2) {
    e->identifiable = false;
    e->reason = i == at.n_2 ? "Is2 is 0" : "the best fit has no such diode";
    if (i == at.saturation_current_2) e->at_bound = BoundSide::kLower;
  } else if (e->info.kind == ParameterKind::kDarkShunt) {
    // The range of a dark shunt is relative to the shunt at the reference.
    const double ratio = e->refined / judged.fit.best.p[e->info.with[0]];
    e->at_bound = ratio > 1.5 ? BoundSide::kUpper : BoundSide::kLower;
  } else if (e->info.kind == ParameterKind::kShunt && std::isinf(e->bounds.upper)) {
    const bool perfect = e->refined > kNearPerfectShunt * resistance;
    e->at_bound = perfect ? BoundSide::kUpper : BoundSide::kLower;
  } else {
    const bool low = e->refined - e->bounds.lower < e->bounds.upper - e->refined;
    e->at_bound = low ? BoundSide::kLower : BoundSide::kUpper;
  }
}

Estimate Describe(const Judged& judged, int i, double searched) {
  Estimate e;
  e.info = judged.fit.family.translation.parameters[i];
  e.bounds = ReportedBounds(SpanOf(judged.fit.family.translation), judged.fit.family.bounds[i],
                            judged.fit.end.point.shared, i);
  e.fixed = !std::isnan(judged.fit.family.fixed[i]);
  e.searched = searched;
  e.refined = judged.fit.best.p[i];
  if (e.fixed) return e;
  if (judged.fit.end.held[i]) MarkHeld(judged, i, &e);
  e.standard_error = judged.spread.standard_error[i];
  const double reach = judged.t * e.standard_error;
  if (!std::isfinite(reach) && !judged.fit.end.held[i]) {
    e.identifiable = false;
    e.reason = "the data do not fix it: nothing shows it, or another parameter takes its place";
  }
  if (!judged.options.intervals || !std::isfinite(reach)) return e;
  e.interval = IntervalMethod::kSymmetric;
  const ParameterRange range = RangeAround(e.info.kind, e.refined, reach);
  e.low_95 = range.low;
  e.high_95 = range.high;
  return e;
}

bool BendsWithOthers(const Judged& judged, int i) {
  const Translation& at = judged.fit.family.translation;
  if (!at.extended || i < at.first_effect) return false;
  return OneOfSeveral(*at.extended->effects, i - at.first_effect);
}

bool NeedsProfile(const Judged& judged, int i, const Estimate& e) {
  if (e.fixed || (KindOf(judged, i) == ParameterKind::kSaturation && judged.fit.end.held[i]) ||
      i == judged.fit.family.translation.n_2)
    return false;
  if (!judged.local_optima.empty() || BendsWithOthers(judged, i)) return true;
  // An ideality and what goes with it are exact in their own coordinates.
  if (e.at_bound != BoundSide::kNone) return true;
  if (e.interval == IntervalMethod::kNone) return false;
  if (e.low_95 < e.bounds.lower || e.high_95 > e.bounds.upper) return true;
  const bool signed_value = e.bounds.lower < 0;
  if (signed_value) return false;
  return judged.t * e.standard_error > kLinearReach * std::fabs(e.refined) || std::isinf(e.high_95);
}

// Returns false if the observer stopped it.
bool ProfileWhereNeeded(const Judged& judged, const Observer& observer,
                        std::vector<Estimate>* estimates) {
  std::vector<ProfileQuery> queries;
  for (int i = 0; i < judged.fit.family.translation.size(); ++i) {
    if (!NeedsProfile(judged, i, (*estimates)[i])) continue;
    for (const bool upper : {false, true}) {
      queries.push_back({i, upper, judged.t, judged.variance, (*estimates)[i].standard_error, false,
                         judged.local_optima});
    }
  }
  std::vector<ProfileSide> sides(queries.size());
  const ProgressReporter progress(observer, "intervals", static_cast<std::int64_t>(queries.size()));
  ParallelFor(static_cast<int>(queries.size()), judged.options.threads, [&](int q) {
    if (progress.Stopped()) return;
    JointOptions options;
    options.stop = progress.stop();
    sides[q] = FindProfileSide(judged.fit.model, judged.fit.best, queries[q], HowToRefine(options));
    progress.Step();
  });
  if (progress.Stopped()) return false;
  for (std::size_t q = 0; q + 1 < queries.size(); q += 2) {
    const int i = queries[q].parameter;
    Estimate& e = (*estimates)[i];
    e.interval = IntervalMethod::kProfile;
    e.low_95 = std::max(sides[q].value, e.bounds.lower);
    e.high_95 =
        sides[q + 1].at_bound && IsConductance(KindOf(judged, i)) ? kInfinity : sides[q + 1].value;
    if (IsConductance(KindOf(judged, i)) && std::isinf(e.high_95)) {
      e.identifiable = false;
      e.reason = "only a lower limit is known";
    } else if (sides[q].at_bound && sides[q + 1].at_bound) {
      e.identifiable = false;
      e.reason = "the data allow its whole range";
    }
  }
  return true;
}

// Value and symmetric interval of a function of the shared parameters, from a gradient by central
// differences. The interval is unknown if the function changes along a direction that the data do
// not determine.
Interval Derived(const Judged& judged, const std::vector<double>& refined,
                 const std::function<double(const std::vector<double>&)>& value) {
  const JointSpread& spread = judged.spread;
  constexpr double kOpen = 1e-3;  // smaller relative changes are rounding errors
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(spread.covariance.rows());
  for (int i = 0; i < judged.fit.family.translation.size(); ++i) {
    if (judged.fit.end.held[i]) continue;
    // The step is a thousandth of the standard error, or of the undetermined direction.
    const bool open = std::isnan(spread.standard_error[i]);
    const double size = open ? spread.open.row(i).norm() : spread.standard_error[i];
    const double step = std::max(1e-3 * size, 1e-5 * std::fabs(refined[i]));
    if (!(step > 0)) continue;
    std::vector<double> up = refined, down = refined;
    up[i] += step;
    down[i] -= step;
    gradient[i] = (value(up) - value(down)) / (up[i] - down[i]);
  }
  const double now = value(refined);
  for (Eigen::Index k = 0; k < spread.open.cols(); ++k) {
    const Eigen::VectorXd parts = gradient.cwiseProduct(spread.open.col(k));
    const double least = std::max(parts.cwiseAbs().sum(), std::fabs(now));
    if (std::fabs(parts.sum()) > kOpen * least) return Symmetric(now, kUnknown, judged.t);
  }
  const double variance = gradient.dot(spread.covariance * gradient);
  return Symmetric(now, std::sqrt(std::max(variance, 0.0)), judged.t);
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

// Correlations above kStrongCorrelation, the strongest first.
std::vector<Correlation> StrongCorrelations(const Judged& judged) {
  const JointProblem& problem = judged.fit.problem;
  std::vector<Correlation> strong;
  const auto symbol = [&](int i) -> std::string {
    if (i == problem.irradiance_offset()) return "dG";
    if (i == problem.temperature_offset()) return "dT";
    return judged.fit.family.translation.parameters[i].symbol;
  };
  for (int i = 0; i < problem.shared(); ++i) {
    for (int j = i + 1; j < problem.shared(); ++j) {
      const double value = judged.spread.correlation(i, j);
      if (std::fabs(value) <= kStrongCorrelation) continue;
      strong.push_back({symbol(i), symbol(j), value});
    }
  }
  std::stable_sort(strong.begin(), strong.end(), [](const Correlation& a, const Correlation& b) {
    return std::fabs(a.value) > std::fabs(b.value);
  });
  return strong;
}

void DescribeSensors(const Judged& judged, FamilyReport* report) {
  const JointProblem& problem = judged.fit.problem;
  const auto error = [&](int i) {
    return Symmetric(judged.fit.best.p[i], judged.spread.standard_error[i], judged.t);
  };
  if (judged.options.irradiance_offset) {
    report->irradiance_offset_W_m2 = error(problem.irradiance_offset());
  }
  if (judged.options.temperature_offset) {
    report->temperature_offset_K = error(problem.temperature_offset());
  }
}

void DescribeOffsets(const Judged& judged, FamilyReport* report) {
  const std::vector<int>& fitted = judged.fit.family.curves.fitted;
  for (std::size_t k = 0; k < fitted.size(); ++k) {
    const JointCurve& curve = judged.fit.problem.curves[k];
    const JointLocal& local = judged.fit.end.point.local[k];
    const JointLocal& error = judged.spread.local_errors[k];
    FamilyCurve& row = report->curves[fitted[k]];
    if (curve.irradiance_sd > 0) {
      row.irradiance_offset_W_m2 =
          Symmetric(local[0] * curve.irradiance_W_m2, error[0] * curve.irradiance_W_m2, judged.t);
    }
    if (curve.temperature_sd_K > 0) {
      row.temperature_offset_K = Symmetric(local[1], error[1], judged.t);
    }
  }
}

}  // namespace

double JointDegrees(const JointProblem& problem, int free_parameters, double local_degrees) {
  double points = 0;
  for (const JointCurve& curve : problem.curves) {
    points += static_cast<double>(curve.voltage_V.size());
  }
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

void JudgeFamily(const ReportedFit& fit, const FamilyOptions& options, const Observer& observer,
                 FamilyReport* report) {
  const Translation& at = fit.family.translation;
  const std::vector<double>& shared = fit.best.p;
  report->refined.assign(shared.begin(), shared.begin() + at.size());
  report->refined = InnerShared(at, std::move(report->refined));
  const std::vector<double> searched = ReportedShared(at, report->searched);
  const Judged judged = SpreadOf(fit, options, observer);
  report->noise_A = std::sqrt(judged.variance);
  report->estimates.clear();
  for (int i = 0; i < at.size(); ++i) {
    report->estimates.push_back(Describe(judged, i, searched.empty() ? kUnknown : searched[i]));
  }
  if (options.intervals) {
    if (!ProfileWhereNeeded(judged, observer, &report->estimates)) report->interrupted = true;
    report->coefficients = Coefficients(judged, report->refined);
    report->correlations = StrongCorrelations(judged);
  }
  DescribeSensors(judged, report);
  report->reference = AtReference(at, report->refined);
  DescribeOffsets(judged, report);
}

}  // namespace lyrefit
