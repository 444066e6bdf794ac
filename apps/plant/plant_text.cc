#include "plant/plant_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/base/number_text.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

constexpr std::size_t kLettersOfName = 22;

// Columns whose names do not become words by themselves.
constexpr std::pair<const char*, const char*> kColumnWords[] = {
    {"Pmax_stc_W", "Pmax at standard conditions"},
    {"p_mp_rate_percent", "change of power a year"},
    {"resistance_series_rate_ohm", "change of series resistance a year"},
    {"loss_total_percent", "energy lost"},
    {"loss_now_total_percent", "power lost now"},
    {"loss_light_percent", "energy lost by light"},
    {"loss_mismatch_percent", "energy lost by mismatch"},
    {"group_Isc_percent", "Isc against the neighbours"},
    {"group_Voc_percent", "Voc against the neighbours"},
    {"group_FF_percent", "FF against the neighbours"},
    {"group_deviation_percent", "Pmax against the neighbours"}};
constexpr const char* kUnitsOfColumns[] = {"_W", "_A", "_V", "_C", "_Wm2", "_ohm", "_percent"};

std::string Listed(const std::map<std::string, PlantShare>& shares, std::size_t most) {
  std::string text;
  const auto ordered = Ordered(shares);
  std::int64_t rest = 0;
  for (std::size_t c = 0; c < ordered.size(); ++c) {
    if (c >= most) {
      rest += ordered[c].second.rows;
      continue;
    }
    text += fmt::format("{}{} ({})", c == 0 ? "" : ", ", LowerCase(Title(ordered[c])),
                        Counted(ordered[c].second.rows));
  }
  return rest > 0 ? text + fmt::format(", others ({})", Counted(rest)) : text;
}

std::string Plural(std::int64_t count, const std::string& what) {
  return fmt::format("{} {}{}", Counted(count), what, count == 1 ? "" : "s");
}

}  // namespace

std::vector<std::pair<std::string, PlantShare>> Ordered(
    const std::map<std::string, PlantShare>& shares) {
  std::vector<std::pair<std::string, PlantShare>> ordered(shares.begin(), shares.end());
  std::stable_sort(ordered.begin(), ordered.end(), [](const auto& one, const auto& other) {
    return one.second.rows > other.second.rows;
  });
  return ordered;
}

std::string Title(const std::pair<std::string, PlantShare>& cause) {
  return cause.second.title.empty() ? cause.first : cause.second.title;
}

std::string Power(double watts) {
  if (watts >= 999500) return Significant(watts / 1e6, 3) + " MW";
  if (watts >= 9999.5) return Significant(watts / 1000, 3) + " kW";
  return watts >= 999.5 ? Significant(watts / 1000, 2) + " kW" : fmt::format("{:.0f} W", watts);
}

std::string Counted(std::int64_t count) {
  std::string text = std::to_string(count);
  for (std::size_t place = text.size(); place > 3;) text.insert(place -= 3, ",");
  return text;
}

std::string ShortName(const std::string& name) {
  if (Columns(name) <= kLettersOfName) return name;
  std::string text = name.substr(name.size() - kLettersOfName);
  while (!text.empty() && (text.front() & 0xc0) == 0x80) text.erase(0, 1);
  return "\xe2\x80\xa6" + text;
}

std::string ColumnInWords(const std::string& column) {
  for (const auto& [name, words] : kColumnWords) {
    if (column == name) return words;
  }
  std::string text = column;
  for (const std::string unit : kUnitsOfColumns) {
    const std::size_t end = text.size() - std::min(text.size(), unit.size());
    if (end == 0 || text.compare(end, unit.size(), unit) != 0) continue;
    text.erase(end);
    break;
  }
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string PlantVerdict(const PlantSummary& summary) {
  if (summary.rows == 0) return "No strings.";
  const std::string all = Plural(summary.rows, "string");
  const char* verb = summary.rows == 1 ? "s" : "";
  if (summary.judged_by.empty()) {
    return fmt::format("{} of {} ha{} a result.", Counted(summary.fine), all,
                       summary.rows == 1 ? "s" : "ve");
  }
  std::string text =
      summary.judged_by == "zone"
          ? fmt::format("{} of {} pass{}", Counted(summary.passed), all, *verb ? "es" : "")
          : fmt::format("{} of {} show{} no cause",
                        Counted(summary.fine - summary.in_need - summary.to_repeat), all, verb);
  text += ".";
  const auto add = [&text](std::int64_t count, const char* one, const char* many,
                           const std::string& what) {
    if (count > 0) text += fmt::format(" {} {}{}.", Counted(count), count == 1 ? one : many, what);
  };
  const auto undecided = summary.zones.find("undecided");
  if (undecided != summary.zones.end()) {
    add(undecided->second.rows, "is undecided", "are undecided", "");
  }
  add(summary.in_need, "needs work: ", "need work: ", Listed(summary.causes, 6));
  if (summary.in_need > 0 && summary.recoverable_power_W > 0) {
    text += fmt::format(" Repair would give about {}.", Power(summary.recoverable_power_W));
  }
  if (summary.in_need > 0 && summary.below_rating_W > 0) {
    text += fmt::format(" {} {} below {} rating at standard conditions.",
                        summary.in_need == 1 ? "The string is" : "These strings are",
                        Power(summary.below_rating_W), summary.in_need == 1 ? "its" : "their");
  }
  add(summary.to_repeat, "must be measured again, because the measurement has a fault: ",
      "must be measured again, because the measurement has a fault: ",
      Listed(summary.causes_to_repeat, 6));
  std::int64_t beside = 0;
  for (const auto& [cause, share] : summary.causes_of_passed) beside += share.rows;
  add(beside, "of the strings that pass also shows a cause: ",
      "of the strings that pass also show a cause: ", Listed(summary.causes_of_passed, 6));
  add(summary.passed_outlier, "string that needs no work differs from the others of its combiner",
      "strings that need no work differ from the others of their combiners", "");
  if (summary.fine < summary.rows) {
    text += fmt::format(" {} could not be judged.", Counted(summary.rows - summary.fine));
  }
  return text;
}

}  // namespace lyrefit
