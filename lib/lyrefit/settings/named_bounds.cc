#include <fmt/format.h>

#include <filesystem>

#include "lyrefit/base/try.h"
#include "lyrefit/estimate/fit/bounds.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

Expected<BoundsSpec> PublishedBounds(const std::string& name, const std::string& curve_file) {
  std::error_code error;
  const fs::path curve(curve_file);
  const fs::path folder = fs::is_directory(curve, error) ? curve : curve.parent_path();
  const fs::path file = folder / ("bounds-" + name + ".json");
  if (!fs::exists(file, error)) {
    // Readings from standard input or from memory have no file.
    const bool in_file = !curve_file.empty() && curve_file != "-";
    if (in_file && !fs::exists(curve, error)) return Fail("the file does not exist", curve_file);
    std::string others;
    for (const char* other : {"paper", "literature"}) {
      if (!fs::exists(folder / fmt::format("bounds-{}.json", other), error)) continue;
      others += fmt::format("{}, ", other);
    }
    return Fail(
        fmt::format("bounds {}: there is no {} beside the curve; there are {}physical and wide",
                    name, file.string(), others));
  }
  TRY(BoundsSpec spec, ReadBoundsFile(file.string()));
  spec.name = name;
  return spec;
}

}  // namespace

Expected<BoundsSpec> NamedBounds(const std::string& name, const std::string& curve_file) {
  if (name == "physical" || name == "wide") {
    BoundsSpec spec;
    spec.name = name;
    return spec;
  }
  if (name == "paper" || name == "literature") return PublishedBounds(name, curve_file);
  std::error_code error;
  if (!fs::exists(name, error)) {
    return Fail(
        fmt::format("bounds: expected physical, wide, paper, literature or a JSON file, but "
                    "there is no file '{}'",
                    name));
  }
  return ReadBoundsFile(name);
}

}  // namespace lyrefit
