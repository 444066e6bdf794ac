#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ostream>
#include <string>

#include "effects/synthetic_readings.h"
#include "lyrefit/base/random.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/model/law.h"
#include "repeats.h"

namespace lyrefit {
namespace {

// One effect of the catalogue in one kind of data that can show it. Effects added to the catalogue
// are tested automatically.
struct Place {
  const Effect* effect;
  DataKind kind;
  int cells;
};

std::vector<Place> Places() {
  std::vector<Place> places;
  for (const Effect* effect : Catalogue()) {
    for (const DataKind kind : kDataKinds) {
      for (const int cells : {1, 60}) {
        const bool open = !effect->parameters.empty() &&
                          !effect->why_not(SyntheticReadings(kind, cells).traits).has_value();
        if (open) places.push_back({effect, kind, cells});
      }
    }
  }
  return places;
}

std::vector<Place> PlacesInDevices() {
  std::vector<Place> places = Places();
  const auto elsewhere = [](const Place& place) { return place.effect->where != Where::kDevice; };
  places.erase(std::remove_if(places.begin(), places.end(), elsewhere), places.end());
  return places;
}

std::string PlaceName(const ::testing::TestParamInfo<Place>& info) {
  return std::string(info.param.effect->id) + "_" + NameOf(info.param.kind) +
         std::to_string(info.param.cells);
}

void PrintTo(const Place& place, std::ostream* out) { *out << place.effect->id; }

class LawEffectsTest : public ::testing::TestWithParam<Place> {
 protected:
  const Effect& effect() const { return *GetParam().effect; }
  const Readings readings_ = SyntheticReadings(GetParam().kind, GetParam().cells);

