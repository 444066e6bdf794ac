#include "output.h"

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "lyrefit/base/file.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {

void TellError(const std::string& text) {
  const std::string readable = Readable(text);
  std::fwrite(readable.data(), 1, readable.size(), stderr);
  std::fflush(stderr);
}

int Refuse(const Error& error) {
  TellError("lyrefit: " + error.ToString() + "\n");
  return kExitBadInput;
}

void PrintRemarks(const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks) TellError("lyrefit: " + remark + "\n");
}

Expected<void> WriteOutput(const std::string& path, const std::string& text) {
  if (path != "-") return WriteTextFile(path, text);
  const std::string readable = Readable(text);
  const bool written =
      std::fwrite(readable.data(), 1, readable.size(), stdout) == readable.size() &&
      std::fflush(stdout) == 0;
  if (written) return {};
  return Fail("cannot write the file: " + std::generic_category().message(errno),
              "standard output");
}

}  // namespace lyrefit
