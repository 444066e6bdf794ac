#pragma once

#include <vector>

#include "lyrefit/base/dense.h"
#include "lyrefit/devices/cell_options.h"
#include "lyrefit/devices/cell_report.h"
#include "lyrefit/estimate/refine/error_model.h"
#include "lyrefit/estimate/refine/model.h"
#include "lyrefit/estimate/refine/spread.h"
#include "lyrefit/model/device.h"
#include "lyrefit/model/kernel.h"

namespace lyrefit {

// One measurement of a cell: a curve under one light or in the dark, or open-circuit voltages over
// light.
struct CellBlock {
  bool open_circuit = false;  // open-circuit voltages over light
  // Pseudo currents of a Suns-Voc trace: the curve of `light` without series resistance, whose
  // photocurrent is that of short circuit at every voltage.
  bool pseudo = false;
  std::vector<double> voltage_V;  // of the readings
  std::vector<double> current_A;  // of the readings; of an open-circuit voltage its stated light
  // Position of the parameter of its light: the photocurrent of a curve, or the factor of the stated
  // lights. -1: in the dark.
  int light = -1;
  double error = 1;     // standard deviation of a reading, A; V of an open-circuit voltage
  bool heated = false;  // by its light: see CellProblem::warmer
};

// Measurements of one cell at one temperature. Parameters: those of the device without its
// photocurrent, which every block shares, then `collection`, then with `contacts` the share of the
// area that is behind a series resistance of its own, and this, then with `warmer` the kelvins by
// which heated blocks are above the others, then the lights. A photocurrent falls
// with the junction voltage by collection that is linear in it, Iph (1 - c Vj) with c = `collection`
// in 1/V. This acts as a shunt of conductance c Iph that is not there in the dark. Both series
// resistances are as if the whole device were behind them: parts of one junction law in parallel.
struct CellProblem {
  Device device;  // one or more diodes, no effects
  bool contacts = false;
  bool warmer = false;
  double temperature_K = 298.15;  // of the blocks that are not heated
  double gap_over_thermal = 0;    // band gap over k T
  std::vector<ParameterInfo> parameters;
  std::vector<double> lower;
  std::vector<double> upper;
  std::vector<CellBlock> blocks;
  double error_A = 1;  // a residual is its deviation in parts of its error, times this

  // Scales of the coordinates.
  double current_scale_A = 1;
  double voltage_scale_V = 1;

  int collection() const { return device.size() - 1; }
  int contact_share() const { return device.size(); }
  int contact_resistance() const { return device.size() + 1; }
  int warmth() const { return first_light() - 1; }
  int first_light() const { return device.size() + (contacts ? 2 : 0) + (warmer ? 1 : 0); }
};

// Parameters of the device under a light that gives this photocurrent, at the temperature of the
// block: n Vt grows with T, and Is as (T^3 exp(-Eg / k T))^(1/n).
std::vector<double> DeviceUnderLight(const CellProblem& problem, const double* p,
                                     double photocurrent_A, bool heated);

// The problem as a model: a block for each measurement, without local unknowns. Residuals of curves
// are of the solved current.
class CellModel : public FitModel {
 public:
  // Keeps a reference to the problem.
  explicit CellModel(const CellProblem& problem);

  bool Evaluate(int block, const double* p, const double* local, double* residuals, double* slopes,
                double* local_slopes) const override;

 private:
  bool EvaluateCurve(int block, const double* p, double* residuals, double* slopes) const;
  void AddContacts(int block, const double* p, std::vector<double> device, double* current,
                   RowMatrix* by_device, double* slopes) const;
  bool EvaluateOpenCircuit(const CellBlock& block, const double* p, double* residuals,
                           double* slopes) const;

  const CellProblem& problem_;
  std::vector<PointSet> points_;  // of each block that is a curve
};

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
  bool warmer = false;        // see CellProblem
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

// Starts with lit sweeps above and below the temperature of the dark one, from a fit at one.
std::vector<std::vector<double>> WarmerStarts(const JointCell& cell,
                                              const std::vector<double>& plain);

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
