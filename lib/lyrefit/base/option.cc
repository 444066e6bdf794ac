#include "lyrefit/base/option.h"

namespace lyrefit {

Expected<std::vector<std::string>> SplitList(const std::string& text) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = text.find(',', begin);
    parts.push_back(text.substr(begin, end - begin));
    if (parts.back().empty()) {
      return Fail("expected a list such as a,b,c, found '" + text + "'");
    }
  }
  return parts;
}

std::string JoinList(const std::vector<std::string>& parts) {
  std::string list;
  for (const std::string& part : parts) list += (list.empty() ? "" : ",") + part;
  return list;
}

}  // namespace lyrefit
