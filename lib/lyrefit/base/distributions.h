#pragma once

// Tails and quantiles of standard distributions, compiled once, because Boost.Math's templates take
// long to compile.
namespace lyrefit {

// Probability of a value above `x`. `degrees` are degrees of freedom; `degrees_above` are those of
// the numerator of F, `degrees_below` those of its denominator.
double NormalTail(double x);
double ChiSquaredTail(double x, double degrees);
double FisherTail(double x, double degrees_above, double degrees_below);

// Quantile of the standard normal distribution: the value with the upper tail probability `tail`.
double NormalAbove(double tail);

// Quantile of Student's t: the value with the lower tail probability `p`.
double StudentQuantile(double p, double degrees);

}  // namespace lyrefit