  // About a dozen probes, evenly spread over all.
  std::vector<Probe> SomeProbes() const {
    const std::vector<Probe> all = effect().probes(readings_.traits);
    const std::size_t stride = std::max<std::size_t>(1, all.size() / (kSanitized ? 2 : 12));
    std::vector<Probe> some;
    for (std::size_t k = 0; k < all.size(); k += stride) some.push_back(all[k]);
    // Includes half-cut modules: with two parallel chains, the weak cell lacks twice the
    // substring's deficit.
    const std::size_t chains = effect().parameters.size() - 1;
    if (std::string(effect().parameters.back().symbol) != "chains") return some;
    for (std::size_t k = some.size(); k-- > 0;) {
      some.push_back(some[k]);
      some.back()[chains] = 2;
      if (effect().parameters.front().upper < 1) some.back()[0] /= 2;
    }
    return some;
  }
};

// One parameter's column of the Jacobian, and central differences of fourth order for comparison.
struct Column {
  std::vector<double> exact;
  std::vector<double> difference;
  std::vector<char> kinked;  // where the slope jumps within the difference
  double largest = 1e-9;
};

std::vector<double> ExactColumn(const Settled& at, const Readings& readings, int parameter) {
  const std::vector<double> jacobian = Jacobian(at.law, readings, at.p);
  std::vector<double> column;
  for (std::size_t k = parameter; k < jacobian.size(); k += at.law.size()) {
    column.push_back(jacobian[k]);
  }
  return column;
}

Column CompareColumn(const Settled& at, const Readings& readings, int parameter, double part) {
  const EffectParameter* own = at.law.EffectParameterAt(parameter);
  const double range = own != nullptr ? own->upper - own->lower : 0;
  const double step = part * std::max(std::fabs(at.p[parameter]), 1e-2 * std::min(range, 20.0));
  const auto moved = [&](double steps) {
    Settled there = at;
    there.p[parameter] += steps * step;
    return there;
  };
  const auto current = [&](double steps) { return Currents(at.law, readings, moved(steps).p); };
  const auto far_down = current(-2), down = current(-1), up = current(1), far_up = current(2);
  const auto before = ExactColumn(moved(-2), readings, parameter);
  const auto after = ExactColumn(moved(2), readings, parameter);
  Column column;
  column.exact = ExactColumn(at, readings, parameter);
  for (const double slope : column.exact) {
    column.largest = std::max(column.largest, std::fabs(slope));
  }
  for (std::size_t k = 0; k < up.size(); ++k) {
    column.difference.push_back((8 * (up[k] - down[k]) - (far_up[k] - far_down[k])) / (12 * step));
    const double size = std::max(std::fabs(before[k]), std::fabs(after[k]));
    column.kinked.push_back(std::fabs(after[k] - before[k]) > 0.5 * size);
  }
  return column;
}

TEST_P(LawEffectsTest, DerivativesAreThoseOfTheCurrents) {
  double worst = 0;
  int kinked = 0, compared = 0;
  for (const Probe& probe : SomeProbes()) {
    const Settled at = WithEffect(effect(), probe, readings_);
    for (int parameter = 0; parameter < at.law.size(); ++parameter) {
      const int own = parameter - at.law.base_size();
      // the parameter has no influence
      if (own >= 0 && probe[own] == effect().parameters[own].absent_at) continue;
      // Long steps fail at sharp bends, short steps at rounding.
      const Column column = CompareColumn(at, readings_, parameter, 1e-3);
      const Column close = CompareColumn(at, readings_, parameter, 5e-5);
      ASSERT_EQ(column.exact.size(), readings_.points.size());
      for (std::size_t k = 0; k < column.exact.size(); ++k) {
        const double apart = std::min(std::fabs(column.exact[k] - column.difference[k]),
                                      std::fabs(column.exact[k] - close.difference[k])) /
                             column.largest;
        ++compared;
        kinked += apart > 1e-5 && column.kinked[k] != 0;
        if (column.kinked[k] != 0) continue;
        worst = std::max(worst, apart);
        EXPECT_LT(apart, 1e-5) << "parameter " << parameter << ", reading " << k << ", strength "
                               << probe[0];
      }
    }
  }
  EXPECT_LE(kinked, compared / 50);
  RecordProperty("worst", std::to_string(1e9 * worst) + "e-9");
}

TEST_P(LawEffectsTest, CurrentsAreTheSameWithAndWithoutDerivatives) {
  for (const Probe& probe : SomeProbes()) {
    const Settled at = WithEffect(effect(), probe, readings_);
    const std::vector<double> plain = Currents(at.law, readings_, at.p);
    ASSERT_FALSE(plain.empty());
    LawWorkspace workspace;
    std::vector<double> current(plain.size()), jacobian(plain.size() * at.law.size());
    ASSERT_TRUE(
        EvaluateLaw(at.law, readings_, at.p.data(), &workspace, current.data(), jacobian.data()));
    for (std::size_t k = 0; k < plain.size(); ++k) EXPECT_NEAR(current[k], plain[k], 1e-10);
  }
}

TEST_P(LawEffectsTest, IsNotThereAtItsNeutralValue) {
  const std::vector<double> base = Currents(Law{}, readings_, ParametersOf({}, readings_));
  const Settled at = WithEffect(effect(), NeutralValues(effect()), readings_);
  const std::vector<double> current = Currents(at.law, readings_, at.p);
  ASSERT_FALSE(current.empty());
  for (std::size_t k = 0; k < base.size(); ++k) {
    // Bypass diodes conduct in reverse even without shading.
    if (readings_.points[k].voltage < 0.02 && readings_.traits.module) continue;
    EXPECT_NEAR(current[k], base[k], 1e-6) << k;
  }
}

TEST_P(LawEffectsTest, ShowsAtItsProbes) {
  const std::vector<double> base = Currents(Law{}, readings_, ParametersOf({}, readings_));
  for (const Probe& probe : SomeProbes()) {
    const Settled at = WithEffect(effect(), probe, readings_);
    const std::vector<double> current = Currents(at.law, readings_, at.p);
    double moved = 0;
    for (std::size_t k = 0; k < base.size(); ++k) {
      moved = std::max(moved, std::fabs(current[k] - base[k]));
    }
    EXPECT_GT(moved, 1e-6) << probe[0];
  }
}

using DeviceEffectsTest = LawEffectsTest;

TEST_P(DeviceEffectsTest, CurrentsNeverRiseWithVoltage) {
  for (const Probe& probe : SomeProbes()) {
    const Settled at = WithEffect(effect(), probe, readings_);
    const std::vector<double> current = Currents(at.law, readings_, at.p);
    for (std::size_t k = 1; k < current.size(); ++k) {
      const Reading &a = readings_.points[k - 1], &b = readings_.points[k];
      if (a.segment != b.segment) continue;
      const double rise = (current[k] - current[k - 1]) * (b.voltage > a.voltage ? 1 : -1);
      EXPECT_LE(rise, 1e-12) << b.voltage << " V, strength " << probe[0];
    }
  }
}

// Models with more than six or ten parameters use a wider number type in each stage.
TEST_P(LawEffectsTest, LargeModelsSeeTheSameEffect) {
  const std::vector<const Effect*> idle = {FindEffect("drift"), FindEffect("temp_drift"),
                                           FindEffect("voltage_offset"),
                                           FindEffect("current_offset")};
  for (const Probe& probe : SomeProbes()) {
    const Settled narrow = WithEffect(effect(), probe, readings_);
    Settled wide = narrow;
    wide.law.effects.insert(wide.law.effects.end(), idle.begin(), idle.end());
    wide.p.resize(wide.law.size(), 0.0);
    if (narrow.law.size() > 10) return;  // has the widest type already
    ASSERT_TRUE(narrow.law.size() <= 6 ? wide.law.size() > 6 : wide.law.size() > 10);
    const std::vector<double> a = Jacobian(narrow.law, readings_, narrow.p);
    const std::vector<double> b = Jacobian(wide.law, readings_, wide.p);
    ASSERT_FALSE(a.empty() || b.empty());
    for (std::size_t k = 0; k < readings_.points.size(); ++k) {
      for (int i = 0; i < narrow.law.size(); ++i) {
        const double expected = a[k * narrow.law.size() + i];
        EXPECT_NEAR(b[k * wide.law.size() + i], expected, 1e-12 * (1 + std::fabs(expected)));
      }
    }
  }
}

// With any parameters inside their bounds, an evaluation ends, and gives finite currents or none.
TEST_P(LawEffectsTest, OddParametersGiveFiniteCurrentsOrNone) {
  RandomStream random(17);
  int fine = 0;
  constexpr int kDraws = kSanitized ? 20 : 60;
  for (int draw = 0; draw < kDraws; ++draw) {
    Settled at = WithEffect(effect(), NeutralValues(effect()), readings_);
    at.law.model = draw % 2 == 1 ? Model::kDoubleDiode : Model::kSingleDiode;
    const auto between = [&](double lower, double upper) {
      const std::uint32_t corner = random.Index(3);
      if (corner < 2) return corner == 0 ? lower : upper;
      return lower + (upper - lower) * random.Uniform();
    };
    const CellValues cell = {between(0, 1.2e4), between(-60, 40), between(0.2, 8),
                             between(0, 3),     between(0, 50),   between(0, 20)};
    at.p = ParametersOf(cell, readings_, at.law.model);
    for (const EffectParameter& own : effect().parameters) {
      at.p.push_back(between(own.lower, own.upper));
    }
    LawWorkspace workspace;
    std::vector<double> current(readings_.points.size());
    std::vector<double> jacobian(current.size() * at.law.size());
    if (!EvaluateLaw(at.law, readings_, at.p.data(), &workspace, current.data(), nullptr)) continue;
    ++fine;
    for (const double i : current) ASSERT_TRUE(std::isfinite(i)) << "draw " << draw;
    if (!EvaluateLaw(at.law, readings_, at.p.data(), &workspace, current.data(), jacobian.data())) {
      continue;
    }
    for (const double i : current) ASSERT_TRUE(std::isfinite(i)) << "draw " << draw;
    for (const double slope : jacobian) ASSERT_TRUE(std::isfinite(slope)) << "draw " << draw;
  }
  EXPECT_GT(fine, kDraws / 4);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, LawEffectsTest, ::testing::ValuesIn(Places()), PlaceName);
INSTANTIATE_TEST_SUITE_P(Catalogue, DeviceEffectsTest, ::testing::ValuesIn(PlacesInDevices()),
                         PlaceName);

}  // namespace
}  // namespace lyrefit
