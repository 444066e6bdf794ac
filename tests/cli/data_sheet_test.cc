#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_app.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// A module of 36 cells.
const std::string kCurrents = "datasheet --isc 4.75 --imp 4.26 --vmp 17.6 ";
const std::string kSheet = kCurrents + "--voc 21.6 --alpha 0.002 --beta -0.076 --cells 36";

TEST(DataSheetVerb, PrintsTheDevice) {
  const AppResult result = RunApp(kSheet + " --gamma -0.45");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("behind a data sheet"));
  EXPECT_THAT(result.out, HasSubstr("within the rounding"));
  EXPECT_THAT(result.out, HasSubstr("gamma_pmp"));
}

// The digits of "4.75" state its rounding, half a unit of the last digit. Coefficients in percent
// refer to the values at 25 C.
TEST(DataSheetVerb, WritesJson) {
  const AppResult kelvin = RunApp(kSheet + " --exact --json -");
  ASSERT_EQ(kelvin.exit_code, 0) << kelvin.err;
  const json j = json::parse(kelvin.out, nullptr, false);
  EXPECT_EQ(j["cells_in_series"], 36);
  EXPECT_NEAR(j["checks"]["Isc"]["given"].get<double>(), 4.75, 1e-6);
  EXPECT_TRUE(j["parameters"]["R_s"]["low"].is_null());
  const AppResult percent =
      RunApp(kCurrents + "--voc 21.6 --alpha 0.04% --beta -0.35% --cells 36 --json -");
  ASSERT_EQ(percent.exit_code, 0) << percent.err;
  const json p = json::parse(percent.out, nullptr, false);
  EXPECT_NEAR(p["checks"]["beta_oc"]["printed"].get<double>(), -0.0756, 1e-12);
}

TEST(DataSheetVerb, WritesWhatPvlibTakes) {
  const AppResult result = RunApp(kSheet + " --name M1 --technology Multi-c-Si --pvlib -");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json j = json::parse(result.out, nullptr, false);
  EXPECT_EQ(j["function"], "calcparams_desoto");
  EXPECT_TRUE(j["parameters"].contains("R_sh_ref"));
  EXPECT_EQ(j["cec"]["Name"], "M1");
  EXPECT_EQ(j["cec"]["Technology"], "Multi-c-Si");
}

// The three points leave one device for every n; the result is the device with the stated beta_oc.
TEST(DataSheetVerb, ShowsAndDrawsTheFamily) {
  const TempFolder folder;
  const std::string picture = folder.Path("family.svg"), page = folder.Path("family.html");
  const AppResult text = RunApp(kSheet + " --plot '" + picture + "' --html '" + page + "'");
  ASSERT_EQ(text.exit_code, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("0  picked"));
  EXPECT_THAT(FileText(picture), HasSubstr("</svg>"));
  EXPECT_THAT(FileText(page), HasSubstr("All devices through the sheet"));
  const AppResult result = RunApp(kSheet + " --json -");
  const json j = json::parse(result.out, nullptr, false);
  EXPECT_EQ(j["family"]["picked"]["n"], j["parameters"]["n"]["value"]);
  EXPECT_EQ(j["family"]["rounding"]["low"]["n"], j["parameters"]["n"]["low"]);
}

TEST(DataSheetVerb, WritesTheParametersAsATable) {
  const AppResult result = RunApp(
      "datasheet --isc 4.75 --voc 21.6 --imp 4.26 --vmp 17.6 --alpha 0.002 --beta -0.076 "
      "--cells 36 --csv -");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, ::testing::StartsWith("parameter,name,unit,value,low,high\n"));
  for (const char* name : {"\nn1,n,,", "\nRs,R_s,ohm,", ",alpha_sc,A/K,0.002,,"}) {
    EXPECT_THAT(result.out, ::testing::HasSubstr(name));
  }
}

TEST(DataSheetVerb, TakesTheSheetOfAModuleFile) {
  const std::string pan = "datasheet '" + DataFolder("datasheet/invented.PAN") + "'";
  const AppResult result = RunApp(pan + " --pvlib -");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json j = json::parse(result.out, nullptr, false);
  EXPECT_EQ(j["name"], "Invented I-304 M60");
  EXPECT_EQ(j["cells_in_series"], 60);
  EXPECT_EQ(j["cec"]["Technology"], "mtSiMono");
  EXPECT_NEAR(j["cec"]["I_mp_ref"].get<double>(), 9.192, 1e-9);
  // What is said counts before the file, and the digits of the file give the rounding.
  const json said = json::parse(RunApp(pan + " --voc 39.8 --json -").out, nullptr, false);
  EXPECT_EQ(said["checks"]["Voc"]["printed"], 39.8);
  EXPECT_FALSE(said["parameters"]["R_s"]["low"].is_null());
  const json exact = json::parse(RunApp(pan + " --exact --json -").out, nullptr, false);
  EXPECT_TRUE(exact["parameters"]["R_s"]["low"].is_null());
  EXPECT_THAT(RunApp(kSheet + " --technology CdTe").out, HasSubstr("the band gap 1.475 eV"));
  const std::string library = DataFolder("datasheet/invented_cec.csv");
  EXPECT_EQ(RunApp("datasheet '" + library + "#Invented I-304 M60' --quiet").exit_code, 0);
  const TempFolder folder;
  const std::string text = FileText(DataFolder("datasheet/invented.PAN"));
  const std::string unstated = std::string(text).replace(text.find("-122.5"), 6, "0.0");
  EXPECT_THAT(
      RunApp("datasheet '" + folder.Write("unstated.PAN", unstated) + "'").out,
      HasSubstr("muVocSpec is not stated: beta_oc of -0.1222 V/K is that of the file's own"));
  const std::string bare = folder.Write(
      "bare.PAN", std::string(unstated).replace(unstated.find("RSerie=0.218"), 12, "RNone=0"));
  const std::string copy = folder.Write("copy.csv", FileText(library));
  ExpectRefusals("datasheet ",
                 {{"'" + bare + "'", "bare.PAN: the file does not state the value: say --beta"},
                  {"'" + copy + "#Invented I-304 M60' --csv '" + copy + "'",
                   "--csv: this run reads the file"}});
}

}  // namespace
}  // namespace lyrefit
