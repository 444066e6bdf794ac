#pragma once

// Passing an error on, in one line. Either
//   TRY(const IvCurve curve, ReadCurve(file));    the value, or out of this function with its error
//   TRY(CheckReadings(curve));                    where there is no value, or none is wanted
// in a function that returns some Expected<T> itself. Not installed: a macro with so short a name
// belongs to the inside of a library.

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
