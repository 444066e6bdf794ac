#pragma once

#include "lyrefit/certify/certify.h"
#include "lyrefit/report/document.h"

namespace lyrefit {

// The picture of the proof for pages, with a caption and a table of its numbers. A figure without
// panels if there is nothing to draw.
block::Figure FigureBlock(const Certificate& certificate);

}  // namespace lyrefit
