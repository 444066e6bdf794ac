#include "plant/synthetic_score.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <vector>

#include "plant/synthetic_table.h"

namespace made {
namespace {

// Names and directions of the outliers: "Voc -4.96 % (usual: within 0.5 %), FF ..." -> "Voc-", ...
std::set<std::string> OutlierNames(const std::string& text) {
  std::set<std::string> names;
  std::string before;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    const bool sign = word.size() > 1 && (word[0] == '+' || word[0] == '-');
    if (sign && !before.empty()) names.insert(before + word[0]);
    before = word;
    at = end + 1;
  }
  return names;
}

struct Alarm {
  bool by_cause = false, by_group = false, by_zone = false;
  std::set<std::string> names;
  bool any() const { return by_cause || by_group || by_zone; }
};

Alarm AlarmOf(const Row& row) {
  Alarm alarm;
  alarm.by_cause = !At(row, "cause").empty();
  alarm.by_group = At(row, "group_flag") == "true";
  const std::string zone = At(row, "zone");
  alarm.by_zone = zone == "fail" || zone == "fail within uncertainty";
  if (alarm.by_cause) {
    alarm.names = Words(At(row, "equivalents"), " ,;|");
    alarm.names.insert(At(row, "cause"));
  }
  if (!alarm.by_cause) alarm.names = OutlierNames(At(row, "group_outlier"));
  return alarm;
}

// Whether the only alarm is a single misreading or the resolution, which is no fault of the string.
bool OfInstrument(const Row& row, const Alarm& alarm) {
  const std::string cause = At(row, "cause");
  return !alarm.by_group && !alarm.by_zone && (cause == "outliers" || cause == "quantisation");
}

std::string Said(const Row& row, const Alarm& alarm) {
  std::string text;
  const auto add = [&](bool is, const std::string& words) {
    if (is) text += (text.empty() ? "" : "; ") + words;
  };
  add(alarm.by_cause, At(row, "cause"));
  add(alarm.by_group, "beside its neighbours " + At(row, "group_outlier"));
  add(alarm.by_zone, At(row, "zone"));
  return text.empty() ? "not found" : text;
}

}  // namespace

std::string Score(const ScoreRequest& request, std::string* text) {
  std::vector<Row> results, truths;
  std::string error = ReadRows(request.results, &results);
  if (error.empty()) error = ReadRows(request.truth, &truths);
  if (!error.empty()) return error;
  std::map<std::string, Row> by_id;
  for (const Row& row : results) by_id[At(row, "id")] = row;
  int found = 0, right = 0;
  std::set<std::string> hidden;
  std::string lines;
  for (const Row& truth : truths) {
    const std::string id = At(truth, "id");
    hidden.insert(id);
    const Alarm alarm = AlarmOf(by_id[id]);
    const std::set<std::string> accepted = Words(At(truth, "accepted"), "|");
    const bool named = std::any_of(alarm.names.begin(), alarm.names.end(),
                                   [&](const std::string& name) { return accepted.count(name); });
    found += alarm.any();
    right += named;
    lines += "  " + id + "  " + At(truth, "fault") + " (" + At(truth, "loss_percent") +
             " %): " + Said(by_id[id], alarm) + (alarm.any() && !named ? "  [another name]" : "") +
             "\n";
  }
  int reference = 0, false_alarms = 0, instrument = 0, by_cause = 0, by_group = 0, by_zone = 0;
  std::string false_lines;
  for (const Row& row : results) {
    if (hidden.count(At(row, "id"))) continue;
    ++reference;
    const Alarm alarm = AlarmOf(row);
    false_alarms += alarm.any();
    instrument += OfInstrument(row, alarm);
    by_cause += alarm.by_cause;
    by_group += alarm.by_group;
    by_zone += alarm.by_zone;
    if (alarm.any()) false_lines += "  " + At(row, "id") + ": " + Said(row, alarm) + "\n";
  }
  char buffer[300];
  std::snprintf(
      buffer, sizeof buffer,
      "%d of %zu hidden faults found, %d under a right name\n"
      "%d false alarms among %d healthy strings (cause %d, neighbours %d, zone %d); %d of "
      "them of the instrument alone\n",
      found, truths.size(), right, false_alarms, reference, by_cause, by_group, by_zone,
      instrument);
  *text =
      buffer + ("hidden:\n" + lines) + (false_lines.empty() ? "" : "false alarms:\n" + false_lines);
  return "";
}

}  // namespace made
