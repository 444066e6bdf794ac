#include "lyrefit/model/variants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/model/curve_shape.h"
#include "lyrefit/model/reporting_units.h"

namespace lyrefit {
namespace {

constexpr double kSame = 1e-9;

bool HasShape(const DeviceEffects& device_effects, const Effect& effect) {
  const DataTraits& traits = device_effects.readings.traits;
  return effect.starts != nullptr && traits.single && !traits.only_dark;
}

std::vector<ParameterBounds> OwnBounds(const DeviceEffects& device_effects, std::size_t use) {
  const int first =
      device_effects.law.Offset(static_cast<int>(use)) - device_effects.law.base_size();
  const auto begin = device_effects.bounds.begin() + first;
  return {begin, begin + device_effects.uses[use].effect->size()};
}

bool SameBounds(const Variant& a, const Variant& b) {
  for (std::size_t k = 0; k < a.bounds.size(); ++k) {
    if (std::fabs(a.bounds[k].lower - b.bounds[k].lower) > kSame) return false;
    if (std::fabs(a.bounds[k].upper - b.bounds[k].upper) > kSame) return false;
  }
  return true;
}

// The variant as requested, of one effect.
Variant AsAsked(const DeviceEffects& device_effects, std::size_t use) {
  Variant variant;
  variant.bounds = OwnBounds(device_effects, use);
  const int first =
      device_effects.law.Offset(static_cast<int>(use)) - device_effects.law.base_size();
  const auto begin = device_effects.usual.begin() + first;
  variant.usual.assign(begin, begin + static_cast<std::ptrdiff_t>(variant.bounds.size()));
  return variant;
}

// The variant of a start from the shape: free are all parameters that fits free by default, and
// those that the start frees.
Variant VariantOf(const Effect& effect, const ShapeStart& start) {
  Variant variant;
  variant.usual = start.p;
  for (int k = 0; k < effect.size(); ++k) {
    const EffectParameter& info = effect.parameters[k];
    const bool freed = std::find(start.freed.begin(), start.freed.end(), k) != start.freed.end();
    const double lower = info.fixed_by_default && !freed ? start.p[k] : info.lower;
    const double upper = info.fixed_by_default && !freed ? start.p[k] : info.upper;
    variant.bounds.push_back({lower, upper, lower, upper, SearchScale::kLinear});
  }
  return variant;
}

std::vector<Variant> OfOneEffect(const DeviceEffects& device_effects, const CurveShape& shape,
                                 std::size_t use) {
  const EffectUse& asked = device_effects.uses[use];
  const Variant as_asked = AsAsked(device_effects, use);
  std::vector<Variant> variants;
  if (asked.ranges.empty() && HasShape(device_effects, *asked.effect)) {
    for (const ShapeStart& start :
         asked.effect->starts(shape, device_effects.readings.traits, as_asked.bounds)) {
      Variant variant = VariantOf(*asked.effect, start);
      for (std::size_t k = 0; k < variant.bounds.size(); ++k) {  // requested whole numbers
        ParameterBounds& own = variant.bounds[k];
        if (own.lower < own.upper && as_asked.bounds[k].whole > 0) own = as_asked.bounds[k];
      }
      const bool known = std::any_of(variants.begin(), variants.end(), [&](const Variant& other) {
        return SameBounds(variant, other);
      });
      if (!known) variants.push_back(std::move(variant));
    }
  }
  if (variants.empty()) variants.push_back(as_asked);
  return variants;
}

// Moves a start inside bounds. Returns false if that changes its meaning: another number of
// substrings, or, in a variant from the shape, another value of a fixed parameter.
bool MoveInside(const Effect& effect, const std::vector<ParameterBounds>& bounds, bool as_asked,
                std::vector<double>* p) {
  constexpr double kTyped = 1e-4;  // shares are typed with few digits
  bool same = true;
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    const ParameterBounds& own = bounds[k];
    const EffectParameter& info = effect.parameters[k];
    const double inside = WithinBounds(own, (*p)[k]);
    const bool counts = info.searched || info.whole != Whole::kNo || !as_asked;
    const bool settled = own.lower == own.upper || own.whole > 0;
    if (settled && counts && std::fabs(inside - (*p)[k]) > kTyped) same = false;
    (*p)[k] = inside;
  }
  return same;
}

// Starts of one effect in this variant; if none fits it, all of them moved into its bounds.
std::vector<std::vector<double>> OwnPlaces(const DeviceEffects& device_effects,
                                           const CurveShape& shape, std::size_t use,
                                           const std::vector<ParameterBounds>& bounds) {
  const EffectUse& asked = device_effects.uses[use];
  std::vector<std::vector<double>> places, others;
  for (const ShapeStart& start : asked.effect->starts(shape, device_effects.readings.traits,
                                                      OwnBounds(device_effects, use))) {
    std::vector<double> own = start.p;
    const bool same = MoveInside(*asked.effect, bounds, !asked.ranges.empty(), &own);
    std::vector<std::vector<double>>& list = same ? places : others;
    if (std::find(list.begin(), list.end(), own) == list.end()) list.push_back(std::move(own));
  }
  return places.empty() ? others : places;
}

}  // namespace

