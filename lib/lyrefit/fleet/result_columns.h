#pragma once

#include <string>
#include <vector>

#include "lyrefit/fleet/fleet_source.h"
#include "lyrefit/fleet/fleet_task.h"
#include "lyrefit/fleet/result_row.h"

namespace lyrefit {

// The columns that every row has, whatever was done with its curve, before those of the task: who
// it is, where it stands, under what it was taken, its key points and a sketch.
std::vector<ResultColumn> CommonColumns();

// Their cells. The curve may be broken.
std::vector<ResultCell> CommonCells(const FleetCurve& curve, const FleetItem& item,
                                    RowStatus status, const std::string& reason);

}  // namespace lyrefit
