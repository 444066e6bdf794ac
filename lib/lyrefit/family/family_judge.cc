#include "lyrefit/family/family_judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "lyrefit/base/parallel.h"
#include "lyrefit/base/shared_observer.h"
#include "lyrefit/family/coefficients.h"
#include "lyrefit/fit/statistics.h"
#include "lyrefit/law/extended_set.h"
#include "lyrefit/law/model_points.h"

namespace lyrefit {
namespace {

constexpr double kStrongCorrelation = 0.9;
constexpr double kLinearReach = 0.3;       // of a symmetric interval, in parts of the value
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
    return ModelKeyPoints(UnderSky(*translation.extended, 1, kReferenceTemperature_K),
                          ExtendedParameters(translation, shared.data()).data());
  }
  const TranslatedDevice at =
      TranslateTo(translation, shared, kReferenceIrradiance_W_m2, kReferenceTemperature_K);
  return ModelKeyPoints(at.device, at.parameters.data());
}

class Judge {
 public:
  Judge(const QuotedFit& fit, const FamilyOptions& options, const Observer& observer,
        FamilyReport* report)
      : family_(fit.family),
        options_(options),
        problem_(fit.problem),
        end_(fit.end),
        valleys_(fit.valleys),
        observer_(observer),
        r_(*report) {}

  void Run() {
    const std::vector<double>& shared = end_.point.shared;
    const int count = family_.translation.size();
    r_.refined.assign(shared.begin(), shared.begin() + count);
    r_.refined = InnerShared(family_.translation, std::move(r_.refined));
    searched_ = ReportedShared(family_.translation, r_.searched);
    JointSpread spread = FindJointSpread(problem_, end_, problem_.noise_A * problem_.noise_A);
    const double degrees = JointDegrees(problem_, family_.free_parameters, spread.local_degrees);
    variance_ = end_.squares / degrees;
    r_.noise_A = std::sqrt(variance_);
    t_ = StudentT95(static_cast<int>(degrees));
    spread = FindJointSpread(problem_, end_, variance_);
    r_.estimates.clear();
    for (int i = 0; i < count; ++i) r_.estimates.push_back(Describe(i, spread));
    if (options_.intervals) {
      ProfileWhereNeeded();
      FindCoefficients(spread);
      FindCorrelations(spread);
    }
    SensorErrors(spread);
    r_.reference = AtReference(family_.translation, r_.refined);
    local_error_ = spread.local_errors;
  }

  double t() const { return t_; }
  const std::vector<JointLocal>& local_error() const { return local_error_; }

 private:
  ParameterKind Kind(int i) const { return family_.translation.parameters[i].kind; }

  Estimate Describe(int i, const JointSpread& spread) const {
    Estimate e;
    e.info = family_.translation.parameters[i];
    e.bounds = family_.bounds[i];
    e.fixed = !std::isnan(family_.fixed[i]);
    e.searched = searched_.empty() ? kUnknown : searched_[i];
    e.refined = end_.point.shared[i];
    if (e.fixed) return e;
    if (end_.held[i]) MarkHeld(i, &e);
    e.standard_error = spread.standard_error[i];
    const double reach = t_ * e.standard_error;
    if (!std::isfinite(reach) && !end_.held[i]) {
      e.identifiable = false;
      e.reason = "the data do not fix it: nothing shows it, or another parameter takes its place";
    }
    if (!options_.intervals || !std::isfinite(reach)) return e;
    e.interval = IntervalMethod::kSymmetric;
    const ParameterRange range = RangeAround(e.info.kind, e.refined, reach);
    e.low_95 = range.low;
    e.high_95 = range.high;
    return e;
  }

  void MarkHeld(int i, Estimate* e) const {
    const Translation& at = family_.translation;
    const double resistance = problem_.voltage_scale_V / problem_.current_scale_A;
    if (i == at.saturation_current_2 || i == at.n_2) {
      e->identifiable = false;
      e->reason = i == at.n_2 ? "Is2 is 0" : "the best fit has no such diode";
      if (i == at.saturation_current_2) e->at_bound = BoundSide::kLower;
    } else if (e->info.kind == ParameterKind::kDarkShunt) {
      // Its range is relative to the other shunt.
      const double ratio = e->refined / end_.point.shared[e->info.with[0]];
      e->at_bound = ratio > 1.5 ? BoundSide::kUpper : BoundSide::kLower;
    } else if (e->info.kind == ParameterKind::kShunt && std::isinf(e->bounds.upper)) {
      const bool perfect = e->refined > kNearPerfectShunt * resistance;
      e->at_bound = perfect ? BoundSide::kUpper : BoundSide::kLower;
    } else {
      const bool low = e->refined - e->bounds.lower < e->bounds.upper - e->refined;
      e->at_bound = low ? BoundSide::kLower : BoundSide::kUpper;
    }
  }

