#include "lyrefit/family/key_point_errors.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

#include "lyrefit/base/roots.h"
#include "lyrefit/estimate/refine/error_sizes.h"
#include "lyrefit/estimate/refine/spread.h"
#include "lyrefit/family/family_model.h"

namespace lyrefit {
namespace {

// The level of each value; a level reaches from its lowest value `reach` up.
std::vector<int> LevelsOf(const std::vector<double>& values, double reach) {
  std::vector<int> order(values.size()), level(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return values[a] < values[b]; });
  int now = -1;
  double first = -kInfinity;
  for (const int c : order) {
    if (values[c] > first + reach) {
      ++now;
      first = values[c];
    }
    level[c] = now;
  }
  return level;
}

}  // namespace

std::optional<KeyPointRowsOf> RowsOfKeyPoints(const JointProblem& problem, const JointPoint& point,
                                              const std::vector<bool>& active,
                                              const std::vector<bool>& fitted) {
  constexpr double kSameTemperature_K = 2, kSameLight = 0.04;
  JointProblem free = problem;
  std::array<std::vector<double>, 2> conditions;
  for (JointCurve& curve : free.curves) {
    if (!curve.key_points || !OwnUnknowns(curve).empty()) return std::nullopt;
    curve.irradiance_sd = curve.temperature_sd_K = kInfinity;
    conditions[0].push_back(curve.temperature_K);
    conditions[1].push_back(std::log(curve.irradiance_W_m2));
  }
  const std::array<std::vector<int>, 2> level = {LevelsOf(conditions[0], kSameTemperature_K),
                                                 LevelsOf(conditions[1], kSameLight)};
  const FamilyModel model(free);
  Linearization now = Linearize(model, model.Pack(point), active);
  KeyPointRowsOf rows;
  rows.residual = now.residual;
  rows.log_light = Eigen::VectorXd::Zero(now.residual.size());
  for (int which = 0; which < 2; ++which) {
    const int levels = *std::max_element(level[which].begin(), level[which].end()) + 1;
    rows.by_level[which] = RowMatrix::Zero(now.residual.size(), levels);
  }
  for (std::size_t c = 0; c < free.curves.size(); ++c) {
    const int first = now.first_row[c];
    const RowMatrix by_own = now.local[c];  // ln(light), K
    rows.first.push_back(first);
    rows.log_light.segment(first, by_own.rows())
        .setConstant(std::log(free.curves[c].irradiance_W_m2 / kReferenceIrradiance_W_m2));
    for (int k = 0; k < kKeyPointRows; ++k) {
      if (std::isfinite(free.curves[c].key_points->value[k])) rows.kind.push_back(k);
    }
    for (int which = 0; which < 2; ++which) {
      rows.by_level[which].col(level[which][c]).segment(first, by_own.rows()) =
          by_own.col(1 - which);
    }
    if (!fitted.empty() && !fitted[c]) now.jacobian.middleRows(first, by_own.rows()).setZero();
    now.local[c].resize(by_own.rows(), 0);
  }
  rows.first.push_back(static_cast<int>(now.residual.size()));
  rows.influence = InfluenceOf(now);
  rows.jacobian = std::move(now.jacobian);
  return rows;
}

namespace {

// Variance of a linear function of the errors, for each error of size 1.
using ErrorParts = std::array<double, kErrorParts>;

// Factor of the error of a row under a power of light.
double Dimming(const KeyPointRowsOf& rows, Eigen::Index r, double power) {
  const bool dims = rows.kind[r] == kIscRow || rows.kind[r] == kPmpRow;
  return dims ? std::exp(power * rows.log_light[r]) : 1;
}

ErrorParts PartsOf(const KeyPointRowsOf& rows, const Eigen::VectorXd& weight, double power) {
  ErrorParts parts = {};
  for (Eigen::Index r = 0; r < weight.size(); ++r) {
    const double own = weight[r] * Dimming(rows, r, power);
    parts[rows.kind[r]] += own * own;
  }
  for (int which = 0; which < 2; ++which) {
    parts[kKeyPointRows + which] = TransposedTimes(rows.by_level[which], weight).squaredNorm();
  }
  return parts;
}

}  // namespace

namespace {

constexpr std::array<double, 2> kUsualShared = {0.3, 0.002};  // K, part: scales of the priors
// Sizes of shared errors in units of those of the priors.
constexpr double kSharedGrid[] = {0, 0.25, 0.5, 0.75, 1, 1.5, 2, 2.75, 3.75, 5, 7, 10};
constexpr int kGridSize = static_cast<int>(std::size(kSharedGrid));

// The part of the axis that a grid size stands for.
double GridWidth(int i) {
  return 0.5 * (kSharedGrid[std::min(i + 1, kGridSize - 1)] - kSharedGrid[std::max(i - 1, 0)]);
}

double LogHalfCauchy(int which, double size) {
  const double part = size / kUsualShared[which];
  return -std::log1p(part * part);
}

}  // namespace

