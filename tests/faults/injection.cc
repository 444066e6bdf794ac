#include "faults/injection.h"

#include <algorithm>
#include <cmath>

namespace faults {

const std::vector<Injection>& Injections() {
  static const std::vector<Injection> all = [] {
    std::vector<Injection> injections;
    for (const auto* part : {&DeviceInjections(), &SweepInjections(), &InstrumentInjections(),
                             &ConditionInjections()}) {
      injections.insert(injections.end(), part->begin(), part->end());
    }
    return injections;
  }();
  return all;
}

const Injection* FindInjection(const std::string& name) {
  for (const Injection& injection : Injections()) {
    if (name == injection.name) return &injection;
  }
  return nullptr;
}

bool Shows(const Injection& injection, Kind kind) {
  return std::find(injection.kinds.begin(), injection.kinds.end(), kind) != injection.kinds.end();
}

Shape DrawShape(Random* random) {
  Shape shape;
  for (double& part : shape.parts) part = random->Unit();
  shape.sign = random->Sign();
  return shape;
}

double StrengthFor(const Injection& injection, const Shape& shape, const Scene& scene,
                   double misfit) {
  double low = std::log(injection.low), high = std::log(injection.high);
  const double top = high;
  double x = low + 0.4 * (high - low);
  double x_before = 0, y_before = 0;
  for (int i = 0; i < 24; ++i) {
    Scene with = scene;
    const bool room = injection.apply(shape, std::exp(x), &with);
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

}  // namespace faults
