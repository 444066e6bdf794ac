#include "lyrefit/certify/cause_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lyrefit/base/random.h"

namespace lyrefit {
namespace {

struct NamedShape {
  const char* name;
  CauseShape shape;
};

std::vector<NamedShape> AllShapes() {
  return {{"collection", CollectionShape(1, 1)},
          {"diode", DiodeShape(19.5, 0.6, 1)},
          {"power", PowerShape(0.6, {1.3, 5}, 1)}};
}

double Within(double low, double high, RandomStream* random) {
  return low + (high - low) * random->Uniform();
}

Span SomeSpan(double low, double high, RandomStream* random) {
  const double a = Within(low, high, random), b = Within(low, high, random);
  return {std::min(a, b), std::max(a, b)};
}

Span SomeTheta(const CauseShape& shape, RandomStream* random) {
  return random->Uniform() < 0.3 ? Span{shape.theta.lower, shape.theta.lower}
                                 : SomeSpan(shape.theta.lower, shape.theta.upper, random);
}

void ExpectWithin(double value, Span range, const char* what) {
  const double rounding = 1e-12 * (1 + std::fabs(value));
  EXPECT_GE(value, range.lower - rounding) << what;
  EXPECT_LE(value, range.upper + rounding) << what;
}

TEST(CauseShapes, StartAtNothingNeverFallAndAreConvexAtForwardVoltages) {
  for (const auto& [name, shape] : AllShapes()) {
    for (const double theta : {shape.theta.lower, shape.theta.upper}) {
      EXPECT_NEAR(shape.value(0, theta), 0, 1e-15) << name;
      double before = 0;
      for (double v = -2; v < 1.2; v += 0.01) {
        const double slope = (shape.value(v + 1e-6, theta) - shape.value(v - 1e-6, theta)) / 2e-6;
        const bool bent = std::fabs(v) < 0.005 || std::fabs(v - 0.87) < 0.005;
        EXPECT_NEAR(shape.slope(v, theta), slope, bent ? 0.05 : 1e-5 * (1 + slope)) << name << v;
        EXPECT_GE(slope, 0) << name << " at " << v;
        EXPECT_TRUE(v < 0.02 || slope >= before * (1 - 1e-6)) << name << " at " << v;
        before = v > 0 ? slope : 0;
      }
    }
  }
}

TEST(CauseShapes, RangesHoldEveryValueWithin) {
  RandomStream random(1);
  for (const auto& [name, shape] : AllShapes()) {
    for (int draw = 0; draw < 300; ++draw) {
      const Span v = SomeSpan(-1, 1.1, &random), theta = SomeTheta(shape, &random);
      const Span slopes = shape.slopes(v, theta), bends = shape.bends(v, theta);
      for (int inside = 0; inside < 20; ++inside) {
        const double at = Within(v.lower, v.upper, &random);
        const double th = Within(theta.lower, theta.upper, &random);
        ExpectWithin(shape.slope(at, th), slopes, name);
        constexpr double kStep = 1e-6;
        if (std::fabs(at) < 0.01 || std::fabs(at - 0.87) < 0.01) continue;
        const double bend = (shape.slope(at + kStep, th) - shape.slope(at - kStep, th)) / 2 / kStep;
        const double rough = 1e-6 * (1 + std::fabs(bend));
        ExpectWithin(bend, {bends.lower - rough, bends.upper + rough}, name);
        if (!shape.theta_bends) continue;
        const Span by_theta = shape.theta_bends(at, theta);
        const double size = std::fabs(at) / 0.6;
        ExpectWithin(std::log(size) * std::log(size) * shape.value(at, th), by_theta, name);
      }
    }
  }
}

struct PullCase {
  Eigen::VectorXd v0, v1, z0, z1;
};

PullCase SomePulls(RandomStream* random) {
  constexpr int kPoints = 12;
  PullCase made{Eigen::VectorXd(kPoints), Eigen::VectorXd(kPoints), Eigen::VectorXd(kPoints),
                Eigen::VectorXd(kPoints)};
  const double dr = 0.2 * random->Uniform();
  for (int k = 0; k < kPoints; ++k) {
    made.v0[k] = Within(-0.2, 0.6, random);
    made.v1[k] = made.v0[k] + dr * Within(-0.3, 1, random);
    made.z0[k] = random->Normal();
    made.z1[k] = made.z0[k] + 0.3 * random->Normal();
  }
  return made;
}

TEST(CauseShapes, PullsStayBelowTheirBoundsAllTheWay) {
  RandomStream random(2);
  for (const auto& [name, shape] : AllShapes()) {
    double tightest = 1e300;
    for (int draw = 0; draw < 200; ++draw) {
      const PullCase p = SomePulls(&random);
      const Span theta = SomeTheta(shape, &random);
      const ShapePull at_0 = BoundPull(shape, theta, p.v0, p.z0);
      const ShapePull at_1 = BoundPull(shape, theta, p.v1, p.z1);
      const double rise = BoundRise(shape, theta, p.v0, p.v1, p.z0, p.z1);
      for (int inside = 0; inside < 40; ++inside) {
        const double th = Within(theta.lower, theta.upper, &random), t = random.Uniform();
        const auto pull = [&, &values = shape](double s) {
          const Eigen::VectorXd v = (1 - s) * p.v0 + s * p.v1;
          return -values.Values(v, th).dot((1 - s) * p.z0 + s * p.z1);
        };
        EXPECT_LE(pull(0), at_0.ends + at_0.bulge + 1e-12) << name;
        EXPECT_LE(pull(1), at_1.ends + at_1.bulge + 1e-12) << name;
        const double above = pull(t) - (1 - t) * pull(0) - t * pull(1);
        EXPECT_LE(above, 0.5 * t * (1 - t) * rise + 1e-12) << name;
        if (t > 0.1 && t < 0.9) tightest = std::min(tightest, 0.5 * t * (1 - t) * rise - above);
      }
    }
    EXPECT_LT(tightest, 0.02) << name << ": the bound is never near what it bounds";
  }
}

}  // namespace
}  // namespace lyrefit