// ln of the restricted likelihood of sizes. Products of all columns are taken once for each kind.
class RestrictedLikelihood {
 public:
  RestrictedLikelihood(const KeyPointRowsOf& rows, const std::array<bool, 2>& seen, double power) {
    const Eigen::MatrixXd basis = RankedBasis(Eigen::MatrixXd(rows.jacobian));
    for (int which = 0; which < 2; ++which) {
      levels_[which] = seen[which] ? static_cast<int>(rows.by_level[which].cols()) : 0;
    }
    const Eigen::Index shared = levels_[0] + levels_[1], rest = basis.cols() + 1;
    for (int k = 0; k < kKeyPointRows; ++k) {
      std::vector<int> own;
      for (std::size_t r = 0; r < rows.kind.size(); ++r) {
        if (rows.kind[r] == k && !rows.jacobian.row(r).isZero(0))
          own.push_back(static_cast<int>(r));
      }
      Eigen::MatrixXd columns(own.size(), shared + rest);
      for (std::size_t i = 0; i < own.size(); ++i) {
        auto row = columns.row(static_cast<Eigen::Index>(i));
        if (levels_[0] > 0) row.head(levels_[0]) = rows.by_level[0].row(own[i]);
        if (levels_[1] > 0) row.segment(levels_[0], levels_[1]) = rows.by_level[1].row(own[i]);
        row.segment(shared, basis.cols()) = basis.row(own[i]);
        row[shared + basis.cols()] = rows.residual[own[i]];
        const double factor = Dimming(rows, own[i], power);
        row /= factor;
        logs_ += 2 * std::log(factor);
      }
      count_[k] = static_cast<double>(own.size());
      products_[k] = TransposedTimes(columns, columns);
    }
  }

  // By Woodbury's formula; one Cholesky factor has both determinants and, at its end, the sum of
  // squares.
  double At(const std::array<double, kKeyPointRows>& kinds,
            const std::array<double, 2>& shared) const {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(products_[0].rows(), products_[0].cols());
    double logs = logs_;
    for (int k = 0; k < kKeyPointRows; ++k) {
      sum += products_[k] / (kinds[k] * kinds[k]);
      logs += 2 * count_[k] * std::log(kinds[k]);
    }
    for (int i = 0; i < levels_[0] + levels_[1]; ++i) {
      const double size = shared[i < levels_[0] ? 0 : 1];
      sum.row(i) *= size;
      sum.col(i) *= size;
      sum(i, i) += 1;
    }
    const Eigen::MatrixXd root = LowerRoot(sum);
    const Eigen::Index last = root.rows() - 1;
    for (Eigen::Index i = 0; i < last; ++i) logs += 2 * std::log(root(i, i));
    const double value = -0.5 * (logs + root(last, last) * root(last, last));
    return std::isnan(value) ? -HUGE_VAL : value;
  }

 private:
  std::array<int, 2> levels_ = {};
  std::array<double, kKeyPointRows> count_ = {};
  double logs_ = 0;  // of the factors of rows, twice
  std::array<Eigen::MatrixXd, kKeyPointRows> products_;
};

namespace {

// ln of likelihood times priors of the logarithms of all sizes. `known`: sizes of shared errors that
// are stated; NaN: sought.
struct SizePosterior {
  const RestrictedLikelihood& likelihood;
  double noise;
  std::array<double, 2> known;

  double operator()(const std::vector<double>& logs) const {
    constexpr double kWidthOfKinds = 1;  // of ln(size), about the common one
    std::array<double, kKeyPointRows> kinds;
    double prior = 0;
    for (int k = 0; k < kKeyPointRows; ++k) {
      kinds[k] = std::exp(logs[k]);
      prior -= 0.5 * std::pow((logs[k] - std::log(noise)) / kWidthOfKinds, 2);
    }
    std::array<double, 2> shared = known;
    for (int which = 0; which < 2; ++which) {
      const double log = logs[kKeyPointRows + which];
      prior += log + LogHalfCauchy(which, std::exp(log));
      if (std::isnan(known[which])) shared[which] = std::exp(log);
    }
    return likelihood.At(kinds, shared) + prior;
  }
};

// Where the posterior is largest.
std::vector<double> MostLikely(const SizePosterior& posterior) {
  constexpr int kMostSteps = 30;
  std::vector<double> best;
  for (const double part : {1.0, 0.1}) {
    std::vector<double> start(kErrorParts, std::log(posterior.noise));
    for (int which = 0; which < 2; ++which) {
      start[kKeyPointRows + which] = std::log(part * kUsualShared[which]);
    }
    std::vector<double> end = NewtonAscent(posterior, std::move(start), kMostSteps);
    if (best.empty() || posterior(end) > posterior(best)) best = std::move(end);
  }
  return best;
}

}  // namespace

