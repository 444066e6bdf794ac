#include "engine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "../json_keys.h"
#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/read/read_curve_set.h"
#include "lyrefit/report/json.h"
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

json Ask(const std::string& verb, const std::string& file, const json& options = json::object()) {
  const json request = {{"verb", verb}, {"file", file}, {"options", options}};
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
  for (const char* name : {"cells", "base", "effects", "probability", "no-held-out", "plan"}) {
    EXPECT_THAT(diagnose, Contains(name));
  }
  // Every choice that a form offers is accepted.
  for (const json& row : forms["fit"]) {
    for (const json& choice : row["choices"]) {
      const json answer = Ask("fit", "none.csv", {{row["name"], choice}});
      EXPECT_THAT(answer["error"].get<std::string>(), HasSubstr("none.csv")) << row["name"];
      EXPECT_THAT(answer["error"].get<std::string>(), Not(HasSubstr("expected one of")));
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

}  // namespace
}  // namespace lyrefit
