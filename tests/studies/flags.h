#pragma once

#include <string>
#include <vector>

#include "web/table_options.h"

namespace lyrefit {

// The words of a study's command line.
struct ProgramFlags {
  std::vector<std::string> files;  // words that belong to no flag
  FormTexts texts;                 // by flag, without "--"; a flag without a value has "yes"
};

ProgramFlags ReadProgramFlags(const std::vector<std::string>& words);

// Removes a flag and returns its last value; `usual` if it is not given.
std::string Take(const std::string& name, const std::string& usual, ProgramFlags* flags);

// Error: a flag that nothing took.
Expected<void> CheckNothingLeft(const ProgramFlags& flags);

// Sets the options that the flags name and removes these flags.
template <class Options, class Table>
Expected<void> TakeTable(const Table& table, ProgramFlags* flags, Options* options) {
  const Options defaults = *options;
  for (const OptionRow<Options>& row : table) {
    const auto found = row.IsHeading() ? flags->texts.end() : flags->texts.find(row.name);
    if (found == flags->texts.end()) continue;
    for (const std::string& text : found->second) {
      if (const auto read = ReadField(row, text, defaults, options); !read) {
        return Fail(fmt::format("--{}: {}", row.name, read.error().message));
      }
    }
    flags->texts.erase(found);
  }
  return ValidateOptions(*options, table);
}

}  // namespace lyrefit
