#pragma once

#include <vector>

#include "lyrefit/model/curve_shape.h"
#include "lyrefit/model/reading.h"

namespace lyrefit {

// A guess of where dim cells are, and of how they conduct in reverse.
struct DimPlaces {
  std::vector<int> places;  // the substring of each cell, from 0
  int chains = 1;           // parallel chains of a substring, of which one has the dim cells
  double soft_voltage = 0;  // of the soft reverse law, V
  double exponent = 0;
  double area = 0;  // between the rough curve of the guess and the measured one
};

// Deficits of light from the plateaus of a curve below the first, largest first, at most `most`.
// Without plateaus: from the currents at some places. Half of a single deficit is a second one.
std::vector<double> PlateauDeficits(const CurveShape& shape, int most);

// The guesses whose rough curves are nearest to the measured one, nearest first, at most `most`.
// The rough curve adds the voltages of the cells: a logarithm for a cell whose light suffices, the
// reverse law for others, and a constant drop for a bypass diode. `substrings`: the largest number
// of substrings with dim cells.
std::vector<DimPlaces> GuessDimPlaces(const CurveShape& shape, const DataTraits& traits,
                                      const std::vector<double>& deficits, int substrings,
                                      std::size_t most);

}  // namespace lyrefit
