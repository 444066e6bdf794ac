#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lyrefit/base/append.h"
#include "lyrefit/base/median.h"
#include "lyrefit/curve/date_time.h"
#include "lyrefit/trend/day_series.h"
#include "lyrefit/trend/quantities.h"

namespace lyrefit {
namespace {

constexpr double kTogether_days = 45;  // onsets of shunt and recombination so near are one cause
constexpr double kShade_days = 30;     // of the days that tell how a shade came

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

Cause DeviceCause(const char* id, std::string title, const char* sentence, const char* action) {
  Cause cause;
  cause.id = id;
  cause.title = std::move(title);
  cause.sentence = sentence;
  cause.group = "device";
  cause.action = action;
  return cause;
}

// Power in % lost by mismatch on the days from `begin_s` on, within a part of a month.
double MismatchFrom(const TrendBlocks& blocks, double begin_s) {
  double lost_W = 0, expected_W = 0;
  for (const TrendRow& row : blocks.rows) {
    if (row.time_s < begin_s || row.time_s > begin_s + kShade_days * kDay_s) continue;
    lost_W += row.parts_W[kPartMismatch];
    expected_W += row.expected_W;
  }
  return expected_W > 0 ? 100 * lost_W / expected_W : kUnknown;
}

// "between 8 and 10 o'clock": three hours of the logger's day at most that have most of what
// mismatch takes in the month from `begin_s` on; empty: there are none.
std::string HoursOfMismatch(const TrendBlocks& blocks, double begin_s) {
  constexpr int kHours = 24, kWindow = 3;
  constexpr double kMost = 0.7;
  std::array<double, kHours> lost_W{};
  double all_W = 0;
  for (const TrendRow& row : blocks.rows) {
    if (row.time_s < begin_s || row.time_s > begin_s + kShade_days * kDay_s) continue;
    const double hour = kHours * (row.time_s / kDay_s - std::floor(row.time_s / kDay_s));
    const double own_W = std::max(row.parts_W[kPartMismatch], 0.0);
    lost_W[std::min(static_cast<int>(hour), kHours - 1)] += own_W;
    all_W += own_W;
  }
  for (int begin = 0; begin + kWindow <= kHours; ++begin) {
    double own_W = 0;
    for (int k = 0; k < kWindow; ++k) own_W += lost_W[begin + k];
    if (all_W > 0 && own_W > kMost * all_W) {
      return fmt::format(", most of it between {} and {} o'clock", begin, begin + kWindow);
    }
  }
  return "";
}

// Whether mismatch took as much at this season of the record's first year, and less between.
bool ReturnsWithSeason(const TrendBlocks& blocks, double time_s) {
  constexpr double kHalf = 0.5;
  const double now = MismatchFrom(blocks, time_s);
  const double last_s = blocks.time_s.back();
  double before = kUnknown, least = now;
  for (double begin_s = blocks.time_s.front(); begin_s < std::min(time_s, last_s);
       begin_s += 0.5 * kShade_days * kDay_s) {
    const double own = MismatchFrom(blocks, begin_s);
    if (!std::isfinite(own)) continue;
    const double season = std::fabs(std::remainder((time_s - begin_s) / kDay_s, kYear_days));
    if (season < 2 * kShade_days && time_s - begin_s > 0.5 * kYear_days * kDay_s &&
        !(own <= before)) {
      before = own;
    }
    least = std::min(least, own);
  }
  return before > kHalf * now && least < kHalf * kHalf * now;
}

Cause CauseOf(const TrendBlocks& blocks, const TrendReport& report, const TrendQuantity& quantity,
              const TrendChange& change) {
  if (quantity.name == "mismatch") {
    const std::string hours = HoursOfMismatch(blocks, change.time_s);
    if (ReturnsWithSeason(blocks, change.time_s)) {
      return DeviceCause("seasonal_shade", "shade that comes back with the season" + hours,
                         "mismatch took as much at this season before, and less between",
                         "look for what throws a shadow when the sun is where it is then; nothing "
                         "in the device has changed");
    }
    return DeviceCause(
        "growing_mismatch", "growing mismatch" + hours,
        "power is lost that neither light nor resistances explain: shade, dirt or snow on a "
        "part, broken cells",
        "look at the module at the time of its losses; diagnose one of the sweeps");
  }
  if (quantity.name == "resistance_series") {
    return change.onset ? DeviceCause("growing_series_resistance", "growing series resistance",
                                      "solder joints or interconnects age, or a contact corrodes",
                                      "thermography under load")
                        : DeviceCause("series_resistance_step", "a step of the series resistance",
                                      "a connector, a clamp or an interconnect changed",
                                      "check connectors and the junction box, thermography under "
                                      "load");
  }
  const std::string other =
      quantity.name == "recombination" ? "conductance_shunt" : "recombination";
  if (HasOnsetNear(report, other, change.time_s)) {
    return DeviceCause(
        "potential_induced_degradation", "potential-induced degradation",
        "shunt and recombination grow together, as by potential-induced degradation (PID)",
        "measure the string's potential to ground and its insulation; electroluminescence shows "
        "dark cells at the negative end");
  }
  if (quantity.name == "recombination") {
    return DeviceCause(
        "growing_recombination",
        change.onset ? "growing recombination" : "a step of the recombination",
        "the voltage falls by more than light and temperature explain: degradation of the "
        "cells, or an error of the temperature sensor",
        "compare the sensor with another one; electroluminescence");
  }
  return DeviceCause("growing_shunt",
                     change.onset ? "growing shunt conductance" : "a step of the shunt conductance",
                     "cells leak: PID in its beginning, cracks or hot spots",
                     "thermography; electroluminescence at low current");
}

// Lost substrings of each block, by the median of its sweeps; -1: no sweep.
std::vector<int> LostByBlock(const TrendBlocks& blocks) {
  std::vector<std::vector<double>> lost(blocks.size());
  for (std::size_t i = 0; i < blocks.rows.size(); ++i) {
    if (blocks.rows[i].state != TrendRowState::kUsed) continue;
    lost[blocks.block[i]].push_back(blocks.rows[i].lost_substrings);
  }
  std::vector<int> median(blocks.size(), -1);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (!lost[b].empty()) median[b] = static_cast<int>(UpperMedian(lost[b]));
  }
  return median;
}

// An onset where the number of lost substrings rises and stays so for ten days of data, or to
// the end of the series but for at least three.
std::vector<TrendOnset> OnsetsOfSubstrings(const TrendBlocks& blocks, const TrendReport& report) {
  constexpr int kStays = 10, kLeast = 3;
  std::vector<TrendOnset> onsets;
  const std::vector<int> lost = LostByBlock(blocks);
  int before = 0;
  double last_s = blocks.time_s.front();
  for (std::size_t b = 0; b < lost.size(); ++b) {
    if (lost[b] < 0) continue;
    int stays = 0;
    std::size_t k = b;
    for (; k < lost.size() && stays < kStays; ++k) {
      if (lost[k] < 0) continue;
      if (lost[k] <= before) break;
      ++stays;
    }
    const bool stayed = stays >= kStays || (k == lost.size() && stays >= kLeast);
    if (lost[b] > before && stayed) {
      TrendOnset onset;
      onset.quantity = "mismatch";
      onset.time_s = onset.latest_s = blocks.time_s[b];
      onset.earliest_s = last_s;
      onset.lost_percent = LostNow(report, "mismatch");
      onset.cause = DeviceCause(
          "lost_substrings",
          fmt::format("{} of {} substrings without voltage", lost[b], blocks.device->substrings),
          "Voc is lower by whole substrings: a bypass diode is shorted, or a cell string is open "
          "and bypassed",
          "measure the voltage of each substring at the junction box and replace the diode");
      onsets.push_back(std::move(onset));
      before = lost[b];
    } else if (lost[b] < before) {
      before = lost[b];
    }
    last_s = blocks.time_s[b];
  }
  return onsets;
}

// Whether the number of lost substrings changes within the days around a time.
bool SubstringsChange(const TrendBlocks& blocks, double time_s) {
  constexpr double kAround_s = 10 * kDay_s;
  const std::vector<int> lost = LostByBlock(blocks);
  int least = blocks.device->substrings, most = 0;
  for (std::size_t b = 0; b < lost.size(); ++b) {
    if (lost[b] < 0 || std::fabs(blocks.time_s[b] - time_s) > kAround_s) continue;
    least = std::min(least, lost[b]);
    most = std::max(most, lost[b]);
  }
  return most > least;
}

bool MayEchoSubstrings(const TrendOnset& onset) {
  return onset.cause.id != "lost_substrings" && onset.quantity != "conductance_shunt" &&
         onset.cause.id != "potential_induced_degradation";
}

// What a lost substring changes besides, and an onset of the same cause in another quantity, are no
// onsets of their own.
std::vector<TrendOnset> WithoutEchoes(const std::vector<TrendOnset>& onsets) {
  constexpr double kEcho_s = 30 * kDay_s;
  std::vector<TrendOnset> own;
  for (const TrendOnset& onset : onsets) {
    const bool echo = std::any_of(onsets.begin(), onsets.end(), [&](const TrendOnset& other) {
      return other.cause.id == "lost_substrings" && MayEchoSubstrings(onset) &&
             std::fabs(onset.time_s - other.time_s) < kEcho_s;
    });
    const bool again = std::any_of(own.begin(), own.end(), [&](const TrendOnset& other) {
      return onset.cause.id == other.cause.id && onset.quantity != other.quantity &&
             std::fabs(onset.time_s - other.time_s) < kTogether_days * kDay_s;
    });
    if (!echo && !again) own.push_back(onset);
  }
  return own;
}

// A step of a parameter about a day that is larger than what one device does in a day; null: none.
const TrendChange* LargeStepOn(const TrendReport& report, const TrendQuantity& quantity,
                               double time_s) {
  constexpr double kSameDay_s = 3 * kDay_s;
  // Of light in %, of the reference, of a cell in V, of the reference.
  constexpr double kLight = 1, kSeries = 0.04, kCell_V = 0.002, kShunt = 0.1;
  double least = kInfinity;
  if (quantity.name == "light") least = kLight;
  if (quantity.name == "resistance_series") least = kSeries * quantity.reference;
  if (quantity.name == "recombination") least = kCell_V * report.cells_in_series;
  if (quantity.name == "conductance_shunt") least = kShunt * quantity.reference;
  for (const TrendChange& change : quantity.changes) {
    const bool near = !change.onset && std::fabs(change.time_s - time_s) <= kSameDay_s;
    if (near && std::fabs(change.size.value) > least) return &change;
  }
  return nullptr;
}

// From when on a shunt takes `least_percent` of the power or more; infinity: never.
double ShuntGrowsFrom(const TrendBlocks& blocks, const std::vector<TrendQuantity>& quantities,
                      double least_percent) {
  double begin_s = kInfinity;
  for (const TrendQuantity& quantity : quantities) {
    if (quantity.name != "conductance_shunt") continue;
    for (const TrendChange& change : quantity.changes) {
      const bool matters = LostByChange(blocks, quantity.name, change) >= least_percent;
      if (matters) begin_s = std::min(begin_s, change.time_s);
    }
  }
  return begin_s;
}

}  // namespace

