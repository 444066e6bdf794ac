#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "faults/field_draw.h"
#include "faults/field_tracer.h"
#include "faults/scene.h"

namespace faults::field {

// A quantity that a user reads from the diagnosis: "light" (relative light of a dim part), "share"
// (of the cells), "width" (of a scatter), "step" (of the light), ...
struct Figure {
  std::string quantity;
  double value;
};

struct Truth {
  std::vector<std::string> accepted;  // accepted first names; empty: no fault
  std::vector<Figure> figures;        // a "light" is followed by its "share" if it has one
  double power_W = 0;                 // maximum power without the fault
  double lost_W = 0;                  // what the fault takes of it
};

// A field fault: the change that it makes to a healthy rig.
struct Fault {
  const char* name;
  void (*apply)(Random* random, Rig* rig, Truth* truth);
};
const std::vector<Fault>& DeviceFaults();
const std::vector<Fault>& CellFaults();
const std::vector<Fault>& SweepFaults();

struct Case {
  std::string kind;
  Make make;
  Truth truth;
  double misfit = 0;   // rms misfit of the best single diode to the exact readings, % of Isc
  double healthy = 0;  // the misfit without the fault, % of Isc
  Measurement measurement;
};

std::vector<std::string> Kinds();
// Scales the departure so that the rms misfit of the best single diode to the healthy module is
// `wanted`, as a fraction of Isc. The departure is included.
void SettleDeparture(const Sampled& curve, double wanted, Departure* departure);
Case MakeCase(const std::string& kind, std::uint64_t seed);
// Draws cases until one has a misfit of at least `misfit`, in % of Isc. If none of many draws
// reaches it, returns the one with the largest misfit.
Case MakeCaseAbove(const std::string& kind, double misfit, std::uint64_t seed);

}  // namespace faults::field
