#include "lyrefit/model/string.h"

#include <string_view>

#include "lyrefit/model/kernel.h"
#include "lyrefit/model/string_cell_group.h"
#include "lyrefit/model/string_solve.h"

namespace lyrefit {
namespace {

class Bracketed {
 public:
  Bracketed(const StringEffects& effects, const Cell<Pack>& cell, const StringLimits& limits)
      : effects_(effects), cell_(cell), limits_(limits) {}

  void Solve(const Pack& voltage, StringState* state) const {
    for (int s = 0; s < cell_.strings; ++s) {
      const auto excess = [&](const Pack& current) {  // rises with current
        return voltage * WeightOf(s) - VoltageOf(s, current, state);
      };
      state->current[s] = RisingRoot(excess, state->current[s], 1.0);
      excess(state->current[s]);
    }
  }

 private:
  static constexpr int kSteps = 64;
  static constexpr double kEnough = 1e-9;  // relative; Newton's steps refine the result

  // Root of a rising function. A bracket grows from `start` by doubling steps. It is then reduced
  // by bisection and by linear interpolation in turns.
  template <class F>
  static Pack RisingRoot(const F& f, const Pack& start, double first_step) {
    Pack low = start, high = start, below = f(start), above = below;
    double step = first_step;
    for (int k = 0; k < kSteps; ++k, step *= 2) {
      const Mask too_high = 0.0 < below, too_low = above < 0.0;
      if (!Any(too_high) && !Any(too_low)) break;
      low = Choose(too_high, low - step, low);
      high = Choose(too_low, high + step, high);
      below = f(low);
      above = f(high);
    }
    for (int k = 0; k < kSteps && Any(kEnough * (1.0 + abs(low)) < high - low); ++k) {
      const Pack middle = 0.5 * (low + high);
      const Pack cut = low - below * ((high - low) / Larger(above - below, 1e-300));
      const Pack width = high - low;
      const Mask inside = (low + 0.01 * width < cut) & (cut < high - 0.01 * width);
      const Pack x = k % 2 == 0 ? middle : Choose(inside, cut, middle);
      const Pack value = f(x);
      const Mask negative = value < 0.0;
      low = Choose(negative, x, low);
      below = Choose(negative, value, below);
      high = Choose(negative, high, x);
      above = Choose(negative, above, value);
    }
    return 0.5 * (low + high);
  }

  Pack WeightOf(int string) const {
    Pack weight = 0.0;
    for (int g = 0; g < cell_.groups; ++g) {
      if (IsBeside(cell_, g)) continue;
      if (cell_.substring[SubstringOf(cell_, g)].string == string)
        weight = weight + ShareOf(cell_, g);
    }
    return weight;
  }

  // Sum of share x voltage over a string's substrings at a current; updates the state.
  Pack VoltageOf(int string, const Pack& current, StringState* state) const {
    const Pack drop = SeriesDrop(effects_, cell_, current).a;
    Pack sum = 0.0;
    for (int p = 0; p < cell_.substrings; ++p) {
      if (cell_.substring[p].string != string) continue;
      Pack carried = current, weight = 0.0;
      if (cell_.substring[p].parallel) {
        state->substring_voltage[p] = VoltageOfPair(p, current, &weight, state);
        sum = sum + weight * state->substring_voltage[p];
        continue;
      }
      if (cell_.substring[p].bypassed) {
        carried = RisingRoot(
            [&](const Pack& own) {
              const Pack reverse = drop - MeanVoltage(p, own, &weight, state);
              return own +
                     BypassCurrent(cell_, cell_.substring[p].cells, Dual<1, Pack>(reverse, 0)).a -
                     current;
            },
            current, 1.0);
      }
      state->substring_voltage[p] = MeanVoltage(p, carried, &weight, state) - drop;
      sum = sum + weight * state->substring_voltage[p];
    }
    return sum;
  }

  Pack DropAt(const Pack& current) const { return SeriesDrop(effects_, cell_, current).a; }

  // Voltage of a substring of two parallel chains. `excess` rises: the current of the group beside
  // falls as its voltage rises, so the other chain carries more and its voltage falls.
  Pack VoltageOfPair(int substring, const Pack& current, Pack* weight, StringState* state) const {
    int beside = 0;
    while (cell_.group[beside].substring != substring || !cell_.group[beside].beside) ++beside;
    Pack voltage = 0.0;
    const auto excess = [&](const Pack& junction) {  // rises with the junction voltage
      state->u[beside] = junction;
      const Pack own = PointOf(effects_, cell_, beside, *state).current.a;
      voltage = junction - DropAt(own);
      Pack others = 2.0 * current - own;
      if (cell_.substring[substring].bypassed) {
        const Dual<1, Pack> reverse(-voltage, 0);
        others = others - 2.0 * BypassCurrent(cell_, cell_.substring[substring].cells, reverse).a;
      }
      return voltage - MeanVoltage(substring, others, weight, state) + DropAt(others);
    };
    excess(RisingRoot(excess, state->u[beside], 0.1));
    return voltage;
  }

