#include "lyrefit/model/string.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstring>

#include "lyrefit/base/random.h"
#include "lyrefit/model/kernel.h"
#include "repeats.h"
#include "synthetic/draw.h"

namespace lyrefit {
namespace {

using Quad = boost::multiprecision::cpp_bin_float_quad;
constexpr int kLanes = Block::kLanes;

template <class F>
Pack Draw(F draw) {
  Block block;
  for (double& lane : block.lane) lane = draw();
  return every_processor::Load(block);
}

// Eight strings of one layout, one per lane. Each has its own values, drawn from ranges far wider
// than those of real modules.
class Strings {
 public:
  explicit Strings(RandomStream* random) : random_(*random) {
    cell_.group = groups_;
    DrawCells();
    DrawShape();
    DrawReverse();
    voltage_ = Draw([&] { return Between(-0.7, 0.78); });
    // A string in which every substring has a bypass diode is a short circuit beyond the sum of
    // their voltages.
    for (int string = 0; string < cell_.strings; ++string) {
      bool open = false;
      Pack lowest = 0.0, weight = 0.0;
      for (int g = 0; g < cell_.groups; ++g) {
        const Substring& substring = cell_.substring[cell_.groups == 1 ? 0 : groups_[g].substring];
        if (substring.string != string) continue;
        open = open || !substring.bypassed;
        lowest = lowest - groups_[g].share * cell_.bypass / substring.cells;
        weight = weight + groups_[g].share;
      }
      if (!open) voltage_ = Larger(voltage_, lowest / weight);
    }
  }
  Strings(const Strings&) = delete;

  const Cell<Pack>& cell() const { return cell_; }
  const Pack& voltage() const { return voltage_; }

 private:
  double Between(double low, double high) { return low + (high - low) * random_.Uniform(); }
  bool OneIn(int times) { return random_.Index(times) == 0; }

  void DrawCells() {
    const double k_eV = ThermalVoltage(1.0);
    cell_.thermal_voltage = Draw([&] { return k_eV * Between(250, 350); });
    cell_.photocurrent = Draw([&] { return Between(0.05, 1.3); });
    cell_.diodes = 1 + static_cast<int>(random_.Index(2));
    for (int d = 0; d < cell_.diodes; ++d) {
      const Pack n_vt = cell_.thermal_voltage * Draw([&] { return Between(0.9, 2); });
      cell_.diode[d].inverse_n_vt = 1.0 / n_vt;
      cell_.diode[d].saturation = exp(-Draw([&] { return Between(0.4, 0.8); }) / n_vt);
    }
    cell_.conductance = Draw([&] { return LogUniform(&random_, 1e-8, 0.5); });
    cell_.resistance = Draw([&] { return OneIn(10) ? 0 : LogUniform(&random_, 1e-4, 0.4); });
    cell_.two_parts = OneIn(8);
    cell_.far_share = Draw([&] { return Between(0.01, 0.97); });
    cell_.far_resistance = Draw([&] { return LogUniform(&random_, 1e-3, 2); });
  }

  void DrawShape() {
    cell_.cells = 1 + static_cast<double>(random_.Index(144));
    cell_.substrings = OneIn(5) ? 1 : 1 + static_cast<int>(random_.Index(5));
    cell_.groups = cell_.substrings == 1 ? 1 : cell_.substrings;
    cell_.groups += static_cast<int>(random_.Index(kMostGroups - cell_.groups + 1));
    cell_.strings = cell_.substrings > 1 && OneIn(4) ? 2 : 1;
    for (int p = 0; p < cell_.substrings; ++p) {
      cell_.substring[p].bypassed = cell_.groups > 1 && !OneIn(3);
      cell_.substring[p].cells = 1 + static_cast<double>(random_.Index(32));
      cell_.substring[p].string = p == 0 ? 0 : static_cast<int>(random_.Index(cell_.strings));
    }
    if (cell_.strings == 2) cell_.substring[1].string = 1;
    cell_.bypass = Draw([&] { return Between(0.2, 0.9); });
    cell_.bypass_ideality = Draw([&] { return Between(0.8, 2); });
    Pack sum = 0.0;
    for (int g = 0; g < cell_.groups; ++g) {
      CellGroup<Pack>& group = groups_[g];
      group.share = Draw([&] { return LogUniform(&random_, 0.01, 1); });
      group.light = Draw([&] { return OneIn(6) ? 0 : Between(0, 1.1); });
      group.leak = Draw([&] { return OneIn(2) ? 0 : LogUniform(&random_, 1e-4, 1); });
      group.substring =
          g < cell_.substrings ? g : static_cast<int>(random_.Index(cell_.substrings));
      sum = sum + group.share;
    }
    for (int g = 0; g < cell_.groups; ++g) groups_[g].share = groups_[g].share / sum;
  }

