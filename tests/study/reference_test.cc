#include "lyrefit/study/reference.h"
#include "lyrefit/settings/bounds_file.h"
#include "lyrefit/study/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lyrefit/read/read_curve.h"
#include "lyrefit/study/algorithms.h"
#include "lyrefit/study/report/documents.h"
#include "repeats.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

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

TEST(Reference, IsThatOfTheBoxWhereItCutsTheOptimumOff) {
  constexpr double kLeaky_A = 4.023779e-3;  // result of a fit with --bound Rsh=0:20
  CompareCurve subject = Rtc(2);
  subject.bounds.table["Rsh"] = {0, 20};
  const Reference reference = FindReference(subject, Model::kSingleDiode, {}, {5e-3, {}});
  EXPECT_TRUE(reference.certified);
  EXPECT_NEAR(reference.rmse_A / kLeaky_A, 1, 1e-6);
  EXPECT_NEAR(reference.lower_bound_A / reference.rmse_A, 1, 1e-9);
  EXPECT_EQ(reference.origin, "certified optimum");
  EXPECT_LE(reference.parameters[kRsh], 20);
}

// Below this n the exponent of a diode is cut: runs do not search there, though the bounds begin at
// 0.0278, where three diodes are proved to reach 1.603618381e-3 A.
TEST(Reference, IsOfThePartOfTheBoundsThatRunsSearch) {
  CompareCurve subject = MakeSubject(*ReadCurve(LYREFIT_DATA_DIR "/pwp201"),
                                     *NamedBounds("literature", LYREFIT_DATA_DIR "/pwp201"));
  const Reference reference = FindReference(subject, Model::kTripleDiode, {}, {2.5e-3, {}});
  EXPECT_TRUE(reference.certified);
  EXPECT_NEAR(reference.rmse_A / 1.606387144469e-3, 1, 1e-9);
  EXPECT_NEAR(reference.floor_A / reference.rmse_A, 1, 1e-9);
  EXPECT_NEAR(reference.steepest_n, 0.05537, 1e-5);
  for (int d = 0; d < 3; ++d) {
    EXPECT_GE(reference.parameters[IdealityIndex(d)], reference.steepest_n);
  }
  subject.bounds = *NamedBounds("physical", "");
  EXPECT_TRUE(std::isnan(FindReference(subject, Model::kSingleDiode, {}, {2.5e-3, {}}).steepest_n));
}

TEST(Reference, IsReachedByTheRunsWhereBoundsAreSearchedInPart) {
  CompareOptions options;
  options.models = {Model::kTripleDiode};
  options.runs = 2;
  options.threads = 1;
  SearchOptions search;
  search.population = 10;
  search.iterations = 20;
  const auto comparison =
      Compare({MakeSubject(*ReadCurve(LYREFIT_DATA_DIR "/pwp201"),
                           *NamedBounds("literature", LYREFIT_DATA_DIR "/pwp201"))},
              PlainAlgorithms({Algorithm::kMlo}, search), options);
  ASSERT_TRUE(comparison) << comparison.error().ToString();
  EXPECT_EQ(comparison->problems.at(0).algorithms.at(0).polished.within_1e9, 2);
  const nlohmann::json warnings = nlohmann::json::parse(CompareJson(*comparison))["warnings"];
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0].get<std::string>(),
              HasSubstr("pwp201, triple-diode model, bounds literature: n begins at 0.05537"));
  EXPECT_THAT(CompareText(*comparison), HasSubstr("n begins at 0.05537"));
}

TEST(Reference, IsOfTheObjectiveOfTheRuns) {
  SKIP_IF_SANITIZED();
  CompareOptions options;
  options.objective = Objective::kSolvedCurrent;
  for (const double best_A : {8e-4, 7.730062689941e-4}) {
    const Reference reference = FindReference(Rtc(2), Model::kSingleDiode, options, {best_A, {}});
    EXPECT_TRUE(reference.certified) << best_A;
    EXPECT_NEAR(reference.rmse_A / 7.730062690e-4, 1, 1e-9);
    EXPECT_EQ(reference.origin, "certified optimum");
    EXPECT_NEAR(reference.floor_A / 7.326480809e-4, 1, 1e-9);
  }
}

}  // namespace
}  // namespace lyrefit