  // Mean junction voltage of a substring's cells at their current.
  Pack MeanVoltage(int substring, const Pack& carried, Pack* weight, StringState* state) const {
    Pack sum = 0.0;
    *weight = 0.0;
    for (int g = 0; g < cell_.groups; ++g) {
      if (SubstringOf(cell_, g) != substring || IsBeside(cell_, g)) continue;
      MoveGroup(g, carried, state);
      *weight = *weight + ShareOf(cell_, g);
      sum = sum + ShareOf(cell_, g) * state->u[g];
    }
    return sum / *weight;
  }

  // Moves a cell group to the junction voltage at which it carries `carried`.
  void MoveGroup(int group, const Pack& carried, StringState* state) const {
    const Pack size = 1.0 + abs(carried);
    constexpr double kFar = 1e6;
    Pack low = -kFar, high = kFar;  // the current falls as the voltage rises
    for (int k = 0; k < kSteps; ++k) {
      const GroupPoint point = PointOf(effects_, cell_, group, *state);
      const Pack missing = carried - point.current.a, u = state->u[group];
      const Mask too_high = 0.0 < missing;
      high = Choose(too_high, Smaller(high, u), high);
      low = Choose(too_high, low, Larger(low, u));
      const Pack next =
          NextVoltage(cell_, limits_, u, missing / point.current.v[0], point.current, size);
      // Newton's steps may oscillate between a flat and a steep stretch: bisection ends that.
      const Mask outside = (next < low) | (high < next);
      state->u[group] = Choose(outside, 0.5 * (low + high), next);
      const Pack step = state->u[group] - u;
      Mask done = (abs(missing) < kRounding * size) | IsShort(step, u);
      if (cell_.two_parts) {
        const Pack far = state->far[group], way = (step + point.behind) * point.follows;
        state->far[group] = NextVoltage(cell_, limits_, far, way, point.far, size);
        done = done & IsShort(state->far[group] - far, far);
      }
      if (All(done)) return;
    }
  }

