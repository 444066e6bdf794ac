#pragma once

#include <string>
#include <utility>

#include <tl/expected.hpp>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// A mistake in the user's data, files or options. The message is one sentence that states what is
// wrong and what was expected. Broken invariants of lyrefit itself are glog CHECKs instead. A
// search that ends early is a result, not an Error.
struct Error {
  std::string message;  // what is wrong, and what was expected
  std::string file;     // empty: the error concerns no file
  int line = 0;         // from 1; 0: the error concerns no line
  int column = 0;       // from 1; 0: the error concerns no column

  // "curve.csv:7:3: expected a number in column current_A, found 'abc'"
  std::string ToString() const;
};

// A value, or the Error that explains why there is no value.
template <class T>
using Expected = tl::expected<T, Error>;

// Builds the error result of a function that returns an Expected: `return Fail("...")`.
inline tl::unexpected<Error> Fail(std::string message, std::string file = {}, int line = 0,
                                  int column = 0) {
  return tl::unexpected<Error>(Error{std::move(message), std::move(file), line, column});
}

}  // namespace lyrefit
