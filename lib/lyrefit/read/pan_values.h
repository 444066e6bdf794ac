#pragma once

#include <optional>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/read/pan_object.h"

namespace lyrefit {

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

}  // namespace lyrefit
