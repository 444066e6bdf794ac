#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/sidecar.h"
#include "lyrefit/read/table_curve.h"

namespace lyrefit {

// One row of the index of a set; unset values belong to empty fields.
struct IndexRow {
  std::optional<double> irradiance_W_m2;
  std::optional<double> temperature_C;
  std::string date;  // as written; empty: none
  Error missing;     // the error to report if the set has no such curve
};

struct CurveIndex {
  std::map<std::string, IndexRow> rows;  // by curve id
  bool states_irradiance = false;        // the index has an irradiance column
  bool states_temperature = false;
  std::vector<Assumption> assumptions;
};

enum class IndexIds {
  kNumbers,  // numbers in a table's curve column; "07" is 7
  kFiles     // names of tables, with or without extension
};

// Reads a table with one row for each curve. The column `curve`, `sweep` or `file` holds the id. Of
// several temperatures, that of the cell is preferred to that of the module. Air temperatures and
// irradiances of other planes are ignored. A column `timestamp`, `date`, `datetime` or `time` is the
// date of the measurement.
Expected<CurveIndex> ReadCurveIndex(const std::string& path, IndexIds ids,
                                    const ReadOptions& options);

// Collects the curves of a set and determines their conditions.
class CurveSetBuilder {
 public:
  CurveSetBuilder(std::string name, std::string source, const ReadOptions& options);

  // Reads the sidecar and the index of the whole set. A missing file adds nothing.
  Expected<void> ReadCommon(const std::string& path, SidecarOf of);
  Expected<void> ReadIndex(const std::string& path, IndexIds ids);

  // Adds the conditions in the head of a table of the whole set. The sidecar has priority.
  void TakeHead(const Sidecar& head);

  // Checks that the curve of every index row is among `ids`.
  Expected<void> CheckIndex(const std::set<std::string>& ids) const;

  // Adds a curve whose name is its id and whose first row is in `line` of its file (0: no line).
  // Priority of conditions: column, statement for this curve, index, common statement. A curve that
  // fails its checks is rejected.
  void Add(RawCurve raw, int line);

  // Adds a curve whose conditions are already determined.
  void AddSettled(IvCurve curve);

  void Reject(std::string id, Error error);

  // Adds assumptions shared by all curves.
  void Assume(const std::vector<Assumption>& assumptions);

  Expected<CurveSet> Finish();

 private:
  void ApplyIndex(const Sidecar& own, Sidecar* stated, IvCurve* curve) const;

  const ReadOptions& options_;
  CurveSet set_;
  Sidecar common_;
  std::optional<CurveIndex> index_;
};

}  // namespace lyrefit
