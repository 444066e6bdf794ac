#include "lyrefit/family/family_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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
  bool shared = false;  // by conditions: may be 0, or not stated
  double unit = 0.01;
  const char* unit_text = "%";
  double most = 50;
};
constexpr KeyPointErrorRow kKeyPointErrorRows[] = {
    {"isc", &KeyPointErrors::short_circuit_current},
    {"voc", &KeyPointErrors::open_circuit_voltage},
    {"vmp", &KeyPointErrors::max_power_voltage},
    {"pmp", &KeyPointErrors::max_power},
    {"temperature", &KeyPointErrors::temperature_K, true, 1, "K", 20},
    {"light", &KeyPointErrors::irradiance, true},
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
          fmt::format("key-point-errors: expected isc, voc, vmp, pmp or light and a percentage, as "
                      "in voc=0.3%, or temperature=0.3K, found {}",
                      part));
    }
    std::string value = part.substr(equals + 1);
    if (!value.empty() && value.back() == row->unit_text[0]) value.pop_back();
    const auto number = ParseNumber(value);
    const bool enough = number && (row->shared ? *number >= 0 : *number > 0);
    if (!enough || !(*number <= row->most)) {
      return Fail(fmt::format("key-point-errors: expected {} {} and at most {:g} {}, found {}",
                              name, row->shared ? "of at least 0" : "above 0", row->most,
                              row->unit_text, value));
    }
    errors->*row->part = *number * row->unit;
  }
  return {};
}

std::string KeyPointErrorsText(const KeyPointErrors& errors) {
  std::string text;
  for (const KeyPointErrorRow& row : kKeyPointErrorRows) {
    const double part = errors.*row.part;
    if (std::isnan(part)) continue;
    text += fmt::format("{}{}={:.3g}{}", text.empty() ? "" : ",", row.name, part / row.unit,
                        row.unit_text);
  }
  return text;
}

}  // namespace lyrefit
