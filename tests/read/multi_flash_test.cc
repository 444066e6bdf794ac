#include "lyrefit/read/multi_flash.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "error_of.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/read_curve_set.h"

namespace lyrefit {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// A module whose current follows from its voltage and light: a diode with a shunt, without series
// resistance, so that the open-circuit voltage has a closed form without the shunt.
constexpr double kPhoto_A = 9, kSaturation_A = 3e-9, kDiode_V = 1.7;
constexpr double kReference_V = 0.25, kVoltageTransfer = 3, kCurrentTransfer = -0.05;

double FlashCurrent(double voltage_V, double suns) {
  return suns * kPhoto_A - kSaturation_A * std::expm1(voltage_V / kDiode_V);
}
double OpenVoltage(double suns) { return kDiode_V * std::log1p(suns * kPhoto_A / kSaturation_A); }

// Time, light, voltage, current and temperature of a flash as detector voltages, a row after the
// other. The first reading comes before the light is at its peak.
std::string FlashRows(int samples, double peak, const std::function<double(double)>& voltage_at) {
  std::string rows[5];
  for (int k = 0; k < samples; ++k) {
    const double suns = k == 0 ? 0.3 * peak : peak * std::exp(-3.5 * k / samples);
    const double voltage = voltage_at(suns);
    rows[0] += fmt::format(" {:.7g}", 1e-4 * k);
    rows[1] += fmt::format(" {:.9g}", suns * kReference_V);
    rows[2] += fmt::format(" {:.9g}", voltage / kVoltageTransfer);
    rows[3] += fmt::format(" {:.9g}", FlashCurrent(voltage, suns) * kCurrentTransfer);
    rows[4] += " 0.243";
  }
  return rows[0] + rows[1] + rows[2] + rows[3] + rows[4];
}

std::string FlashFile(int loads, int samples, double peak = 1.4) {
  std::string load_rows;
  for (int k = 0; k < loads; ++k) {
    const double voltage = OpenVoltage(1) * k / loads;
    load_rows += FlashRows(samples, peak, [voltage](double) { return voltage; });
  }
  return fmt::format(
      "[Cell Inputs]\nNumber of Cells per String = \"60\"\nNumber of Strings = \"1\"\n"
      "Temperature (C) = \"25\"\nIntensity (suns) = \"1\"\n\n[Calibration]\n"
      "Current Transfer = \"{}\"\nVoltage Transfer = \"{}\"\n"
      "Reference Constant (V/sun) = \"{}\"\nTemperature Offset (C) = \"-0.6\"\n"
      "Power per Sun (W/m2) = \"1000\"\n[Output]\nTemperature (C) = \"23.4\"\n[Raw]\n"
      "Averaged Data Out (Voc Array) = \"<size(s)=5 {}>{}\"\n"
      "Averaged Data Out (VLoad Array) = \"<size(s)={} 5 {}>{}\"\n",
      kCurrentTransfer, kVoltageTransfer, kReference_V, samples,
      FlashRows(samples, peak, OpenVoltage), loads, samples, load_rows);
}

TEST(MultiFlashTest, FlashesGiveTheCurvesAtEqualLight) {
  for (const int samples : {60, 500}) {
    const auto flashes = ReadMultiFlash(FlashFile(20, samples), "f.mfr");
    ASSERT_TRUE(flashes) << flashes.error().ToString();
    ASSERT_EQ(flashes->curves.size(), 8U);  // at 0.1 to 1.2 suns, and the trace
    ASSERT_EQ(flashes->at_target, std::optional<std::size_t>(5));
    for (std::size_t c = 0; c + 1 < flashes->curves.size(); ++c) {
      const RawCurve& raw = flashes->curves[c];
      const double suns = *raw.stated.irradiance_W_m2 / 1000;
      ASSERT_EQ(raw.curve.size(), 21U);
      for (std::size_t k = 0; k < raw.curve.size(); ++k) {
        // At equal voltage the current is linear in the light: interpolation is exact. The reading at
        // open circuit is not.
        const double lost_A = std::fabs(raw.curve.current_A[k]) < 1e-9 ? 0.01 : 1e-6;
        EXPECT_NEAR(raw.curve.current_A[k], FlashCurrent(raw.curve.voltage_V[k], suns), lost_A)
            << suns << " suns, reading " << k;
      }
      EXPECT_EQ(*raw.stated.cells_in_series, 60);
      EXPECT_EQ(raw.stated.notes.setup, Setup::kFlash);
      EXPECT_NEAR(*raw.stated.temperature_C, 24, 1e-12);
    }
  }
}

TEST(MultiFlashTest, TheFlashAtOpenCircuitIsASunsVocTrace) {
  const auto flashes = ReadMultiFlash(FlashFile(20, 500), "f.mfr");
  ASSERT_TRUE(flashes) << flashes.error().ToString();
  const IvCurve& trace = flashes->curves.back().curve;
  ASSERT_TRUE(trace.suns_voc_A);
  EXPECT_NEAR(*trace.suns_voc_A, kPhoto_A, 1e-4 * kPhoto_A);
  ASSERT_GT(trace.size(), 20U);
  for (std::size_t k = 0; k < trace.size(); ++k) {
    const double suns = 1 - trace.current_A[k] / *trace.suns_voc_A;
    EXPECT_NEAR(trace.voltage_V[k], OpenVoltage(suns), 1e-3);
  }
}

TEST(MultiFlashTest, TheCurveAtTheTargetIsReadUnlessAnotherIsChosen) {
  const std::string text = FlashFile(12, 80);
  const auto curve = ReadCurveText(text, "flash");
  ASSERT_TRUE(curve) << curve.error().ToString();
  EXPECT_EQ(curve->conditions.irradiance_W_m2, 1000);
  ReadOptions options;
  options.curve = 3;
  const auto chosen = ReadCurveText(text, "flash", options);
  ASSERT_TRUE(chosen) << chosen.error().ToString();
  EXPECT_NEAR(chosen->conditions.irradiance_W_m2, 400, 1e-9);
  options.curve = 30;
  EXPECT_THAT(MessageOf(ReadCurveText(text, "flash", options)),
              HasSubstr("curve 30 was asked for, but the file holds 8 curves"));
  // No flash passes the target: the others are offered.
  EXPECT_THAT(MessageOf(ReadCurveText(FlashFile(12, 80, 0.7), "flash")),
              AllOf(HasSubstr("found 4"), HasSubstr("choose one with --curve")));
}

TEST(MultiFlashTest, WhatIsMissingOrWrongIsNamedWithItsLine) {
  const std::string good = FlashFile(8, 20);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return [&] {
      const auto read = ReadMultiFlash(text, "f.mfr");
      return read ? std::string("no error") : read.error().ToString();
    }();
  };
  EXPECT_THAT(with("Voltage Transfer", "Transfer"),
              HasSubstr("expected the constant \"Voltage Transfer\", found none"));
  EXPECT_THAT(with("= \"0.25\"", "= \"0\""),
              HasSubstr("f.mfr:10:1: expected a number other than 0"));
  EXPECT_THAT(with("<size(s)=8 5 20>", "<size(s)=8 5 21>"),
              HasSubstr("found 800 numbers for 840 by the sizes"));
  EXPECT_THAT(with("<size(s)=8 5 20>", "<size(s)=8 100>"), HasSubstr("in 3 dimensions"));
  EXPECT_THAT(with("<size(s)=8 5 20> 0", "<size(s)=8 5 20> x"), HasSubstr("'x' at place 1"));
  EXPECT_THAT(with("<size(s)=8 5 20>", "<size(s)=-8 5 20>"), HasSubstr("the size '-8'"));
}

}  // namespace
}  // namespace lyrefit
