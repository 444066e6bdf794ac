#include "lyrefit/curve/sweep_order.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lyrefit {
namespace {

constexpr std::vector<double> IvCurve::*kColumns[] = {&IvCurve::voltage_V, &IvCurve::current_A,
                                                      &IvCurve::sigma_A, &IvCurve::irradiance_W_m2,
                                                      &IvCurve::temperature_C};

template <class T>
void Permute(const std::vector<std::size_t>& order, std::vector<T>* values) {
  if (values->size() != order.size()) return;
  std::vector<T> sorted;
  sorted.reserve(order.size());
  for (const std::size_t k : order) sorted.push_back((*values)[k]);
  *values = std::move(sorted);
}

void SortByVoltage(IvCurve* curve) {
  std::vector<std::size_t> order(curve->size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return curve->voltage_V[a] < curve->voltage_V[b];
  });
  curve->time_s.clear();
  curve->sweep.clear();
  Permute(order, &curve->voltage_V);
  Permute(order, &curve->current_A);
  Permute(order, &curve->sigma_A);
  Permute(order, &curve->irradiance_W_m2);
  Permute(order, &curve->temperature_C);
}

}  // namespace

CurveSet InOrder(const CurveSet& set, std::vector<std::string>* warnings) {
  constexpr std::size_t kShortest = 6;  // readings of a sweep, on the average
  CurveSet ordered = set;
  for (IvCurve& curve : ordered.curves) {
    const std::size_t sweeps = FindTurns(curve.voltage_V).size();
    if (sweeps < 3 || curve.size() >= kShortest * sweeps) continue;
    SortByVoltage(&curve);
    warnings->push_back(curve.name +
                        ": the readings are in no order of voltage; taken as one sweep from the "
                        "lowest to the highest, so what happened in time cannot be seen");
  }
  return ordered;
}

bool Rises(const std::vector<double>& voltage_V) {
  return !voltage_V.empty() && voltage_V.back() > voltage_V.front();
}

void Reverse(IvCurve* curve) {
  curve->time_s.clear();
  for (const auto column : kColumns) {
    std::reverse((curve->*column).begin(), (curve->*column).end());
  }
  std::reverse(curve->sweep.begin(), curve->sweep.end());
}

void AppendSweep(const IvCurve& next, IvCurve* curve) {
  const std::size_t before = curve->size();
  curve->time_s.clear();
  if (curve->sweep.empty()) curve->sweep.assign(before, 1);
  const int sweeps = curve->sweep.back() - curve->sweep.front() + 1;
  for (StatedResult one : next.stated) {
    one.sweep += sweeps;
    curve->stated.push_back(std::move(one));
  }
  curve->sweep.insert(curve->sweep.end(), next.size(), curve->sweep.back() + 1);
  for (const auto column : kColumns) {
    std::vector<double>& values = curve->*column;
    const std::vector<double>& more = next.*column;
    if (values.size() == before && more.size() == next.size()) {
      values.insert(values.end(), more.begin(), more.end());
    } else {
      values.clear();
    }
  }
}

std::vector<int> FindTurns(const std::vector<double>& voltage) {
  const auto [low, high] = std::minmax_element(voltage.begin(), voltage.end());
  const double jitter = 0.2 * (*high - *low);
  std::vector<int> turns = {0};
  int direction = 0;
  std::size_t extreme = 0;
  for (std::size_t k = 1; k < voltage.size(); ++k) {
    const double move = voltage[k] - voltage[extreme];
    if (direction == 0) {
      if (std::fabs(move) > jitter) {
        direction = move > 0 ? 1 : -1;
        extreme = k;
      }
    } else if (direction * move > 0) {
      extreme = k;
    } else if (std::fabs(move) > jitter) {
      turns.push_back(static_cast<int>(extreme) + 1);
      direction = -direction;
      extreme = k;
    }
  }
  return turns;
}

}  // namespace lyrefit
