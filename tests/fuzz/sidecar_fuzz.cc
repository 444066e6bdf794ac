#include "fuzz_file.h"
#include "lyrefit/read/read_curve.h"

// Reader of the sidecar of a table.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lyrefit;
  FuzzFile("a.json", Bytes(data, size));
  const auto curve = ReadCurve(FuzzFile("a.csv", "V,I\n0,2\n0.4,1.5\n0.6,0\n"));
  if (curve && !Validate(*curve)) std::abort();
  return 0;
}
