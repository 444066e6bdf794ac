#include "lyrefit/devices/data_sheet_family.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/random.h"
#include "lyrefit/devices/data_sheet.h"
#include "lyrefit/model/model_points.h"
#include "repeats.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

Translation DeSotoOf(int cells) {
  TranslationSpec spec;
  spec.cells_in_series = cells;
  return *MakeTranslation(spec);
}

TranslatedDevice DeviceOf(const DataSheet& sheet, const DataSheetMember& member) {
  return TranslateTo(
      DeSotoOf(sheet.cells_in_series),
      {member.photocurrent_A, member.saturation_current_A, member.n, member.resistance_series_ohm,
       member.resistance_shunt_ohm, sheet.values.alpha_sc_A_K, 1.121, -0.0002677},
      1000, 298.15);
}

double CurrentAt(const TranslatedDevice& at, double voltage) {
  return SolveOperatingPoint(at.device, at.parameters.data(), voltage).current_A;
}

// Expects the member's curve to pass through all three points, to 1e-10 of Isc, and to have its
// maximum power at Vmp.
void ExpectThroughThePoints(const DataSheet& sheet, const DataSheetMember& member) {
  const DataSheetValues& v = sheet.values;
  const double isc = v.short_circuit_current_A;
  const TranslatedDevice at = DeviceOf(sheet, member);
  EXPECT_NEAR(CurrentAt(at, 0) / isc, 1, 1e-10) << member.n;
  EXPECT_NEAR(CurrentAt(at, v.open_circuit_voltage_V) / isc, 0, 1e-10) << member.n;
  EXPECT_NEAR(CurrentAt(at, v.max_power_voltage_V), v.max_power_current_A, 1e-10 * isc) << member.n;
  const KeyPoints points = ModelKeyPoints(at.device, at.parameters.data());
  EXPECT_NEAR(points.max_power_voltage_V / v.max_power_voltage_V, 1, 1e-6) << member.n;
  EXPECT_GE(member.resistance_series_ohm, 0);
  EXPECT_GT(member.resistance_shunt_ohm, 0);
  EXPECT_GT(member.saturation_current_A, 0);
}

DataSheet FamilySheet(const DataSheetValues& values, int cells) {
  DataSheet sheet;
  sheet.values = values;
  sheet.cells_in_series = cells;
  return sheet;
}

// Silicon modules of different makes, one of them with 144 cells; a thin-film module; a single
// cell; a module with a low shunt resistance.
const DataSheet kFamilySheets[] = {
    FamilySheet({8.21, 32.9, 7.61, 26.3, 0.00318, -0.123}, 54),
    FamilySheet({13.98, 49.6, 13.29, 41.4, 0.0063, -0.134}, 144),
    FamilySheet({1.0318, 16.778, 0.912, 12.649, 0.0004, -0.06}, 36),
    FamilySheet({1.19, 86.8, 1.04, 64.8, 0.0004, -0.2}, 116),
    FamilySheet({0.76, 0.5728, 0.691, 0.4507, 0.0004, -0.002}, 1),
    FamilySheet({5, 21, 4.2, 17.8, 0.002, -0.08}, 36),
};

TEST(DataSheetFamily, PassesThroughTheThreePoints) {
  for (const DataSheet& sheet : kFamilySheets) {
    const auto family = FindDataSheetFamily(sheet);
    ASSERT_TRUE(family.has_value()) << family.error().message;
    ASSERT_EQ(family->members.size(), 32U);
    double before = 0;
    for (const DataSheetMember& member : family->members) {
      ExpectThroughThePoints(sheet, member);
      EXPECT_GT(member.n, before);
      before = member.n;
      EXPECT_TRUE(std::isnan(member.difference_A));
      ASSERT_EQ(member.max_power_W.size(), family->conditions.size());
    }
    EXPECT_FALSE(family->picked.has_value());
  }
}