std::vector<Variant> VariantsOf(const DeviceEffects& device_effects) {
  const CurveShape shape = ShapeOf(device_effects.readings);
  std::vector<Variant> variants = {{}};
  for (std::size_t use = 0; use < device_effects.uses.size(); ++use) {
    std::vector<Variant> longer;
    for (const Variant& own : OfOneEffect(device_effects, shape, use)) {
      for (Variant variant : variants) {
        variant.bounds.insert(variant.bounds.end(), own.bounds.begin(), own.bounds.end());
        variant.usual.insert(variant.usual.end(), own.usual.begin(), own.usual.end());
        longer.push_back(std::move(variant));
      }
    }
    variants = std::move(longer);
  }
  for (Variant& variant : variants) {
    for (const ParameterBounds& own : variant.bounds) variant.free += own.lower < own.upper ? 1 : 0;
  }
  return variants;
}

std::vector<std::vector<double>> ShapePlaces(const DeviceEffects& device_effects,
                                             const Variant& variant) {
  const CurveShape shape = ShapeOf(device_effects.readings);
  std::vector<std::vector<double>> places;
  for (std::size_t use = 0; use < device_effects.uses.size(); ++use) {
    const Effect& effect = *device_effects.uses[use].effect;
    if (!HasShape(device_effects, effect)) continue;
    const int first =
        device_effects.law.Offset(static_cast<int>(use)) - device_effects.law.base_size();
    const auto begin = variant.bounds.begin() + first;
    for (const std::vector<double>& own :
         OwnPlaces(device_effects, shape, use, {begin, begin + effect.size()})) {
      std::vector<double> place = variant.usual;
      std::copy(own.begin(), own.end(), place.begin() + first);
      places.push_back(std::move(place));
    }
  }
  return places;
}

void LeaveARest(const DeviceEffects& device_effects, const std::vector<ParameterBounds>& bounds,
                double* p) {
  int first = 0;
  for (const EffectUse& use : device_effects.uses) {
    const Effect& effect = *use.effect;
    std::vector<int> shares;
    for (int k = 0; k < effect.size(); ++k) {
      if (effect.parameters[k].whole == Whole::kSubstrings) shares.push_back(first + k);
    }
    const auto too_much = [&] {
      double sum = 0;
      for (const int k : shares) sum += p[k];
      return sum > 1 - kSame;
    };
    while (too_much()) {
      int largest = -1;
      for (const int k : shares) {
        const bool falls = p[k] > bounds[k].lower + kSame;
        if (falls && (largest < 0 || p[k] > p[largest])) largest = k;
      }
      if (largest < 0) break;
      const ParameterBounds& own = bounds[largest];
      const double less = own.whole > 0 ? p[largest] - own.whole : 0.5 * p[largest];
      p[largest] = std::max(less, own.lower);
    }
    first += effect.size();
  }
}

