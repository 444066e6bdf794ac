#pragma once

#include <string>

#include "lyrefit/base/numbers.h"

namespace lyrefit {

// What is usual of the coefficients of a technology's data sheets, in percent per kelvin, with their
// standard deviations among modules; NaN: no such sheets are known.
struct SheetCoefficients {
  double alpha_percent_K = kUnknown;  // of Isc
  double alpha_scatter = kUnknown;
  double beta_percent_K = kUnknown;  // of Voc
  double beta_scatter = kUnknown;
  double gamma_percent_K = kUnknown;  // of Pmax
};

// What a technology sets of a solar cell. Voltages are at 25 C and 1000 W/m2.
struct Technology {
  const char* name;
  const char* words;  // parts of its spellings, lower case, between '|'; "a+b": both
  bool silicon;       // wafers of crystalline silicon
  int junctions;      // in series in a cell
  // Of De Soto's law, which takes the gap of one junction (of several: their mean), and its slope
  // relative to the gap at 25 C.
  double bandgap_eV;
  double bandgap_slope_per_K;
  double most_ideality;  // of a cell without a fault, of each junction
  double most_Voc_V;     // of a cell with all its junctions
  // PVsyst's name and band gap of each junction; its law takes the sum. Null: it has no name.
  const char* pvsyst_name;
  double pvsyst_gap_eV;
  SheetCoefficients sheets = {};
  double narrowest_gap_eV = kUnknown;  // of the alloys in use; unknown: it is no alloy
  double widest_gap_eV = kUnknown;

  double pvsyst_bandgap_eV() const { return junctions * pvsyst_gap_eV; }
};

// The technology that a text names: "Mono-c-Si", "mtCdTe", "CIGS", "GaAs", "triple junction"; null
// if none is known. Case does not count.
const Technology* FindTechnology(const std::string& text);

// Crystalline silicon: what is assumed where no technology is stated.
const Technology& Silicon();

// The highest open-circuit voltage of a cell of the technology. It moves with the temperature as far
// as the gap lets it, and with the light by k T / q a junction for a factor of e.
double HighestVoc_V(const Technology& technology, double temperature_K, double suns);

// A sentence's list of the names that FindTechnology knows: "c-Si, PERC, ...".
std::string TechnologyNames();

}  // namespace lyrefit
