#include "hidden/hide.h"

#include <algorithm>
#include <cmath>

namespace hidden {

const std::vector<Hide>& Hides() {
  static const std::vector<Hide> all = [] {
    std::vector<Hide> hides;
    for (const auto* part :
         {&DeviceHides(), &SweepHides(), &InstrumentHides(), &ConditionHides()}) {
      hides.insert(hides.end(), part->begin(), part->end());
    }
    return hides;
  }();
  return all;
}

const Hide* FindHide(const std::string& name) {
  for (const Hide& hide : Hides()) {
    if (name == hide.name) return &hide;
  }
  return nullptr;
}

bool Shows(const Hide& hide, Kind kind) {
  return std::find(hide.kinds.begin(), hide.kinds.end(), kind) != hide.kinds.end();
}

Shape DrawShape(Random* random) {
  Shape shape;
  for (double& part : shape.parts) part = random->Unit();
  shape.sign = random->Sign();
  return shape;
}

double StrengthFor(const Hide& hide, const Shape& shape, const Scene& scene, double misfit) {
  double low = std::log(hide.low), high = std::log(hide.high);
  const double top = high;
  double x = low + 0.4 * (high - low);
  double x_before = 0, y_before = 0;
  for (int i = 0; i < 24; ++i) {
    Scene with = scene;
    const bool room = hide.apply(shape, std::exp(x), &with);
    const double y = room ? std::log(std::max(Misfit(with), 1e-9)) - std::log(misfit) : 1;
    if (room && std::fabs(y) < 0.02) return std::exp(x);
    if (std::isnan(y) || y > 0)
      high = x;
    else
      low = x;
    if (low >= top - 1e-9 || high - low < 1e-6) return -1;
    const double slope = i > 0 && x != x_before ? (y - y_before) / (x - x_before) : 1;
    double next = room && slope > 0.1 ? x - y / slope : (low + high) / 2;
    if (!(next > low && next < high)) next = next >= top && high == top ? top : (low + high) / 2;
    if (!room) next = (low + high) / 2;
    x_before = x, y_before = y;
    x = next;
  }
  return -1;
}

}  // namespace hidden