std::string DescribeVariant(const DeviceEffects& device_effects, const Variant& variant) {
  std::string free, fixed;
  const auto add = [](std::string* list, const std::string& text) {
    *list += (list->empty() ? "" : ", ") + text;
  };
  int at = 0;
  for (const EffectUse& use : device_effects.uses) {
    const Effect& effect = *use.effect;
    const std::string prefix = device_effects.uses.size() > 1 ? std::string(effect.id) + "." : "";
    const std::vector<double> reported =
        ReportedValues(effect, variant.usual.data() + at, device_effects.readings.scale);
    for (int k = 0; k < effect.size(); ++k, ++at) {
      const EffectParameter& info = effect.parameters[k];
      const ParameterBounds& own = variant.bounds[at];
      const std::string symbol = prefix + info.symbol;
      if (own.lower < own.upper) {
        add(&free, symbol);
      } else if (own.lower != info.neutral && own.lower != info.absent_at) {
        add(&fixed, fmt::format("{} = {:.4g}", symbol, reported[k]));
      }
    }
  }
  return free + " free" + (fixed.empty() ? "" : "; " + fixed);
}

namespace {

constexpr int kSteps = 200;

using Points = std::vector<std::pair<double, double>>;  // voltage (rising) and current

// Running median of five currents.
Points Medians(const Points& points) {
  Points smooth = points;
  const int count = static_cast<int>(points.size());
  for (int k = 0; k < count; ++k) {
    const int reach = std::min({2, k, count - 1 - k});
    std::vector<double> around;
    for (int i = k - reach; i <= k + reach; ++i) around.push_back(points[i].second);
    std::nth_element(around.begin(), around.begin() + reach, around.end());
    smooth[k].second = around[reach];
  }
  return smooth;
}

double Interpolate(const Points& points, double voltage) {
  const auto above = std::lower_bound(points.begin(), points.end(), std::pair{voltage, -1e300});
  if (above == points.begin()) return points.front().second;
  if (above == points.end()) return points.back().second;
  const auto below = above - 1;
  const double span = above->first - below->first;
  const double part = span > 0 ? (voltage - below->first) / span : 0;
  return below->second + part * (above->second - below->second);
}

}  // namespace

double CurveShape::At(double part) const {
  if (current.empty()) return 0;
  const double last = static_cast<double>(current.size() - 1);
  const double at = std::clamp(part, 0.0, 1.0) * last;
  const std::size_t below = static_cast<std::size_t>(std::min(at, last - 1));
  return current[below] + (at - static_cast<double>(below)) * (current[below + 1] - current[below]);
}

Stairs StairsOf(const CurveShape& shape) {
  constexpr int kReach = 3;  // steps to either side over which a slope is taken
  constexpr double kTwice = 1.5, kLeast = 0.004;  // contrast of a step and its plateau
  Stairs stairs;
  if (shape.current.empty()) return stairs;
  const auto slope = [&](int k) { return shape.current[k - kReach] - shape.current[k + kReach]; };
  int flattest = kReach, steepest = kReach;
  bool rising = true;  // the slope is about to rise from a plateau to a step
  for (int k = kReach; k <= kSteps - kReach; ++k) {
    if (rising && slope(k) < slope(flattest)) flattest = k;
    if (!rising && slope(k) > slope(steepest)) steepest = k;
    if (rising && slope(k) > kTwice * std::max(slope(flattest), 0.0) + kLeast) {
      stairs.plateaus.push_back({static_cast<double>(flattest) / kSteps, shape.current[flattest]});
      rising = false;
      steepest = k;
    } else if (!rising && kTwice * std::max(slope(k), 0.0) + kLeast < slope(steepest)) {
      stairs.steps.push_back(static_cast<double>(steepest) / kSteps);
      rising = true;
      flattest = k;
    }
  }
  if (!rising) stairs.steps.push_back(static_cast<double>(steepest) / kSteps);
  return stairs;
}

CurveShape ShapeOf(const Readings& readings) {
  CurveShape shape;
  Points points;
  for (const Reading& r : readings.points) {
    if (!r.dark && !r.suns_voc) points.push_back({r.voltage, r.current});
  }
  if (points.size() < 2) return shape;
  std::sort(points.begin(), points.end());
  shape.open_circuit = readings.pivot_voltage;
  const Points smooth = Medians(points);
  for (int k = 0; k <= kSteps; ++k) {
    shape.current.push_back(Interpolate(smooth, shape.open_circuit * k / kSteps));
  }
  return shape;
}

}  // namespace lyrefit
