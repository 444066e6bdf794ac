#include "lyrefit/devices/data_sheet.h"
#include "error_of.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/random.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

bool Warns(const DataSheetFit& fit, const std::string& text) {
  return std::any_of(fit.warnings.begin(), fit.warnings.end(), [&](const std::string& warning) {
    return warning.find(text) != std::string::npos;
  });
}

KeyPoints PointsAt(const Translation& translation, const std::vector<double>& shared,
                   double temperature_K) {
  const TranslatedDevice at = TranslateTo(translation, shared, 1000, temperature_K);
  return ModelKeyPoints(at.device, at.parameters.data());
}

// The data sheet of a device, with all digits.
DataSheet SheetOf(const Translation& translation, const std::vector<double>& shared) {
  const KeyPoints now = PointsAt(translation, shared, 298.15);
  const KeyPoints warm = PointsAt(translation, shared, 300.15);
  DataSheet sheet;
  sheet.values = {
      now.short_circuit_current_A,  now.open_circuit_voltage_V,
      now.max_power_current_A,      now.max_power_voltage_V,
      shared[translation.alpha_sc], (warm.open_circuit_voltage_V - now.open_circuit_voltage_V) / 2};
  sheet.cells_in_series = translation.spec.cells_in_series;
  return sheet;
}

TEST(FitDataSheet, RecoversRandomDevicesFromTheirOwnKeyPoints) {
  RandomStream random(61);
  for (int k = 0; k < 300; ++k) {
    TranslationSpec spec;
    spec.cells_in_series = 1 + static_cast<int>(random.Index(144));
    const Translation translation = *MakeTranslation(spec);
    const double isc = 0.5 + 12 * random.Uniform();
    const double n = 0.85 + 0.7 * random.Uniform();
    const double voc = spec.cells_in_series * (0.5 + 0.2 * random.Uniform());
    const double a = n * spec.cells_in_series * 0.025693;
    // Relative to Voc / Isc.
    const double rs = voc / isc * (0.002 + 0.05 * random.Uniform());
    const double rsh = voc / isc * std::pow(10, 1 + 1.5 * random.Uniform());
    const std::vector<double> shared = {
        isc, isc * std::exp(-voc / a), n, rs, rsh, 5e-4 * isc, 1.121, -0.0002677};
    const auto fit = FitDataSheet(SheetOf(translation, shared));
    ASSERT_TRUE(fit.has_value()) << fit.error().message;
    EXPECT_LT(fit->largest_relative_error, 1e-8) << k;
    for (int i = 0; i < translation.size(); ++i) {
      EXPECT_NEAR(fit->shared[i] / shared[i], 1, 1e-6)
          << k << ' ' << translation.parameters[i].name;
    }
  }
}

DataSheet ShellS75() {
  DataSheet sheet;
  sheet.values = {4.70, 21.6, 4.26, 17.6, 0.002, -0.076};
  sheet.half_unit = {0.005, 0.05, 0.005, 0.05, 0.00005, 0.0005};
  sheet.cells_in_series = 36;
  return sheet;
}

DataSheet Kc200gt() {
  DataSheet sheet;
  sheet.values = {8.21, 32.9, 7.61, 26.3, 0.00318, -0.123};
  sheet.half_unit = {0.005, 0.05, 0.005, 0.05, 0.000005, 0.0005};
  sheet.cells_in_series = 54;
  return sheet;
}