  void DrawReverse() {
    cell_.reverse = static_cast<ReverseLaw>(random_.Index(3));
    cell_.reverse_strength = Draw([&] { return LogUniform(&random_, 1e-3, 1); });
    cell_.reverse_voltage = Draw([&] { return Between(2, 25); });
    cell_.reverse_exponent = Draw([&] { return Between(2, 4); });
  }

  RandomStream& random_;
  Cell<Pack> cell_;
  CellGroup<Pack> groups_[kMostGroups];
  Pack voltage_;
};

// One lane of the strings, implemented independently of the library over any number type.
template <class T>
class Lane {
 public:
  Lane(const Cell<Pack>& cell, const Pack& voltage, int lane)
      : cell_(cell), lane_(lane), voltage_(voltage[lane]) {}

  // Residuals of the equations. Order of the unknowns: junction voltages of each cell group, near
  // and far; current J and voltage U of each substring; current I of each string.
  std::vector<T> Residuals(const std::vector<T>& x) const {
    const T* u = x.data();
    const T* far = u + cell_.groups;
    const T* carried = far + (cell_.two_parts ? cell_.groups : 0);
    const T* substring = carried + cell_.substrings;
    const T* string = substring + cell_.substrings;
    std::vector<T> left;
    std::vector<T> weight(cell_.substrings, T(0)), sum(cell_.substrings, T(0));
    for (int g = 0; g < cell_.groups; ++g) {
      const int p = cell_.groups == 1 ? 0 : cell_.group[g].substring;
      const T share = cell_.groups == 1 ? T(1) : T(cell_.group[g].share[lane_]);
      T current = Junction(g, u[g]);
      if (cell_.two_parts) {
        const T there = Junction(g, far[g]), part = T(cell_.far_share[lane_]);
        left.push_back(u[g] + T(cell_.far_resistance[lane_]) * there - far[g]);
        current = (1 - part) * current + part * there;
      }
      left.push_back(current - carried[p]);
      weight[p] += share;
      sum[p] += share * u[g];
    }
    std::vector<T> along(cell_.strings, T(0)), cells(cell_.strings, T(0));
    for (int p = 0; p < cell_.substrings; ++p) {
      const int s = cell_.substring[p].string;
      left.push_back(sum[p] / weight[p] - T(cell_.resistance[lane_]) * string[s] - substring[p]);
      left.push_back(carried[p] + Bypass(p, substring[p]) - string[s]);
      along[s] += weight[p] * substring[p];
      cells[s] += weight[p];
    }
    for (int s = 0; s < cell_.strings; ++s) left.push_back(along[s] - cells[s] * T(voltage_));
    return left;
  }

