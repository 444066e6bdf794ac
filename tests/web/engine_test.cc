#include "engine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "../json_keys.h"
#include "lyrefit/devices/describe_cell.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/read/read_cell.h"
#include "lyrefit/read/read_curve_set.h"
#include "lyrefit/report/json.h"
#include "lyrefit/translate/translate.h"
#include "lyrefit/translate/translation_documents.h"
#include "repeats.h"
#include "temp_folder.h"

namespace {
std::vector<std::string> progress_heard;
}  // namespace

void lyrefit_progress(const char* progress) { progress_heard.emplace_back(progress); }

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kRtc = std::string(LYREFIT_DATA_DIR) + "/rtc_france/curve.csv";
const std::string kShaded = std::string(LYREFIT_DATA_DIR) + "/diagnosis/shaded_module.csv";

const std::string kTracer = std::string(LYREFIT_DATA_DIR) + "/formats/head_tracer.csv";

std::vector<std::string> CellFiles() {
  std::vector<std::string> files;
  for (const char* name : {"pair", "lit_dark", "suns"}) {
    files.push_back(std::string(LYREFIT_DATA_DIR) + "/cell/" + name + ".csv");
  }
  return files;
}

json Ask(const std::string& verb, const std::string& file, const json& options = json::object(),
         const std::vector<std::string>& files = {}) {
  const json request = {{"verb", verb}, {"file", file}, {"files", files}, {"options", options}};
  return json::parse(lyrefit_run(request.dump().c_str()));
}

// A JSON record without its times.
json Timeless(const std::string& text) {
  json record = json::parse(text);
  RemoveSeconds(&record);
  return record;
}

TEST(Engine, FitsAsTheLibraryDoes) {
  const json answer = Ask("fit", kRtc);
  ASSERT_FALSE(answer.contains("error")) << answer["error"];
  const auto curve = ReadCurve(kRtc);
  ASSERT_TRUE(curve);
  const auto report = Fit(*curve);
  ASSERT_TRUE(report);
  EXPECT_EQ(Timeless(answer["report_json"]), Timeless(JsonReport(*report)));
  EXPECT_TRUE(answer["usable"].get<bool>());
  EXPECT_THAT(answer["csv"].get<std::string>(), HasSubstr("Iph_A"));
}

TEST(Engine, DiagnosesAsTheLibraryDoes) {
  SKIP_IF_SANITIZED();
  progress_heard.clear();
  const json answer = Ask("diagnose", kShaded, {{"no-held-out", "yes"}});
  ASSERT_FALSE(answer.contains("error")) << answer["error"];
  DiagnoseOptions options;
  options.held_out = false;
  const auto diagnosis = Diagnose(*ReadMeasurement(kShaded), options);
  ASSERT_TRUE(diagnosis);
  EXPECT_EQ(Timeless(answer["report_json"]), Timeless(DiagnosisJson(*diagnosis)));
  ASSERT_FALSE(progress_heard.empty());
  for (const std::string& said : progress_heard) EXPECT_FALSE(json::parse(said)["stage"].empty());
}

TEST(Engine, TranslatesAsTheLibraryDoes) {
  SKIP_IF_SANITIZED();
  const TempFolder folder;
  const std::string module =
      folder.Write("sheet.json", R"({"rated_power_W": 250, "alpha_sc_percent_K": 0.05})");
  const json answer = Ask("translate", kTracer,
                          {{"module", module}, {"beta", "-0.3%"}, {"draws", "200"}, {"seed", "3"}});
  ASSERT_FALSE(answer.contains("error")) << answer["error"];
  TranslateOptions options;
  options.coefficients.beta_percent_K = -0.3;
  options.uncertainty.draws = 200;
  options.diagnosis.seed = 3;
  options.diagnosis.threads = 1;
  ShareSeedAndThreads(&options);
  ASSERT_TRUE(ReadModule(module, &options));
  const auto report = TranslateCurve(*ReadCurve(kTracer), options);
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_EQ(Timeless(answer["report_json"]), Timeless(TranslationJson(*report)));
  EXPECT_EQ(Timeless(answer["report_json"])["field_test"]["rated_W"], 250);
  EXPECT_THAT(answer["csv"].get<std::string>(), HasSubstr("procedure"));
  const json elsewhere = Ask("translate", kTracer, {{"to", "800,40"}, {"draws", "0"}});
  EXPECT_EQ(Timeless(elsewhere["report_json"])["target"]["irradiance_W_m2"], 800);
}

