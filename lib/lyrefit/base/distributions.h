#pragma once

// Tails and quantiles of the usual distributions, compiled once.
namespace lyrefit {

// Probability of a value above `x`.
double NormalTail(double x);
double ChiSquaredTail(double x, double degrees);
double FisherTail(double x, double degrees_above, double degrees_below);

// The value above which the standard normal distribution has the probability `tail`.
double NormalAbove(double tail);

// The value below which Student's t has the probability `p`.
double StudentQuantile(double p, double degrees);

}  // namespace lyrefit
