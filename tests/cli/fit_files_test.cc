#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "repeats.h"
#include "run_app.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// Three curves and a file that is no curve.
class FitOfManyFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    for (int i = 0; i < 3; ++i) {
      const std::string name = "c" + std::to_string(i);
      const AppResult made = RunApp(
          "simulate --set Iph=" + std::to_string(5 + i) +
          " --set Is1=1e-9 --set n1=1.1 --set Rs=0.2 --set Rsh=300 --cells 36 --temperature-C 40 "
          "--irradiance-Wm2 900 --noise-A 0.002 --seed " +
          std::to_string(i) + " --out '" + folder_.Path(name + ".csv") + "'");
      ASSERT_EQ(made.exit_code, 0) << made.err;
      curves_ += "'" + folder_.Path(name + ".csv") + "' ";
    }
    broken_ = folder_.Write("broken.csv", "voltage_V,current_A\n0,x\n");
  }

  static std::vector<std::string> Lines(const std::string& text) {
    std::vector<std::string> lines;
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
      lines.push_back(text.substr(begin, end - begin));
    }
    return lines;
  }

  // Fields of a CSV row without quotes.
  static std::vector<std::string> Fields(const std::string& line) {
    std::vector<std::string> fields(1);
    for (const char c : line) {
      if (c == ',') {
        fields.emplace_back();
      } else {
        fields.back() += c;
      }
    }
    return fields;
  }

  static std::string Field(const std::vector<std::string>& lines, std::size_t row,
                           const std::string& column) {
    const std::vector<std::string> names = Fields(lines[0]);
    const auto at = std::find(names.begin(), names.end(), column) - names.begin();
    const std::vector<std::string> fields = Fields(lines[row]);
    return at < static_cast<long>(fields.size()) ? fields[at] : "no such column";
  }

  const TempFolder folder_;
  std::string curves_;
  std::string broken_;
};

TEST_F(FitOfManyFiles, HasALineAndARowEach) {
  const AppResult fits = RunApp("fit " + curves_ + "--csv '" + folder_.Path("t.csv") +
                                "' --json '" + folder_.Path("t.json") + "'");
  ASSERT_EQ(fits.exit_code, 0) << fits.err;
  const auto text = Lines(fits.out);
  ASSERT_EQ(text.size(), 3U);
  for (int i = 0; i < 3; ++i) EXPECT_THAT(text[i], StartsWith("c" + std::to_string(i) + ": sd, "));
  const auto rows = Lines(FileText(folder_.Path("t.csv")));
  const json all = json::parse(FileText(folder_.Path("t.json")));
  ASSERT_EQ(rows.size(), 4U);
  ASSERT_EQ(all.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    const json& one = all[i];
    EXPECT_EQ(one["file"], folder_.Path("c" + std::to_string(i) + ".csv"));
    EXPECT_EQ(Field(rows, i + 1, "file"), one["file"]);
    EXPECT_EQ(Field(rows, i + 1, "name"), "c" + std::to_string(i));
    EXPECT_EQ(Field(rows, i + 1, "cells_in_series"), "36");
    EXPECT_EQ(Field(rows, i + 1, "temperature_C"), "40");
    EXPECT_EQ(Field(rows, i + 1, "irradiance_Wm2"), "900");
    EXPECT_EQ(Field(rows, i + 1, "points"), "100");
    EXPECT_EQ(Field(rows, i + 1, "usable"), "true");
    EXPECT_EQ(Field(rows, i + 1, "error"), "");
    const auto number = [&](const std::string& column) {
      return std::stod(Field(rows, i + 1, column));
    };
    EXPECT_EQ(number("Iph_A"), one["parameters"]["photocurrent"]["refined"].get<double>());
    EXPECT_NEAR(number("Iph_A"), 5 + i, 0.01);
    EXPECT_EQ(number("Rs_ohm_se"),
              one["parameters"]["resistance_series"]["standard_error"].get<double>());
    for (const char* stage : {"searched", "refined"}) {
      for (const char* objective : {"measured", "solved"}) {
        EXPECT_EQ(number(std::string("rmse_") + stage + "_" + objective + "_current_A"),
                  one["rmse"][stage][std::string(objective) + "_current_A"].get<double>());
      }
    }
  }
}

