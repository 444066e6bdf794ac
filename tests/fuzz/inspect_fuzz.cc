// What a file holds, of any bytes. Where it is text there is an answer, which can be drawn and written.

#include <cstdlib>

#include "fuzz_file.h"
#include "lyrefit/inspect/inspect.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lyrefit;
  const auto found = Inspect(FuzzFile("input.csv", Bytes(data, size)));
  if (!found) {
    if (found.error().message.empty()) std::abort();
    return 0;
  }
  if (found->form.empty() || (found->next.empty() && found->refusal.empty())) std::abort();
  if (InspectionText(*found).empty() || InspectionJson({*found}).empty()) std::abort();
  return 0;
}
