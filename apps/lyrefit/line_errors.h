#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command_line.h"

namespace lyrefit {

// Command lines that cannot be meant as they stand, in sentences that lead on.

// The first word of the line that is no flag; empty if there is none.
std::string FirstWord(int argc, char** argv);

// What was meant by a word that is no verb, or which verbs there are.
Error NoSuchVerb(const std::string& word, const std::vector<const Verb*>& verbs);

// Flags that many verbs have alike: if one of them is among the words that `verb` does not know,
// what it writes instead.
std::optional<Error> OtherTarget(const Verb& verb, const std::vector<std::string>& words);

}  // namespace lyrefit
