#include "lyrefit/read/bare_curve.h"

#include "lyrefit/curve/sweep_order.h"
#include "lyrefit/read/settle_conditions.h"

namespace lyrefit {

IvCurve BareCurve(IvCurve readings) {
  SettleConditions({}, &readings);
  if (Validate(readings)) TurnLoadSign(&readings);
  return readings;
}

}  // namespace lyrefit
