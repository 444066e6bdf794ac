#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect TemperatureOrCells() {
  Effect e;
  e.id = "temperature_or_cells";
  e.title = "temperature or number of cells not as stated";
  e.where = Where::kConditions;
  e.equation = "n Ns T is one product: n below 1 is impossible";
  e.reference = "sah1957";
  e.sentence =
      "no junction has an ideality below 1: the temperature or the number of cells in series is "
      "not what was stated";
  e.needs = "any curve";
  e.acts = "everywhere near open circuit";
  e.confused_with = {"temp_offset"};
  e.separate_by = "count the cells; a thermometer on the cell";
  e.action = "count the cells, and read the temperature at the back of a cell";
  e.found_by = FoundBy::kValues;
  e.why_not = [](const DataTraits&) -> WhyNot { return {}; };
  return e;
}

}  // namespace lyrefit
