#include "fuzz_file.h"
#include "lyrefit/curve/curve_set.h"

#include "lyrefit/read/read_curve_set.h"

// Reader of an ivcurves JSON file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lyrefit;
  const auto set = ReadCurveSet(FuzzFile("curves.json", Bytes(data, size)));
  for (std::size_t i = 0; set && i < set->curves.size(); ++i) {
    if (!Validate(set->curves[i])) std::abort();
  }
  return 0;
}