 private:
  T Junction(int g, const T& v) const {
    using std::exp;
    using std::log;
    const bool alike = cell_.groups == 1;
    T light = T(cell_.photocurrent[lane_]);
    T conductance = T(cell_.conductance[lane_]);
    const T least = alike ? T(1e-13) : T(cell_.group[g].leak[lane_]) + T(1e-8);
    if (!alike) light *= T(cell_.group[g].light[lane_]);
    T current = light - (conductance + least) * v;
    for (int d = 0; d < cell_.diodes; ++d) {
      current -= T(cell_.diode[d].saturation[lane_]) *
                 (exp(v * T(cell_.diode[d].inverse_n_vt[lane_])) - 1);
    }
    if (cell_.reverse == ReverseLaw::kShunt || !(v < 0)) return current;
    const T depth = -v / T(cell_.reverse_voltage[lane_]);
    const T m = T(cell_.reverse_exponent[lane_]);
    if (cell_.reverse == ReverseLaw::kSoft) {
      return depth < 1e-9 ? T(current + T(cell_.photocurrent[lane_]) * exp(m * log(T(1e-9))))
                          : T(current + T(cell_.photocurrent[lane_]) * exp(m * log(depth)));
    }
    const T strength = conductance * T(cell_.reverse_strength[lane_]);
    const T width = T(cell_.reverse_voltage[lane_]);
    const T deepest = T(0.98);
    if (!(depth > deepest)) return current - strength * v * exp(-m * log(T(1 - depth)));
    const T edge = -deepest * width, factor = exp(-m * log(T(1 - deepest)));
    const T slope = factor * (1 - edge * m / (width * (1 - deepest)));
    return current - strength * (edge * factor + (v - edge) * slope);
  }

  T Bypass(int p, const T& voltage) const {
    using std::exp;
    if (!cell_.substring[p].bypassed) return T(0);
    const T n_vt = T(cell_.bypass_ideality[lane_]) * T(cell_.thermal_voltage[lane_]);
    return exp(-T(cell_.bypass[lane_]) / n_vt) *
           (exp(-voltage * T(cell_.substring[p].cells) / n_vt) - 1);
  }

