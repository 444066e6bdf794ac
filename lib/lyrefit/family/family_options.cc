#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "lyrefit/base/number_text.h"
#include "lyrefit/family/fit_family.h"

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

}  // namespace lyrefit
