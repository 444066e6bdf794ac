#include "lyrefit/model/plain_stage.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/model/cell.h"

namespace lyrefit {
namespace {

constexpr double kStep = 1e-4;
constexpr double kLeastPart = 1e-3;  // of a parameter's range: the smallest size used for its step

// Five-point difference formula: places in steps from the point of the derivative, and their
// weights.
struct Stencil {
  double place[5];
  double weight[5];
};
constexpr Stencil kCentral = {{-2, -1, 0, 1, 2}, {1 / 12.0, -2 / 3.0, 0, 2 / 3.0, -1 / 12.0}};
constexpr Stencil kForward = {{0, 1, 2, 3, 4}, {-25 / 12.0, 4, -3, 4 / 3.0, -1 / 4.0}};
constexpr Stencil kBackward = {{0, -1, -2, -3, -4}, {25 / 12.0, -4, 3, -4 / 3.0, 1 / 4.0}};

// Evaluates a stage at all five places along one of its input arrays, in one call of 5 x count
// readings.
class Widened {
 public:
  explicit Widened(const StageInput& input) : input_(input) {}

  void Differentiate(const PlainValue& stage, const double* StageInput::*along,
                     double* derivative) {
    const int count = input_.count;
    StageInput wide = input_;
    wide.count = 5 * count;
    wide.x = Repeat(input_.x, &x_);
    wide.photocurrent = Repeat(input_.photocurrent, &photocurrent_);
    wide.thermal_voltage = Repeat(input_.thermal_voltage, &thermal_voltage_);
    moved_.resize(5 * count);
    std::vector<double> steps(count);
    for (int i = 0; i < count; ++i) {
      const double at = (input_.*along)[i];
      steps[i] = kStep * std::max(std::fabs(at), Least(along));
      for (int k = 0; k < 5; ++k) moved_[k * count + i] = at + kCentral.place[k] * steps[i];
    }
    wide.*along = moved_.data();
    values_.resize(5 * count);
    stage(wide, values_.data());
    for (int i = 0; i < count; ++i) {
      derivative[i] = 0;
      for (const int k : {0, 1, 3, 4}) {
        derivative[i] += kCentral.weight[k] * values_[k * count + i] / steps[i];
      }
    }
  }

 private:
  // The smallest size used for a step: 1 V or current scale; thermal voltages are never near 0.
  static double Least(const double* StageInput::*along) {
    return along == &StageInput::thermal_voltage ? 0 : 1;
  }
  const double* Repeat(const double* from, std::vector<double>* to) const {
    to->clear();
    for (int k = 0; k < 5; ++k) to->insert(to->end(), from, from + input_.count);
    return to->data();
  }

  const StageInput& input_;
  std::vector<double> x_, photocurrent_, thermal_voltage_, moved_, values_;
};

const Stencil& StencilInside(double at, double step, const std::pair<double, double>& range) {
  if (at - 2 * step < range.first) return kForward;
  return at + 2 * step > range.second ? kBackward : kCentral;
}

void DifferentiateByParameter(const PlainValue& stage, const StageInput& input, int parameter,
                              const std::pair<double, double>& range, double* derivative) {
  std::vector<double> p(input.p, input.p + input.parameters);
  const double at = p[parameter];
  const double width = range.second - range.first;
  const double least = std::isfinite(width) ? kLeastPart * width : kLeastPart;
  const double step = kStep * std::max(std::fabs(at), least);
  const Stencil& stencil = StencilInside(at, step, range);
  StageInput moved = input;
  moved.p = p.data();
  std::vector<double> values(input.count);
  std::fill(derivative, derivative + input.count, 0.0);
  for (int k = 0; k < 5; ++k) {
    if (stencil.weight[k] == 0) continue;
    p[parameter] = at + stencil.place[k] * step;
    stage(moved, values.data());
    for (int i = 0; i < input.count; ++i) derivative[i] += stencil.weight[k] * values[i] / step;
  }
}

}  // namespace

void CallPlainStage(const PlainStage& stage, int parameters, double reach, double cells, bool all,
                    StageBlocks* blocks) {
  StageInput input;
  input.count = Block::kLanes;
  input.x = blocks->x.lane;
  input.photocurrent = blocks->photocurrent.lane;
  input.thermal_voltage = blocks->thermal_voltage.lane;
  input.p = blocks->p;
  input.parameters = parameters;
  input.reach = reach;
  input.cells = cells;
  StageOutput output;
  output.value = blocks->value.lane;
  output.by_x = blocks->by_x.lane;
  if (all) {
    output.by_photocurrent = blocks->by_photocurrent.lane;
    output.by_thermal_voltage = blocks->by_thermal_voltage.lane;
    output.by_p = blocks->by_p[0].lane;
  }
  stage(input, output);
}

PlainStage WithDifferences(PlainValue stage, std::vector<std::pair<double, double>> ranges,
                           bool under_conditions) {
  return [stage = std::move(stage), ranges = std::move(ranges), under_conditions](
             const StageInput& input, const StageOutput& output) {
    stage(input, output.value);
    Widened widened(input);
    if (output.by_x != nullptr) widened.Differentiate(stage, &StageInput::x, output.by_x);
    if (output.by_p == nullptr) return;
    if (under_conditions) {
      widened.Differentiate(stage, &StageInput::photocurrent, output.by_photocurrent);
      widened.Differentiate(stage, &StageInput::thermal_voltage, output.by_thermal_voltage);
    } else {
      std::fill(output.by_photocurrent, output.by_photocurrent + input.count, 0.0);
      std::fill(output.by_thermal_voltage, output.by_thermal_voltage + input.count, 0.0);
    }
    for (int k = 0; k < input.parameters; ++k) {
      DifferentiateByParameter(stage, input, k, ranges[k], output.by_p + k * input.count);
    }
  };
}

}  // namespace lyrefit
