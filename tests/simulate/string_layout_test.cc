#include "lyrefit/simulate/read_string_layout.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "effects/synthetic_readings.h"
#include "temp_folder.h"

#include "lyrefit/simulate/read_string_layout.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

StringLayout Layout(const std::string& text) {
  const TempFolder folder;
  const auto layout = ReadStringLayout(folder.Write("layout.json", text));
  EXPECT_TRUE(layout) << layout.error().ToString();
  return layout.value_or(StringLayout());
}

std::string ErrorOf(const std::string& text) {
  const TempFolder folder;
  const auto layout = ReadStringLayout(folder.Write("layout.json", text));
  return layout ? "no error" : layout.error().ToString();
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

TEST(StringLayoutTest, ReadsSubstringsAndTakesEqualOnesTogether) {
  const StringLayout layout = Layout(kTwoStrings);
  EXPECT_EQ(layout.cells_in_series, 36);
  EXPECT_EQ(layout.strings, 2);
  ASSERT_EQ(layout.substrings.size(), 3U);
  ASSERT_EQ(layout.groups.size(), 4U);
  EXPECT_EQ(layout.substrings[0].string, 0);
  EXPECT_EQ(layout.substrings[2].string, 1);
  EXPECT_TRUE(layout.substrings[2].bypassed);
  EXPECT_EQ(layout.substrings[1].cells, 12);
  EXPECT_DOUBLE_EQ(layout.groups[0].share, 0.5);
  EXPECT_DOUBLE_EQ(layout.groups[1].share, 24.0 / 72);
  EXPECT_DOUBLE_EQ(layout.groups[3].share, 1.0 / 72);
  EXPECT_EQ(layout.groups[3].light, 0.4);
  EXPECT_EQ(layout.groups[3].leak_S, 0.05);
  EXPECT_EQ(layout.bypass_voltage_V, 0.45);
  EXPECT_EQ(layout.bypass_ideality, 1.1);
  EXPECT_EQ(layout.reverse, ReverseLaw::kSoft);
  EXPECT_EQ(layout.reverse_voltage_V, 3.1);
  EXPECT_EQ(layout.reverse_exponent, 3.4);
}

TEST(StringLayoutTest, NamesThePlaceOfWhatItCannotRead) {
  EXPECT_THAT(ErrorOf("{"), HasSubstr("expected valid JSON"));
  EXPECT_THAT(ErrorOf("[]"), HasSubstr("expected an object with bypass_diode, reverse, strings"));
  EXPECT_THAT(ErrorOf(R"({"strings": []})"), HasSubstr("expected a list \"strings\""));
  EXPECT_THAT(ErrorOf(R"({"strings": [[]]})"), HasSubstr("strings[0]: expected a list of parts"));
  EXPECT_THAT(ErrorOf(R"({"strings": [[{"cells": [{"count": 1.5}]}]]})"),
              HasSubstr("strings[0][0].cells[0].count: expected a whole number, found 1.5"));
  EXPECT_THAT(ErrorOf(R"({"strings": [[{"cells": [{"light": -1}]}]]})"),
              HasSubstr("strings[0][0].cells[0].light: expected a number from 0 to 2, found -1"));
  EXPECT_THAT(ErrorOf(R"({"strings": [[{"cells": [{"lite": 1}]}]]})"),
              HasSubstr("strings[0][0].cells[0]: there is no \"lite\""));
  EXPECT_THAT(ErrorOf(R"({"strings": [[{"bypass": 1, "cells": [{}]}]]})"),
              HasSubstr("strings[0][0].bypass: expected true or false, found 1"));
  EXPECT_THAT(ErrorOf(R"({"strings": [[{"cells": [{"count": 3}]}],
                                      [{"cells": [{"count": 4}]}]]})"),
              HasSubstr("expected as many cells in each, found 3 and 4"));
  EXPECT_THAT(ErrorOf(R"({"reverse": {"law": "none"}, "strings": [[{"cells": [{}]}]]})"),
              HasSubstr("\"law\" to be shunt, bishop or soft"));
  EXPECT_THAT(ErrorOf(R"({"reverse": {"law": "soft", "a": 1}, "strings": [[{"cells": [{}]}]]})"),
              HasSubstr("reverse: there is no \"a\", expected law, A_V, m"));
  std::string many = R"({"strings": [[{"cells": [)";
  for (int k = 0; k < 13; ++k) {
    many += fmt::format("{}{{\"light\": 0.{}}}", k > 0 ? "," : "", k + 11);
  }
  EXPECT_THAT(ErrorOf(many + "]}]]}"), HasSubstr("at most 12 kinds of cells"));
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
