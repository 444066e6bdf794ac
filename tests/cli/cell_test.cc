#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "repeats.h"
#include "run_app.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

const std::string kCell = DataFolder("cell") + "/";

// Rows of two pixels, dark and lit, whose short-circuit currents are 1 and 2 mA.
std::string TwoPixels() {
  std::string rows;
  for (int k = 0; k <= 40; ++k) {
    const double voltage_V = 0.02 * k;
    const double dark_mA = 1e-9 * std::expm1(voltage_V / 0.036);
    rows += fmt::format("{0},{1},{0},{2},{0},{1},{0},{3}\n", voltage_V, dark_mA, dark_mA - 1,
                        dark_mA - 2);
  }
  return rows;
}

// Every figure of the JSON, computed by cell_reference.py from the readings in it.
TEST(CellCommand, AgreesWithAnIndependentComputation) {
  SKIP_IF_SANITIZED();
  const std::string script = DataFolder("../tests/cli/cell_reference.py");
  const int status =
      std::system(("/usr/bin/env python3 '" + script + "' '" LYREFIT_APP "'").c_str());
  const int code = WEXITSTATUS(status);
  if (code == 77 || code == 127) {
    const int own = std::system(("/usr/bin/python3 '" + script + "' '" LYREFIT_APP "'").c_str());
    if (WEXITSTATUS(own) == 77 || WEXITSTATUS(own) == 127) GTEST_SKIP() << "no Python with SciPy";
    EXPECT_EQ(WEXITSTATUS(own), 0);
    return;
  }
  EXPECT_EQ(code, 0);
}

TEST(CellCommand, WritesEveryOutput) {
  const TempFolder folder;
  const AppResult run = RunApp("cell '" + kCell + "pair.csv' --csv '" + folder.Path("c.csv") +
                               "' --json '" + folder.Path("c.json") + "' --html '" +
                               folder.Path("c.html") + "' --plot '" + folder.Path("c.svg") + "'");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("Hysteresis, normal"));
  EXPECT_THAT(FileText(folder.Path("c.csv")), HasSubstr("reverse,1000,25,0.25,"));
  EXPECT_THAT(FileText(folder.Path("c.html")), HasSubstr("index by power"));
  EXPECT_THAT(FileText(folder.Path("c.svg")), HasSubstr("</svg>"));
}

TEST(CellCommand, SunsVocTakesItsIscFromTheLitCurve) {
  const AppResult run = RunApp("cell '" + kCell + "suns.csv' '" + kCell + "pair.csv' --brief");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("n from Suns-Voc"));
  const AppResult alone = RunApp("cell '" + kCell + "suns.csv'");
  EXPECT_EQ(alone.exit_code, 1);
  EXPECT_THAT(alone.err, HasSubstr("--isc-A"));
}

// A lit curve of 22 mA/cm2 whose file states neither area nor light.
const std::string kDensities = [] {
  std::string rows = "V (V),J (mA/cm2)\n";
  for (int k = 0; k <= 45; ++k) {
    const double junction_V = 0.02 * k, current = 22 - 1e-9 * std::expm1(junction_V / 0.036);
    rows += fmt::format("{},{}\n", junction_V - 0.002 * current, current);
  }
  return rows;
}();

TEST(CellCommand, DensitiesNeedNoArea) {
  const TempFolder folder;
  const AppResult run = RunApp("cell '" + folder.Write("j.csv", kDensities) + "'");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("Jsc 22.00 mA/cm2"));
  EXPECT_THAT(run.out, HasSubstr("not stated: all is of 1 cm2"));
  // Beside currents of an unknown area they are not comparable.
  const std::string dark = folder.Write(
      "dark.csv",
      "# Irradiance: 0 W/m2\nV (V),I (A)\n0,0\n0.2,-1e-6\n0.4,-1e-5\n0.6,-1e-4\n0.7,-1e-3\n");
  const AppResult mixed = RunApp("cell '" + folder.Path("j.csv") + "' '" + dark + "'");
  EXPECT_EQ(mixed.exit_code, 1);
  EXPECT_THAT(mixed.err, HasSubstr("--area-cm2"));
}

TEST(CellCommand, ATraceBesideAnAssumedLight) {
  const TempFolder folder;
  std::string rows = "suns,voc_V\n";
  for (int k = 0; k < 30; ++k) {
    const double suns = 0.02 * std::pow(1.2, k);
    rows += fmt::format("{},{}\n", suns, 0.036 * std::log(22 * suns / 1e-9));
  }
  const std::string lit = folder.Write("j.csv", kDensities), trace = folder.Write("s.csv", rows);
  for (const char* const light : {"", " --irradiance-Wm2 1000"}) {
    const AppResult run = RunApp("cell '" + lit + "' '" + trace + "'" + light + " --verbose");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("Pseudo-FF"));
    const bool said = run.out.find("no light is stated") != std::string::npos;
    EXPECT_EQ(said, *light == '\0') << run.out;
  }
}

TEST(CellCommand, DescribesTheCellThatIsNamedLitAndDark) {
  const TempFolder folder;
  const std::string table = folder.Write(
      "pixels.csv",
      "Voltage (V)_a_Forward_Dark,Current (mA)_a_Forward_Dark,Voltage (V)_a_Forward_Light,"
      "Current (mA)_a_Forward_Light,Voltage (V)_b_Forward_Dark,Current (mA)_b_Forward_Dark,"
      "Voltage (V)_b_Forward_Light,Current (mA)_b_Forward_Light\n" +
          TwoPixels());
  const AppResult run = RunApp("cell '" + table + "' --column b --no-fit");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("cell pixels b\n"));
  EXPECT_THAT(run.out, HasSubstr("forward, dark"));
  EXPECT_THAT(run.out, HasSubstr("Isc 0.002000 A"));
  EXPECT_THAT(RunApp("cell '" + table + "'").err, HasSubstr("several cells (a, b)"));
  EXPECT_THAT(RunApp("cell '" + table + "' --column c").err, HasSubstr("'c' was asked for"));
}

}  // namespace
}  // namespace lyrefit
