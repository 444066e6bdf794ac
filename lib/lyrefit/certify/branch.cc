#include "lyrefit/certify/branch.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "lyrefit/base/numbers.h"
#include "lyrefit/certify/mixture.h"

namespace lyrefit {
namespace {

// An RMSE below this fraction of the largest current is rounding.
constexpr double kRounding = 1e-14;
// Generations of parts that are divided although only the duality gap of their end solutions keeps
// them open.
constexpr int kMostStuck = 3;

struct LowerFirst {
  bool operator()(const BranchPart& a, const BranchPart& b) const {
    if (a.lower != b.lower) return a.lower > b.lower;
    return a.rs1 - a.rs0 < b.rs1 - b.rs0;  // among equals the widest first
  }
};

bool HoldsIs(const Window& window) {
  return window.saturation_lower_A > 0 || window.saturation_upper_A < kInfinity;
}

bool Alike(const Window& a, const Window& b) {
  return a.lower == b.lower && a.upper == b.upper && a.saturation_lower_A == b.saturation_lower_A &&
         a.saturation_upper_A == b.saturation_upper_A;
}

// Distance between the outermost atoms of a mixture in a window; 0 if `diodes` diodes can represent
// all of them.
double Spread(const Mixture& mixture, const Window& window, std::ptrdiff_t diodes) {
  double least = kInfinity, most = -kInfinity;
  std::ptrdiff_t count = 0;
  for (const Atom& atom : mixture.atoms) {
    if (atom.u < window.lower || atom.u > window.upper) continue;
    least = std::min(least, atom.u);
    most = std::max(most, atom.u);
    ++count;
  }
  return count > diodes ? most - least : 0;
}

// Selects the widest window by default. A window with a range of Is takes precedence if an end
// solution has more atoms there than diodes: one atom may carry the current and another the Is. Of
// these, selects the one with the largest distance between atoms.
Window WindowToSplit(const BranchPart& part) {
  Window widest = part.windows.front(), loosest = widest;
  double spread = 0;
  for (const Window& window : part.windows) {
    if (window.upper - window.lower > widest.upper - widest.lower) widest = window;
    if (!HoldsIs(window)) continue;
    const auto copies = std::count_if(part.windows.begin(), part.windows.end(),
                                      [&](const Window& other) { return Alike(other, window); });
    for (const MixturePtr& end : {part.left, part.right}) {
      const double here = Spread(*end, window, copies);
      if (here <= spread) continue;
      spread = here;
      loosest = window;
    }
  }
  return spread > 0 ? loosest : widest;
}

class Branch {
 public:
  Branch(const Relaxation& relaxation, const BranchLimits& limits, std::vector<Window> box,
         double primal)
      : relaxation_(relaxation), limits_(limits) {
    incumbent_.best.primal = kInfinity;
    incumbent_.primal = primal;
    incumbent_.diodes = static_cast<int>(box.size());
    incumbent_.box = std::move(box);
    incumbent_.tolerance = limits.tolerance;
    incumbent_.polish = limits.polish;
  }

  BranchEnd Run(const std::vector<Window>& windows) {
    BranchPart whole;
    whole.windows = windows;
    whole.rs0 = limits_.rs_lower;
    whole.rs1 = std::min(limits_.rs_upper, limits_.rs_cut);
    const BranchPart start = whole;
    Push(nullptr, std::move(whole));
    if (limits_.rs_upper > limits_.rs_cut) PushFar(start, limits_.rs_cut);
    while (!open_.empty()) {
      const BranchPart part = open_.top();
      if (part.lower >= Target()) break;
      if (incumbent_.solved >= limits_.most_solved) break;
      if (limits_.stop && limits_.stop(incumbent_.solved, incumbent_.primal, part.lower)) {
        break;
      }
      open_.pop();
      Split(part);
    }
    BranchEnd end;
    end.lower = std::min(settled_, open_.empty() ? settled_ : open_.top().lower);
    // Only mixtures as good as the best one known have been bounded, so `lower` cannot exceed its
    // value.
    end.lower = std::min(end.lower, incumbent_.primal);
    end.complete = end.lower >= Target();
    end.solved = incumbent_.solved;
    end.best = std::move(incumbent_.best);
    end.rs_reached = rs_reached_;
    return end;
  }

 private:
  // The lower bound that closes a part; 0 if the best value known is an exact fit.
  double Target() const {
    const double points = static_cast<double>(relaxation_.Points());
    const double rmse = std::sqrt(2 * incumbent_.primal / points);
    return rmse <= kRounding * relaxation_.Scale() ? 0
                                                   : incumbent_.primal * (1 - limits_.tolerance);
  }

  // Adds a part with Rs of `rs` or more, bounded by the order of the points alone. Its ends are not
  // solved.
  void PushFar(const BranchPart& part, double rs) {
    BranchPart far = part;
    far.rs0 = rs;
    far.rs1 = limits_.rs_upper;
    far.left = far.right = nullptr;
    far.lower = std::max(part.lower, relaxation_.Beyond(rs));
    if (far.lower >= Target() || rs >= limits_.rs_divided) {
      settled_ = std::min(settled_, far.lower);
      return;
    }
    open_.push(std::move(far));
  }