std::optional<ExchangedDevice> FindExchange(const TrendBlocks& blocks, const TrendReport& report,
                                            double least_percent) {
  constexpr std::size_t kLeastChanged = 3;
  constexpr double kGreat_V = 0.02;  // of a cell: no device gains as much, no sensor errs by it
  if (report.source != TrendSource::kSweeps) return std::nullopt;
  // A shunt changes all parameters as it grows.
  const double shunt_s = ShuntGrowsFrom(blocks, report.quantities, least_percent) + 3 * kDay_s;
  std::optional<ExchangedDevice> possible;
  for (const TrendQuantity& first : report.quantities) {
    for (const TrendChange& at : first.changes) {
      if (at.onset || at.time_s > shunt_s) continue;
      ExchangedDevice found{at.time_s, {}, false};
      bool great = false;
      for (const TrendQuantity& one : report.quantities) {
        const TrendChange* const step = LargeStepOn(report, one, at.time_s);
        if (step == nullptr) continue;
        found.changed.push_back(fmt::format(
            "{} {:+.3g} {}", one.title.substr(0, one.title.find(',')), step->size.value, one.unit));
        found.time_s = std::min(found.time_s, step->time_s);
        found.certain |= one.name != "light" && step->size.high_95 < 0;
        great |=
            one.name == "recombination" && step->size.high_95 < -kGreat_V * report.cells_in_series;
      }
      const std::size_t least = great ? kLeastChanged - 1 : kLeastChanged;
      if (found.changed.size() < least || SubstringsChange(blocks, found.time_s)) continue;
      if (found.certain) return found;
      if (!possible) possible = std::move(found);
    }
  }
  return possible;
}

