#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/error.h"

namespace lyrefit::python {

// A sentence of the library with the command's flags as keywords: "--cells 2" as "cells_in_series=2",
// "--as-is" as "as_is=True", "--area-cm2" as "area_cm2=". Flags without a keyword stay. Raise and Warn
// apply it.
std::string InKeywords(const std::string& sentence);

// Raises lyrefit.Error, a ValueError with the command's message and the attributes file, line and
// column.
[[noreturn]] void Raise(const Error& told);

// The error raised by Raise; raises any other exception again.
Error ErrorOf(pybind11::error_already_set& raised);

// A Python UserWarning, which names the line of the caller's code. The caller must hold the
// interpreter's lock; raises where the user made warnings errors.
void Warn(const std::string& sentence);

// A warning for each doubt about the readings, which the command shows as DOUBTFUL.
void WarnOfDoubts(const std::vector<std::string>& doubts);

// The warning that a fit gives no answer to go on with, where the command ends with another exit
// code; nothing of a usable fit. An empty reason refers to the result.
void WarnUnlessUsable(bool usable, const std::string& because);

// Returns the value or raises its error. The caller must hold the interpreter's lock.
template <class T>
T Must(Expected<T> expected) {
  if (!expected) Raise(expected.error());
  if constexpr (!std::is_void_v<T>) return *std::move(expected);
}

}  // namespace lyrefit::python
