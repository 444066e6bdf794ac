// Real sweeps: no fit of a cause has a lower RMSE than the lower bound proved for that cause.
// Nightly runs use all sweeps, other runs every sixth.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "lyrefit/base/parallel.h"
#include "lyrefit/curve/read_curve.h"
#include "lyrefit/diagnose/diagnose.h"
#include "repeats.h"

namespace lyrefit {
namespace {

std::vector<std::string> SingleSweeps() {
  std::vector<std::string> files;
  const std::string folder = std::string(LYREFIT_FIELD_DATA_DIR) + "/field/single";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".csv" || entry.path().stem() == "labels") continue;
    files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(ProofsOfRealSweeps, AreUndercutByNoFit) {
  DiagnoseOptions options;
  options.held_out = false;
  options.proofs = true;
  options.draws = 400;
  options.threads = 1;
  int proved = 0, close = 0;
  const std::vector<std::string> files = SingleSweeps();
  const std::size_t step = AtNight() ? 1 : 6;
  for (std::size_t k = 0; k < files.size(); k += step) {
    const std::string& file = files[k];
    const auto curve = ReadCurve(file);
    if (!curve) continue;
    const auto diagnosis = Diagnose(*curve, options);
    if (!diagnosis) continue;
    ASSERT_TRUE(diagnosis->proofs) << file;
    for (const CauseProof& proof : diagnosis->proofs->causes) {
      EXPECT_FALSE(proof.upper_bound_A < proof.lower_bound_A) << file << " " << proof.effect;
      EXPECT_FALSE(proof.base_A < proof.lower_bound_A &&
                   proof.objective == Objective::kMeasuredCurrent)
          << file << " " << proof.effect;
      if (proof.objective != Objective::kMeasuredCurrent) continue;
      ++proved;
      const auto square = [](double x) { return x * x; };
      const double gap = square(proof.upper_bound_A) - square(proof.lower_bound_A);
      const double allowed =
          std::max(0.02 * square(proof.upper_bound_A), 0.005 * square(proof.base_A));
      close += gap <= allowed * (1 + 1e-6) ? 1 : 0;
    }
  }
  EXPECT_GT(proved, 150 / static_cast<int>(step));
  EXPECT_GE(close, proved - 2 / static_cast<int>(step));
}

}  // namespace
}  // namespace lyrefit