  bool NeedsProfile(int i) const {
    const Estimate& e = r_.estimates[i];
    if (e.fixed || (Kind(i) == ParameterKind::kSaturation && end_.held[i]) ||
        i == family_.translation.n_2)
      return false;
    if (!valleys_.empty() || BendsWithOthers(i)) return true;
    // An ideality and what goes with it are exact in their own coordinates.
    if (e.at_bound != BoundSide::kNone) return true;
    if (e.interval == IntervalMethod::kNone) return false;
    if (e.low_95 < e.bounds.lower || e.high_95 > e.bounds.upper) return true;
    const bool signed_value = e.bounds.lower < 0;
    if (signed_value) return false;
    return t_ * e.standard_error > kLinearReach * std::fabs(e.refined) || std::isinf(e.high_95);
  }

  bool BendsWithOthers(int i) const {
    const Translation& at = family_.translation;
    if (!at.extended || i < at.first_effect) return false;
    return OneOfSeveral(*at.extended->extension, i - at.first_effect);
  }

  void ProfileWhereNeeded() {
    std::vector<ProfileQuery> queries;
    for (int i = 0; i < family_.translation.size(); ++i) {
      if (!NeedsProfile(i)) continue;
      for (const bool upper : {false, true}) {
        queries.push_back(
            {i, upper, t_, variance_, r_.estimates[i].standard_error, false, valleys_});
      }
    }
    std::vector<ProfileSide> sides(queries.size());
    SharedObserver watch(observer_, "intervals", static_cast<std::int64_t>(queries.size()));
    watch.Begin();
    ParallelFor(static_cast<int>(queries.size()), options_.threads, [&](int q) {
      if (watch.Stopped()) return;
      sides[q] = FindProfileSide(problem_, end_, queries[q], watch.Proceed());
      watch.FinishJob();
    });
    if (watch.Stopped()) {
      r_.interrupted = true;
      return;
    }
    for (std::size_t q = 0; q + 1 < queries.size(); q += 2) {
      const int i = queries[q].parameter;
      Estimate& e = r_.estimates[i];
      e.interval = IntervalMethod::kProfile;
      e.low_95 = std::max(sides[q].value, e.bounds.lower);
      e.high_95 = sides[q + 1].at_bound && IsConductance(Kind(i)) ? kInfinity : sides[q + 1].value;
      if (IsConductance(Kind(i)) && std::isinf(e.high_95)) {
        e.identifiable = false;
        e.reason = "only a lower limit is known";
      } else if (sides[q].at_bound && sides[q + 1].at_bound) {
        e.identifiable = false;
        e.reason = "the data allow its whole range";
      }
    }
  }

  // Gradient of a function of the shared parameters by central differences, and the spread that
  // follows; none where the function changes along a direction that the data leave open.
  Interval Derived(const std::function<double(const std::vector<double>&)>& value,
                   const JointSpread& spread) const {
    constexpr double kOpen = 1e-3;  // smaller changes are rounding
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(spread.covariance.rows());
    for (int i = 0; i < family_.translation.size(); ++i) {
      if (end_.held[i]) continue;
      // A step that shows: a thousandth of what is not known, be it little or everything.
      const bool open = std::isnan(spread.standard_error[i]);
      const double size = open ? spread.open.row(i).norm() : spread.standard_error[i];
      const double step = std::max(1e-3 * size, 1e-5 * std::fabs(r_.refined[i]));
      if (!(step > 0)) continue;
      std::vector<double> up = r_.refined, down = r_.refined;
      up[i] += step;
      down[i] -= step;
      gradient[i] = (value(up) - value(down)) / (up[i] - down[i]);
    }
    const double now = value(r_.refined);
    for (Eigen::Index k = 0; k < spread.open.cols(); ++k) {
      const Eigen::VectorXd parts = gradient.cwiseProduct(spread.open.col(k));
      const double least = std::max(parts.cwiseAbs().sum(), std::fabs(now));
      if (std::fabs(parts.sum()) > kOpen * least) return Symmetric(now, kUnknown, t_);
    }
    const double variance = gradient.dot(spread.covariance * gradient);
    return Symmetric(now, std::sqrt(std::max(variance, 0.0)), t_);
  }