// The last member has a series resistance or a shunt conductance of exactly 0. Beyond it one of the
// two would be negative.
TEST(DataSheetFamily, EndsWhereAResistanceIsNothing) {
  int series = 0, shunt = 0;
  for (const DataSheet& sheet : kFamilySheets) {
    const auto family = FindDataSheetFamily(sheet);
    ASSERT_TRUE(family.has_value());
    const DataSheetMember& last = family->members.back();
    const bool of_series = family->bound == FamilyBound::kSeriesResistance;
    ++(of_series ? series : shunt);
    if (of_series) {
      EXPECT_EQ(last.resistance_series_ohm, 0);
      EXPECT_FALSE(std::isinf(last.resistance_shunt_ohm));
    } else {
      EXPECT_TRUE(std::isinf(last.resistance_shunt_ohm));
      EXPECT_GT(last.resistance_series_ohm, 0);
    }
    EXPECT_TRUE(FindDataSheetMember(sheet, last.n).has_value());
    EXPECT_TRUE(FindDataSheetMember(sheet, last.n * (1 - 1e-9)).has_value());
    const auto beyond = FindDataSheetMember(sheet, last.n * (1 + 1e-9));
    ASSERT_FALSE(beyond.has_value());
    EXPECT_THAT(beyond.error().message, HasSubstr("no single diode with n"));
  }
  EXPECT_GT(series, 0);
  EXPECT_GT(shunt, 0);
}

// A device without a shunt or without series resistance is the last member of its own family, so
// that the expected end is known.
TEST(DataSheetFamily, EndsAtDevicesWithoutOneOfTheResistances) {
  RandomStream random(17);
  for (int k = 0; k < 100; ++k) {
    DataSheetMember device;
    device.n = 0.8 + random.Uniform();
    const int cells = 1 + static_cast<int>(random.Index(144));
    const double isc = 0.1 + 12 * random.Uniform();
    const double voc = cells * (0.5 + 0.3 * random.Uniform());
    device.photocurrent_A = isc;
    device.saturation_current_A = isc * std::exp(-voc / (device.n * cells * 0.025693));
    const bool no_series = k % 2 == 0;
    const double share = 0.01 + 0.05 * random.Uniform();
    device.resistance_series_ohm = no_series ? 0 : voc / isc * share;
    device.resistance_shunt_ohm = no_series ? voc / isc / share : kInfinity;
    DataSheet sheet = FamilySheet({}, cells);
    const TranslatedDevice at = DeviceOf(sheet, device);
    const KeyPoints points = ModelKeyPoints(at.device, at.parameters.data());
    sheet.values = {points.short_circuit_current_A, points.open_circuit_voltage_V,
                    points.max_power_current_A, points.max_power_voltage_V};
    const auto family = FindDataSheetFamily(sheet);
    ASSERT_TRUE(family.has_value()) << family.error().message;
    EXPECT_EQ(family->bound,
              no_series ? FamilyBound::kSeriesResistance : FamilyBound::kShuntConductance)
        << k;
    const DataSheetMember& last = family->members.back();
    EXPECT_NEAR(last.n / device.n, 1, 1e-7) << k;
    EXPECT_NEAR(last.resistance_series_ohm, device.resistance_series_ohm, 1e-6 * voc / isc) << k;
    EXPECT_NEAR(1 / last.resistance_shunt_ohm, 1 / device.resistance_shunt_ohm, 1e-7 * isc / voc)
        << k;
  }
}

// For small n the curves and parameters approach the sharp knee, a broken line.
TEST(DataSheetFamily, GoesToASharpKnee) {
  for (const DataSheet& sheet : kFamilySheets) {
    const auto family = FindDataSheetFamily(sheet);
    ASSERT_TRUE(family.has_value());
    const SharpKnee& knee = family->sharp_knee;
    const DataSheetMember& first = family->members.front();
    const DataSheetMember& second = family->members[1];
    const auto closer = [](double limit, double near, double far) {
      EXPECT_LT(std::fabs(near - limit), std::fabs(far - limit));
      EXPECT_NEAR(near / limit, 1, 0.2);
    };
    closer(knee.photocurrent_A, first.photocurrent_A, second.photocurrent_A);
    closer(knee.resistance_series_ohm, first.resistance_series_ohm, second.resistance_series_ohm);
    closer(knee.resistance_shunt_ohm, first.resistance_shunt_ohm, second.resistance_shunt_ohm);
    // The knee's line below Voc at the junction: I = Iph - (V + I Rs) / Rsh.
    const DataSheetValues& v = sheet.values;
    const auto off = [&](double voltage, double current) {
      return knee.photocurrent_A -
             (voltage + current * knee.resistance_series_ohm) / knee.resistance_shunt_ohm - current;
    };
    EXPECT_NEAR(off(0, v.short_circuit_current_A), 0, 1e-12 * v.short_circuit_current_A);
    EXPECT_NEAR(off(v.max_power_voltage_V, v.max_power_current_A), 0,
                1e-12 * v.short_circuit_current_A);
    EXPECT_NEAR(v.max_power_voltage_V + v.max_power_current_A * knee.resistance_series_ohm,
                v.open_circuit_voltage_V, 1e-12 * v.open_circuit_voltage_V);
  }
}

