#include "lyrefit/family/family_errors.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/curve/key_points.h"
#include "lyrefit/estimate/fit/reading_errors.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/estimate/refine/coordinates.h"
#include "lyrefit/family/family_model.h"

namespace lyrefit {
namespace {

// Center of weak priors: a per cent of light and a kelvin, with a factor of 20 either way.
constexpr double kUsualIrradiance = 0.01;
constexpr double kUsualTemperature_K = 1;
constexpr double kWidth = 3;

RowMatrix CommonErrors(const FamilyErrorShape& shape, const FamilyErrorSizes& sizes) {
  RowMatrix common = shape.common;
  common.col(0) *= sizes.irradiance;
  common.col(1) *= sizes.temperature_K;
  return common;
}

FamilyErrorSizes SizesAt(FamilyErrorKind kind, const std::vector<double>& logs) {
  FamilyErrorSizes sizes;
  sizes.readings.current_A = std::exp(logs[0]);
  if (kind == FamilyErrorKind::kIndependent) return sizes;
  sizes.readings.voltage_V = std::exp(logs[1]);
  sizes.readings.path = std::exp(logs[2]);
  if (kind == FamilyErrorKind::kPath) return sizes;
  sizes.irradiance = std::exp(logs[3]);
  sizes.temperature_K = std::exp(logs[4]);
  return sizes;
}

}  // namespace

FamilyErrorSizes FindFamilyErrors(FamilyErrorKind kind, const FamilyErrorShape& shape, double isc_A,
                                  double voc_V, const Eigen::VectorXd& residual) {
  const ErrorPrior prior = UsualErrors(isc_A, voc_V);
  std::vector<double> center = {std::log(prior.center.current_A), std::log(prior.center.voltage_V),
                                std::log(prior.center.path), std::log(kUsualIrradiance),
                                std::log(kUsualTemperature_K)};
  const std::vector<double> width = {prior.width.current_A, prior.width.voltage_V, prior.width.path,
                                     kWidth, kWidth};
  center.resize(kind == FamilyErrorKind::kIndependent ? 1 : kind == FamilyErrorKind::kPath ? 3 : 5);
  const auto value = [&](const std::vector<double>& at) {
    double sum = LogLikelihood(shape, SizesAt(kind, at), residual);
    for (std::size_t i = 0; i < at.size(); ++i) {
      sum -= 0.5 * std::pow((at[i] - center[i]) / width[i], 2);
    }
    return std::isnan(sum) ? -HUGE_VAL : sum;
  };
  constexpr int kMostSteps = 30;
  std::vector<double> best = center;
  for (const double part : {1.0, 0.03}) {  // of the usual sizes: tracers' readings, simulated ones
    std::vector<double> start = center;
    for (double& one : start) one += std::log(part);
    std::vector<double> end = NewtonAscent(value, std::move(start), kMostSteps);
    if (value(end) > value(best)) best = std::move(end);
  }
  return SizesAt(kind, best);
}

double LogLikelihood(const FamilyErrorShape& shape, const FamilyErrorSizes& sizes,
                     const Eigen::VectorXd& residual) {
  const Eigen::Index shared = shape.common.cols();
  RowMatrix rows(residual.size(), 1 + shared);
  rows.col(0) = residual;
  rows.rightCols(shared) = CommonErrors(shape, sizes);
  double sum = Whiten(MakeErrorModel(shape.readings, sizes.readings), {}, rows);
  for (std::size_t c = 0; c + 1 < shape.first.size(); ++c) {
    const Eigen::MatrixXd block =
        rows.middleRows(shape.first[c], shape.first[c + 1] - shape.first[c]);
    const Eigen::MatrixXd all = TransposedTimes(block, block);
    // Whitened readings have the covariance 1 + common common': Woodbury's formula.
    const double a = all(1, 1) + 1, b = all(2, 2) + 1, mixed = all(1, 2);
    const double determinant = a * b - mixed * mixed, x = all(0, 1), y = all(0, 2);
    sum += std::log(determinant) + all(0, 0) -
           (b * x * x - 2 * mixed * x * y + a * y * y) / determinant;
  }
  return -0.5 * sum;
}

RowMatrix CovarianceTimes(const FamilyErrorShape& shape, const FamilyErrorSizes& sizes,
                          const RowMatrix& rows) {
  RowMatrix product = CovarianceTimes(MakeErrorModel(shape.readings, sizes.readings), rows);
  const RowMatrix common = CommonErrors(shape, sizes);
  for (std::size_t c = 0; c + 1 < shape.first.size(); ++c) {
    const int first = shape.first[c], count = shape.first[c + 1] - first;
    const Eigen::MatrixXd errors = common.middleRows(first, count);
    const Eigen::MatrixXd block = rows.middleRows(first, count);
    product.middleRows(first, count) += Times(errors, TransposedTimes(errors, block));
  }
  return product;
}

namespace {

constexpr int kMostCurves = 60;  // largest number of curves used to find error sizes

// Residuals of some curves, with the shape of their errors.
struct Rows {
  FamilyErrorShape shape;     // with a path proportional to each curve's irradiance
  std::vector<double> light;  // irradiance of each curve, W/m2
  Eigen::VectorXd residual;
};

// Selects at most kMostCurves curves, evenly over all.
std::vector<int> SomeOf(int curves) {
  std::vector<int> some;
  const int count = std::min(curves, kMostCurves);
  some.reserve(count);
  for (int k = 0; k < count; ++k) some.push_back(static_cast<int>(1LL * k * curves / count));
  return some;
}

std::vector<int> EveryOther(const std::vector<int>& all, std::size_t from) {
  std::vector<int> some;
  for (std::size_t k = from; k < all.size(); k += 2) some.push_back(all[k]);
  return some;
}

void AppendCurve(const JointProblem& problem, const JointPoint& point, int c, Rows* rows) {
  const JointCurve& curve = problem.curves[c];
  const Device& device = DeviceOf(problem, c);
  const std::vector<double> p = DeviceAt(problem, point, c);
  const double voc = FindKeyPoints(curve.voltage_V, curve.current_A).open_circuit_voltage_V;
  const std::size_t before = rows->shape.readings.path.size();
  AppendErrorShape({device, problem.objective, curve.voltage_V, curve.current_A, curve.weight,
                    voc > 0 ? voc : problem.voltage_scale_V, p},
                   c, &rows->shape.readings);
  // The independent error of a reading is that of a point of weight 1, divided by the root of the
  // reading's weight.
  std::vector<double>& current = rows->shape.readings.current;
  for (std::size_t k = before; k < current.size(); ++k) {
    current[k] /= std::sqrt(curve.weight[k - before]);
  }
  rows->light.push_back(curve.irradiance_W_m2);
  if (!problem.translation.extended) return;
  // The photocurrent of a device with effects is that at the reference irradiance.
  const double suns = curve.irradiance_W_m2 / kReferenceIrradiance_W_m2;
  std::vector<double>& path = rows->shape.readings.path;
  for (std::size_t k = before; k < path.size(); ++k) path[k] *= suns;
}

// The shape with a path proportional to that power of the irradiance, and unchanged at `brightest`.
FamilyErrorShape WithPower(const Rows& rows, double brightest, double power) {
  FamilyErrorShape shape = rows.shape;
  for (std::size_t c = 0; c + 1 < shape.first.size(); ++c) {
    const double light = rows.light[c] / brightest;
    if (!(light > 0)) continue;  // a dark curve has no path
    const double factor = std::pow(light, power - 1);
    for (int k = shape.first[c]; k < shape.first[c + 1]; ++k) shape.readings.path[k] *= factor;
  }
  return shape;
}

// Rows of the given curves. An error of a curve that the fit has as an unknown is not an error of
// its rows. Priors are rows of the problem but not of readings, and are dropped.
Rows RowsOf(JointProblem problem, const JointPoint& point, const std::vector<bool>& active) {
  Rows rows;
  std::vector<bool> has_light, has_temperature;
  for (JointCurve& curve : problem.curves) {
    has_light.push_back(curve.irradiance_sd > 0);
    has_temperature.push_back(curve.temperature_sd_K > 0);
    const bool none = problem.translation.extended.has_value();
    curve.irradiance_sd = curve.temperature_sd_K = none ? 0 : kInfinity;
  }
  const FamilyModel model(problem);
  const Linearization now = Linearize(model, model.Pack(point), active);
  rows.residual = now.residual;
  rows.shape.common = RowMatrix::Zero(now.residual.size(), 2);
  for (std::size_t c = 0; c < problem.curves.size(); ++c) {
    rows.shape.first.push_back(now.first_row[c]);
    AppendCurve(problem, point, static_cast<int>(c), &rows);
    const RowMatrix& local = now.local[c];
    if (local.cols() < 2) continue;
    auto common = rows.shape.common.middleRows(now.first_row[c], local.rows());
    if (!has_light[c]) common.col(0) = local.col(0);
    if (!has_temperature[c]) common.col(1) = local.col(1);
  }
  rows.shape.first.push_back(static_cast<int>(now.residual.size()));
  return rows;
}

JointProblem Only(const JointProblem& problem, const std::vector<int>& curves) {
  JointProblem some = problem;
  some.curves.clear();
  for (const int c : curves) some.curves.push_back(problem.curves[c]);
  return some;
}

JointPoint Only(const JointPoint& point, const std::vector<int>& curves) {
  JointPoint some{point.shared, {}};
  for (const int c : curves) some.local.push_back(point.local[c]);
  return some;
}

// Log likelihood of the residuals under the error sizes. If the sizes were found from the same
// residuals (`same`), it is penalised by 1 for each size used.
double Score(const FamilyErrorShape& shape, const FamilyErrorSizes& sizes,
             const Eigen::VectorXd& residual, bool same) {
  const double used[] = {sizes.readings.voltage_V, sizes.readings.path, sizes.irradiance,
                         sizes.temperature_K};
  const auto count =
      std::count_if(std::begin(used), std::end(used), [](double s) { return s > 0; });
  return LogLikelihood(shape, sizes, residual) - (same ? static_cast<double>(count) : 0);
}

FamilyErrorSizes SizesOf(FamilyErrorKind kind, double power, const Rows& rows, double brightest,
                         const JointProblem& problem) {
  return FindFamilyErrors(kind, WithPower(rows, brightest, power), problem.current_scale_A,
                          problem.voltage_scale_V, rows.residual);
}

// Error sizes are found from the rows `found` and tested on the rows `tried`. Both are the same
// object or are of different curves.
struct Trial {
  const Rows& found;
  const Rows& tried;
};

// Selects the kind of errors and the power of the irradiance with the largest total score over all
// trials. Leaves the sizes unset.
FamilyErrors ChooseErrors(const std::vector<Trial>& trials, double brightest,
                          const JointProblem& problem) {
  FamilyErrors best;
  double highest = -HUGE_VAL, independent = 0;
  for (const FamilyErrorKind kind :
       {FamilyErrorKind::kIndependent, FamilyErrorKind::kPath, FamilyErrorKind::kCurves}) {
    for (const double power : {1.0, 0.5, 0.0}) {
      if (kind == FamilyErrorKind::kIndependent && power < 1) continue;
      double score = 0;
      for (const Trial& trial : trials) {
        const FamilyErrorSizes sizes = SizesOf(kind, power, trial.found, brightest, problem);
        score += Score(WithPower(trial.tried, brightest, power), sizes, trial.tried.residual,
                       &trial.found == &trial.tried);
      }
      if (kind == FamilyErrorKind::kIndependent) independent = score;
      constexpr double kClear = 3;        // gain in ln likelihood required of a richer kind
      constexpr double kOneLight = 1e-6;  // of powers, which are equal at one irradiance
      if (!(score > highest + (kind == best.kind ? kOneLight : kClear))) continue;
      highest = score;
      best = {kind, {}, power, FamilyErrorJudge::kFitted, 0, 2 * (score - independent)};
    }
  }
  return best;
}

// Returns the product with the covariance of all rows of a joint model: that of its readings, and a
// diagonal for priors.
CovarianceProduct ProductOf(const JointProblem& problem, const FitModel& model, const Rows& rows,
                            const FamilyErrorSizes& sizes) {
  return [&](const RowMatrix& all) {
    RowMatrix product = problem.noise_A * problem.noise_A * all;
    RowMatrix readings(rows.residual.size(), all.cols());
    const auto each = [&](const auto& move) {
      int row = 0;
      for (std::size_t c = 0; c + 1 < rows.shape.first.size(); ++c) {
        const int first = rows.shape.first[c];
        move(row, first, rows.shape.first[c + 1] - first);
        row += model.shape().blocks[c].residuals;
      }
    };
    each([&](int row, int first, int count) {
      readings.middleRows(first, count) = all.middleRows(row, count);
    });
    readings = CovarianceTimes(rows.shape, sizes, readings);
    each([&](int row, int first, int count) {
      product.middleRows(row, count) = readings.middleRows(first, count);
    });
    return product;
  };
}

std::vector<Interval> IntervalsUnder(const Spread& spread, double t,
                                     const std::vector<Estimate>& estimates) {
  std::vector<Interval> intervals;
  intervals.reserve(estimates.size());
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const Estimate& e = estimates[i];
    intervals.push_back(
        SymmetricInterval(e.refined, spread.standard_error[i], t, e.info.kind, e.bounds));
  }
  return intervals;
}

}  // namespace

