#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// A curve of a set that could not be read, with the reason.
struct RejectedCurve {
  std::string id;
  Error error;
};

// Curves of one device at different irradiances and temperatures, unless `several_devices`. IvCurve::name is the curve's id,
// unique within the set.
struct CurveSet {
  std::string name;    // "sandia_pvue125"
  std::string source;  // file or folder
  std::vector<IvCurve> curves;
  std::vector<RejectedCurve> rejected;  // curves that could not be read
  std::vector<Assumption> assumptions;  // assumptions shared by all curves
  bool several_devices = false;         // a column of their table tells devices apart
};

// A set of one curve.
CurveSet SetOfOne(IvCurve curve);

}  // namespace lyrefit
