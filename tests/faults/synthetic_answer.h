#pragma once

#include <string>
#include <utility>
#include <vector>

#include "faults/adapter.h"

namespace faults {

inline Claim Claiming(const std::string& id, std::vector<std::string> equivalents = {},
                      std::vector<Strength> strengths = {}) {
  Claim claim;
  claim.id = id;
  claim.equivalents = std::move(equivalents);
  claim.strengths = std::move(strengths);
  return claim;
}

inline Answer Saying(std::vector<Claim> claims) {
  Answer answer;
  answer.claims = std::move(claims);
  return answer;
}

}  // namespace faults
