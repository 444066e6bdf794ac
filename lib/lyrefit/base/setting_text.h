// Experimental: may change in a minor version (data/stable).
#pragma once

#include <map>
#include <string>
#include <utility>

#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Parse the text of a parameter setting: a value, "n2=2", or a range, "Rs=0:0.5".
Expected<std::pair<std::string, double>> ReadAssignment(const std::string& text);
Expected<std::pair<std::string, std::pair<double, double>>> ReadRange(const std::string& text);

// Format a setting, with six significant digits.
std::string AssignmentText(const std::string& name, double value);
std::string RangeText(const std::string& name, const std::pair<double, double>& range);

// Option for a map whose entries are given one by one, parsed by `Read` and formatted by `Text`:
// see base/option.h.
template <auto Read, auto Text, auto First, auto... Rest>
constexpr auto MapOption() {
  using Options = ClassOf<First>;
  return OptionText<Options>{
      [](const std::string& text, Options* options, const TextReaders&) -> Expected<void> {
        const auto named = Read(text);
        if (!named) return tl::unexpected<Error>(named.error());
        Along<First, Rest...>(*options)[named->first] = named->second;
        return {};
      },
      [](const Options& options) {
        std::vector<std::string> texts;
        for (const auto& [name, value] : Along<First, Rest...>(options)) {
          texts.push_back(Text(name, value));
        }
        return texts;
      },
      nullptr, true};
}

// Option NAME=VALUE, repeated for each entry.
template <auto First, auto... Rest>
constexpr auto AssignmentsOption() {
  return MapOption<ReadAssignment, AssignmentText, First, Rest...>();
}

// Option NAME=LOW:HIGH, repeated for each entry.
template <auto First, auto... Rest>
constexpr auto RangesOption() {
  return MapOption<ReadRange, RangeText, First, Rest...>();
}

}  // namespace lyrefit
