#include "faults/field_module.h"

#include <algorithm>
#include <cmath>

namespace faults::field {
namespace {

constexpr double kTolerance = 1e-7;  // of the largest photocurrent
constexpr double kBeyondShort = 1.03;
constexpr double kBeyondOpen = -1.3;

double Photocurrent(const std::vector<Cell>& chain) {
  double largest = 0;
  for (const Cell& cell : chain) largest = std::max(largest, cell.photocurrent);
  return largest;
}

double Photocurrent(const Group& group) {
  double sum = 0;
  for (const auto& chain : group.chains) sum += Photocurrent(chain);
  return sum;
}

Sampled CurveOfChain(const std::vector<Cell>& chain, double largest) {
  const auto law = [&](double current) {
    Point sum{current, 0, 0};
    for (const Cell& cell : chain) {
      const Point own = AtCurrent(cell, current);
      sum.voltage += own.voltage;
      sum.slope += own.slope;
    }
    return sum;
  };
  return Sample(law, kBeyondOpen * largest, kBeyondShort * largest, kTolerance * largest);
}

// Diode curve in the generator sign convention: forward current flows at negative voltage.
Sampled CurveOfDiode(const BypassDiode& diode, double largest) {
  Sampled curve;
  const auto add = [&](double current) {
    const double inside = current + diode.saturation_A;
    curve.points.push_back(
        {current,
         -diode.scale_V * std::log(inside / diode.saturation_A) - diode.series_ohm * current,
         -diode.scale_V / inside - diode.series_ohm});
  };
  // The blocking range starts at twelve voltage scales, where the current is within 6e-6 of
  // saturation.
  constexpr int kSteps = 48;
  for (int i = 0; i < kSteps; ++i)
    add(diode.saturation_A * std::expm1(12.0 * (i - kSteps) / kSteps));
  const double span = std::log1p(2 * largest / diode.saturation_A);
  for (int i = 0; i <= 4 * kSteps; ++i)
    add(diode.saturation_A * std::expm1(span * i / (4 * kSteps)));
  const Point blocking = curve.points.front();
  constexpr double kFar = 1e3;  // V
  curve.points.insert(curve.points.begin(),
                      {blocking.current - 1e-9 * diode.saturation_A, kFar, blocking.slope * 1e9});
  return curve;
}

Sampled CurveOfShort(double ohm, double largest) {
  return {{{-5 * largest, 5 * largest * ohm, -ohm}, {5 * largest, -5 * largest * ohm, -ohm}}};
}

Sampled CurveOfGroup(const Group& group, double largest) {
  std::vector<Sampled> parts;
  for (const auto& chain : group.chains) {
    if (group.broken) continue;
    parts.push_back(CurveOfChain(chain, largest / static_cast<double>(group.chains.size())));
  }
  if (group.bypass == Bypass::kWorks) parts.push_back(CurveOfDiode(group.diode, largest));
  if (group.bypass == Bypass::kShorted) parts.push_back(CurveOfShort(group.short_ohm, largest));
  std::vector<const Sampled*> all;
  for (const Sampled& part : parts) all.push_back(&part);
  return all.size() == 1 ? parts.front() : SideBySide(all);
}

}  // namespace

int Module::CellsInSeries() const {
  int cells = 0;
  for (const Group& group : groups) cells += static_cast<int>(group.chains.front().size());
  return cells;
}

double Module::LargestPhotocurrent() const {
  double largest = 0;
  for (const Group& group : groups) largest = std::max(largest, Photocurrent(group));
  return largest;
}

Sampled CurveOf(const Module& module, double light) {
  Module lit = module;
  for (Group& group : lit.groups) {
    for (auto& chain : group.chains) {
      for (Cell& cell : chain) cell.photocurrent *= light;
    }
  }
  const double largest = lit.LargestPhotocurrent();
  std::vector<Sampled> groups;
  for (const Group& group : lit.groups) groups.push_back(CurveOfGroup(group, largest));
  std::vector<const Sampled*> all;
  for (const Sampled& group : groups) all.push_back(&group);
  return InSeries(all);
}

}  // namespace faults::field
