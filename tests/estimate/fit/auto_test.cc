#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/estimate/fit/held_out.h"
#include "lyrefit/read/read_curve.h"
#include "repeats.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

TEST(FitAuto, SaysThatOneDiodeIsEnoughForTheRtcFranceCell) {
  const FitReport report = *FitAuto(*ReadCurve(LYREFIT_DATA_DIR "/rtc_france"), {});
  ASSERT_TRUE(report.choice.has_value());
  EXPECT_EQ(report.choice->chosen, Model::kSingleDiode);
  EXPECT_EQ(report.model, Model::kSingleDiode);
  ASSERT_EQ(report.choice->candidates.size(), 3U);
  EXPECT_EQ(report.choice->sentence.rfind("The data support SD.", 0), 0U);
  EXPECT_NE(report.choice->sentence.find("DD is not supported: AICc rises"), std::string::npos);
}

TEST(FitAuto, FindsASecondDiodeThatIsThere) {
  const FitReport report =
      *FitAuto(ModuleCurve(Model::kDoubleDiode, kDoubleTruth, 1e-3, 3, 100), {});
  EXPECT_EQ(report.choice->chosen, Model::kDoubleDiode);
  const auto& candidates = report.choice->candidates;
  EXPECT_LT(candidates[1].held_out_rmse_A, candidates[0].held_out_rmse_A);
  EXPECT_LT(candidates[1].f_p_value, 0.05);
}

TEST(FitAuto, IsRarelyFooledByASingleDiode) {
  SKIP_IF_SANITIZED();
  constexpr int kCurves = Repeats(40);
  int fooled = 0;
  for (int seed = 0; seed < kCurves; ++seed) {
    const FitReport report =
        *FitAuto(ModuleCurve(Model::kSingleDiode, kSingleTruth, 4e-3, seed), {});
    fooled += report.choice->chosen != Model::kSingleDiode;
  }
  EXPECT_LE(fooled, 4);
}

TEST(FitAuto, LeavesOutModelsThatThePointsCannotDetermine) {
  const FitReport report = *FitAuto(ModuleCurve(Model::kSingleDiode, kSingleTruth, 1e-3, 1, 8), {});
  EXPECT_EQ(report.choice->chosen, Model::kSingleDiode);
  EXPECT_NE(report.choice->sentence.find("TD was not tried"), std::string::npos);
}

TEST(HeldOutRmse, IsAboveTheInSampleOneAndNearTheNoise) {
  const double noise = 2e-3;
  FitOptions options;
  const FitReport report =
      *Fit(ModuleCurve(Model::kSingleDiode, kSingleTruth, noise, 5, 100), options);
  const double held_out = HeldOutRmse(report, options);
  EXPECT_GT(held_out, report.rmse.refined.solved_current_A);
  EXPECT_LT(held_out, 5 * noise);
}

}  // namespace
}  // namespace lyrefit
