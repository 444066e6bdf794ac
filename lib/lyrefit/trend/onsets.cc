#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/read/date_time.h"
#include "lyrefit/trend/quantities.h"

namespace lyrefit {
namespace {

constexpr double kTogether_days = 45;  // onsets of shunt and recombination so near are one cause

// Name of the part of the loss that a quantity belongs to.
std::string PartOf(const std::string& quantity) {
  return quantity == "conductance_shunt" ? "shunt" : quantity;
}

double LostNow(const TrendReport& report, const std::string& quantity) {
  for (const TrendLoss& loss : report.losses) {
    if (loss.name == PartOf(quantity)) return loss.now_percent.value;
  }
  return kUnknown;
}

// Most frequent number of lost substrings of the rows from a time on, up to 30 days later.
int LostSubstringsAfter(const TrendBlocks& blocks, double time_s) {
  constexpr double kAfter_s = 30 * kDay_s;
  std::vector<int> counts(16, 0);
  for (const TrendRow& row : blocks.rows) {
    if (row.time_s < time_s || row.time_s > time_s + kAfter_s) continue;
    ++counts[std::min<std::size_t>(row.lost_substrings, counts.size() - 1)];
  }
  return static_cast<int>(std::max_element(counts.begin(), counts.end()) - counts.begin());
}

bool HasOnsetNear(const TrendReport& report, const std::string& quantity, double time_s) {
  for (const TrendQuantity& one : report.quantities) {
    if (one.name != quantity) continue;
    for (const TrendChange& change : one.changes) {
      const bool near = std::fabs(change.time_s - time_s) < kTogether_days * kDay_s;
      if (change.size.value > 0 && near) return true;
    }
  }
  return false;
}

struct CauseWords {
  std::string cause;
  std::string what;
  std::string action;
};

CauseWords WordsOfMismatch(const TrendBlocks& blocks, const TrendChange& change) {
  const int lost = LostSubstringsAfter(blocks, change.time_s);
  if (lost > 0) {
    return {fmt::format("{} of {} substrings without voltage", lost, blocks.device->substrings),
            "Voc is lower by whole substrings: a bypass diode is shorted, or a cell string is open "
            "and bypassed",
            "measure the voltage of each substring at the junction box and replace the diode"};
  }
  return {"growing mismatch",
          "power is lost that neither light nor resistances explain: shade, dirt or snow on a part, "
          "broken cells",
          "look at the module at the time of its losses; diagnose one of the sweeps"};
}

CauseWords WordsOf(const TrendReport& report, const TrendBlocks& blocks,
                   const TrendQuantity& quantity, const TrendChange& change) {
  if (quantity.name == "mismatch") return WordsOfMismatch(blocks, change);
  if (quantity.name == "resistance_series") {
    return change.onset ? CauseWords{"growing series resistance",
                                     "solder joints or interconnects age, or a contact corrodes",
                                     "thermography under load"}
                        : CauseWords{"a step of the series resistance",
                                     "a connector, a clamp or an interconnect changed",
                                     "check connectors and the junction box, thermography under "
                                     "load"};
  }
  const std::string other =
      quantity.name == "recombination" ? "conductance_shunt" : "recombination";
  if (HasOnsetNear(report, other, change.time_s)) {
    return {"potential-induced degradation",
            "shunt and recombination grow together, as by potential-induced degradation (PID)",
            "measure the string's potential to ground and its insulation; electroluminescence shows "
            "dark cells at the negative end"};
  }
  if (quantity.name == "recombination") {
    return {"growing recombination",
            "the voltage falls by more than light and temperature explain: degradation of the "
            "cells, or an error of the temperature sensor",
            "compare the sensor with another one; electroluminescence"};
  }
  return {"growing shunt conductance", "cells leak: PID in its beginning, cracks or hot spots",
          "thermography; electroluminescence at low current"};
}

}  // namespace

void FindOnsets(const TrendBlocks& blocks, TrendReport* report) {
  for (const TrendQuantity& quantity : report->quantities) {
    if (quantity.name == "p_mp" || quantity.name == "light") continue;
    for (const TrendChange& change : quantity.changes) {
      if (!(change.size.value > 0)) continue;  // to the better, or the end of a growth
      const CauseWords words = WordsOf(*report, blocks, quantity, change);
      TrendOnset onset;
      onset.quantity = quantity.name;
      onset.time_s = change.time_s;
      onset.earliest_s = change.earliest_s;
      onset.latest_s = change.latest_s;
      onset.lost_percent = LostNow(*report, quantity.name);
      onset.cause = words.cause;
      onset.sentence = fmt::format("{}. To do: {}.", words.what, words.action);
      report->onsets.push_back(std::move(onset));
    }
  }
  std::stable_sort(
      report->onsets.begin(), report->onsets.end(),
      [](const TrendOnset& one, const TrendOnset& other) { return one.time_s < other.time_s; });
}

}  // namespace lyrefit
