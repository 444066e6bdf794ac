// Errors that are correlated over a few neighbouring readings: coverage and length of intervals,
// and spread of estimates.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "lyrefit/estimate/fit/fit.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

constexpr int kCurves = 200;
constexpr double kSize_A = 4e-3;  // about 0.1 % of Isc

// 60 readings with first-order autoregressive errors; `kept` is the correlation of neighbours.
IvCurve CurveWith(double kept, int seed) {
  IvCurve curve = ModuleCurve(Model::kSingleDiode, kSingleTruth, 0);
  RandomStream random(seed, 0);
  double error = random.Normal();
  for (std::size_t k = 0; k < curve.size(); ++k) {
    if (k > 0) error = kept * error + std::sqrt(1 - kept * kept) * random.Normal();
    curve.current_A[k] += kSize_A * error;
  }
  return curve;
}

// Transforms an estimate to the scale on which it is closest to normal: ln Is and 1 / Rsh.
double OnScale(int i, double value) {
  return i == 1 ? std::log(value) : i == 4 ? 1 / value : value;
}

struct Tally {
  int holds = 0;
  double squares = 0;
  std::vector<double> lengths;

  void Add(int i, const Estimate& e) {
    holds += e.low_95 <= kSingleTruth[i] && kSingleTruth[i] <= e.high_95 ? 1 : 0;
    squares += std::pow(OnScale(i, e.refined) - OnScale(i, kSingleTruth[i]), 2);
    lengths.push_back(std::fabs(OnScale(i, e.high_95) - OnScale(i, e.low_95)));
  }
  double Spread() const { return std::sqrt(squares / kCurves); }
  double Percent() const { return 100.0 * holds / kCurves; }
  // Median interval length relative to an exact 95 % interval.
  double Length() {
    std::nth_element(lengths.begin(), lengths.begin() + kCurves / 2, lengths.end());
    return lengths[kCurves / 2] / (2 * 1.96 * Spread());
  }
};

class ShortPath : public ::testing::TestWithParam<double> {};

TEST_P(ShortPath, IsFoundAndCostsLittle) {
  Tally plain[5], offered[5], weighed[5];
  int believed = 0;
  for (int seed = 1; seed <= kCurves; ++seed) {
    const IvCurve curve = CurveWith(GetParam(), seed);
    FitOptions options;
    options.random_baseline = false;
    const auto white = Fit(curve, options);
    options.errors = {ErrorKind::kField, {}, "field"};
    const auto field = Fit(curve, options);
    ASSERT_TRUE(white && field);
    believed += white->errors->believed ? 1 : 0;
    for (int i = 0; i < 5; ++i) {
      plain[i].Add(i, white->estimates[i]);
      offered[i].Add(i, white->errors->believed ? white->under_errors[i] : white->estimates[i]);
      weighed[i].Add(i, field->estimates[i]);
    }
  }
  fmt::print("correlation {}: the error model is believed in {} of {} curves\n", GetParam(),
             believed, kCurves);
  for (int i = 0; i < 5; ++i) {
    const double ratio = weighed[i].Spread() / plain[i].Spread();
    const double length = offered[i].Length(), field_length = weighed[i].Length();
    fmt::print(
        "  {:4} truth held, %: plain {:5.1f}, offered {:5.1f}, field {:5.1f}; spread field / plain "
        "{:.2f}; length: plain {:.2f}, offered {:.2f}, field {:.2f}\n",
        std::vector<const char*>{"Iph", "Is", "n", "Rs", "Rsh"}[i], plain[i].Percent(),
        offered[i].Percent(), weighed[i].Percent(), ratio, plain[i].Length(), length, field_length);
    EXPECT_LT(ratio, 1.15) << i;
    if (GetParam() < 0.4) continue;  // too weak to be detected in every curve
    EXPECT_GE(offered[i].Percent(), 92) << i;
    EXPECT_GE(weighed[i].Percent(), 86) << i;
    EXPECT_LT(length, 2.5) << i;
    EXPECT_LT(field_length, 2.5) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Correlations, ShortPath, ::testing::Values(0.3, 0.5, 0.8));

}  // namespace
}  // namespace lyrefit
