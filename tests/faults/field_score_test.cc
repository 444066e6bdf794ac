#include "faults/field_score.h"

#include <gtest/gtest.h>

#include <cmath>

#include "faults/synthetic_answer.h"

namespace faults::field {
namespace {

Case Shaded() {
  Case made;
  made.kind = "substrings";
  made.truth.accepted = {"substrings", "shading"};
  made.truth.figures = {{"light", 0.7}, {"share", 1.0 / 3}, {"light", 0.4}, {"share", 1.0 / 3}};
  return made;
}

TEST(FieldJudge, KnowsRightFromWrong) {
  const CaseScore right = ScoreCase(Shaded(), Saying({Claiming("shading")}));
  EXPECT_TRUE(right.named && right.first_right && right.any_right);
  EXPECT_EQ(right.spurious, 0);
  const CaseScore second =
      ScoreCase(Shaded(), Saying({Claiming("transient"), Claiming("substrings")}));
  EXPECT_TRUE(second.any_right);
  EXPECT_FALSE(second.first_right);
  EXPECT_EQ(second.spurious, 1);
  Claim either = Claiming("transient");
  either.beside = {"substrings", "drift"};
  const CaseScore set = ScoreCase(Shaded(), Saying({either}));
  EXPECT_FALSE(set.first_right || set.any_right);
  EXPECT_EQ(set.in_set, 1);
  EXPECT_EQ(set.spurious, 0);
  const CaseScore wrong = ScoreCase(Shaded(), Saying({Claiming("irr_step")}));
  EXPECT_FALSE(wrong.first_right || wrong.any_right);
  EXPECT_FALSE(ScoreCase(Shaded(), Saying({})).named);
}

TEST(FieldJudge, TakesAnythingOnACleanCurveForFalse) {
  Case clean;
  clean.kind = "clean_module";
  const CaseScore score = ScoreCase(clean, Saying({Claiming("quantisation"), Claiming("drift")}));
  EXPECT_TRUE(score.named);
  EXPECT_EQ(score.claims, 1);
  EXPECT_EQ(score.spurious, 1);
  EXPECT_EQ(score.first, "drift");
  EXPECT_FALSE(ScoreCase(clean, Saying({Claiming("outliers")})).named);
  EXPECT_TRUE(ScoreCase(clean, Saying({Claiming("second_diode")})).named);
  clean.kind = "clean_dd";
  EXPECT_FALSE(ScoreCase(clean, Saying({Claiming("second_diode")})).named);
}

TEST(FieldJudge, ReadsLightsAndSharesOfEveryGroup) {
  const Claim claim = Claiming("substrings", {},
                               {{"d1", "", 0.61, 0.58, 0.64, "light_deficit_1"},
                                {"w1", "", 0.34, 0.33, 0.35, "share_1"},
                                {"d2", "%", 29, 28, 29.5, "light_deficit_2"},
                                {"w2", "", 0.33, 0.325, 0.332, "share_2"},
                                {"d3", "", 0.3, 0, 1, "light_deficit_3"},
                                {"w3", "", 0, 0, 1, "share_3"}});
  const auto compared = ScoreCase(Shaded(), Saying({claim})).compared;
  ASSERT_EQ(compared.size(), 4u);
  EXPECT_EQ(compared[0].quantity, "light");
  EXPECT_DOUBLE_EQ(compared[0].value, 0.71);  // not that of the group without cells
  EXPECT_FALSE(compared[0].holds);
  EXPECT_TRUE(compared[0].interval);
  EXPECT_DOUBLE_EQ(compared[2].value, 0.39);
  EXPECT_TRUE(compared[2].holds);
  EXPECT_EQ(compared[1].quantity, "share");
  EXPECT_DOUBLE_EQ(compared[1].value, 0.33);
}

TEST(FieldJudge, DoesNotCallAMissingIntervalRight) {
  const Claim claim = Claiming("shading", {}, {{"d", "", 0.3, NAN, NAN, "shading_depth"}});
  const auto compared = ScoreCase(Shaded(), Saying({claim})).compared;
  ASSERT_FALSE(compared.empty());
  EXPECT_FALSE(compared[0].interval || compared[0].holds);
}

}  // namespace
}  // namespace faults::field
