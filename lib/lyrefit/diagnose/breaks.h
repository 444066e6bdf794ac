#pragma once

#include <vector>

#include "lyrefit/law/reading.h"

namespace lyrefit {

// Where averages of neighbouring readings must end: `off` are the distances of the readings from a
// model, `sigma` their noise.

// Marks readings that are further from the middle of their neighbours than noise goes, at most a
// hundred, the furthest.
void MarkSudden(const std::vector<Reading>& points, const std::vector<double>& off,
                const std::vector<double>& sigma, std::vector<char>* alone);

// Cuts groups, each stated by its first reading, where the distances jump within one: by more than
// noise does beside a straight line. At most fifty cuts, the surest first.
std::vector<int> CutAtJumps(std::vector<int> first, const std::vector<double>& off,
                            const std::vector<double>& sigma);

}  // namespace lyrefit
