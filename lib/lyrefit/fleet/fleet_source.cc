#include "lyrefit/fleet/fleet_source.h"

namespace lyrefit {

Expected<std::unique_ptr<FleetSource>> OpenFleet(const std::vector<std::string>& inputs,
                                                 const FleetReadOptions&) {
  if (inputs.empty()) return Fail("no input");
  return Fail("this shape of input is not known", inputs.front());
}

}  // namespace lyrefit
