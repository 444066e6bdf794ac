#include "lyrefit/translate/procedure_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

constexpr double kOffLight = 0.02;  // relative to the target's irradiance
constexpr double kOff_K = 1;
constexpr double kFarthest = 1;  // beyond either curve, in parts of the distance between them

// A curve with its conditions.
struct Placed {
  CurvePoints points;
  double g = 0;
  double t_C = 0;
  std::optional<SingleDiodeFit> diode;
};

// The voltage at a current. Currents fall along the points except for noise.
double VoltageAt(const CurvePoints& points, double current_A) {
  const std::size_t n = points.current_A.size();
  for (std::size_t i = n - 1; i > 0; --i) {
    const double a = points.current_A[i - 1], b = points.current_A[i];
    if (!(a >= current_A && b < current_A)) continue;
    const double part = (a - current_A) / (a - b);
    return points.voltage_V[i - 1] + part * (points.voltage_V[i] - points.voltage_V[i - 1]);
  }
  return kUnknown;
}

// The curve at a fraction `a` of the way from `one` to `two`.
Expected<Placed> Along(const Placed& one, const Placed& two, double a) {
  if (!one.diode || !two.diode) return Fail("no single diode fits one of the curves");
  const auto isc = [](const Placed& at) {
    return FindKeyPoints(at.points.voltage_V, at.points.current_A).short_circuit_current_A;
  };
  const double step = isc(two) - isc(one);
  if (!std::isfinite(step)) return Fail("one of the curves does not come to short circuit");
  const double largest = std::max(isc(one), isc(two));
  const double lowest_A = -std::fabs(step) * (1 + std::fabs(a)) - 0.02 * largest;
  const double lowest_V = -0.3 * one.points.voltage_V.back();
  const CurvePoints first = Completed(one.points, *one.diode, lowest_V, lowest_A);
  const CurvePoints second =
      Completed(two.points, *two.diode, 3 * lowest_V, lowest_A - std::fabs(step));
  Placed between;
  between.g = one.g + a * (two.g - one.g);
  between.t_C = one.t_C + a * (two.t_C - one.t_C);
  for (std::size_t i = 0; i < first.voltage_V.size(); ++i) {
    const double v2 = VoltageAt(second, first.current_A[i] + step);
    if (!std::isfinite(v2)) continue;
    between.points.voltage_V.push_back(first.voltage_V[i] + a * (v2 - first.voltage_V[i]));
    between.points.current_A.push_back(first.current_A[i] + a * step);
  }
  between.points = ByVoltage(std::move(between.points));
  between.diode = one.diode;  // extends the points of `one`
  return between;
}

// Irradiance and temperature on one scale: 1 is the target's irradiance, or 100 K.
struct Place {
  double light = 0;
  double heat = 0;
};
Place operator-(const Place& a, const Place& b) { return {a.light - b.light, a.heat - b.heat}; }
double Cross(const Place& a, const Place& b) { return a.light * b.heat - a.heat * b.light; }
double Dot(const Place& a, const Place& b) { return a.light * b.light + a.heat * b.heat; }

struct Steps {
  double first = kUnknown;   // from the second curve to the third
  double second = kUnknown;  // from the first curve on
};

bool TooFar(double a) { return !(a >= -kFarthest && a <= 1 + kFarthest); }

class Way {
 public:
  Way(const PreparedCurve& curve, const TranslationInputs& inputs)
      : target_(curve.target), here_(At(EquivalentIrradiance(inputs), inputs.temperature_C)) {
    for (const FurtherCurve& further : curve.further) {
      there_.push_back(At(further.irradiance_W_m2, further.temperature_C));
    }
  }

  Expected<Steps> Find() const {
    if (there_.empty()) return Fail("it needs a second curve of the same device");
    const Place goal = At(target_.irradiance_W_m2, target_.temperature_C) - here_;
    if (there_.size() == 1) return OnLine(goal);
    const Place side = there_[1] - there_[0], to = there_[0] - here_;
    const double across = Cross(goal, side);
    if (std::fabs(across) < 1e-12) return Fail("the curves lie in line, the target does not");
    Steps steps;
    const double reach = Cross(to, side) / across;  // goal times this is on the line of 2 and 3
    steps.second = 1 / reach;
    steps.first = Cross(to, goal) / across;
    if (TooFar(steps.first) || TooFar(steps.second)) {
      return Fail("the target lies further beyond the curves than they are apart");
    }
    return steps;
  }

 private:
  Place At(double g, double t_C) const { return {g / target_.irradiance_W_m2, t_C / 100}; }

  Expected<Steps> OnLine(const Place& goal) const {
    const Place line = there_[0] - here_;
    if (!(Dot(line, line) > 1e-8)) return Fail("the second curve was taken under the same light");
    Steps steps;
    steps.second = Dot(goal, line) / Dot(line, line);
    const double light = std::fabs(goal.light - steps.second * line.light);
    const double heat_K = 100 * std::fabs(goal.heat - steps.second * line.heat);
    if (light > kOffLight || heat_K > kOff_K) {
      return Fail(
          fmt::format("the target lies {:.0f} W/m2 and {:.1f} K off the line of the two "
                      "curves: a third one would reach it",
                      light * target_.irradiance_W_m2, heat_K));
    }
    if (TooFar(steps.second)) {
      return Fail("the target lies further beyond the two curves than they are apart");
    }
    return steps;
  }

  TranslationTarget target_;
  Place here_;
  std::vector<Place> there_;
};

Placed PlacedOf(const FurtherCurve& curve, const TranslationInputs& inputs) {
  Placed at{
      ByVoltage(TruePoints(curve.points, inputs)), curve.irradiance_W_m2, curve.temperature_C, {}};
  if (curve.diode) at.diode = TrueDiode(*curve.diode, inputs);
  return at;
}

}  // namespace

Expected<CurvePoints> BetweenCurves(const PreparedCurve& curve, const TranslationInputs& inputs) {
  TRY(const Steps steps, Way(curve, inputs).Find());
  Placed one{ByVoltage(TruePoints(curve.points, inputs)),
             EquivalentIrradiance(inputs),
             inputs.temperature_C,
             {}};
  if (curve.diode) one.diode = TrueDiode(*curve.diode, inputs);
  Placed two = PlacedOf(curve.further.front(), inputs);
  if (curve.further.size() > 1) {
    TRY(two, Along(two, PlacedOf(curve.further[1], inputs), steps.first));
  }
  TRY(const Placed end, Along(one, two, steps.second));
  return end.points;
}

double PlaceBetween(const PreparedCurve& curve, const TranslationInputs& inputs) {
  const auto steps = Way(curve, inputs).Find();
  if (!steps) return kUnknown;
  return curve.further.size() > 1 ? std::max(steps->first, steps->second) : steps->second;
}

}  // namespace lyrefit