// Any device is a member of the family of its own three points, at its own n.
TEST(DataSheetFamily, HoldsEveryDeviceAtItsIdeality) {
  RandomStream random(29);
  int picked = 0;
  for (int k = 0; k < 300; ++k) {
    DataSheetMember device;
    const int cells = 1 + static_cast<int>(random.Index(144));
    device.n = 0.6 + 1.6 * random.Uniform();
    device.photocurrent_A = 0.05 + 15 * random.Uniform();
    const double voc = cells * (0.4 + 0.5 * random.Uniform());
    device.saturation_current_A =
        device.photocurrent_A * std::exp(-voc / (device.n * cells * 0.025693));
    const double unit = voc / device.photocurrent_A;
    device.resistance_series_ohm = unit * 0.12 * random.Uniform();
    device.resistance_shunt_ohm = unit * std::pow(10, 0.6 + 2.4 * random.Uniform());
    DataSheet sheet = FamilySheet({}, cells);
    sheet.values.alpha_sc_A_K = 5e-4 * device.photocurrent_A;
    const TranslatedDevice at = DeviceOf(sheet, device);
    const KeyPoints points = ModelKeyPoints(at.device, at.parameters.data());
    sheet.values.short_circuit_current_A = points.short_circuit_current_A;
    sheet.values.open_circuit_voltage_V = points.open_circuit_voltage_V;
    sheet.values.max_power_current_A = points.max_power_current_A;
    sheet.values.max_power_voltage_V = points.max_power_voltage_V;
    const auto member = FindDataSheetMember(sheet, device.n);
    ASSERT_TRUE(member.has_value()) << k << ' ' << member.error().message;
    EXPECT_NEAR(member->photocurrent_A / device.photocurrent_A, 1, 1e-7) << k;
    EXPECT_NEAR(member->saturation_current_A / device.saturation_current_A, 1, 1e-5) << k;
    EXPECT_NEAR(member->resistance_series_ohm, device.resistance_series_ohm, 1e-6 * unit) << k;
    EXPECT_NEAR(1 / member->resistance_shunt_ohm, 1 / device.resistance_shunt_ohm, 1e-6 / unit)
        << k;
    // The device's own beta_oc selects it from the family.
    sheet.values.beta_oc_V_K = member->beta_oc_V_K;
    sheet.EgRef_eV = 1.121;  // silicon's, also where the voltage is of another material
    // no data sheet has this value
    if (member->beta_oc_V_K < -0.009 * points.open_circuit_voltage_V) continue;
    const auto fit = FitDataSheet(sheet);
    ASSERT_TRUE(fit.has_value()) << k << ' ' << fit.error().message;
    ASSERT_TRUE(fit->family.picked.has_value());
    EXPECT_NEAR(fit->family.picked->n / device.n, 1, 1e-6) << k;
    EXPECT_LE(fit->family.picked->n, fit->family.members.back().n * (1 + 1e-9)) << k;
    ++picked;
  }
  EXPECT_GT(picked, 200);
}

