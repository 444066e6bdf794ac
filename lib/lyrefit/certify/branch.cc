#include "lyrefit/certify/branch.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <queue>

#include "lyrefit/base/numbers.h"
#include "lyrefit/certify/correlation.h"

namespace lyrefit {
namespace {

// An RMSE below this part of the largest current is rounding.
constexpr double kRounding = 1e-14;
// Generations of parts that are tried although better solutions at their ends are all they lack.
constexpr int kMostStuck = 3;

using MixturePtr = std::shared_ptr<const Mixture>;

// A part of the region: Rs between the two solutions, one window for each diode (one in all where
// any number of diodes is allowed).
struct Part {
  MixturePtr left, right;
  std::vector<Window> windows;
  double lower = 0;
  double ends = 0;  // dual value at the two ends alone
  int stuck = 0;    // generations for which only rounding has kept the part from being settled
};

struct LowerFirst {
  bool operator()(const Part& a, const Part& b) const {
    if (a.lower != b.lower) return a.lower > b.lower;
    return a.right->rs - a.left->rs < b.right->rs - b.left->rs;  // the widest of equals
  }
};

// Windows of several diodes may overlap; a mixture needs them disjoint.
std::vector<Window> Union(std::vector<Window> windows) {
  std::sort(windows.begin(), windows.end(),
            [](const Window& a, const Window& b) { return a.lower < b.lower; });
  std::vector<Window> merged;
  for (const Window& window : windows) {
    if (!merged.empty() && window.lower <= merged.back().upper) {
      merged.back().upper = std::max(merged.back().upper, window.upper);
    } else {
      merged.push_back(window);
    }
  }
  return merged;
}

class Branch {
 public:
  Branch(const MixtureData& data, const BranchLimits& limits, int diodes, double primal)
      : data_(data), limits_(limits), diodes_(diodes), primal_(primal) {}

  BranchEnd Run(const std::vector<Window>& windows) {
    end_.best.primal = kInfinity;
    Part whole;
    whole.windows = windows;
    whole.left = Solve(windows, limits_.rs_lower, {});
    whole.right = limits_.rs_upper > limits_.rs_lower
                      ? Solve(windows, limits_.rs_upper, whole.left->atoms)
                      : whole.left;
    Push(std::move(whole));
    while (!open_.empty()) {
      const Part part = open_.top();
      if (part.lower >= Enough()) break;
      if (end_.solved >= limits_.most_solved) break;
      if (limits_.proceed && !limits_.proceed(end_.solved, primal_, part.lower)) break;
      open_.pop();
      Split(part);
    }
    end_.lower = std::min(settled_, open_.empty() ? settled_ : open_.top().lower);
    end_.complete = end_.lower >= Enough();
    return std::move(end_);
  }

 private:
  MixturePtr Solve(const std::vector<Window>& windows, double rs, const std::vector<Atom>& start) {
    ++end_.solved;
    const double price = Price(rs, rs).current_A;
    auto mixture = std::make_shared<Mixture>(SolveMixture(data_, Union(windows), rs, start,
                                                          0.01 * limits_.tolerance,
                                                          std::min(price, 1e3 * Scale())));
    const bool counts = diodes_ == 0 || static_cast<int>(mixture->atoms.size()) <= diodes_;
    if (counts && mixture->primal < end_.best.primal) {
      end_.best = *mixture;
      primal_ = std::min(primal_, mixture->primal);
    }
    return mixture;
  }

  double Scale() const { return data_.current_A.cwiseAbs().maxCoeff(); }

  // The lower bound that settles a part.
  double Enough() const {
    const double rmse = std::sqrt(2 * primal_ / data_.current_A.size());
    return rmse <= kRounding * Scale() ? 0 : primal_ * (1 - limits_.tolerance);
  }

  struct PriceTag {
    double current_A;
    double voltage_V;  // never below the reference voltage
  };

  // No model as good as the best known has a larger sum of shunt and diode currents at this
  // voltage, for any Rs in [rs0, rs1]: the difference of the model's currents at the points of the
  // largest and the smallest junction voltage is known to within the residuals allowed.
  PriceTag Price(double rs0, double rs1) const {
    const Eigen::VectorXd v0 = data_.voltage_V + rs0 * data_.current_A;
    const Eigen::VectorXd v1 = data_.voltage_V + rs1 * data_.current_A;
    int high, low;
    const double v_high = v0.cwiseMin(v1).maxCoeff(&high);
    const double v_low = std::max(0.0, v0.cwiseMax(v1).minCoeff(&low));
    if (v_low >= v_high) return {kInfinity, v_high};
    const double known = std::isfinite(primal_) ? primal_ : 0.5 * data_.current_A.squaredNorm();
    const double difference = data_.current_A[low] - data_.current_A[high] + 2 * std::sqrt(known);
    return {std::max(difference, 0.0) / (1 - v_low / v_high), v_high};
  }

  // The excess of a mixture with columns scaled at `voltage`.
  static double Excess(const Mixture& mixture, const std::vector<Window>& windows, double voltage) {
    const double above = mixture.scale_voltage_V - voltage;
    if (above <= 0 || mixture.excess == 0) return mixture.excess;
    double u = 0;
    for (const Window& window : windows) u = std::max(u, window.upper);
    return mixture.excess * (mixture.scale_voltage_V / voltage) * std::exp(u * above);
  }

