#include "lyrefit/estimate/fit/bounds.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/model/kernel.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/settings/bounds_file.h"
#include "synthetic/curves.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

TEST(MakeBounds, DerivesAPhysicalBoxThatHoldsTheTruth) {
  const IvCurve curve = ModuleCurve(Model::kDoubleDiode, kDoubleTruth, 1e-3);
  const Device device = MakeDevice(Model::kDoubleDiode, curve.conditions);
  const auto bounds = *MakeBounds({}, device, curve);
  for (int i = 0; i < device.size(); ++i) {
    EXPECT_LE(bounds[i].lower, bounds[i].search_lower);
    EXPECT_LE(bounds[i].search_lower, kDoubleTruth[i]) << device.parameters[i].symbol;
    EXPECT_GE(bounds[i].search_upper, kDoubleTruth[i]) << device.parameters[i].symbol;
    EXPECT_LE(bounds[i].search_upper, bounds[i].upper);
  }
}

TEST(MakeBounds, WidensNWhereTheNumberOfCellsCannotBeRight) {
  IvCurve curve = ModuleCurve(Model::kSingleDiode, kSingleTruth, 1e-3);
  curve.conditions.cells_in_series = 1;
  const Device device = MakeDevice(Model::kSingleDiode, curve.conditions);
  const auto bounds = *MakeBounds({}, device, curve);
  EXPECT_LE(bounds[2].lower, 36 * 1.2);
  EXPECT_GE(bounds[2].upper, 36 * 1.2);
}

// Collection, ions and barriers raise the n of a thin film's curve.
TEST(MakeBounds, LetsNOfThinFilmsBeAboveTwo) {
  IvCurve curve = ModuleCurve(Model::kSingleDiode, kSingleTruth, 1e-3);
  const Device device = MakeDevice(Model::kSingleDiode, curve.conditions);
  const auto upper = [&](const char* technology) {
    curve.notes.technology = technology;
    return (*MakeBounds({}, device, curve))[2].upper;
  };
  EXPECT_EQ(upper(""), 2);
  EXPECT_EQ(upper("mono-Si"), 2);
  EXPECT_EQ(upper("Perovskite"), 6);
  EXPECT_EQ(upper("organic, inverted"), 6);
}

// A diode of n 1.4 and 2e-12 A, swept into a series resistance that takes `drop_V` at the last
// reading, and into breakdown.
IvCurve DiodeInTheDark(double drop_V, bool breakdown) {
  IvCurve curve;
  curve.conditions.cells_in_series = 1;
  const Device device = MakeDevice(Model::kSingleDiode, curve.conditions);
  const double thermal_V = 1.4 * device.module_thermal_voltage_V;
  const double top_A = 2e-12 * std::expm1(0.7 / thermal_V);
  const std::vector<double> truth = {0, 2e-12, 1.4, drop_V / top_A, 1e9};
  for (int k = 0; k <= 100; ++k) curve.voltage_V.push_back(-1 + 0.01 * k * (1.7 + drop_V));
  curve.current_A = SolveCurrents(device, truth.data(), curve.voltage_V);
  if (breakdown) curve.current_A[0] = 1e3 * top_A;
  return curve;
}

TEST(MakeBounds, HoldsTheDiodeOfADarkCurveWhateverItsResistanceTakes) {
  for (const double drop_V : {0.05, 0.7, 3.3}) {
    for (const bool breakdown : {false, true}) {
      for (const bool cells_known : {false, true}) {
        IvCurve curve = DiodeInTheDark(drop_V, breakdown);
        curve.cells_known = cells_known;
        const Device device = MakeDevice(Model::kSingleDiode, curve.conditions);
        const auto bounds = *MakeBounds({}, device, curve);
        const double top_A = -curve.current_A.back();
        EXPECT_LT(bounds[kIph].upper, 10 * top_A) << "breakdown does not rule";
        EXPECT_LE(bounds[1].search_lower, 2e-12) << drop_V;
        EXPECT_GE(bounds[1].search_upper, 2e-12) << drop_V;
        EXPECT_LE(bounds[2].lower, 1) << drop_V;
        EXPECT_GE(bounds[2].upper, 1.4) << drop_V;
        EXPECT_GE(bounds[kRs].upper, drop_V / top_A) << drop_V;
        if (cells_known) {
          EXPECT_LE(bounds[2].upper, 10) << "a stated number of cells stands";
        }
      }
    }
  }
}

