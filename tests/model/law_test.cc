#include "lyrefit/model/law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "effects/synthetic_readings.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/translation.h"

namespace lyrefit {
namespace {

TEST(LawTest, BaseIsTheDeviceOfASingleCurve) {
  for (const int cells : {1, 60}) {
    for (const bool second : {false, true}) {
      const Readings readings = SyntheticReadings(DataKind::kReverse, cells);
      Law law;
      law.model = second ? Model::kDoubleDiode : Model::kSingleDiode;
      const std::vector<double> p = ParametersOf({}, readings, law.model);
      const std::vector<double> found = Currents(law, readings, p);
      ASSERT_FALSE(found.empty());
      Conditions conditions;
      conditions.cells_in_series = cells;
      const Device device = MakeDevice(law.model, conditions);
      for (std::size_t k = 0; k < found.size(); ++k) {
        const double expected =
            SolveOperatingPoint(device, p.data(), readings.points[k].voltage * cells).current_A;
        EXPECT_NEAR(found[k] * readings.scale.current_A, expected, 1e-10);
      }
    }
  }
}

TEST(LawTest, BaseOfAFamilyIsTheTranslationOfDeSoto) {
  for (const bool second : {false, true}) {
    const Readings readings = SyntheticReadings(DataKind::kFamily, 60);
    Law law;
    law.model = second ? Model::kDoubleDiode : Model::kSingleDiode;
    const std::vector<double> p = ParametersOf({}, readings, law.model);
    TranslationSpec spec;
    spec.shunt = ShuntLaw::kConstant;
    spec.cells_in_series = 60;
    spec.model = law.model;
    const Translation translation = *MakeTranslation(spec);
    std::vector<double> shared(translation.size(), 0.0);
    shared[translation.photocurrent] = p[0];
    shared[translation.saturation_current] = p[1];
    shared[translation.n] = p[2];
    shared[translation.resistance_series] = p[3];
    shared[translation.resistance_shunt] = p[4];
    shared[translation.alpha_sc] = readings.isc_tempco_per_K * p[0];
    shared[translation.bandgap] = readings.bandgap_eV;
    if (second) {
      shared[translation.saturation_current_2] = p[5];
      shared[translation.n_2] = 2;
    }
    const std::vector<double> found = Currents(law, readings, p);
    ASSERT_FALSE(found.empty());
    for (std::size_t k = 0; k < found.size(); ++k) {
      const Reading& r = readings.points[k];
      const TranslatedDevice at =
          TranslateTo(translation, shared, r.irradiance * 1000, r.temperature_K);
      const double expected =
          SolveOperatingPoint(at.device, at.parameters.data(), r.voltage * 60).current_A;
      EXPECT_NEAR(found[k] * readings.scale.current_A, expected, 1e-10);
    }
  }
}

// Root of the increasing function f, by bisection.
double Bisect(const std::function<double(double)>& f, double low, double high) {
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (f(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// An ordinary cell, implemented independently of the library.
struct PlainCell {
  const Readings& readings;
  double leak = 1e-8;  // leak conductance of each cell in a string
  CellValues cell = {};

  double Junction(double voltage, double light) const {
    const double n_vt = cell.ideality * ThermalVoltage(readings.reference_temperature_K);
    const double saturation = std::exp(cell.log_pivot) / std::expm1(readings.pivot_voltage / n_vt);
    return cell.photocurrent * light - saturation * std::expm1(voltage / n_vt) -
           (cell.conductance + leak) * voltage;
  }
  // Terminal voltage at which the cell delivers `current`.
  double Voltage(double current, double light) const {
    return Bisect([&](double v) { return current - Junction(v, light); }, -1e9, 3) -
           current * cell.resistance;
  }
};

TEST(LawTest, UnequalCellsAreTwoCellsInSeries) {
  const Readings readings = SyntheticReadings(DataKind::kForward, 60);
  const PlainCell cell{readings};
  for (const auto& [deficit, share] : {std::pair{0.05, 0.3}, {0.4, 0.1}, {0.02, 1.0 / 60}}) {
    const Settled at = WithEffect(*FindEffect("mismatch"), {deficit, share}, readings);
    const std::vector<double> found = Currents(at.law, readings, at.p);
    ASSERT_FALSE(found.empty());
    for (std::size_t k = 0; k < found.size(); ++k) {
      const double expected = Bisect(
          [&, d = deficit, w = share](double current) {
            return readings.points[k].voltage - (1 - w) * cell.Voltage(current, 1) -
                   w * cell.Voltage(current, 1 - d);
          },
          -20, 1.1);
      EXPECT_NEAR(found[k], expected, 1e-9);
    }
  }
}

// The bypass diode carries the current that the shaded cells cannot.
TEST(LawTest, ShadedCellsAreBypassed) {
  Readings readings = SyntheticReadings(DataKind::kForward, 60);
  readings.traits.substrings = 3;
  const PlainCell cell{readings};
  const double drop = 0.5, share = 1.0 / 3, depth = 0.6;
  const double n_vt = 1.2 * ThermalVoltage(readings.reference_temperature_K);
  const auto dim = [&](double own) { return cell.Voltage(own, 1 - depth); };
  // Current through the shaded cells at a string current; the bypass diode carries the rest.
  const auto carried = [&](double current) {
    return Bisect(
        [&](double own) {
          return own + std::exp(-drop / n_vt) * std::expm1(-20 * dim(own) / n_vt) - current;
        },
        -25, 2);
  };
  const Settled at = WithEffect(*FindEffect("shading"), {depth, share, drop, 1}, readings);
  const std::vector<double> found = Currents(at.law, readings, at.p);
  ASSERT_FALSE(found.empty());
  for (std::size_t k = 0; k < found.size(); k += 5) {
    const double expected = Bisect(
        [&](double current) {
          return readings.points[k].voltage - (1 - share) * cell.Voltage(current, 1) -
                 share * dim(carried(current));
        },
        -20, 1.1);
    EXPECT_NEAR(found[k], expected, 1e-5);
  }
  EXPECT_GT(found.front(), 0.9);  // photocurrent of the lit substrings
}

TEST(LawTest, SpreadResistanceIsTwoHalfCells) {
  const Readings readings = SyntheticReadings(DataKind::kForward, 1);
  const PlainCell cell{readings, 0};
  for (const double lateral : {0.02, 0.3, 2.0}) {
    const Settled at = WithEffect(*FindEffect("distributed_rs"), {lateral}, readings);
    const std::vector<double> found = Currents(at.law, readings, at.p);
    ASSERT_FALSE(found.empty());
    const auto far = [&](double near) {
      return Bisect([&](double v) { return v - near - 0.5 * lateral * cell.Junction(v, 1); },
                    near - 5, near + 5);
    };
    for (std::size_t k = 0; k < found.size(); ++k) {
      const double voltage = readings.points[k].voltage;
      const auto current = [&](double near) {
        return 0.5 * (cell.Junction(near, 1) + cell.Junction(far(near), 1));
      };
      const double near =
          Bisect([&](double v) { return v - voltage - cell.cell.resistance * current(v); },
                 voltage - 1, voltage + 1);
      EXPECT_NEAR(found[k], current(near), 1e-9);
    }
  }
}

// A part of every cell behind a resistance of its own, and the readings of a Suns-Voc trace without it.
TEST(LawTest, AgedContactsAreTwoPartsOfACell) {
  Readings readings = SyntheticReadings(DataKind::kForward, 1);
  const PlainCell cell{readings, 0};
  for (const double share : {0.05, 0.4, 0.85}) {
    for (const double own : {0.02, 0.3, 2.0}) {
      const Settled at = WithEffect(*FindEffect("aged_contacts"), {own, share}, readings);
      const std::vector<double> found = Currents(at.law, readings, at.p);
      ASSERT_FALSE(found.empty());
      const auto far = [&](double near) {
        return Bisect([&](double v) { return v - near - own * cell.Junction(v, 1); }, near - 5,
                      near + 5);
      };
      for (std::size_t k = 0; k < found.size(); ++k) {
        const double voltage = readings.points[k].voltage;
        const auto current = [&](double near) {
          return (1 - share) * cell.Junction(near, 1) + share * cell.Junction(far(near), 1);
        };
        const double near =
            Bisect([&](double v) { return v - voltage - cell.cell.resistance * current(v); },
                   voltage - 1, voltage + 1);
        EXPECT_NEAR(found[k], current(near), 1e-9);
      }
      Readings trace = readings;
      for (Reading& reading : trace.points) reading.suns_voc = true;
      const std::vector<double> open = Currents(at.law, trace, at.p);
      for (std::size_t k = 0; k < open.size(); ++k) {
        EXPECT_NEAR(open[k], cell.Junction(trace.points[k].voltage, 1), 1e-9);
      }
    }
  }
}

TEST(LawTest, RefusesImpossibleTemperatures) {
  const Readings readings = SyntheticReadings(DataKind::kFamily, 1);
  const Settled at = WithEffect(*FindEffect("temp_offset"), {-250}, readings);
  EXPECT_TRUE(Currents(at.law, readings, at.p).empty());
}

TEST(LawTest, KnowsWhereEachEffectBegins) {
  Law law;
  law.model = Model::kDoubleDiode;
  law.effects = {FindEffect("nonohmic_shunt"), FindEffect("irr_step"), FindEffect("drift")};
  EXPECT_EQ(law.base_size(), 7);
  EXPECT_EQ(law.size(), 14);
  EXPECT_EQ(law.Offset(0), 7);
  EXPECT_EQ(law.Offset(2), 11);
  EXPECT_EQ(law.EffectParameterAt(6), nullptr);
  EXPECT_EQ(law.EffectParameterAt(8)->upper, 5);
  EXPECT_EQ(law.EffectParameterAt(11)->lower, -0.5);
  EXPECT_TRUE(law.Searched(10));
  EXPECT_FALSE(law.Searched(9));
}

// The workspace holds junction voltages of the previous evaluation, which serve as starting values
// only.
TEST(LawTest, DoesNotHangOnWhereTheLastEvaluationEnded) {
  const Readings readings = SyntheticReadings(DataKind::kUpDown, 60);
  LawWorkspace workspace;
  std::vector<double> current(readings.points.size());
  const std::vector<double> far = ParametersOf({3, 8, 2.5, 1.5, 20}, readings);
  ASSERT_TRUE(EvaluateLaw(Law{}, readings, far.data(), &workspace, current.data(), nullptr));
  const std::vector<double> p = ParametersOf({}, readings);
  ASSERT_TRUE(EvaluateLaw(Law{}, readings, p.data(), &workspace, current.data(), nullptr));
  const std::vector<double> fresh = Currents(Law{}, readings, p);
  for (std::size_t k = 0; k < fresh.size(); ++k) EXPECT_NEAR(current[k], fresh[k], 1e-11);
}

// Shading of whole substrings has two cell groups, partial shading three. The workspace has no
// valid starting value for the third group, whatever its memory holds.
TEST(LawTest, AKindOfCellsThatWasNotThereStartsLikeAFreshOne) {
  const Readings readings = SyntheticReadings(DataKind::kUpDown, 60);
  Law law;
  law.effects = {FindEffect("shading")};
  std::vector<double> two = ParametersOf({}, readings), three = two;
  for (const double value : {0.4, 0.3, 0.5, 1.0}) two.push_back(value);
  for (const double value : {0.4, 0.3, 0.5, 0.5}) three.push_back(value);
  std::vector<double> current(readings.points.size()), fresh = current;
  LawWorkspace kept, new_one;
  ASSERT_TRUE(EvaluateLaw(law, readings, two.data(), &kept, current.data(), nullptr));
  ASSERT_TRUE(EvaluateLaw(law, readings, three.data(), &kept, current.data(), nullptr));
  ASSERT_TRUE(EvaluateLaw(law, readings, three.data(), &new_one, fresh.data(), nullptr));
  EXPECT_EQ(current, fresh);  // bit-identical: both started from the default
}

}  // namespace
}  // namespace lyrefit
