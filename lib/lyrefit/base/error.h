#pragma once

#include <string>
#include <utility>

#include <tl/expected.hpp>

namespace lyrefit {

// A mistake in the user's data, files or options, in one sentence that says what is wrong and what
// was expected. `line` and `column` count from 1; 0 means "not tied to a line". Broken invariants
// of lyrefit itself are glog CHECKs, and a search that stops badly is a result: neither is an
// Error.
struct Error {
  std::string message;
  std::string file;
  int line = 0;
  int column = 0;

  // "curve.csv:7:3: expected a number in column current_A, found 'abc'"
  std::string ToString() const;
};

template <class T>
using Expected = tl::expected<T, Error>;

inline tl::unexpected<Error> Fail(std::string message, std::string file = {}, int line = 0,
                                  int column = 0) {
  return tl::unexpected<Error>(Error{std::move(message), std::move(file), line, column});
}

}  // namespace lyrefit
