#include "lyrefit/certify/cause_dual_gain.h"

#include <algorithm>

namespace lyrefit {
namespace {

// Largest strength in a model that the dual gain allows, for every theta of the span. At the
// voltage of the dual gain the current of the cause counts as a shunt current.
double LargestStrength(const CauseShape& shape, Span theta, const DualGain& dual_gain) {
  const double least = std::min(shape.value(dual_gain.voltage_V, theta.lower),
                                shape.value(dual_gain.voltage_V, theta.upper));
  return least > 0 ? std::min(dual_gain.current_A / least, shape.strongest_A) : shape.strongest_A;
}

// Adds the gain of one shape over its span. All theta of a mixture together have at most the
// largest strength.
void AddShape(const MixtureData& data, const CauseShape& shape, Span theta, const Mixture& a,
              const Mixture& b, const DualGain& dual_gain, CauseGain* gain) {
  const double largest = LargestStrength(shape, theta, dual_gain);
  const Eigen::VectorXd v0 = data.JunctionVoltage(a.rs), v1 = data.JunctionVoltage(b.rs);
  const Eigen::VectorXd z0 = data.weight.cwiseProduct(a.y), z1 = data.weight.cwiseProduct(b.y);
  const ShapePull at_a = BoundPull(shape, theta, v0, z0), at_b = BoundPull(shape, theta, v1, z1);
  const double pull_a = at_a.ends + at_a.bulge, pull_b = at_b.ends + at_b.bulge;
  gain->at_a += largest * std::max(pull_a, 0.0);
  gain->at_b += largest * std::max(pull_b, 0.0);
  if (!(b.rs > a.rs)) return;
  const double rise = std::max(BoundRise(shape, theta, v0, v1, z0, z1), 0.0);
  if (std::max(pull_a, pull_b) + 0.125 * rise > 0) gain->bend += largest * rise;
}

}  // namespace

CauseGain CauseDualGains(const MixtureData& data, const Mixture& a, const Mixture& b,
                         const DualGain& dual_gain) {
  CauseGain gain;
  const std::vector<LinearTerm>& terms = data.terms;
  for (std::size_t first = 0; first < terms.size(); ++first) {
    if (terms[first].shape == nullptr) continue;
    std::size_t last = first;
    while (last + 1 < terms.size() && terms[last + 1].shape == terms[first].shape) ++last;
    AddShape(data, *terms[first].shape, {terms[first].theta, terms[last].theta}, a, b, dual_gain,
             &gain);
    first = last;
  }
  return gain;
}

}  // namespace lyrefit
