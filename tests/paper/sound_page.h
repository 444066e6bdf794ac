#pragma once

#include <string>

#include "paper/sound_study.h"

namespace lyrefit {

// Page of results on synthetic problems.
std::string SoundPage(const SoundStudy& made);

// Replaces the block "proofs-wide" in `page`, if it has one.
std::string WithWide(std::string page, const SoundStudy& study);

// Replaces the block "proofs-measured" in `page`, if it has one.
std::string WithMeasured(std::string page, const SoundStudy& study);

}  // namespace lyrefit
