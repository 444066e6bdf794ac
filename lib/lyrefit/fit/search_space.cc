#include "lyrefit/fit/search_space.h"

#include <cmath>

#include "lyrefit/base/portable_exp.h"

namespace lyrefit {

SearchSpace::SearchSpace(const std::vector<ParameterBounds>& bounds,
                         const std::vector<double>& fixed)
    : fixed_(fixed) {
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (!std::isnan(fixed[i])) continue;
    const ParameterBounds& b = bounds[i];
    const bool log_scale = b.scale == SearchScale::kLog && b.search_lower > 0;
    parameter_.push_back(static_cast<int>(i));
    log_base_.push_back(log_scale ? b.search_lower : 0);
    box_.lower.push_back(log_scale ? 0 : b.search_lower);
    box_.upper.push_back(log_scale ? std::log(b.search_upper / b.search_lower) : b.search_upper);
  }
}

void SearchSpace::ToParameters(const double* x, double* p) const {
  for (std::size_t i = 0; i < fixed_.size(); ++i) p[i] = fixed_[i];
  for (std::size_t k = 0; k < parameter_.size(); ++k) {
    p[parameter_[k]] = log_base_[k] > 0 ? log_base_[k] * PortableExp(x[k]) : x[k];
  }
}

}  // namespace lyrefit
