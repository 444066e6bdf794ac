#include "lyrefit/estimate/refine/linearize.h"

#include <algorithm>

#include "lyrefit/estimate/refine/finite.h"

namespace lyrefit {

bool EvaluateBlock(const FitModel& model, const Coordinates& coordinates, int block,
                   const double* theta, const double* local, double unit_A, double* residuals,
                   double* slopes, double* local_slopes) {
  if (!coordinates.Sane(theta)) return false;
  const ModelShape& shape = model.shape();
  const std::size_t rows = shape.blocks[block].residuals, count = shape.size();
  const std::size_t locals = shape.blocks[block].locals, moving = coordinates.size();
  std::vector<double> p(count);
  std::vector<double> natural(slopes != nullptr ? rows * count : 0);
  coordinates.ToParameters(theta, p.data());
  if (local_slopes != nullptr) std::fill(local_slopes, local_slopes + rows * locals, 0.0);
  if (!model.Evaluate(block, p.data(), local, residuals,
                      slopes != nullptr ? natural.data() : nullptr, local_slopes)) {
    return false;
  }
  const double scale = 1 / unit_A;
  for (std::size_t r = 0; r < rows; ++r) residuals[r] *= scale;
  if (!AllFinite(residuals, rows)) return false;
  if (local_slopes != nullptr) {
    for (std::size_t k = 0; k < rows * locals; ++k) local_slopes[k] *= scale;
    if (!AllFinite(local_slopes, rows * locals)) return false;
  }
  if (slopes == nullptr) return true;
  std::fill(slopes, slopes + rows * moving, 0.0);
  const std::vector<Coordinates::Slope> chain = coordinates.Slopes(p.data());
  for (std::size_t r = 0; r < rows; ++r) {
    const double* from = natural.data() + r * count;
    double* to = slopes + r * moving;
    for (const Coordinates::Slope& link : chain) {
      to[link.coordinate] += from[link.parameter] * (link.value * scale);
    }
  }
  return AllFinite(slopes, rows * moving);
}

Linearization Linearize(const FitModel& model, const FitPoint& point,
                        const std::vector<bool>& active) {
  const ModelShape& shape = model.shape();
  const Coordinates coordinates(shape, point.p, active);
  const std::vector<double> theta = coordinates.Start();
  const int moving = coordinates.size();
  Linearization now;
  int rows = 0;
  for (const FitBlock& block : shape.blocks) {
    now.first_row.push_back(rows);
    rows += block.residuals;
  }
  now.residual.setZero(rows);
  now.jacobian.setZero(rows, moving);
  const double* local = point.local.data();
  for (std::size_t b = 0; b < shape.blocks.size(); ++b) {
    const FitBlock& block = shape.blocks[b];
    const int first = now.first_row[b];
    now.local.push_back(RowMatrix::Zero(block.residuals, block.locals));
    double* slopes = now.jacobian.data() + static_cast<std::ptrdiff_t>(first) * moving;
    if (!EvaluateBlock(model, coordinates, static_cast<int>(b), theta.data(), local, 1.0,
                       now.residual.data() + first, slopes, now.local.back().data())) {
      now.residual.segment(first, block.residuals).setZero();
      now.jacobian.middleRows(first, block.residuals).setZero();
      now.local.back().setZero();
    }
    local += block.locals;
  }
  for (int k = 0; k < moving; ++k) now.parameter.push_back(coordinates.parameter(k));
  std::vector<double> p(shape.size());
  coordinates.ToParameters(theta.data(), p.data());
  now.natural_slope = Eigen::MatrixXd::Zero(shape.size(), moving);
  for (const Coordinates::Slope& link : coordinates.Slopes(p.data())) {
    now.natural_slope(link.parameter, link.coordinate) = link.value;
  }
  return now;
}

}  // namespace lyrefit