TEST(Engine, TakesFurtherCurvesOfOneDevice) {
  SKIP_IF_SANITIZED();
  const TempFolder folder;
  const std::string dim = folder.Write("dim.csv", "V,I\n0,1\n30,0.9\n36,0.1\n");
  const auto procedure_3 = [&](const json& further) {
    return Ask("translate", kTracer,
               {{"procedures", "iec3"}, {"draws", "0"}, {"with-curve", further}});
  };
  EXPECT_THAT(procedure_3({dim, dim, dim})["error"].get<std::string>(),
              HasSubstr("at most two further curves"));
  EXPECT_THAT(procedure_3({folder.Path("none.csv")})["error"].get<std::string>(),
              HasSubstr("none.csv"));
}

TEST(Engine, AllFilesAreOneCell) {
  const json answer = Ask("cell", "", {{"hysteresis", "0.7"}}, CellFiles());
  ASSERT_FALSE(answer.contains("error")) << answer["error"];
  CellOptions options;
  options.hysteresis = 0.7;
  options.threads = 1;
  const auto report = DescribeCell(*ReadCell(CellFiles()), options);
  ASSERT_TRUE(report);
  EXPECT_EQ(Timeless(answer["report_json"]), Timeless(CellJson(*report)));
  EXPECT_EQ(answer["name"], "pair + lit_dark + suns");
  EXPECT_TRUE(answer["usable"].get<bool>());
  EXPECT_THAT(Ask("cell", "")["error"].get<std::string>(), HasSubstr("expected the names"));
  EXPECT_THAT(Ask("cell", "", {{"irradiance-Wm2", "900"}}, CellFiles())["error"].get<std::string>(),
              HasSubstr("every lit curve states its own light"));
}

TEST(Engine, ADataSheetNeedsNoFile) {
  const json said = {{"isc", "9.05"},    {"voc", "37.8"},    {"imp", "8.58"}, {"vmp", "30.3"},
                     {"alpha", "0.06%"}, {"beta", "-0.31%"}, {"cells", "60"}, {"exact", "yes"}};
  const json answer = Ask("datasheet", "", said);
  ASSERT_FALSE(answer.contains("error")) << answer["error"];
  DataSheet sheet;
  sheet.values = {9.05, 37.8, 8.58, 30.3, 0.06e-2 * 9.05, -0.31e-2 * 37.8};
  sheet.cells_in_series = 60;
  const auto fit = FitDataSheet(sheet);
  ASSERT_TRUE(fit);
  const json record = Timeless(answer["report_json"]), expected = Timeless(DataSheetJson(*fit));
  EXPECT_EQ(record["family"]["picked"]["n"], record["parameters"]["n"]["value"]);
  EXPECT_NEAR(record["parameters"]["n"]["value"].get<double>(),
              expected["parameters"]["n"]["value"].get<double>(), 1e-9);
  EXPECT_EQ(json::parse(answer["pvlib_json"].get<std::string>())["function"], "calcparams_desoto");
  const json missing = Ask("datasheet", "", {{"isc", "9.05"}});
  EXPECT_THAT(missing["message"].get<std::string>(), HasSubstr("--voc is required"));
}

TEST(Engine, PagesNeedNoGnuplot) {
  const std::string page = Ask("fit", kRtc)["page_html"];
  EXPECT_THAT(page, Not(HasSubstr("gnuplot")));
  EXPECT_THAT(page, Not(HasSubstr("class=\"still\"")));
  EXPECT_THAT(page, HasSubstr("figure-1-chart"));
}

