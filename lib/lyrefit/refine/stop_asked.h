#pragma once

#include <ceres/iteration_callback.h>

#include <functional>

namespace lyrefit {

// Ends a solve where it stands when asked to, or when it is low enough.
class StopAsked : public ceres::IterationCallback {
 public:
  explicit StopAsked(const std::function<bool()>& stop) : stop_(stop) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (stop_ && stop_()) stopped_ = true;
    const bool end = stopped_ || summary.cost <= enough_;
    return end ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }
  bool stopped() const { return stopped_; }
  void set_enough(double cost) { enough_ = cost; }

 private:
  const std::function<bool()>& stop_;
  double enough_ = 0;
  bool stopped_ = false;
};

}  // namespace lyrefit