  double LargestPhotocurrent(double price) const {
    return data_.current_A.maxCoeff() + std::sqrt(2 * primal_) + price;
  }

  void Push(Part part) {
    const Mixture &a = *part.left, &b = *part.right;
    const auto [price, voltage] = Price(a.rs, b.rs);
    const double lack =
        price * std::max(Excess(a, part.windows, voltage), Excess(b, part.windows, voltage)) +
        LargestPhotocurrent(price) * std::max(a.photocurrent_excess, b.photocurrent_excess);
    part.ends = std::min(a.dual, b.dual);
    part.lower = std::isfinite(price) ? part.ends - lack : 0;
    if (std::isfinite(price) && b.rs > a.rs) {
      const double bend =
          BoundBend(data_, Union(part.windows), a.rs, b.rs - a.rs, a.y, b.y, voltage);
      // Along t: (1 - t) D0 + t D1 + t (1 - t) / 2 (|y1 - y0|^2 - price x bend).
      const double curvature = 0.5 * ((b.y - a.y).squaredNorm() - price * bend);
      if (!(curvature >= 0)) {
        const double rise = b.dual - a.dual;
        const double t = std::min(std::max(0.5 * (1 + rise / curvature), 0.0), 1.0);
        part.lower = a.dual + t * rise + t * (1 - t) * curvature - lack;
      }
    }
    const double lacking = std::max(a.relative_gap * a.primal, b.relative_gap * b.primal);
    part.stuck = part.lower + lacking >= Enough() ? part.stuck + 1 : 0;
    if (!(part.lower > 0)) part.lower = 0;
    if (part.lower >= Enough() || part.stuck > kMostStuck) {
      settled_ = std::min(settled_, part.lower);
      return;
    }
    open_.push(std::move(part));
  }

  // Halves the windows where even the ends of the part lie too low, else the range of Rs.
  void Split(const Part& part) {
    const bool ends_too_low = part.ends < Enough();
    if (diodes_ > 0 && (ends_too_low || !(part.right->rs > part.left->rs))) {
      SplitWindow(part);
    } else {
      SplitResistance(part);
    }
  }

  void SplitResistance(const Part& part) {
    const Mixture &a = *part.left, &b = *part.right;
    const double width = b.rs - a.rs;
    double t = 0.5;
    const bool near = std::max(a.primal, b.primal) < 4 * primal_;
    if (near && a.slope < 0 && b.slope > 0) {
      // Towards the minimum, but never so close to an end that nothing is gained.
      t = std::min(std::max(a.slope / (a.slope - b.slope), 0.01), 0.99);
    }
    const double rs = a.rs + t * width;
    if (!(rs > a.rs && rs < b.rs)) {
      settled_ = std::min(settled_, part.lower);
      return;
    }
    const Mixture& nearer = t < 0.5 ? a : b;
    const MixturePtr middle = Solve(part.windows, rs, nearer.atoms);
    Part left = part, right = part;
    left.right = right.left = middle;
    Push(std::move(left));
    Push(std::move(right));
  }

  void SplitWindow(const Part& part) {
    int widest = 0;
    for (int j = 1; j < static_cast<int>(part.windows.size()); ++j) {
      const Window &w = part.windows[j], &best = part.windows[widest];
      if (w.upper - w.lower > best.upper - best.lower) widest = j;
    }
    const Window window = part.windows[widest];
    const double middle = 0.5 * (window.lower + window.upper);
    if (!(middle > window.lower && middle < window.upper)) {
      settled_ = std::min(settled_, part.lower);
      return;
    }
    // Diodes are interchangeable: of windows that are alike, the lower halves go first.
    const auto alike = [&](const Window& w) {
      return w.lower == window.lower && w.upper == window.upper;
    };
    const int copies =
        static_cast<int>(std::count_if(part.windows.begin(), part.windows.end(), alike));
    for (int low = 0; low <= copies; ++low) {
      Part child = part;
      int seen = 0;
      for (Window& w : child.windows) {
        if (!alike(w)) continue;
        w = seen++ < low ? Window{window.lower, middle} : Window{middle, window.upper};
      }
      child.left = Solve(child.windows, part.left->rs, part.left->atoms);
      child.right = part.right == part.left
                        ? child.left
                        : Solve(child.windows, part.right->rs, part.right->atoms);
      Push(std::move(child));
    }
  }

  const MixtureData& data_;
  const BranchLimits& limits_;
  const int diodes_;  // 0: any number
  double primal_;     // the best half sum of squares known
  double settled_ = kInfinity;
  std::priority_queue<Part, std::vector<Part>, LowerFirst> open_;
  BranchEnd end_;
};

}  // namespace

BranchEnd BranchOverResistance(const MixtureData& data, const Window& window,
                               const BranchLimits& limits) {
  return Branch(data, limits, 0, kInfinity).Run({window});
}

BranchEnd BranchOverDiodes(const MixtureData& data, const Window& window, int diodes, double primal,
                           const BranchLimits& limits) {
  return Branch(data, limits, diodes, primal)
      .Run(std::vector<Window>(static_cast<std::size_t>(diodes), window));
}

}  // namespace lyrefit
