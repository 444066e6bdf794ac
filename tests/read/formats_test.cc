#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/read_curve_set.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

const fs::path kFormats = fs::path(LYREFIT_DATA_DIR) / "formats";

// A row of the table in data/formats/README.md, by its columns.
struct Format {
  std::string file, what, options, points, isc, voc, irradiance, temperature, cells, area, curves;
};

void PrintTo(const Format& format, std::ostream* out) { *out << format.file; }

std::string Trim(const std::string& text) {
  const auto begin = text.find_first_not_of(" `");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" `") - begin + 1);
}

std::vector<Format> ReadFormats() {
  std::vector<Format> formats;
  std::ifstream readme(kFormats / "README.md");
  for (std::string line; std::getline(readme, line);) {
    if (line.rfind("| `", 0) != 0) continue;
    std::vector<std::string> cells;
    std::istringstream row(line.substr(1));
    for (std::string cell; std::getline(row, cell, '|');) cells.push_back(Trim(cell));
    if (cells.size() != 11) continue;
    formats.push_back({cells[0], cells[1], cells[2], cells[3], cells[4], cells[5], cells[6],
                       cells[7], cells[8], cells[9], cells[10]});
  }
  return formats;
}

ReadOptions ParseOptions(const std::string& text) {
  ReadOptions options;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string key = word.substr(0, word.find('='));
    const std::string value = word.substr(word.find('=') + 1);
    if (key == "column") options.column = value;
    if (key == "voltage_column") options.voltage_column = value;
    if (key == "current_column") options.current_column = value;
    if (key == "curve") options.curve = std::stoi(value);
    if (key == "voltage_unit") options.voltage_unit = value;
    if (key == "current_unit") options.current_unit = value;
    if (key == "skip_missing") options.skip_missing = true;
    if (key == "area_cm2") options.area_cm2 = std::stod(value);
    if (key == "isc_A") options.isc_A = std::stod(value);
  }
  return options;
}

class FormatTest : public ::testing::TestWithParam<Format> {};

TEST_P(FormatTest, IsReadWithItsUnitsSignAndConditions) {
  const Format& format = GetParam();
  const auto curve = ReadCurve((kFormats / format.file).string(), ParseOptions(format.options));
  ASSERT_TRUE(curve) << curve.error().ToString();
  EXPECT_EQ(std::to_string(curve->size()), format.points);
  const KeyPoints points = FindKeyPoints(curve->voltage_V, curve->current_A);
  if (format.isc.empty()) {
    EXPECT_TRUE(std::isnan(points.short_circuit_current_A));
  } else {
    EXPECT_NEAR(points.short_circuit_current_A, std::stod(format.isc),
                1e-3 * std::stod(format.isc));
  }
  EXPECT_NEAR(points.open_circuit_voltage_V, std::stod(format.voc), 1e-3 * std::stod(format.voc));
  EXPECT_EQ(curve->irradiance_known, !format.irradiance.empty());
  EXPECT_EQ(curve->temperature_known, !format.temperature.empty());
  const double irradiance = format.irradiance.empty() ? 1000 : std::stod(format.irradiance);
  const double temperature = format.temperature.empty() ? 25 : std::stod(format.temperature);
  EXPECT_NEAR(curve->conditions.irradiance_W_m2, irradiance, 1e-9);
  EXPECT_NEAR(curve->conditions.cell_temperature_K, temperature + kZeroCelsius_K, 1e-9);
  EXPECT_EQ(curve->conditions.cells_in_series, format.cells.empty() ? 1 : std::stoi(format.cells));
  EXPECT_EQ(curve->notes.area_cm2.has_value(), !format.area.empty());
  if (!format.area.empty()) {
    EXPECT_NEAR(*curve->notes.area_cm2, std::stod(format.area), 1e-12);
  }
}

