#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/read/module_sheet.h"
#include "lyrefit/read/read_pvlib.h"

namespace lyrefit {

// Value of one line KEY=VALUE, without blanks around it, and its position from 1.
struct PanEntry {
  std::string key;    // as written
  std::string value;  // as written
  int line = 0;
  int column = 0;
};

// A number to look up: its key, what it is for messages, and its range.
struct PanNumber {
  const char* key;
  const char* what;  // "a current in A"
  double least = -std::numeric_limits<double>::infinity();
  bool above_least = true;  // `least` itself is not allowed
  double most = std::numeric_limits<double>::infinity();
};

// The entries of the module of a PVsyst .PAN file: those of the object pvModule itself and of its
// pvCommercial, without those of other blocks inside (remarks, incidence angles, operating points).
class PanObject {
 public:
  const PanEntry* Find(const std::string& key) const;  // null: no such key; case does not count

  // The text of a key; empty if there is none.
  std::string Text(const std::string& key) const;

  // The number of a key, nullopt if there is none. Errors name the place and what was expected.
  Expected<std::optional<double>> Number(const PanNumber& number) const;
  // Number(), for a key that must be there.
  Expected<double> Required(const PanNumber& number) const;

  // Error at an entry: "expected <expected> in <key>, found '...'".
  tl::unexpected<Error> Refuse(const PanEntry& entry, const std::string& expected) const;

 private:
  friend Expected<PanObject> ParsePan(const std::string& text, const std::string& path);

  std::map<std::string, PanEntry> entries_;  // by key in lower case
  std::string path_;
  int last_line_ = 0;  // of "End of PVObject pvModule"
};

// Whether a text begins as PVsyst's component files do.
bool IsPan(const std::string& text);

// Parses the text of a .PAN file: lines KEY=VALUE in nested blocks, each from PVObject_NAME=TYPE,
// NAME, Count=N or NAME, list of=N to "End of ...". Errors: another component than a module, such
// as an inverter; a key of the module twice; a file that ends within a block. `path` is only used
// in errors.
Expected<PanObject> ParsePan(const std::string& text, const std::string& path);

// Values that the data sheet and the model of a .PAN file share, checked, with errors at their
// place.

// Isc, Imp (A), Voc, Vmp (V). Errors: Imp not below Isc, Vmp not below Voc.
struct PanPoints {
  double isc, voc, imp, vmp;
};
Expected<PanPoints> TakePanPoints(const PanObject& pan);

// NCelS.
Expected<int> TakePanCells(const PanObject& pan);

// Error: GRef or TRef is another reference than 1000 W/m2 and 25 C, which is not supported.
Expected<void> CheckPanReference(const PanObject& pan);

// muISC in A/K.
Expected<double> TakeCurrentTempco(const PanObject& pan, double isc_A);
// muVocSpec in V/K; NaN if it is not stated.
Expected<double> TakeVoltageTempco(const PanObject& pan, double voc_V);
// muPmpReq in %/K; 0 stands for not stated.
Expected<std::optional<double>> TakePowerTempco(const PanObject& pan);

// Manufacturer and model.
std::string NameOfPan(const PanObject& pan);

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
