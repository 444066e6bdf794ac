#pragma once

#include <string>
#include <vector>

#include "faults/field_case.h"
#include "faults/study.h"

namespace faults {

std::uint64_t FieldSeed(const StudyOptions& options, const std::string& kind, int number);
field::Case FieldCase(const StudyOptions& options, const std::string& kind, int number);

std::string Joined(const std::vector<std::string>& words);
std::string FiguresOf(const field::Case& with_fault);  // "light 0.71, share 0.3333"

// Writes the case as a table to standard output and its truth to standard error.
int ShowFieldCase(const StudyOptions& options);

// Writes each case as a table with its notes into the folder, and the true faults into labels.csv.
int DumpFieldCases(const StudyOptions& options, const std::vector<std::string>& kinds, int cases);

}  // namespace faults
