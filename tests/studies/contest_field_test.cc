// The contest sets of github.com/cwhanse/ivcurves: exact curves with known parameters, and noisy
// curves of one device per set.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lyrefit/family/fit_family.h"
#include "lyrefit/family/fit_individually.h"
#include "lyrefit/read/read_curve_set.h"
#include "repeats.h"
#include "studies/truth.h"

namespace lyrefit {
namespace {

const std::string kFolder = std::string(LYREFIT_FIELD_DATA_DIR) + "/ivcurves/";

CurveSet ContestSet(const std::string& name) {
  Expected<CurveSet> set = ReadCurveSet(kFolder + name + ".json");
  EXPECT_TRUE(set) << set.error().ToString();
  return set ? std::move(*set) : CurveSet();
}

TruthComparison HeldAgainstTruth(const FamilyReport& report, const std::string& name) {
  const auto truth = ReadTruth(kFolder + name + ".csv");
  EXPECT_TRUE(truth) << truth.error().ToString();
  return truth ? CompareWithTruth(report, *truth) : TruthComparison();
}

class ExactSet : public ::testing::TestWithParam<const char*> {};

TEST_P(ExactSet, GivesEveryParameterToNineDigits) {
  const auto report = FitIndividually(ContestSet(GetParam()));
  ASSERT_TRUE(report) << report.error().ToString();
  const TruthComparison comparison = HeldAgainstTruth(*report, GetParam());
  EXPECT_EQ(comparison.curves, 32);
  EXPECT_EQ(comparison.unmatched, 0);
  ASSERT_EQ(comparison.parameters.size(), 5U);
  for (const TruthParameter& p : comparison.parameters) {
    EXPECT_LE(p.worst, 1e-9) << p.info.symbol << " of curve " << p.worst_id;
  }
}

INSTANTIATE_TEST_SUITE_P(Contest, ExactSet, ::testing::Values("case1", "case2"));

class NoisySet : public ::testing::TestWithParam<const char*> {};

// The noise of neighbouring points is correlated. The report must warn of it, and the intervals of
// the joint fit must be based on whole curves.
TEST_P(NoisySet, IsFittedTogetherAndItsNoiseIsNamed) {
  if (std::string(GetParam()) != "case3a") SKIP_IF_SANITIZED();
  const CurveSet set = ContestSet(GetParam());
  FamilyOptions options;
  options.bounds["n1"] = {0.5, 3};
  const auto single = FitIndividually(set, options);
  ASSERT_TRUE(single) << single.error().ToString();
  EXPECT_EQ(HeldAgainstTruth(*single, GetParam()).curves, 50);
  bool named = false;
  for (const std::string& warning : single->warnings) {
    named = named || warning.find("keep their sign too long") != std::string::npos;
  }
  EXPECT_TRUE(named);

  FamilyOptions joint;
  joint.individual_fits = false;
  joint.folds = 0;
  const auto together = FitFamily(set, joint);
  ASSERT_TRUE(together) << together.error().ToString();
  const TruthComparison comparison = HeldAgainstTruth(*together, GetParam());
  ASSERT_EQ(comparison.parameters.size(), 5U);
  int by_points = 0, by_curves = 0;
  for (const TruthParameter& p : comparison.parameters) {
    by_points += p.truth >= p.by_points.low_95 && p.truth <= p.by_points.high_95;
    by_curves += p.truth >= p.by_curves.low_95 && p.truth <= p.by_curves.high_95;
    EXPECT_LT(p.by_points.high_95 - p.by_points.low_95, p.by_curves.high_95 - p.by_curves.low_95)
        << p.info.symbol;
  }
  EXPECT_GE(by_curves, by_points);
  EXPECT_LT(std::abs(comparison.parameters[0].joint_error), 2e-3);  // Iph
}

INSTANTIATE_TEST_SUITE_P(Contest, NoisySet,
                         ::testing::Values("case3a", "case3b", "case3c", "case3d"));

}  // namespace
}  // namespace lyrefit
