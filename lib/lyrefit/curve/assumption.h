#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Subject of an assumption.
enum class About {
  kReading,
  kCells,
  kTemperature,
  kIrradiance,
  kCurrentUnit,
  kBypassDiodes,
  kTechnology,
};

template <>
struct EnumTable<About> {
  static constexpr EnumText<About> kRows[] = {
      {About::kReading, "reading"},
      {About::kCells, "cells in series"},
      {About::kTemperature, "cell temperature"},
      {About::kIrradiance, "irradiance"},
      {About::kCurrentUnit, "unit of the current"},
      {About::kBypassDiodes, "bypass diodes"},
      {About::kTechnology, "technology"},
  };
};

// A value that a reader assumed, or took from a particular source, as a plain sentence. The
// assumption is removed once the user states the value.
struct Assumption {
  std::string sentence;  // what was assumed, and from where
  About about = About::kReading;

  // The default subject is the readings themselves.
  Assumption(std::string text, About what = About::kReading)  // NOLINT: a sentence is one
      : sentence(std::move(text)), about(what) {}
  Assumption(const char* text) : sentence(text) {}  // NOLINT
};

// Removes the assumptions about one subject.
void Forget(About about, std::vector<Assumption>* assumptions);

// The sentences alone, for display.
std::vector<std::string> SentencesOf(const std::vector<Assumption>& assumptions);

}  // namespace lyrefit
