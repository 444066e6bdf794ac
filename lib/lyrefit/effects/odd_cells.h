#pragma once

#include "lyrefit/law/effect.h"

namespace lyrefit {

// A few cells of one substring have a light and a leak of their own. Other substrings are never in
// reverse; where all cells are one substring it has no bypass diode.
template <class S>
void SetOddCells(const S& count, const S& light, const S& leak, Cell<S>* cell) {
  const double mates = cell->substring_cells < cell->cells ? cell->substring_cells : cell->cells;
  const S odd = count * (1 / cell->cells);
  const double elsewhere = 1 - mates / cell->cells;
  const bool bypassed = elsewhere > 1e-9;
  cell->kind[0] = {mates / cell->cells - odd, S(1.0), S(0.0), 0};
  cell->kind[1] = {odd, light, leak, 0};
  cell->part[0] = {bypassed, mates, 0};
  cell->kinds = 2;
  cell->parts = 1;
  if (!bypassed) return;
  cell->kind[2] = {S(elsewhere), S(1.0), S(0.0), 1};
  cell->part[1] = {false, mates, 0};
  cell->kinds = 3;
  cell->parts = 2;
}

}  // namespace lyrefit
