#include "lyrefit/read/stated_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/read/label.h"
#include "lyrefit/read/table_header.h"

namespace lyrefit {

using nlohmann::json;

namespace {

constexpr std::string_view kKeyPointResults[] = {"isc", "jsc",  "voc",  "imp",
                                                 "vmp", "impp", "vmpp", "pmp"};
constexpr std::string_view kOtherResults[] = {"jmp",
                                              "jmpp",
                                              "umpp",
                                              "pmpp",
                                              "pmax",
                                              "mpp",
                                              "ff",
                                              "fillfactor",
                                              "eff",
                                              "efficiency",
                                              "pce",
                                              "rs",
                                              "rsh",
                                              "rseries",
                                              "rshunt",
                                              "seriesresistance",
                                              "shuntresistance"};

template <std::size_t kSize>
bool IsOneOf(const std::string_view (&names)[kSize], std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

// Whether an object holds weights of a fit under the names of results: "fit_weight".
bool AreWeights(std::string_view key) {
  const std::vector<LabelWord> words = SplitLabel(key);
  return std::any_of(words.begin(), words.end(), [](const LabelWord& word) {
    return word.text == "weight" || word.text == "weights";
  });
}

// Number of the words before the first that is marked as a unit.
std::size_t EndOfName(const std::vector<LabelWord>& words) {
  std::size_t end = 0;
  while (end < words.size() && !words[end].marked_as_unit) ++end;
  return end;
}

std::string_view Trimmed(std::string_view text) {
  constexpr char kBlanks[] = " \t\r:=;\"";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

// Whether the label of a column holds the name, at its begin or its end.
bool IsOf(std::string_view label, std::string_view name) {
  if (label.size() < name.size()) return false;
  return label.substr(0, name.size()) == name || label.substr(label.size() - name.size()) == name;
}

// The value that a line has for a current column, `place` of all; none if it has none.
std::optional<double> ValueFor(const ResultLine& line, const Column& column, std::size_t place,
                               std::size_t count) {
  for (std::size_t k = 0; k < line.names.size() && k < line.values.size(); ++k) {
    if (!line.names[k].empty() && IsOf(column.label, line.names[k])) return line.values[k];
  }
  if (line.names.empty() && line.values.size() == count) return line.values[place];
  return std::nullopt;
}

}  // namespace

std::string ResultName(std::string_view label) {
  const std::vector<LabelWord> words = SplitLabel(label);
  std::string name = JoinWords(words, 0, EndOfName(words));
  return name == "isca" || name == "voca" ? name.substr(0, 3) : name;
}

std::string ResultUnit(std::string_view label) {
  const std::vector<LabelWord> words = SplitLabel(label);
  return JoinWords(words, EndOfName(words), words.size());
}

bool AreKeyPoints(const std::vector<std::string>& names) {
  return std::count_if(names.begin(), names.end(), [](const std::string& name) {
           return IsOneOf(kKeyPointResults, ResultName(name));
         }) >= 3;
}

bool IsResult(std::string_view label) {
  const std::string name = ResultName(label);
  return IsOneOf(kKeyPointResults, name) || IsOneOf(kOtherResults, name);
}

void TakeColumnNames(std::string_view line, std::vector<std::string>* names) {
  const auto fields = SplitFields(line, '\t');
  if (!fields || fields->size() < 3) return;
  names->assign(fields->begin() + 1, fields->end());
  while (!names->empty() && names->back().empty()) names->pop_back();
}

ResultLine ReadResultLine(std::string_view line, const std::vector<std::string>& names,
                          const std::string& source) {
  ResultLine found;
  const std::size_t end = std::min(line.find_first_of(":=\t;"), line.size());
  found.label = std::string(Trimmed(line.substr(0, end)));
  found.source = source;
  for (std::size_t from = end; from < line.size();) {
    const std::size_t next = std::min(line.find_first_of("\t;", from + 1), line.size());
    const std::string_view field = Trimmed(line.substr(from, next - from));
    const auto number = ParseNumber(field, true);
    from = next;
    if (field.empty() && found.values.empty()) continue;
    found.values.push_back(number.value_or(kUnknown));
  }
  while (!found.values.empty() && found.values.back() != found.values.back()) {
    found.values.pop_back();
  }
  if (names.size() >= found.values.size() && found.values.size() > 1) found.names = names;
  return found;
}

std::vector<StatedResult> ResultsOf(const std::vector<ResultLine>& lines,
                                    const std::vector<Column>& columns,
                                    const std::vector<Channel>& channels, const Channel& channel) {
  std::vector<int> currents;
  for (const Channel& one : channels) {
    currents.push_back(one.current);
    for (const ColumnPair& more : one.more) currents.push_back(more.current);
  }
  std::sort(currents.begin(), currents.end());
  std::vector<int> own = {channel.current};
  for (const ColumnPair& more : channel.more) own.push_back(more.current);
  std::vector<StatedResult> results;
  for (std::size_t sweep = 0; sweep < own.size(); ++sweep) {
    const auto at = std::find(currents.begin(), currents.end(), own[sweep]);
    if (at == currents.end()) continue;
    const auto place = static_cast<std::size_t>(at - currents.begin());
    for (const ResultLine& line : lines) {
      const auto value = ValueFor(line, columns[own[sweep]], place, currents.size());
      if (!value || *value != *value) continue;
      results.push_back({static_cast<int>(sweep), line.label, *value, line.source});
    }
  }
  return results;
}

std::string MemberId(const std::string& id, const std::string& key) {
  return id.empty() ? key : fmt::format("{}.{}", id, key);
}

bool HoldsScalarsOnly(const json& object) {
  return object.is_object() && std::none_of(object.begin(), object.end(), [](const json& value) {
           return value.is_structured();
         });
}

std::vector<StatedResult> ResultsIn(const json& object, const std::string& id) {
  std::vector<StatedResult> results;
  const auto take = [&](const json& from, const std::string& above) {
    for (const auto& [key, value] : from.items()) {
      const auto number = value.is_structured() ? std::nullopt : NumberOrText(value);
      if (number && IsResult(key))
        results.push_back({0, key, *number, Quoted(MemberId(above, key))});
    }
  };
  for (const auto& [key, value] : object.items()) {
    if (HoldsScalarsOnly(value) && !AreWeights(key)) take(value, MemberId(id, key));
  }
  take(object, id);
  return results;
}

}  // namespace lyrefit
