#pragma once

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Which values of the Boltzmann constant and the elementary charge enter the thermal voltage. The
// sets differ in the sixth digit of n, and in the RMSE only where n sits at a bound.
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

// 0 C in kelvin.
constexpr double kZeroCelsius_K = 273.15;

// Vt = k T / q in volt, of one cell at `temperature_K`.
double ThermalVoltage(double temperature_K, ConstantSet constants = ConstantSet::kCodata);

}  // namespace lyrefit
