#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "lyrefit/model/parameter.h"

namespace lyrefit {

// A parameter of a fit; see ParameterInfo.
struct FitParameter {
  ParameterKind kind = ParameterKind::kPlain;
  double step = 1;
  std::array<int, 2> with = {-1, -1};
  double lower = 0;  // equal: fixed
  double upper = 0;
  // Saturation currents only: the value 0 is allowed and drops the diode with its ideality. The
  // diode is added again if it lowers the sum of squares.
  bool may_vanish = false;

  bool fixed() const { return lower == upper; }
};

// Residuals that are evaluated together, and the number of unknowns that only they depend on.
struct FitBlock {
  int residuals = 0;
  int locals = 0;
};

// Parameters and residual blocks of a model, and the scales of its coordinates.
struct ModelShape {
  std::vector<FitParameter> parameters;
  std::vector<FitBlock> blocks;
  double points = 1;  // divisor of the mean square: residuals without those of priors
  double current_scale_A = 1;
  double voltage_scale_V = 1;
  double forward_A = 0;          // at voltage_scale_V, if above what the device delivers
  double thermal_voltage_V = 1;  // n times this is the voltage scale of a diode of ideality n

  int size() const { return static_cast<int>(parameters.size()); }
  double resistance_scale() const { return voltage_scale_V / current_scale_A; }
  int locals() const;  // of all blocks
  // The diodes' own voltage at voltage_scale_V: what the series resistance of `p` leaves of it, at
  // least thermal_voltage_V.
  double junction_V(const std::vector<double>& p) const;
};

// A shunt of resistance_scale() / this counts as perfect; finite, so that the equations can compute
// with it.
constexpr double kPerfectConductance = 1e-30;

// From infos and bounds. Bounds beyond the infos belong to further plain parameters.
std::vector<FitParameter> MakeFitParameters(const std::vector<ParameterInfo>& infos,
                                            const std::vector<double>& lower,
                                            const std::vector<double>& upper);

// Sets blocks of these numbers of readings, without local unknowns.
void SetBlocks(const std::vector<int>& readings, ModelShape* shape);

// Sets the parameters. The upper bounds of free shunts are at most a perfect one in the shape's
// scales.
void SetParameters(const std::vector<ParameterInfo>& infos, const std::vector<double>& lower,
                   const std::vector<double>& upper, ModelShape* shape);

struct FitPoint {
  std::vector<double> p;      // natural parameters
  std::vector<double> local;  // unknowns of the blocks, one block after the other
};

// A bounded least-squares problem: minimise the sum of squares of the residuals of all blocks. Has
// only natural parameters; coordinates, active bounds and solver belong to RefineModel.
class FitModel {
 public:
  explicit FitModel(ModelShape shape) : shape_(std::move(shape)) {}
  virtual ~FitModel() = default;

  const ModelShape& shape() const { return shape_; }
  void Fix(int i, double value) { shape_.parameters[i].lower = shape_.parameters[i].upper = value; }

  // Residuals of a block in ampere and, if requested, their derivatives row by row: `slopes` by all
  // parameters, `local_slopes` by the block's local unknowns (zeroed before the call). False if the
  // model cannot be evaluated.
  virtual bool Evaluate(int block, const double* p, const double* local, double* residuals,
                        double* slopes, double* local_slopes) const = 0;

  // Sum of squares over `points`, in A^2; not finite if the model cannot be evaluated. Local unknowns
  // that the point lacks are 0.
  virtual double MeanSquare(const FitPoint& point) const;

  // A coarsened model with equal parameters, for scanning search directions; null: none.
  virtual std::unique_ptr<FitModel> Coarse() const { return nullptr; }

 private:
  ModelShape shape_;
};

}  // namespace lyrefit