TEST(FitDataSheet, GivesKnownModulesACurveThroughTheirPoints) {
  for (const DataSheet& sheet : {ShellS75(), Kc200gt()}) {
    const auto fit = FitDataSheet(sheet);
    ASSERT_TRUE(fit.has_value()) << fit.error().message;
    const DataSheetValues& v = sheet.values;
    const TranslatedDevice at = TranslateTo(fit->translation, fit->shared, 1000, 298.15);
    const auto current = [&](double voltage) {
      return SolveOperatingPoint(at.device, at.parameters.data(), voltage).current_A;
    };
    EXPECT_NEAR(current(0), v.short_circuit_current_A, 1e-9);
    EXPECT_NEAR(current(v.open_circuit_voltage_V), 0, 1e-9);
    EXPECT_NEAR(current(v.max_power_voltage_V), v.max_power_current_A, 1e-9);
    const KeyPoints points = PointsAt(fit->translation, fit->shared, 298.15);
    EXPECT_NEAR(points.max_power_voltage_V, v.max_power_voltage_V, 1e-6);
    ASSERT_EQ(fit->checks.size(), 6U);
    EXPECT_EQ(fit->checks[4].name, "beta_oc");
    EXPECT_NEAR(fit->checks[4].given, v.beta_oc_V_K, 1e-9);
    EXPECT_EQ(fit->checks[4].asked, v.beta_oc_V_K);
    EXPECT_NEAR(fit->checks[5].given, v.alpha_sc_A_K, 0.01 * v.alpha_sc_A_K);
    EXPECT_LT(fit->largest_relative_error, 1e-8);
    EXPECT_TRUE(Warns(*fit, "nothing is left to check"));
    EXPECT_TRUE(Warns(*fit, "moves Rs from"));
    EXPECT_FALSE(Warns(*fit, "no physical"));
    ASSERT_EQ(fit->ranges.size(), 5U);
    for (const DataSheetRange& range : fit->ranges) {
      const double value = fit->shared[fit->translation.Find(range.name).value()];
      EXPECT_LT(range.low, value) << range.name;
      EXPECT_GT(range.high, value) << range.name;
    }
  }
}

// Expected values of pvlib's own test of fit_desoto, to the digits printed there.
TEST(FitDataSheet, FindsWhatPvlibFinds) {
  DataSheet sheet;
  sheet.values = {9.43, 38.3, 8.71, 31.0, 0.005658, -0.13788};
  sheet.cells_in_series = 60;
  const auto fit = FitDataSheet(sheet);
  ASSERT_TRUE(fit.has_value());
  const Translation& at = fit->translation;
  const auto near = [&](int parameter, double expected) {
    EXPECT_NEAR(fit->shared[parameter] / expected, 1, 1e-4) << at.parameters[parameter].name;
  };
  near(at.photocurrent, 9.45232);
  near(at.saturation_current, 3.22460e-10);
  near(at.resistance_series, 0.297814);
  near(at.resistance_shunt, 125.798);
  near(at.n, 1.59128 / at.device.module_thermal_voltage_V);
  EXPECT_TRUE(fit->ranges.empty());
  EXPECT_TRUE(Warns(*fit, "state the rounding"));
}

void ExpectTheCurveKeptWithoutTheCoefficient(const DataSheetFit& fit) {
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(fit.checks[k].given / fit.checks[k].asked, 1, 1e-7) << fit.checks[k].name;
  }
  EXPECT_GT(fit.largest_relative_error, 1e-3);
  EXPECT_TRUE(Warns(fit, "no physical single diode"));
}

TEST(FitDataSheet, GoesToThePerfectShuntWhereTheShuntWouldBeNegative) {
  DataSheet sheet = Kc200gt();
  sheet.values.beta_oc_V_K = -0.25;
  const auto fit = FitDataSheet(sheet);
  ASSERT_TRUE(fit.has_value()) << fit.error().message;
  EXPECT_TRUE(std::isinf(fit->shared[fit->translation.resistance_shunt]));
  EXPECT_GT(fit->shared[fit->translation.resistance_series], 0);
  ExpectTheCurveKeptWithoutTheCoefficient(*fit);
  EXPECT_TRUE(Warns(*fit, "set infinite"));
}

TEST(FitDataSheet, GoesToNoSeriesResistanceWhereItWouldBeNegative) {
  DataSheet sheet = ShellS75();
  sheet.values.beta_oc_V_K = -0.21;
  const auto fit = FitDataSheet(sheet);
  ASSERT_TRUE(fit.has_value()) << fit.error().message;
  EXPECT_EQ(fit->shared[fit->translation.resistance_series], 0);
  EXPECT_GT(fit->shared[fit->translation.resistance_shunt], 0);
  ExpectTheCurveKeptWithoutTheCoefficient(*fit);
  EXPECT_TRUE(Warns(*fit, "set to 0"));
}