TEST(MakeBounds, OfALitCurveHangOnWhatItDelivers) {
  IvCurve curve = ModuleCurve(Model::kSingleDiode, kSingleTruth, 0);
  const Device device = MakeDevice(Model::kSingleDiode, curve.conditions);
  const auto before = *MakeBounds({}, device, curve);
  curve.voltage_V.push_back(30);
  curve.current_A.push_back(-500);
  const auto beyond = *MakeBounds({}, device, curve);
  for (int i = 0; i < device.size(); ++i) {
    EXPECT_EQ(before[i].lower, beyond[i].lower) << device.parameters[i].symbol;
    EXPECT_EQ(before[i].upper, beyond[i].upper) << device.parameters[i].symbol;
  }
}

TEST(MakeBounds, LetsATableSpeakForEveryDiodeOrForOne) {
  const IvCurve curve = ModuleCurve(Model::kSingleDiode, kSingleTruth, 1e-3);
  const Device device = MakeDevice(Model::kDoubleDiode, curve.conditions);
  BoundsSpec spec;
  spec.name = "table";
  spec.table = {{"Iph", {0, 5}},  {"Is", {0, 1e-6}}, {"n", {1, 2}},
                {"n2", {1.8, 2}}, {"Rs", {0, 1}},    {"Rsh", {0, 1000}}};
  const auto bounds = *MakeBounds(spec, device, curve);
  EXPECT_EQ(bounds[2].lower, 1);
  EXPECT_EQ(bounds[6].lower, 1.8);
  EXPECT_EQ(bounds[5].upper, 1e-6);
  EXPECT_EQ(bounds[1].scale, SearchScale::kLinear);
  spec.table.erase("Rs");
  EXPECT_EQ(MakeBounds(spec, device, curve).error().message, "bounds 'table' leave out Rs");
}

TEST(ReadBoundsFile, ReadsThePublishedOnes) {
  const auto spec = ReadBoundsFile(LYREFIT_DATA_DIR "/rtc_france/bounds-paper.json");
  ASSERT_TRUE(spec.has_value()) << spec.error().ToString();
  EXPECT_EQ(spec->table.at("Rsh"), (std::pair{0.0, 100.0}));
}

TEST(ReadBoundsFile, SaysWhereAndWhatIsWrong) {
  const TempFolder folder;
  const struct {
    const char* text;
    const char* expected;
  } cases[] = {
      {"{\"Iph\":[0,1],\n \"Rs\":[0]}", ":2:"},
      {"{\"Iph\":[0,1],\n \"Rs\":[0,\"a\"]}", ":2:"},
      {"[1,2]", "expected bounds as an object"},
      {"{\"Foo\":[0,1]}", "no such parameter"},
      {"{\"Rs\":[1,0]}", "reversed"},
      {"{\"Rs\":[-1,0]}", "expected 0 or more"},
      {"{\"Rs\":[0,1]", ":1:"},
  };
  for (const auto& c : cases) {
    const auto spec = ReadBoundsFile(folder.Write("b.json", c.text));
    ASSERT_FALSE(spec.has_value()) << c.text;
    EXPECT_NE(spec.error().ToString().find(c.expected), std::string::npos)
        << c.text << " gave " << spec.error().ToString();
  }
  EXPECT_FALSE(ReadBoundsFile(folder.Path("missing.json")).has_value());
}

TEST(NamedBounds, SaysFirstThatThereIsNoCurve) {
  const TempFolder folder;
  const auto error = [](const std::string& file) {
    return NamedBounds("literature", file).error().ToString();
  };
  EXPECT_EQ(error(folder.Path("nosuch")), folder.Path("nosuch") + ": the file does not exist");
  const std::string curve = folder.Write("curve.csv", "voltage_V,current_A\n");
  for (const std::string& file : {curve, std::string("-"), std::string()}) {
    EXPECT_NE(error(file).find("beside the curve; there are physical and wide"), std::string::npos)
        << error(file);
  }
}

}  // namespace
}  // namespace lyrefit
