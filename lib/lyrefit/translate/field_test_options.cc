#include "lyrefit/translate/field_test_options.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

struct Bound {
  double value = 0;
  bool in_W = false;
};

// "-3", "+5%", "-0W"
Expected<Bound> ReadBound(std::string text) {
  Bound bound;
  const std::string whole = text;
  if (!text.empty() && (text.back() == 'W' || text.back() == '%')) {
    bound.in_W = text.back() == 'W';
    text.pop_back();
  }
  char* end = nullptr;
  bound.value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(std::fabs(bound.value) <= kOverflowCode)) {
    return Fail("expected a tolerance like -0,+5 or -0W,+5W, found '" + whole + "'");
  }
  return bound;
}

}  // namespace

Expected<PowerTolerance> ReadTolerance(const std::string& text) {
  TRY(const std::vector<std::string> parts, SplitList(text));
  if (parts.empty() || parts.size() > 2) {
    return Fail("expected a tolerance like -0,+5 or -0W,+5W, found '" + text + "'");
  }
  TRY(const Bound first, ReadBound(parts[0]));
  if (parts.size() == 1) {  // equal in both directions
    const double size = first.value < 0 ? -first.value : first.value;
    return PowerTolerance{-size, size, first.in_W};
  }
  TRY(const Bound second, ReadBound(parts[1]));
  if (!(first.value <= 0 && second.value >= 0)) {
    return Fail("expected a tolerance that holds the rating, like -0,+5, found '" + text + "'");
  }
  // The unit may follow only the last number.
  const bool first_bare = parts[0].back() != 'W' && parts[0].back() != '%';
  if (first.in_W != second.in_W && !first_bare) {
    return Fail("expected both ends of the tolerance in one unit, found '" + text + "'");
  }
  return PowerTolerance{first.value == 0 ? 0.0 : first.value, second.value, second.in_W};
}

std::string ToleranceText(const PowerTolerance& tolerance) {
  const char* unit = tolerance.in_W ? "W" : "";
  return fmt::format("-{:g}{},+{:g}{}", 0 - tolerance.low, unit, tolerance.high, unit);
}

}  // namespace lyrefit
