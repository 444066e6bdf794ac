#pragma once

#include <cstdint>
#include <string>

namespace made {

// A load file: many curves of many modules, some of them broken on purpose.

enum class Shape { kJsonLines, kCsv };

struct CurvesRequest {
  std::int64_t count = 1000;
  int points = 50;
  double broken = 0.01;    // fraction of the rows
  double reversed = 0.01;  // fraction measured from open circuit down, which is valid
  std::uint64_t seed = 1;
  Shape shape = Shape::kJsonLines;
  std::string out;    // file of the rows
  std::string truth;  // file of the altered rows: line,id,how,fate; empty: not written
};

// Writes the rows in order. The same request gives the same bytes, and row i does not depend on
// `count`. In the truth file `line` counts from 1 (the header line of a CSV is line 1), and `fate`
// is the expected result of reading the row:
//   refused  the row gives no curve
//   told     the row gives a curve and needs a remark
//   read     the row is valid
// Returns an error message, empty on success.
std::string WriteCurves(const CurvesRequest& request);

}  // namespace made
