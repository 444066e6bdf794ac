#include "lyrefit/read/suns_voc.h"

#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/read/column.h"
#include "lyrefit/read/label.h"
#include "lyrefit/read/results_above.h"

namespace lyrefit {
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
