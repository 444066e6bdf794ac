#include "plant/string_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lyrefit/batch/addition.h"

namespace lyrefit {
namespace {

bool HasWildcard(const std::string& text) { return text.find_first_of("*?") != std::string::npos; }

std::size_t LettersOf(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return c != '*' && c != '?'; }));
}

// Whether `text` has the form of `pattern`. Goes back to the last * only, which suffices.
bool Matches(const std::string& pattern, const std::string& text) {
  std::size_t p = 0, t = 0;
  std::size_t star = std::string::npos, begin = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      begin = t;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
      ++p;
      ++t;
    } else if (star != std::string::npos) {
      p = star + 1;
      t = ++begin;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string::npos;
}

}  // namespace

DeviceLayout LayoutOf(const PlannedString& line, DeviceLayout sheet) {
  sheet.modules_in_series = line.modules_in_series;
  if (line.module || !sheet.module_diodes) sheet.module_diodes = line.bypass_diodes;
  if (line.module) sheet.module_cells = line.module->cells_in_series;
  sheet.source = "plan" + (sheet.source.empty() ? "" : " and " + sheet.source);
  return sheet;
}

PlantPlan::PlantPlan(std::vector<PlannedString> lines) : lines_(std::move(lines)) {
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (HasWildcard(lines_[i].id)) {
      patterns_.push_back(i);
    } else {
      by_id_.emplace(lines_[i].id, i);
    }
  }
}

const PlannedString* PlantPlan::Find(const std::string& id) const {
  const auto own = by_id_.find(id);
  if (own != by_id_.end()) return &lines_[own->second];
  const PlannedString* best = nullptr;
  for (std::string above = ParentOf(id); !above.empty() && best == nullptr;
       above = ParentOf(above)) {
    const auto found = by_id_.find(above);
    if (found != by_id_.end()) best = &lines_[found->second];
  }
  for (const std::size_t i : patterns_) {
    const bool more = best == nullptr || LettersOf(lines_[i].id) > LettersOf(best->id);
    if (more && Matches(lines_[i].id, id)) best = &lines_[i];
  }
  return best;
}

std::string PlantPlan::Digest() const {
  std::string all;
  for (const PlannedString& line : lines_) {
    all += fmt::format("{}|{}|{}|{}|", line.id, line.modules_in_series, line.strings_in_parallel,
                       line.bypass_diodes);
    if (!line.module) continue;
    all += fmt::format("{}|{}", line.module->name, line.module->cells_in_series);
    for (const double value : line.module->shared) all += fmt::format("|{}", value);
  }
  std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a
  for (const char c : all) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return fmt::format("{} lines, {:016x}", lines_.size(), hash);
}

}  // namespace lyrefit
