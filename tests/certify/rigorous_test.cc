// Bounds that are valid despite rounding errors. They are compared, without a tolerance, with
// values rounded outwards from 113 bits.
#include <gtest/gtest.h>

#include "certify/made.h"
#include "lyrefit/certify/box.h"
#include "lyrefit/certify/certify.h"
#include "lyrefit/certify/correlation.h"
#include "lyrefit/certify/part_bound.h"
#include "lyrefit/certify/real_data.h"
#include "lyrefit/certify/relaxation.h"
#include "lyrefit/certify/upper_bound.h"
#include "lyrefit/estimate/refine/refine.h"
#include "lyrefit/estimate/refine/separable.h"
#include "repeats.h"

namespace lyrefit {
namespace {

CertifyOptions Rigorous() {
  CertifyOptions options;
  options.rigorous = true;
  return options;
}

double ExactRmse(const IvCurve& curve, const Device& device, const std::vector<double>& p) {
  std::vector<SafeDiode> diodes;
  for (int d = 0; d < DiodeCount(device); ++d) {
    diodes.push_back({p[IdealityIndex(d)], p[SaturationCurrentIndex(d)]});
  }
  return SafeUpperRmse(curve, SafeThermalVoltage(curve.conditions, ConstantSet::kCodata), p[kIph],
                       p[kRs], WideInterval(1) / WideInterval(p[kRsh]), diodes);
}

// A curve of two diodes with so little noise that the errors of double arithmetic matter.
IvCurve NearlyExact(const std::string& name, double noise, std::uint64_t seed) {
  IvCurve curve = Shipped(name);
  const Device device = MakeDevice(Model::kDoubleDiode, curve.conditions);
  const std::vector<double> truth =
      name == "msx60" ? std::vector<double>{3.8, 2e-8, 1.3, 0.2, 300, 1e-6, 1.9}
                      : std::vector<double>{0.76, 2e-7, 1.45, 0.036, 55, 7e-7, 1.9};
  curve.current_A = SolveCurrents(device, truth.data(), curve.voltage_V);
  RandomStream random(seed);
  for (double& i : curve.current_A) i += noise * random.Normal();
  return curve;
}

class RigorousShipped : public ::testing::TestWithParam<const char*> {};

TEST_P(RigorousShipped, CertifiesAsTheSearchInDoublesDoes) {
  SKIP_IF_SANITIZED();
  const IvCurve curve = Shipped(GetParam());
  const auto plain = Certify(curve);
  const auto safe = Certify(curve, Rigorous());
  ASSERT_TRUE(plain && safe);
  EXPECT_TRUE(safe->floor.certified);
  EXPECT_LE(safe->floor.gap, 2e-10);
  EXPECT_NEAR(safe->floor.rmse_A / plain->floor.rmse_A, 1, 1e-10);
  EXPECT_LE(safe->floor.lower_bound_A, plain->floor.rmse_A * (1 + 1e-10));
  for (std::size_t m = 0; m < safe->models.size(); ++m) {
    const ModelCertificate& model = safe->models[m];
    const Device device = MakeDevice(model.model, curve.conditions);
    EXPECT_TRUE(model.certified) << m;
    EXPECT_LE(model.gap, 2e-10) << m;
    EXPECT_GE(model.gap, 1 - model.lower_bound_A / model.rmse_A) << m;
    EXPECT_EQ(model.rmse_A, ExactRmse(curve, device, model.parameters)) << m;
    EXPECT_LE(model.lower_bound_A, ExactRmse(curve, device, plain->models[m].parameters)) << m;
    EXPECT_NEAR(model.rmse_A / plain->models[m].rmse_A, 1, 1e-10) << m;
    EXPECT_LE(model.lower_bound_A, plain->models[m].lower_bound_A * (1 + 2e-10)) << m;
  }
}

INSTANTIATE_TEST_SUITE_P(Curves, RigorousShipped,
                         ::testing::Values("rtc_france", "pwp201", "msx60", "stm6_40_36",
                                           "stp6_120_36"));

TEST(Rigorous, NothingRefinedUndercutsItAtAll) {
  for (int seed = 800; seed < 800 + Repeats(6); ++seed) {
    const IvCurve curve = RandomCurve(seed);
    const auto certificate = Certify(curve, Rigorous());
    ASSERT_TRUE(certificate) << certificate.error().ToString();
    for (const ModelCertificate& model : certificate->models) {
      const Device device = MakeDevice(model.model, curve.conditions);
      const RefineProblem problem = ModelProblem(
          curve, device, {1, 2, 0, certificate->rs_upper_ohm, certificate->reference_voltage_V});
      EXPECT_TRUE(model.certified) << seed;
      EXPECT_GE(model.rmse_A, certificate->floor.lower_bound_A);
      for (const SeparableStart& start :
           SeparableStarts(problem, certificate->floor.resistance_series_ohm, 2)) {
        const std::vector<double> p = Refine(problem, SeparableDescent(problem, start.p)).p;
        EXPECT_GE(ExactRmse(curve, device, p), model.lower_bound_A) << seed;
      }
    }
  }
}

// Half the sum of squares of a mixture, rounded up.
double ExactPrimal(const IvCurve& curve, const MixtureData& data, const Mixture& mixture) {
  const WideInterval reference(data.reference_voltage_V), rs(mixture.rs);
  WideInterval sum(0);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const WideInterval current(curve.current_A[k]);
    const WideInterval vd = WideInterval(curve.voltage_V[k]) + rs * current;
    WideInterval residual = WideInterval(mixture.linear[kPhotocurrentTerm]) -
                            WideInterval(mixture.linear[kShuntTerm]) * vd - current;
    for (const Atom& atom : mixture.atoms) {
      const WideInterval u(atom.u), one(1);
      residual -= WideInterval(atom.current_A) * (exp(u * vd) - one) / (exp(u * reference) - one);
    }
    sum += square(residual);
  }
  return 0.5 * Upper(Hull(sum));
}

// With residuals far smaller than the currents, a bound computed in doubles sometimes exceeds the
// sum of squares of an actual mixture.
TEST(Rigorous, HoldsWhereDoublesClaimMoreThanIsTrue) {
  SKIP_IF_SANITIZED();
  int claimed = 0, close = 0;
  for (int seed = 0; seed < 200; ++seed) {
    const IvCurve curve = NearlyExact(seed % 2 == 0 ? "msx60" : "rtc_france", 1e-9, seed);
    const MixtureData data = DataOf(curve);
    const double dark_bound = 2 * data.target_A.maxCoeff();
    const std::vector<Window> windows = {WindowOf(curve, 1, 2)};
    const double rs = seed % 2 == 0 ? 0.2 : 0.036;
    Mixture mixture = SolveMixture(data, windows, rs, {}, 1e-12, dark_bound);
    const double truth = ExactPrimal(curve, data, mixture);
    const DarkCurrentBound tag = lyrefit::BoundDarkCurrent<Interval>(data, rs, rs, truth);
    const PartBound plain = BoundPart(data, windows, mixture, mixture, tag, truth);
    if (plain.lower > truth) ++claimed;
    MakeSafe(data, windows, dark_bound, &mixture);
    const PartBound bound = BoundPart<Interval>(data, windows, mixture, mixture, tag, truth);
    EXPECT_LE(bound.lower, truth) << seed;
    if (bound.lower > 0.999 * truth) ++close;
  }
  EXPECT_GT(claimed, 0);
  EXPECT_GT(close, 120);
}

// In double arithmetic the reported RMSE is slightly too small. In rigorous mode it is exact, and
// the gap includes all errors.
TEST(Rigorous, SaysWhatNearlyExactDataLeaveOpen) {
  SKIP_IF_SANITIZED();
  const IvCurve curve = NearlyExact("rtc_france", 1e-8, 7);
  const Device device = MakeDevice(Model::kDoubleDiode, curve.conditions);
  CertifyOptions options;
  options.models = {Model::kDoubleDiode};
  options.tolerance = 1e-7;
  const auto plain = Certify(curve, options);
  options.rigorous = true;
  const auto safe = Certify(curve, options);
  ASSERT_TRUE(plain && safe);
  const double exact = ExactRmse(curve, device, plain->models[0].parameters);
  EXPECT_GT(exact, plain->models[0].rmse_A * (1 + 1e-9));
  EXPECT_LE(safe->models[0].lower_bound_A, exact);
  EXPECT_EQ(safe->models[0].rmse_A, ExactRmse(curve, device, safe->models[0].parameters));
  EXPECT_GE(safe->models[0].gap, 1 - safe->models[0].lower_bound_A / safe->models[0].rmse_A);
  EXPECT_LT(safe->models[0].gap, 1e-6);
}

TEST(Rigorous, CorrelationsAreBoundedFromAbove) {
  SKIP_IF_SANITIZED();
  const IvCurve curve = Shipped("rtc_france");
  const MixtureData data = DataOf(curve);
  const Window window = WindowOf(curve, 0.5, 4);
  RandomStream random(11);
  for (int trial = 0; trial < 20; ++trial) {
    const double rs = 0.06 * random.Uniform();
    const ArrayOf<Interval> vd = JunctionVoltage<Interval>(data, rs);
    const double scale = data.JunctionVoltage(rs).maxCoeff();
    Eigen::VectorXd y(vd.size());
    for (double& value : y) value = random.Normal();
    const Correlation1D found =
        BoundCorrelation<Interval>(vd, scale, WeightedArray<Interval>(data, y), {window}, {}, 1e-9);
    const Correlation1D plain =
        BoundCorrelation(data.JunctionVoltage(rs), scale, y, {window}, {}, 1e-9);
    EXPECT_LE(found.bound, plain.bound * (1 + 1e-9) + 1e-12);
    for (int i = 0; i <= 50; ++i) {
      const WideInterval u(window.lower + (window.upper - window.lower) * i / 50), one(1);
      WideInterval correlation(0);
      for (Eigen::Index k = 0; k < y.size(); ++k) {
        const WideInterval v =
            WideInterval(data.voltage_V[k]) + WideInterval(rs) * WideInterval(data.current_A[k]);
        correlation -=
            WideInterval(y[k]) * (exp(u * v) - one) / (exp(u * WideInterval(scale)) - one);
      }
      EXPECT_GE(found.bound, Upper(Hull(correlation)) * (1 - 1e-15));
    }
  }
}

TEST(Rigorous, TakesConstantsAsTheyAreWritten) {
  using Truth = boost::multiprecision::cpp_bin_float_100;
  const struct {
    ConstantSet constants;
    const char *k, *q;
  } sets[] = {{ConstantSet::kCodata, "1.380649e-23", "1.602176634e-19"},
              {ConstantSet::kLiterature, "1.3806503e-23", "1.60217646e-19"},
              {ConstantSet::kPaper, "1.38065e-23", "1.60217e-19"}};
  Conditions conditions;
  conditions.cells_in_series = 36;
  conditions.cell_temperature_K = 318.15;
  for (const auto& set : sets) {
    const WideInterval vt = SafeThermalVoltage(conditions, set.constants);
    const Truth truth = Truth(set.k) / Truth(set.q) * 36 * Truth(318.15);
    EXPECT_LE(Truth(vt.lower), truth);
    EXPECT_GE(Truth(vt.upper), truth);
    EXPECT_LE(vt.upper - vt.lower, vt.upper * 1e-30);
    const Window window = SafeWindow(1, 2, vt);
    EXPECT_LT(Truth(window.lower), 1 / (2 * truth));
    EXPECT_GT(Truth(window.upper), 1 / truth);
    EXPECT_NEAR(window.lower * 2 * conditions.ModuleThermalVoltage(set.constants), 1, 1e-15);
  }
}

TEST(Rigorous, BoundsLargerResistancesNoHigherThanDoublesDo) {
  for (const char* name : {"rtc_france", "msx60", "pwp201"}) {
    const MixtureData data = DataOf(Shipped(name));
    const double rs = data.reference_voltage_V / data.current_A.maxCoeff();
    const double plain = BoundTail(data, rs), safe = BoundTail<Interval>(data, rs);
    EXPECT_LE(safe, plain);
    EXPECT_GT(safe, plain * 0.99);  // two points may be tied up to rounding
  }
}

}  // namespace
}  // namespace lyrefit
