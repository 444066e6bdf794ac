#include <algorithm>
#include <cmath>
#include <numeric>

#include "lyrefit/model/model_points.h"
#include "studies/landscape_draw.h"
#include "synthetic/draw.h"

namespace lyrefit {
namespace {

// Number of substrings for each irradiance, in random order and not all equal. All partitions are
// equally likely. `lights` is from 2 to the number of substrings less one.
std::vector<int> DrawGroups(int substrings, int lights, RandomStream* random) {
  for (;;) {
    std::vector<int> cuts(substrings - 1);
    std::iota(cuts.begin(), cuts.end(), 1);
    for (int k = 0; k < lights - 1; ++k) {
      std::swap(cuts[k], cuts[WholeBetween(random, k, substrings - 2)]);
    }
    cuts.resize(lights - 1);
    std::sort(cuts.begin(), cuts.end());
    cuts.push_back(substrings);
    std::vector<int> groups;
    groups.reserve(lights);
    for (int k = 0; k < lights; ++k) groups.push_back(cuts[k] - (k > 0 ? cuts[k - 1] : 0));
    if (std::adjacent_find(groups.begin(), groups.end(), std::not_equal_to<>()) != groups.end()) {
      return groups;
    }
  }
}

double DrawBypass(RandomStream* random) { return Between(random, 0.35, 0.75); }

// A module in which each group of substrings has its own irradiance; the first group has the
// highest. If `known`, the fit fixes the shares of the groups. Otherwise it fits each share between
// one substring and all substrings but one.
Expected<LandscapeCase> UnderLights(const std::vector<int>& groups, bool known, bool covered,
                                    RandomStream* random) {
  const int substrings = std::accumulate(groups.begin(), groups.end(), 0);
  DrawnDevice device = DrawModule(substrings, random);
  const double least = 1.0 / substrings;
  Values values = {{"Vb", DrawBypass(random)}};
  Ranges ranges;
  for (std::size_t k = 1; k < groups.size(); ++k) {
    const std::string number = std::to_string(k);
    const double share = groups[k] * least;
    values["d" + number] = Between(random, 0.02, 0.95);
    values["w" + number] = share;
    ranges["d" + number] = {0, 0.999};
    ranges["w" + number] =
        known ? std::pair(share, share) : std::pair(least, (substrings - 1) * least);
  }
  if (covered) {
    values["c"] = Between(random, 0.05, 0.95);
    ranges["c"] = {0.03, 1};
  }
  device.made.with = {Held("substrings", values)};
  device.with = {Freed("substrings", ranges)};
  return Measure(device);
}

// A module of three substrings, one of them shaded, with its simulation and its fit. The fit has a
// fixed shaded share.
DrawnDevice DrawShadedModule(RandomStream* random) {
  constexpr double kShare = 1.0 / 3;
  DrawnDevice device = DrawModule(3, random);
  const double depth = Between(random, 0.05, 0.95);
  device.made.with = {Held("shading", {{"d", depth}, {"w", kShare}, {"Vb", DrawBypass(random)}})};
  device.with = {Freed("shading", {{"d", {0, 0.999}}, {"w", {kShare, kShare}}})};
  return device;
}

}  // namespace

Expected<LandscapeCase> DrawLights(int lights, RandomStream* random) {
  return UnderLights(std::vector<int>(lights, 1), /*known=*/true, /*covered=*/false, random);
}

Expected<LandscapeCase> DrawUnlikeLights(bool covered, RandomStream* random) {
  const int substrings = WholeBetween(random, 3, 6);
  const int lights = WholeBetween(random, 2, std::min(4, substrings - 1));
  return UnderLights(DrawGroups(substrings, lights, random), /*known=*/false, covered, random);
}

Expected<LandscapeCase> DrawWeakCell(ReverseLaw law, RandomStream* random) {
  DrawnDevice device = DrawModule(WholeBetween(random, 2, 4), random);
  Values values = {{"d", Between(random, 0.03, 0.95)}, {"cells", 1}, {"g", 0}, {"chains", 1}};
  values["Vb"] = DrawBypass(random);
  if (law == ReverseLaw::kSoft) {
    values["A"] = LogUniform(random, 1.5, 15);
    values["m"] = Between(random, 2, 5);
  } else {
    values["A"] = 0;
    values["a"] = LogUniform(random, 0.01, 1);
    values["Vbr"] = Between(random, 8, 30);
    values["m"] = Between(random, 2, 6);
  }
  device.made.with = {Held("weak_cell", values)};
  device.with = {Freed("weak_cell", {})};
  return Measure(device);
}

Expected<LandscapeCase> DrawShadeAndStep(RandomStream* random) {
  DrawnDevice device = DrawShadedModule(random);
  const double sign = random->Index(2) == 0 ? -1 : 1;
  const double step = sign * LogUniform(random, 0.003, 0.15);
  device.made.with.push_back(Held("irr_step", {{"s", step}, {"x0", Between(random, -0.45, 0.35)}}));
  device.with.push_back(Freed("irr_step", {}));
  return Measure(device);
}

Expected<LandscapeCase> DrawShadeAndShunt(RandomStream* random) {
  DrawnDevice device = DrawShadedModule(random);
  const SimulateOptions& made = device.made;
  const double exponent = Between(random, 1.5, 4.5);
  // Shunt current at the cells' open-circuit voltage, relative to Isc.
  const double part = LogUniform(random, 0.005, 0.1);
  const double isc = made.parameters.at("Iph");
  const double thermal_V =
      made.parameters.at("n1") * ThermalVoltage(made.conditions.cell_temperature_K, made.constants);
  const double voc = thermal_V * std::log1p(isc / made.parameters.at("Is1"));
  device.made.with.push_back(
      Held("nonohmic_shunt", {{"k", part * isc * std::pow(voc, -exponent)}, {"m", exponent}}));
  device.with.push_back(Freed("nonohmic_shunt", {}));
  return Measure(device);
}

Expected<LandscapeCase> DrawThreeDiodes(RandomStream* random) {
  constexpr int kDiodes = 3;
  constexpr double kNoise = 1e-4;
  DrawnDevice device;
  device.made.model = Model::kTripleDiode;
  device.bounds.name = "wide";
  const double isc = LogUniform(random, 0.5, 10);
  const double voc = Between(random, 0.55, 0.68);
  const double n[kDiodes] = {Between(random, 0.95, 1.1), Between(random, 1.8, 2.2),
                             Between(random, 3, 6)};
  // Shares of the current at open circuit.
  const double third = Between(random, 0.03, 0.3);
  const double second = Between(random, 0.05, 0.5);
  const double part[kDiodes] = {1 - second - third, second, third};
  Values& parameters = device.made.parameters;
  parameters = {{"Iph", isc},
                {"Rs", Between(random, 0.01, 0.04) * voc / isc},
                {"Rsh", LogUniform(random, 20, 1000) * voc / isc}};
  const double thermal_V = device.made.conditions.ModuleThermalVoltage(device.made.constants);
  for (int k = 0; k < kDiodes; ++k) {
    const std::string number = std::to_string(k + 1);
    parameters["n" + number] = n[k];
    parameters["Is" + number] = SaturationCurrent(part[k] * isc, voc, n[k] * thermal_V);
  }
  DrawMeasurement(isc, kNoise, kNoise, random, &device);
  return Measure(device);
}

}  // namespace lyrefit
