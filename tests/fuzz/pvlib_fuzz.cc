#include "fuzz_file.h"
#include "lyrefit/read/read_pvlib.h"

// Reader of parameters with pvlib's names.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lyrefit::ReadPvlibParameters(lyrefit::FuzzFile("pvlib.json", lyrefit::Bytes(data, size)));
  return 0;
}
