#include "bounds_flag.h"

#include <fmt/format.h>

#include <filesystem>

#include "flags.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

Expected<BoundsSpec> PublishedBounds(const std::string& name, const std::string& curve_file) {
  std::error_code error;
  const fs::path curve(curve_file);
  const fs::path folder = fs::is_directory(curve, error) ? curve : curve.parent_path();
  const fs::path file = folder / ("bounds-" + name + ".json");
  if (!fs::exists(file, error)) {
    std::string others;
    for (const char* other : {"paper", "literature"}) {
      if (!fs::exists(folder / fmt::format("bounds-{}.json", other), error)) continue;
      others += fmt::format("{}, ", other);
    }
    return Fail(
        fmt::format("--bounds {}: there is no {} beside the curve; there are {}physical and wide",
                    name, file.string(), others));
  }
  Expected<BoundsSpec> spec = ReadBoundsFile(file.string());
  if (spec) spec->name = name;
  return spec;
}

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
        fmt::format("--bounds: expected physical, wide, paper, literature or a JSON file, but "
                    "there is no file '{}'",
                    name));
  }
  return ReadBoundsFile(name);
}

}  // namespace

void AddBoundsFlags(Verb* verb, const std::string& group, BoundsFlags* flags) {
  verb->AddOption(
          "--bounds", &flags->name,
          "physical (derived from the curve), wide, paper or literature (published with the "
          "curve), or a JSON file (default physical)")
      .Type("NAME|FILE")
      .Group(group)
      .Reads();
  AddListFlag(verb, "--bound", "range of one parameter, Rs=0:0.5; once for each", &flags->ranges)
      .Type("P=LOWER:UPPER")
      .Group(group);
}

Expected<BoundsSpec> BoundsFromFlags(const BoundsFlags& flags, const std::string& curve_file) {
  Expected<BoundsSpec> spec = NamedBounds(flags.name, curve_file);
  if (!spec) return spec;
  for (const std::string& text : flags.ranges) {
    const auto range = ParseRange("--bound", text);
    if (!range) return tl::unexpected(range.error());
    spec->overrides[range->first] = range->second;
  }
  return spec;
}

}  // namespace lyrefit