  void FindCoefficients(const JointSpread& spread) {
    const auto coefficient = [&](double TemperatureCoefficients::*field) {
      return [this, field](const std::vector<double>& shared) {
        return CoefficientsAtReference(family_.translation, shared).*field;
      };
    };
    r_.coefficients = {
        {"alpha_isc", "A/K", Derived(coefficient(&TemperatureCoefficients::alpha_sc_A_K), spread)},
        {"beta_voc", "V/K", Derived(coefficient(&TemperatureCoefficients::beta_oc_V_K), spread)},
        {"gamma_pmp", "%/K",
         Derived(coefficient(&TemperatureCoefficients::gamma_pmp_percent_K), spread)}};
  }

  void FindCorrelations(const JointSpread& spread) {
    r_.correlations.clear();
    const auto symbol = [&](int i) -> std::string {
      if (i == problem_.irradiance_offset()) return "dG";
      if (i == problem_.temperature_offset()) return "dT";
      return family_.translation.parameters[i].symbol;
    };
    for (int i = 0; i < problem_.shared(); ++i) {
      for (int j = i + 1; j < problem_.shared(); ++j) {
        const double value = spread.correlation(i, j);
        if (std::fabs(value) <= kStrongCorrelation) continue;
        r_.correlations.push_back({symbol(i), symbol(j), value});
      }
    }
    std::stable_sort(r_.correlations.begin(), r_.correlations.end(),
                     [](const Correlation& a, const Correlation& b) {
                       return std::fabs(a.value) > std::fabs(b.value);
                     });
  }

  void SensorErrors(const JointSpread& spread) {
    const int g = problem_.irradiance_offset(), d = problem_.temperature_offset();
    if (options_.irradiance_offset) {
      r_.irradiance_offset_W_m2 = Symmetric(end_.point.shared[g], spread.standard_error[g], t_);
    }
    if (options_.temperature_offset) {
      r_.temperature_offset_K = Symmetric(end_.point.shared[d], spread.standard_error[d], t_);
    }
  }

  const FamilyProblem& family_;
  const FamilyOptions& options_;
  const JointProblem& problem_;
  const JointEnd& end_;
  const std::vector<FitPoint>& valleys_;
  const Observer& observer_;
  FamilyReport& r_;
  std::vector<double> searched_;
  double variance_ = 0;
  double t_ = 2;
  std::vector<JointLocal> local_error_;
};

}  // namespace

double JointDegrees(const JointProblem& problem, int free_parameters, double local_degrees) {
  double points = 0;
  for (const JointCurve& curve : problem.curves) {
    points += static_cast<double>(curve.voltage_V.size());
  }
  return std::max(points - free_parameters - local_degrees, 1.0);
}

void JudgeFamily(const QuotedFit& fit, const FamilyOptions& options, const Observer& observer,
                 FamilyReport* report) {
  Judge judge(fit, options, observer, report);
  judge.Run();
  const JointEnd& end = fit.end;
  const std::vector<int>& fitted = fit.family.curves.fitted;
  for (std::size_t k = 0; k < fitted.size(); ++k) {
    const JointCurve& curve = fit.problem.curves[k];
    FamilyCurve& row = report->curves[fitted[k]];
    const JointLocal& error = judge.local_error()[k];
    if (curve.irradiance_sd > 0) {
      row.irradiance_offset_W_m2 = Symmetric(end.point.local[k][0] * curve.irradiance_W_m2,
                                             error[0] * curve.irradiance_W_m2, judge.t());
    }
    if (curve.temperature_sd_K > 0) {
      row.temperature_offset_K = Symmetric(end.point.local[k][1], error[1], judge.t());
    }
  }
}

}  // namespace lyrefit
