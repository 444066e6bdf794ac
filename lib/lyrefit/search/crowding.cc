#include "lyrefit/search/run.h"

#include <algorithm>
#include <cmath>

namespace lyrefit {
namespace {

constexpr int kLanes = 8;

// The loops are elementwise and have no fused operations, so that every clone gives the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define LYREFIT_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define LYREFIT_CLONES
#endif

LYREFIT_CLONES void Distances(const double* coordinate, int stride, int dimensions,
                              const double* point, double* distance) {
  for (int k = 0; k < stride; ++k) distance[k] = 0;
  for (int j = 0; j < dimensions; ++j) {
    const double* row = coordinate + static_cast<long>(j) * stride;
    const double at = point[j];
    for (int k = 0; k < stride; ++k) distance[k] += (row[k] - at) * (row[k] - at);
  }
  for (int k = 0; k < stride; ++k) distance[k] = std::sqrt(distance[k]);
}

// Updates the other candidates' sums and distance bounds after one candidate has moved. `past` and
// `fresh` are its distances to them before and after the move.
LYREFIT_CLONES void UpdateOthers(const double* past, const double* fresh, int stride, double* sum,
                                 double* bound) {
  for (int k = 0; k < stride; ++k) {
    sum[k] += fresh[k] - past[k];
    bound[k] = fresh[k] > bound[k] ? fresh[k] : bound[k];
  }
}

LYREFIT_CLONES double LargestOf(const double* row, int stride) {
  double lane[kLanes] = {};
  for (int k = 0; k < stride; k += kLanes) {
    for (int l = 0; l < kLanes; ++l) lane[l] = row[k + l] > lane[l] ? row[k + l] : lane[l];
  }
  return *std::max_element(lane, lane + kLanes);
}

double SumOf(const double* row, int stride) {
  double lane[kLanes] = {};
  for (int k = 0; k < stride; k += kLanes) {
    for (int l = 0; l < kLanes; ++l) lane[l] += row[k + l];
  }
  double sum = 0;
  for (const double part : lane) sum += part;
  return sum;
}

}  // namespace

Crowding::Crowding(int candidates, int dimensions, const std::vector<double>& unit)
    : candidates_(candidates),
      dimensions_(dimensions),
      stride_((candidates + kLanes - 1) / kLanes * kLanes),
      coordinate_(static_cast<std::size_t>(dimensions) * stride_),
      point_(dimensions),
      sum_(stride_),
      bound_(stride_),
      past_(stride_),
      fresh_(stride_) {
  for (int i = 0; i < candidates; ++i) {
    for (int j = 0; j < dimensions; ++j) {
      coordinate_[static_cast<std::size_t>(j) * stride_ + i] =
          unit[static_cast<std::size_t>(i) * dimensions + j];
    }
  }
  for (int i = 0; i < candidates; ++i) {
    FindDistances(i, &fresh_);
    sum_[i] = SumOf(fresh_.data(), stride_);
    bound_[i] = LargestOf(fresh_.data(), stride_);
  }
  FindLargest();
}

void Crowding::FindDistances(int i, std::vector<double>* distance) {
  for (int j = 0; j < dimensions_; ++j) {
    point_[j] = coordinate_[static_cast<std::size_t>(j) * stride_ + i];
  }
  Distances(coordinate_.data(), stride_, dimensions_, point_.data(), distance->data());
  std::fill(distance->begin() + candidates_, distance->end(), 0.0);
}

void Crowding::Move(int i, const double* unit) {
  FindDistances(i, &past_);
  for (int j = 0; j < dimensions_; ++j) {
    coordinate_[static_cast<std::size_t>(j) * stride_ + i] = unit[j];
  }
  FindDistances(i, &fresh_);
  UpdateOthers(past_.data(), fresh_.data(), stride_, sum_.data(), bound_.data());
  sum_[i] = SumOf(fresh_.data(), stride_);
  bound_[i] = LargestOf(fresh_.data(), stride_);
  if (bound_[i] >= largest_) {
    largest_ = bound_[i];
    end_a_ = i;
    end_b_ = FarthestOf(fresh_);
  } else if (i == end_a_ || i == end_b_) {
    FindLargest();
  }
}

// The largest bound is the largest distance if its candidate reaches it. Otherwise the bound is
// lowered to the candidate's largest distance, and the search repeats.
void Crowding::FindLargest() {
  while (true) {
    end_a_ = FarthestOf(bound_);
    FindDistances(end_a_, &fresh_);
    largest_ = LargestOf(fresh_.data(), stride_);
    if (largest_ >= bound_[end_a_]) break;
    bound_[end_a_] = largest_;
  }
  end_b_ = FarthestOf(fresh_);
}

int Crowding::FarthestOf(const std::vector<double>& distance) {
  return static_cast<int>(std::max_element(distance.begin(), distance.end()) - distance.begin());
}

}  // namespace lyrefit
