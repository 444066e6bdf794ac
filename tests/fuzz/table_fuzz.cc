// Reader of any curve text, as from standard input. A curve that is read must pass Validate().

#include <cstdlib>

#include "fuzz_file.h"
#include "lyrefit/read/read_curve.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lyrefit;
  const std::string text = Bytes(data, size);
  ReadOptions chosen;
  chosen.column = "2";
  chosen.curve = 1;
  chosen.area_cm2 = 4;
  ReadOptions named;
  named.voltage_column = "2";
  named.current_column = "1";
  for (const ReadOptions& options : {ReadOptions(), chosen, named}) {
    const auto curve = ReadCurveText(text, "input", options);
    if (curve && !Validate(*curve)) std::abort();
    if (!curve && curve.error().message.empty()) std::abort();
  }
  return 0;
}
