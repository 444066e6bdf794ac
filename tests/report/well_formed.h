#pragma once

#include <cstdlib>
#include <fstream>
#include <string>

#include "temp_folder.h"

namespace lyrefit {

inline bool HasXmlLint() { return std::system("command -v xmllint > /dev/null") == 0; }

// Errors that xmllint reports for a page; empty if there are none.
inline std::string Complaints(const std::string& html) {
  const TempFolder folder;
  const std::string page = folder.Write("page.html", html);
  const std::string said = page + ".said";
  const int status = std::system(("xmllint --nonet --noout " + page + " 2> " + said).c_str());
  std::ifstream file(said);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  return status == 0 ? text : "failed: " + text;
}

}  // namespace lyrefit
