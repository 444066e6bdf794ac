#include "fuzz_file.h"
#include "lyrefit/estimate/fit/bounds.h"

#include "lyrefit/settings/bounds_file.h"

// Reader of a file of bounds.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lyrefit::ReadBoundsFile(lyrefit::FuzzFile("bounds.json", lyrefit::Bytes(data, size)));
  return 0;
}
