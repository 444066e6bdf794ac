#pragma once

#include <string>
#include <vector>

namespace lyrefit {

// `sentence` with every number, and every quoted text, replaced by "N". Reasons that differ in these
// alone are of one kind.
std::string WithoutNumbers(const std::string& sentence);

// The first sentence of each kind, in their order, with the number of further ones behind it:
// "line 4: expected a number, found 'x' (and 160 more of the kind)".
std::vector<std::string> OncePerKind(const std::vector<std::string>& sentences);

}  // namespace lyrefit
