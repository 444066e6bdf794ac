#pragma once

#include <string>
#include <vector>

#include "lyrefit/batch/batch_source.h"
#include "lyrefit/batch/batch_task.h"
#include "lyrefit/batch/result_row.h"

namespace lyrefit {

// The columns that every row has, whatever was done with its curve, before those of the task: who
// it is, where it stands, under what it was taken, its key points and a sketch.
std::vector<ResultColumn> CommonColumns();

// Their cells. The curve may be broken.
std::vector<ResultCell> CommonCells(const BatchCurve& curve, const BatchItem& item,
                                    RowStatus status, const std::string& reason);

}  // namespace lyrefit
