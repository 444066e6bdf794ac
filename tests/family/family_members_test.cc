#include "lyrefit/family/family_members.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "family/synthetic_family.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class MakeFamilyMembersTest : public testing::Test {
 protected:
  Expected<FamilyMembers> Make() const { return MakeFamilyMembers(set_, options_); }
  std::string Error() const {
    const auto made = Make();
    return made ? "" : made.error().ToString();
  }

  const Translation law_ = SyntheticLaw(TranslationLaw::kDeSoto);
  CurveSet set_ = SyntheticSet(law_, SyntheticTruth(law_), kSixPlaces, 12, 1e-3);
  FamilyOptions options_;
};

TEST_F(MakeFamilyMembersTest, TakesLightCurvesAsTheyAre) {
  const FamilyMembers members = *Make();
  EXPECT_THAT(members.fitted, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(members.held_out, IsEmpty());
  EXPECT_THAT(members.notes, IsEmpty());
  EXPECT_NEAR(members.reference_current_A, 3.8, 0.1);
  for (const FamilyMember& member : members.members) {
    EXPECT_EQ(member.joint.irradiance_sd, 0);
    EXPECT_EQ(member.joint.temperature_sd_K, 0);
    EXPECT_THAT(member.joint.weight, testing::Each(1));
  }
}

TEST_F(MakeFamilyMembersTest, SaysOfEveryCurveThatItCannotUseWhy) {
  set_.curves[0].conditions.irradiance_W_m2 = 0;
  set_.curves[1].conditions.cells_in_series = 72;
  set_.curves[2].conditions.irradiance_W_m2 = 0;
  for (double& current : set_.curves[2].current_A) current -= 10;
  for (double& current : set_.curves[3].current_A) current -= 10;
  options_.leave_out = {"c5"};
  options_.fit_curves = 0;
  RandomStream random(3);
  set_.curves.push_back(SyntheticCurve(law_, SyntheticTruth(law_), {300, 30}, 12, 0, &random));
  set_.curves.back().name = "c7";
  const FamilyMembers members = *Make();
  EXPECT_THAT(members.fitted, ElementsAre(5, 6));
  EXPECT_THAT(members.members[0].reason, HasSubstr("stated as 0 W/m2 but it delivers"));
  EXPECT_THAT(members.members[1].reason, HasSubstr("has 72 cells in series, the others 36"));
  EXPECT_THAT(members.members[2].reason, HasSubstr("dark curve"));
  EXPECT_THAT(members.members[3].reason, HasSubstr("no current at 0 V"));
  EXPECT_EQ(members.members[4].reason, "left out as asked");
  for (int c = 0; c < 5; ++c) EXPECT_EQ(members.members[c].role, CurveRole::kLeftOut) << c;
}

TEST_F(MakeFamilyMembersTest, NeedsTwoLightCurvesWithNamesOfTheirOwn) {
  set_.curves.resize(1);
  EXPECT_THAT(Error(), HasSubstr("at least two light curves, found 1"));
  set_.curves.clear();
  EXPECT_THAT(Error(), HasSubstr("at least two light curves, found 0"));
  set_ = SyntheticSet(law_, SyntheticTruth(law_), kSixPlaces, 12, 1e-3);
  options_.leave_out = {"c9"};
  EXPECT_THAT(Error(), HasSubstr("leave-out: the set has no curve c9"));
  options_.leave_out = {};
  set_.curves[3].name = "c1";
  EXPECT_THAT(Error(), HasSubstr("two curves are named c1"));
  set_.curves[3].name = "c4";
  set_.curves[3].current_A.pop_back();
  EXPECT_THAT(Error(), HasSubstr("curve c4"));
}

TEST_F(MakeFamilyMembersTest, GuessesWhatNobodyStated) {
  set_.curves[3].irradiance_known = false;
  set_.curves[3].conditions.irradiance_W_m2 = 1000;
  set_.curves[4].temperature_known = false;
  options_.irradiance_accuracy = 0.02;
  const FamilyMembers members = *Make();
  EXPECT_NEAR(members.members[3].joint.irradiance_W_m2, 400, 10);
  EXPECT_EQ(members.members[3].joint.irradiance_sd, kInfinity);
  EXPECT_EQ(members.members[4].joint.temperature_sd_K, kInfinity);
  EXPECT_EQ(members.members[4].joint.irradiance_sd, 0.02);
  EXPECT_NEAR(ConditionsOf(members)[3].irradiance_W_m2, 400, 10);
}

TEST_F(MakeFamilyMembersTest, CallsTheBrightestOneSunWhereNobodyStatedAny) {
  for (IvCurve& curve : set_.curves) curve.irradiance_known = curve.temperature_known = false;
  const FamilyMembers members = *Make();
  ASSERT_EQ(members.notes.size(), 2U);
  EXPECT_THAT(members.notes[0], HasSubstr("the brightest counts as 1000 W/m2"));
  EXPECT_THAT(members.notes[1], HasSubstr("25 C counts for all"));
  EXPECT_EQ(members.members[1].joint.irradiance_W_m2, 1000);
  EXPECT_EQ(members.members[1].joint.irradiance_sd, 0);
  EXPECT_NEAR(members.members[4].joint.irradiance_W_m2, 200, 10);
  EXPECT_EQ(members.members[4].joint.temperature_sd_K, 0);
}

TEST_F(MakeFamilyMembersTest, WeighsByIscOrByTheStatedDeviations) {
  options_.weights = FamilyWeights::kIsc;
  const FamilyMembers members = *Make();
  EXPECT_NEAR(members.members[4].joint.weight[0], 25, 1.5);
  options_.weights = FamilyWeights::kEqual;
  for (IvCurve& curve : set_.curves) curve.sigma_A.assign(curve.size(), 1e-3);
  set_.curves[2].sigma_A[0] = 2e-3;
  EXPECT_EQ(Make()->members[2].joint.weight[0], 0.25);
  EXPECT_EQ(Make()->members[2].joint.weight[1], 1);
}

TEST_F(MakeFamilyMembersTest, HoldsOutWhatItDoesNotFit) {
  options_.fit_curves = 3;
  options_.leave_out = {"c1"};
  const FamilyMembers members = *Make();
  EXPECT_EQ(members.fitted.size(), 3U);
  EXPECT_EQ(members.held_out.size(), 2U);
  for (const int c : members.held_out) EXPECT_EQ(members.members[c].role, CurveRole::kHeldOut);
}

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Conditions At(double irradiance_W_m2, double temperature_C) {
  Conditions conditions;
  conditions.irradiance_W_m2 = irradiance_W_m2;
  conditions.cell_temperature_K = temperature_C + 273.15;
  return conditions;
}

TEST(CurveSubset, BeginsAtTheReferenceAndTakesTheFarthestNext) {
  const std::vector<Conditions> line = {At(100, 25), At(990, 25), At(900, 26), At(300, 25),
                                        At(1000, 80)};
  EXPECT_THAT(CurveSubset(line, {0, 1, 2, 3, 4}, 1), ElementsAre(1));
  EXPECT_THAT(CurveSubset(line, {0, 1, 2, 3, 4}, 2), ElementsAre(0, 1));
  EXPECT_THAT(CurveSubset(line, {0, 1, 2, 3, 4}, 3), ElementsAre(0, 1, 4));
  EXPECT_THAT(CurveSubset(line, {0, 1, 2, 3, 4}, 4), ElementsAre(0, 1, 3, 4));
}

TEST(CurveSubset, TakesOnlyFromThoseItIsGiven) {
  const std::vector<Conditions> line = {At(1000, 25), At(500, 25), At(490, 25), At(100, 25)};
  EXPECT_THAT(CurveSubset(line, {1, 2, 3}, 2), ElementsAre(1, 3));
  EXPECT_THAT(CurveSubset(line, {1, 3}, 5), ElementsAre(1, 3));
  EXPECT_THAT(CurveSubset(line, {1, 2, 3}, 0), IsEmpty());
  EXPECT_THAT(CurveSubset(line, {}, 3), IsEmpty());
}

TEST(CurveSubset, TakesNoneTwiceWhereAllAreAlike) {
  const std::vector<Conditions> same(5, At(700, 40));
  EXPECT_THAT(CurveSubset(same, {0, 1, 2, 3, 4}, 4), ElementsAre(0, 1, 2, 3));
}

TEST(CurveSubset, BearsDarkness) {
  const std::vector<Conditions> dark = {At(0, 25), At(1000, 25), At(500, 25)};
  EXPECT_THAT(CurveSubset(dark, {0, 1, 2}, 2), ElementsAre(0, 1));
}

}  // namespace
}  // namespace lyrefit
