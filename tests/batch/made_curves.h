#pragma once

#include <cstdint>
#include <string>

namespace made {

// A load: many curves of many modules in a file, some of them broken on purpose.

enum class Shape { kJsonLines, kCsv };

struct CurvesRequest {
  std::int64_t count = 1000;
  int points = 50;
  double broken = 0.01;    // share of the rows
  double reversed = 0.01;  // share that runs from the open circuit down, which breaks nothing
  std::uint64_t seed = 1;
  Shape shape = Shape::kJsonLines;
  std::string out;    // the rows
  std::string truth;  // what was done to which: line,id,how,fate; empty: not written
};

// Writes the rows in order; the same request gives the same bytes, and row i does not depend on
// `count`. In the truth, `line` counts from 1 (the head line of a CSV is line 1), and `fate` is what
// a reader ought to make of the row:
//   refused  no curve can come of it
//   told     a curve stands there, but something about the row has to be said
//   read     as any other
// Returns what went wrong, empty if nothing did.
std::string WriteCurves(const CurvesRequest& request);

}  // namespace made
