#pragma once

#include <utility>
#include <vector>

#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// Reduces a column to the readings `kept`, by their indices; an empty column stays empty.
template <typename Value>
void KeepValues(const std::vector<int>& kept, std::vector<Value>* values) {
  if (values->empty()) return;
  std::vector<Value> few;
  few.reserve(kept.size());
  for (const int k : kept) few.push_back((*values)[k]);
  *values = std::move(few);
}

// Reduces every column of a curve.
inline void KeepReadings(const std::vector<int>& kept, IvCurve* curve) {
  for (std::vector<double>* column :
       {&curve->voltage_V, &curve->current_A, &curve->sigma_A, &curve->time_s,
        &curve->irradiance_W_m2, &curve->temperature_C}) {
    KeepValues(kept, column);
  }
  KeepValues(kept, &curve->sweep);
}

}  // namespace lyrefit
