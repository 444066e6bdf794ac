#include "lyrefit/read/read_curve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "error_of.h"
#include "lyrefit/base/file.h"
#include "lyrefit/base/random.h"
#include "repeats.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr char kTable[] = "voltage_V,current_A\n0,1\n0.5,0.9\n0.6,0\n";

TEST(ReadCurveTest, SidecarBesideTheTableCounts) {
  const TempFolder folder;
  folder.Write("a.json", R"({"cells_in_series": 36, "nominal_temperature_C": 45,
                             "nominal_irradiance_Wm2": 900})");
  const std::string path = folder.Write("a.csv", kTable);
  const auto curve = ReadCurve(path);
  ASSERT_TRUE(curve);
  EXPECT_EQ(curve->name, "a");
  EXPECT_EQ(curve->source, path);
  EXPECT_EQ(curve->conditions.cells_in_series, 36);
  EXPECT_EQ(curve->conditions.cell_temperature_K, 318.15);
  EXPECT_EQ(curve->conditions.irradiance_W_m2, 900);
  EXPECT_THAT(SentencesOf(curve->assumptions), IsEmpty());
}

TEST(ReadCurveTest, WithoutSidecarTheAssumptionsAreSaid) {
  const TempFolder folder;
  const auto curve = ReadCurve(folder.Write("a.txt", kTable));
  ASSERT_TRUE(curve);
  EXPECT_THAT(
      SentencesOf(curve->assumptions),
      ElementsAre("number of cells in series not given: assumed 1; n is then the ideality of "
                  "the whole module",
                  "cell temperature not given: assumed 25 C",
                  "irradiance not given: assumed 1000 W/m2"));
}

TEST(ReadCurveTest, FolderWithCurveCsvIsNamedAfterTheFolder) {
  const TempFolder folder;
  const std::string path = folder.Write("module7/curve.csv", kTable);
  for (const std::string& asked : {folder.Path("module7"), folder.Path("module7/"), path}) {
    const auto curve = ReadCurve(asked);
    ASSERT_TRUE(curve);
    EXPECT_EQ(curve->name, "module7");
    EXPECT_EQ(curve->source, path);
  }
}

TEST(ReadCurveTest, LoadSignIsTurnedAndSaid) {
  const TempFolder folder;
  const auto curve = ReadCurve(folder.Write("a.csv", "V,I\n0.6,0\n0.5,-0.9\n0,-1\n"));
  ASSERT_TRUE(curve);
  EXPECT_THAT(curve->current_A, ElementsAre(0, 0.9, 1));
  EXPECT_THAT(curve->voltage_V, ElementsAre(0.6, 0.5, 0));
  EXPECT_THAT(SentencesOf(curve->assumptions), Contains(HasSubstr("load sign")));
}

TEST(ReadCurveTest, IvSwingerFileIsRead) {
  const TempFolder folder;
  const auto curve = ReadCurve(folder.Write("iv.csv",
                                            "Volts, Amps, Watts, Ohms\n"
                                            "0.000000,5.100000,0.000000,0.000000\n"
                                            "20.100000,4.700000,94.47,4.27\n"
                                            "24.500000,0.000000,0.000000,inf\n"));
  ASSERT_TRUE(curve) << curve.error().ToString();
  EXPECT_THAT(curve->voltage_V, ElementsAre(0, 20.1, 24.5));
  EXPECT_THAT(curve->current_A, ElementsAre(5.1, 4.7, 0));
  EXPECT_THAT(SentencesOf(curve->assumptions), Contains("columns not used: 'Watts', 'Ohms'"));
}

TEST(ReadCurveTest, SweepOfAFamilyHasItsOwnConditions) {
  const TempFolder folder;
  folder.Write("a.json", R"({"cells_in_series": 1, "nominal_irradiance_Wm2": 1000,
                             "nominal_temperature_C": 25})");
  const std::string path = folder.Write("a.csv",
                                        "V,I,sweep,irradiance_Wm2\n0,1,0,1000\n0.6,0,0,1000\n"
                                        "0,0.2,1,200\n0.55,0,1,200\n");
  const auto undecided = ReadCurve(path);
  ASSERT_FALSE(undecided);
  EXPECT_EQ(undecided.error().file, path);
  EXPECT_THAT(undecided.error().message, HasSubstr("--curve INDEX"));
  ReadOptions options;
  options.curve = 1;
  const auto curve = ReadCurve(path, options);
  ASSERT_TRUE(curve);
  EXPECT_EQ(curve->name, "a_1");
  EXPECT_EQ(curve->conditions.irradiance_W_m2, 200);
  EXPECT_THAT(curve->current_A, ElementsAre(0.2, 0));
}

