// Reader of a set in a folder. The input holds a table, its index and the sidecar of all curves,
// separated by form feeds.

#include <algorithm>

#include "fuzz_file.h"
#include "lyrefit/curve/curve_set.h"

#include "lyrefit/read/read_curve_set.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lyrefit;
  const std::string all = Bytes(data, size);
  const std::size_t first = std::min(all.find('\f'), all.size());
  const std::size_t second = std::min(all.find('\f', first + 1), all.size());
  FuzzFile("curves.csv", all.substr(0, first));
  FuzzFile("index.csv", all.substr(std::min(first + 1, all.size()), second - first));
  FuzzFile("dataset.json", all.substr(std::min(second + 1, all.size())));
  const auto set = ReadCurveSet(FuzzFolder().string());
  for (std::size_t i = 0; set && i < set->curves.size(); ++i) {
    if (!Validate(set->curves[i])) std::abort();
  }
  HoldsCurveSet((FuzzFolder() / "curves.csv").string());
  return 0;
}