FamilyErrorIntervals FindFamilyIntervals(const ReportedFit& fit, const JointProblem& rest,
                                         const JudgedEnd& judged) {
  constexpr int kFewest = 3;        // fewest curves that show an error common to a curve
  constexpr double kExact = 1e-11;  // relative to the currents: rounding errors only
  const JointProblem& problem = fit.problem;
  JointPoint point = fit.end.point;
  std::copy(judged.refined.begin(), judged.refined.end(), point.shared.begin());
  const int curves = static_cast<int>(problem.curves.size());
  if (curves < kFewest || !(judged.noise_A > kExact * problem.current_scale_A)) return {};
  const auto rows_of = [&](const std::vector<int>& some) {
    return RowsOf(Only(problem, some), Only(point, some), fit.end.active);
  };
  const std::vector<int> some = SomeOf(curves);
  const Rows rows = rows_of(some);
  const double brightest = *std::max_element(rows.light.begin(), rows.light.end());
  const int tested = std::min(static_cast<int>(rest.curves.size()), kMostCurves);
  FamilyErrors errors;
  if (tested >= kFewest) {
    const JointPoint there{point.shared, std::vector<JointLocal>(tested, {0, 0})};
    const Rows others =
        RowsOf(Only(rest, SomeOf(static_cast<int>(rest.curves.size()))), there, fit.end.active);
    errors = ChooseErrors({{rows, others}}, brightest, problem);
    errors.judge = FamilyErrorJudge::kHeldOut;
    errors.tested_curves = tested;
  } else if (static_cast<int>(some.size()) >= 2 * kFewest) {
    const Rows even = rows_of(EveryOther(some, 0)), odd = rows_of(EveryOther(some, 1));
    errors = ChooseErrors({{even, odd}, {odd, even}}, brightest, problem);
    errors.judge = FamilyErrorJudge::kHalves;
    errors.tested_curves = static_cast<int>(some.size());
  } else {
    errors = ChooseErrors({{rows, rows}}, brightest, problem);
  }
  errors.sizes = SizesOf(errors.kind, errors.path_power, rows, brightest, problem);
  if (errors.kind == FamilyErrorKind::kIndependent) return {errors, {}};
  Rows all = RowsOf(problem, point, fit.end.active);
  all.shape = WithPower(all, brightest, errors.path_power);
  const Spread spread = FindSpread(fit.model, fit.best, fit.best.active,
                                   ProductOf(problem, fit.model, all, errors.sizes));
  return {errors, IntervalsUnder(spread, StudentT95(curves - 1), judged.estimate.estimates)};
}

}  // namespace lyrefit