  void Push(const BranchPart* parent, BranchPart part) {
    rs_reached_ = std::max(rs_reached_, part.rs1);
    const double known = part.lower;  // bound of the parent part
    relaxation_.Bound(parent, &part, &incumbent_);
    part.stuck = part.lower + part.lacking >= Target() ? part.stuck + 1 : 0;
    if (!(part.lower > 0)) part.lower = 0;
    part.lower = std::max(part.lower, known);
    if (part.lower >= Target() || part.stuck > kMostStuck) {
      settled_ = std::min(settled_, part.lower);
      return;
    }
    open_.push(std::move(part));
  }

  void Split(const BranchPart& part) {
    if (part.left == nullptr) {
      SplitFar(part);
    } else if (incumbent_.diodes > 0 && relaxation_.SplitsWindows(part, Target())) {
      SplitWindow(part);
    } else {
      SplitResistance(part);
    }
  }

  // Turns the smaller Rs of a part without end solutions into an ordinary part, up to twice its
  // lower end.
  void SplitFar(const BranchPart& part) {
    BranchPart near = part;
    near.rs1 = std::min(2 * part.rs0, part.rs1);
    const double rs = near.rs1;
    Push(nullptr, std::move(near));
    if (rs < part.rs1) PushFar(part, rs);
  }

  void SplitResistance(const BranchPart& part) {
    const Mixture &a = *part.left, &b = *part.right;
    double t = 0.5;
    const bool near = std::max(a.primal, b.primal) < 4 * incumbent_.primal;
    if (near && a.slope < 0 && b.slope > 0) {
      // Splits near the minimum, but at least 1 % of the range away from each end.
      t = std::min(std::max(a.slope / (a.slope - b.slope), 0.01), 0.99);
    }
    const double rs = part.rs0 + t * (part.rs1 - part.rs0);
    if (!(rs > part.rs0 && rs < part.rs1)) {
      settled_ = std::min(settled_, part.lower);
      return;
    }
    const Mixture& nearer = t < 0.5 ? a : b;
    BranchPart left = part, right = part;
    left.rs1 = right.rs0 = rs;
    left.right = right.left = relaxation_.At(part.windows, rs, nearer.atoms, &incumbent_);
    Push(&part, std::move(left));
    Push(&part, std::move(right));
  }

  void SplitWindow(const BranchPart& part) {
    const Window window = WindowToSplit(part);
    const double middle = 0.5 * (window.lower + window.upper);
    if (!(middle > window.lower && middle < window.upper)) {
      settled_ = std::min(settled_, part.lower);
      return;
    }
    // Diodes are interchangeable. Of equal windows the first ones take the lower half.
    const auto alike = [&](const Window& w) { return Alike(w, window); };
    const int copies =
        static_cast<int>(std::count_if(part.windows.begin(), part.windows.end(), alike));
    for (int low = 0; low <= copies; ++low) {
      BranchPart child = part;
      int seen = 0;
      for (Window& w : child.windows) {
        if (!alike(w)) continue;
        (seen++ < low ? w.upper : w.lower) = middle;
      }
      child.left = child.right = nullptr;
      Push(&part, std::move(child));
    }
  }

  const Relaxation& relaxation_;
  const BranchLimits& limits_;
  Incumbent incumbent_;
  double settled_ = kInfinity;
  double rs_reached_ = 0;
  std::priority_queue<BranchPart, std::vector<BranchPart>, LowerFirst> open_;
};

}  // namespace

void Incumbent::Note(const Mixture& mixture, double value) {
  if (!(value < best.primal)) return;
  const bool few = diodes == 0 || static_cast<int>(mixture.atoms.size()) <= diodes;
  if (!few || (!box.empty() && !AsDiodes(mixture, box))) {
    if (!polish || !(value < primal) || solved < next_polish) return;
    next_polish = 2 * solved + 1;
    primal = std::min(primal, polish(mixture));
    return;
  }
  best = mixture;
  best.primal = value;
  primal = std::min(primal, value);
}

std::vector<Window> Union(std::vector<Window> windows) {
  std::sort(windows.begin(), windows.end(),
            [](const Window& a, const Window& b) { return a.lower < b.lower; });
  std::vector<Window> merged;
  for (const Window& window : windows) {
    const bool meets = !merged.empty() && window.lower <= merged.back().upper;
    const bool touches = meets && window.lower == merged.back().upper &&
                         merged.back().lower < merged.back().upper && window.lower < window.upper;
    // Ranges of Is give tighter bounds if the windows stay separate.
    if (meets && !(touches && (HoldsIs(window) || HoldsIs(merged.back())))) {
      merged.back().upper = std::max(merged.back().upper, window.upper);
      merged.back().saturation_lower_A += window.saturation_lower_A;
      merged.back().saturation_upper_A += window.saturation_upper_A;
    } else {
      merged.push_back(window);
    }
  }
  return merged;
}

BranchEnd BranchOver(const Relaxation& relaxation, const std::vector<Window>& box, double primal,
                     const BranchLimits& limits) {
  return Branch(relaxation, limits, box, primal).Run(box);
}

BranchEnd BranchOver(const Relaxation& relaxation, const Window& window, int diodes, double primal,
                     const BranchLimits& limits) {
  if (diodes == 0) return Branch(relaxation, limits, {}, primal).Run({window});
  return BranchOver(relaxation, std::vector<Window>(static_cast<std::size_t>(diodes), window),
                    primal, limits);
}

}  // namespace lyrefit
