#include "lyrefit/diagnose/fit_effect.h"

#include <gtest/gtest.h>

#include <string>

#include "lyrefit/diagnose/law_coordinates.h"
#include "synthetic_data.h"

namespace lyrefit {
namespace {

TEST(FitEffectTest, NeverDoesWorseThanTheLawItExtends) {
  Recipe recipe;
  recipe.cells = 60;
  const SyntheticData made = OnTheData(SyntheticCurve(recipe));
  const LawFit base = FitBase(made.weighted, Law());
  const auto candidates = Showable(made.measurement.readings.traits);
  int fitted = 0;
  Signatures signatures;
  for (const Score& score : ScoreEffects(made.weighted, base, candidates, &signatures)) {
    if (!score.testable || score.effect->probes == nullptr) continue;
    // Effects with shares, limits or a reverse law that is tried out have no parameter value
    // without an effect. Readings in reverse also respond to a bypass diode where no cell is weak.
    const std::string id = score.effect->id;
    const LawFit fit = FitEffect(made.weighted, base, score);
    if (!fit.usable && score.effect->where != Where::kDevice) continue;  // it would imitate another
    ASSERT_TRUE(fit.usable) << id;
    EXPECT_EQ(fit.law.effects.back(), score.effect);
    const bool always_there = id == "shading" || id == "clip" || id == "weak_cell" ||
                              id == "dim_cells" || id == "scatter";
    EXPECT_TRUE(always_there || fit.sum <= base.sum * (1 + 1e-6)) << id;
    const LawCoordinates coordinates(fit.law, *made.weighted.readings);
    const LeastSquaresProblem bounded = coordinates.Problem();
    const std::vector<double> theta = coordinates.Of(fit.p);
    for (int k = 0; k < fit.law.size(); ++k) {
      EXPECT_GE(theta[k], bounded.lower[k]) << id;
      EXPECT_LE(theta[k], bounded.upper[k]) << id;
    }
    ++fitted;
  }
  EXPECT_GT(fitted, 3);
}

TEST(FitEffectTest, FindsADipAndTakesItOutAgain) {
  IvCurve curve = SyntheticCurve({});
  for (int k = 18; k < 25; ++k) curve.current_A[k] -= 0.1;
  const SyntheticData made = OnTheData(curve);
  const LawFit base = FitBase(made.weighted, Law());
  Signatures signatures;
  const std::vector<Score> scores =
      ScoreEffects(made.weighted, base, {FindEffect("transient")}, &signatures);
  const LawFit fit = FitEffect(made.weighted, base, scores.front());
  ASSERT_TRUE(fit.usable);
  EXPECT_LT(fit.sum, 0.5 * base.sum);
  EXPECT_NEAR(fit.p[6], made.measurement.readings.points[21].x, 0.02);
  const LawFit without = FitWithout(made.weighted, fit, 0);
  EXPECT_TRUE(without.law.effects.empty());
  EXPECT_NEAR(without.sum, base.sum, 1e-3 * base.sum);
}

// A refit without a tenth of the readings starts at the previous optimum and stays close to it.
TEST(FitEffectTest, GoesOnFromWhereItEnded) {
  IvCurve curve = SyntheticCurve({});
  for (int k = 18; k < 25; ++k) curve.current_A[k] -= 0.1;
  SyntheticData made = OnTheData(curve);
  const LawFit base = FitBase(made.weighted, Law());
  Signatures signatures;
  const std::vector<Score> scores =
      ScoreEffects(made.weighted, base, {FindEffect("transient")}, &signatures);
  const LawFit met = FitEffect(made.weighted, base, scores.front());
  for (std::size_t k = 0; k < made.weighted.used.size(); k += 10) made.weighted.used[k] = 0;
  const LawFit fit = FitOnwards(made.weighted, met);
  ASSERT_TRUE(fit.usable);
  EXPECT_LT(fit.sum, met.sum);
  EXPECT_EQ(fit.law.effects, met.law.effects);
  EXPECT_NEAR(fit.p[6], met.p[6], 0.01);
}

}  // namespace
}  // namespace lyrefit
