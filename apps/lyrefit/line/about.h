#pragma once

#include <string>
#include <vector>

#include "command_line.h"

namespace lyrefit {

// Texts about lyrefit itself. The manual and the completion script use the declarations of the
// verbs.

// The page printed by `lyrefit` without a verb: the verbs that answer each question.
std::string FirstPage();

// Where manual, packages and tracker are: published (base/address.h), or how a clone makes them.
std::string Whereabouts();

// The terms of the field and the columns of the tables, each explained in a few sentences.
std::string Glossary();

// The manual as a man page, in roff.
std::string ManualPage(const std::vector<VerbText>& verbs);

// A script that completes verbs, flags and their values in "bash", "zsh" or "fish".
std::string CompletionScript(const std::string& shell, const std::vector<VerbText>& verbs);

}  // namespace lyrefit
