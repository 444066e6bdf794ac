// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <string>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/devices/data_sheet.h"
#include "lyrefit/read/module_sheet.h"

namespace LYREFIT_PUBLIC lyrefit {

// A data sheet as somebody states it: texts as printed, whose digits give the rounding of each
// value, and a module file for what is not stated.
struct StatedSheet {
  std::string file;  // see ReadModuleSheet; empty: none
  std::string isc;
  std::string voc;
  std::string imp;
  std::string vmp;
  std::string alpha;
  std::string beta;
  std::string gamma;
  std::string name;
  std::string technology;
  std::optional<double> EgRef_eV;
  std::optional<double> dEgdT_1_K;
  std::optional<int> cells;
  bool exact = false;
  ConstantSet constants = ConstantSet::kCodata;
};

inline constexpr OptionRow<StatedSheet> kStatedSheetTable[] = {
    OptionRow<StatedSheet>("Data sheet"),
    {"isc", "NUMBER", "short-circuit current in A", &StatedSheet::isc},
    {"voc", "NUMBER", "open-circuit voltage in V", &StatedSheet::voc},
    {"imp", "NUMBER", "current at the maximum power in A", &StatedSheet::imp},
    {"vmp", "NUMBER", "voltage at the maximum power in V", &StatedSheet::vmp},
    {"alpha", "NUMBER", "temperature coefficient of Isc in A/K, or in percent: 0.05%",
     &StatedSheet::alpha},
    {"beta", "NUMBER", "temperature coefficient of Voc in V/K, or in percent: -0.3%",
     &StatedSheet::beta},
    {"gamma", "NUMBER", "temperature coefficient of Pmp in percent per kelvin, only compared",
     &StatedSheet::gamma},
    {"cells", "N", "cells in series", &StatedSheet::cells, 1, 100000,
     OptionTrait::kQuiet | OptionTrait::kNoDefault},
    {"technology", "NAME",
     "of the cells, which sets the band gap: c-Si, HJT, CdTe, CIGS, a-Si, GaAs, perovskite, ...",
     &StatedSheet::technology},
    {"EgRef", "eV",
     "band gap at 25 C of De Soto's law (default: of the technology, 1.121 of silicon)",
     &StatedSheet::EgRef_eV, 0.3, 3.0, OptionTrait::kNoDefault},
    {"dEgdT", "1/K", "its slope with temperature, relative to it", &StatedSheet::dEgdT_1_K, -0.01,
     0.01, OptionTrait::kNoDefault},
    {"exact", "", "the values are not rounded to the digits given", &StatedSheet::exact},
    {"constants", "NAME", "values of k and q", EnumOption<&StatedSheet::constants>()},
    OptionRow<StatedSheet>("Output"),
    {"name", "TEXT", "of the module, for pvlib (default module)", &StatedSheet::name},
};

// A completed sheet and the device that gives its values.
struct FittedSheet {
  ModuleSheet module;
  DataSheetFit fit;
};

// Completes what is stated by the file and finds the device (FitDataSheet). Errors: a value that
// neither states, whose sentence names the option; a text that is no number; those of
// ReadModuleSheet and FitDataSheet.
Expected<FittedSheet> FitStatedSheet(const StatedSheet& stated);

// The parameters as pvlib takes them, with the row of SAM's library. Error: a device that pvlib has
// no parameters for.
Expected<std::string> PvlibText(const FittedSheet& sheet);

}  // namespace lyrefit
