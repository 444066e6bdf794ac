#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "cli/run_app.h"
#include "lyrefit/base/random.h"
#include "lyrefit/model/model_points.h"
#include "paper/held_tables.h"
#include "paper/planted.h"
#include "paper/sound_study.h"
#include "repeats.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TEST(Soundness, NoBoundOfAMadeProblemLiesAboveWhatIsAttained) {
  SKIP_IF_SANITIZED();
  SoundOptions options;
  options.problems = Repeats(20);  // `lyrefit_paper --only sound` uses a thousand
  options.effort = 200;
  const auto study = StudySynthetic(options);
  ASSERT_TRUE(study) << study.error().ToString();
  ASSERT_EQ(study->held.size(), 2U * options.problems);
  EXPECT_EQ(study->unusable, 0);
  int certified = 0;
  for (const HeldCertificate& held : study->held) {
    SCOPED_TRACE(held.name + " " + ToText(held.objective));
    EXPECT_EQ(held.violations(), 0);
    ASSERT_EQ(held.models.size(), 3U);
    for (const HeldBound& model : held.models) EXPECT_GE(model.best_A, held.floor.best_A);
    certified += held.floor.certified ? 1 : 0;
    if (held.planted != Planted::kMeasuredAtRs || held.objective != Objective::kMeasuredCurrent) {
      continue;
    }
    const HeldBound& own = held.models[held.diodes - 1];
    EXPECT_TRUE(own.certified) << own.gap;
    EXPECT_NEAR(own.lower_bound_A / held.planted_A, 1, 2e-9);
    EXPECT_NEAR(held.floor.best_A / held.planted_A, 1, 2e-9);
  }
  EXPECT_GT(certified, options.problems);
}

// No parameters near a planted optimum have a lower RMSE under the objective it was planted for.
TEST(Soundness, PlantedOptimaAreOptima) {
  int seen = 0;
  for (int number = 0; number < 60; ++number) {
    const SyntheticProblem made = MakeProblem(3, number);
    if (made.planted == Planted::kNothing) continue;
    ++seen;
    SCOPED_TRACE(made.curve.name + " " + ToText(made.planted));
    const Objective objective =
        made.planted == Planted::kSolved ? Objective::kSolvedCurrent : Objective::kMeasuredCurrent;
    const Device device = MakeDevice(made.model, made.curve.conditions);
    const auto rmse = [&](const std::vector<double>& p) {
      return Rmse(device, objective, p.data(), made.curve.voltage_V, made.curve.current_A);
    };
    const double planted = rmse(made.parameters);
    RandomStream random(5, number);
    for (int step = 0; step < 100; ++step) {
      std::vector<double> p = made.parameters;
      const double size = 1e-2 * std::pow(10, -6 * random.Uniform());
      for (int i = 0; i < device.size(); ++i) {
        const bool held = made.planted == Planted::kMeasuredAtRs && i == kRs;
        if (!held) p[i] *= 1 + size * random.Normal();
      }
      for (int d = 0; d < DiodeCount(device); ++d) {
        double& n = p[IdealityIndex(d)];
        n = std::min(std::max(n, made.ranges.n_lower), made.ranges.n_upper);
      }
      EXPECT_GE(rmse(p), planted * (1 - 1e-9));
    }
  }
  EXPECT_GT(seen, 40);
}

TEST(Soundness, CountsABoundAboveWhatIsAttained) {
  HeldCertificate held;
  held.models.resize(1);
  held.models[0].violated = true;
  EXPECT_EQ(held.violations(), 1);
  held.floor.violated = true;
  SoundStudy study;
  study.held = {held, held};
  EXPECT_EQ(Violations(study), 4);
  EXPECT_EQ(BoundsHeld(study), 4);
  // A bound above a reached RMSE is detected. Here a narrow range of n excludes the true
  // parameters, so their RMSE lies below a valid bound.
  const SyntheticProblem made = MakeProblem(3, 4);
  CertifyOptions narrow;
  narrow.n_lower = 1;
  narrow.n_upper = 1.05;
  const auto caught = HoldCertificate(made.curve, narrow, made.model, made.parameters, 1);
  ASSERT_TRUE(caught) << caught.error().ToString();
  EXPECT_GT(caught->violations(), 0);
}

TEST(Soundness, QuantilesAreValuesThatOccur) {
  EXPECT_EQ(QuantileOf({3, 1, 2}, 0.5), 2);
  EXPECT_EQ(QuantileOf({3, 1, 2}, 1), 3);
  EXPECT_EQ(QuantileOf({3, 1, 2}, 0), 1);
  EXPECT_TRUE(std::isnan(QuantileOf({}, 0.5)));
}

TEST(SoundPage, IsWrittenAloneAndShipsWithoutAViolation) {
  SKIP_IF_SANITIZED();
  const TempFolder folder;
  const AppResult result = RunApp("'" + DataFolder("paper") + "' --only sound --out '" +
                                  folder.Path("") + "' --sound-problems 4 --sound-effort 20");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string shipped = FileText(DataFolder("paper") + "/sound.md");
  for (const std::string& page : {FileText(folder.Path("sound.md")), shipped}) {
    EXPECT_THAT(page, HasSubstr("# Proved bounds, held against what is known"));
    EXPECT_THAT(page, HasSubstr("| measured-current | td |"));
    EXPECT_THAT(page, HasSubstr("**0 of them above"));
  }
  EXPECT_THAT(shipped, HasSubstr("1000 made problems"));
}

}  // namespace
}  // namespace lyrefit
