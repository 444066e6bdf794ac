#include "lyrefit/batch/plant_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/base/number_text.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

constexpr std::size_t kLettersOfName = 22;

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
  const auto undecided = summary.zones.find("undecided");
  if (undecided != summary.zones.end()) {
    const std::int64_t rows = undecided->second.rows;
    text += fmt::format("; {} {} undecided", Counted(rows), rows == 1 ? "is" : "are");
  }
  if (summary.in_need > 0) {
    text += fmt::format("; {} need{} work: {}", Counted(summary.in_need),
                        summary.in_need == 1 ? "s" : "", Listed(summary.causes, 6));
  }
  if (summary.in_need > 0 && summary.recoverable_power_W > 0) {
    text += ", worth about " + Power(summary.recoverable_power_W);
  }
  if (summary.in_need > 0 && summary.below_rating_W > 0) {
    text += fmt::format(". They are {} below their rating at standard conditions",
                        Power(summary.below_rating_W));
  }
  text += ".";
  if (summary.to_repeat > 0) {
    text += fmt::format(" {} {} to be measured again, for a cause of the measurement alone: {}.",
                        Counted(summary.to_repeat), summary.to_repeat == 1 ? "has" : "have",
                        Listed(summary.causes_to_repeat, 6));
  }
  std::int64_t beside = 0;
  for (const auto& [cause, share] : summary.causes_of_passed) beside += share.rows;
  if (beside > 0) {
    text += fmt::format(" Of those that pass, {} show{} a cause all the same: {}.", Counted(beside),
                        beside == 1 ? "s" : "", Listed(summary.causes_of_passed, 6));
  }
  if (summary.passed_outlier > 0) {
    text += fmt::format(" {} that need{} no work by this differ{} from the strings of {} combiner.",
                        Counted(summary.passed_outlier), summary.passed_outlier == 1 ? "s" : "",
                        summary.passed_outlier == 1 ? "s" : "",
                        summary.passed_outlier == 1 ? "its" : "their");
  }
  if (summary.fine < summary.rows) {
    text += fmt::format(" {} could not be judged.", Counted(summary.rows - summary.fine));
  }
  return text;
}

}  // namespace lyrefit
