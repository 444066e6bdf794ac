#include "lyrefit/diagnose/diagnose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "synthetic/curves.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;

IvCurve SteppedCurve(int points) {
  Recipe recipe;
  recipe.points = points;
  IvCurve curve = SyntheticCurve(recipe);
  for (std::size_t k = curve.size() / 2; k < curve.size(); ++k) curve.current_A[k] += 0.12;
  return curve;
}

TEST(DiagnosisProgress, HearsOfEveryStageOfADiagnosis) {
  std::vector<std::string> stages;
  const Observer observer = [&](const Progress& progress) {
    if (stages.empty() || stages.back() != progress.stage) stages.emplace_back(progress.stage);
    EXPECT_GT(progress.iterations, 0);
    EXPECT_LE(progress.iteration, progress.iterations);
    return ObserverAction::kContinue;
  };
  DiagnoseOptions options;
  options.threads = 1;
  options.folds = 3;
  ASSERT_TRUE(Diagnose(SteppedCurve(100), options, observer));
  EXPECT_THAT(stages, ElementsAre("base fit", "selection", "candidates", "held out"));
}

// A stop during any stage ends all fits, and the diagnosis is marked as unfinished.
TEST(DiagnosisProgress, AStopEndsEveryStageAtOnce) {
  for (const char* stage : {"base fit", "selection", "candidates", "held out"}) {
    const Observer observer = [&](const Progress& progress) {
      return progress.stage == stage ? ObserverAction::kStop : ObserverAction::kContinue;
    };
    const auto d = Diagnose(SteppedCurve(800), {}, observer);
    ASSERT_TRUE(d.has_value()) << stage;
    EXPECT_TRUE(d->interrupted) << stage;
    EXPECT_EQ(d->verdict.sentence.rfind("Stopped early", 0), 0U) << stage;
    EXPECT_EQ(d->gain.folds, 0) << stage;
  }
}

}  // namespace
}  // namespace lyrefit
