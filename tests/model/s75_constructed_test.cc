// Checks data/s75_constructed against its about.md: the data sheet, and De Soto's equations.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/translation.h"

namespace lyrefit {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::ifstream Open(const std::string& name) {
  std::ifstream file(LYREFIT_DATA_DIR "/s75_constructed/" + name);
  EXPECT_TRUE(file) << "cannot read " LYREFIT_DATA_DIR "/s75_constructed/" << name;
  return file;
}

// The rows below the header.
Rows ReadRows(const std::string& name) {
  std::ifstream file = Open(name);
  Rows rows;
  std::string line, field;
  std::getline(file, line);
  while (std::getline(file, line)) {
    rows.emplace_back();
    for (std::istringstream fields(line); std::getline(fields, field, ',');) {
      rows.back().push_back(field);
    }
  }
  return rows;
}

double Value(const std::string& text) { return ParseNumber(text).value_or(1e300); }

Translation DeSoto() {
  TranslationSpec spec;
  spec.cells_in_series = 36;
  return *MakeTranslation(spec);
}

// The table of about.md, in the translation's order: Iph, Is1, n1, Rs, Rsh, alpha, Eg, dEg.
std::vector<double> Truth() {
  std::ifstream file = Open("about.md");
  const Translation translation = DeSoto();
  std::vector<double> shared(translation.parameters.size(), 0);
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("| ", 0) != 0) continue;
    const std::string symbol = line.substr(2, line.find_first_of(" ,", 2) - 2);
    const auto at = translation.Find(symbol);
    if (!at) continue;
    const std::size_t begin = line.find(" | ") + 3;
    shared[*at] = Value(line.substr(begin, line.find(' ', begin) - begin));
  }
  return shared;
}

TranslatedDevice Module(double irradiance_W_m2, double temperature_C) {
  return TranslateTo(DeSoto(), Truth(), irradiance_W_m2, temperature_C + kZeroCelsius_K);
}

double CurrentAt(const TranslatedDevice& module, double voltage_V) {
  return SolveCurrents(module.device, module.parameters.data(), std::vector<double>{voltage_V})[0];
}

TEST(S75Constructed, EveryPointIsTheTranslatedModelRoundedToAMilliampere) {
  std::map<std::string, TranslatedDevice> modules;
  for (const auto& row : ReadRows("index.csv")) {
    ASSERT_EQ(row.size(), 3U);
    modules[row[0]] = Module(Value(row[1]), Value(row[2]));
  }
  EXPECT_EQ(modules.size(), 7U);
  std::map<std::string, int> points;
  for (const auto& row : ReadRows("curves.csv")) {
    ASSERT_EQ(row.size(), 3U);
    ASSERT_EQ(modules.count(row[0]), 1U) << row[0];
    ++points[row[0]];
    EXPECT_NEAR(CurrentAt(modules[row[0]], Value(row[1])), Value(row[2]), 0.5e-3 + 1e-9)
        << row[0] << " at " << row[1] << " V";
  }
  for (const auto& [id, count] : points) EXPECT_EQ(count, 28) << id;
  EXPECT_EQ(points.size(), 7U);
}

TEST(S75Constructed, MeetsTheDataSheetWithinItsRounding) {
  const TranslatedDevice module = Module(1000, 25);
  const KeyPoints points = ModelKeyPoints(module.device, module.parameters.data());
  EXPECT_NEAR(points.short_circuit_current_A, 4.70, 1e-9);
  EXPECT_NEAR(points.open_circuit_voltage_V, 21.6, 1e-9);
  EXPECT_NEAR(CurrentAt(module, 17.6), 4.26, 1e-9);
  EXPECT_NEAR(points.max_power_voltage_V, 17.6, 1e-5);
  EXPECT_NEAR(points.max_power_W, 17.6 * 4.26, 1e-8);
}

TEST(S75Constructed, FollowsTheDataSheetsTemperatureCoefficients) {
  const auto at = [](double temperature_C) {
    const TranslatedDevice module = Module(1000, temperature_C);
    return ModelKeyPoints(module.device, module.parameters.data());
  };
  const KeyPoints cold = at(20), warm = at(30);
  EXPECT_NEAR((warm.open_circuit_voltage_V - cold.open_circuit_voltage_V) / 10, -0.076, 1e-9);
  EXPECT_NEAR((warm.short_circuit_current_A - cold.short_circuit_current_A) / 10, 0.002, 1e-5);
}

}  // namespace
}  // namespace lyrefit
