#pragma once

namespace lyrefit {

// Helpers for Effect::covered. `groups`: number of bypass groups, all of the same number of cells.
// `which`: the covered group, from 0.
// ShareLeft converts `share`, the fraction of all cells that an effect concerns, to the fraction of
// the cells that are not covered. The cells concerned begin in group `first`.
double ShareLeft(double share, int which, int groups, int first = 0);

// For an effect in the first group only: false if that group is covered.
bool GoneWithTheFirst(double* p, int which, int groups);

// For an effect whose second parameter is its share of the cells: false if no such cell is left.
bool SecondIsShare(double* p, int which, int groups);

}  // namespace lyrefit
