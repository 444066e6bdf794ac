#include "lyrefit/model/string.h"

#include <string_view>

#include "lyrefit/model/kernel.h"
#include "lyrefit/model/string_brackets.h"
#include "lyrefit/model/string_solve.h"

namespace lyrefit {

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

}  // namespace lyrefit
