#pragma once

#include <string>
#include <vector>

#include "lyrefit/batch/batch_task.h"
#include "lyrefit/batch/result_row.h"
#include "lyrefit/stream/batch_source.h"

namespace lyrefit {

// The columns of every row, for any task, before those of the task: id, location, conditions, key
// points and a sparkline.
std::vector<ResultColumn> CommonColumns();

// The cells of CommonColumns() for one curve, which may be broken, with the status, reason and key
// points of `result`.
std::vector<ResultCell> CommonCells(const BatchCurve& curve, const BatchItem& item,
                                    const TaskResult& result);

}  // namespace lyrefit
