#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "family/synthetic_effects.h"
#include "lyrefit/read/write_curve.h"
#include "repeats.h"
#include "run_app.h"
#include "same_curve.h"

namespace lyrefit {
namespace {

constexpr const char* kLaboratory = " --noise white --floor-current 0 --floor-power 0";

using ::nlohmann::json;
using ::testing::HasSubstr;

constexpr char kQuickRun[] = " --iterations 15 --population 12 --quiet ";

class WithFamily : public ::testing::Test {
 protected:
  void SetUp() override {
    const Translation law = SyntheticLaw(TranslationLaw::kDeSoto);
    const std::vector<double> truth = SyntheticTruth(law);
    CurveSet set = SyntheticSet(law, truth, kSixPlaces, 30, 0);
    AddSyntheticEffects({UseOf("nonohmic_shunt", {{"k", {0.15, 0.15}}, {"m", {2.5, 2.5}}})}, law,
                        truth, 1e-3, &set);
    for (const IvCurve& curve : set.curves) {
      folder_.Write("set/" + curve.name + ".csv", CurveToCsv(curve));
      folder_.Write("set/" + curve.name + ".json", CurveSidecarJson(curve));
    }
  }

  std::string Quoted(const std::string& name) const { return "'" + folder_.Path(name) + "'"; }
  AppResult Fit(const std::string& flags) const {
    return RunApp("fit " + Quoted("set") + " " + flags);
  }
  json Read(const std::string& name) const { return json::parse(FileText(folder_.Path(name))); }

  // Currents of a curve simulated from a report.
  std::vector<double> Simulated(const std::string& file, const std::string& curve,
                                const std::string& more = "") const {
    const AppResult made =
        RunApp("simulate --from " + Quoted(file) + " --curve " + curve + " " + more);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return CurrentsOf(made.out);
  }

