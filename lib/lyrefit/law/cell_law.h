#pragma once

#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/law/effect.h"
#include "lyrefit/law/law.h"
#include "lyrefit/law/reading.h"

// The law of one cell, over any number type: what law.cc solves.
namespace lyrefit {

constexpr double kLargestCellExponent = 200;

// The parameters' view of a law: where each effect's stretch begins.
template <class S>
struct Bench {
  const Law& law;
  const Readings& readings;
  const S* p;
  std::vector<int> offsets;
};

// A cell at a temperature, its light still to come.
template <class S>
Cell<S> CellUnder(const Bench<S>& bench, const Sky<S>& sky) {
  const double k_eV = ThermalVoltage(1.0);
  const double reference_K = bench.readings.reference_temperature_K;
  const double pivot = bench.readings.pivot_voltage;
  const S* p = bench.p;
  const S ratio = sky.temperature_K * (1 / reference_K);
  const S inverse_vt = 1.0 / (sky.temperature_K * k_eV);
  const S barrier = DeSotoBarrier(sky.bandgap_eV, S(bench.law.bandgap_slope_per_K), reference_K,
                                  sky.temperature_K, k_eV);
  const S inverse_n = 1.0 / p[kBaseIdeality];
  const S pivot_exponent = inverse_n * (pivot / (k_eV * reference_K));
  Cell<S> cell;
  cell.thermal_voltage = sky.temperature_K * k_eV;
  // exp(pivot) / (exp(x) - 1), without overflow where the cells are too few for the voltage.
  cell.saturation = exp(p[kBasePivot] + barrier - pivot_exponent) * (ratio * ratio * ratio) /
                    (1.0 - exp(-pivot_exponent));
  cell.inverse_n_vt = inverse_vt * inverse_n;
  cell.inverse_2_vt = 0.5 * inverse_vt;
  cell.saturation_2_unit =
      bench.readings.scale.saturation_2_unit * (ratio * ratio * sqrt(ratio)) * exp(0.5 * barrier);
  cell.second = bench.law.second_diode;
  cell.saturation_2 = bench.law.second_diode ? p[kBaseSecond] * cell.saturation_2_unit : S(0.0);
  cell.resistance = p[kBaseResistance];
  cell.share = S(0.0);
  cell.light = S(1.0);
  cell.bypass = S(0.0);
  cell.lateral = S(0.0);
  cell.reach = bench.readings.scale.reach_V;
  const DataTraits& traits = bench.readings.traits;
  const int substrings = traits.substrings > 0 ? traits.substrings : 3;
  cell.substring_cells = static_cast<double>(traits.cells) / substrings;
  return cell;
}

// What the light decides in a cell whose temperature is settled.
template <class S>
void Light(const Bench<S>& bench, const Sky<S>& sky, Cell<S>* cell) {
  const double reference_K = bench.readings.reference_temperature_K;
  const S* p = bench.p;
  cell->irradiance = sky.irradiance;
  const S warmer = sky.temperature_K - reference_K;
  cell->photocurrent =
      sky.irradiance * (p[kBasePhotocurrent] * (1.0 + sky.isc_tempco_per_K * warmer) +
                        bench.readings.isc_tempco_scales_per_K * warmer);
  // A cell in a string must carry the others' current in reverse, if at a huge voltage.
  constexpr double kSmallestConductance = 1e-8;
  const bool inverse = bench.law.shunt == ShuntLaw::kInverse;
  cell->conductance =
      (inverse ? p[kBaseConductance] * sky.irradiance : p[kBaseConductance]) + kSmallestConductance;
}

template <class S>
Sky<S> SkyAt(const Bench<S>& bench, const Reading& reading) {
  const Law& law = bench.law;
  Sky<S> sky{S(reading.voltage), S(reading.irradiance), S(reading.temperature_K),
             law.free_bandgap ? bench.p[law.BandgapAt()] : S(bench.readings.bandgap_eV),
             law.free_tempco ? bench.p[law.TempcoAt()] : S(bench.readings.isc_tempco_per_K)};
  for (std::size_t e = 0; e < bench.law.effects.size(); ++e) {
    const auto stage = bench.law.effects[e]->sky.template For<S>();
    if (stage != nullptr) stage(bench.p + bench.offsets[e], reading, &sky);
  }
  return sky;
}

// `warm` holds what the temperature decides: CellUnder of the same one.
template <class S>
Cell<S> CellAt(const Bench<S>& bench, const Sky<S>& sky, const Cell<S>& warm) {
  Cell<S> cell = warm;
  Light(bench, sky, &cell);
  for (std::size_t e = 0; e < bench.law.effects.size(); ++e) {
    const auto stage = bench.law.effects[e]->cell.template For<S>();
    if (stage != nullptr) stage(bench.p + bench.offsets[e], &cell);
  }
  return cell;
}

template <class T>
T Cut(const T& exponent) {
  return exponent < kLargestCellExponent ? exponent : T(kLargestCellExponent);
}

// F(Vj) of a cell with its own photocurrent. With plain parameters the result carries its slope.
template <class S>
Tangent<S> JunctionCurrent(const Bench<S>& bench, const Cell<S>& cell, const Tangent<S>& voltage) {
  using T = Tangent<S>;
  T current = T(cell.photocurrent) -
              (exp(Cut(T(voltage * cell.inverse_n_vt))) - 1.0) * T(cell.saturation) -
              voltage * cell.conductance;
  if (cell.second) {
    current = current - (exp(Cut(T(voltage * cell.inverse_2_vt))) - 1.0) * T(cell.saturation_2);
  }
  for (std::size_t e = 0; e < bench.law.effects.size(); ++e) {
    const auto stage = bench.law.effects[e]->junction.template For<S>();
    if (stage != nullptr) current = current + stage(bench.p + bench.offsets[e], cell, voltage);
  }
  return current;
}

// Root of a rising function from `start`: Newton inside a bracket that grows with what is seen.
// `f` returns value and slope. The last value is at most rounding away from 0.
template <class F>
double RisingRoot(F f, double start) {
  constexpr int kMaxIterations = 120;
  constexpr int kPatience = 40;  // Newton steps before plain halving
  double rise = 0.15;            // upwards the diode's exponential overshoots
  double low = -std::numeric_limits<double>::infinity(),
         high = std::numeric_limits<double>::infinity(), x = start;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const Slope1 y = f(x);
    if (y.a == 0) return x;
    (y.a < 0 ? low : high) = x;
    const bool bracketed = std::isfinite(low) && std::isfinite(high);
    double next = x - y.a / y.v[0];
    // After a Newton step this short the next would be below rounding.
    bool last = std::fabs(next - x) < 1e-8 * (1 + std::fabs(x));
    if (next > x + rise) {
      next = x + rise;
      rise *= 2;
    }
    if (bracketed && (!(next > low && next < high) || iteration > kPatience)) {
      next = 0.5 * (low + high);
      last = std::fabs(next - x) < 1e-13 * (1 + std::fabs(x));
    } else if (!std::isfinite(next) || next == x) {
      return x;
    }
    x = next;
    if (last) break;
  }
  return x;
}

