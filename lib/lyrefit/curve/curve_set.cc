#include "lyrefit/curve/curve_set.h"

#include <utility>

namespace lyrefit {

CurveSet SetOfOne(IvCurve curve) {
  CurveSet set;
  set.name = curve.name;
  set.source = curve.source;
  set.curves.push_back(std::move(curve));
  return set;
}

}  // namespace lyrefit
