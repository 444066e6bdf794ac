#include "lyrefit/read/join_sweeps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "lyrefit/base/number_text.h"
#include "lyrefit/curve/sweep_order.h"
#include "lyrefit/read/label.h"
#include "lyrefit/read/results_above.h"

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

namespace {

// A label as name and unit. The name is the last of its words before a unit: "subcell 0 IL(A)".
struct NameAndUnit {
  std::string name;
  std::string unit;
};

NameAndUnit SplitUnit(std::string_view label) {
  const std::vector<LabelWord> words = SplitLabel(label);
  std::size_t end = 0;
  while (end < words.size() && !words[end].marked_as_unit) ++end;
  // "voc_V" has its unit as a word.
  const bool bare = end > 1 && end == words.size() && words[end - 2].text == "voc" &&
                    FindUnit(ColumnKind::kVoltage, words[end - 1].text) != nullptr;
  if (bare) --end;
  return {end == 0 ? "" : words[end - 1].text, JoinWords(words, end, words.size())};
}

bool IsPhotocurrent(const NameAndUnit& label) {
  return label.name == "il" || label.name == "iph" || label.name == "photocurrent";
}

}  // namespace

std::optional<SunsVocColumns> FindSunsVoc(const std::vector<std::string>& labels) {
  if (AreKeyPoints(labels)) return std::nullopt;
  SunsVocColumns found;
  for (int i = 0; i < static_cast<int>(labels.size()); ++i) {
    const Column column = RecogniseColumn(labels[i]);
    const NameAndUnit label = SplitUnit(labels[i]);
    if (IsCurrent(column.kind) && column.refusal.empty()) return std::nullopt;
    const Unit* volt = FindUnit(ColumnKind::kVoltage, label.unit);
    const Unit* ampere = FindUnit(ColumnKind::kCurrent, label.unit);
    const bool voc = label.name == "voc" && (label.unit.empty() || volt != nullptr);
    if (found.voltage == -1 && (voc || column.kind == ColumnKind::kVoltage)) {
      found.voltage = i;
      found.voltage_factor = voc ? (volt == nullptr ? 1 : volt->factor) : column.factor;
    } else if (IsPhotocurrent(label) && (label.unit.empty() || ampere != nullptr)) {
      found.light = i;
      found.light_factor = ampere == nullptr ? 1 : ampere->factor;
      found.photocurrent = true;
    } else if (found.light == -1 && label.name == "suns") {
      found.light = i;
    } else if (found.light == -1 && column.kind == ColumnKind::kIrradiance) {
      found.light = i;
      found.light_factor = column.factor / 1000;
    }
  }
  if (found.voltage == -1 || found.light == -1) return std::nullopt;
  return found;
}

Expected<void> LightToCurrent(const SunsVocColumns& columns, std::optional<double> isc,
                              IvCurve* curve) {
  if (!columns.photocurrent && !isc) {
    return Fail(
        "this is a Suns-Voc trace, open-circuit voltage over light: its curve needs the "
        "short-circuit current at one sun (--isc-A)");
  }
  std::vector<double>& values = curve->current_A;
  if (values.empty()) return {};
  for (double& value : values) value *= columns.light_factor;
  const double brightest = *std::max_element(values.begin(), values.end());
  for (double& value : values)
    value = columns.photocurrent ? brightest - value : *isc * (1 - value);
  curve->suns_voc_A = columns.photocurrent ? brightest : *isc;
  curve->current_unit_known = true;
  curve->assumptions.push_back(
      columns.photocurrent
          ? fmt::format(
                "a Suns-Voc trace, read as the curve at its brightest light, a photocurrent "
                "of {:.6g} A: series resistance is not in it",
                brightest)
          : fmt::format(
                "a Suns-Voc trace, read as the curve of a short-circuit current of {:.6g} A at "
                "one sun: series resistance is not in it",
                *isc));
  return {};
}

void SayIsTrace(IvCurve* curve) {
  if (curve->current_A.empty()) return;
  curve->suns_voc_A = *std::max_element(curve->current_A.begin(), curve->current_A.end());
  curve->pseudo_current = true;
  curve->assumptions.emplace_back(
      "a Suns-Voc trace whose light the file gives as currents: series resistance is not in it");
}

}  // namespace lyrefit
