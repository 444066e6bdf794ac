#include "lyrefit/simulate/read_string_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/json_text.h"

namespace lyrefit {
namespace {

using nlohmann::json;

constexpr std::uintmax_t kLargestFile = 1U << 20;

struct Range {
  double lower;
  double upper;
};

// A value of the file with its place for error messages: "strings[0][1].cells[0]".
struct Node {
  const json* value;
  std::string place;
  const std::string* path;

  tl::unexpected<Error> Refuse(const std::string& expected) const {
    return Fail(
        (place.empty() ? "" : place + ": ") + "expected " + expected + ", found " + OneLine(*value),
        *path);
  }
  Node At(std::size_t index) const {
    return {&value->at(index), fmt::format("{}[{}]", place, index), path};
  }
  Node At(const char* key) const {
    return {&value->at(key), place.empty() ? key : place + "." + key, path};
  }
  bool Has(const char* key) const { return value->contains(key); }
};

// Error unless the node is an object with no keys but `keys`.
Expected<void> CheckKeys(const Node& node, std::initializer_list<const char*> keys) {
  std::string list;
  for (const char* key : keys) list += (list.empty() ? "" : ", ") + std::string(key);
  if (!node.value->is_object()) return node.Refuse("an object with " + list);
  for (const auto& [key, unused] : node.value->items()) {
    const bool known = std::any_of(keys.begin(), keys.end(), [&k = key](auto c) { return k == c; });
    if (known) continue;
    return Fail(fmt::format("{}: there is no \"{}\", expected {}",
                            node.place.empty() ? "the layout" : node.place, key, list),
                *node.path);
  }
  return {};
}

// Reads a number; leaves `target` unchanged if the key is absent.
Expected<void> ReadNumber(const Node& node, const char* key, const Range& range, double* target) {
  if (!node.Has(key)) return {};
  const Node at = node.At(key);
  const bool number = at.value->is_number();
  if (number) *target = at.value->get<double>();
  if (number && *target >= range.lower && *target <= range.upper) return {};
  return at.Refuse(fmt::format("a number from {:g} to {:g}", range.lower, range.upper));
}

Expected<void> ReadWhole(const Node& node, const char* key, double* target) {
  TRY(ReadNumber(node, key, {1, 10000}, target));
  if (*target == std::floor(*target)) return {};
  return node.At(key).Refuse("a whole number");
}

Expected<void> ReadBypass(const Node& file, StringLayout* layout) {
  if (!file.Has("bypass_diode")) return {};
  const Node node = file.At("bypass_diode");
  TRY(CheckKeys(node, {"voltage_V", "ideality"}));
  TRY(ReadNumber(node, "voltage_V", {0.05, 2}, &layout->bypass_voltage_V));
  return ReadNumber(node, "ideality", {0.05, 3}, &layout->bypass_ideality);
}

Expected<void> ReadReverse(const Node& file, StringLayout* layout) {
  if (!file.Has("reverse")) return {};
  const Node node = file.At("reverse");
  TRY(CheckKeys(node, {"law", "a", "Vbr_V", "A_V", "m"}));
  const json law = node.Has("law") ? *node.At("law").value : json();
  if (law == "shunt") return CheckKeys(node, {"law"});
  if (law != "bishop" && law != "soft") {
    return node.Refuse("\"law\" to be shunt, bishop or soft");
  }
  const bool soft = law == "soft";
  layout->reverse = soft ? ReverseLaw::kSoft : ReverseLaw::kBishop;
  if (soft) layout->reverse_voltage_V = 3.2;
  auto fine =
      soft ? CheckKeys(node, {"law", "A_V", "m"}) : CheckKeys(node, {"law", "a", "Vbr_V", "m"});
  if (!fine) return fine;
  TRY(ReadNumber(node, "a", {0, 100}, &layout->reverse_strength));
  const char* const voltage = soft ? "A_V" : "Vbr_V";
  TRY(ReadNumber(node, voltage, {0.5, 200}, &layout->reverse_voltage_V));
  return ReadNumber(node, "m", {0.5, 10}, &layout->reverse_exponent);
}

bool Alike(const StringLayout::Cells& a, const StringLayout::Cells& b) {
  return a.light == b.light && a.leak_S == b.leak_S;
}

// One part (substring) as in the file: `share` holds the cell count.
struct WrittenSubstring {
  Substring substring;
  std::vector<StringLayout::Cells> groups;
  double times = 1;
};

bool Alike(const WrittenSubstring& a, const WrittenSubstring& b) {
  if (a.substring.bypassed != b.substring.bypassed || a.substring.string != b.substring.string)
    return false;
  if (a.substring.bypassed && a.substring.cells != b.substring.cells) return false;
  if (a.groups.size() != b.groups.size()) return false;
  const double ratio = b.substring.cells / a.substring.cells;
  for (std::size_t k = 0; k < a.groups.size(); ++k) {
    if (!Alike(a.groups[k], b.groups[k])) return false;
    if (std::fabs(a.groups[k].share * ratio - b.groups[k].share) > 1e-9) return false;
  }
  return true;
}

Expected<WrittenSubstring> ReadSubstring(const Node& node, int string) {
  TRY(CheckKeys(node, {"bypass", "times", "cells"}));
  WrittenSubstring written;
  written.substring.string = string;
  if (node.Has("bypass")) {
    if (!node.At("bypass").value->is_boolean()) return node.At("bypass").Refuse("true or false");
    written.substring.bypassed = node.At("bypass").value->get<bool>();
  }
  TRY(ReadWhole(node, "times", &written.times));
  if (!node.Has("cells") || !node.At("cells").value->is_array() ||
      node.At("cells").value->empty()) {
    return node.Refuse("a list \"cells\" of {\"count\", \"light\", \"leak_S\"}");
  }
  written.substring.cells = 0;
  const Node cells = node.At("cells");
  for (std::size_t k = 0; k < cells.value->size(); ++k) {
    const Node at = cells.At(k);
    TRY(CheckKeys(at, {"count", "light", "leak_S"}));
    StringLayout::Cells group;
    for (auto read :
         {ReadWhole(at, "count", &group.share), ReadNumber(at, "light", {0, 2}, &group.light),
          ReadNumber(at, "leak_S", {0, 1000}, &group.leak_S)}) {
      if (!read) return tl::unexpected(read.error());
    }
    written.substring.cells += group.share;
    written.groups.push_back(group);
  }
  return written;
}

// The parts of all strings. Equal parts of a string are merged. `cells`: cells in series of each
// string.
Expected<std::vector<WrittenSubstring>> ReadSubstrings(const Node& strings,
                                                       std::vector<double>* cells) {
  std::vector<WrittenSubstring> substrings;
  for (std::size_t s = 0; s < strings.value->size(); ++s) {
    const Node string = strings.At(s);
    if (!string.value->is_array() || string.value->empty()) {
      return string.Refuse("a list of parts {\"bypass\", \"times\", \"cells\"}");
    }
    double count = 0;
    for (std::size_t k = 0; k < string.value->size(); ++k) {
      TRY(auto substring, ReadSubstring(string.At(k), static_cast<int>(s)));
      count += substring.times * substring.substring.cells;
      const auto same =
          std::find_if(substrings.begin(), substrings.end(),
                       [&](const WrittenSubstring& other) { return Alike(other, substring); });
      if (same == substrings.end()) {
        substrings.push_back(std::move(substring));
      } else {
        same->times += substring.times * substring.substring.cells / same->substring.cells;
      }
    }
    cells->push_back(count);
  }
  return substrings;
}

}  // namespace

Expected<StringLayout> ReadStringLayout(const std::string& path) {
  TRY(const std::string text, ReadTextFile(path, kLargestFile));
  TRY(const json document, ParseJson(text, path));
  const Node file{&document, "", &path};
  StringLayout layout;
  for (auto read : {CheckKeys(file, {"bypass_diode", "reverse", "strings"}),
                    ReadBypass(file, &layout), ReadReverse(file, &layout)}) {
    if (!read) return tl::unexpected(read.error());
  }
  if (!file.Has("strings") || !file.At("strings").value->is_array() ||
      file.At("strings").value->empty()) {
    return Fail("expected a list \"strings\" of lists of parts", path);
  }
  std::vector<double> cells;
  TRY(const auto substrings, ReadSubstrings(file.At("strings"), &cells));
  for (const double count : cells) {
    if (count == cells.front()) continue;
    return Fail(fmt::format("strings: expected as many cells in each, found {:g} and {:g}",
                            cells.front(), count),
                path);
  }
  layout.strings = static_cast<int>(cells.size());
  layout.cells_in_series = static_cast<int>(cells.front());
  for (const WrittenSubstring& written : substrings) {
    for (StringLayout::Cells group : written.groups) {
      group.substring = static_cast<int>(layout.substrings.size());
      group.share *= written.times / (cells.front() * layout.strings);
      layout.groups.push_back(group);
    }
    layout.substrings.push_back(written.substring);
  }
  if (layout.groups.size() == 1) {  // one cell group means "all alike, no bypass diode" (see Cell)
    layout.groups.front().share *= 0.5;
    layout.groups.push_back(layout.groups.front());
  }
  if (layout.groups.size() > kMostGroups) {
    return Fail(fmt::format("strings: expected at most {} kinds of cells that differ in part, "
                            "light or leak, found {}",
                            kMostGroups, layout.groups.size()),
                path);
  }
  return layout;
}

}  // namespace lyrefit
