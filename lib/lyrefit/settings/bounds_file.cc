#include "lyrefit/settings/bounds_file.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "lyrefit/base/file.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/json_text.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

Expected<BoundsSpec> PublishedBounds(const std::string& name, const std::string& curve_file) {
  std::error_code error;
  const fs::path curve(curve_file);
  const fs::path folder = fs::is_directory(curve, error) ? curve : curve.parent_path();
  const std::string stem = name == "table1" ? "paper" : name;  // its former name, which files have
  const fs::path file = folder / ("bounds-" + stem + ".json");
  if (!fs::exists(file, error)) {
    // Readings from standard input or from memory have no file.
    const bool in_file = !curve_file.empty() && curve_file != "-";
    if (in_file && !fs::exists(curve, error)) return Fail("the file does not exist", curve_file);
    std::string others;
    if (fs::exists(folder / "bounds-paper.json", error)) others += "table1, ";
    if (fs::exists(folder / "bounds-literature.json", error)) others += "literature, ";
    return Fail(
        fmt::format("bounds {}: there is no {} beside the curve; there are {}physical and wide",
                    name, file.string(), others));
  }
  TRY(BoundsSpec spec, ReadBoundsFile(file.string()));
  spec.name = name;
  return spec;
}

}  // namespace

Expected<BoundsSpec> ReadBoundsFile(const std::string& path) {
  constexpr std::uintmax_t kLargestFile = 1U << 20;
  TRY(const auto text, ReadTextFile(path, kLargestFile));
  const auto json = ParseJson(text, path);
  if (!json) return tl::unexpected(json.error());
  if (!json->is_object() || json->empty()) {
    return Fail(R"(expected bounds as an object like {"Iph":[0,2],"n":[1,2]})", path, 1, 1);
  }
  BoundsSpec spec;
  spec.name = path;
  const JsonFields fields(*json, text, path);
  for (const auto& [key, value] : json->items()) {
    if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number() ||
        !(std::fabs(value[0].get<double>()) < kOverflowCode) ||
        !(std::fabs(value[1].get<double>()) < kOverflowCode)) {
      return fields.Refuse(key, "[lower, upper], two numbers,");
    }
    spec.table[key] = {value[0].get<double>(), value[1].get<double>()};
  }
  if (auto checked = CheckBoundsTable(spec.table); !checked) {
    return Fail(checked.error().message, path);
  }
  return spec;
}

Expected<BoundsSpec> NamedBounds(const std::string& name, const std::string& curve_file) {
  if (name == "physical" || name == "wide") {
    BoundsSpec spec;
    spec.name = name;
    return spec;
  }
  for (const char* published : {"table1", "paper", "literature"}) {
    if (name == published) return PublishedBounds(name, curve_file);
  }
  std::error_code error;
  if (!fs::exists(name, error)) {
    return Fail(
        fmt::format("bounds: expected physical, wide, table1, literature or a JSON file, but "
                    "there is no file '{}'",
                    name));
  }
  return ReadBoundsFile(name);
}

}  // namespace lyrefit
