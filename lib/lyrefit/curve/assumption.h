#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

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
  std::string sentence;  // what was assumed, and from where
  About about = About::kReading;

  // A sentence is an assumption of the readings unless it says of what.
  Assumption(std::string text, About what = About::kReading)  // NOLINT: a sentence is one
      : sentence(std::move(text)), about(what) {}
  Assumption(const char* text) : sentence(text) {}  // NOLINT
};

// Takes back what was assumed about one thing.
void Forget(About about, std::vector<Assumption>* assumptions);

// For whoever only shows them.
std::vector<std::string> SentencesOf(const std::vector<Assumption>& assumptions);

}  // namespace lyrefit
