// Experimental: may change in a minor version (data/stable).
#pragma once

#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// When a pixel of a sample counts as working, for its yield. The direction of more power decides.
struct PixelOptions {
  double least_voc_V = 0.05;            // of each cell in series; below it the pixel is shorted
  double resistor_ff_percent = 2;       // a straight line with an FF so near to 25 % is a resistor
  double least_jsc_mA_cm2 = 0.1;        // at 1000 W/m2; below it the pixel is dead. Without an area
                                        // that of 0.1 cm2 counts
  double least_efficiency_percent = 0;  // below it the pixel is weak
};

inline constexpr OptionRow<PixelOptions> kPixelOptionTable[] = {
    OptionRow<PixelOptions>("Working pixels"),
    {"least-voc-V", "V", "a pixel with less Voc for each cell in series is shorted",
     &PixelOptions::least_voc_V, 0.0, 10.0},
    {"resistor-ff", "PERCENT",
     "a pixel is shorted too where its curve is straight and its FF so near to the 25 % of a "
     "resistor",
     &PixelOptions::resistor_ff_percent, 0.0, 25.0},
    {"least-jsc", "MA/CM2", "a pixel with less Jsc at 1000 W/m2 is dead",
     &PixelOptions::least_jsc_mA_cm2, 0.0, 100.0},
    {"least-efficiency", "PERCENT", "a pixel with less efficiency is weak, and does not count",
     &PixelOptions::least_efficiency_percent, 0.0, 100.0},
};

}  // namespace lyrefit
