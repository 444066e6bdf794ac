#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/law/extension.h"

namespace LYREFIT_PUBLIC lyrefit {

// "shading:d=0.3,w=0.2:0.4" as an effect of the catalogue and what is said of its parameters;
// DescribeUse() is the other way round.
Expected<EffectUse> ReadEffectUse(const std::string& text);

// Effects that are given one by one: see base/option.h.
template <auto First, auto... Rest>
constexpr auto EffectsOption() {
  using Options = ClassOf<First>;
  return OptionText<Options>{[](const std::string& text, Options* options) -> Expected<void> {
                               Expected<EffectUse> use = ReadEffectUse(text);
                               if (!use) return tl::unexpected<Error>(use.error());
                               Along<First, Rest...>(*options).push_back(std::move(*use));
                               return {};
                             },
                             [](const Options& options) {
                               std::vector<std::string> texts;
                               for (const EffectUse& use : Along<First, Rest...>(options)) {
                                 texts.push_back(DescribeUse(use));
                               }
                               return texts;
                             },
                             nullptr, true};
}

// What --help says of them, wherever they may be given.
inline constexpr char kEffectsUnit[] = "EFFECT[:P=VALUE|LOW:HIGH,...]";
inline constexpr char kEffectsDoc[] =
    "an effect beside the diodes, as diagnose --explain names it: alone, with what the shape of "
    "the curve suggests free; or with parameters held (d=0.3) or within a range (d=0:0.5); once "
    "for each";

}  // namespace lyrefit
