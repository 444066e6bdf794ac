#include "lyrefit/diagnose/law_coordinates.h"

#include <gtest/gtest.h>

#include <cmath>

#include "effects/synthetic_readings.h"
#include "lyrefit/model/device.h"

namespace lyrefit {
namespace {

// A family whose law has every parameter that a base can have.
struct FamilyLaw {
  Readings readings = SyntheticReadings(DataKind::kFamily, 60);
  Law law;
  std::vector<double> theta = {1, -0.1, 1.25, 0.02, 0.04, 0.1, 2, 0.0006, 1.15, 0.03, 0.1, 0.2};

  FamilyLaw() {
    law.model = Model::kDoubleDiode;
    law.free_tempco = law.free_bandgap = true;
    law.effects = {FindEffect("drift")};
  }
};

TEST(LawCoordinatesTest, AreThoseOfAnOrdinaryCell) {
  const FamilyLaw at;
  const std::vector<double> p = LawCoordinates(at.law, at.readings).Parameters(at.theta);
  const std::vector<double> cell = ParametersOf({}, at.readings, Model::kDoubleDiode);
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(p[k], cell[k], 1e-12 * cell[k]) << k;
  // Both are small against exp(0.6 V / 2 Vt), which Saturation2Unit leaves out.
  EXPECT_NEAR(p[5], cell[5], 1e-4 * cell[5]);
  EXPECT_DOUBLE_EQ(p[7], 0.0006 * 8.2);
  const std::vector<double> back = LawCoordinates(at.law, at.readings).Of(p);
  for (std::size_t k = 0; k < back.size(); ++k) EXPECT_NEAR(back[k], at.theta[k], 1e-13) << k;
}

TEST(LawCoordinatesTest, LeaveOutWhatIsNotThere) {
  FamilyLaw at;
  at.theta[kIph] = at.theta[kRs] = at.theta[kRsh] = at.theta[SaturationCurrentIndex(1)] = 0;
  at.theta[at.law.TempcoAt()] = 0;  // has no meaning without a photocurrent
  const LawCoordinates coordinates(at.law, at.readings);
  const std::vector<double> p = coordinates.Parameters(at.theta);
  EXPECT_TRUE(std::isinf(p[kRsh]));
  const std::vector<double> back = coordinates.Of(p);
  for (std::size_t k = 0; k < back.size(); ++k) EXPECT_NEAR(back[k], at.theta[k], 1e-13) << k;
}

// Also at bounds: without a shunt, a second diode or a photocurrent.
TEST(LawCoordinatesTest, DerivativesAreThoseOfTheCurrents) {
  for (const bool bare : {false, true}) {
    FamilyLaw at;
    if (bare) at.theta[kIph] = at.theta[kRsh] = at.theta[SaturationCurrentIndex(1)] = 0;
    const LawCoordinates coordinates(at.law, at.readings);
    const std::size_t count = at.readings.points.size(), size = at.theta.size();
    std::vector<double> current(count), up = current, down = current, jacobian(count * size);
    LawWorkspace workspace;
    ASSERT_TRUE(coordinates.Evaluate(at.theta.data(), &workspace, current.data(), jacobian.data()));
    const Eigen::MatrixXd slopes = coordinates.Slopes(at.theta);
    for (std::size_t i = 0; i < size; ++i) {
      constexpr double kStep = 1e-5;
      std::vector<double> above = at.theta, below = at.theta;
      above[i] += kStep;
      below[i] -= kStep;
      const bool at_bound = i == kRsh && bare;  // no conductance below 0
      if (at_bound) below = at.theta;
      ASSERT_TRUE(coordinates.Evaluate(above.data(), &workspace, up.data(), nullptr));
      ASSERT_TRUE(coordinates.Evaluate(below.data(), &workspace, down.data(), nullptr));
      for (std::size_t k = 0; k < count; ++k) {
        const double slope = (up[k] - down[k]) / (above[i] - below[i]);
        EXPECT_NEAR(jacobian[k * size + i], slope,
                    (at_bound ? 1e-4 : 1e-6) * (1 + std::fabs(slope)))
            << "reading " << k << ", coordinate " << i;
      }
      if (at_bound) continue;
      const auto p = coordinates.Parameters(above), q = coordinates.Parameters(below);
      for (std::size_t j = 0; j < size; ++j) {
        if (std::isinf(p[j])) continue;
        const double slope = (p[j] - q[j]) / (above[i] - below[i]);
        EXPECT_NEAR(slopes(j, i), slope, 1e-7 * (1e-9 + std::fabs(slope))) << j << " by " << i;
      }
    }
  }
}

// A module measured as one cell has a huge exponent at the pivot voltage.
TEST(LawCoordinatesTest, DerivativesAreFiniteAtAnyPivot) {
  Readings readings = SyntheticReadings(DataKind::kForward, 1);
  for (const double pivot : {0.05, 6.0, 40.0, 400.0}) {
    for (Reading& r : readings.points) r.voltage *= pivot / readings.pivot_voltage;
    readings.pivot_voltage = pivot;
    readings.scale.saturation_2_unit = Saturation2Unit(readings);
    for (const double n : {0.2, 1.2, 8.0}) {
      const Law law;
      const std::vector<double> theta = {1, -0.1, n, 0.02, 0.04};
      LawWorkspace workspace;
      std::vector<double> current(readings.points.size()), jacobian(5 * current.size());
      ASSERT_TRUE(LawCoordinates(law, readings)
                      .Evaluate(theta.data(), &workspace, current.data(), jacobian.data()))
          << pivot << " V, n " << n;
      for (const double slope : jacobian) EXPECT_TRUE(std::isfinite(slope));
    }
  }
}

}  // namespace
}  // namespace lyrefit
