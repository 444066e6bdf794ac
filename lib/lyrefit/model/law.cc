#include "lyrefit/model/law.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/model/cell.h"
#include "lyrefit/model/make_readings.h"
#include "lyrefit/model/string_cell_group.h"

namespace lyrefit {
namespace {

constexpr double kNear_V = 2;       // larger distance from the guess: no start
constexpr double kBeside_V = 0.25;  // largest distance of consecutive readings

bool IsSame(const Pack& a, const Pack& b) { return All((!(a < b)) & (!(b < a))); }
template <int N>
bool IsSame(const Dual<N, Pack>& a, const Dual<N, Pack>& b) {
  if (!IsSame(a.a, b.a)) return false;
  for (int k = 0; k < N; ++k) {
    if (!IsSame(a.v[k], b.v[k])) return false;
  }
  return true;
}

// Reuses cells: readings at the same operating conditions share one cell. The temperature-dependent
// fields are also reused at other irradiances.
template <class S>
class CellKeeper {
 public:
  CellKeeper(const CellKeeper&) = delete;  // `warm_` and its copies point into this object
  explicit CellKeeper(const EvaluationContext<S>& context) : context_(context) {
    warm_.group = groups_;
    for (const Effect* effect : context.law.effects) {
      varies_ = varies_ || effect->conditions || effect->by_sweep;
    }
  }

  // Updates the cell for `block`; returns whether it changed.
  bool Settle(const ReadingBlock& block) {
    conditions_ = ConditionsAt(context_, block);
    const bool same = known_ && block.same_conditions && last_.same_conditions &&
                      block.suns_voc == last_.suns_voc &&
                      IsSame(block.temperature_K, last_.temperature_K) &&
                      IsSame(block.irradiance, last_.irradiance);
    if (!varies_ && same) {
      conditions_.voltage = conditions_.voltage + above_;
      return false;
    }
    if (!known_ || !IsSame(conditions_.temperature_K, warm_conditions_.temperature_K) ||
        !IsSame(conditions_.bandgap_eV, warm_conditions_.bandgap_eV)) {
      CellUnder(context_, conditions_, &warm_);
      warm_conditions_ = conditions_;
    }
    cell_ = warm_;
    cell_.sweep = Choose(Pack(0.0) < block.rate, Pack(1.0),
                         Choose(block.rate < Pack(0.0), Pack(-1.0), Pack(0.0)));
    Light(context_, conditions_, &cell_);
    ApplyCellStages(context_, &cell_);
    above_ = block.suns_voc ? OpenCircuit(&cell_) : S(0.0);
    conditions_.voltage = conditions_.voltage + above_;
    last_ = block;
    known_ = true;
    return true;
  }
  const Cell<S>& cell() const { return cell_; }
  const OperatingConditions<S>& conditions() const { return conditions_; }

