#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hidden/field_draw.h"
#include "hidden/field_tracer.h"
#include "hidden/scene.h"

namespace hidden::field {

// A number somebody would read off, "light" of a dim part, "share" of the cells, "width" of a
// scatter, "step" of the light.
struct Figure {
  std::string quantity;
  double value;
};

struct Truth {
  std::vector<std::string> accepted;  // names that are right first; empty: nothing is wrong
  std::vector<Figure> figures;        // a light is followed by its share, where it has one
};

// A fault of the field: what it does to a healthy rig.
struct Fault {
  const char* name;
  void (*apply)(Random* random, Rig* rig, Truth* truth);
};
const std::vector<Fault>& DeviceFaults();
const std::vector<Fault>& SweepFaults();

struct Case {
  std::string kind;
  Make make;
  Truth truth;
  double misfit = 0;   // % of Isc that the best single diode misses the exact readings by (rms)
  double healthy = 0;  // the same without the fault
  Measurement measurement;
};

std::vector<std::string> Kinds();
// The size at which the best single diode misses the healthy module, departure included, by
// `wanted` of Isc.
void SettleDeparture(const Sampled& curve, double wanted, Departure* departure);
Case MakeCase(const std::string& kind, std::uint64_t seed);
// The same with a misfit above a bound, as % of Isc; the strongest of many draws where none is.
Case MakeCaseAbove(const std::string& kind, double misfit, std::uint64_t seed);

}  // namespace hidden::field
