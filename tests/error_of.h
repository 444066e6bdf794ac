#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "lyrefit/base/error.h"

namespace lyrefit {

template <class T>
std::string MessageOf(const Expected<T>& result) {
  return result ? "no error" : result.error().message;
}

// Expects an error at this place whose message contains the phrase.
template <class T>
void ExpectErrorAt(const Expected<T>& result, const std::string& file, int line, int column,
                   const std::string& phrase) {
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().file, file);
  EXPECT_EQ(result.error().line, line);
  EXPECT_EQ(result.error().column, column);
  EXPECT_THAT(result.error().message, ::testing::HasSubstr(phrase));
}

}  // namespace lyrefit
