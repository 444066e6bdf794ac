#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/read/curve_index.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/sidecar.h"
#include "lyrefit/read/table_curve.h"

namespace lyrefit {

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
