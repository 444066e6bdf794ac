#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command_line.h"

namespace lyrefit {

// Flags of version 0.1, and error messages with suggestions for wrong command lines.

// The words of the command line, with each flag of version 0.1 (base/former_names.h) under its name
// now. A note on standard error tells of it.
std::vector<std::string> CurrentWords(int argc, char** argv);

// The first word of the line that is not a flag; empty if there is none.
std::string FirstWord(int argc, char** argv);

// Error for an unknown verb: the most similar verb, or the list of all verbs.
Error NoSuchVerb(const std::string& word, const std::vector<const Verb*>& verbs);

// Error for an unknown flag among `words`, if one of the verb's `flags` is similar or begins so.
std::optional<Error> NearFlag(const Verb& verb, const std::vector<FlagText>& flags,
                              const std::vector<std::string>& words);

// Error for a common output flag that `verb` does not have, if one is among `words`: names the
// flags that it has instead.
std::optional<Error> OtherTarget(const Verb& verb, const std::vector<std::string>& words);

}  // namespace lyrefit
