// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/model/translation.h"

namespace LYREFIT_PUBLIC lyrefit {

// What a .PAN file says of a module beside its electrical model.
struct PanNotes {
  std::string name;          // of the model
  std::string manufacturer;  // may be empty
  std::string technology;    // "mtSiMono", "Mono-c-Si", "CdTe"; empty: the one of the band gap
  std::optional<int> bypass_diodes;  // of the module
};

// Notes from those of a measured curve.
PanNotes NotesOf(const std::string& name, const DeviceNotes& device);

// The band gap in eV that a .PAN file implies by the technology; of silicon if that is unknown.
double PanBandgap_eV(const std::string& technology);

// The text of a PVsyst .PAN file with the electrical model of a device and nothing else, which its
// remarks say: no sizes, incidence angles, limits or prices. ReadPanParameters gives the same
// curves, to 1e-9 of Isc. Isc, Voc, Imp and Vmp are those of the model at 1000 W/m2 and 25 C, PNom
// is their power; muISC is alpha_sc (mA/K), muVocSpec (mV/K) and muPmpReq (%/K) are the model's.
// Written as PVsyst 6.8 does, in UTF-8 with CR LF; not tried in PVsyst itself. Errors: those of
// PvlibParameters; a law other than PVsyst's; a band gap that is not that of the technology
// (curve/technology.h), which such a file cannot state; a built-in voltage that it cannot state; a
// device that gives no power.
Expected<std::string> PanText(const Translation& translation, const std::vector<double>& shared,
                              const PanNotes& notes);

}  // namespace lyrefit
