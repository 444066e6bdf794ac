#include "lyrefit/settings/error_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/json_text.h"

namespace lyrefit {

Expected<ErrorSpec> ReadErrorFile(const std::string& path) {
  constexpr std::uintmax_t kLargestFile = 1U << 16;
  TRY(const auto text, ReadTextFile(path, kLargestFile));
  const auto json = ParseJson(text, path);
  if (!json) return tl::unexpected(json.error());
  constexpr char kLike[] =
      R"({"current_noise_A": 0.001, "voltage_noise_V": 0.01, "path_of_isc": 0.0012})";
  if (!json->is_object()) {
    return Fail(fmt::format("expected sizes of errors as an object like {}", kLike), path, 1, 1);
  }
  const JsonFields fields(*json, text, path);
  constexpr char kLength[] = "path_length_of_voc";
  ErrorSpec spec{ErrorKind::kStated, {}, path};
  const std::pair<const char*, double ErrorSizes::*> keys[] = {
      {"current_noise_A", &ErrorSizes::current_A},
      {"voltage_noise_V", &ErrorSizes::voltage_V},
      {"path_of_isc", &ErrorSizes::path}};
  for (const auto& [key, size] : keys) {
    const auto number = fields.Number({key});
    if (!number) return tl::unexpected(number.error());
    if (!*number) {
      return Fail(fmt::format("expected \"{}\", as in {}, found no such key", key, kLike), path, 1,
                  1);
    }
    if (!(**number >= 0) || !std::isfinite(**number))
      return fields.Refuse(key, "a number from 0 up");
    spec.sizes.*size = **number;
  }
  const auto length = fields.Number({kLength});
  if (!length) return tl::unexpected(length.error());
  if (*length && !(**length > 0 && std::isfinite(**length))) {
    return fields.Refuse(kLength, "a number above 0");
  }
  if (*length) spec.sizes.length = **length;
  for (const auto& [key, value] : json->items()) {
    const bool known = std::any_of(std::begin(keys), std::end(keys),
                                   [&name = key](const auto& one) { return name == one.first; });
    if (!known && key != kLength) {
      return fields.Refuse(key,
                           "current_noise_A, voltage_noise_V, path_of_isc or path_length_of_voc");
    }
  }
  if (!(spec.sizes.current_A + spec.sizes.path > 0)) {
    return fields.Refuse("current_noise_A", "a size above 0, here or in \"path_of_isc\"");
  }
  return spec;
}

Expected<ErrorSpec> ErrorsNamed(const std::string& name) {
  if (name == "white") return ErrorSpec();
  if (name == "field") return ErrorSpec{ErrorKind::kField, {}, name};
  return ReadErrorFile(name);
}

}  // namespace lyrefit
