#include "lyrefit/devices/describe_cell.h"
#include "error_of.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/random.h"
#include "lyrefit/devices/cell_figures.h"
#include "lyrefit/devices/device_documents.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const double kNoise = 1e-6;

CellReport Described(const std::vector<IvCurve>& curves, const CellOptions& options = {}) {
  const auto report = DescribeCell(CellOf(curves), options);
  EXPECT_TRUE(report) << report.error().ToString();
  return *report;
}

const SeriesResistance* Method(const CellReport& report, const std::string& begin) {
  for (const SeriesResistance& one : report.series_resistance) {
    if (one.Name().rfind(begin, 0) == 0) return &one;
  }
  return nullptr;
}

TEST(DescribeCell, EveryMethodFindsTheSeriesResistance) {
  const CellReport report =
      Described({CellSweepOf(kCellTruth, 1000, false, kNoise),
                 CellSweepOf(kCellTruth, 500, false, kNoise), CellSweepOf(kCellTruth, 0)});
  for (const char* method : {"single-diode fit", "two lights", "lit against dark, Rs of the dark",
                             "lit against dark, equal Rs"}) {
    ASSERT_NE(Method(report, method), nullptr) << method;
    EXPECT_NEAR(Method(report, method)->ohm.value, kCellTruth[3], 0.2) << method;
  }
  EXPECT_GT(Method(report, "slope at Voc")->ohm.value, kCellTruth[3]);
  EXPECT_NEAR(report.PerArea(4), 1, 1e-12);
}

// A wrong unit, area or sign gives no current density and no efficiency, but a doubt that says why.
TEST(DescribeCell, GivesNoEfficiencyOfAnImpossibleCurrentAreaOrSign) {
  const IvCurve sound = CellSweepOf(kCellTruth, 1000, false, kNoise);
  EXPECT_EQ(Described({sound}).sweeps[0].doubt, "");
  EXPECT_GT(Described({sound}).sweeps[0].efficiency, 0.1);
  IvCurve milliampere = sound, other_area = sound, reversed = sound;
  for (double& i : milliampere.current_A) i *= 1000;
  other_area.notes.area_cm2 = 0.025;
  for (double& v : reversed.voltage_V) v = -v;
  EXPECT_THAT(MessageOf(DescribeCell(CellOf({reversed}), {})), HasSubstr("the wrong sign?"));
  EXPECT_THAT(Described({sound, reversed}).warnings, Contains(HasSubstr("is left out")));
  for (const IvCurve& wrong : {milliampere, other_area}) {
    CellReport report = Described({wrong});
    const CellSweep& sweep = report.sweeps[0];
    EXPECT_NE(sweep.doubt, "");
    EXPECT_TRUE(std::isnan(sweep.efficiency) && std::isnan(sweep.jsc_mA_cm2));
    EXPECT_THAT(report.warnings, Contains(HasSubstr(sweep.doubt)));
  }
  other_area.as_is = true;
  EXPECT_GT(Described({other_area}).sweeps[0].efficiency, 1);
}

TEST(DescribeCell, NamesCurvesThatCouldNotBeRead) {
  CurveSet cell = CellOf({CellSweepOf(kCellTruth, 1000, false, kNoise)});
  cell.rejected.push_back({"px dark", Error{"expected a number", "a.csv", 7, 2}});
  const auto report = DescribeCell(cell, {});
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_THAT(report->warnings, Contains("px dark left out: a.csv:7:2: expected a number"));
}

TEST(DescribeCell, LightAndDarkCurvesOfOneDiodeSuperpose) {
  const CellReport report = Described(
      {CellSweepOf(kCellTruth, 1000, false, kNoise), CellSweepOf(kCellTruth, 0, false, kNoise)});
  ASSERT_TRUE(report.superposition);
  EXPECT_FALSE(report.superposition->departs);
  EXPECT_NEAR(report.superposition->dark_scale, 1, 0.03);
}

