#include "lyrefit/curve/bare_curve.h"

#include "lyrefit/curve/current_sign.h"
#include "lyrefit/curve/settle_conditions.h"

namespace lyrefit {

IvCurve BareCurve(IvCurve readings) {
  SettleConditions({}, &readings);
  if (Validate(readings)) TurnLoadSign(&readings);
  return readings;
}

}  // namespace lyrefit
