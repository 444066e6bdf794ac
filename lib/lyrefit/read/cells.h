#pragma once

#include <string>
#include <vector>

#include "lyrefit/curve/curve_set.h"

namespace lyrefit {

// What a curve without photocurrent is, whose file does not say that it is dark.
enum class UnstatedDark {
  kDark,  // the dark curve of a cell
  kDead,  // a cell of its own, which is dead or shorted
};

// Whether two curves of one file are lit curves under one light (within 2 %): several cells.
bool HoldsSeveralCells(const CurveSet& set, UnstatedDark unstated);

// The device in the name of a curve, without the words of light, direction and quantity: "a" for
// "a dark" and for "a_Forward_Light J (mA/cm2)". Empty: the name has such words only.
std::string CellOfCurve(const std::string& name);

// The curves of one cell.
struct CellCurves {
  std::string name;             // CellOfCurve() of each of its curves
  std::vector<IvCurve> curves;  // the brightest first, the others in the order of the file
};

// Splits the curves of a file into cells: those of one CellOfCurve() belong together. A file that
// does not hold several cells (kDead) is one.
std::vector<CellCurves> SplitIntoCells(CurveSet set);

// Error that lists the cells of a set that holds several. `each`: the command that takes them all.
Expected<void> CheckIsOneCell(const CurveSet& set, const char* each);

// Sample that the cell with this id of a batch belongs to. `where` is the place of the cell in the
// input (BatchItem::where). From the last level of the id a pixel at its end is taken off, with the
// mark in front of it (one of "_-. "): a letter, a number of at most two digits, or one of them after
// "px", "pix", "pixel", "p", "cell" or "dev", as in "batch7/ox3_px2". Where the last level is nothing
// but a pixel, the sample is the level above. Where it names no pixel, a file of one cell is its own
// sample, and the cells of a file of several belong to the file.
std::string SampleOfCell(const std::string& id, const std::string& where);

}  // namespace lyrefit
