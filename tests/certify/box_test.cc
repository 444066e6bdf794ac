// Certificates within a box, which has a range for every parameter.
#include "lyrefit/certify/box.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "certify/made.h"
#include "error_of.h"
#include "lyrefit/certify/certify.h"
#include "lyrefit/certify/floor.h"
#include "lyrefit/certify/mixture.h"
#include "lyrefit/estimate/refine/refine.h"
#include "lyrefit/estimate/refine/separable.h"
#include "lyrefit/settings/bounds_file.h"
#include "repeats.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

// A range around a value that lies within it, at its end or outside.
std::pair<double, double> RangeNear(double value, RandomStream* random) {
  const double a = value * std::pow(10, 1.2 * random->Uniform() - 0.7);
  const double b = value * std::pow(10, 1.2 * random->Uniform() - 0.5);
  return {std::min(a, b), std::max(a, b)};
}

// A box near plausible parameters of the curve. Some diodes have their own ranges, and some lower
// limits of Is are above 0.
CertifyOptions RandomBox(const IvCurve& curve, RandomStream* random) {
  const MixtureData data = DataOf(curve);
  const double vt = curve.conditions.ModuleThermalVoltage(ConstantSet::kCodata);
  const double current = data.current_A.maxCoeff();
  const double resistance = data.reference_voltage_V / current;
  CertifyOptions options;
  options.effort = 3000;
  options.n_upper = 1.5 + 2 * random->Uniform();
  options.rs_upper_ohm = 0.5 * resistance * random->Uniform();
  if (random->Uniform() < 0.5) options.rs_lower_ohm = 0.1 * options.rs_upper_ohm;
  if (random->Uniform() < 0.5) options.iph_upper_A = current * (0.9 + 0.4 * random->Uniform());
  if (random->Uniform() < 0.3) options.iph_lower_A = current * (0.8 + 0.1 * random->Uniform());
  if (random->Uniform() < 0.7) {
    std::tie(options.rsh_lower_ohm, options.rsh_upper_ohm) = RangeNear(50 * resistance, random);
  }
  const auto is_range = [&](double n) {
    auto range = RangeNear(current / std::expm1(data.reference_voltage_V / (n * vt)), random);
    if (random->Uniform() < 0.5) range.first = 0;
    return range;
  };
  if (random->Uniform() < 0.5) {
    std::tie(options.is_lower_A, options.is_upper_A) = is_range(1 + random->Uniform());
    return options;
  }
  for (int d = 0; d < 3; ++d) {
    const double n = 1 + 0.5 * d;
    const auto [is_lower, is_upper] = is_range(n);
    options.diodes.push_back({n, n + 0.5 * random->Uniform(), is_lower, is_upper});
  }
  return options;
}

std::vector<double> PointInside(const RefineProblem& problem, const ModelRanges& ranges,
                                RandomStream* random) {
  std::vector<double> p(problem.device.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double t = random->Uniform();
    const double low = problem.lower[i], high = problem.upper[i];
    p[i] = low > 0 && high > 10 * low ? low * std::pow(high / low, t) : low + t * (high - low);
  }
  for (std::size_t d = 0; d < ranges.diodes.size(); ++d) {
    if (random->Uniform() < 0.5) continue;  // otherwise near a plausible diode
    const int is = SaturationCurrentIndex(static_cast<int>(d));
    const double n = p[IdealityIndex(static_cast<int>(d))];
    const double typical =
        problem.current_scale_A * random->Uniform() /
        std::expm1(ranges.reference_voltage_V / (n * problem.device.module_thermal_voltage_V));
    p[is] = std::min(std::max(typical, problem.lower[is]), problem.upper[is]);
  }
  return p;
}

bool Inside(const std::vector<double>& p, const CertifyOptions& options, double rs_upper_ohm) {
  const CertifyOptions every = WithEveryDiode(options);
  const auto within = [](double value, double lower, double upper) {
    return value >= lower && value <= upper;
  };
  bool inside = within(p[kIph], options.iph_lower_A, options.iph_upper_A) &&
                within(p[kRs], options.rs_lower_ohm, rs_upper_ohm) &&
                within(p[kRsh], options.rsh_lower_ohm, options.rsh_upper_ohm);
  for (int d = 0; IdealityIndex(d) < static_cast<int>(p.size()); ++d) {
    const DiodeRanges& diode = every.diodes[static_cast<std::size_t>(d)];
    inside = inside && within(p[IdealityIndex(d)], diode.n_lower, diode.n_upper) &&
             within(p[SaturationCurrentIndex(d)], diode.is_lower_A, diode.is_upper_A);
  }
  return inside;
}

