#pragma once

#include <pybind11/pybind11.h>

#include <utility>

#include "lyrefit/base/error.h"

namespace lyrefit::python {

// Raises lyrefit.Error, a ValueError with the sentence that the command prints and the attributes
// file, line and column.
[[noreturn]] void Raise(const Error& error);

// The error that Raise raised; raises again whatever else was.
Error ErrorOf(pybind11::error_already_set& raised);

// The value, or its error raised. The interpreter's lock has to be held.
template <class T>
T Must(Expected<T> expected) {
  if (!expected) Raise(expected.error());
  if constexpr (!std::is_void_v<T>) return *std::move(expected);
}

}  // namespace lyrefit::python