// A larger n makes Voc fall faster with temperature, so that one coefficient selects one member.
// All curves lie between the sharp knee and the last member, whose difference is thus the largest
// difference of any two.
TEST(DataSheetFamily, IsInOrderOfItsIdeality) {
  for (const DataSheet& sheet : kFamilySheets) {
    const auto family = FindDataSheetFamily(sheet);
    ASSERT_TRUE(family.has_value());
    const DataSheetValues& v = sheet.values;
    const std::vector<DataSheetMember>& members = family->members;
    for (std::size_t k = 1; k < members.size(); ++k) {
      EXPECT_LT(members[k].beta_oc_V_K, members[k - 1].beta_oc_V_K);
      EXPECT_LT(members[k].resistance_series_ohm, members[k - 1].resistance_series_ohm);
      EXPECT_GT(members[k].resistance_shunt_ohm, members[k - 1].resistance_shunt_ohm);
      const TranslatedDevice low = DeviceOf(sheet, members[k - 1]);
      const TranslatedDevice high = DeviceOf(sheet, members[k]);
      for (const double share : {0.2, 0.5, 0.8}) {
        const double left = share * v.max_power_voltage_V;
        const double right =
            v.max_power_voltage_V + share * (v.open_circuit_voltage_V - v.max_power_voltage_V);
        EXPECT_GT(CurrentAt(high, left), CurrentAt(low, left));
        EXPECT_GT(CurrentAt(high, right), CurrentAt(low, right));
      }
    }
    const MemberSpread& spread = family->spread;
    const double knee_A =
        spread.at_V < v.max_power_voltage_V
            ? v.short_circuit_current_A - (v.short_circuit_current_A - v.max_power_current_A) *
                                              spread.at_V / v.max_power_voltage_V
            : v.max_power_current_A * (v.open_circuit_voltage_V - spread.at_V) /
                  (v.open_circuit_voltage_V - v.max_power_voltage_V);
    const double last_A = CurrentAt(DeviceOf(sheet, members.back()), spread.at_V);
    EXPECT_NEAR(spread.difference_A, last_A - knee_A, 1e-9);
    EXPECT_NEAR(spread.difference_percent, 100 * spread.difference_A / v.short_circuit_current_A,
                1e-9);
  }
}

// With beta_oc and its rounding only a part of the family is left.
TEST(DataSheetFamily, IsNarrowerWithTheCoefficient) {
  DataSheet sheet = kFamilySheets[0];
  sheet.half_unit = {0.005, 0.05, 0.005, 0.05, 0.000005, 0.0005};
  const auto fit = FitDataSheet(sheet);
  ASSERT_TRUE(fit.has_value());
  const DataSheetFamily& family = fit->family;
  ASSERT_TRUE(family.picked && family.rounding_low && family.rounding_high);
  EXPECT_EQ(family.picked->n, fit->shared[fit->translation.n]);
  EXPECT_EQ(family.picked->difference_A, 0);
  EXPECT_NEAR(family.picked->beta_oc_V_K, sheet.values.beta_oc_V_K, 1e-9);
  EXPECT_LT(family.rounding_low->n, family.picked->n);
  EXPECT_GT(family.rounding_high->n, family.picked->n);
  EXPECT_GT(family.rounding_low->difference_A, 0);
  ASSERT_TRUE(family.rounding_spread.has_value());
  EXPECT_GT(family.rounding_spread->difference_A, 0);
  EXPECT_LT(family.rounding_spread->difference_A, family.spread.difference_A);
  for (std::size_t k = 0; k < family.conditions.size(); ++k) {
    EXPECT_LE(family.rounding_spread->lowest_power_W[k], family.picked->max_power_W[k]);
    EXPECT_GE(family.rounding_spread->highest_power_W[k], family.picked->max_power_W[k]);
  }
  sheet.half_unit = {};
  EXPECT_FALSE(FitDataSheet(sheet)->family.rounding_spread.has_value());
  // For a coefficient that no member has, the last member is selected.
  sheet.values.beta_oc_V_K = -0.25;
  const auto border = FitDataSheet(sheet);
  ASSERT_TRUE(border.has_value());
  EXPECT_NEAR(border->family.picked->n, border->family.members.back().n, 1e-7);
}

