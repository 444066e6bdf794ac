#pragma once

#include <string>
#include <vector>

#include "hidden/field_case.h"
#include "hidden/study.h"

namespace hidden {

std::uint64_t FieldSeed(const StudyOptions& options, const std::string& kind, int number);
field::Case FieldCase(const StudyOptions& options, const std::string& kind, int number);

std::string Joined(const std::vector<std::string>& words);
std::string FiguresOf(const field::Case& hidden);  // "light 0.71, share 0.3333"

// The case to show as a table on the output, what is in it on the error output.
int ShowFieldCase(const StudyOptions& options);

// A table with its notes for every case in the folder, and what is in them: labels.csv.
int DumpFieldCases(const StudyOptions& options, const std::vector<std::string>& kinds, int cases);

}  // namespace hidden
