#include "lyrefit/study/reference.h"
#include "lyrefit/study/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lyrefit/curve/read_curve.h"

namespace lyrefit {
namespace {

CompareCurve Rtc(double upper_n) {
  CompareCurve subject = MakeSubject(*ReadCurve(LYREFIT_DATA_DIR "/rtc_france"), {});
  subject.bounds.name = "own";
  subject.bounds.table = {
      {"Iph", {0, 10}}, {"Is", {0, 1e-5}}, {"n", {1, upper_n}}, {"Rs", {0, 2}}, {"Rsh", {0, 100}}};
  return subject;
}

constexpr double kSingle_A = 9.860218778918e-4;

TEST(Reference, IsCertifiedWhereTheBestRunReachesTheProvedBound) {
  const Reference reference = FindReference(Rtc(2), Model::kSingleDiode, {}, {kSingle_A, {}});
  EXPECT_TRUE(reference.certified);
  EXPECT_NEAR(reference.rmse_A / kSingle_A, 1, 1e-9);
  EXPECT_EQ(reference.origin, "certified optimum");
}

TEST(Reference, IsWhatTheProofFoundWhereNoRunCameNear) {
  const Reference reference = FindReference(Rtc(2), Model::kSingleDiode, {}, {2e-3, {}});
  EXPECT_NEAR(reference.rmse_A / kSingle_A, 1, 1e-9);
  EXPECT_TRUE(reference.certified);
}

TEST(Reference, SaysHowFarTheBoundIsWhereABoxCutsTheOptimumOff) {
  CompareCurve subject = Rtc(2);
  subject.bounds.table["Rsh"] = {0, 20};
  const Reference reference = FindReference(subject, Model::kSingleDiode, {}, {1.5e-3, {}});
  EXPECT_FALSE(reference.certified);
  EXPECT_EQ(reference.rmse_A, 1.5e-3);
  EXPECT_NEAR(reference.lower_bound_A / kSingle_A, 1, 1e-9);
  EXPECT_THAT(reference.origin, testing::HasSubstr("proved lower bound 34.3 % below"));
}

TEST(Reference, OfTheSolvedCurrentIsTheBestOfAllRuns) {
  CompareOptions options;
  options.objective = Objective::kSolvedCurrent;
  const Reference reference = FindReference(Rtc(2), Model::kSingleDiode, options, {8e-4, {}});
  EXPECT_FALSE(reference.certified);
  EXPECT_EQ(reference.rmse_A, 8e-4);
  EXPECT_NE(reference.lower_bound_A, reference.lower_bound_A);
}

}  // namespace
}  // namespace lyrefit
