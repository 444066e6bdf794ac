#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "faults/field_tracer.h"

namespace made {

// A simulated plant of strings with 20 modules of 60 cells, built cell by cell; some have faults.

inline constexpr int kModules = 20;  // per string
inline constexpr int kCombiners = 10;
inline constexpr int kStringsOfCombiner = 25;

// A string and the conditions of its measurement.
struct StringRig {
  std::vector<faults::field::Module> modules;
  double lead_ohm = 0;               // of connectors and cables
  double suns = 1, kelvin = 298.15;  // of the string
  faults::field::Sky sky;
  faults::field::Tracer tracer;
};

// A module of the plant's type, or of another type that was put in its place.
faults::field::Module DrawPlantModule(bool other_type, double suns, double kelvin,
                                      faults::Random* random);

struct PlantFault {
  const char* name;
  const char* accepted;  // accepted names, separated by '|'
  // "curve": visible in the curve of the string; "neighbours": only by comparison with the rating
  // and other strings.
  const char* shows_in;
  const char* words;
  void (*apply)(faults::Random* random, StringRig* rig);
  bool of_sweep = false;  // belongs to one sweep, not to the string
};
const std::vector<PlantFault>& PlantFaults();

// What happens to a string between two campaigns.
enum class ChangeOf { kDevice, kRepair, kExchange, kName, kGone, kNew };

struct PlantChange {
  const char* name;
  const char* accepted;  // accepted values of change_kind and change_candidates, separated by '|'
  const char* words;
  ChangeOf of = ChangeOf::kDevice;
  // kDevice: the change. kRepair, kExchange: null, see `fault`.
  void (*apply)(faults::Random* random, StringRig* rig) = nullptr;
  // Name of the fault that a repaired or exchanged string has since the first campaign.
  const char* fault = nullptr;
};
const std::vector<PlantChange>& PlantChanges();

struct PlantRequest {
  int strings = 500;
  // 0: the first campaign. Else years since then: the same strings and modules, older, with another
  // sky, other errors of sensors and tracer, and PlantChanges(). `truth` then lists the changes:
  // id,change,accepted,partner,lost_W,words.
  int years = 0;
  std::uint64_t seed = 1;
  int threads = 0;     // 0: all cores; the output does not depend on it
  std::string packed;  // file with one curve per row; empty: not written
  std::string tree;    // folder: site/inverter/combiner/string.csv; empty: not written
  bool sidecars = false;
  std::string truth;   // file of the faults: id,fault,accepted,shows_in,loss_percent,words
  std::string module;  // rating and coefficients of a module, as JSON
};

// Returns an error message, empty on success.
std::string WritePlant(const PlantRequest& request);

}  // namespace made
