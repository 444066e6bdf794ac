#include "lyrefit/read/join_sweeps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/curve/sweep_order.h"

namespace lyrefit {
namespace {

// Sum of the last third minus sum of the first third.
double Change(const std::vector<double>& values) {
  const std::size_t third = values.size() / 3;
  double change = 0;
  for (std::size_t i = 0; i < third; ++i) change += values[values.size() - 1 - i] - values[i];
  return change;
}

// Whether a sweep in the other direction is stored in the order of its scan, although it shares the
// voltages of the first one: its current then changes with the opposite sign.
bool IsStoredInScanOrder(SweepDirection own, SweepDirection other, const IvCurve& sweep,
                         const IvCurve& first) {
  return own != SweepDirection::kUnknown && other != SweepDirection::kUnknown && own != other &&
         Change(sweep.current_A) * Change(first.current_A) < 0;
}

bool GoesAgainst(SweepDirection direction, const IvCurve& sweep) {
  return direction != SweepDirection::kUnknown && sweep.size() > 1 &&
         Rises(sweep.voltage_V) != (direction == SweepDirection::kForward);
}

void Turn(IvCurve* sweep, std::vector<int>* lines) {
  Reverse(sweep);
  std::reverse(lines->begin(), lines->end());
}

}  // namespace

void TakeLight(const Column& current, IvCurve* curve, Sidecar* stated) {
  const bool dark = current.tag.light == SweepLight::kDark;
  if (current.tag.by_letter && !dark) {
    curve->assumptions.push_back(
        fmt::format("column {} taken as lit (L beside D)", Quoted(current.label)));
  }
  if (!dark) return;
  Forget(About::kIrradiance, &curve->assumptions);
  stated->irradiance_W_m2 = 0;
  curve->assumptions.emplace_back(
      fmt::format("irradiance 0 W/m2, since column {} is dark{}", Quoted(current.label),
                  current.tag.by_letter ? " (D beside L)" : ""),
      About::kIrradiance);
}

void GiveDirection(SweepDirection direction, IvCurve* sweep) {
  if (GoesAgainst(direction, *sweep)) Reverse(sweep);
}

void JoinSweeps(const std::vector<Column>& columns, const Channel& channel,
                std::vector<FurtherSweep> further, IvCurve* curve, std::vector<int>* lines) {
  if (further.empty() || curve->size() == 0) return;
  const Column& first = columns[channel.current];
  std::string labels = Quoted(first.label);
  for (std::size_t i = 0; i < further.size(); ++i) {
    const ColumnPair& pair = channel.more[i];
    const Column& column = columns[pair.current];
    labels += (i + 1 == further.size() ? " and " : ", ") + Quoted(column.label);
    IvCurve& sweep = further[i].curve;
    const bool turned =
        pair.voltage == channel.voltage &&
        IsStoredInScanOrder(column.tag.direction, first.tag.direction, sweep, *curve);
    if (!turned) continue;
    std::reverse(sweep.current_A.begin(), sweep.current_A.end());
    curve->assumptions.push_back(
        fmt::format("column {} is stored in the order of its scan beside voltages in the other "
                    "order: its currents were turned",
                    Quoted(column.label)));
  }
  const bool stated = first.tag.direction != SweepDirection::kUnknown;
  curve->assumptions.push_back(
      fmt::format("columns {} read as sweeps of one device{}", labels,
                  stated ? ""
                         : ", since a third column is their average: the first in the order of the "
                           "file, the next back"));
  if (GoesAgainst(first.tag.direction, *curve)) Turn(curve, lines);
  bool rises = Rises(curve->voltage_V);
  for (std::size_t i = 0; i < further.size(); ++i) {
    auto& [sweep, own_lines] = further[i];
    const SweepDirection direction = columns[channel.more[i].current].tag.direction;
    const bool turn = direction == SweepDirection::kUnknown ? Rises(sweep.voltage_V) == rises
                                                            : GoesAgainst(direction, sweep);
    if (turn) Turn(&sweep, &own_lines);
    rises = Rises(sweep.voltage_V);
    AppendSweep(sweep, curve);
    lines->insert(lines->end(), own_lines.begin(), own_lines.end());
  }
}

}  // namespace lyrefit