  const StringEffects& effects_;
  const Cell<Pack>& cell_;
  const StringLimits& limits_;
};

// Moves `state` near the root at `voltage` by nested bracketed searches over currents. It serves
// lanes in which Newton's steps cycle. The search is safe because two functions are monotone: the
// voltage of a string falls as its current rises, and the cell current of a substring rises with
// the string current.
void SolveByBrackets(const StringEffects& effects, const Cell<Pack>& cell,
                     const StringLimits& limits, const Pack& voltage, StringState* state) {
  Bracketed(effects, cell, limits).Solve(voltage, state);
}

}  // namespace

#if defined(__x86_64__)
namespace avx2 {
extern const StringKernel kStringKernel;
}
namespace avx512 {
extern const StringKernel kStringKernel;
}
#endif

namespace {

std::vector<StringKernel> FindStringKernels() {
  std::vector<StringKernel> kernels;
  for (const Kernel& kernel : AvailableKernels()) {
    kernels.push_back({kernel.name, FindRootInMemory<Pack>, AddSlopesInMemory<Pack>});
#if defined(__x86_64__)
    const std::string_view name = kernel.name;
    if (name == "avx2") kernels.back() = avx2::kStringKernel;
    if (name == "avx512") kernels.back() = avx512::kStringKernel;
#endif
  }
  return kernels;
}

}  // namespace

void AddJunctionTerms(const StringEffects& effects, const void* cell, const Block& light,
                      const Block& voltage, Block* current, Block* slope) {
  Dual<1, Pack> sum = every_processor::Load(*current);
  sum.v[0] = every_processor::Load(*slope);
  sum = AddEffects(*effects.context, *static_cast<const Cell<Pack>*>(cell),
                   every_processor::Load(light), Dual<1, Pack>(every_processor::Load(voltage), 0),
                   sum);
  every_processor::Store(sum.a, current);
  every_processor::Store(sum.v[0], slope);
}

void AddSeriesTerms(const StringEffects& effects, const void* cell, const Block& current,
                    Block* drop, Block* slope) {
  const Dual<1, Pack> sum = MoreDrop(*effects.context, *static_cast<const Cell<Pack>*>(cell),
                                     Dual<1, Pack>(every_processor::Load(current), 0));
  every_processor::Store(sum.a, drop);
  every_processor::Store(sum.v[0], slope);
}

void StartInBrackets(const StringEffects& effects, const void* cell, const void* limits,
                     const void* voltage, void* state) {
  const auto& own = *static_cast<const Cell<Pack>*>(cell);
  const auto& own_limits = *static_cast<const StringLimits*>(limits);
  const Pack& at = *static_cast<const Pack*>(voltage);
  StringState* const start = static_cast<StringState*>(state);
  StartString(own, own_limits, at, 0.0, start);
  SolveByBrackets(effects, own, own_limits, at, start);
}

const std::vector<StringKernel>& StringKernels() {
  static const std::vector<StringKernel> kernels = FindStringKernels();
  return kernels;
}

StringEffects EffectsOf(const EvaluationContext<Pack>& context) {
  StringEffects effects{&context, false, false};
  for (const Effect* effect : context.law.effects) {
    effects.junction = effects.junction || effect->ChangesJunction();
    effects.series = effects.series || effect->ChangesSeries();
  }
  return effects;
}

void SolveString(const StringEffects& effects, const Cell<Pack>& cell, const StringLimits& limits,
                 const Pack& voltage, GiveUp give_up, Wanted wanted, StringState* state,
                 StringRoot* root) {
  static const StringKernel& fastest = StringKernels().back();
  fastest.solve(effects, &cell, &limits, &voltage, give_up, wanted, state, root);
}

void AddSlopes(const std::vector<SlopeTerm>& terms, int size, void* sum) {
  static const StringKernel& fastest = StringKernels().back();
  fastest.add_slopes(terms.data(), static_cast<int>(terms.size()), size, sum);
}

StringLimits LimitsOf(const Cell<Pack>& cell) {
  StringLimits limits;
  limits.n_vt = 1.0 / cell.diode[0].inverse_n_vt;
  limits.voltage = 1e3;
  for (int d = 0; d < cell.diodes; ++d) {
    const Pack n_vt = 1.0 / cell.diode[d].inverse_n_vt;
    limits.n_vt = Smaller(limits.n_vt, n_vt);
    const Pack ratio = (abs(cell.photocurrent) + 1.0) / Larger(cell.diode[d].saturation, 1e-300);
    limits.voltage = Smaller(limits.voltage, n_vt * LogUpperBound(1.0 + ratio));
  }
  limits.bypass_vt = cell.bypass_ideality * cell.thermal_voltage;
  limits.reverse = cell.bypass;
  return limits;
}

void StartString(const Cell<Pack>& cell, const StringLimits& limits, const Pack& voltage,
                 const Pack& current, StringState* state) {
  state->groups = cell.groups;
  state->substrings = cell.substrings;
  state->strings = cell.strings;
  if (cell.groups == 1) {
    state->u[0] = state->far[0] = Smaller(voltage + current * cell.resistance, limits.voltage);
    state->substring_voltage[0] = voltage;
    state->current[0] = current;
    return;
  }
  // Start voltage of each cell group at this current: that of its first diode, or of its shunt in
  // reverse.
  for (int g = 0; g < cell.groups; ++g) {
    const CellGroup<Pack>& group = cell.group[g];
    const Substring& substring = cell.substring[group.substring];
    const Pack room = cell.photocurrent * group.light - current;
    const Pack forward =
        LogUpperBound(1.0 + Larger(room, 0.0) / Larger(cell.diode[0].saturation, 1e-300)) /
        cell.diode[0].inverse_n_vt;
    const Pack least = substring.bypassed ? -limits.reverse / substring.cells : Pack(-50.0);
    const Pack reverse = Larger(room / (cell.conductance + group.leak + 1e-3), least);
    state->u[g] = state->far[g] = Choose(0.0 < room, Smaller(forward, limits.voltage), reverse);
  }
  for (int p = 0; p < cell.substrings; ++p) {
    const bool bypassed = cell.substring[p].bypassed;
    Pack lowest = 1e3;
    for (int g = 0; g < cell.groups; ++g) {
      if (cell.group[g].substring == p) lowest = Smaller(lowest, state->u[g]);
    }
    state->substring_voltage[p] =
        bypassed ? Larger(lowest, -limits.reverse / cell.substring[p].cells) : lowest;
  }
  for (int s = 0; s < cell.strings; ++s) state->current[s] = current;
}

}  // namespace lyrefit
