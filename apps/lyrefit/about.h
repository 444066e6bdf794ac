#pragma once

#include <string>
#include <vector>

#include "command_line.h"

namespace lyrefit {

// What lyrefit prints of itself. Manual and completion are of the verbs as they are declared.

// The page of `lyrefit` alone: which verb answers which question.
std::string FirstPage();

// The terms of the field, and the columns of the tables, in a few sentences each.
std::string Glossary();

// The manual as a man page, in roff.
std::string ManualPage(const std::vector<VerbText>& verbs);

// A script that completes verbs, flags and their values in "bash", "zsh" or "fish".
std::string CompletionScript(const std::string& shell, const std::vector<VerbText>& verbs);

}  // namespace lyrefit