// Points drawn from the box and refined in it never have an RMSE below the proved bound. The
// parameters that reach the upper bound lie inside the box.
void ExpectSound(const IvCurve& curve, const CertifyOptions& options, RandomStream* random,
                 int* certified) {
  const auto certificate = Certify(curve, options);
  ASSERT_TRUE(certificate) << certificate.error().ToString();
  const double rounding = 1e-14 * DataOf(curve).current_A.cwiseAbs().maxCoeff();
  for (const ModelCertificate& model : certificate->models) {
    const ModelRanges ranges =
        RangesOfModel(certificate->options, static_cast<int>(model.model),
                      certificate->rs_upper_ohm, certificate->reference_voltage_V);
    const RefineProblem problem =
        ModelProblem(curve, MakeDevice(model.model, curve.conditions), ranges);
    EXPECT_TRUE(Inside(model.parameters, options, certificate->rs_upper_ohm))
        << curve.name << " " << ToText(model.model);
    EXPECT_LE(model.lower_bound_A, model.rmse_A);
    EXPECT_LE(certificate->floor.lower_bound_A, model.rmse_A + rounding);
    *certified += model.certified ? 1 : 0;
    for (int start = 0; start < 6; ++start) {
      std::vector<double> p = PointInside(problem, ranges, random);
      EXPECT_GE(std::sqrt(MeanSquare(problem, p)), model.lower_bound_A);
      if (start % 2 == 1) p = SeparableDescent(problem, p);
      p = Refine(problem, p).p;
      for (std::size_t i = 0; i < p.size(); ++i) {
        p[i] = std::min(std::max(p[i], problem.lower[i]), problem.upper[i]);
      }
      EXPECT_GE(std::sqrt(MeanSquare(problem, p)), model.lower_bound_A - rounding)
          << curve.name << " " << ToText(model.model);
    }
  }
}

TEST(CertifyBox, NothingInsideUndercutsIt) {
  RandomStream random(31);
  int certified = 0;
  const int curves = Repeats(20);
  for (int seed = 900; seed < 900 + curves; ++seed) {
    const IvCurve curve = RandomCurve(seed);
    ExpectSound(curve, RandomBox(curve, &random), &random, &certified);
  }
  EXPECT_GE(certified, 3 * curves * 9 / 10);
}

// The bound that the dual vector of a mixture with ranges of Is proves, computed independently.
TEST(SolveMixture, ProvesItsOwnValueWithinRangesOfIs) {
  RandomStream random(32);
  int held = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const IvCurve curve = RandomCurve(seed);
    const MixtureData data = DataOf(curve);
    Window low = WindowOf(curve, 1.5, 2), high = WindowOf(curve, 1, 1.4);
    const double current = data.current_A.maxCoeff();
    for (Window* window : {&low, &high}) {
      const double typical = current / std::expm1(window->lower * data.reference_voltage_V);
      std::tie(window->saturation_lower_A, window->saturation_upper_A) =
          RangeNear(typical, &random);
    }
    const double rs = 0.05 * data.reference_voltage_V / current;
    const Mixture mixture = SolveMixture(data, {low, high}, rs, {}, 1e-11, 3 * current);
    EXPECT_LT(mixture.relative_gap, 1e-7) << curve.name;
    const Eigen::VectorXd vd = data.JunctionVoltage(rs);
    double dual = data.target_A.dot(mixture.y) - 0.5 * mixture.y.squaredNorm();
    const std::vector<Window> windows = {low, high};
    for (std::size_t w = 0; w < 2; ++w) {
      const Window& window = windows[w];
      const double pull = mixture.saturation_pulls[w];
      held += pull != 0 ? 1 : 0;
      dual -= pull * (pull > 0 ? window.saturation_upper_A : window.saturation_lower_A);
      double mass = 0;
      for (const Atom& atom : mixture.atoms) {
        if (atom.u < window.lower || atom.u > window.upper) continue;
        mass += atom.current_A / std::expm1(atom.u * data.reference_voltage_V);
      }
      EXPECT_GE(mass, window.saturation_lower_A * (1 - 1e-9)) << curve.name;
      EXPECT_LE(mass, window.saturation_upper_A * (1 + 1e-9)) << curve.name;
      for (int i = 0; i <= 500; ++i) {
        const double u = window.lower + (window.upper - window.lower) * i / 500;
        const double gain = DiodeColumn(vd, mixture.scale_voltage_V, u).dot(mixture.y);
        EXPECT_LE(gain - pull / std::expm1(u * mixture.scale_voltage_V),
                  mixture.excess + 1e-14 * current)
            << curve.name;
      }
    }
    EXPECT_NEAR(mixture.dual, dual, 1e-9 * mixture.primal + 1e-16) << curve.name;
  }
  EXPECT_GT(held, 20);
}

