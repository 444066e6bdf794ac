#pragma once

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Selects the values of the Boltzmann constant k and the elementary charge q in the thermal
// voltage. The choice changes the sixth digit of n, and the RMSE only where n is at a bound.
enum class ConstantSet {
  kCodata,      // k = 1.380649e-23 J/K, q = 1.602176634e-19 C, exact since 2019 (CODATA 2018)
  kLiterature,  // k = 1.3806503e-23, q = 1.60217646e-19: most of the benchmark literature
  kPaper,       // k = 1.38065e-23, q = 1.60217e-19: the modified-lyrebird paper
};

template <>
struct EnumTable<ConstantSet> {
  static constexpr EnumText<ConstantSet> kRows[] = {
      {ConstantSet::kCodata, "codata"},
      {ConstantSet::kLiterature, "literature"},
      {ConstantSet::kPaper, "paper"},
  };
};

// 0 degrees Celsius in K.
constexpr double kZeroCelsius_K = 273.15;

// Thermal voltage Vt = k T / q of one cell, in V. `temperature_K` must be positive (CHECKed).
double ThermalVoltage(double temperature_K, ConstantSet constants = ConstantSet::kCodata);

}  // namespace lyrefit
