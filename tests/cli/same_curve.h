#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "run_app.h"

namespace lyrefit {

// The currents, second column, of a CSV table.
inline std::vector<double> CurrentsOf(const std::string& csv) {
  std::vector<double> currents;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t comma = line.find(',');
    if (comma == std::string::npos || std::isalpha(static_cast<unsigned char>(line[0])) != 0) {
      continue;
    }
    currents.push_back(std::stod(line.substr(comma + 1)));
  }
  return currents;
}

// Expects `simulate --from` to reproduce the model currents of the report, within 1e-9 A.
inline void ExpectSameCurve(const std::string& report_file, const nlohmann::json& report) {
  const AppResult simulated = RunApp("simulate --from '" + report_file + "'");
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  const std::vector<double> currents = CurrentsOf(simulated.out);
  const nlohmann::json& expected = report["data"]["model_current_A"];
  ASSERT_EQ(currents.size(), expected.size());
  for (std::size_t k = 0; k < currents.size(); ++k) {
    EXPECT_NEAR(currents[k], expected[k].get<double>(), 1e-9);
  }
}

}  // namespace lyrefit