TEST(Engine, OptionsMeanWhatTheyMeanToTheCommand) {
  const json answer = Ask("fit", kRtc,
                          {{"cells", "2"},
                           {"temperature-C", "40"},
                           {"model", "dd"},
                           {"bounds", "wide"},
                           {"fix", {"n2=2"}},
                           {"seed", "7"},
                           {"intervals", "none"},
                           {"no-polish", ""}});
  ASSERT_FALSE(answer.contains("error")) << answer["error"];
  const json report = json::parse(answer["report_json"].get<std::string>());
  EXPECT_EQ(report["curve"]["conditions"]["cells_in_series"], 2);
  EXPECT_EQ(report["model"], "dd");
  EXPECT_EQ(report["parameters"]["n_2"]["refined"], 2);
  EXPECT_EQ(report["search"]["seed"], 7);
}

TEST(Engine, ErrorsNameFileLineAndColumn) {
  const TempFolder folder;
  const std::string file = folder.Write("bad.csv", "V,I\n0,1.5\n0.1,abc\n0.2,1.2\n");
  const json answer = Ask("fit", file);
  EXPECT_EQ(answer["error"], ReadCurve(file).error().ToString());
  EXPECT_EQ(answer["line"], 3);
  EXPECT_EQ(answer["column"], 5);
  EXPECT_EQ(Ask("look", file)["line"], 3);
}

TEST(Engine, RefusesWhatItDoesNotKnow) {
  const auto error = [](const json& answer) { return answer["error"].get<std::string>(); };
  EXPECT_THAT(error(Ask("fit", kRtc, {{"speed", "11"}})), HasSubstr("no option 'speed'"));
  EXPECT_THAT(error(Ask("fit", kRtc, {{"threads", "2"}})), HasSubstr("no option 'threads'"));
  EXPECT_THAT(error(Ask("fit", kRtc, {{"population", "ten"}})),
              HasSubstr("population: expected a number, found 'ten'"));
  EXPECT_THAT(error(Ask("fit", kRtc, {{"population", "1"}})), HasSubstr("is outside [4, 20000]"));
  EXPECT_THAT(error(Ask("fit", kRtc, {{"temperature-C", "300"}})), HasSubstr("looks like kelvin"));
  EXPECT_THAT(error(Ask("fit", kRtc, {{"bounds", "paper"}})), HasSubstr("physical or wide"));
  EXPECT_THAT(error(Ask("diagnose", kRtc, {{"model", "dd"}})), HasSubstr("no option 'model'"));
  EXPECT_THAT(error(Ask("sing", kRtc)), HasSubstr("found 'sing'"));
  EXPECT_THAT(error(Ask("fit", "")), HasSubstr("file: expected the name"));
  EXPECT_THAT(error(json::parse(lyrefit_run("{"))), HasSubstr("expected a request in JSON"));
}

TEST(Engine, FormsAreTheOptionTables) {
  const json forms = json::parse(lyrefit_run("{\"verb\":\"about\"}"))["forms"];
  const auto names = [](const json& form) {
    std::set<std::string> all;
    for (const json& row : form) EXPECT_TRUE(all.insert(row["name"]).second) << row["name"];
    return all;
  };
  const std::set<std::string> fit = names(forms["fit"]);
  for (const char* name : {"cells", "voltage-unit", "curve", "model", "bounds", "no-polish", "with",
                           "population", "seed", "skip-missing"}) {
    EXPECT_THAT(fit, Contains(name));
  }
  const std::set<std::string> diagnose = names(forms["diagnose"]);
  for (const char* name : {"cells", "base", "effects", "probability", "no-held-out"}) {
    EXPECT_THAT(diagnose, Contains(name));
  }
  const std::set<std::string> translate = names(forms["translate"]);
  for (const char* name : {"cells", "to", "alpha", "rated-W", "irradiance-from", "wind", "operator",
                           "module", "with-curve", "seed", "base"}) {
    EXPECT_THAT(translate, Contains(name));
  }
  EXPECT_THAT(names(forms["cell"]), Contains("no-fit"));
  EXPECT_THAT(names(forms["cell"]), Not(Contains("curve")));
  EXPECT_THAT(names(forms["datasheet"]), Contains("gamma"));
  // Every choice that a form offers is accepted.
  for (const auto& [verb, form] : forms.items()) {
    if (verb == "datasheet") continue;  // needs no file, and its values first
    for (const json& row : form) {
      for (const json& choice : row["choices"]) {
        const json answer = Ask(verb, "none.csv", {{row["name"], choice}}, {"none.csv"});
        EXPECT_THAT(answer["error"].get<std::string>(), HasSubstr("none.csv")) << row["name"];
        EXPECT_THAT(answer["error"].get<std::string>(), Not(HasSubstr("expected one of")));
      }
    }
  }
}

