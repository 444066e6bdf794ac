// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"
#include "lyrefit/model/law.h"

namespace LYREFIT_PUBLIC lyrefit {

// A size with its 95 % interval.
struct Sized {
  double value = kUnknown;  // in the unit of the field
  double low_95 = kUnknown;
  double high_95 = kUnknown;
};

// A fitted parameter of an effect.
struct CauseParameter {
  std::string symbol;
  std::string name;  // name in code and JSON
  std::string unit;
  double value = kUnknown;  // in `unit`
  double low_95 = kUnknown;
  double high_95 = kUnknown;
  bool at_bound = false;
};

// An effect of a fitted law, of which Effect::in_words says how large it is.
struct FittedEffect {
  const Readings& readings;
  const Law& law;
  const std::vector<double>& parameters;        // of the whole law
  int index;                                    // position of the effect in the law
  const double* p;                              // its own parameters, in the units of Reading
  const std::vector<CauseParameter>& strength;  // the same as reported

  // The effect.
  const Effect& effect() const { return *law.effects[index]; }
  // What differs between cells: in a flasher what they make of the light.
  const char* light() const { return readings.traits.setup == Setup::kFlash ? "current" : "light"; }
  // The upper bound of parameter number `k`.
  double Most(int k) const { return effect().parameters[k].upper; }
  // The reported parameter; unknown values if it is not among them.
  Sized Of(std::string_view symbol) const {
    for (const CauseParameter& one : strength) {
      if (one.symbol == symbol) return {one.value, one.low_95, one.high_95};
    }
    return {};
  }
};

}  // namespace lyrefit
