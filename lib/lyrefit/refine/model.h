#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "lyrefit/law/parameter.h"

namespace lyrefit {

// A parameter as a fit sees it; see ParameterInfo.
struct FitParameter {
  ParameterKind kind = ParameterKind::kPlain;
  double step = 1;
  std::array<int, 2> with = {-1, -1};
  double lower = 0;  // equal: fixed
  double upper = 0;
  // Of a saturation current: may become 0, which takes its diode out with its ideality, and come
  // back where the residuals ask for it.
  bool may_vanish = false;

  bool fixed() const { return lower == upper; }
};

// Residuals that are evaluated together, and how many unknowns nobody else has they depend on.
struct FitBlock {
  int residuals = 0;
  int locals = 0;
};

// What is fitted, and the natural sizes that its coordinates are scaled by.
struct ModelShape {
  std::vector<FitParameter> parameters;
  std::vector<FitBlock> blocks;
  double points = 1;  // that the mean square is over: residuals without those of priors
  double current_scale_A = 1;
  double voltage_scale_V = 1;
  double thermal_voltage_V = 1;  // n times this is how steep a diode of ideality n is

  int size() const { return static_cast<int>(parameters.size()); }
  double resistance_scale() const { return voltage_scale_V / current_scale_A; }
  int locals() const;  // of all blocks
};

// A shunt of resistance_scale() / this is perfect: a number, so that laws can compute with it.
constexpr double kPerfectConductance = 1e-30;

// From infos and bounds, the latter shared with them or longer by further plain parameters.
std::vector<FitParameter> MakeFitParameters(const std::vector<ParameterInfo>& infos,
                                            const std::vector<double>& lower,
                                            const std::vector<double>& upper);

struct FitPoint {
  std::vector<double> p;      // natural parameters
  std::vector<double> local;  // unknowns of the blocks, one block after the other
};

// A bounded least-squares problem: minimise the sum of squares of the residuals of all blocks. It
// knows natural parameters alone; coordinates, active bounds and solver are the engine's.
class FitModel {
 public:
  explicit FitModel(ModelShape shape) : shape_(std::move(shape)) {}
  virtual ~FitModel() = default;

  const ModelShape& shape() const { return shape_; }
  void Fix(int i, double value) { shape_.parameters[i].lower = shape_.parameters[i].upper = value; }

  // Residuals of a block in ampere and, where asked for, their derivatives row by row: `slopes` by
  // all parameters, `local_slopes` by the block's own unknowns (which come zeroed). False where the
  // model cannot be evaluated.
  virtual bool Evaluate(int block, const double* p, const double* local, double* residuals,
                        double* slopes, double* local_slopes) const = 0;

  // Sum of squares over `points`, in A^2; not finite where the model cannot be evaluated.
  virtual double MeanSquare(const FitPoint& point) const;

  // A smaller model with the same parameters that stands for this one when directions are looked
  // for; null: none.
  virtual std::unique_ptr<FitModel> Coarse() const { return nullptr; }

 private:
  ModelShape shape_;
};

}  // namespace lyrefit
