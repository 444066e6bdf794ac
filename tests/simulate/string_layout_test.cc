#include "lyrefit/simulate/read_string_layout.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "cases.h"
#include "effects/synthetic_readings.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

StringLayout Layout(const std::string& text) {
  const TempFolder folder;
  const auto layout = ReadStringLayout(folder.Write("layout.json", text));
  EXPECT_TRUE(layout) << layout.error().ToString();
  return layout.value_or(StringLayout());
}

constexpr char kTwoStrings[] =
    R"({"bypass_diode": {"voltage_V": 0.45, "ideality": 1.1},
        "reverse": {"law": "soft", "A_V": 3.1, "m": 3.4},
        "strings": [[{"bypass": true, "times": 3, "cells": [{"count": 12}]}],
                    [{"bypass": true, "times": 2, "cells": [{"count": 12}]},
                     {"bypass": true, "cells": [{"count": 11},
                                                {"count": 1, "light": 0.4, "leak_S": 0.05}]}]]})";

TEST(StringLayoutTest, ReadsWhatItsHeaderShows) {
  std::ifstream header(std::string(LYREFIT_DATA_DIR) +
                       "/../lib/lyrefit/simulate/read_string_layout.h");
  std::string shown;
  for (std::string line; std::getline(header, line);) {
    if (line.rfind("//   ", 0) == 0) shown += line.substr(5) + '\n';
  }
  const StringLayout layout = Layout(shown);
  EXPECT_EQ(layout.cells_in_series, 40);
  EXPECT_EQ(layout.reverse, ReverseLaw::kBishop);
  EXPECT_EQ(layout.substrings.size(), 2U);
  EXPECT_EQ(layout.groups.size(), 3U);
}

std::string Told(const std::string& text) {
  const TempFolder folder;
  const std::string path = folder.Write("layout.json", text);
  const auto read = ReadStringLayout(path);
  if (!read) return "error " + read.error().ToString().substr(folder.Path("").size());
  std::string told = fmt::format(
      "{} strings of {} cells, bypass {} V, n {}, reverse {} V, m {}, law {}", read->strings,
      read->cells_in_series, read->bypass_voltage_V, read->bypass_ideality, read->reverse_voltage_V,
      read->reverse_exponent, static_cast<int>(read->reverse));
  for (const auto& one : read->substrings) {
    told += fmt::format("; substring of {} in string {}{}", one.cells, one.string,
                        one.bypassed ? ", bypassed" : "");
  }
  for (const auto& one : read->groups) {
    told += fmt::format("; group {:.6g}, light {}, leak {} S", one.share, one.light, one.leak_S);
  }
  return told;
}

TEST(StringLayoutTest, IsReadOrNamesThePlaceOfWhatItCannotRead) {
  CheckCases("string_layouts", {{"layout", Told}});
}

// Currents of a device with this layout of cells.
std::vector<double> CurrentsOf(const Readings& readings, const std::string& text) {
  Law law;
  if (!text.empty()) law.layout = std::make_shared<const StringLayout>(Layout(text));
  return Currents(law, readings, ParametersOf({}, readings));
}

void ExpectNear(const std::vector<double>& a, const std::vector<double>& b, double error) {
  ASSERT_EQ(a.size(), b.size());
  ASSERT_FALSE(a.empty());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], error) << "reading " << k;
}

TEST(StringLayoutTest, CellsThatAreAlikeAreTheDevice) {
  const Readings readings = SyntheticReadings(DataKind::kForward, 36);
  const std::vector<double> plain = CurrentsOf(readings, "");
  // Each cell in a string has a leak of 1e-8 of the current scale per volt.
  ExpectNear(CurrentsOf(readings, R"({"strings": [[{"cells": [{"count": 36}]}]]})"), plain, 2e-8);
  ExpectNear(CurrentsOf(readings, R"({"strings": [[{"cells": [{"count": 36}]}],
                                                  [{"times": 3, "cells": [{"count": 12}]}]]})"),
             plain, 2e-8);
}

// While cells are in reverse without conducting, the current of a string is its photocurrent.
// Strings are computed with all cells each, so that two strings deliver the mean.
TEST(StringLayoutTest, StringsInParallelAddUp) {
  const Readings readings = SyntheticReadings(DataKind::kForward, 36);
  const std::string cells = R"([{"cells": [{"count": 36, "light": 0.5}]}])";
  const std::vector<double> dim = CurrentsOf(readings, R"({"strings": [)" + cells + "]}");
  const std::vector<double> both =
      CurrentsOf(readings, R"({"strings": [[{"cells": [{"count": 36}]}],)" + cells + "]}");
  const std::vector<double> lit = CurrentsOf(readings, "");
  for (std::size_t k = 0; k < both.size(); ++k) {
    EXPECT_NEAR(both[k], 0.5 * (lit[k] + dim[k]), 2e-8) << "reading " << k;
  }
}

// With an ideal bypass diode, a bypassed substring stays at the diode's voltage. The others carry
// the current at the remaining voltage.
TEST(StringLayoutTest, AnIdealBypassDiodeKeepsItsVoltage) {
  constexpr double kVoltage = 0.37;  // near open circuit of the lit substrings
  Readings readings = SyntheticReadings(DataKind::kForward, 36);
  for (Reading& r : readings.points) r.voltage = kVoltage;
  const auto bypassed = [&](const char* ideality) {
    return CurrentsOf(readings, fmt::format(R"({{"bypass_diode": {{"voltage_V": 0.4, "ideality":
           {}}}, "strings": [[{{"cells": [{{"count": 24}}]}},
           {{"bypass": true, "cells": [{{"count": 12, "light": 0}}]}}]]}})",
                                            ideality));
  };
  // The 24 lit cells take the terminal voltage plus the bypass diode's voltage.
  const double ideal = bypassed("0.05").front();
  Readings lit = readings;
  for (Reading& r : lit.points) r.voltage = (36 * kVoltage + 0.4) / 24;
  EXPECT_NEAR(ideal, CurrentsOf(lit, "").front(), 1e-3);
  EXPECT_GT(std::fabs(bypassed("1.2").front() - ideal), 5e-3);
}

// Derivatives from the slopes at the root against differences, for two strings with a weak and
// leaky cell in soft reverse and bypass diodes.
TEST(StringLayoutTest, DerivativesAreThoseOfTheCurrents) {
  const Readings readings = SyntheticReadings(DataKind::kUpDown, 36);
  Law law;
  law.layout = std::make_shared<const StringLayout>(Layout(kTwoStrings));
  const std::vector<double> p = ParametersOf({}, readings);
  const std::vector<double> jacobian = Jacobian(law, readings, p);
  ASSERT_FALSE(jacobian.empty());
  for (int i = 0; i < law.size(); ++i) {
    constexpr double kStep = 3e-5;  // relative
    const auto moved = [&](double by) {
      std::vector<double> at = p;
      at[i] *= 1 + by * kStep;
      return Currents(law, readings, at);
    };
    const auto up = moved(1), down = moved(-1), up2 = moved(2), down2 = moved(-2);
    for (std::size_t k = 0; k < up.size(); ++k) {
      const double slope = (8 * (up[k] - down[k]) - (up2[k] - down2[k])) / (12 * kStep);
      EXPECT_NEAR(p[i] * jacobian[k * law.size() + i], slope, 1e-9 * (1 + std::fabs(slope)))
          << "reading " << k << ", parameter " << i;
    }
  }
}

}  // namespace
}  // namespace lyrefit
