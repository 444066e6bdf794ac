#include "lyrefit/search/crowding.h"

#include <algorithm>
#include <cmath>

namespace lyrefit {
namespace {

constexpr int kLanes = 8;

// These loops are elementwise and free of fused operations: every clone gives the same bits.
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

LYREFIT_CLONES void ReplaceRow(const double* fresh, int stride, double* row, double* sum) {
  for (int k = 0; k < stride; ++k) {
    sum[k] += fresh[k] - row[k];
    row[k] = fresh[k];
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

Crowding::Crowding(int birds, int dimensions, const std::vector<double>& unit)
    : birds_(birds),
      dimensions_(dimensions),
      stride_((birds + kLanes - 1) / kLanes * kLanes),
      coordinate_(static_cast<std::size_t>(dimensions) * stride_),
      distance_(static_cast<std::size_t>(birds) * stride_),
      sum_(stride_),
      fresh_(stride_) {
  for (int i = 0; i < birds; ++i) {
    for (int j = 0; j < dimensions; ++j) {
      coordinate_[static_cast<std::size_t>(j) * stride_ + i] = unit[i * dimensions + j];
    }
  }
  for (int i = 0; i < birds; ++i) {
    Distances(coordinate_.data(), stride_, dimensions_, &unit[i * dimensions], Row(i));
    std::fill(Row(i) + birds_, Row(i) + stride_, 0.0);
    sum_[i] = SumOf(Row(i), stride_);
  }
  FindLargest();
}

void Crowding::Move(int i, const double* unit) {
  for (int j = 0; j < dimensions_; ++j) {
    coordinate_[static_cast<std::size_t>(j) * stride_ + i] = unit[j];
  }
  Distances(coordinate_.data(), stride_, dimensions_, unit, fresh_.data());
  std::fill(fresh_.begin() + birds_, fresh_.end(), 0.0);
  ReplaceRow(fresh_.data(), stride_, Row(i), sum_.data());
  for (int k = 0; k < birds_; ++k) Row(k)[i] = fresh_[k];
  sum_[i] = SumOf(fresh_.data(), stride_);
  const double reach = LargestOf(fresh_.data(), stride_);
  if (reach >= largest_) {
    largest_ = reach;
    end_a_ = i;
    end_b_ = static_cast<int>(std::find(fresh_.begin(), fresh_.end(), reach) - fresh_.begin());
  } else if (i == end_a_ || i == end_b_) {
    FindLargest();
  }
}

void Crowding::FindLargest() {
  largest_ = -1;
  for (int i = 0; i < birds_; ++i) {
    const double reach = LargestOf(Row(i), stride_);
    if (reach <= largest_) continue;
    largest_ = reach;
    end_a_ = i;
    end_b_ = static_cast<int>(std::find(Row(i), Row(i) + stride_, reach) - Row(i));
  }
}

}  // namespace lyrefit
