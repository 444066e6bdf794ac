#pragma once

#include <cstddef>
#include <vector>

namespace lyrefit {

// More marks than these nobody can tell apart, and a picture of them all is many megabytes.
constexpr std::size_t kMostMarks = 2000;

// The places of about `most` points (at least 4) that look like all of them: in equal steps of x
// the lowest and the highest y and two in between, and the first and last point. Rising; all places
// if there are no more points than that. Points that are not finite are left out where there are
// more.
std::vector<std::size_t> MarksToDraw(const std::vector<double>& x, const std::vector<double>& y,
                                     std::size_t most = kMostMarks);

}  // namespace lyrefit
