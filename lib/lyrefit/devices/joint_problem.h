#pragma once

#include <vector>

#include "lyrefit/devices/cell_model.h"
#include "lyrefit/devices/cell_options.h"
#include "lyrefit/devices/cell_report.h"
#include "lyrefit/estimate/refine/error_model.h"
#include "lyrefit/estimate/refine/spread.h"

namespace lyrefit {

// The measurements of a cell as blocks of one problem.
struct JointCell {
  CellProblem problem;
  std::vector<int> sweep;           // of each block, index into CellReport::sweeps
  std::vector<double> noise;        // of a reading of each block, from second differences
  std::vector<double> least_error;  // of a reading of each block
  double isc_A = 0;                 // of the brightest curve; in the dark the largest current
  double voc_V = 0;  // of the brightest curve; where it is not reached the largest voltage
};

// Isc of a lit sweep, photocurrent of a Suns-Voc trace. Of a lit one that begins above 0 V, but below half of its largest voltage, its largest
// current; NaN of others.
double IscOfSweep(const CellSweep& sweep);

// What the device has beside one diode.
struct JointKind {
  bool second_diode = false;  // of n = 2
  bool contacts = false;      // see CellProblem
};

// Blocks of the lit sweeps `lights` (indices, the brightest first), of `dark` (-1: none) and of all
// Suns-Voc traces.
JointCell MakeJointCell(const CellReport& report, const std::vector<int>& lights, int dark,
                        const CellOptions& options, const JointKind& kind);

// Places to start the fit from: parameters of single fits, with the conductance at short circuit as
// a shunt or as collection.
std::vector<std::vector<double>> JointStarts(const JointCell& cell, const CellReport& report);

// Starts with a second diode that takes a part of the current of the only one of `single`.
std::vector<std::vector<double>> SecondDiodeStarts(const JointCell& cell,
                                                   const std::vector<double>& single);

// Starts with a part of the area behind a resistance of its own, from a fit without.
std::vector<std::vector<double>> ContactStarts(const JointCell& cell,
                                               const std::vector<double>& plain);

// Root mean square of the residuals of each block, in A or V.
std::vector<double> RmsOfBlocks(const CellProblem& problem, const std::vector<double>& p);

// Errors of each block's residuals at the end of a fit: independent ones, and those that neighbours
// share because the model departs from the cell or the light wandered.
std::vector<ErrorModel> FindBlockErrors(const JointCell& cell, const std::vector<double>& p);

// FindSpread of the problem under these errors. `active`: parameters that count as known.
Spread SpreadUnderErrors(const CellProblem& problem, const FitPoint& end,
                         const std::vector<bool>& active, const std::vector<ErrorModel>& errors);

// The problem without block `block`.
CellProblem Without(CellProblem problem, int block);

}  // namespace lyrefit
