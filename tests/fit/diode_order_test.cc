#include "lyrefit/fit/diode_order.h"

#include <gtest/gtest.h>

#include "lyrefit/effects/catalogue.h"
#include "lyrefit/fit/simulate.h"
#include "lyrefit/law/extension.h"

namespace lyrefit {
namespace {

const ParameterBounds kAny = {0, 1, 0, 1, SearchScale::kLinear};

TEST(OrderDiodes, SortsByIdealityAndPutsVanishedOnesLast) {
  //                       Iph Is1 n1   Rs Rsh Is2 n2   Is3 n3
  std::vector<double> p = {1, 0, 1.1, 2, 3, 7, 1.9, 8, 1.5};
  std::vector<bool> held = {false, true, true, false, false, false, false, false, false};
  const Device device = MakeDevice(Model::kTripleDiode, {});
  OrderDiodes(device, std::vector<ParameterBounds>(9, kAny), &p, &held);
  EXPECT_EQ(p, (std::vector<double>{1, 8, 1.5, 2, 3, 7, 1.9, 0, 1.1}));
  EXPECT_EQ(held, (std::vector<bool>{false, false, false, false, false, false, false, true, true}));
}

TEST(OrderDiodes, LeavesDiodesWithBoundsOfTheirOwnAlone) {
  std::vector<ParameterBounds> bounds(7, kAny);
  bounds[6].lower = 0.5;
  std::vector<double> p = {1, 2, 1.9, 3, 4, 5, 1.1};
  const std::vector<double> before = p;
  OrderDiodes(MakeDevice(Model::kDoubleDiode, {}), bounds, &p, nullptr);
  EXPECT_EQ(p, before);
}

// A device of one or two diodes in the measurement of some curve, with an effect.
Device Extended(Model model, const char* effect) {
  SimulateOptions options;
  options.parameters = {{"Iph", 8}, {"Is1", 2e-9}, {"n", 1.15}, {"Rs", 0.2}, {"Rsh", 300}};
  options.conditions.cells_in_series = 60;
  const auto curve = Simulate(options);
  const Device base = MakeDevice(model, options.conditions);
  return *Extend(base, model, ConstantSet::kCodata, *curve, {{FindEffect(effect), {}}}, false);
}

TEST(OrderDiodes, TakesNoParametersOfEffectsForDiodes) {
  const Device device = Extended(Model::kSingleDiode, "transient");
  std::vector<double> p = {8, 2e-9, 1.15, 0.2, 300, 0.3, 0.2, 0.1, 0, 2};
  const std::vector<double> before = p;
  OrderDiodes(device, std::vector<ParameterBounds>(10, kAny), &p, nullptr);
  EXPECT_EQ(p, before);
}

TEST(OrderDiodes, LeavesDiodesThatFollowTheTemperatureEachInItsOwnWay) {
  std::vector<double> p = {8, 1e-6, 1.9, 0.2, 300, 2e-9, 1.1, 5};
  const std::vector<double> before = p;
  const std::vector<ParameterBounds> bounds(8, kAny);
  OrderDiodes(Extended(Model::kDoubleDiode, "temp_drift"), bounds, &p, nullptr);
  EXPECT_EQ(p, before);
  OrderDiodes(Extended(Model::kDoubleDiode, "collection"), bounds, &p, nullptr);
  EXPECT_EQ(p, (std::vector<double>{8, 2e-9, 1.1, 0.2, 300, 1e-6, 1.9, 5}));
}

}  // namespace
}  // namespace lyrefit
