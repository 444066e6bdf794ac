#include "lyrefit/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "lyrefit/base/reasons.h"

namespace lyrefit {

std::string Error::ToString() const {
  std::string place = file;
  if (line > 0) place += (place.empty() ? "line " : ":") + std::to_string(line);
  if (line > 0 && column > 0) place += ":" + std::to_string(column);
  return place.empty() ? message : place + ": " + message;
}

namespace {

bool IsNumeral(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

}  // namespace

std::string WithoutNumbers(const std::string& sentence) {
  std::string text;
  for (std::size_t i = 0; i < sentence.size();) {
    const char c = sentence[i];
    const std::size_t close = c == '\'' ? sentence.find('\'', i + 1) : std::string::npos;
    if (close != std::string::npos) {  // a quoted text, usually the found value
      text += "'N'";
      i = close + 1;
    } else if (IsNumeral(c)) {
      const std::size_t end = sentence.find_first_not_of("0123456789.,eE+-", i);
      std::size_t last = std::min(end, sentence.size());
      while (!IsNumeral(sentence[last - 1])) --last;  // keeps the full stop of the sentence
      text += 'N';
      i = last;
    } else {
      text += c;
      ++i;
    }
  }
  return text;
}

std::vector<std::string> OncePerKind(const std::vector<std::string>& sentences) {
  std::map<std::string, std::size_t> counts;
  for (const std::string& sentence : sentences) ++counts[WithoutNumbers(sentence)];
  std::vector<std::string> kept;
  for (const std::string& sentence : sentences) {
    std::size_t& count = counts[WithoutNumbers(sentence)];
    if (count == 0) continue;
    kept.push_back(count == 1 ? sentence
                              : fmt::format("{} (and {} more of the kind)", sentence, count - 1));
    count = 0;
  }
  return kept;
}

}  // namespace lyrefit