// Current of a cell in two halves, the second behind a lateral resistance R:
// I = (F(V) + F(Vb)) / 2, Vb = V + R F(Vb) / 2.
template <class S>
Tangent<S> HalvedCurrent(const Bench<S>& bench, const Cell<S>& cell, const Bench<double>& plain,
                         const Cell<double>& plain_cell, const Tangent<S>& voltage) {
  using T = Tangent<S>;
  const double half = 0.5 * plain_cell.lateral;
  double slope = 0;
  const auto excess = [&](double v) {
    const Slope1 current = JunctionCurrent(plain, plain_cell, Slope1(v, 0));
    slope = 1 - half * current.v[0];
    return Slope1(v, 0) - ValueOf(voltage) - half * current;
  };
  const double far = RisingRoot(excess, ValueOf(voltage));
  excess(far);
  const T there = JunctionCurrent(bench, cell, T(far));
  const T second = far - (far - voltage - 0.5 * cell.lateral * there) / slope;
  return 0.5 * (JunctionCurrent(bench, cell, voltage) + JunctionCurrent(bench, cell, second));
}

template <class S>
Cell<S> UnderLight(const Cell<S>& cell, const S& light) {
  Cell<S> lit = cell;
  lit.photocurrent = cell.photocurrent * light;
  return lit;
}

// Current of a cell, halves and all, in plain numbers with its slope by the voltage.
inline Slope1 CellCurrent(const Bench<double>& bench, const Cell<double>& cell,
                          const Slope1& voltage) {
  if (!cell.halved) return JunctionCurrent(bench, cell, voltage);
  return HalvedCurrent(bench, cell, bench, cell, voltage);
}

// The same as duals.
template <class S>
S CellCurrent(const Bench<S>& bench, const Cell<S>& cell, const Bench<double>& plain,
              const Cell<double>& plain_cell, const S& voltage) {
  if (!cell.halved) return JunctionCurrent(bench, cell, voltage);
  return HalvedCurrent(bench, cell, plain, plain_cell, voltage);
}

// Current through the bypass diodes beside a group of cells, per voltage `reverse` of a cell
// against its own direction.
template <class S>
Tangent<S> BypassCurrent(const Cell<S>& cell, const Tangent<S>& reverse) {
  using T = Tangent<S>;
  constexpr double kIdeality = 1.2;
  if (!cell.bypassed) return T(0.0);
  const S inverse = (1 / kIdeality) / cell.thermal_voltage;
  const S start = exp(-(cell.bypass * inverse));
  return (exp(Cut(T(reverse * (cell.substring_cells * inverse)))) - 1.0) * T(start);
}

// D(I): what stands between junction and terminal, Vj = V + D.
template <class S>
Tangent<S> SeriesDrop(const Bench<S>& bench, const Cell<S>& cell, const Tangent<S>& current) {
  Tangent<S> drop = current * cell.resistance;
  for (std::size_t e = 0; e < bench.law.effects.size(); ++e) {
    const auto stage = bench.law.effects[e]->series.template For<S>();
    if (stage != nullptr) drop = drop + stage(bench.p + bench.offsets[e], cell, current);
  }
  return drop;
}

}  // namespace lyrefit
