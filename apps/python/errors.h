#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <utility>

#include "lyrefit/base/error.h"

namespace lyrefit::python {

// Raises lyrefit.Error, a ValueError with the command's message and the attributes file, line and
// column.
[[noreturn]] void Raise(const Error& error);

// The error raised by Raise; raises any other exception again.
Error ErrorOf(pybind11::error_already_set& raised);

// A Python UserWarning, which names the line of the caller's code. The caller must hold the
// interpreter's lock; raises where the user made warnings errors.
void Warn(const std::string& sentence);

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
