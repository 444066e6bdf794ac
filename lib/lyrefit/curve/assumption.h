#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/enum_text.h"

namespace lyrefit {

// What an assumption is about.
enum class About { kReading, kCells, kTemperature, kIrradiance, kCurrentUnit };

template <>
struct EnumTable<About> {
  static constexpr EnumText<About> kRows[] = {
      {About::kReading, "reading"},
      {About::kCells, "cells in series"},
      {About::kTemperature, "cell temperature"},
      {About::kIrradiance, "irradiance"},
      {About::kCurrentUnit, "unit of the current"},
  };
};

// What a reader had to assume or took from where, as a plain sentence. It is taken back where
// somebody states what it is about.
struct Assumption {
  std::string sentence;
  About about = About::kReading;

  Assumption(std::string text, About what = About::kReading)  // NOLINT: a sentence is one
      : sentence(std::move(text)), about(what) {}
  Assumption(const char* text) : sentence(text) {}  // NOLINT
};

void Forget(About about, std::vector<Assumption>* assumptions);

// For whoever only shows them.
std::vector<std::string> SentencesOf(const std::vector<Assumption>& assumptions);

}  // namespace lyrefit