TEST(AsDiodes, SharesAtomsAmongDiodesThatMayNotVanish) {
  Mixture mixture;
  mixture.reference_voltage_V = 0.5;
  const auto atom = [](double u, double saturation_A) {
    return Atom{u, saturation_A * std::expm1(0.5 * u)};
  };
  const Window wide = {20, 40, 1e-8, 1e-6};
  mixture.atoms = {atom(30, 3e-8)};
  const auto both = AsDiodes(mixture, {wide, wide});
  ASSERT_TRUE(both);
  EXPECT_NEAR((*both)[0].saturation_A + (*both)[1].saturation_A, 3e-8, 1e-20);
  EXPECT_GE(std::min((*both)[0].saturation_A, (*both)[1].saturation_A), 1e-8);
  mixture.atoms = {atom(30, 1.9e-8)};
  EXPECT_FALSE(AsDiodes(mixture, {wide, wide}));  // too little for two diodes
  mixture.atoms = {atom(30, 2.1e-6)};
  EXPECT_FALSE(AsDiodes(mixture, {wide, wide}));            // too much
  EXPECT_FALSE(AsDiodes(mixture, {wide, {35, 40, 0, 1}}));  // outside of the second diode's range
  mixture.atoms = {atom(22, 1e-7), atom(38, 2e-7)};
  EXPECT_FALSE(AsDiodes(mixture, {wide}));
  const auto each = AsDiodes(mixture, {{35, 40, 0, 1}, wide});
  ASSERT_TRUE(each);
  EXPECT_EQ((*each)[0].u, 38);
}

CertifyOptions Published(const IvCurve& curve, const std::string& name) {
  return *CertifyWithin(*NamedBounds(name, std::string(LYREFIT_DATA_DIR) + "/" + curve.name), curve,
                        {});
}

TEST(CertifyBox, ProvesEveryModelInTheLiteraturesBoxes) {
  SKIP_IF_SANITIZED();
  const struct {
    const char *curve, *bounds;
    double sd, dd, td;
  } known[] = {{"rtc_france", "literature", 9.860218779e-4, 9.824848761e-4, 9.824848761e-4},
               {"rtc_france", "paper", 9.860218779e-4, 9.824848761e-4, 9.824848761e-4},
               {"pwp201", "literature", 2.425074868e-3, 1.606387144e-3, 1.603618381e-3},
               {"stm6_40_36", "literature", 1.729813710e-3, 1.688412363e-3, 1.688412363e-3},
               {"stp6_120_36", "literature", 1.660060313e-2, 1.660060313e-2, 1.660060313e-2},
               {"msx60", "paper", 8.824727075e-4, 9.013852839e-4, 9.203506507e-4}};
  for (const auto& one : known) {
    const IvCurve curve = Shipped(one.curve);
    const CertifyOptions options = Published(curve, one.bounds);
    const auto certificate = Certify(curve, options);
    ASSERT_TRUE(certificate) << certificate.error().ToString();
    EXPECT_TRUE(certificate->floor.certified) << one.curve;
    const double expected[] = {one.sd, one.dd, one.td};
    for (int m = 0; m < 3; ++m) {
      EXPECT_TRUE(certificate->models[m].certified) << one.curve << " " << m;
      EXPECT_NEAR(certificate->models[m].rmse_A / expected[m], 1, 2e-9) << one.curve << " " << m;
      EXPECT_TRUE(Inside(certificate->models[m].parameters, options, certificate->rs_upper_ohm));
    }
  }
}

// The paper's box requires at least 1e-8 A of both saturation currents, which excludes the optimum
// of a single diode.
TEST(CertifyBox, ProvesThatDiodesWhichMayNotVanishCost) {
  IvCurve hot = Shipped("msx60");
  hot.conditions.cell_temperature_K = 348.15;
  CertifyOptions options;
  options.constants = ConstantSet::kLiterature;
  options =
      *CertifyWithin(*NamedBounds("paper", std::string(LYREFIT_DATA_DIR) + "/msx60"), hot, options);
  const auto certificate = Certify(hot, options);
  ASSERT_TRUE(certificate);
  const double expected[] = {1.748061810e-3, 1.752734925e-3, 1.757409504e-3};
  for (int m = 0; m < 3; ++m) {
    EXPECT_TRUE(certificate->models[m].certified);
    EXPECT_NEAR(certificate->models[m].rmse_A / expected[m], 1, 1e-9);
  }
}

TEST(CertifyBox, RefusesRangesThatMakeNoSense) {
  const IvCurve curve = Shipped("rtc_france");
  CertifyOptions options;
  options.iph_lower_A = 2;
  options.iph_upper_A = 1;
  EXPECT_THAT(MessageOf(Certify(curve, options)),
              HasSubstr("iph-lower = 2 is above iph-upper = 1"));
  options = {};
  options.diodes = {{1, 2, 0, 0}};
  EXPECT_THAT(MessageOf(Certify(curve, options)), HasSubstr("a model has 3"));
  options.models = {Model::kSingleDiode};
  EXPECT_THAT(MessageOf(Certify(curve, options)), HasSubstr("diode 1"));
  options = {};
  options.n_upper = 3;
  EXPECT_THAT(MessageOf(CertifyWithin({}, curve, options)), HasSubstr("bounds 'physical'"));
}

}  // namespace
}  // namespace lyrefit
