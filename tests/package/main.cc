#include <cmath>
#include <cstdio>

#include "lyrefit/lyrefit.h"

// Argument: the folder of a curve. Fits it and succeeds if the RMSE is the certified one.
int main(int argc, char** argv) {
  const auto curve = lyrefit::ReadCurve(argc > 1 ? argv[1] : ".");
  if (!curve) return std::puts(curve.error().ToString().c_str()), 1;
  const auto report = lyrefit::Fit(*curve);
  if (!report) return std::puts(report.error().ToString().c_str()), 1;
  constexpr double kCertified =
      7.730062689942e-4;  // data/rtc_france/expected.json, SD, solved current
  const double rmse = report->rmse.refined.solved_current_A;
  std::printf("RMSE %.12e A, certified %.12e A\n", rmse, kCertified);
  if (!(std::abs(rmse / kCertified - 1.0) <= 1e-9)) return 1;
  const auto certificate = lyrefit::Certify(*curve);
  if (!certificate) return std::puts(certificate.error().ToString().c_str()), 1;
  std::fputs(lyrefit::BriefCertificate(*certificate).c_str(), stdout);
  return certificate->models[0].certified ? 0 : 1;
}