TEST_F(FitOfManyFiles, GoesOnAfterABrokenOne) {
  const AppResult fits = RunApp("fit '" + broken_ + "' " + curves_ + "--csv - ");
  EXPECT_EQ(fits.exit_code, 1);
  EXPECT_THAT(fits.err, HasSubstr("broken.csv:2:3: "));
  const auto rows = Lines(fits.out);
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_THAT(rows[1], StartsWith(broken_ + ","));
  EXPECT_THAT(rows[1], HasSubstr("broken.csv:2:3: "));
  EXPECT_EQ(Field(rows, 4, "name"), "c2");
  const AppResult json_too = RunApp("fit '" + broken_ + "' " + curves_ + "--json -");
  const json all = json::parse(json_too.out);
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0]["file"], broken_);
  EXPECT_THAT(all[0]["error"].get<std::string>(), HasSubstr("broken.csv:2:3: "));
}

TEST_F(FitOfManyFiles, IsTheSameOnAnyNumberOfThreads) {
  SKIP_IF_SANITIZED();
  const auto seconds_apart = [](json list) {
    RemoveSeconds(&list);
    return list;
  };
  const AppResult one = RunApp("fit " + curves_ + "--model auto --threads 1 --json -");
  const AppResult four = RunApp("fit " + curves_ + "--model auto --threads 4 --json -");
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(seconds_apart(json::parse(one.out)), seconds_apart(json::parse(four.out)));
}

TEST_F(FitOfManyFiles, IsWhatEveryFileAloneGives) {
  const json all = FitJson(curves_);
  json alone = FitJson("'" + folder_.Path("c1.csv") + "'");
  json among = all[1];
  among.erase("file");
  RemoveSeconds(&alone);
  RemoveSeconds(&among);
  EXPECT_EQ(among, alone);
}

TEST_F(FitOfManyFiles, OfOneFileIsATableOfOneRow) {
  const AppResult fit = RunApp("fit '" + folder_.Path("c0.csv") + "' --csv -");
  EXPECT_EQ(fit.exit_code, 0) << fit.err;
  EXPECT_EQ(Lines(fit.out).size(), 2U);
}

// Writes a curve of 5,001 readings and returns its path in quotes.
std::string MakeLongCurve(const TempFolder& folder) {
  const std::string curve = "'" + folder.Path("long.csv") + "'";
  const AppResult made = RunApp(
      "simulate --set Iph=5 --set Is1=1e-9 --set n1=1.1 --set Rs=0.01 --set Rsh=30 "
      "--points 5001 --noise-A 0.001 --out " +
      curve);
  EXPECT_EQ(made.exit_code, 0) << made.err;
  return curve;
}

// The data of a very long curve are thinned in the JSON; the other keys hold the results of all
// readings.
TEST(FitJsonOfALongCurve, RepeatsSomeOfItUnlessAsked) {
  const TempFolder folder;
  const std::string curve = MakeLongCurve(folder);
  const json some = FitJson(curve + " --intervals none");
  const json& data = some["data"];
  EXPECT_EQ(data["points"], 5001);
  EXPECT_EQ(data["every"], 3);
  for (const char* column : {"voltage_V", "current_A", "model_current_A", "residual_A"}) {
    EXPECT_EQ(data[column].size(), 1668U) << column;
  }
  const json all = FitJson(curve + " --intervals none --full-json");
  EXPECT_EQ(all["data"]["voltage_V"].size(), 5001U);
  EXPECT_FALSE(all["data"].contains("every"));
  EXPECT_EQ(all["data"]["voltage_V"][3], data["voltage_V"][1]);
  EXPECT_EQ(all["data"]["residual_A"][5000], data["residual_A"].back());
}

// Number of symbols drawn.
std::size_t Marks(const std::string& picture) {
  std::ifstream file(picture);
  std::size_t marks = 0;
  for (std::string line; std::getline(file, line);) {
    for (std::size_t at = 0; (at = line.find("<use ", at)) != std::string::npos; ++at) ++marks;
  }
  return marks;
}

TEST(FitPlotOfALongCurve, ShowsSomeOfItUnlessAsked) {
  const TempFolder folder;
  const std::string curve = MakeLongCurve(folder);
  const std::string fit = "fit " + curve + " --intervals none --plot ";
  ASSERT_EQ(RunApp(fit + "'" + folder.Path("some.svg") + "'").exit_code, 0);
  ASSERT_EQ(RunApp(fit + "'" + folder.Path("all.svg") + "' --full-plot").exit_code, 0);
  const std::size_t some = Marks(folder.Path("some.svg"));
  const std::size_t all = Marks(folder.Path("all.svg"));
  EXPECT_GT(some, 1000U);
  EXPECT_LT(some, 8000U);
  EXPECT_GE(all, 3 * 5000U);  // current, power and residual of each
}

}  // namespace
}  // namespace lyrefit
