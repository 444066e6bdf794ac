#include "lyrefit/family/family_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "lyrefit/base/number_text.h"

namespace lyrefit {

Expected<void> ReadIrradianceAccuracy(const std::string& text, FamilyOptions* options,
                                      const TextReaders&) {
  constexpr double kWorst_percent = 50;
  const bool sign = !text.empty() && text.back() == '%';
  const std::optional<double> percent = ParseNumber(sign ? text.substr(0, text.size() - 1) : text);
  if (!percent || !(*percent >= 0 && *percent <= kWorst_percent)) {
    return Fail(fmt::format("expected percent from 0 to {}, such as 2 or 2%, found '{}'",
                            kWorst_percent, text));
  }
  options->irradiance_accuracy = *percent / 100;
  return {};
}

Expected<void> ReadLeaveOut(const std::string& text, FamilyOptions* options, const TextReaders&) {
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    if (end > begin) options->leave_out.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return {};
}

namespace {

struct KeyPointErrorRow {
  const char* name;
  double KeyPointErrors::*part;
};
constexpr KeyPointErrorRow kKeyPointErrorRows[] = {
    {"isc", &KeyPointErrors::short_circuit_current},
    {"voc", &KeyPointErrors::open_circuit_voltage},
    {"vmp", &KeyPointErrors::max_power_voltage},
    {"pmp", &KeyPointErrors::max_power},
};

}  // namespace

Expected<void> ReadKeyPointErrors(const std::string& text, KeyPointErrors* errors) {
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::size_t equals = part.find('=');
    const std::string name = part.substr(0, equals);
    const auto* const row =
        std::find_if(std::begin(kKeyPointErrorRows), std::end(kKeyPointErrorRows),
                     [&](const KeyPointErrorRow& known) { return name == known.name; });
    if (equals == std::string::npos || row == std::end(kKeyPointErrorRows)) {
      return Fail(
          fmt::format("key-point-errors: expected isc, voc, vmp or pmp and a percentage, as in "
                      "voc=0.3%, found {}",
                      part));
    }
    std::string value = part.substr(equals + 1);
    if (!value.empty() && value.back() == '%') value.pop_back();
    const auto percent = ParseNumber(value);
    if (!percent || !(*percent > 0) || !(*percent <= 50)) {
      return Fail(fmt::format("key-point-errors: expected {} above 0 and at most 50 %, found {}",
                              name, value));
    }
    errors->*row->part = *percent / 100;
  }
  return {};
}

std::string KeyPointErrorsText(const KeyPointErrors& errors) {
  std::string text;
  for (const KeyPointErrorRow& row : kKeyPointErrorRows) {
    text += fmt::format("{}{}={:g}%", text.empty() ? "" : ",", row.name, 100 * errors.*row.part);
  }
  return text;
}

}  // namespace lyrefit
