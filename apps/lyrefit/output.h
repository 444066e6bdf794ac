#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"

namespace lyrefit {

// Exit codes of every verb.
constexpr int kExitFine = 0;
constexpr int kExitBadInput = 1;
constexpr int kExitNotUsable = 2;
constexpr int kExitInterrupted = 130;  // also where a report of what was done was written

// Writes onto standard error, what is no UTF-8 as U+FFFD. Where that cannot be written, nobody is told.
void TellError(const std::string& text);

// Prints "lyrefit: sentence" on standard error; returns kExitBadInput.
int Refuse(const Error& error);

// One line each on standard error.
void PrintRemarks(const std::vector<std::string>& remarks);

// Whether a file can be created or replaced at `path`; leaves nothing behind. "-" and "" pass.
Expected<void> CheckWritable(const std::string& path);

// Writes into a file, or onto standard output if `path` is "-", where what is no UTF-8 becomes U+FFFD.
Expected<void> WriteOutput(const std::string& path, const std::string& text);

}  // namespace lyrefit
