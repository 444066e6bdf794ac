#pragma once

namespace lyrefit {

// For Effect::covered. The cells of a share of the module, the share of them among the cells that
// work while group `which` of `groups` equal ones is covered; they begin in the group `first`.
double ShareLeft(double share, int which, int groups, int first = 0);

// Of an effect that sits in the first group alone.
bool GoneWithTheFirst(double* p, int which, int groups);

// Of one whose second parameter is the share of the cells it has.
bool SecondIsShare(double* p, int which, int groups);

}  // namespace lyrefit
