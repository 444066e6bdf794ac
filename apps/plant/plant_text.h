#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "plant/plant_summary.h"

namespace lyrefit {

// Words and numbers of a plant's page.

// The summary in sentences: "488 of 500 strings pass. 12 need work: partial shading (5), ... Repair
// would give about 3.2 kW."
std::string PlantVerdict(const PlantSummary& summary);

// By decreasing number of rows.
std::vector<std::pair<std::string, PlantShare>> Ordered(
    const std::map<std::string, PlantShare>& shares);

// The title of a cause, or its name.
std::string Title(const std::pair<std::string, PlantShare>& cause);

// A column's name in words, without its unit: "Pmax_stc_W" as "Pmax at standard conditions".
std::string ColumnInWords(const std::string& column);

// "3.2 kW"; 1234567 as "1,234,567".
std::string Power(double watts);
std::string Counted(std::int64_t count);

// The end of a long name, for an axis.
std::string ShortName(const std::string& name);

}  // namespace lyrefit
