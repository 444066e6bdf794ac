#include "lyrefit/diagnose/joint_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "lyrefit/diagnose/choose_base.h"
#include "synthetic_data.h"

namespace lyrefit {
namespace {

FollowUp Find(const Readings& readings, const std::string& id) {
  for (FollowUp& follow_up : FollowUpMeasurements(readings)) {
    if (follow_up.id == id) return follow_up;
  }
  ADD_FAILURE() << id;
  return {};
}

struct Reference {
  SyntheticData made;
  LawFit fit;
};
Reference FitReferences() {
  Reference reference{OnTheData(SyntheticCurve({})), {}};
  reference.fit = FitBase(reference.made.weighted,
                          StartingLaw(reference.made.measurement.readings, Model::kSingleDiode));
  return reference;
}

TEST(TakeFurtherTest, OpenCircuitIsWhereNothingFlows) {
  const Reference reference = FitReferences();
  const FollowUp follow_up = Find(*reference.made.weighted.readings, "isc_voc");
  const std::vector<double> unknown(follow_up.unknown.size(), 0.5);
  const auto joint = TakeFurther(reference.made.weighted, 1, follow_up, reference.fit, unknown);
  ASSERT_TRUE(joint);
  const double photocurrent = reference.fit.p[kIph] / joint->readings.scale.current_A;
  double before = 1;
  for (std::size_t k = joint->taken; k < joint->readings.points.size(); k += 2) {
    const Reading &isc = joint->readings.points[k], &voc = joint->readings.points[k + 1];
    EXPECT_NEAR(voc.current, 0, 1e-9);
    EXPECT_LT(voc.voltage, before);
    EXPECT_NEAR(isc.current, isc.irradiance * 1.015 * photocurrent, 0.01 * isc.irradiance);
    before = voc.voltage;
  }
}

// The true law fits the exact follow-up readings, so that only the residuals of the old readings
// remain.
TEST(FitJointTest, TheTruthLeavesTheOldResidualsAlone) {
  const Reference reference = FitReferences();
  for (const FollowUp& follow_up : FollowUpMeasurements(*reference.made.weighted.readings)) {
    const std::vector<double> unknown(follow_up.unknown.size(), 0.0);
    const auto joint = TakeFurther(reference.made.weighted, 1, follow_up, reference.fit, unknown);
    ASSERT_TRUE(joint) << follow_up.id;
    const FurtherEnd end = FitJoint(*joint, reference.fit.law, {reference.fit.p});
    ASSERT_TRUE(end.usable) << follow_up.id;
    EXPECT_NEAR(end.sum, reference.fit.sum, 1e-3 * reference.fit.sum) << follow_up.id;
    EXPECT_LT(end.after.norm(), 0.1) << follow_up.id;
  }
}

// Deviations of irradiance and temperature by 2 and -1 standard deviations add about their squares,
// 5, to the sum of squares.
TEST(FitJointTest, FindsWhatWasUnknown) {
  const Reference reference = FitReferences();
  const FollowUp follow_up = Find(*reference.made.weighted.readings, "second_light");
  const auto joint = TakeFurther(reference.made.weighted, 1, follow_up, reference.fit, {2, -1});
  ASSERT_TRUE(joint);
  const FurtherEnd end = FitJoint(*joint, reference.fit.law, {reference.fit.p});
  EXPECT_NEAR(end.sum - reference.fit.sum, 5, 1.5);
  EXPECT_LT(end.after.norm(), 1);
}

TEST(FitJointTest, WhatIsNotThereMisfits) {
  const Reference reference = FitReferences();
  LawFit truth = reference.fit;
  truth.law.effects = {FindEffect("nonohmic_shunt")};
  truth.p.insert(truth.p.end(), {0.5, 2});
  const FollowUp follow_up = Find(*reference.made.weighted.readings, "dark_curve");
  const auto joint = TakeFurther(reference.made.weighted, 1, follow_up, truth, {0});
  ASSERT_TRUE(joint);
  EXPECT_GT(FitJoint(*joint, reference.fit.law, {reference.fit.p}).sum, 100 * reference.fit.sum);
}

TEST(DrawErrorsTest, AreOfTheirSizeAndShared) {
  constexpr int kRows = 20000;
  ErrorModel errors;
  errors.white.assign(kRows, 0.5);
  errors.path.assign(kRows, 2);
  errors.chain.assign(kRows, 0);
  for (int k = 0; k < kRows; ++k) errors.position.push_back(0.1 * k);
  RandomStream random(3);
  const std::vector<double> drawn = DrawErrors(errors, &random);
  double square = 0, product = 0;
  for (int k = 0; k < kRows; ++k) {
    square += drawn[k] * drawn[k] / kRows;
    if (k > 0) product += drawn[k] * drawn[k - 1] / kRows;
  }
  EXPECT_NEAR(square, 4.25, 0.6);
  EXPECT_NEAR(product, 4 * std::exp(-0.1), 0.6);
}

// Up and down over the same positions: the path is that of the position, so that it is equal where a
// reading comes twice.
TEST(DrawErrorsTest, FollowTheOrderAlongTheChain) {
  constexpr int kHalf = 50;
  ErrorModel errors;
  errors.white.assign(2 * kHalf, 0);
  errors.path.assign(2 * kHalf, 1);
  errors.chain.assign(2 * kHalf, 0);
  for (int k = 0; k < kHalf; ++k) errors.position.push_back(0.1 * k);
  for (int k = kHalf - 1; k >= 0; --k) errors.position.push_back(0.1 * k);
  for (int k = 0; k < kHalf; ++k) {
    errors.order.push_back(k);
    errors.order.push_back(2 * kHalf - 1 - k);
  }
  RandomStream random(3);
  const std::vector<double> drawn = DrawErrors(errors, &random);
  for (int k = 0; k < kHalf; ++k) {
    ASSERT_TRUE(std::isfinite(drawn[k])) << k;
    EXPECT_NEAR(drawn[k], drawn[2 * kHalf - 1 - k], 1e-12) << k;
  }
}

}  // namespace
}  // namespace lyrefit