TEST(DescribeCell, ADarkCellThatIsWarmerDoesNotSuperpose) {
  std::vector<double> warmer = kCellTruth;
  warmer[1] *= 3;
  const CellReport report = Described(
      {CellSweepOf(kCellTruth, 1000, false, kNoise), CellSweepOf(warmer, 0, false, kNoise)});
  ASSERT_TRUE(report.superposition);
  EXPECT_TRUE(report.superposition->departs);
  EXPECT_NEAR(report.superposition->dark_scale, 1 / 3.0, 0.03);
  EXPECT_THAT(report.superposition->causes[0], HasSubstr("the dark cell was warmer"));
  EXPECT_THAT(report.superposition->causes, Contains(HasSubstr("collection")));
  EXPECT_THAT(Method(report, "lit against dark")->missing, HasSubstr("do not superpose"));
}

TEST(DescribeCell, LossesOfTheFillFactorAddUpAndHoldTheTruth) {
  const CellReport report = Described({CellSweepOf(kCellTruth, 1000, false, kNoise)});
  ASSERT_EQ(report.losses.size(), 1U);
  const FillFactorLosses& losses = report.losses[0];
  ASSERT_EQ(losses.missing, "");
  double left = losses.ideal;
  for (const FillFactorPart& part : losses.parts) {
    left -= part.loss.value;
    EXPECT_LE(part.loss.low_95, part.loss.value) << part.name;
    EXPECT_GE(part.loss.high_95, part.loss.value) << part.name;
  }
  EXPECT_NEAR(left, losses.measured, 1e-14);
  EXPECT_NEAR(losses.green_n1, losses.ideal, 2e-3);
  EXPECT_EQ(report.pseudo.source, PseudoSource::kFit);
  EXPECT_EQ(report.pseudo.value, losses.without_series);
}

TEST(DescribeCell, AShuntInVocOverLightGivesNoNegativeSeriesResistance) {
  std::vector<double> p = kCellTruth;
  p[4] = 1200;  // Voc falls faster than the light
  const CellReport report =
      Described({CellSweepOf(p, 1000, false, kNoise), CellSweepOf(p, 300, false, kNoise),
                 CellSweepOf(p, 100, false, kNoise)});
  const SeriesResistance* const voc = Method(report, "Voc of the light series");
  ASSERT_NE(voc, nullptr);
  EXPECT_TRUE(std::isnan(voc->ohm.value));
  EXPECT_THAT(voc->missing, HasSubstr("below 0 as no resistance is; a shunt"));
  EXPECT_EQ(report.pseudo.source, PseudoSource::kFit);
  EXPECT_GT(report.pseudo.value, report.sweeps[report.main].key.fill_factor);
}

// A trace of Suns-Voc of a diode of this n, with 0.3 mV of noise.
IvCurve TraceOfDiode(double n, std::uint64_t seed) {
  constexpr int kPoints = 80;
  RandomStream random(9, seed);
  IvCurve trace = CellSweepOf(kCellTruth, 1000);
  trace.voltage_V.clear();
  trace.current_A.clear();
  trace.suns_voc_A = kCellTruth[0];
  const double voc = 1.4 * ThermalVoltage(298.15) * std::log(kCellTruth[0] / kCellTruth[1]);
  for (int k = 0; k < kPoints; ++k) {
    const double suns = 0.02 * std::pow(100.0, k / (kPoints - 1.0));
    trace.voltage_V.push_back(voc + n * ThermalVoltage(298.15) * std::log(suns) +
                              3e-4 * random.Normal());
    trace.current_A.push_back(*trace.suns_voc_A * (1 - suns));
  }
  return trace;
}

TEST(DescribeCell, NoiseOfATraceVoidsNoFitButAnotherIdealityDoes) {
  const IvCurve lit = CellSweepOf(kCellTruth, 1000, false, kNoise);
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const CellReport same = Described({lit, TraceOfDiode(1.4, seed)});
    EXPECT_TRUE(same.sweeps[0].diode()) << seed;
    const CellReport other = Described({lit, TraceOfDiode(1.2, seed)});
    EXPECT_THAT(other.sweeps[0].void_because, Contains(HasSubstr("of Voc over light"))) << seed;
  }
}