 private:
  const EvaluationContext<S>& context_;
  bool varies_ = false;
  bool known_ = false;
  ReadingBlock last_;
  OperatingConditions<S> conditions_;
  S above_;  // voltage above the measured one, see OpenCircuit
  OperatingConditions<S> warm_conditions_;
  Cell<S> warm_;  // fields for the temperature of warm_conditions_ only
  Cell<S> cell_;
  CellGroup<S> groups_[kMostGroups];
};

template <class S>
S Recorded(const EvaluationContext<S>& context, const ReadingBlock& block, const Cell<S>& cell,
           const S& current, const S& junction) {
  Solved<S> solved;
  solved.current = current;
  solved.resistance = cell.resistance;
  solved.diode_conductance = S(0.0);
  for (int d = 0; d < cell.diodes; ++d) {
    const Diode<S>& diode = cell.diode[d];
    const S through = DiodeCurrent(diode.saturation, diode.inverse_n_vt, junction);
    solved.diode_conductance =
        solved.diode_conductance + (diode.saturation - through) * diode.inverse_n_vt;
  }
  solved.conductance = solved.diode_conductance + cell.conductance;
  for (std::size_t e = 0; e < context.law.effects.size(); ++e) {
    const auto stage = context.law.effects[e]->instrument.template For<S>();
    if (stage != nullptr) stage(context.p + context.offsets[e], block, &solved);
  }
  return solved.current;
}

// Start from the solution of the last evaluation in lanes where it is near the guess, else from the
// guess.
void Start(const Cell<Pack>& cell, const StringLimits& limits, const ReadingBlock& block,
           const Pack& voltage, bool fresh, StringState* state) {
  StringState guess;
  StartString(cell, limits, voltage, block.current, &guess);
  if (fresh) {
    *state = guess;
    return;
  }
  const Mask near = abs(state->u[0] - guess.u[0]) < kNear_V;
  if (All(near)) return;
  for (int g = 0; g < cell.groups; ++g) {
    state->u[g] = Choose(near, state->u[g], guess.u[g]);
    state->far[g] = Choose(near, state->far[g], guess.far[g]);
  }
  for (int p = 0; p < cell.substrings; ++p) {
    state->substring_voltage[p] =
        Choose(near, state->substring_voltage[p], guess.substring_voltage[p]);
  }
  for (int s = 0; s < cell.strings; ++s) {
    state->current[s] = Choose(near, state->current[s], guess.current[s]);
  }
}

// Start from the solution of the last reading in the previous block. For unlike cells that is
// better than any guess. Returns false if that reading is not a neighbour.
bool StartBeside(const ReadingBlock& before, const StringState& there, const ReadingBlock& block,
                 const Cell<Pack>& cell, StringState* state) {
  constexpr int kLast = Block::kLanes - 1;
  if (cell.groups == 1 || !there.Fits(cell) ||
      std::fabs(block.voltage[0] - before.voltage[kLast]) > kBeside_V ||
      block.irradiance[0] != before.irradiance[kLast] || block.suns_voc != before.suns_voc) {
    return false;
  }
  state->groups = there.groups;
  state->substrings = there.substrings;
  state->strings = there.strings;
  for (int g = 0; g < cell.groups; ++g) {
    state->u[g] = Pack(there.u[g][kLast]);
    state->far[g] = Pack(there.far[g][kLast]);
  }
  for (int p = 0; p < cell.substrings; ++p)
    state->substring_voltage[p] = Pack(there.substring_voltage[p][kLast]);
  for (int s = 0; s < cell.strings; ++s) state->current[s] = Pack(there.current[s][kLast]);
  return true;
}

bool HasInstrument(const Law& law) {
  return std::any_of(law.effects.begin(), law.effects.end(),
                     [](const Effect* e) { return static_cast<bool>(e->instrument); });
}

// Adds `factor` times the derivatives of x to `sum`.
template <int N>
void Add(const Pack& factor, const Dual<N, Pack>& x, Dual<N, Pack>* sum) {
  for (int k = 0; k < N; ++k) sum->v[k] = sum->v[k] + factor * x.v[k];
}

// The cell and its context at a root, in duals and in plain numbers.
template <class S>
struct Place {
  const EvaluationContext<S>& context;
  const StringEffects& effects;
  const Cell<S>& cell;
  const Cell<Pack>& plain;
  int size;                             // number of derivatives
  const std::vector<SlopeTerm>& terms;  // of the delivered current, at any root
};

template <int N>
bool HasDerivatives(const Dual<N, Pack>& a, int size) {
  return std::any_of(a.v, a.v + size, [](const Pack& v) { return !All(abs(v) < 1e-300); });
}

// The slopes of a current by the fields of a cell that have derivatives, of which there are `size`.
template <class S>
std::vector<SlopeTerm> TermsOf(const FieldSlopes& slopes, const Cell<S>& cell, int size) {
  std::vector<SlopeTerm> terms;
  const auto add = [&](const Pack& slope, const S& by) {
    if (HasDerivatives(by, size)) terms.push_back({&slope, &by});
  };
  add(slopes.photocurrent, cell.photocurrent);
  add(slopes.conductance, cell.conductance);
  add(slopes.resistance, cell.resistance);
  for (int d = 0; d < cell.diodes; ++d) {
    add(slopes.saturation[d], cell.diode[d].saturation);
    add(slopes.inverse_n_vt[d], cell.diode[d].inverse_n_vt);
  }
  for (int g = 0; cell.groups > 1 && g < cell.groups; ++g) {
    add(slopes.light[g], cell.group[g].light);
    add(slopes.leak[g], cell.group[g].leak);
    add(slopes.share[g], cell.group[g].share);
  }
  if (cell.reverse == ReverseLaw::kBishop) add(slopes.reverse_strength, cell.reverse_strength);
  if (cell.reverse != ReverseLaw::kShunt) {
    add(slopes.reverse_voltage, cell.reverse_voltage);
    add(slopes.reverse_exponent, cell.reverse_exponent);
  }
  const bool bypassed = std::any_of(cell.substring, cell.substring + cell.substrings,
                                    [](const Substring& one) { return one.bypassed; });
  if (bypassed) {
    add(slopes.bypass, cell.bypass);
    add(slopes.bypass_ideality, cell.bypass_ideality);
    add(slopes.thermal_voltage, cell.thermal_voltage);
  }
  if (cell.two_parts) {
    add(slopes.far_share, cell.far_share);
    add(slopes.far_resistance, cell.far_resistance);
  }
  return terms;
}

// Adds `factor` times the derivatives of the terms that effects add to a cell group's current.
template <class S>
void AddEffectTerms(const Place<S>& at, const StringState& state, const GroupPoint& point,
                    int group, const Pack& factor, S* sum) {
  S light = at.cell.photocurrent;
  if (at.plain.groups > 1) light = light * at.cell.group[group].light;
  const auto add = [&](const Pack& voltage, const Pack& by) {
    Add(by, AddEffects(at.context, at.cell, light, S(voltage), S(0.0)), sum);
  };
  if (!at.plain.two_parts) return add(state.u[group], factor);
  add(state.u[group], (1.0 - at.plain.far_share) * factor);
  add(state.far[group], at.plain.far_share * factor * point.follows);
}

// The delivered current with its derivatives, from the slopes at the root.
template <class S>
S DifferentiateCurrent(const Place<S>& at, const S& voltage, const StringState& state,
                       const StringRoot& root) {
  const StringSlopes& slopes = root.slopes;
  const Cell<Pack>& plain = at.plain;
  S current = root.current;
  AddSlopes(at.terms, at.size, &current);
  Add(root.fields.voltage, voltage, &current);
  for (int g = 0; at.effects.junction && g < plain.groups; ++g)
    AddEffectTerms(at, state, root.group[g], g, slopes.by_current[g], &current);
  if (!at.effects.series || plain.suns_voc) return current;
  for (int g = 0; plain.groups > 1 && g < plain.groups; ++g) {
    if (!plain.substring[plain.group[g].substring].parallel) continue;
    Add(slopes.by_chain_drop[g], MoreDrop(at.context, at.cell, S(root.group[g].current.a)),
        &current);
  }
  for (int s = 0; s < plain.strings; ++s)
    Add(slopes.by_drop[s], MoreDrop(at.context, at.cell, S(state.current[s])), &current);
  return current;
}

// Junction voltage of the first cell group at cell current `current`, with derivatives.
template <class S>
S DifferentiateJunction(const Place<S>& at, const StringState& state, const StringRoot& root,
                        const S& current) {
  const GroupPoint& point = root.group[0];
  const Pack slope = 1.0 / point.current.v[0];
  S junction = state.u[0];
  Add(slope, current, &junction);
  S group = 0.0;
  AddSlopes(TermsOf(root.first_group, at.cell, at.size), at.size, &group);
  if (at.effects.junction) AddEffectTerms(at, state, point, 0, Pack(1.0), &group);
  Add(-slope, group, &junction);
  return junction;
}

template <int N>
bool AllFinite(const Dual<N, Pack>& a, int size) {
  bool finite = AllFinite(a.a);
  for (int k = 0; k < size; ++k) finite = finite && AllFinite(a.v[k]);
  return finite;
}

void StoreRows(const Pack& values, const ReadingBlock& block, int stride, double* to) {
  Block lanes;
  every_processor::Store(values, &lanes);
  for (int i = 0; i < block.count; ++i) to[(block.first + i) * stride] = lanes.lane[i];
}

}  // namespace

struct LawWorkspace::State {
  std::vector<ReadingBlock> own;
  const std::vector<ReadingBlock>* blocks = nullptr;
  std::vector<StringState> strings;  // per block, from the last evaluation; may be empty
  bool fresh = true;
  GiveUp give_up = GiveUp::kNever;
};

LawWorkspace::LawWorkspace(GiveUp give_up) : give_up_(give_up) {}
LawWorkspace::LawWorkspace(const std::vector<ReadingBlock>& blocks)
    : state_(std::make_unique<State>()) {
  state_->blocks = &blocks;
}
LawWorkspace::~LawWorkspace() = default;
LawWorkspace::State* LawWorkspace::Of(const Readings& readings) {
  if (state_ == nullptr) {
    state_ = std::make_unique<State>();
    state_->own = BlocksOf(readings);
    state_->blocks = &state_->own;
    state_->strings.resize(state_->own.size());
    state_->give_up = give_up_;
  }
  return state_.get();
}

namespace {

template <class S>
bool Evaluate(const Law& law, const Readings& readings, const double* values,
              const std::vector<int>& free, LawWorkspace* workspace, double* current,
              double* jacobian) {
  constexpr bool kDerivatives = !std::is_same_v<S, Pack>;
  const int size = law.size(), moved = static_cast<int>(free.size());
  std::vector<Pack> plain_values(size);
  for (int k = 0; k < size; ++k) plain_values[k] = Pack(values[k]);
  const EvaluationContext<Pack> plain =
      MakeEvaluationContext(law, readings, static_cast<const Pack*>(plain_values.data()));
  std::vector<S> duals;
  if constexpr (kDerivatives) {
    duals.reserve(size);
    for (int k = 0; k < size; ++k) duals.push_back(S(Pack(values[k])));
    for (int i = 0; i < moved; ++i) duals[free[i]] = S(Pack(values[free[i]]), i);
  }
  const EvaluationContext<S> context =
      MakeEvaluationContext(law, readings, static_cast<const S*>(duals.data()));
  CellKeeper<Pack> plain_cells(plain);
  CellKeeper<S> cells(context);
  const bool instrument = HasInstrument(law);
  LawWorkspace::State& state = *workspace->Of(readings);
  StringLimits limits;
  StringState unkept;
  const StringEffects effects = EffectsOf(plain);
  StringRoot root;
  std::vector<SlopeTerm> terms;
  for (std::size_t b = 0; b < state.blocks->size(); ++b) {
    const ReadingBlock& block = (*state.blocks)[b];
    if (plain_cells.Settle(block)) limits = LimitsOf(plain_cells.cell());
    const Cell<Pack>& cell = plain_cells.cell();
    const Pack& temperature = plain_cells.conditions().temperature_K;
    if (!All((100.0 < temperature) & (temperature < 700.0))) return false;
    const bool kept = !state.strings.empty();
    StringState& at = kept ? state.strings[b] : unkept;
    const Pack& voltage = plain_cells.conditions().voltage;
    // A state with other numbers of groups, substrings or strings cannot be reused.
    const bool fresh = state.fresh || !at.Fits(cell);
    const bool follows =
        fresh && b > 0 &&
        StartBeside((*state.blocks)[b - 1], kept ? state.strings[b - 1] : unkept, block, cell, &at);
    if (!follows) Start(cell, limits, block, voltage, fresh, &at);
    const bool recorded_otherwise = instrument && !block.suns_voc;
    const Wanted wanted = !kDerivatives        ? Wanted::kCurrent
                          : recorded_otherwise ? Wanted::kJunctionSlopes
                                               : Wanted::kSlopes;
    SolveString(effects, cell, limits, voltage, state.give_up, wanted, &at, &root);
    if constexpr (!kDerivatives) {
      const Pack recorded =
          recorded_otherwise ? Recorded(plain, block, cell, root.current, at.u[0]) : root.current;
      if (!AllFinite(recorded)) return false;
      StoreRows(recorded, block, 1, current);
    } else {
      if (cells.Settle(block)) terms = TermsOf(root.fields, cells.cell(), moved);
      const Place<S> place{context, effects, cells.cell(), cell, moved, terms};
      S recorded = DifferentiateCurrent(place, cells.conditions().voltage, at, root);
      if (recorded_otherwise) {
        const S junction = DifferentiateJunction(place, at, root, recorded);
        recorded = Recorded(context, block, cells.cell(), recorded, junction);
      }
      if (!AllFinite(recorded, moved)) return false;
      StoreRows(recorded.a, block, 1, current);
      for (int i = 0; i < moved; ++i) StoreRows(recorded.v[i], block, size, jacobian + free[i]);
    }
  }
  state.fresh = state.strings.empty();
  return true;
}

}  // namespace

bool EvaluateLaw(const Law& law, const Readings& readings, const double* p, LawWorkspace* workspace,
                 double* current, double* jacobian, const std::vector<char>* fixed) {
  CHECK_LE(law.size(), kMostParameters);
  if (jacobian == nullptr) return Evaluate<Pack>(law, readings, p, {}, workspace, current, nullptr);
  std::vector<int> free;
  for (int k = 0; k < law.size(); ++k) {
    if (fixed == nullptr || (*fixed)[k] == 0) free.push_back(k);
  }
  if (static_cast<int>(free.size()) < law.size()) {
    std::fill(jacobian, jacobian + readings.points.size() * law.size(), 0.0);
  }
  const auto evaluate = free.size() <= 6    ? Evaluate<Narrow>
                        : free.size() <= 10 ? Evaluate<Middle>
                                            : Evaluate<Wide>;
  return evaluate(law, readings, p, free, workspace, current, jacobian);
}

}  // namespace lyrefit
