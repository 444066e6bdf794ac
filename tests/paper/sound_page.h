#pragma once

#include <string>

#include "paper/sound_study.h"

namespace lyrefit {

// The page of made problems.
std::string SoundPage(const SoundStudy& made);

// `page` with the block "proofs-wide" drawn anew, if it has one.
std::string WithWide(std::string page, const SoundStudy& study);

// `page` with the block "proofs-measured" drawn anew, if it has one.
std::string WithMeasured(std::string page, const SoundStudy& study);

}  // namespace lyrefit
