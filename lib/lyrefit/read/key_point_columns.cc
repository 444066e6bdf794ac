#include "lyrefit/read/key_point_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "lyrefit/base/numbers.h"

namespace lyrefit {
namespace {

constexpr const char* kPointLabels[] = {"Isc", "Voc", "Imp", "Vmp"};

// d ln(value) / d ln(light) of a key point over all conditions; NaN: the light hardly varies.
double ExponentOfLight(const std::vector<KeyPointCondition>& conditions, KeyPoint point) {
  constexpr double kLeastRange = 0.3;  // of ln(light)
  double count = 0, x = 0, y = 0, xx = 0, xy = 0;
  double low = kInfinity, high = -kInfinity;
  for (const KeyPointCondition& one : conditions) {
    const auto value = one.points[point];
    if (!value || !(*value > 0) || !(one.irradiance_W_m2 > 0)) continue;
    const double light = std::log(one.irradiance_W_m2), log = std::log(*value);
    low = std::min(low, light);
    high = std::max(high, light);
    count += 1;
    x += light;
    y += log;
    xx += light * light;
    xy += light * log;
  }
  if (!(high - low > kLeastRange)) return kUnknown;
  return (count * xy - x * y) / (count * xx - x * x);
}

// Whether a column of currents holds voltages, or one of voltages currents.
bool HoldsTheOther(const std::vector<KeyPointCondition>& conditions, KeyPoint point) {
  constexpr double kFollows = 0.7, kHardly = 0.3;
  const double exponent = ExponentOfLight(conditions, point);
  return point == kIsc || point == kImp ? exponent < kHardly : exponent > kFollows;
}

// Whether the first key point, which is the smaller one, is above the second in most conditions.
bool IsAbove(const std::vector<KeyPointCondition>& conditions, KeyPoint smaller, KeyPoint larger) {
  int above = 0, both = 0;
  for (const KeyPointCondition& one : conditions) {
    if (!one.points[smaller] || !one.points[larger]) continue;
    ++both;
    above += *one.points[smaller] > *one.points[larger] ? 1 : 0;
  }
  constexpr int kFewest = 2;
  return both >= kFewest && 2 * above > both;
}

std::string Exchanged(KeyPoint a, KeyPoint b, const std::string& why) {
  return fmt::format(
      "{0} and {1} look exchanged: {2}. Exchange the names {0} and {1} of the columns",
      kPointLabels[a], kPointLabels[b], why);
}

std::string ExchangeIn(const std::vector<KeyPointCondition>& conditions) {
  const auto other = [&](KeyPoint point) { return HoldsTheOther(conditions, point); };
  const bool axes = other(kIsc) && other(kVoc), powers = other(kImp) && other(kVmp);
  if (axes && powers) {
    return "currents and voltages look exchanged: the columns of Voc and Vmp follow the light as "
           "currents do, Isc and Imp hardly. Exchange the names Isc and Voc, and Imp and Vmp, of "
           "the "
           "columns";
  }
  if (axes)
    return Exchanged(kIsc, kVoc,
                     "the column of Voc follows the light as a current does, Isc hardly");
  if (powers) {
    return Exchanged(kImp, kVmp,
                     "the column of Vmp follows the light as a current does, Imp hardly");
  }
  const bool currents = IsAbove(conditions, kImp, kIsc), voltages = IsAbove(conditions, kVmp, kVoc);
  if (currents && IsAbove(conditions, kImp, kVmp) && IsAbove(conditions, kIsc, kVmp)) {
    return Exchanged(kImp, kVmp, "the column of Imp lies above Isc");
  }
  if (currents && !voltages)
    return Exchanged(kImp, kIsc, "no device delivers an Imp above its Isc");
  if (voltages && !currents) return Exchanged(kVmp, kVoc, "no device has a Vmp above its Voc");
  return "";
}

}  // namespace

Expected<void> CheckKeyPointColumns(const std::vector<KeyPointCondition>& conditions,
                                    const std::string& path, int line) {
  const std::string exchange = ExchangeIn(conditions);
  return exchange.empty() ? Expected<void>() : Fail(exchange, path, line);
}

std::vector<std::string> ImpossibleConditions(const std::vector<KeyPointCondition>& conditions) {
  std::vector<std::string> sentences;
  for (const KeyPointCondition& one : conditions) {
    for (const auto& [inner, outer, unit] :
         {std::tuple(kImp, kIsc, "A"), std::tuple(kVmp, kVoc, "V")}) {
      const auto a = one.points[inner], b = one.points[outer];
      if (!a || !b || !(*a > *b)) continue;
      sentences.push_back(
          fmt::format("line {}: {} {:.4g} {} is above {} {:.4g} {}, which no device gives: one of "
                      "them is wrong",
                      one.line, kPointLabels[inner], *a, unit, kPointLabels[outer], *b, unit));
    }
  }
  return sentences;
}

bool IsDash(std::string_view text) {
  return !text.empty() && text.find_first_not_of("-\u2013\u2014 ") == std::string_view::npos;
}

}  // namespace lyrefit