TEST(DescribeCell, RatesAndHoursNameTheSweepsThatTheyTellApart) {
  std::vector<IvCurve> curves;
  for (const double hours : {0.0, 24.0, 100.0}) {
    std::vector<double> p = kCellTruth;
    p[0] *= 1 - hours / 1000;
    curves.push_back(CellSweepOf(p, 1000, false, kNoise));
    curves.back().notes.elapsed_h = hours;
    curves.back().source = std::to_string(hours);
  }
  const CellReport series = Described(curves);
  EXPECT_EQ(series.sweeps[2].name, "forward, 1000 W/m2, 100 h");
  EXPECT_THAT(CellText(series), HasSubstr("Over hours"));
  EXPECT_THAT(CellText(series), HasSubstr("Pmp 89.8 % of the first"));
  // Dates are hours since the first.
  for (IvCurve& curve : curves) {
    curve.notes.date = curve.notes.elapsed_h > 50 ? "2025-03-13 10:00" : "2025-03-12 10:00";
    curve.notes.elapsed_h.reset();
  }
  EXPECT_NEAR(Described(curves).sweeps[2].elapsed_h, 24, 1e-9);
  IvCurve timed = CellSweepOf(kCellTruth, 1000);
  for (std::size_t k = 0; k < timed.size(); ++k) timed.time_s.push_back(0.1 * k);
  const double step_V = std::fabs(timed.voltage_V[1] - timed.voltage_V[0]);
  EXPECT_NEAR(Described({timed}).sweeps[0].scan_rate_V_s, step_V / 0.1, 1e-9);
}

TEST(DescribeCell, OneLightDoesNotTellAShuntFromCollection) {
  const CellReport report = Described({CellSweepOf(kCellTruth, 1000, false, kNoise)});
  EXPECT_EQ(report.losses.at(0).parts.at(1).name, "shunt or collection");
}

TEST(DescribeCell, OneDirectionAloneHasNoHysteresis) {
  EXPECT_THAT(Described({CellSweepOf(kCellTruth, 1000)}).pairs, IsEmpty());
}

TEST(DescribeCell, WithoutAnAreaNothingIsPerAreaAndTheReportSaysWhatToGive) {
  IvCurve curve = CellSweepOf(kCellTruth, 1000, false, kNoise);
  curve.notes.area_cm2.reset();
  const CellReport report = Described({curve});
  EXPECT_TRUE(std::isnan(report.sweeps[0].jsc_mA_cm2));
  EXPECT_TRUE(std::isnan(report.sweeps[0].efficiency));
  EXPECT_THAT(report.warnings, Contains(HasSubstr("--area-cm2")));
}

TEST(DescribeCell, AnIdealityAboveThatOfOneJunctionIsVoid) {
  std::vector<double> p = kCellTruth;
  p[1] = 1e-7;
  p[2] = 3;
  const CellReport report = Described({CellSweepOf(p, 1000, false, kNoise)});
  ASSERT_TRUE(report.sweeps[0].fit);
  EXPECT_FALSE(report.sweeps[0].diode());
  EXPECT_THAT(report.losses[0].missing, HasSubstr("void"));
  EXPECT_TRUE(std::isnan(report.series_resistance[0].ohm.value));
}

TEST(DescribeCell, AnSShapeIsVoid) {
  IvCurve curve = CellSweepOf(kCellTruth, 1000, false, kNoise);
  // A barrier takes half of the current before Voc and gives it back above.
  for (std::size_t k = 0; k < curve.size(); ++k) {
    curve.current_A[k] -= 2e-3 / (1 + std::exp((0.6 - curve.voltage_V[k]) / 0.02));
  }
  const CellReport report = Described({curve});
  EXPECT_LT(report.sweeps[0].least_slope_ratio, 0.9);
  EXPECT_FALSE(report.sweeps[0].diode());
  EXPECT_NEAR(Described({CellSweepOf(kCellTruth, 1000, false, kNoise)}).sweeps[0].least_slope_ratio,
              1, 1e-12);
}

