#include "lyrefit/trend/clearness.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "lyrefit/curve/date_time.h"
#include "lyrefit/trend/time_model.h"

namespace lyrefit {
namespace {

constexpr double kQuantileOfClear = 0.93;
constexpr double kNight_W_m2 = 30;
constexpr double kMost_W_m2 = 1600;           // more is an error of the sensor
constexpr double kSeasons_days = 270;         // shorter series follow a line in place of the season
constexpr double kLeastForClear_days = 20;    // shorter ones tell no clear sky
constexpr Eigen::Index kLeastForClear = 100;  // rows
constexpr int kPowersOfHour = 5;

double PhaseOfDay(double time_s) { return 2 * M_PI * (time_s / kDay_s); }

// Hours of the day around the middle of the light, over their spread.
struct HourScale {
  double middle_rad = 0;
  double spread_rad = 1;

  double At(double time_s) const {
    constexpr double kMost = 1.3;
    const double off = std::remainder(PhaseOfDay(time_s) - middle_rad, 2 * M_PI);
    return std::clamp(off / spread_rad, -kMost, kMost);
  }
};

HourScale ScaleOf(const std::vector<const TrendRow*>& lit) {
  double x = 0, y = 0, sum = 0, square = 0;
  for (const TrendRow* row : lit) {
    x += row->irradiance_W_m2 * std::cos(PhaseOfDay(row->time_s));
    y += row->irradiance_W_m2 * std::sin(PhaseOfDay(row->time_s));
  }
  HourScale scale = {std::atan2(y, x), 1};
  for (const TrendRow* row : lit) {
    const double off = std::remainder(PhaseOfDay(row->time_s) - scale.middle_rad, 2 * M_PI);
    sum += row->irradiance_W_m2;
    square += row->irradiance_W_m2 * off * off;
  }
  constexpr double kHour_rad = 2 * M_PI / 24;
  scale.spread_rad = std::max(2 * std::sqrt(square / sum), kHour_rad);
  return scale;
}

struct ClearBasis {
  HourScale hours;
  double first_s = 0;
  double span_s = 1;

  Eigen::RowVectorXd At(double time_s) const {
    const bool seasons = span_s >= kSeasons_days * kDay_s;
    const double year = 2 * M_PI * time_s / (kYear_days * kDay_s);
    const double line = (time_s - first_s) / span_s;
    const std::vector<double> along =
        seasons ? std::vector<double>{1, std::cos(year), std::sin(year), std::cos(2 * year),
                                      std::sin(2 * year)}
                : std::vector<double>{1, line};
    Eigen::RowVectorXd out(kPowersOfHour * static_cast<Eigen::Index>(along.size()));
    Eigen::Index k = 0;
    for (double power : along) {
      for (int p = 0; p < kPowersOfHour; ++p, power *= hours.At(time_s)) out[k++] = power;
    }
    return out;
  }
};

Eigen::VectorXd FitQuantile(const Eigen::MatrixXd& x, const Eigen::VectorXd& y) {
  constexpr int kRounds = 60;
  constexpr double kFinest_W_m2 = 10;  // smaller residuals weigh alike
  constexpr double kRidge = 1e-9;      // where all rows are of one hour
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(y.size());
  Eigen::VectorXd found = Eigen::VectorXd::Zero(x.cols());
  for (int round = 0; round < kRounds; ++round) {
    Eigen::MatrixXd normal = x.transpose() * weights.asDiagonal() * x;
    normal.diagonal().array() += kRidge * static_cast<double>(y.size());
    found = normal.ldlt().solve(x.transpose() * weights.cwiseProduct(y));
    const Eigen::VectorXd off = y - x * found;
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      weights[i] = (off[i] > 0 ? kQuantileOfClear : 1 - kQuantileOfClear) /
                   std::max(std::fabs(off[i]), kFinest_W_m2);
    }
  }
  return found;
}

// The clear sky of a series.
class ClearSky {
 public:
  // None: `rows` do not tell it.
  static std::optional<ClearSky> Of(const std::vector<TrendRow>& rows) {
    std::vector<const TrendRow*> lit;
    for (const TrendRow& row : rows) {
      const bool light = row.irradiance_W_m2 > kNight_W_m2 && row.irradiance_W_m2 < kMost_W_m2;
      if (light && row.state != TrendRowState::kUnusable) lit.push_back(&row);
    }
    const auto count = static_cast<Eigen::Index>(lit.size());
    if (count < kLeastForClear) return std::nullopt;
    ClearSky sky;
    sky.basis_ = {ScaleOf(lit), lit.front()->time_s, lit.back()->time_s - lit.front()->time_s};
    if (sky.basis_.span_s < kLeastForClear_days * kDay_s) return std::nullopt;
    Eigen::MatrixXd x(count, sky.basis_.At(sky.basis_.first_s).size());
    Eigen::VectorXd y(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const TrendRow& row = *lit[static_cast<std::size_t>(i)];
      x.row(i) = sky.basis_.At(row.time_s);
      y[i] = row.irradiance_W_m2;
    }
    sky.coefficients_ = FitQuantile(x, y);
    return sky;
  }

  // In W/m2.
  double At(double time_s) const {
    return std::max(basis_.At(time_s).dot(coefficients_.transpose()), kNight_W_m2);
  }

  // The largest one of the day around `time_s`, W/m2.
  double LargestOfDay(double time_s) const {
    constexpr int kSteps = 20;
    const double off_rad = std::remainder(PhaseOfDay(time_s) - basis_.hours.middle_rad, 2 * M_PI);
    const double middle_s = time_s - off_rad / (2 * M_PI) * kDay_s;
    double largest = kNight_W_m2;
    for (int k = -kSteps; k <= kSteps; ++k) {
      const double part = basis_.hours.spread_rad / (2 * M_PI) * k / kSteps;
      largest = std::max(largest, At(middle_s + part * kDay_s));
    }
    return largest;
  }

 private:
  ClearBasis basis_;
  Eigen::VectorXd coefficients_;
};

}  // namespace

void FindSky(std::vector<TrendRow>* rows) {
  const std::optional<ClearSky> sky = ClearSky::Of(*rows);
  if (!sky) return;
  double day = kUnknown, largest = 1;
  for (TrendRow& row : *rows) {
    if (!std::isfinite(row.irradiance_W_m2) || !std::isfinite(row.time_s)) continue;
    const double own = std::floor(row.time_s / kDay_s);
    if (own != day) largest = sky->LargestOfDay(row.time_s);
    day = own;
    const double clear = sky->At(row.time_s);
    row.clearness = std::clamp(row.irradiance_W_m2 / clear, 0.0, 1.0);
    row.height = std::min(clear / largest, 1.0);
  }
}

}  // namespace lyrefit