  const Cell<Pack>& cell_;
  int lane_;
  double voltage_;
};

std::vector<double> StateOf(const Cell<Pack>& cell, const StringState& state,
                            const StringRoot& root, int lane) {
  std::vector<double> x;
  for (int g = 0; g < cell.groups; ++g) x.push_back(state.u[g][lane]);
  for (int g = 0; g < cell.groups && cell.two_parts; ++g) x.push_back(state.far[g][lane]);
  for (int p = 0; p < cell.substrings; ++p) {
    for (int g = 0; g < cell.groups; ++g) {
      if (cell.groups > 1 && cell.group[g].substring != p) continue;
      x.push_back(root.group[g].current.a[lane]);
      break;
    }
  }
  for (int p = 0; p < cell.substrings; ++p) x.push_back(state.substring_voltage[p][lane]);
  for (int s = 0; s < cell.strings; ++s) x.push_back(state.current[s][lane]);
  return x;
}

// Error of the strings' currents, by Newton steps with residuals in 113 bits.
double CurrentError(const Strings& strings, const StringState& state, const StringRoot& root,
                    int lane) {
  const Cell<Pack>& cell = strings.cell();
  const Lane<Quad> exact(cell, strings.voltage(), lane);
  const Lane<double> plain(cell, strings.voltage(), lane);
  const std::vector<double> found = StateOf(cell, state, root, lane);
  std::vector<Quad> x(found.begin(), found.end());
  const int size = static_cast<int>(x.size());
  for (int k = 0; k < 4; ++k) {
    const std::vector<Quad> left = exact.Residuals(x);
    Eigen::MatrixXd slopes(size, size);
    Eigen::VectorXd rest(size);
    for (int j = 0; j < size; ++j) {
      std::vector<double> up, down;
      for (const Quad& value : x) up.push_back(static_cast<double>(value));
      down = up;
      const double step = 1e-7 * (1 + std::fabs(up[j]));
      up[j] += step;
      down[j] -= step;
      const std::vector<double> above = plain.Residuals(up), below = plain.Residuals(down);
      for (int i = 0; i < size; ++i) slopes(i, j) = (above[i] - below[i]) / (up[j] - down[j]);
    }
    for (int i = 0; i < size; ++i) rest[i] = static_cast<double>(left[i]);
    const Eigen::VectorXd move = slopes.fullPivLu().solve(rest);
    for (int i = 0; i < size; ++i) x[i] -= move[i];
    if (move.tail(cell.strings).cwiseAbs().maxCoeff() < 1e-13) break;
  }
  double error = 0;
  for (int s = 0; s < cell.strings; ++s) {
    const int at = size - cell.strings + s;
    error = std::max(error, std::fabs(static_cast<double>(x[at] - found[at])));
  }
  return error;
}

StringState ColdStart(const Strings& strings, const StringLimits& limits) {
  StringState state;
  const Cell<Pack>& cell = strings.cell();
  StartString(cell, limits, strings.voltage(), Pack(0.0), &state);
  return state;
}

TEST(StringTest, ReachesTheRootOfRandomStrings) {
  RandomStream random(20260101);
  const Law law;
  const Readings readings;
  const EvaluationContext<Pack> context =
      MakeEvaluationContext(law, readings, static_cast<const Pack*>(nullptr));
  const StringEffects effects = EffectsOf(context);
  double worst = 0;
  int wrong = 0;
  for (int k = 0; k < Repeats(12500, 500); ++k) {
    const Strings strings(&random);
    const StringLimits limits = LimitsOf(strings.cell());
    StringState state = ColdStart(strings, limits);
    StringRoot root;
    SolveString(effects, strings.cell(), limits, strings.voltage(), GiveUp::kNever,
                Wanted::kCurrent, &state, &root);
    for (int lane = 0; lane < kLanes; ++lane) {
      ASSERT_TRUE(std::isfinite(root.current[lane])) << k;
      const double error =
          CurrentError(strings, state, root, lane) / (1 + std::fabs(root.current[lane]));
      worst = std::max(worst, error);
      wrong += !(error < 1e-10);
      if (!(error < 1e-10) && wrong < 10) {
        ADD_FAILURE() << k << " lane " << lane << " error " << error << " kinds "
                      << strings.cell().groups << " parts " << strings.cell().substrings
                      << " strings " << strings.cell().strings << " two_parts "
                      << strings.cell().two_parts << " reverse "
                      << static_cast<int>(strings.cell().reverse) << " V "
                      << strings.voltage()[lane] << " I " << root.current[lane];
      }
    }
  }
  EXPECT_EQ(wrong, 0);
  RecordProperty("worst", std::to_string(worst * 1e12) + "e-12");
}

// The numbers of a root with its slopes.
std::vector<double> NumbersOf(const Cell<Pack>& cell, const StringState& state,
                              const StringRoot& root) {
  std::vector<double> numbers;
  const auto add = [&](const Pack& pack) {
    for (int lane = 0; lane < kLanes; ++lane) numbers.push_back(pack[lane]);
  };
  add(root.current);
  for (int s = 0; s < cell.strings; ++s) add(state.current[s]);
  for (const FieldSlopes* slopes : {&root.fields, &root.first_group}) {
    for (const Pack* one :
         {&slopes->photocurrent, &slopes->conductance, &slopes->resistance, &slopes->voltage,
          &slopes->reverse_strength, &slopes->reverse_voltage, &slopes->reverse_exponent,
          &slopes->bypass, &slopes->bypass_ideality, &slopes->thermal_voltage, &slopes->far_share,
          &slopes->far_resistance}) {
      add(*one);
    }
    for (int d = 0; d < cell.diodes; ++d) {
      add(slopes->saturation[d]);
      add(slopes->inverse_n_vt[d]);
    }
    for (int g = 0; g < cell.groups; ++g) {
      add(slopes->light[g]);
      add(slopes->leak[g]);
      add(slopes->share[g]);
    }
  }
  return numbers;
}

TEST(StringTest, RegistersOfAllWidthsGiveTheSameBits) {
  RandomStream random(20261129);
  const Law law;
  const Readings readings;
  const EvaluationContext<Pack> context =
      MakeEvaluationContext(law, readings, static_cast<const Pack*>(nullptr));
  const StringEffects effects = EffectsOf(context);
  EXPECT_EQ(StringKernels().size(), AvailableKernels().size());
  for (int k = 0; k < Repeats(4000, 400); ++k) {
    const Strings strings(&random);
    const Cell<Pack>& cell = strings.cell();
    const StringLimits limits = LimitsOf(cell);
    std::vector<double> portable;
    for (const StringKernel& kernel : StringKernels()) {
      StringState state = ColdStart(strings, limits);
      StringRoot root;
      kernel.solve(effects, &cell, &limits, &strings.voltage(), GiveUp::kNever,
                   Wanted::kJunctionSlopes, &state, &root);
      const std::vector<double> numbers = NumbersOf(cell, state, root);
      if (portable.empty()) portable = numbers;
      ASSERT_EQ(std::memcmp(numbers.data(), portable.data(), numbers.size() * sizeof(double)), 0)
          << kernel.name << " " << k;
    }
  }
}

TEST(StringTest, SlopesByTheFieldsAreThoseOfDifferences) {
  RandomStream random(7);
  const Law law;
  const Readings readings;
  const EvaluationContext<Pack> context =
      MakeEvaluationContext(law, readings, static_cast<const Pack*>(nullptr));
  const StringEffects effects = EffectsOf(context);
  int compared = 0;
  for (int k = 0; k < Repeats(400, 60); ++k) {
    const Strings strings(&random);
    Cell<Pack> cell = strings.cell();
    const StringLimits limits = LimitsOf(cell);
    const auto solved = [&](StringRoot* root) {
      StringState state = ColdStart(strings, limits);
      SolveString(effects, cell, limits, strings.voltage(), GiveUp::kNever, Wanted::kSlopes, &state,
                  root);
    };
    StringRoot root, up, down;
    solved(&root);
    const auto compare = [&](Pack* field, const Pack& slope, const char* name) {
      constexpr double kStep = 1e-6;
      const Pack before = *field, step = kStep * (1e-3 + abs(before));
      *field = before + step;
      solved(&up);
      *field = before - step;
      solved(&down);
      *field = before;
      const Pack found = (up.current - down.current) / (2.0 * step);
      for (int lane = 0; lane < kLanes; ++lane) {
        const double rise = up.current[lane] - root.current[lane],
                     fall = root.current[lane] - down.current[lane];
        const bool bends = std::fabs(rise - fall) > 1e-4 * (std::fabs(rise) + std::fabs(fall));
        if (bends || std::fabs(root.current[lane]) > 50) continue;  // differences mislead
        const double size = 1 + std::fabs(slope[lane]);
        EXPECT_NEAR(found[lane], slope[lane], 1e-3 * size) << name << " " << k << " " << lane;
        ++compared;
      }
    };
    compare(&cell.photocurrent, root.fields.photocurrent, "photocurrent");
    compare(&cell.conductance, root.fields.conductance, "conductance");
    compare(&cell.resistance, root.fields.resistance, "resistance");
    if (cell.reverse == ReverseLaw::kBishop)
      compare(&cell.reverse_strength, root.fields.reverse_strength, "reverse strength");
    if (cell.reverse != ReverseLaw::kShunt) {
      compare(&cell.reverse_voltage, root.fields.reverse_voltage, "reverse voltage");
      compare(&cell.reverse_exponent, root.fields.reverse_exponent, "reverse exponent");
    }
    for (int g = 0; cell.groups > 1 && g < cell.groups; ++g) {
      compare(&cell.group[g].light, root.fields.light[g], "light");
      compare(&cell.group[g].leak, root.fields.leak[g], "leak");
    }
    if (std::any_of(cell.substring, cell.substring + cell.substrings,
                    [](const Substring& one) { return one.bypassed; })) {
      compare(&cell.bypass, root.fields.bypass, "bypass");
      compare(&cell.bypass_ideality, root.fields.bypass_ideality, "bypass ideality");
    }
    if (cell.two_parts) {
      compare(&cell.far_share, root.fields.far_share, "far share");
      compare(&cell.far_resistance, root.fields.far_resistance, "far resistance");
    }
  }
  EXPECT_GT(compared, 1000);
}

}  // namespace
}  // namespace lyrefit
