#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "batch/strings.h"

namespace lyrefit {

// Made substrates of pixels, a diode each.
constexpr double kArea_cm2 = 0.25;
inline const std::string kSidecar =
    R"({"cells_in_series": 1, "area_cm2": 0.25, "nominal_irradiance_Wm2": 1000,)"
    R"( "nominal_temperature_C": 25})";

// Current of a diode of n = 1.5 at a voltage; 0 of photocurrent in the dark.
inline double Diode_A(double photocurrent_A, double voltage_V) {
  return photocurrent_A - 1e-11 * std::expm1(voltage_V / (1.5 * 0.0256926));
}

// A column of currents and its name.
struct TestColumn {
  std::string name;
  std::function<double(double voltage_V)> current_A;
};

inline std::string TableOf(const std::vector<TestColumn>& columns) {
  std::string text = "voltage (V)";
  for (const TestColumn& column : columns) text += ",Current (A)_" + column.name;
  for (int k = -10; k <= 80; ++k) {
    const double voltage_V = 0.01 * k;
    text += fmt::format("\n{:.2f}", voltage_V);
    for (const TestColumn& column : columns)
      text += fmt::format(",{:.9g}", column.current_A(voltage_V));
  }
  return text + "\n";
}

inline TestColumn Lit(const std::string& pixel, const std::string& direction,
                      double photocurrent_A) {
  return {pixel + "_" + direction + "_light",
          [photocurrent_A](double v) { return Diode_A(photocurrent_A, v); }};
}

// Four pixels: a and b work (a also in the dark), c is shorted, d is dead.
inline std::string Substrate(double photocurrent_A) {
  return TableOf({Lit("a", "forward", photocurrent_A),
                  Lit("a", "reverse", 1.02 * photocurrent_A),
                  {"a_forward_dark", [](double v) { return Diode_A(0, v); }},
                  Lit("b", "forward", 0.9 * photocurrent_A),
                  Lit("b", "reverse", 0.89 * photocurrent_A),
                  {"c_forward_light", [](double v) { return 1e-3 - 0.05 * v; }},
                  {"d_forward_light", [](double v) { return 1e-9 - 1e-8 * v; }}});
}

// Runs the task `cell` on such substrates.
class CellTaskTest : public testing::Test {
 protected:
  Expected<BatchSummary> Run(const std::vector<std::string>& inputs, const std::string& out,
                             Shard shard = {}, const PixelOptions& pixels = {}) const {
    BatchReadOptions reading;
    reading.shard = shard;
    reading.reading.whole_cells = true;
    auto source = OpenBatch(inputs, reading);
    if (!source) return tl::unexpected(source.error());
    BatchOptions options = Into(folder_.Path(out));
    options.shard = shard;
    options.additions = additions_;
    CellOptions cell;
    cell.fit = false;
    return RunBatch(source->get(), CellTask(cell, pixels), options);
  }
  std::string Named(const std::string& name, const std::string& text) const {
    folder_.Write(name + ".json", kSidecar);
    return folder_.Write(name + ".csv", text);
  }
  std::vector<nlohmann::json> Lines(const std::string& file) const {
    std::istringstream lines(FileText(folder_.Path(file)));
    std::vector<nlohmann::json> all;
    for (std::string line; std::getline(lines, line);) all.push_back(nlohmann::json::parse(line));
    return all;
  }

  const TempFolder folder_;
  BatchAdditions additions_;
};

}  // namespace lyrefit
