#pragma once

#include <map>
#include <string>
#include <utility>

#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"

namespace lyrefit {

// What a person writes to set single parameters: "n2=2", or a range of one, "Rs=0:0.5".
Expected<std::pair<std::string, double>> ReadAssignment(const std::string& text);
Expected<std::pair<std::string, std::pair<double, double>>> ReadRange(const std::string& text);

// The same the other way round, to six digits.
std::string AssignmentText(const std::string& name, double value);
std::string RangeText(const std::string& name, const std::pair<double, double>& range);

// A map of values, or of ranges, that is given one by one: see base/option.h.
template <auto First, auto... Rest>
constexpr auto AssignmentsOption() {
  using Options = ClassOf<First>;
  return OptionText<Options>{[](const std::string& text, Options* options) -> Expected<void> {
                               const auto assignment = ReadAssignment(text);
                               if (!assignment) return tl::unexpected<Error>(assignment.error());
                               Along<First, Rest...>(*options)[assignment->first] =
                                   assignment->second;
                               return {};
                             },
                             [](const Options& options) {
                               std::vector<std::string> texts;
                               for (const auto& [name, value] : Along<First, Rest...>(options)) {
                                 texts.push_back(AssignmentText(name, value));
                               }
                               return texts;
                             },
                             nullptr, true};
}

template <auto First, auto... Rest>
constexpr auto RangesOption() {
  using Options = ClassOf<First>;
  return OptionText<Options>{[](const std::string& text, Options* options) -> Expected<void> {
                               const auto range = ReadRange(text);
                               if (!range) return tl::unexpected<Error>(range.error());
                               Along<First, Rest...>(*options)[range->first] = range->second;
                               return {};
                             },
                             [](const Options& options) {
                               std::vector<std::string> texts;
                               for (const auto& [name, range] : Along<First, Rest...>(options)) {
                                 texts.push_back(RangeText(name, range));
                               }
                               return texts;
                             },
                             nullptr, true};
}

}  // namespace lyrefit
