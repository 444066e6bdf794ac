#include "bounds_flag.h"

#include "lyrefit/settings/bounds_file.h"

namespace lyrefit {

Expected<BoundsSpec> FlaggedBounds(const std::string& name, const std::string& curve_file) {
  Expected<BoundsSpec> spec = NamedBounds(name, curve_file);
  if (spec || !spec.error().file.empty()) return spec;
  return Fail("--" + spec.error().message);
}

void AddBoundsFlag(VerbLine* verb, const std::string& group, std::string* name) {
  AddBoundsFlag(verb, group, "physical", name);
}

void AddBoundsFlag(VerbLine* verb, const std::string& group, const std::string& by_default,
                   std::string* name) {
  verb->AddOption("--bounds", name,
                  "physical (derived from the curve), wide, table1 (formerly paper) or literature "
                  "(published with the curve), or a JSON file (default " +
                      by_default + ")")
      .Type("NAME|FILE")
      .Group(group)
      .Reads();
}

}  // namespace lyrefit
