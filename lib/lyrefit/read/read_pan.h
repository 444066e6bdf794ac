#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/read/module_sheet.h"
#include "lyrefit/read/read_pvlib.h"

namespace lyrefit {

// Reads the electrical model of a PVsyst .PAN file, given as UTF-8 text: PVsyst's law with the
// exponential shunt, and the recombination loss of thin films where D2MuTau is above 0. Sizes,
// incidence angles (IAM), bypass diodes, relative efficiencies and limits are left out. The file's
// keys and units, of the whole module except Gamma:
//
//   NCelS; GRef = 1000 W/m2 and TRef = 25 C; Isc and Imp (A), Voc and Vmp (V)
//   RSerie, RShunt at GRef, Rp_0 in the dark (ohm), Rp_Exp (5.5 where it is missing)
//   Gamma: ideality at TRef; muGamma (1/K); muISC (mA/K); D2MuTau (V)
//
// A file states no photocurrent and no saturation current. They follow from Isc and Voc (Mermoud
// and Lejeune 2010, "Performance assessment of a simulation model for PV modules of any available
// technology"; Sauer, Roessler and Hansen 2015, doi:10.1109/JPHOTOV.2014.2364133), two linear
// equations with a = NCelS Gamma k TRef / q and r(V) = D2MuTau / (NsVbi - V):
//
//   Isc = I_L (1 - r(Isc RSerie)) - I_o (exp(Isc RSerie / a) - 1) - Isc RSerie / RShunt
//   0   = I_L (1 - r(Voc))        - I_o (exp(Voc / a) - 1)        - Voc / RShunt
//
// The technology (Technol) gives EgRef and NsVbi: see curve/technology.h; an unknown one counts as
// silicon, with a warning. Further warnings: Pmp differs from Imp Vmp by more than 1 %, or its
// temperature coefficient from muPmpReq by more than 0.05 %/K; a muISC so small that it is likely
// in percent. Errors, with line and column: a missing key; a value that is no number or that no
// module has (a TRef in kelvin, a muISC in uA/K); a shunt that pvlib cuts off at 0 ohm.
Expected<NamedParameters> ReadPanParameters(const std::string& text, const std::string& path);

// Reads what the data sheet behind a .PAN file prints: Isc, Voc, Imp, Vmp, muISC, muVocSpec (mV/K;
// 0 stands for not stated: that of the file's own model), muPmpReq (%/K), PNom (W), NCelS. Errors: as for ReadPanParameters, of
// these keys alone.
Expected<ModuleSheet> ReadPanSheet(const std::string& text, const std::string& path);

}  // namespace lyrefit
