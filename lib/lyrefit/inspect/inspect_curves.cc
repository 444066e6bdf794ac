#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/curve/check_readings.h"
#include "lyrefit/curve/dark.h"
#include "lyrefit/curve/sweep_order.h"
#include "lyrefit/inspect/inspect_parts.h"
#include "lyrefit/read/cells.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

constexpr double kOneCell_V = 1.6;  // more than any junction delivers (CheckReadings: "cells")

std::string DirectionOf(const IvCurve& curve) {
  const std::vector<int> turns = FindTurns(curve.voltage_V);
  if (turns.size() > 1) return "up and down";
  return Rises(curve.voltage_V) ? "up" : "down";
}

CurveNote NoteOn(const IvCurve& curve) {
  CurveNote note;
  note.name = curve.name;
  note.points = curve.size();
  const auto [low, high] = std::minmax_element(curve.voltage_V.begin(), curve.voltage_V.end());
  note.least_V = *low;
  note.largest_V = *high;
  note.kind = KindOf(curve);
  if (note.kind.kind != CurveKind::kDark) {
    note.key_points = FindKeyPoints(curve.voltage_V, curve.current_A);
  }
  note.direction = DirectionOf(curve);
  if (curve.irradiance_known) note.irradiance_W_m2 = curve.conditions.irradiance_W_m2;
  if (curve.temperature_known) {
    note.temperature_C = curve.conditions.cell_temperature_K - kZeroCelsius_K;
  }
  return note;
}

template <class Says>
bool AnyLacks(const CurveSet& set, Says says) {
  return std::any_of(set.curves.begin(), set.curves.end(),
                     [&](const IvCurve& curve) { return !says(curve); });
}

// Whether a curve is of more than one cell, by its open-circuit voltage; a dark one by its largest.
bool IsOfModule(const CurveNote& curve) {
  const double voc = curve.key_points.open_circuit_voltage_V;
  return voc > kOneCell_V || (!(voc > 0) && curve.largest_V > 2 * kOneCell_V);
}

void TakeMissing(const CurveSet& set, Inspection* found) {
  const auto first = std::find_if(found->curves.begin(), found->curves.end(), IsOfModule);
  const bool module = first != found->curves.end();
  const auto lack = [&](const std::string& what, const char* flag) {
    found->missing.push_back({what, flag});
  };
  if (module && AnyLacks(set, [](const IvCurve& c) { return c.cells_known; })) {
    const double voc = first->key_points.open_circuit_voltage_V;
    lack(voc > 0 ? fmt::format("number of cells in series (by its Voc some {})", LikelyCells(voc))
                 : "number of cells in series",
         "--cells N");
  }
  if (AnyLacks(set, [](const IvCurve& c) { return c.temperature_known; })) {
    lack("cell temperature", "--temperature-C T");
  }
  const auto lit = [](const IvCurve& c) { return c.irradiance_known || c.suns_voc_A || IsDark(c); };
  if (AnyLacks(set, lit)) lack("irradiance", "--irradiance-Wm2 G");
  if (AnyLacks(set, [](const IvCurve& c) { return c.voltage_unit_known; })) {
    lack("unit of the voltage, taken as V", "--voltage-unit UNIT");
  }
  if (AnyLacks(set, [](const IvCurve& c) { return c.current_unit_known; })) {
    lack("unit of the current, taken as A", "--current-unit UNIT");
  }
  if (!module && AnyLacks(set, [](const IvCurve& c) { return c.notes.area_cm2.has_value(); })) {
    lack("area of the cell, for its efficiency", "--area-cm2 A");
  }
}

void TakeNext(const CurveSet& set, Inspection* found) {
  const std::string& file = found->file;
  const bool several = set.curves.size() > 1;
  const CurveKind kind = found->curves.front().kind.kind;
  std::string flags;
  for (const WayOut& way : found->missing) {
    if (way.flag.find("unit") == std::string::npos && way.flag.find("area") == std::string::npos) {
      flags += " " + way.flag;
    }
  }
  if (kind == CurveKind::kKeyPoints || kind == CurveKind::kIscVoc) {
    if (several) found->next = {"lyrefit fit " + file + " --family desoto|pvsyst" + flags};
    return;
  }
  const bool side_by_side =
      std::any_of(found->columns.begin(), found->columns.end(), [](const ColumnNote& column) {
        return column.use.find("current 2") == 0 || column.use.find("current density 2") == 0 ||
               column.use.find("device, one of") == 0;
      });
  const bool devices = side_by_side || !CheckIsOneCell(set, "batch");
  const std::string choose = side_by_side ? " --column NAME|N" : " --curve INDEX";
  found->next = {"lyrefit fit " + file + (several ? choose : "") + flags};
  if (several && devices) found->next.push_back("lyrefit batch " + file + " --out DIR");
  if (!IsOfModule(found->curves.front())) {
    found->next.push_back("lyrefit cell " + file + (devices ? " --column NAME" : ""));
    return;
  }
  // One device at several conditions is diagnosed as a whole, and fitted where they are stated.
  if (several && !devices && flags.find("-C") == std::string::npos) {
    found->next.push_back("lyrefit fit " + file + " --family desoto|pvsyst" + flags);
  }
  found->next.push_back("lyrefit diagnose " + file + (side_by_side ? choose : "") + flags);
  if (!several) found->next.push_back("lyrefit translate " + file + flags);
}

// A choice of options under which a refused file would be read.
struct Trial {
  std::string flag;
  ReadOptions options;
};

