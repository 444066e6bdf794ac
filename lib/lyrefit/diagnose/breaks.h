#pragma once

#include <vector>

#include "lyrefit/model/reading.h"

namespace lyrefit {

// Finds where averages of neighbouring readings must end. `off`: current of each reading minus that
// of a model; `sigma`: noise deviation of each reading, in the same unit.

// Marks readings that are further from the median of their neighbours than noise explains. It marks
// at most a hundred, the furthest first.
void MarkSudden(const std::vector<Reading>& points, const std::vector<double>& off,
                const std::vector<double>& sigma, std::vector<char>* alone);

// Splits groups, each given by its first reading, where `off` jumps within a group. A jump must
// exceed what noise about a straight line explains. At most fifty splits, the most significant
// first.
std::vector<int> CutAtJumps(std::vector<int> first, const std::vector<double>& off,
                            const std::vector<double>& sigma);

}  // namespace lyrefit
