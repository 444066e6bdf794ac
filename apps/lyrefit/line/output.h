#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"

namespace lyrefit {

// Exit codes of every verb.
constexpr int kExitFine = 0;
constexpr int kExitBadInput = 1;
constexpr int kExitNotUsable = 2;
constexpr int kExitInterrupted = 130;  // also if a report of the finished part was written

// Writes to standard error; invalid UTF-8 becomes U+FFFD. Failures are ignored.
void TellError(const std::string& text);

// Prints "lyrefit: sentence" on standard error; returns kExitBadInput.
int Refuse(const Error& error);

// Prints one line for each remark to standard error.
void PrintRemarks(const std::vector<std::string>& remarks);

// Writes to a file, or to standard output if `path` is "-"; there invalid UTF-8 becomes U+FFFD.
Expected<void> WriteOutput(const std::string& path, const std::string& text);

}  // namespace lyrefit
