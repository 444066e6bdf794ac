#include "fuzz_file.h"
#include "lyrefit/read/read_curve.h"

// Reader of an ivcurves JSON file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lyrefit;
  const auto curves = ReadIvCurvesJson(FuzzFile("curves.json", Bytes(data, size)));
  for (std::size_t i = 0; curves && i < curves->size(); ++i) {
    if (!Validate((*curves)[i])) std::abort();
  }
  return 0;
}
