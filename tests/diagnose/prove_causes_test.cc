#include "lyrefit/diagnose/prove_causes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagnose/synthetic_diagnosis.h"
#include "lyrefit/curve/read_curve.h"
#include "repeats.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

DiagnoseOptions WithProofs(DiagnoseOptions options = {}) {
  options.proofs = true;
  return Quick(std::move(options));
}

TEST(Proofs, AreThereWhereTheyWereAskedFor) {
  SKIP_IF_SANITIZED();
  const IvCurve curve = SyntheticCurve({});
  EXPECT_FALSE(DiagnoseOrFail(curve).proofs);
  const Diagnosis diagnosis = DiagnoseOrFail(curve, WithProofs());
  ASSERT_TRUE(diagnosis.proofs);
  EXPECT_FALSE(diagnosis.proofs->causes.empty());
  for (const CauseProof& proof : diagnosis.proofs->causes) {
    EXPECT_LE(proof.lower_bound_A, proof.base_A) << proof.effect;
    EXPECT_LE(proof.lower_bound_A, proof.upper_bound_A) << proof.effect;
    const double left = proof.lower_bound_A / proof.base_A;
    EXPECT_NEAR(proof.explains_at_most, 1 - left * left, 1e-12) << proof.effect;
  }
}

TEST(Proofs, AreOfTheEffectsThatWereTried) {
  DiagnoseOptions options;
  options.effects = {"collection", "drift"};
  const Diagnosis one = DiagnoseOrFail(SyntheticCurve({}), WithProofs(options));
  for (const CauseProof& proof : one.proofs->causes) EXPECT_EQ(proof.effect, "collection");
  options.effects = {"drift"};
  const Diagnosis none = DiagnoseOrFail(SyntheticCurve({}), WithProofs(options));
  EXPECT_TRUE(none.proofs->causes.empty());
  EXPECT_THAT(none.proofs->sentence, HasSubstr("none has a bound"));
}

TEST(Proofs, SayWhyThereAreNone) {
  CurveSet set;
  set.curves = {SyntheticCurve({}), SyntheticCurve({})};
  set.curves[1].conditions.irradiance_W_m2 = 500;
  const Diagnosis diagnosis = DiagnoseOrFail(set, WithProofs());
  EXPECT_TRUE(diagnosis.proofs->causes.empty());
  EXPECT_THAT(diagnosis.proofs->sentence, HasSubstr("several curves"));
}

}  // namespace
}  // namespace lyrefit