std::vector<Trial> TrialsOf(const Inspected& file) {
  std::vector<Trial> trials;
  const auto add = [&](const std::string& flag, auto set) {
    trials.push_back({flag, file.options});
    set(&trials.back().options);
  };
  if (!file.options.area_cm2) add("--area-cm2 A", [](ReadOptions* o) { o->area_cm2 = 1; });
  if (!file.options.skip_missing) {
    add("--skip-missing", [](ReadOptions* o) { o->skip_missing = true; });
    add("--skip-missing --area-cm2 A", [](ReadOptions* o) {
      o->skip_missing = true;
      o->area_cm2 = 1;
    });
  }
  if (!file.options.isc_A) add("--isc-A I", [](ReadOptions* o) { o->isc_A = 1; });
  constexpr std::size_t kMostColumns = 12;
  // Readings stand in most rows and differ.
  const auto may_be_read = [&file](const ColumnNote& column) {
    return column.numbers >= 5 && 2 * column.numbers >= file.found->rows &&
           column.least < column.largest;
  };
  const std::vector<ColumnNote>& columns = file.found->columns;
  for (std::size_t v = 0; v < std::min(kMostColumns, columns.size()); ++v) {
    for (const std::size_t i : {v + 1, v - 1}) {
      if (i >= columns.size() || !may_be_read(columns[v]) || !may_be_read(columns[i])) continue;
      const std::string voltage = std::to_string(v + 1), current = std::to_string(i + 1);
      add(fmt::format("--voltage-column {} --current-column {}", voltage, current),
          [&](ReadOptions* o) {
            o->voltage_column = voltage;
            o->current_column = current;
          });
    }
  }
  return trials;
}

// Whether readings are those of a device: they pass the checks before a fit, but for the number of
// cells and the temperature, which may be stated later, and their voltage covers an open circuit or
// 0 V.
bool AreOfADevice(const CurveSet& set) {
  return std::all_of(set.curves.begin(), set.curves.end(), [](const IvCurve& curve) {
    const KeyPoints points = FindKeyPoints(curve.voltage_V, curve.current_A);
    const bool meets_axis = points.open_circuit_voltage_V > 0 || points.short_circuit_current_A > 0;
    const auto findings = CheckReadings(curve);
    constexpr double kLine = 0.27;  // a straight line, such as a counter, has a fill factor of 0.25
    return meets_axis && !(points.fill_factor < kLine) && FindTurns(curve.voltage_V).size() <= 4 &&
           std::all_of(findings.begin(), findings.end(), [&](const ReadingFinding& one) {
             const bool module = one.id == "cells" && points.open_circuit_voltage_V > kOneCell_V;
             return !one.refuse && (module || one.id == "head");
           });
  });
}

// Adds the flags with which the file would be read, and what it would then hold. Where it is
// readable, and its readings were refused, they must be those of a device.
void TakeWaysOut(const Inspected& file, bool readable) {
  constexpr std::size_t kMost = 4;
  std::set<std::string> currents;
  for (const Trial& trial : TrialsOf(file)) {
    const bool pair = !trial.options.voltage_column.empty();
    const std::size_t found = file.found->missing.size();
    if (pair && (found == kMost || found > currents.size())) continue;
    if (currents.count(trial.options.current_column) != 0) continue;
    if (trial.options.skip_missing && trial.options.area_cm2 && found > 0) continue;
    const auto set = CurvesIn(file, trial.options);
    if (!set || ((pair || readable) && !AreOfADevice(*set))) continue;
    const CurveNote first = NoteOn(set->curves.front());
    const bool density = trial.options.area_cm2.has_value() && !file.options.area_cm2;
    const bool lit = first.kind.kind < CurveKind::kDark;
    const std::string points = fmt::format(
        ", Isc {} {}, Voc {} V", Significant(first.key_points.short_circuit_current_A, 4),
        density ? "A per cm2" : "A", Significant(first.key_points.open_circuit_voltage_V, 4));
    file.found->missing.push_back(
        {fmt::format("would give {} of {}{}{}", Plural(set->curves.size(), "curve"),
                     Plural(first.points, "point"), lit ? points : "",
                     first.kind.words.empty() ? "" : ", " + first.kind.words),
         trial.flag});
    if (pair) currents.insert(trial.options.current_column);
  }
}

}  // namespace

void DescribeCurves(const CurveSet& set, Inspection* found) {
  found->curve_count = set.curves.size();
  std::vector<std::string> refused;
  for (const IvCurve& curve : set.curves) {
    if (found->curves.size() < kMostCurveNotes) found->curves.push_back(NoteOn(curve));
    const auto doubts = JudgeReadings(curve);
    if (!doubts) refused.push_back(doubts.error().message);
    if (doubts) found->doubts.insert(found->doubts.end(), doubts->begin(), doubts->end());
  }
  const bool all = refused.size() == set.curves.size();
  if (all) found->refusal = refused.front();
  for (std::size_t k = 0; k < refused.size() && !all; ++k) {
    found->doubts.push_back("refused: " + refused[k]);
  }
  std::vector<std::string> sentences = SentencesOf(set.assumptions);
  if (set.curves.size() == 1) sentences = SentencesOf(set.curves.front().assumptions);
  found->assumed.insert(found->assumed.end(), sentences.begin(), sentences.end());
  for (const RejectedCurve& bad : set.rejected) {
    found->doubts.push_back(
        fmt::format("curve {} cannot be read: {}", bad.id, bad.error.ToString()));
  }
  if (all) return;
  TakeMissing(set, found);
  TakeNext(set, found);
}

void TakeCurves(const Inspected& file) {
  const auto set = CurvesIn(file, file.options);
  if (set) DescribeCurves(*set, file.found);
  if (!set) file.found->refusal = set.error().ToString();
  if (!file.found->refusal.empty()) TakeWaysOut(file, set.has_value());
}

}  // namespace lyrefit
