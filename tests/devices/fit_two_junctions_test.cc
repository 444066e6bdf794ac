#include "lyrefit/devices/fit_two_junctions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/base/random.h"
#include "lyrefit/model/two_junctions.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

const std::vector<double> kTandemTruth = {0.0195, 1e-14, 1.4, 3000, 0.0202, 3e-10, 1.2, 1500, 2.0};

IvCurve TandemCurve(const std::string& name, double top, double bottom) {
  IvCurve curve;
  curve.name = name;
  curve.conditions.cells_in_series = 2;
  curve.notes.light_top = top;
  curve.notes.light_bottom = bottom;
  std::vector<double> p = kTandemTruth;
  p[JunctionPhotocurrent(0)] *= top;
  p[JunctionPhotocurrent(1)] *= bottom;
  const double thermal_V = ThermalVoltage(curve.conditions.cell_temperature_K);
  const double voc = TwoJunctionVoltage(thermal_V, p.data(), 0);
  for (int k = 0; k < 40; ++k) {
    curve.voltage_V.push_back(-0.1 + (1.02 * voc + 0.1) * k / 39);
    curve.current_A.push_back(TwoJunctionCurrent(thermal_V, p.data(), curve.voltage_V.back()));
  }
  return curve;
}

// The set with independent noise of 0.1 % of its currents.
CurveSet Noisy(CurveSet set) {
  RandomStream random(1);
  for (IvCurve& curve : set.curves) {
    for (double& current : curve.current_A) current += 2e-5 * random.Normal();
  }
  return set;
}

CurveSet TandemSet() {
  CurveSet set;
  set.name = "tandem";
  set.curves = {TandemCurve("white", 1, 1), TandemCurve("red", 0.9, 1.1),
                TandemCurve("blue", 1.1, 0.9)};
  return set;
}

const Estimate& At(const TwoJunctionReport& report, const std::string& symbol) {
  for (const Estimate& e : report.estimates) {
    if (e.info.symbol == symbol) return e;
  }
  ADD_FAILURE() << symbol;
  return report.estimates.front();
}

std::string WhyNot(const CurveSet& set, const TwoJunctionOptions& options = {}) {
  const auto report = FitTwoJunctions(set, options);
  return report ? "" : report.error().message;
}

TEST(FitTwoJunctions, FindsTheTandemOfExactCurves) {
  CurveSet set = TandemSet();
  set.curves.push_back(TandemCurve("top alone", 1, 0));
  const auto report = FitTwoJunctions(set);
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_LT(report->rmse.refined.solved_current_A, 1e-12);
  EXPECT_GT(report->rmse.searched.solved_current_A, report->rmse.refined.solved_current_A);
  for (int i = 0; i < kTwoJunctionParameters; ++i) {
    EXPECT_NEAR(report->estimates[i].refined / kTandemTruth[i], 1, 1e-5)
        << report->estimates[i].info.symbol;
  }
  EXPECT_EQ(report->curves[0].limiting, 1);
  EXPECT_EQ(report->curves[2].limiting, 2);
}

TEST(FitTwoJunctions, SpectraDecideWhatOneCurveLeavesOpen) {
  CurveSet set = Noisy(TandemSet());
  const auto many = FitTwoJunctions(set);
  ASSERT_TRUE(many);
  EXPECT_FALSE(many->interchangeable);
  for (const char* symbol : {"Iph1", "n1", "Rsh1", "Iph2", "n2", "Rsh2", "Rs"}) {
    const Estimate& e = At(*many, symbol);
    const double truth = kTandemTruth[&e - many->estimates.data()];
    EXPECT_TRUE(e.identifiable) << symbol << " " << e.reason;
    // Within four standard deviations: of seven intervals of 95 %, one may miss.
    EXPECT_LE(2 * e.low_95 - e.refined, truth) << symbol;
    EXPECT_GE(2 * e.high_95 - e.refined, truth) << symbol;
  }
  set.curves.resize(1);
  const auto one = FitTwoJunctions(set);
  ASSERT_TRUE(one);
  EXPECT_TRUE(one->interchangeable);
  for (const char* symbol : {"x2", "Is1", "Rsh2"}) {
    EXPECT_FALSE(At(*one, symbol).identifiable) << symbol;
    EXPECT_FALSE(At(*one, symbol).reason.empty()) << symbol;
  }
  ASSERT_FALSE(one->decided_by.empty());
  EXPECT_THAT(one->decided_by.front(), HasSubstr("second spectrum"));
}

