#include "lyrefit/family/joint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tuple>

#include "family/quick.h"
#include "family/synthetic_family.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Stranger {
  const char* name;
  int parameter;
  double factor;
};

class OutlierCurve : public testing::TestWithParam<std::tuple<Stranger, int>> {};

TEST_P(OutlierCurve, IsNamedAndOnlyIt) {
  const auto& [stranger, count] = GetParam();
  const Translation law = SyntheticLaw(TranslationLaw::kDeSoto);
  std::vector<double> other = SyntheticTruth(law);
  CurveSet set = SyntheticSet(law, other, count == 6 ? kSixPlaces : ManyPlaces(count), 20, 2e-3);
  other[stranger.parameter] *= stranger.factor;
  RandomStream random(9);
  const std::string id = set.curves[2].name;
  set.curves[2] = SyntheticCurve(law, other, {800, 40}, 20, 2e-3, &random);
  set.curves[2].name = id;
  FamilyOptions options = Quick();
  options.intervals = false;
  const FamilyReport report = *FitFamily(set, options);
  ASSERT_TRUE(report.without_outliers.has_value());
  EXPECT_THAT(report.without_outliers->ids, ElementsAre(id));
  EXPECT_NEAR(report.without_outliers->rmse.solved_current_A, 2e-3, 4e-4);
  for (const FamilyCurve& row : report.curves) EXPECT_EQ(row.outlier, row.id == id);
  EXPECT_THAT(report.warnings, testing::Contains(HasSubstr("Curve " + id + " does not belong")));
  // Without the exchanged curve, no curve is an outlier.
  options.leave_out = {id};
  EXPECT_FALSE(FitFamily(set, options)->without_outliers.has_value());
}

INSTANTIATE_TEST_SUITE_P(FitFamily, OutlierCurve,
                         testing::Combine(testing::Values(Stranger{"Isc", 0, 1.1},
                                                          Stranger{"Voc", 1, 6},
                                                          Stranger{"Rs", 3, 2}),
                                          testing::Values(6, 20)),
                         [](const testing::TestParamInfo<std::tuple<Stranger, int>>& test) {
                           return std::string(std::get<0>(test.param).name) + "_" +
                                  std::to_string(std::get<1>(test.param));
                         });

}  // namespace
}  // namespace lyrefit
