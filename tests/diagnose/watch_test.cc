#include "lyrefit/diagnose/watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

#include "law/made_curve.h"
#include "lyrefit/diagnose/diagnose.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;

using Clock = std::chrono::steady_clock;

IvCurve CurveWithAStep(int points) {
  Recipe recipe;
  recipe.points = points;
  IvCurve curve = MadeCurve(recipe);
  for (std::size_t k = curve.size() / 2; k < curve.size(); ++k) curve.current_A[k] += 0.12;
  return curve;
}

TEST(WatchTest, RemembersThatItWasToldToStop) {
  int asked = 0;
  Watch watch([&](const Progress& progress) {
    EXPECT_EQ(progress.stage, "stage");
    EXPECT_EQ(progress.iterations, 7);
    return ++asked == 1 ? ObserverAction::kStop : ObserverAction::kContinue;
  });
  EXPECT_FALSE(watch.Stopped());
  watch.Begin("stage", 7);
  EXPECT_TRUE(watch.Stopped());
  EXPECT_TRUE(watch.Stopped());
  EXPECT_FALSE(Stopped(nullptr));
}

TEST(WatchTest, HearsOfEveryStageOfADiagnosis) {
  std::vector<std::string> stages;
  double longest = 0;
  Clock::time_point last = Clock::now();
  const Observer observer = [&](const Progress& progress) {
    if (stages.empty() || stages.back() != progress.stage) stages.emplace_back(progress.stage);
    longest = std::max(longest, std::chrono::duration<double>(Clock::now() - last).count());
    last = Clock::now();
    EXPECT_GT(progress.iterations, 0);
    EXPECT_LE(progress.iteration, progress.iterations);
    return ObserverAction::kContinue;
  };
  DiagnoseOptions options;
  options.threads = 1;
  options.folds = 3;
  ASSERT_TRUE(Diagnose(CurveWithAStep(100), options, observer));
  EXPECT_THAT(stages, ElementsAre("base fit", "nulls", "selection", "rivals", "held out"));
  EXPECT_LT(longest, 1);
}

// Wherever the stop comes, what is left takes no time and the diagnosis says that it is unfinished.
TEST(WatchTest, AStopEndsEveryStageAtOnce) {
  for (const char* stage : {"base fit", "nulls", "selection", "rivals", "held out"}) {
    Clock::time_point told;
    const Observer observer = [&](const Progress& progress) {
      if (progress.stage != stage) return ObserverAction::kContinue;
      told = Clock::now();
      return ObserverAction::kStop;
    };
    const auto d = Diagnose(CurveWithAStep(800), {}, observer);
    const double took = std::chrono::duration<double>(Clock::now() - told).count();
    ASSERT_TRUE(d.has_value()) << stage;
    EXPECT_TRUE(d->interrupted) << stage;
    EXPECT_EQ(d->verdict.sentence.rfind("Stopped early", 0), 0U) << stage;
    EXPECT_EQ(d->gain.folds, 0) << stage;
    EXPECT_LT(took, 1) << stage;
  }
}

}  // namespace
}  // namespace lyrefit
