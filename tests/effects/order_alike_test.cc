#include "lyrefit/estimate/fit/polish.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "lyrefit/effects/catalogue.h"
#include "lyrefit/estimate/fit/simulate.h"
#include "lyrefit/model/device_effects.h"

namespace lyrefit {
namespace {

const ParameterBounds kAny = {0, 1, 0, 1, SearchScale::kLinear};

TEST(OrderAlike, SortsByIdealityAndPutsVanishedOnesLast) {
  //                       Iph Is1 n1   Rs Rsh Is2 n2   Is3 n3
  std::vector<double> p = {1, 0, 1.1, 2, 3, 7, 1.9, 8, 1.5};
  std::vector<bool> active = {false, true, true, false, false, false, false, false, false};
  const Device device = MakeDevice(Model::kTripleDiode, {});
  OrderAlike(device, std::vector<ParameterBounds>(9, kAny), &p, &active);
  EXPECT_EQ(p, (std::vector<double>{1, 8, 1.5, 2, 3, 7, 1.9, 0, 1.1}));
  EXPECT_EQ(active,
            (std::vector<bool>{false, false, false, false, false, false, false, true, true}));
}

TEST(OrderAlike, LeavesDiodesWithBoundsOfTheirOwnAlone) {
  std::vector<ParameterBounds> bounds(7, kAny);
  bounds[6].lower = 0.5;
  std::vector<double> p = {1, 2, 1.9, 3, 4, 5, 1.1};
  const std::vector<double> before = p;
  OrderAlike(MakeDevice(Model::kDoubleDiode, {}), bounds, &p, nullptr);
  EXPECT_EQ(p, before);
}

// A device of one or two diodes with an effect.
Device Extended(Model model, const char* effect) {
  SimulateOptions options;
  options.parameters = {{"Iph", 8}, {"Is1", 2e-9}, {"n", 1.15}, {"Rs", 0.2}, {"Rsh", 300}};
  options.conditions.cells_in_series = 60;
  const auto curve = Simulate(options);
  const Device base = MakeDevice(model, options.conditions);
  return *Extend(base, model, ConstantSet::kCodata, *curve, {{FindEffect(effect), {}}}, false);
}

TEST(OrderAlike, TakesNoParametersOfEffectsForDiodes) {
  const Device device = Extended(Model::kSingleDiode, "transient");
  std::vector<double> p = {8, 2e-9, 1.15, 0.2, 300, 0.3, 0.2, 0.1, 0, 2};
  const std::vector<double> before = p;
  OrderAlike(device, std::vector<ParameterBounds>(10, kAny), &p, nullptr);
  EXPECT_EQ(p, before);
}

TEST(OrderAlike, LeavesDiodesThatFollowTheTemperatureEachInItsOwnWay) {
  std::vector<double> p = {8, 1e-6, 1.9, 0.2, 300, 2e-9, 1.1, 5};
  const std::vector<double> before = p;
  const std::vector<ParameterBounds> bounds(8, kAny);
  OrderAlike(Extended(Model::kDoubleDiode, "temp_drift"), bounds, &p, nullptr);
  EXPECT_EQ(p, before);
  OrderAlike(Extended(Model::kDoubleDiode, "collection"), bounds, &p, nullptr);
  EXPECT_EQ(p, (std::vector<double>{8, 2e-9, 1.1, 0.2, 300, 1e-6, 1.9, 5}));
}

// Cell groups are sorted by their missing light; groups with a share of 0 come last.
TEST(OrderAlike, SortsGroupsOfCells) {
  const Device device = Extended(Model::kSingleDiode, "substrings");
  const double third = 1.0 / 3;
  //                       Iph Is1  n1    Rs   Rsh  d1 w1 d2   w2     d3   w3     d4 w4 Vb  c
  std::vector<double> p = {8, 2e-9, 1.15, 0.2, 300, 0, 0, 0.7, third, 0.2, third, 0, 0, 0.5, 1};
  std::vector<bool> active(p.size(), false);
  active[7] = true;
  std::vector<ParameterBounds> bounds(p.size(), kAny);
  OrderAlike(device, bounds, &p, &active);
  EXPECT_EQ(p, (std::vector<double>{8, 2e-9, 1.15, 0.2, 300, 0.2, third, 0.7, third, 0, 0, 0, 0,
                                    0.5, 1}));
  EXPECT_EQ(std::find(active.begin(), active.end(), true) - active.begin(), 7);
  bounds[5].upper = 0.5;
  std::swap(p[5], p[7]);
  const std::vector<double> before = p;
  OrderAlike(device, bounds, &p, nullptr);
  EXPECT_EQ(p, before) << "they have bounds of their own";
}

}  // namespace
}  // namespace lyrefit
