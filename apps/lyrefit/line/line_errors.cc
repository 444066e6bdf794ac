#include "line_errors.h"

#include <algorithm>
#include <iostream>

#include "lyrefit/base/former_names.h"

namespace lyrefit {
namespace {

// Number of letters to insert, delete, replace or exchange with their neighbour to turn `a` into
// `b`.
std::size_t Distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      const bool same = a[i - 1] == b[j - 1];
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::vector<std::string> CurrentWords(int argc, char** argv) {
  std::vector<std::string> words(argv, argv + argc);
  for (std::string& word : words) {
    if (word.rfind("--", 0) != 0) continue;
    const std::string flag = word.substr(0, word.find('='));
    const std::string now = "--" + std::string(CurrentOption(flag.substr(2)));
    if (now == flag) continue;
    std::cerr << "lyrefit: " << flag << " is now " << now << '\n';
    word.replace(0, flag.size(), now);
  }
  return words;
}

std::string FirstWord(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (argv[i][0] != '-') return argv[i];
  }
  return "";
}

Error NoSuchVerb(const std::string& word, const std::vector<const Verb*>& verbs) {
  std::string near, all;
  std::size_t nearest = 3;  // words that differ by more than two letters are not suggested
  for (const Verb* verb : verbs) {
    const std::string name = verb->name;
    if (verb->kind != VerbKind::kAbout) all += (all.empty() ? "" : ", ") + name;
    const bool begun = word.size() >= 2 && name.rfind(word, 0) == 0;
    const std::size_t distance = begun ? 0 : Distance(word, name);
    if (distance >= std::min(nearest, name.size())) continue;
    nearest = distance;
    near = name;
  }
  if (word.empty()) return {"expected a verb: " + all, {}};
  if (near.empty()) return {"no verb '" + word + "': expected " + all, {}};
  return {"no verb '" + word + "'; did you mean " + near + "?", {}};
}

std::optional<Error> NearFlag(const Verb& verb, const std::vector<FlagText>& flags,
                              const std::vector<std::string>& words) {
  const auto flag = std::find_if(words.begin(), words.end(), [](const std::string& word) {
    return word.size() > 1 && word.front() == '-';
  });
  if (flag == words.end()) return {};
  const std::string word = flag->substr(0, flag->find('='));
  const std::string bare = word.substr(word.find_first_not_of('-'));
  std::string near;
  std::size_t nearest = 3;  // flags that differ by more than two letters are not suggested
  for (const FlagText& text : flags) {
    if (text.name.rfind("--", 0) != 0) continue;
    const std::string known = text.name.substr(2);
    const bool begun = bare.size() >= 2 && known.rfind(bare, 0) == 0;
    const std::size_t distance = bare == known ? 0 : begun ? 1 : Distance(bare, known);
    if (distance >= std::min(nearest, known.size())) continue;
    nearest = distance;
    near = text.name;
  }
  if (near.empty()) return {};
  return Error{"no flag '" + word + "' of " + verb.name + "; did you mean " + near + "?", {}};
}

std::optional<Error> OtherTarget(const Verb& verb, const std::vector<std::string>& words) {
  for (const char* flag : {"--json", "--csv", "--plot", "--html", "--brief", "--full-json",
                           "--full-plot", "--quiet"}) {
    for (const std::string& word : words) {
      if (word.substr(0, word.find('=')) != flag) continue;
      return Error{std::string(flag) + ": " + verb.name + " has none; it writes " + verb.writes,
                   {}};
    }
  }
  return {};
}

}  // namespace lyrefit
