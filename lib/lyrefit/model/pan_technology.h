#pragma once

#include <optional>
#include <string>

#include "lyrefit/model/default_values.h"

namespace lyrefit {

// What PVsyst's law takes from the technology of a module, since its .PAN file states neither: the
// band gap and, for the recombination loss, the built-in voltage.
struct PanTechnology {
  const char* word;        // in Technol, lower case: "cdte" of mtCdTe
  const char* technol;     // Technol in a file that is written; null: the word alone decides none
  double junction_gap_eV;  // of each junction
  int junctions = 1;       // in series in a cell; as JunctionsPerCell
  double bandgap_eV() const { return junctions * junction_gap_eV; }
  // Of a cell: about 0.9 V for each junction (Merten et al. 1998, doi:10.1109/16.661229).
  double built_in_V() const { return junctions * kDefaultBuiltIn_V; }
};

// The first whose word is in the text is meant. PVsyst's gaps are 1.12 eV for crystalline silicon,
// 1.03 for CIS, 1.5 for CdTe and 1.7 for amorphous silicon (help of PVsyst, "PV module, standard
// one-diode model"). For cells of several junctions, the sum of their gaps and built-in voltages
// reproduces the Pmp and muPmpReq of published files.
inline constexpr PanTechnology kPanTechnologies[] = {
    {"hit", "mtHIT", 1.12},
    {"hjt", "mtHIT", 1.12},
    {"ucsi_asi", "mtuCSi_aSiH", 1.7, 2},  // micromorphous tandem
    {"tandem", nullptr, 1.7, 2},
    {"trip", nullptr, 1.7, 3},
    {"asi", nullptr, 1.7},
    {"a-si", nullptr, 1.7},
    {"amorph", nullptr, 1.7},
    {"cdte", "mtCdTe", 1.5},
    {"cadmium", "mtCdTe", 1.5},
    {"cis", "mtCIS", 1.03},
    {"cigs", "mtCIS", 1.03},
    {"copper indium", "mtCIS", 1.03},
    {"poly", "mtSiPoly", 1.12},
    {"multi", "mtSiPoly", 1.12},
    {"si", "mtSiMono", 1.12},
};

// The technology that a text names; nullopt if none.
std::optional<PanTechnology> FindPanTechnology(const std::string& text);

}  // namespace lyrefit
