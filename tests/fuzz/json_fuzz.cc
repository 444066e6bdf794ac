#include "fuzz_file.h"
#include "lyrefit/curve/curve_set.h"

#include "lyrefit/read/read_curve_set.h"

// Reader of curves in JSON formats other than ivcurves.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lyrefit;
  ReadOptions options;
  options.area_cm2 = 4;
  const auto set = ReadCurveSet(FuzzFile("set.json", Bytes(data, size)), options);
  for (std::size_t i = 0; set && i < set->curves.size(); ++i) {
    if (!Validate(set->curves[i])) std::abort();
  }
  return 0;
}