std::vector<TrendQuantity> WithChangesThatMatter(std::vector<TrendQuantity> quantities,
                                                 const TrendBlocks& blocks, double least_percent) {
  constexpr double kBefore_s = 10 * kDay_s;
  for (TrendQuantity& quantity : quantities) {
    auto& changes = quantity.changes;
    const auto small = [&](const TrendChange& change) {
      return quantity.monitored &&
             std::fabs(LostByChange(blocks, quantity.name, change)) < least_percent;
    };
    changes.erase(std::remove_if(changes.begin(), changes.end(), small), changes.end());
  }
  const double begin_s = ShuntGrowsFrom(blocks, quantities, least_percent);
  for (TrendQuantity& quantity : quantities) {
    if (quantity.name != "resistance_series" && quantity.name != "mismatch") continue;
    auto& changes = quantity.changes;
    changes.erase(std::remove_if(changes.begin(), changes.end(),
                                 [&](const TrendChange& change) {
                                   return change.time_s > begin_s - kBefore_s;
                                 }),
                  changes.end());
  }
  return quantities;
}

std::vector<TrendOnset> FindOnsets(const TrendBlocks& blocks, const TrendReport& report) {
  std::vector<TrendOnset> onsets;
  for (const TrendQuantity& quantity : report.quantities) {
    if (!quantity.monitored) continue;
    for (const TrendChange& change : quantity.changes) {
      if (!(change.size.value > 0)) continue;  // to the better, or the end of a growth
      // What grows slowly in operating points may be a shunt.
      if (change.onset && report.source == TrendSource::kOperatingPoints) continue;
      onsets.push_back({quantity.name, change.time_s, change.earliest_s, change.latest_s,
                        LostNow(report, quantity.name), CauseOf(blocks, report, quantity, change)});
    }
  }
  Append(OnsetsOfSubstrings(blocks, report), &onsets);
  std::stable_sort(
      onsets.begin(), onsets.end(),
      [](const TrendOnset& one, const TrendOnset& other) { return one.time_s < other.time_s; });
  return WithoutEchoes(onsets);
}

}  // namespace lyrefit