TEST(Engine, LooksAtAFile) {
  const json look = Ask("look", kRtc);
  ASSERT_EQ(look["curves"].size(), 1U);
  const json& curve = look["curves"][0];
  EXPECT_EQ(curve["readings"], 26);
  EXPECT_EQ(curve["cells"], 1);
  EXPECT_NEAR(curve["temperature_C"].get<double>(), 33, 1e-9);
  EXPECT_THAT(look["picture_html"].get<std::string>(), HasSubstr("26 readings of 1 curve."));
  EXPECT_EQ(look["columns"].size(), 2U);
  EXPECT_EQ(look["columns"][0]["use"], "voltage");
}

TEST(Engine, ALookKnowsWhatNobodySaid) {
  const TempFolder folder;
  const std::string file = folder.Write("bare.csv", "V,I\n0,1.5\n0.3,1.4\n0.5,1.0\n0.55,0.2\n");
  EXPECT_TRUE(Ask("look", file)["curves"][0]["cells"].is_null());
  EXPECT_EQ(Ask("look", file, {{"cells", "1"}})["curves"][0]["cells"], 1);
}

TEST(Engine, ALookKnowsTheSheetOfAModule) {
  const TempFolder folder;
  const json sheet = Ask("look", folder.Write("sheet.json", R"({"rated_power_W": 290,
      "modules_in_series": 20, "beta_oc_percent_K": -0.277})"));
  EXPECT_FALSE(sheet.contains("error"));
  EXPECT_TRUE(sheet["module"].get<bool>());
  EXPECT_FALSE(sheet["sheet"].get<bool>());
  EXPECT_THAT(sheet["assumptions"], Contains("rated-W: 290"));
  EXPECT_THAT(sheet["assumptions"], Contains("modules: 20"));
  const std::string pan = std::string(LYREFIT_DATA_DIR) + "/datasheet/invented.PAN";
  EXPECT_TRUE(Ask("look", pan)["sheet"].get<bool>());
  const json of_file = Ask("datasheet", "", {{"module", pan}});
  EXPECT_EQ(of_file["name"], "Invented I-304 M60");
  const json library = Ask("look", std::string(LYREFIT_DATA_DIR) + "/datasheet/invented_cec.csv");
  EXPECT_THAT(library["error"].get<std::string>(), HasSubstr("a library of 2 modules"));
}

TEST(Engine, ATraceInSunsIsReadBesideTheOthersOfItsCell) {
  const std::vector<std::string> files = CellFiles();
  const json alone = Ask("look", files[2]);
  EXPECT_THAT(alone["message"].get<std::string>(), HasSubstr("(--isc-A)"));
  const json beside = Ask("look", files[2], json::object(), files);
  EXPECT_FALSE(beside.contains("error"));
  ASSERT_EQ(beside["curves"].size(), 1U);
  EXPECT_EQ(beside["curves"][0]["readings"], 29);
}

TEST(Engine, AMissingAreaIsAskedForByItsOption) {
  const TempFolder folder;
  const std::string file =
      folder.Write("density.csv", "V (V),J (mA/cm2)\n0,22\n0.5,21\n0.8,12\n0.86,-1\n");
  EXPECT_THAT(Ask("look", file)["message"].get<std::string>(), HasSubstr("--area-cm2"));
  EXPECT_FALSE(Ask("look", file, {{"area-cm2", "0.25"}}).contains("error"));
}

}  // namespace
}  // namespace lyrefit
