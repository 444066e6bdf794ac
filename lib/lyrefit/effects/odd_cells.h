#pragma once

#include <array>
#include <vector>

#include "lyrefit/effects/fitted_effect.h"
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

// A cell in reverse bias while the terminals are shorted.
struct HotCell {
  double voltage_V = 0;  // below 0
  double heat_W = 0;
};

// Of a fitted `weak_cell`, under the brightest light. Defined in weak_cell.cc.
HotCell FindHotCell(const FittedEffect& of);

constexpr EffectParameter kChains =
    Parameter("chains", "chains_side_by_side", "that share a bypass diode: two in half-cut modules")
        .Between(1, 2)
        .From(1)
        .FixedByDefault()
        .AbsentAt(1)
        .Only(Whole::kCount);

// Sets `count` cells of one substring to a light and a leak of their own. Other substrings are
// never in reverse. If all cells are one substring it has no bypass diode. `deficit`: fraction of
// the substring's light that is missing because of these cells. `chains`: parallel chains of a
// substring (1 or 2), of which one is affected. Its cells are dark if the deficit exceeds their
// light.
template <class S>
void SetOddCells(const S& count, const S& deficit, const S& leak, const S& chains, Cell<S>* cell) {
  const double mates = cell->substring_cells < cell->cells ? cell->substring_cells : cell->cells;
  const S odd = count * (1 / cell->cells);
  const double elsewhere = 1 - mates / cell->cells;
  const bool bypassed = elsewhere > 1e-9;
  cell->group[0] = {mates / cell->cells - odd, S(1.0), S(0.0), 0};
  constexpr double kDark = 1e-3;
  const S light = 1.0 - deficit * chains;
  cell->group[1] = {odd, Choose(ValueOf(light) < kDark, S(kDark), light), leak * chains, 0};
  cell->substring[0] = {bypassed, mates, 0};
  cell->groups = 2;
  cell->substrings = 1;
  if (bypassed) {
    cell->group[cell->groups++] = {S(elsewhere), S(1.0), S(0.0), 1};
    cell->substring[cell->substrings++] = {false, mates, 0};
  }
  if (ValueOf(chains)[0] < 1.5) return;  // all lanes have the same parameters
  cell->substring[0].parallel = true;
  cell->group[cell->groups++] = {odd, S(1.0), S(0.0), 0, true};
}

// Shares of the cells in three substrings, the brightest first.
using ThreeShares = std::array<double, 3>;

// Modules of three substrings whose middle one has half of all cells (24, 48 and 24): the orders of
// brightness that explain the steps of a curve better than three equal substrings do, or less well
// by `nearly` at most, in parts of the voltage. Empty for other data.
std::vector<ThreeShares> UnlikeShares(const CurveShape& shape, const DataTraits& traits,
                                      double nearly = 0);

// A step is placed no better than this.
inline constexpr double kStepPlaced = 0.03;

}  // namespace lyrefit