KeyPointErrorSizes::KeyPointErrorSizes(const KeyPointRowsOf& rows, double noise,
                                       const KeyPointErrors& stated) {
  constexpr double kClearGain = 1;  // of ln likelihood, by another power of light
  for (int which = 0; which < 2; ++which) seen_[which] = rows.by_level[which].cols() > 1;
  const std::array<double, 2> known = {seen_[0] ? stated.temperature_K : 0,
                                       seen_[1] ? stated.irradiance : 0};
  std::optional<RestrictedLikelihood> likelihood;
  double highest = -HUGE_VAL;
  for (const double power : {0.0, -0.5, 0.5}) {
    RestrictedLikelihood one(rows, seen_, power);
    const SizePosterior posterior{one, noise, known};
    const std::vector<double> logs = MostLikely(posterior);
    const double value = posterior(logs) - (power == 0 ? 0 : kClearGain);
    if (!(value > highest)) continue;
    highest = value;
    power_ = power;
    const Eigen::MatrixXd curvature = CurvatureAt(posterior, logs);
    for (int k = 0; k < kKeyPointRows; ++k) {
      kinds_[k] = std::exp(logs[k]);
      // ln(size) of a chi-square of f degrees of freedom has the variance 1 / (2 f).
      degrees_[k] = std::max(-0.5 * curvature(k, k), 1.0);
    }
    likelihood = std::move(one);
  }
  if (likelihood) FillGrid(*likelihood, known);
}

void KeyPointErrorSizes::FillGrid(const RestrictedLikelihood& likelihood,
                                  const std::array<double, 2>& known) {
  constexpr double kNegligible = 1e-4;
  std::array<std::vector<std::pair<double, double>>, 2> axes;  // size, ln of its prior
  for (int which = 0; which < 2; ++which) {
    if (!std::isnan(known[which])) {
      axes[which] = {{known[which], 0}};
      continue;
    }
    for (int i = 0; i < kGridSize; ++i) {
      const double size = kSharedGrid[i] * kUsualShared[which];
      axes[which].push_back({size, LogHalfCauchy(which, size) + std::log(GridWidth(i))});
    }
  }
  double highest = -HUGE_VAL;
  for (const auto& [kelvin, prior] : axes[0]) {
    for (const auto& [light, prior_of_light] : axes[1]) {
      const double log = prior + prior_of_light + likelihood.At(kinds_, {kelvin, light});
      highest = std::max(highest, log);
      grid_.push_back({log, {kelvin, light}});
    }
  }
  for (GridPoint& one : grid_) one.weight = std::exp(one.weight - highest);
  const auto negligible = [](const GridPoint& one) { return one.weight < kNegligible; };
  grid_.erase(std::remove_if(grid_.begin(), grid_.end(), negligible), grid_.end());
}

double KeyPointErrorSizes::HalfWidth95(const KeyPointRowsOf& rows,
                                       const Eigen::VectorXd& weight) const {
  const ErrorParts parts = PartsOf(rows, weight, power_);
  double own = 0, own2 = 0;  // variance of the kinds' errors, and its own
  for (int k = 0; k < kKeyPointRows; ++k) {
    const double variance = parts[k] * kinds_[k] * kinds_[k];
    own += variance;
    own2 += variance * variance / degrees_[k];
  }
  double most = 0, weights = 0;
  std::vector<double> variance;
  for (const GridPoint& one : grid_) {
    variance.push_back(own + parts[kTemperatureError] * one.size[0] * one.size[0] +
                       parts[kLightError] * one.size[1] * one.size[1]);
    most = std::max(most, variance.back());
    weights += one.weight;
  }
  if (!(own > 0)) return 0;
  const auto outside = [&](double half) {
    double part = 0;
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      // Degrees of freedom by Satterthwaite 1946, doi:10.2307/3002019.
      const boost::math::students_t t(std::min(variance[i] * variance[i] / own2, 1e6));
      part += grid_[i].weight * 2 * cdf(t, -half / std::sqrt(variance[i]));
    }
    return part / weights - 0.05;
  };
  constexpr double kFar = 20;
  return RootBetween(outside, 0, kFar * std::sqrt(most));
}

double KeyPointErrorSizes::Size(int part) const {
  if (part < kKeyPointRows) return kinds_[part];
  const int which = part - kKeyPointRows;
  if (!seen_[which]) return kUnknown;
  double sum = 0, weights = 0;
  for (const GridPoint& one : grid_) {
    sum += one.weight * one.size[which];
    weights += one.weight;
  }
  return sum / weights;
}

KeyPointErrors FoundErrorsOf(const KeyPointErrorSizes& sizes, KeyPointErrors errors,
                             double key_point_scale_A) {
  errors.short_circuit_current *= sizes.Size(kIscRow) / key_point_scale_A;
  errors.open_circuit_voltage *= sizes.Size(kVocRow) / key_point_scale_A;
  errors.max_power_voltage *= sizes.Size(kVmpRow) / key_point_scale_A;
  errors.max_power *= sizes.Size(kPmpRow) / key_point_scale_A;
  errors.temperature_K = sizes.Size(kTemperatureError);
  errors.irradiance = sizes.Size(kLightError);
  return errors;
}

}  // namespace lyrefit