// Any three points that a falling, concave curve may have, apart from very sharp knees.
TEST(DataSheetFamily, PassesThroughAnyThreePoints) {
  SKIP_IF_SANITIZED();
  RandomStream random(43);
  int found = 0, sharp = 0;
  for (int k = 0; k < 400; ++k) {
    const double imp = 0.5 + 0.5 * random.Uniform(), vmp = 0.5 + 0.5 * random.Uniform();
    if (imp * vmp < 0.31 || imp * vmp > 0.89) continue;
    const int cells = 1 + static_cast<int>(random.Index(144));
    const double isc = 8 * random.Uniform() + 0.1, voc = 0.6 * cells;
    const DataSheet sheet = FamilySheet(
        {isc, voc, imp * isc, vmp * voc, 0.0003 * isc, -0.006 * voc * random.Uniform()}, cells);
    const auto family = FindDataSheetFamily(sheet);
    if (!family) {
      EXPECT_THAT(family.error().message, HasSubstr("n would have to be below"));
      // Near the limits of possible points every knee is sharp.
      const auto inside = [](double share) { return std::min(share - 0.5, 1 - share); };
      EXPECT_LT(std::min(inside(imp), inside(vmp)), 0.05) << imp << ' ' << vmp;
      ++sharp;
      continue;
    }
    ++found;
    for (const std::size_t member : {0, 10, 20, 30, 31}) {
      ExpectThroughThePoints(sheet, family->members[member]);
    }
    const DataSheetMember& last = family->members.back();
    EXPECT_TRUE(last.resistance_series_ohm == 0 || std::isinf(last.resistance_shunt_ohm));
    EXPECT_FALSE(FindDataSheetMember(sheet, last.n * (1 + 1e-9)).has_value());
    // The member selected by the coefficient belongs to the family.
    const auto fit = FitDataSheet(sheet);
    ASSERT_TRUE(fit.has_value()) << fit.error().message;
    ExpectThroughThePoints(sheet, *fit->family.picked);
    EXPECT_LE(fit->family.picked->n, last.n * (1 + 1e-9));
  }
  EXPECT_GT(found, 300);
  EXPECT_GT(sharp, 3);
}

// For a bare diode, series resistance and shunt conductance of the last member are both 0.
TEST(DataSheetFamily, EndsAtABareDiode) {
  DataSheetMember device;
  device.n = 1.3;
  device.photocurrent_A = 5;
  device.saturation_current_A = 1e-8;
  device.resistance_shunt_ohm = kInfinity;
  DataSheet sheet = FamilySheet({}, 36);
  const TranslatedDevice at = DeviceOf(sheet, device);
  const KeyPoints points = ModelKeyPoints(at.device, at.parameters.data());
  sheet.values = {points.short_circuit_current_A, points.open_circuit_voltage_V,
                  points.max_power_current_A, points.max_power_voltage_V};
  const auto family = FindDataSheetFamily(sheet);
  ASSERT_TRUE(family.has_value()) << family.error().message;
  const DataSheetMember& last = family->members.back();
  EXPECT_NEAR(last.n, 1.3, 1e-6);
  EXPECT_NEAR(last.resistance_series_ohm, 0, 1e-6);
  EXPECT_GT(last.resistance_shunt_ohm, 1e6);
}

TEST(DataSheetFamily, SaysWhyThereIsNone) {
  const auto complaint = [](const DataSheetValues& values, int cells) {
    const auto family = FindDataSheetFamily(FamilySheet(values, cells));
    return family ? std::string() : family.error().message;
  };
  EXPECT_THAT(complaint({8, 33, 8.5, 26}, 54), HasSubstr("Isc > Imp > 0"));
  EXPECT_THAT(complaint({8, 33, 3.9, 28}, 54), HasSubstr("half of Isc or Voc"));
  EXPECT_THAT(complaint({8, 33, 7.6, 26}, 0), HasSubstr("at least 1 cell"));
  EXPECT_THAT(complaint({8, 33, 7.6, 26, 0.05}, 54), HasSubstr("in percent"));
  // 0.997 of Isc at 0.677 of Voc: a knee that no diode has.
  EXPECT_THAT(complaint({1, 1, 0.9972, 0.6764}, 1), HasSubstr("n would have to be below"));
  const auto member = FindDataSheetMember(kFamilySheets[0], -1);
  ASSERT_FALSE(member.has_value());
  EXPECT_THAT(member.error().message, HasSubstr("n has to be from"));
}

}  // namespace
}  // namespace lyrefit
