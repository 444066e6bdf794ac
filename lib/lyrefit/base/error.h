#pragma once

#include <string>
#include <utility>

#include <tl/expected.hpp>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// A mistake in the user's data, files or options, in one sentence that says what is wrong and what
// was expected. `line` and `column` count from 1; 0 means "not tied to a line". Broken invariants
// of lyrefit itself are glog CHECKs, and a search that stops badly is a result: neither is an
// Error.
struct Error {
  std::string message;  // what is wrong, and what was expected
  std::string file;     // empty: of no file
  int line = 0;         // from 1
  int column = 0;       // from 1

  // "curve.csv:7:3: expected a number in column current_A, found 'abc'"
  std::string ToString() const;
};

// A value, or the reason why there is none.
template <class T>
using Expected = tl::expected<T, Error>;

// For `return Fail("...")` in functions that give an Expected.
inline tl::unexpected<Error> Fail(std::string message, std::string file = {}, int line = 0,
                                  int column = 0) {
  return tl::unexpected<Error>(Error{std::move(message), std::move(file), line, column});
}

}  // namespace lyrefit
