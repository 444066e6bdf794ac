// Experimental: may change in a minor version (data/stable).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Median and quartiles, interpolated linearly between the sorted values.
struct Quartiles {
  std::int64_t count = 0;    // number of values
  double low = kUnknown;     // lower quartile
  double median = kUnknown;  // the middle one, or the mean of the two in the middle
  double high = kUnknown;    // upper quartile
};

// Quantities of the statistics of a sample: columns of the rows of task `cell` after "forward_" and
// "reverse_".
inline constexpr std::array<const char*, 5> kSampleQuantities = {"efficiency", "jsc_mA_cm2",
                                                                 "voc_V", "fill_factor", "pmp_W"};

// The working pixels of a sample in one direction.
struct SampleDirection {
  std::string direction;                                       // "forward" or "reverse"
  std::array<Quartiles, kSampleQuantities.size()> quantities;  // as kSampleQuantities names them
  std::string champion;  // id of the pixel of the highest efficiency; without areas, of most power
  double champion_efficiency = kUnknown;  // a fraction; NaN without an area
  double champion_pmp_W = kUnknown;       // its power
};

// The pixels of one sample.
struct SampleSummary {
  std::string name;                            // of the sample
  std::int64_t pixels = 0;                     // number of rows
  std::map<std::string, std::int64_t> states;  // number of rows for each state
  std::map<std::string, std::int64_t> senses;  // number of pairs for each sense of hysteresis
  std::vector<SampleDirection> directions;     // those that were measured
  std::vector<std::string> not_working;        // "a: shorted", by the last level of the ids

  std::int64_t working() const;  // number of working pixels
  // Working pixels over all that were measured in the light; NaN without one.
  double yield() const;
};

}  // namespace lyrefit
