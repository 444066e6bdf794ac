#pragma once

#include <vector>

#include "lyrefit/estimate/fit/fit_report.h"

namespace lyrefit {

// Quantile of Student's t for a two-sided 95 % interval.
double StudentT95(int degrees_of_freedom);

// p-value of the F-test of the null hypothesis that a model with `extra` more parameters is no
// better.
double FTestPValue(double mean_square_simple, double mean_square_rich, int extra,
                   int degrees_of_freedom_rich);

// AICc and BIC of a least-squares fit; the noise variance counts as one more parameter. AICc is NaN
// if the points are too few for its correction.
InformationCriteria FindInformation(double mean_square, int points, int parameters);

// Largest and mean residual, runs of one sign and Durbin-Watson, in order of voltage.
ResidualStatistics FindResidualStatistics(const std::vector<double>& voltage_V,
                                          const std::vector<double>& residual_A);

// Indices in order of rising voltage; equal voltages keep the order of measurement.
std::vector<int> OrderByVoltage(const std::vector<double>& voltage_V);

// Standard deviation of the noise, from second differences of the values in order of voltage. The
// median absolute deviation makes it robust to a few outliers or a knee. Copies of a point count
// once. 0 for fewer than 5 points.
double NoiseFromDifferences(const std::vector<double>& voltage_V,
                            const std::vector<double>& values);

}  // namespace lyrefit
