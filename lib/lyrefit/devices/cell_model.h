#pragma once

#include <vector>

#include "lyrefit/base/dense.h"
#include "lyrefit/estimate/refine/model.h"
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
  double error = 1;  // standard deviation of a reading, A; V of an open-circuit voltage
};

// Measurements of one cell at one temperature. Parameters: those of the device without its
// photocurrent, which every block shares, then `collection`, then with `contacts` the share of the
// area that is behind a series resistance of its own, and this, then the lights. A photocurrent falls
// with the junction voltage by collection that is linear in it, Iph (1 - c Vj) with c = `collection`
// in 1/V. This acts as a shunt of conductance c Iph that is not there in the dark. Both series
// resistances are as if the whole device were behind them: parts of one junction law in parallel.
struct CellProblem {
  Device device;  // one or more diodes, no effects
  bool contacts = false;
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
  int first_light() const { return device.size() + (contacts ? 2 : 0); }
};

// Parameters of the device under a light that gives this photocurrent.
std::vector<double> DeviceUnderLight(const CellProblem& problem, const double* p,
                                     double photocurrent_A);

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

}  // namespace lyrefit