// The noisy set with these true lights under the stated ones.
CurveSet MisstatedLights(const std::vector<StatedLight>& lights) {
  CurveSet set = TandemSet();
  for (std::size_t c = 0; c < set.curves.size(); ++c) {
    const DeviceNotes stated = set.curves[c].notes;
    set.curves[c] = TandemCurve(set.curves[c].name, lights[c].top, lights[c].bottom);
    set.curves[c].notes = stated;
  }
  return Noisy(std::move(set));
}

TEST(FitTwoJunctions, TestsTheFitAgainstTheNoise) {
  TwoJunctionOptions options;
  options.intervals = Intervals::kSymmetric;
  const auto report = FitTwoJunctions(Noisy(TandemSet()), options);
  ASSERT_TRUE(report);
  EXPECT_NEAR(report->test.noise_A, 2e-5, 6e-6);
  EXPECT_NEAR(report->test.rmse_over_noise, 1, 0.25);
  EXPECT_GT(report->test.p_value, 0.01);
  EXPECT_EQ(report->light_part, 0);
  EXPECT_FALSE(report->exchanged);
  EXPECT_TRUE(report->warnings.empty());
}

TEST(FitTwoJunctions, AllowsForLightsThatAreOff) {
  const CurveSet set =
      MisstatedLights({{1, 1}, {0.9 * 1.02, 1.1 * 0.98}, {1.1 * 0.985, 0.9 * 1.02}});
  TwoJunctionOptions options;
  options.intervals = Intervals::kSymmetric;
  // Symmetric intervals do not reach to a junction that is hardly a diode.
  options.bounds = {{"Is1", {1e-20, 1e-8}}, {"Is2", {1e-16, 1e-6}}};
  const auto found = FitTwoJunctions(set, options);
  options.light_accuracy = 0.02;
  const auto stated = FitTwoJunctions(set, options);
  ASSERT_TRUE(found && stated);
  EXPECT_LT(found->test.p_value, 0.01);
  EXPECT_LT(found->exact_lights_p, 0.001);
  EXPECT_GT(found->light_part, 0.005);
  EXPECT_EQ(stated->light_part, 0.02);
  for (const auto* report : {&*found, &*stated}) {
    EXPECT_FALSE(report->exchanged);
    EXPECT_GT(report->test_of_rest.p_value, 0.01);
    EXPECT_EQ(report->curves[0].light_error[0], 0);  // 1:1 is the reference
    EXPECT_NE(report->curves[1].light_error[0], 0);
    for (const char* symbol : {"Iph1", "Iph2", "n1", "n2"}) {
      const Estimate& e = At(*report, symbol);
      const double truth = kTandemTruth[&e - report->estimates.data()];
      EXPECT_LE(2 * e.low_95 - e.refined, truth) << symbol;
      EXPECT_GE(2 * e.high_95 - e.refined, truth) << symbol;
    }
  }
}

TEST(FitTwoJunctions, NoticesExchangedSpectra) {
  TwoJunctionOptions options;
  options.intervals = Intervals::kSymmetric;
  // Spectra that are mirror images would exchange the junctions alone.
  CurveSet set;
  set.curves = {TandemCurve("white", 1, 1), TandemCurve("red", 1.08, 0.8),
                TandemCurve("blue", 0.7, 1.12)};
  std::swap(set.curves[1].notes, set.curves[2].notes);
  const auto report = FitTwoJunctions(Noisy(std::move(set)), options);
  ASSERT_TRUE(report);
  ASSERT_TRUE(report->exchanged) << report->test.rmse_over_noise << " " << report->test.p_value
                                 << " " << report->rmse.refined.solved_current_A << " "
                                 << report->curves[1].light.top;
  EXPECT_EQ(report->exchanged->first, "red");
  EXPECT_EQ(report->exchanged->second, "blue");
  EXPECT_LT(report->exchanged->rmse_A, 0.6 * report->rmse.refined.solved_current_A);
  EXPECT_FALSE(report->usable);
  EXPECT_THAT(report->warnings, ::testing::Contains(HasSubstr("red and blue look exchanged")));
}

