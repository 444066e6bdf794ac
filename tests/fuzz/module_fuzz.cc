#include "fuzz_file.h"
#include "lyrefit/read/read_module.h"
#include "lyrefit/simulate/simulate_module.h"

// Readers of modules of PVsyst and SAM.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string file = lyrefit::FuzzFile("module", lyrefit::Bytes(data, size));
  lyrefit::ReadModuleSheet(file);
  if (const auto module = lyrefit::ReadModuleParameters(file)) {
    lyrefit::SimulationOf(*module, {});
  }
  lyrefit::ReadModuleParameters(file + "#Invented I-304 M60");
  return 0;
}
