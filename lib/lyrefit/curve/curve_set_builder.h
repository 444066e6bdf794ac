#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_index.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/read_curve.h"
#include "lyrefit/curve/sidecar.h"
#include "lyrefit/curve/table_curve.h"

namespace lyrefit {

// Collects the curves of a set and settles under what each was taken.
class CurveSetBuilder {
 public:
  CurveSetBuilder(std::string name, std::string source, const ReadOptions& options);

  // The sidecar and the index of the whole set; files that are not there say nothing.
  Expected<void> ReadCommon(const std::string& path, SidecarOf of);
  Expected<void> ReadIndex(const std::string& path, IndexIds ids);

  // What the head of a table of the whole set states; the sidecar goes before it.
  void TakeHead(const Sidecar& head);

  // Every row of the index has to have its curve among `ids`.
  Expected<void> CheckIndex(const std::set<std::string>& ids) const;

  // Takes a curve named by its id that begins in `line` of its file (0: not tied to one). What a
  // column says goes before what is stated for the curve; then comes the index, then what is
  // common.
  void Add(RawCurve raw, int line);

  // Takes a curve whose reader has settled everything.
  void AddSettled(IvCurve curve);

  void Reject(std::string id, Error error);

  // What holds for every curve.
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