TEST_P(FormatTest, HoldsAsManyCurvesAsTheTableSays) {
  const Format& format = GetParam();
  const std::string path = (kFormats / format.file).string();
  ReadOptions options = ParseOptions(format.options);
  options.column.clear();
  options.curve.reset();
  EXPECT_EQ(HoldsCurveSet(path, options), format.curves != "1");
  if (format.curves == "1") return;
  const auto set = ReadCurveSet(path, options);
  ASSERT_TRUE(set) << set.error().ToString();
  EXPECT_EQ(std::to_string(set->curves.size()), format.curves);
  const auto one = ReadCurve(path, options);
  const bool has_trace = std::any_of(set->curves.begin(), set->curves.end(),
                                     [](const IvCurve& curve) { return curve.suns_voc_A; });
  if (has_trace) {  // the curve under load is read
    ASSERT_TRUE(one) << one.error().ToString();
    EXPECT_FALSE(one->suns_voc_A);
    return;
  }
  ASSERT_FALSE(one);
  EXPECT_THAT(one.error().message, ::testing::HasSubstr("choose one with --c"));
}

TEST_P(FormatTest, IsTheSameFromStandardInput) {
  const Format& format = GetParam();
  const fs::path path = kFormats / format.file;
  if (fs::is_directory(path)) GTEST_SKIP() << "a folder cannot be piped";
  std::ifstream file(path, std::ios::binary);
  std::stringstream bytes;
  bytes << file.rdbuf();
  const ReadOptions options = ParseOptions(format.options);
  const auto piped = ReadCurveText(bytes.str(), "standard input", options);
  ASSERT_TRUE(piped) << piped.error().ToString();
  const auto curve = ReadCurve(path.string(), options);
  ASSERT_TRUE(curve);
  EXPECT_EQ(piped->voltage_V, curve->voltage_V);
  EXPECT_EQ(piped->current_A, curve->current_A);
}

std::string NameOf(const ::testing::TestParamInfo<Format>& info) {
  std::string name = info.param.file;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Formats, FormatTest, ::testing::ValuesIn(ReadFormats()), NameOf);

TEST(FormatsTest, MissingReadingsAreRefusedOrCounted) {
  for (const auto& [file, sentence] :
       {std::pair("missing.csv", "4 of 28 rows without a reading left out: lines 6, 12, 17, 21"),
        std::pair("missing_records.json", "2 of 26 rows without a reading left out")}) {
    const std::string path = (kFormats / file).string();
    const auto refused = ReadCurve(path);
    ASSERT_FALSE(refused) << file;
    EXPECT_THAT(refused.error().message, ::testing::HasSubstr("--skip-missing")) << file;
    ReadOptions options;
    options.skip_missing = true;
    const auto curve = ReadCurve(path, options);
    ASSERT_TRUE(curve) << curve.error().ToString();
    EXPECT_THAT(SentencesOf(curve->assumptions), ::testing::Contains(sentence)) << file;
  }
}

TEST(FormatsTest, UnknownUnitsAreRefused) {
  ReadOptions options;
  options.current_unit = "horsepower";
  for (const char* file : {"plain.csv", "no_header.txt", "records.json"}) {
    const auto curve = ReadCurve((kFormats / file).string(), options);
    ASSERT_FALSE(curve) << file;
    EXPECT_EQ(curve.error().message,
              "--current-unit: expected A, mA, uA, nA or kA, found 'horsepower'");
  }
}

TEST(FormatsTest, EveryFileHasItsLine) {
  std::vector<std::string> listed;
  for (const Format& format : ReadFormats()) listed.push_back(format.file);
  EXPECT_GE(listed.size(), 40U);
  for (const fs::directory_entry& entry : fs::directory_iterator(kFormats)) {
    const std::string name = entry.path().filename().string();
    if (name == "README.md" || name == "batch") continue;  // many curves, read in tests/batch
    EXPECT_THAT(listed, ::testing::Contains(name));
  }
}

}  // namespace
}  // namespace lyrefit
