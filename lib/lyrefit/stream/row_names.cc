// Optimized fully: rows are parsed character by character.
#include "lyrefit/stream/row_names.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/read/sidecar.h"
#include "lyrefit/read/table_head.h"

namespace lyrefit {
namespace {

struct IdName {
  std::string_view text;  // letters only, lower case
  IdPart part;
};

constexpr IdName kIdNames[] = {
    {"id", IdPart::kWhole},
    {"uid", IdPart::kWhole},
    {"uuid", IdPart::kWhole},
    {"curveid", IdPart::kWhole},
    {"stringid", IdPart::kWhole},
    {"path", IdPart::kWhole},
    {"site", IdPart::kSite},
    {"plant", IdPart::kSite},
    {"park", IdPart::kSite},
    {"block", IdPart::kBlock},
    {"section", IdPart::kBlock},
    {"zone", IdPart::kBlock},
    {"inverter", IdPart::kInverter},
    {"inv", IdPart::kInverter},
    {"wr", IdPart::kInverter},
    {"combiner", IdPart::kCombiner},
    {"combinerbox", IdPart::kCombiner},
    {"cb", IdPart::kCombiner},
    {"scb", IdPart::kCombiner},
    {"gak", IdPart::kCombiner},
    {"mppt", IdPart::kMppt},
    {"tracker", IdPart::kMppt},
    {"string", IdPart::kString},
    {"str", IdPart::kString},
    {"curve", IdPart::kCurve},
    {"name", IdPart::kOtherwise},
    {"label", IdPart::kOtherwise},
    {"module", IdPart::kOtherwise},
    {"panel", IdPart::kOtherwise},
    {"device", IdPart::kOtherwise},
    {"sample", IdPart::kOtherwise},
    {"serial", IdPart::kOtherwise},
};

constexpr std::string_view kEndings[] = {"number", "name", "id", "no", "nr"};

constexpr std::string_view kPairNames[] = {"ivdf",    "piv",    "iv",    "vi",
                                           "ivcurve", "ivdata", "points"};

IdPart FindIdName(std::string_view letters) {
  const auto* const found = std::find_if(std::begin(kIdNames), std::end(kIdNames),
                                         [&](const IdName& name) { return name.text == letters; });
  return found == std::end(kIdNames) ? IdPart::kNone : found->part;
}

IdPart IdPartOf(std::string_view name) {
  std::string letters;
  for (const char c : LowerCase(name)) {
    if (c >= 'a' && c <= 'z') letters += c;
    if (c >= '0' && c <= '9') return IdPart::kNone;  // "string2_V" does not name a level
  }
  if (const IdPart part = FindIdName(letters); part != IdPart::kNone) return part;
  for (const std::string_view ending : kEndings) {
    if (letters.size() <= ending.size()) continue;
    const std::size_t front = letters.size() - ending.size();
    if (std::string_view(letters).substr(front) != ending) continue;
    const IdPart part = FindIdName(std::string_view(letters).substr(0, front));
    if (part != IdPart::kNone) return part;
  }
  return IdPart::kNone;
}

NameMeaning Understand(std::string_view name) {
  NameMeaning meaning;
  meaning.id = IdPartOf(name);
  meaning.column = RecogniseColumn(name);
  meaning.sidecar = name != "name" && IsSidecarKey(name);
  // 30 is a valid value of every condition: cells, degrees, W/m2 and cm2.
  TableHead head;
  constexpr double kAnything = 30;
  meaning.states =
      !meaning.sidecar && meaning.id == IdPart::kNone && TakeStatement(name, kAnything, "", &head);
  meaning.pairs = std::find(std::begin(kPairNames), std::end(kPairNames), LowerCase(name)) !=
                  std::end(kPairNames);
  meaning.more = name == "more";
  if (name == "current_noise_constant_A") meaning.noise = "constant_A";
  if (name == "current_noise_relative") meaning.noise = "relative";
  meaning.sidecar = meaning.sidecar || meaning.noise != nullptr;
  return meaning;
}

using Names = std::map<std::string, NameMeaning, std::less<>>;

Names& NamesOfThread() {
  thread_local Names names;
  return names;
}

}  // namespace

const NameMeaning& MeaningOf(std::string_view name) {
  Names& names = NamesOfThread();
  const auto found = names.find(name);
  if (found != names.end()) return found->second;
  return names.emplace(std::string(name), Understand(name)).first->second;
}

void ForgetManyNames() {
  constexpr std::size_t kMany = 1000;
  Names& names = NamesOfThread();
  if (names.size() > kMany) names.clear();
}

std::string AsLevel(std::string_view text) {
  std::string level(TrimBlanks(text));
  std::replace(level.begin(), level.end(), '/', '_');
  return level;
}

std::string IdOf(const std::vector<RecordScalar>& scalars, std::vector<bool>* used) {
  constexpr std::size_t kParts = static_cast<std::size_t>(IdPart::kOtherwise) + 1;
  std::array<int, kParts> places;
  places.fill(-1);
  for (std::size_t i = 0; i < scalars.size(); ++i) {
    const auto part = static_cast<std::size_t>(MeaningOf(scalars[i].name).id);
    if (places[part] == -1 && !TrimBlanks(scalars[i].text).empty()) {
      places[part] = static_cast<int>(i);
    }
  }
  const auto take = [&](std::size_t part) {
    if (used != nullptr) (*used)[places[part]] = true;
    return std::string(TrimBlanks(scalars[places[part]].text));
  };
  if (used != nullptr) used->assign(scalars.size(), false);
  constexpr auto kWhole = static_cast<std::size_t>(IdPart::kWhole);
  constexpr auto kOtherwise = static_cast<std::size_t>(IdPart::kOtherwise);
  if (places[kWhole] != -1) return take(kWhole);
  std::string id;
  for (std::size_t part = kWhole + 1; part < kOtherwise; ++part) {
    if (places[part] != -1) id += (id.empty() ? "" : "/") + AsLevel(take(part));
  }
  if (id.empty() && places[kOtherwise] != -1) id = take(kOtherwise);
  return id;
}

namespace {

constexpr std::string_view kBrackets = "[](){}";
constexpr std::string_view kBlanks = " \t";

std::string_view Inside(std::string_view text) {
  text = TrimBlanks(text);
  while (!text.empty() && kBrackets.find(text.front()) != std::string_view::npos) {
    text.remove_prefix(1);
  }
  while (!text.empty() && kBrackets.find(text.back()) != std::string_view::npos) {
    text.remove_suffix(1);
  }
  return TrimBlanks(text);
}

// The separator of a list. Blanks separate only if there is no other separator; otherwise they
// belong to the other separator.
char SeparatorOf(std::string_view text) {
  for (const char c : {';', '|'}) {
    if (text.find(c) != std::string_view::npos) return c;
  }
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return ' ';
  // "8,49 8,48": the commas are decimal commas if every blank is between digits.
  const std::size_t blank = text.find_first_of(kBlanks);
  if (blank == std::string_view::npos) return ',';
  for (std::size_t at = blank; at != std::string_view::npos; at = text.find_first_of(kBlanks, at)) {
    if (at > 0 && text[at - 1] == ',') return ',';
    at = text.find_first_not_of(kBlanks, at);
    if (at == std::string_view::npos) break;
    if (text[at] == ',') return ',';
  }
  return ' ';
}

// Calls take(item) for each item. Items may be empty, except between blanks.
template <class Take>
void ForEachItem(std::string_view text, char separator, Take take) {
  if (text.empty()) return;
  std::size_t at = 0;
  while (at <= text.size()) {
    if (separator == ' ') {
      at = std::min(text.find_first_not_of(kBlanks, at), text.size());
      if (at == text.size()) return;
    }
    const std::size_t stop =
        separator == ' ' ? text.find_first_of(kBlanks, at) : text.find(separator, at);
    const std::size_t end = std::min(stop, text.size());
    take(TrimBlanks(text.substr(at, end - at)));
    at = end + 1;
  }
}

}  // namespace

void ParseList(std::string_view text, int column, Record* list) {
  text = Inside(text);
  const char separator = SeparatorOf(text);
  if (separator != ' ' && !text.empty() && text.back() == separator) text.remove_suffix(1);
  ForEachItem(text, separator, [&](std::string_view item) {
    double value = 0;
    const auto [end, error] = std::from_chars(item.data(), item.data() + item.size(), value);
    const bool plain = error == std::errc() && end == item.data() + item.size();
    if (plain && std::fabs(value) < kOverflowCode) {
      list->values.push_back(value);
    } else {
      AddReading(item, separator != ',', column, list);
    }
  });
}

bool IsList(std::string_view text) {
  text = Inside(text);
  constexpr std::size_t kLook = 200;
  text = text.substr(0, kLook);
  const char separator = SeparatorOf(text);
  int numbers = 0;
  int others = 0;
  ForEachItem(text, separator, [&](std::string_view item) {
    ++(ParseNumber(item, separator != ',') ? numbers : others);
  });
  return numbers >= 2 && numbers > others;
}

bool ParsePairs(std::string_view text, int column, Records* fields) {
  text = Inside(text);
  const bool stars = text.find('*') != std::string_view::npos;
  const char between = stars ? '*' : ':';
  const char separator = text.find('#') != std::string_view::npos ? '#' : SeparatorOf(text);
  Record first;
  Record second;
  first.name = "V";
  second.name = "I";
  first.column = second.column = column;
  bool pairs = true;
  std::size_t count = 0;
  ForEachItem(text, separator, [&](std::string_view item) {
    if (item.empty()) return;
    const std::size_t at = item.find(between);
    if (at == std::string_view::npos) {
      pairs = false;
      return;
    }
    const std::string_view left = TrimBlanks(item.substr(0, at));
    const std::string_view right = TrimBlanks(item.substr(at + 1));
    if (count++ == 0 && !ParseNumber(left) && !ParseNumber(right)) {
      if (LowerCase(left) == "i") std::swap(first.name, second.name);
      return;
    }
    AddReading(left, separator != ',', column, &first);
    AddReading(right, separator != ',', column, &second);
  });
  if (!pairs || first.values.empty()) return false;
  fields->lists.push_back(std::move(first));
  fields->lists.push_back(std::move(second));
  return true;
}

}  // namespace lyrefit
