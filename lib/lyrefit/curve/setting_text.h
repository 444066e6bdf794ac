#pragma once

#include <map>
#include <string>
#include <utility>

#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// What a person writes to set single parameters: "n2=2", or a range of one, "Rs=0:0.5".
Expected<std::pair<std::string, double>> ReadAssignment(const std::string& text);
Expected<std::pair<std::string, std::pair<double, double>>> ReadRange(const std::string& text);

// The same the other way round, to six digits.
std::string AssignmentText(const std::string& name, double value);
std::string RangeText(const std::string& name, const std::pair<double, double>& range);

// A map that is given one by one, of values or of ranges, as `Read` reads them and `Text` writes
// them: see base/option.h.
template <auto Read, auto Text, auto First, auto... Rest>
constexpr auto MapOption() {
  using Options = ClassOf<First>;
  return OptionText<Options>{[](const std::string& text, Options* options) -> Expected<void> {
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

// NAME=VALUE, once for each.
template <auto First, auto... Rest>
constexpr auto AssignmentsOption() {
  return MapOption<ReadAssignment, AssignmentText, First, Rest...>();
}

// NAME=LOW:HIGH, once for each.
template <auto First, auto... Rest>
constexpr auto RangesOption() {
  return MapOption<ReadRange, RangeText, First, Rest...>();
}

}  // namespace lyrefit