TEST(ReadCurveTest, ErrorsNameTheFile) {
  const TempFolder folder;
  const struct {
    std::string path;
    std::string file;
    const char* phrase;
  } kCases[] = {
      {folder.Path("missing.csv"), folder.Path("missing.csv"), "does not exist"},
      {folder.Path("missing.json"), folder.Path("missing.json"), "does not exist"},
      {folder.Path(""), folder.Path(""), "a folder that holds curve.csv"},
      {folder.Write("empty.csv", ""), folder.Path("empty.csv"), "empty"},
      {folder.Write("binary.csv", std::string("V,I\n\0", 5)), folder.Path("binary.csv"), "binary"},
      {folder.Write("one.csv", "V,I\n0,1\n"), folder.Path("one.csv"), "at least two points"},
      {folder.Write("flat.csv", "V,I\n0.5,1\n0.5,2\n"), folder.Path("flat.csv"),
       "two different voltages"},
      {folder.Write("bad.csv", kTable), folder.Write("bad.json", R"({"cells_in_series": "x"})"),
       "\"cells_in_series\""},
      {folder.Write("cut.csv", kTable), folder.Write("cut.json", "{"), "valid JSON"},
  };
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.path);
    const auto curve = ReadCurve(c.path);
    ASSERT_FALSE(curve);
    EXPECT_EQ(curve.error().file, c.file);
    EXPECT_THAT(curve.error().message, HasSubstr(c.phrase));
  }
}

TEST(ReadCurveTest, FileBeyondTheLimitIsRefused) {
  const TempFolder folder;
  ReadOptions options;
  options.largest_file_bytes = 10;
  EXPECT_THAT(MessageOf(ReadCurve(folder.Write("a.csv", kTable), options)),
              HasSubstr("larger than the limit of 10 bytes"));
}

TEST(ReadCurveTest, CutAndFlippedFilesGiveACurveOrAnError) {
  const TempFolder folder;
  const std::string table =
      "# remark\nVoltage (V);I "
      "[mA];sweep;time_s\n0,0;1000;0;0\n0,5;9,5e2;0;1\n\"0,6\";\u22121;0;2\n";
  const std::string json =
      R"({"cells_in_series": 36, "IV Curves": [{"Index": "1", "Voltages": ["0", 1], "Currents": [1, 0]}]})";
  RandomStream random(17);
  for (const auto& [name, text] : {std::pair("a.csv", table), {"b.json", json}}) {
    ASSERT_TRUE(ReadCurve(folder.Write(name, text)));
    for (std::size_t length = 0; length < text.size(); ++length) {
      const auto curve = ReadCurve(folder.Write(name, text.substr(0, length)));
      if (!curve) {
        EXPECT_NE(curve.error().message, "");
      }
    }
    for (int repeat = 0; repeat < Repeats(3000); ++repeat) {
      std::string broken = text;
      for (std::uint32_t flips = 1 + random.Index(4); flips > 0; --flips) {
        broken[random.Index(broken.size())] = static_cast<char>(random.Index(256));
      }
      const auto curve = ReadCurveText(broken, name);
      if (curve) {
        EXPECT_TRUE(Validate(*curve));
      }
      if (!curve) {
        EXPECT_NE(curve.error().message, "");
      }
    }
  }
}

TEST(ReadCurveTest, BrokenSidecarsGiveACurveOrAnError) {
  const TempFolder folder;
  const std::string path = folder.Write("a.csv", kTable);
  const std::string text =
      R"({"name": "x", "cells_in_series": 36, "nominal_temperature_C": 25.5, "current_noise": {"constant_A": 1e-3}})";
  RandomStream random(18);
  for (int repeat = 0; repeat < Repeats(600); ++repeat) {
    std::string broken = text.substr(0, random.Index(4) == 0 ? random.Index(text.size()) : 1000);
    if (!broken.empty()) broken[random.Index(broken.size())] = static_cast<char>(random.Index(256));
    folder.Write("a.json", broken);
    const auto curve = ReadCurve(path);
    if (!curve) {
      EXPECT_EQ(curve.error().file, folder.Path("a.json"));
    }
  }
}

// A cost that grows faster than the file would exceed the time limit of the test.
TEST(ReadCurveTest, AMillionNumbersInOneLineAreRefused) {
  std::string line;
  for (int i = 0; i < 1000000; ++i) line += std::to_string(i % 10) + ',';
  EXPECT_FALSE(ReadCurveText(line, "line"));
  EXPECT_FALSE(ReadCurveText("title\n" + line + "\n", "line"));
}

TEST(ReadCurveTest, HalfAMillionRowsAreRead) {
  const TempFolder folder;
  std::string text = "voltage_V,current_A\n";
  for (int i = 0; i < 500000; ++i) {
    text += std::to_string(i * 1e-6) + "," + std::to_string(8 - i * 1e-5) + "\n";
  }
  const std::string path = folder.Write("a.csv", text);
  const auto curve = ReadCurve(path);
  ASSERT_TRUE(curve);
  EXPECT_EQ(curve->size(), 500000U);
}

}  // namespace
}  // namespace lyrefit
