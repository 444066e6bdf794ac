#include "faults/score.h"

#include <gtest/gtest.h>

#include "faults/synthetic_answer.h"

namespace faults {
namespace {

Case Hiding(const std::string& name, std::vector<std::string> twins, Size size = {}) {
  Case made;
  Cause cause;
  cause.name = name;
  cause.acceptable = std::move(twins);
  cause.acceptable.insert(cause.acceptable.begin(), name);
  cause.size = size;
  made.causes.push_back(cause);
  return made;
}

TEST(CaseScoreTest, TakesATwinForTheFirstName) {
  const Case made = Hiding("collection", {"nonohmic_shunt"});
  const CaseScore score = ScoreCase(made, Saying({Claiming("nonohmic_shunt")}));
  EXPECT_TRUE(score.detected && score.first_right && score.named);
  EXPECT_FALSE(score.in_set);
}

TEST(CaseScoreTest, AllowsTwoStrangersBesideTheTruth) {
  const Cause cause = Hiding("shading", {}).causes[0];
  EXPECT_TRUE(Names(Claiming("transient", {"irr_step", "shading"}), cause));
  EXPECT_FALSE(Names(Claiming("transient", {"irr_step", "clip", "shading"}), cause));
  EXPECT_FALSE(Names(Claiming("transient", {"irr_step"}), cause));
}

TEST(CaseScoreTest, LooksForTheSecondCauseInEveryClaim) {
  Case made = Hiding("drift", {});
  made.causes.push_back(Hiding("clip", {}).causes[0]);
  const Answer answer = Saying({Claiming("clip"), Claiming("drift")});
  EXPECT_TRUE(ScoreCase(made, answer, 0).named);
  EXPECT_FALSE(ScoreCase(made, answer, 0).first_right);
  EXPECT_TRUE(ScoreCase(made, answer, 1).first_right);
}

TEST(CaseScoreTest, OverlooksTheSecondDiodeThatIsThere) {
  Case made;
  made.second_diode = true;
  EXPECT_FALSE(ScoreCase(made, Saying({Claiming("second_diode")})).detected);
  EXPECT_TRUE(ScoreCase(made, Saying({Claiming("second_diode"), Claiming("clip")})).detected);
  made.second_diode = false;
  EXPECT_TRUE(ScoreCase(made, Saying({Claiming("second_diode")})).detected);
}

TEST(CaseScoreTest, ReadsSizesInTheirUnits) {
  const Case made = Hiding("current_offset", {}, {"A", 0.002});
  Claim claim = Claiming("current_offset");
  claim.strengths = {{"c", "mA", 2.1, 1.9, 2.3}};
  const auto size = SizeOf(made.causes[0], Saying({claim}));
  ASSERT_TRUE(size);
  EXPECT_DOUBLE_EQ(size->value, 0.0021);
  claim.strengths[0].unit = "mV";
  EXPECT_FALSE(SizeOf(made.causes[0], Saying({claim})));
  EXPECT_FALSE(SizeOf(made.causes[0], Saying({Claiming("sensor_offset")})));
}

TEST(CaseScoreTest, ReadsPercent) {
  const Case made = Hiding("drift", {}, {"1", 0.01});
  Claim claim = Claiming("drift");
  claim.strengths = {{"d", "%", 1.2, 0.9, 1.5}};
  ASSERT_TRUE(SizeOf(made.causes[0], Saying({claim})));
  EXPECT_DOUBLE_EQ(SizeOf(made.causes[0], Saying({claim}))->value, 0.012);
}

}  // namespace
}  // namespace faults
