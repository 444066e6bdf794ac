#include "studies/flags.h"

namespace lyrefit {

ProgramFlags ReadProgramFlags(const std::vector<std::string>& words) {
  const auto is_flag = [](const std::string& word) { return word.rfind("--", 0) == 0; };
  ProgramFlags flags;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!is_flag(words[i])) {
      flags.files.push_back(words[i]);
      continue;
    }
    const bool has_value = i + 1 < words.size() && !is_flag(words[i + 1]);
    flags.texts[words[i].substr(2)].push_back(has_value ? words[i + 1] : "yes");
    if (has_value) ++i;
  }
  return flags;
}

std::string Take(const std::string& name, const std::string& usual, ProgramFlags* flags) {
  const auto found = flags->texts.find(name);
  if (found == flags->texts.end()) return usual;
  std::string text = found->second.back();
  flags->texts.erase(found);
  return text;
}

Expected<void> CheckNothingLeft(const ProgramFlags& flags) {
  if (flags.texts.empty()) return {};
  return Fail("unknown flag --" + flags.texts.begin()->first);
}

}  // namespace lyrefit
