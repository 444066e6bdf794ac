#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hidden/field_tracer.h"

namespace made {

// A plant of strings of 20 modules of 60 cells, cell by cell, with faults hidden in some of them.

inline constexpr int kModules = 20;  // of a string
inline constexpr int kCombiners = 10;
inline constexpr int kStringsOfCombiner = 25;

// A string while it is measured.
struct StringRig {
  std::vector<hidden::field::Module> modules;
  double lead_ohm = 0;  // what connectors and cables add
  hidden::field::Sky sky;
  hidden::field::Tracer tracer;
};

struct PlantFault {
  const char* name;
  const char* accepted;  // names that are right, parted by '|'
  // "curve": in the string's own curve; "neighbours": only beside the rating and other strings.
  const char* shows_in;
  const char* words;
  void (*apply)(hidden::Random* random, StringRig* rig);
};
const std::vector<PlantFault>& PlantFaults();

struct PlantRequest {
  int strings = 500;
  std::uint64_t seed = 1;
  int threads = 0;     // 0: all cores; never changes a byte
  std::string packed;  // a file with one curve a row; empty: not written
  std::string tree;    // a folder: site/inverter/combiner/string.csv; empty: not written
  bool sidecars = false;
  std::string truth;   // id,fault,accepted,shows_in,loss_percent,words of what is hidden
  std::string module;  // rating and coefficients of a module, as JSON
};

// Returns what went wrong, empty if nothing did.
std::string WritePlant(const PlantRequest& request);

}  // namespace made
