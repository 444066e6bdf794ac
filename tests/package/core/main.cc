#include <lyrefit/core.h>

#include <cmath>
#include <cstdio>

// Fits a curve that the program itself has, a cell of 2 A, and succeeds if the fit finds its
// parameters again.
int main() {
  lyrefit::SimulateOptions cell;
  cell.parameters = {{"Iph", 2.0}, {"Is1", 1e-8}, {"n1", 1.3}, {"Rs", 0.02}, {"Rsh", 200.0}};
  cell.points = 60;
  const auto curve = lyrefit::Simulate(cell);
  if (!curve) return std::puts(curve.error().ToString().c_str()), 1;
  const auto report = lyrefit::Fit(*curve);
  if (!report) return std::puts(report.error().ToString().c_str()), 1;
  const double rs = report->refined[lyrefit::kRs];
  std::printf("Rs %.9f ohm, solved-current RMSE %.3g A\n", rs,
              report->rmse.refined.solved_current_A);
  return std::abs(rs - 0.02) < 1e-6 ? 0 : 1;
}
