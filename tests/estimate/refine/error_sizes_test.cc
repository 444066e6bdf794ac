#include "lyrefit/estimate/refine/error_sizes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/base/random.h"

namespace lyrefit {
namespace {

constexpr double kIsc = 8, kVoc = 40;

// A curve of `points` readings that is flat, then falls.
ErrorShape SyntheticShape(int points) {
  ErrorShape shape;
  for (int k = 0; k < points; ++k) {
    const double u = static_cast<double>(k) / (points - 1);
    shape.current.push_back(1);
    shape.voltage.push_back(0.01 + 5 * std::exp(12 * (u - 1)));
    shape.path.push_back(kIsc * (1 - 0.5 * std::exp(12 * (u - 1))));
    shape.position.push_back(u);
    shape.chain.push_back(0);
  }
  return shape;
}

// Five smooth functions as parameter derivatives, which a fit removes from the residual.
RowMatrix SyntheticJacobian(int points) {
  RowMatrix jacobian(points, 5);
  for (int k = 0; k < points; ++k) {
    const double u = static_cast<double>(k) / (points - 1);
    jacobian.row(k) << 1, u, std::exp(8 * (u - 1)), std::exp(12 * (u - 1)), std::exp(16 * (u - 1));
  }
  return jacobian;
}

Eigen::VectorXd DrawErrors(const ErrorShape& shape, const ErrorSizes& sizes, int seed) {
  RandomStream random(seed, 0);
  Eigen::VectorXd errors(shape.current.size());
  double state = random.Normal();
  for (Eigen::Index k = 0; k < errors.size(); ++k) {
    if (k > 0) {
      const double kept = std::exp((shape.position[k - 1] - shape.position[k]) / sizes.length);
      state = kept * state + std::sqrt(1 - kept * kept) * random.Normal();
    }
    const double own = shape.stated.empty() ? sizes.current_A * shape.current[k] : shape.stated[k];
    errors[k] = own * random.Normal() + sizes.voltage_V * shape.voltage[k] * random.Normal() +
                sizes.path * shape.path[k] * state;
  }
  return errors;
}

TEST(ErrorSizes, AreFoundFromErrorsOfThatSize) {
  const ErrorShape shape = SyntheticShape(150);
  const RowMatrix jacobian = SyntheticJacobian(150);
  const ErrorSizes truth = {8e-4, 0.012, 1.5e-3};
  constexpr int kDraws = 40;
  double current = 0, voltage = 0, path = 0, length = 0;  // mean squares; length: mean of ln
  for (int seed = 0; seed < kDraws; ++seed) {
    const FoundErrors found =
        FindErrorSizes(shape, UsualErrors(kIsc, kVoc), DrawErrors(shape, truth, seed), jacobian);
    current += std::pow(found.sizes.current_A / truth.current_A, 2) / kDraws;
    voltage += std::pow(found.sizes.voltage_V / truth.voltage_V, 2) / kDraws;
    // For a path as long as the sweep, only differences between neighbours are determined: the
    // ratio of its squared size and its length.
    path += std::pow(found.sizes.path / truth.path, 2) / found.sizes.length / kDraws;
    length += std::log(found.sizes.length) / kDraws;
    EXPECT_GT(found.gain, 20) << seed;
  }
  EXPECT_NEAR(current, 1, 0.15);
  EXPECT_NEAR(voltage, 1, 0.15);
  EXPECT_NEAR(path, 1, 0.15);
  EXPECT_NEAR(length, 0, 1);
}

TEST(ErrorSizes, ALengthOfAFewReadingsIsFound) {
  const ErrorShape shape = SyntheticShape(150);
  const RowMatrix jacobian = SyntheticJacobian(150);
  const ErrorSizes truth = {1e-4, 1e-3, 1.5e-3, 0.02};
  constexpr int kDraws = 40;
  double path = 0, length = 0;  // mean of ln
  for (int seed = 0; seed < kDraws; ++seed) {
    const FoundErrors found =
        FindErrorSizes(shape, UsualErrors(kIsc, kVoc), DrawErrors(shape, truth, seed), jacobian);
    path += std::log(found.sizes.path / truth.path) / kDraws;
    length += std::log(found.sizes.length / truth.length) / kDraws;
    EXPECT_GT(found.uncertainty(3, 3), 0);
  }
  EXPECT_NEAR(path, 0, 0.1);
  EXPECT_NEAR(length, 0, 0.3);
}

TEST(ErrorSizes, WhiteErrorsDoNotAskForMore) {
  const ErrorShape shape = SyntheticShape(100);
  const RowMatrix jacobian = SyntheticJacobian(100);
  int asked = 0;
  for (int seed = 0; seed < 200; ++seed) {
    const Eigen::VectorXd errors = DrawErrors(shape, {8e-3, 0, 0}, seed);
    const FoundErrors found = FindErrorSizes(shape, UsualErrors(kIsc, kVoc), errors, jacobian);
    // A path of a few readings is hard to distinguish from white noise.
    const bool short_path = found.sizes.length < 3 * shape.position[1];
    const double path_A = short_path ? kIsc * found.sizes.path : 0;
    EXPECT_NEAR(std::hypot(found.sizes.current_A, path_A), 8e-3, 2.5e-3);
    EXPECT_LT(found.sizes.path, 3e-3);
    asked += found.gain > 5 ? 1 : 0;
  }
  EXPECT_LE(asked, 10);
}

TEST(ErrorSizes, ArePulledDownWhereReadingsAreFarBetterThanUsual) {
  const ErrorShape shape = SyntheticShape(150);
  const ErrorSizes truth = {2e-6, 1e-5, 5e-6};
  const FoundErrors found = FindErrorSizes(shape, UsualErrors(kIsc, kVoc),
                                           DrawErrors(shape, truth, 3), SyntheticJacobian(150));
  EXPECT_LT(found.sizes.path, 2e-5);
  EXPECT_LT(found.sizes.current_A, 1e-5);
}

TEST(ErrorSizes, WithoutInformationThePriorIsTheAnswer) {
  ErrorShape shape = SyntheticShape(60);
  shape.path.assign(60, 0.0);
  const ErrorPrior prior = UsualErrors(kIsc, kVoc);
  const FoundErrors found =
      FindErrorSizes(shape, prior, DrawErrors(shape, {1e-3, 0.01, 0}, 1), SyntheticJacobian(60));
  EXPECT_NEAR(found.sizes.path / prior.center.path, 1, 0.01);
}

TEST(ErrorSizes, APathThatIsNotUsualHasToShow) {
  const ErrorShape shape = SyntheticShape(100);
  const RowMatrix jacobian = SyntheticJacobian(100);
  ErrorPrior prior = UsualErrors(kIsc, kVoc);
  prior.path_is_usual = false;
  constexpr int kDraws = 40;
  int shown = 0, without = 0;
  double voltage = 0;  // mean square
  for (int seed = 0; seed < kDraws; ++seed) {
    const auto find = [&](const ErrorSizes& truth) {
      return FindErrorSizes(shape, prior, DrawErrors(shape, truth, seed), jacobian);
    };
    const FoundErrors independent = find({8e-4, 0.012, 0});
    without += independent.sizes.path == 0 ? 1 : 0;
    voltage += std::pow(independent.sizes.voltage_V / 0.012, 2) / kDraws;
    shown += find({8e-4, 0.012, 3e-3}).sizes.path > 0 ? 1 : 0;
  }
  EXPECT_GE(without, 0.9 * kDraws);
  EXPECT_GE(shown, 0.9 * kDraws);
  EXPECT_NEAR(voltage, 1, 0.2);
}

TEST(ErrorSizes, StatedSizesOfCurrentsAreBelieved) {
  ErrorShape shape = SyntheticShape(150);
  shape.stated.assign(150, 2e-3);
  const ErrorModel errors = MakeErrorModel(shape, {1, 0, 1e-3});
  for (const double white : errors.white) EXPECT_DOUBLE_EQ(white, 2e-3);
  const ErrorSizes truth = {0, 0.012, 1.5e-3};
  const FoundErrors found = FindErrorSizes(shape, UsualErrors(kIsc, kVoc),
                                           DrawErrors(shape, truth, 5), SyntheticJacobian(150));
  EXPECT_NEAR(std::log(found.sizes.path / truth.path), 0, 0.4);
}

TEST(NewtonAscent, FindsTheTopOfASmoothHill) {
  const auto hill = [](const std::vector<double>& x) {
    return -std::cosh(x[0] - 1) - 0.5 * std::pow(x[1] + 2 - 0.5 * x[0], 2);
  };
  const std::vector<double> top = NewtonAscent(hill, {-4, 5}, 50);
  EXPECT_NEAR(top[0], 1, 1e-3);
  EXPECT_NEAR(top[1], -1.5, 1e-3);
}

}  // namespace
}  // namespace lyrefit