TEST(DescribeCell, AnSShapeIsSeenInBothDirectionsAfterAStartThatSettles) {
  for (const bool down : {false, true}) {
    IvCurve curve = CellSweepOf(kCellTruth, 1000, down, kNoise);
    for (std::size_t k = 0; k < curve.size(); ++k) {
      const double voltage = curve.voltage_V[k];
      curve.current_A[k] += kCellTruth[0] * (0.015 * std::exp(-4 * (voltage + 0.1)) -
                                             0.25 / (1 + std::exp((0.6 - voltage) / 0.02)));
    }
    const CellReport report = Described({curve});
    EXPECT_LT(report.sweeps[0].least_slope_ratio, 0.9);
    EXPECT_FALSE(report.sweeps[0].diode());
  }
}

TEST(DescribeCell, WhatSettlesBeforeTheKneeIsNoSShape) {
  for (const double begins : {0.015, -0.008}) {  // more or less current than when settled
    IvCurve curve = CellSweepOf(kCellTruth, 1000, false, kNoise);
    for (std::size_t k = 0; k < curve.size(); ++k) {
      curve.current_A[k] += begins * kCellTruth[0] * std::exp(-0.04 * static_cast<double>(k));
    }
    const CellReport report = Described({curve});
    EXPECT_THAT(report.sweeps[0].void_because, IsEmpty());
    EXPECT_NEAR(FittedValue(report.sweeps[0], "n1").value, kCellTruth[2], 0.1);
  }
}

TEST(DescribeCell, ACurrentThatRisesBeyondItsNoiseIsVoid) {
  IvCurve curve = CellSweepOf(kCellTruth, 1000, false, kNoise);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    if (curve.voltage_V[k] > 0.45) curve.current_A[k] += 0.015 * kCellTruth[0];
  }
  EXPECT_THAT(Described({curve}).sweeps[0].void_because, Contains(HasSubstr("rises")));
}

TEST(DescribeCell, EqualReadingsAtALimitAreLeftOut) {
  IvCurve curve = CellSweepOf(kCellTruth, 1000, false, kNoise);
  for (double& i : curve.current_A) i = std::max(i, -1e-3);
  const CellReport report = Described({curve});
  EXPECT_GT(report.sweeps[0].limited, 2);
  EXPECT_THAT(report.warnings, Contains(HasSubstr("limit of the source")));
  EXPECT_NEAR(FittedValue(report.sweeps[0], "Rs").value, kCellTruth[3], 0.2);
}

TEST(DescribeCell, SeveralCellsOfOneFileAreRefused) {
  CurveSet cell = CellOf({CellSweepOf(kCellTruth, 1000), CellSweepOf(kCellTruth, 1000)});
  cell.curves[1].source = cell.curves[0].source;
  const auto report = DescribeCell(cell);
  ASSERT_FALSE(report);
  EXPECT_THAT(report.error().message, HasSubstr("several cells"));
  EXPECT_FALSE(DescribeCell(CurveSet()));
  CellOptions options;
  options.largest_n = 0;
  EXPECT_FALSE(DescribeCell(CellOf({CellSweepOf(kCellTruth, 1000)}), options));
}

TEST(DescribeCell, WithoutFitsTheKeyPointsStay) {
  CellOptions options;
  options.fit = false;
  const CellReport report = Described({CellSweepOf(kCellTruth, 1000)}, options);
  EXPECT_FALSE(report.sweeps[0].fit);
  EXPECT_GT(report.sweeps[0].efficiency, 0.1);
  EXPECT_THAT(report.series_resistance[0].missing, HasSubstr("no fit was requested"));
}

// With both signs turned no current flows the way that a lit cell delivers it; no dark curve either.
TEST(DescribeCell, GivesNoFiguresOfACurveTurnedInBothSigns) {
  IvCurve turned = CellSweepOf(kCellTruth, 1000, false, kNoise);
  for (double& v : turned.voltage_V) v = -v;
  for (double& i : turned.current_A) i = -i;
  const auto report = DescribeCell(CellOf({turned}), {});
  ASSERT_FALSE(report);
  EXPECT_THAT(report.error().ToString(), HasSubstr("turn it in the file"));
}

}  // namespace
}  // namespace lyrefit