  TempFolder folder_;
};

void ExpectSame(const std::vector<double>& one, const std::vector<double>& other) {
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t k = 0; k < one.size(); ++k) EXPECT_NEAR(one[k], other[k], 1e-9) << k;
}

std::vector<double> Sum(const json& one, const json& other) {
  std::vector<double> sum;
  for (std::size_t k = 0; k < one.size(); ++k) {
    sum.push_back(one[k].get<double>() + other[k].get<double>());
  }
  return sum;
}

TEST_F(WithFamily, AJointFitIsReportedDrawnAndSimulatedAgain) {
  const AppResult fit = Fit("--family desoto --with nonohmic_shunt --json " + Quoted("fit.json") +
                            " -v --plot " + Quoted("fit.svg") + " --iterations 15 --population 12");
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  EXPECT_THAT(fit.out, HasSubstr("effects       non-ohmic shunt (nonohmic_shunt)"));
  EXPECT_THAT(fit.out, HasSubstr("nonohmic_shunt.k (A/V^m)"));
  EXPECT_THAT(fit.out, HasSubstr("with = nonohmic_shunt"));
  EXPECT_THAT(FileText(folder_.Path("fit.svg")), HasSubstr("desoto sd + nonohmic_shunt"));
  const json report = Read("fit.json");
  EXPECT_EQ(report["causes"], json::array({"nonohmic_shunt"}));
  const json& strength = report["parameters"]["nonohmic_shunt.k"];
  EXPECT_LT(strength["low_95"], 0.15);
  EXPECT_GT(strength["high_95"], 0.15);
  EXPECT_LT(strength["jackknife"]["low_95"], strength["refined"]);
  ASSERT_EQ(report["curves"].size(), 6U);
  for (std::size_t c = 0; c < 6; ++c) {
    ExpectSame(Simulated("fit.json", report["curves"][c]["id"]),
               Sum(report["law"]["curves"][c]["current_A"], report["curves"][c]["residual_A"]));
  }
  EXPECT_NE(Simulated("fit.json", "c1", "--with voltage_offset:c=0.1"),
            Simulated("fit.json", "c1"));
}

TEST_F(WithFamily, CurvesFittedOneByOneAreSimulatedAgain) {
  const AppResult fit = Fit("--family free --with nonohmic_shunt:m=2.5 --json " +
                            Quoted("free.json") + " --csv " + Quoted("free.csv"));
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  EXPECT_THAT(fit.out, HasSubstr("nonohmic_shunt.k"));
  EXPECT_THAT(FileText(folder_.Path("free.csv")),
              HasSubstr(",cells_in_series,nonohmic_shunt_shunt_strength"));
  const json report = Read("free.json");
  for (std::size_t c = 0; c < 6; ++c) {
    const json& curve = report["curves"][c];
    const std::vector<double> made = Simulated("free.json", curve["id"]);
    const json& measured = report["law"]["curves"][c]["current_A"];
    ASSERT_EQ(made.size(), measured.size());
    double sum = 0;
    for (std::size_t k = 0; k < made.size(); ++k) {
      sum += std::pow(made[k] - measured[k].get<double>(), 2);
    }
    EXPECT_NEAR(std::sqrt(sum / static_cast<double>(made.size())),
                curve["individual_rmse"]["solved_current_A"], 1e-9);
  }
}

TEST_F(WithFamily, ADiagnosisOfManyCurvesIsSimulatedAgain) {
  SKIP_IF_SANITIZED();
  const AppResult diagnosed = RunApp("diagnose " + Quoted("set") + kLaboratory +
                                     " --quiet --extend " + Quoted("extended.json"));
  ASSERT_EQ(diagnosed.exit_code, 0) << diagnosed.err;
  const json report = Read("extended.json");
  EXPECT_THAT(report["causes"], ::testing::Contains("nonohmic_shunt"));
  EXPECT_EQ(report["curves"], 6);
  std::vector<double> all;
  for (const json& curve : report["law"]["curves"]) {
    const std::vector<double> one = Simulated("extended.json", curve["id"]);
    all.insert(all.end(), one.begin(), one.end());
  }
  ExpectSame(all, report["data"]["model_current_A"].get<std::vector<double>>());
}

TEST_F(WithFamily, APlainFamilysCurveIsThatOfItsOwnParameters) {
  ASSERT_EQ(Fit("--family pvsyst --temperature-offset --irradiance-accuracy 1 --json " +
                Quoted("plain.json") + kQuickRun)
                .exit_code,
            0);
  const json report = Read("plain.json");
  const json& curve = report["curves"][1];
  const std::vector<double> currents = Simulated("plain.json", "c2", "--voltages 0:18:19");
  Conditions at;
  at.cells_in_series = 36;
  at.cell_temperature_K = curve["temperature_C"].get<double>() + kZeroCelsius_K +
                          report["sensor_offsets"]["temperature_K"]["value"].get<double>();
  const Device device = MakeDevice(Model::kSingleDiode, at);
  std::vector<double> p, voltage_V;
  for (const ParameterInfo& info : device.parameters) p.push_back(curve["parameters"][info.name]);
  for (int k = 0; k < 19; ++k) voltage_V.push_back(k);
  ExpectSame(currents, SolveCurrents(device, p.data(), voltage_V));
}

TEST_F(WithFamily, SaysWhatIsWrong) {
  ExpectRefusals(
      "fit " + Quoted("set") + kQuickRun + " ",
      {
          {"--family desoto --with nonsense", "there is no effect 'nonsense'"},
          {"--family desoto --with shading", "each curve of a set has its own (--force"},
          {"--family desoto --with nonohmic_shunt:q=1", "has no parameter 'q', expected k, m"},
          {"--family desoto --with nonohmic_shunt:m=9", "m = 9 is outside 1.3 to 5"},
          {"--family desoto --with substrings:w1=0.6,w2=0.6 --force", "leave no cell for the rest"},
          {"--family pvsyst --with second_diode", "expected the family desoto, or free"},
          {"--family desoto --with second_diode --temperature-offset", "temp_offset"},
          {"--family free --with irr_step:a=x", "expected PARAMETER=VALUE"},
      });
}

}  // namespace
}  // namespace lyrefit