TEST(FitDataSheet, ComparesTheCoefficientOfThePowerWithoutSolvingForIt) {
  DataSheet sheet = Kc200gt();
  const auto without = FitDataSheet(sheet);
  sheet.gamma_pmp_percent_K = -0.49;
  const auto with = FitDataSheet(sheet);
  ASSERT_TRUE(with.has_value());
  EXPECT_EQ(with->shared, without->shared);
  EXPECT_EQ(with->checks.back().name, "gamma_pmp");
  EXPECT_EQ(with->checks.back().asked, -0.49);
  EXPECT_NEAR(with->checks.back().given, -0.49, 0.1);
}

TEST(FitDataSheet, DoubtsTheNumberOfCellsWhereNoDiodeHasThatIdeality) {
  DataSheet sheet = Kc200gt();
  sheet.half_unit = {};
  sheet.cells_in_series = 1;
  EXPECT_THAT(MessageOf(FitDataSheet(sheet)), HasSubstr("--cells 48 or 54 of silicon?"));
  sheet.cells_in_series = 90;  // 0.37 V a cell
  const auto fit = FitDataSheet(sheet);
  ASSERT_TRUE(fit.has_value()) << fit.error().message;
  EXPECT_TRUE(Warns(*fit, "number of cells (90)"));
  for (const double value : fit->shared) EXPECT_TRUE(std::isfinite(value) || value > 0);
}

TEST(FitDataSheet, AsksForTheGapOfAnAlloy) {
  DataSheet sheet = Kc200gt();
  EXPECT_FALSE(Warns(*FitDataSheet(sheet), "band gaps"));
  sheet.technology = "CIGS";
  EXPECT_TRUE(Warns(*FitDataSheet(sheet),
                    "1 to 1.7 eV, of which 1.15 eV is taken; each 0.1 eV more "
                    "lowers n by 8 %: state it (--EgRef)"));
  sheet.EgRef_eV = 1.2;
  EXPECT_FALSE(Warns(*FitDataSheet(sheet), "band gaps"));
}

TEST(FitDataSheet, SaysWhatIsWrongWithTheValues) {
  const auto complaint = [](const auto& change) {
    DataSheet sheet = ShellS75();
    change(&sheet);
    const auto fit = FitDataSheet(sheet);
    return fit ? std::string() : fit.error().message;
  };
  using V = DataSheetValues;
  const auto with = [&](double V::*field, double value) {
    return complaint([&](DataSheet* sheet) { sheet->values.*field = value; });
  };
  EXPECT_THAT(complaint([](DataSheet* sheet) {
                std::swap(sheet->values.alpha_sc_A_K, sheet->values.beta_oc_V_K);
              }),
              HasSubstr("exchanged?"));
  EXPECT_THAT(with(&V::max_power_current_A, 4.8), HasSubstr("Isc > Imp > 0"));
  EXPECT_THAT(with(&V::max_power_current_A, -1), HasSubstr("Isc > Imp > 0"));
  EXPECT_THAT(with(&V::max_power_voltage_V, 22), HasSubstr("Voc > Vmp > 0"));
  EXPECT_THAT(with(&V::max_power_voltage_V, 21.5), HasSubstr("fill factor"));
  EXPECT_THAT(with(&V::max_power_voltage_V, 10), HasSubstr("half of Isc or Voc"));
  EXPECT_THAT(with(&V::alpha_sc_A_K, 0.05), HasSubstr("in percent"));
  EXPECT_THAT(with(&V::beta_oc_V_K, -0.35), HasSubstr("in percent"));
  EXPECT_THAT(with(&V::beta_oc_V_K, 0.076), HasSubstr("negative beta_oc"));
  EXPECT_THAT(with(&V::short_circuit_current_A, std::nan("")), HasSubstr("no number for Isc"));
  EXPECT_THAT(complaint([](DataSheet* sheet) { sheet->cells_in_series = 0; }),
              HasSubstr("at least 1 cell"));
  EXPECT_THAT(complaint([](DataSheet* sheet) { sheet->half_unit.beta_oc_V_K = -1; }),
              HasSubstr("rounding of beta_oc"));
}

}  // namespace
}  // namespace lyrefit