TEST(FitTwoJunctions, SaysNothingOfCellsInSeries) {
  CurveSet set = Noisy(TandemSet());
  set.curves.resize(1);
  set.curves[0].assumptions = {Assumption("cells in series assumed 1", About::kCells),
                               Assumption("cell temperature assumed 25 C", About::kTemperature)};
  TwoJunctionOptions options;
  options.intervals = Intervals::kNone;
  const auto report = FitTwoJunctions(set, options);
  ASSERT_TRUE(report);
  EXPECT_THAT(report->warnings, ::testing::ElementsAre(HasSubstr("cell temperature")));
  EXPECT_EQ(report->curves[0].curve.assumptions.size(), 1U);
}

TEST(FitTwoJunctions, AnUnknownLightIsAPhotocurrentOfItsCurve) {
  CurveSet set = TandemSet();
  set.curves.pop_back();
  TwoJunctionOptions options;
  options.intervals = Intervals::kNone;
  options.lights["red"] = {0.9, kUnknown};
  const auto report = FitTwoJunctions(set, options);
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_FALSE(report->interchangeable);
  EXPECT_LT(report->rmse.refined.solved_current_A, 1e-7);
  EXPECT_EQ(report->estimates.size(), 10U);
  EXPECT_EQ(report->estimates.back().info.symbol, "Iph2[red]");
}

TEST(FitTwoJunctions, ThreadsChangeNothing) {
  CurveSet set = Noisy(TandemSet());
  set.curves.resize(2);
  TwoJunctionOptions options;
  std::vector<double> ends[2];
  for (const int threads : {1, 2}) {
    options.threads = threads;
    const auto report = FitTwoJunctions(set, options);
    ASSERT_TRUE(report);
    for (const Estimate& e : report->estimates) {
      for (const double value : {e.refined, e.low_95, e.high_95}) {
        ends[threads - 1].push_back(value);
      }
    }
  }
  EXPECT_EQ(ends[0], ends[1]);
}

TEST(FitTwoJunctions, RefusesWhatItCannotUse) {
  EXPECT_THAT(WhyNot({}), HasSubstr("at least one curve"));
  TwoJunctionOptions options;
  options.lights["green"] = {1, 1};
  EXPECT_THAT(WhyNot(TandemSet(), options), HasSubstr("there is no curve green"));
  options.lights = {{"red", {-1, 1}}};
  EXPECT_THAT(WhyNot(TandemSet(), options), HasSubstr("a light of at least 0"));
  options.lights = {{"red", {0, 0}}};
  EXPECT_THAT(WhyNot(TandemSet(), options), HasSubstr("must be lit"));
  options.lights.clear();
  options.fixed["n3"] = 1;
  EXPECT_THAT(WhyNot(TandemSet(), options), HasSubstr("no parameter n3"));
  CurveSet warm = TandemSet();
  warm.curves[1].conditions.cell_temperature_K += 20;
  EXPECT_THAT(WhyNot(warm), HasSubstr("one temperature"));
}

TEST(StatedLight, IsReadAsItIsWritten) {
  for (const char* text : {"red=1:0.9", "a=b=0:1", "red=1:?"}) {
    const auto light = ReadStatedLight(text);
    ASSERT_TRUE(light) << text;
    EXPECT_EQ(StatedLightText(light->first, light->second), text);
  }
  for (const char* text : {"red", "=1:1", "red=1", "red=1:x"}) {
    EXPECT_FALSE(ReadStatedLight(text)) << text;
  }
}

}  // namespace
}  // namespace lyrefit
