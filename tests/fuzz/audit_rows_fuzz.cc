#include "fuzz_file.h"
#include "lyrefit/study/read_audit_rows.h"

// Reader of published parameter rows.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lyrefit::ReadAuditRows(lyrefit::FuzzFile("rows.csv", lyrefit::Bytes(data, size)));
  return 0;
}
