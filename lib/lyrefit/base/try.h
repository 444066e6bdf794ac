#pragma once

// Error propagation in one line, inside functions that return some Expected<T>:
//   TRY(const IvCurve curve, ReadCurve(file));    takes the value, or returns the error
//   TRY(CheckReadings(curve));                    returns the error; discards a value
// The header is not installed, because so short a macro name could clash with a user's code.

#include <utility>

#include "lyrefit/base/error.h"

#define LYREFIT_TRY_JOIN_(a, b) a##b
#define LYREFIT_TRY_NAME_(line) LYREFIT_TRY_JOIN_(lyrefit_try_, line)
#define LYREFIT_TRY_PICK_(first, second, chosen, ...) chosen

#define LYREFIT_TRY_VALUE_(declaration, expression)                                        \
  auto LYREFIT_TRY_NAME_(__LINE__) = (expression);                                         \
  if (!LYREFIT_TRY_NAME_(__LINE__)) {                                                      \
    return tl::unexpected<lyrefit::Error>(std::move(LYREFIT_TRY_NAME_(__LINE__)).error()); \
  }                                                                                        \
  declaration = *std::move(LYREFIT_TRY_NAME_(__LINE__))

#define LYREFIT_TRY_ONLY_(expression)                                          \
  do {                                                                         \
    if (auto lyrefit_tried = (expression); !lyrefit_tried) {                   \
      return tl::unexpected<lyrefit::Error>(std::move(lyrefit_tried).error()); \
    }                                                                          \
  } while (false)

#define TRY(...) \
  LYREFIT_TRY_PICK_(__VA_ARGS__, LYREFIT_TRY_VALUE_, LYREFIT_TRY_ONLY_, )(__VA_ARGS__)
