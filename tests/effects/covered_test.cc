#include "lyrefit/effects/covered.h"

#include <gtest/gtest.h>

#include <vector>

#include "lyrefit/effects/catalogue.h"

namespace lyrefit {
namespace {

TEST(ShareLeftTest, IsOfTheCellsThatWork) {
  EXPECT_NEAR(ShareLeft(1.0 / 3, 0, 3), 0, 1e-12);
  EXPECT_NEAR(ShareLeft(1.0 / 3, 1, 3), 0.5, 1e-12);
  EXPECT_NEAR(ShareLeft(2.0 / 3, 1, 3), 0.5, 1e-12);
  // all working cells; the law needs a share below 1
  EXPECT_NEAR(ShareLeft(2.0 / 3, 2, 3), 0.999, 1e-12);
  EXPECT_NEAR(ShareLeft(0.1, 0, 3), 0, 1e-12);  // less than a group
  EXPECT_NEAR(ShareLeft(0.1, 2, 3), 0.15, 1e-12);
  EXPECT_NEAR(ShareLeft(0.5, 1, 2, 1), 0, 1e-12);  // the shade begins in the second group
  EXPECT_NEAR(ShareLeft(0.5, 0, 2, 1), 0.999, 1e-12);
}

TEST(CoveredTest, AShadeGoesWithItsSubstring) {
  const Effect& shading = *FindEffect("shading");
  std::vector<double> p = {0.4, 1.0 / 3, 0.5, 1};
  EXPECT_FALSE(shading.covered(p.data(), 0, 3));
  p[1] = 1.0 / 3;
  EXPECT_TRUE(shading.covered(p.data(), 2, 3));
  EXPECT_NEAR(p[1], 0.5, 1e-12);
}

TEST(CoveredTest, AWeakCellGoesWithItsSubstring) {
  const Effect& weak = *FindEffect("weak_cell");
  std::vector<double> p = {0.4, 1, 0, 0.5, 0.1, 15, 3.4, 3.2, 1};
  const std::vector<double> before = p;
  EXPECT_FALSE(weak.covered(p.data(), 0, 3));
  EXPECT_TRUE(weak.covered(p.data(), 1, 3));
  EXPECT_EQ(p, before);
}

TEST(CoveredTest, OfSubstringsTheDarkestGoesFirst) {
  const Effect& substrings = *FindEffect("substrings");
  const std::vector<double> two = {0.3, 1.0 / 3, 0.6, 1.0 / 3, 0, 0, 0, 0, 0.5, 1};
  std::vector<double> p = two;
  EXPECT_TRUE(substrings.covered(p.data(), 0, 3));
  EXPECT_NEAR(p[1], 0.5, 1e-12);
  EXPECT_NEAR(p[3], 0, 1e-12);
  p = two;
  EXPECT_TRUE(substrings.covered(p.data(), 1, 3));
  EXPECT_NEAR(p[1], 0, 1e-12);
  EXPECT_NEAR(p[3], 0.5, 1e-12);
  p = two;
  EXPECT_TRUE(substrings.covered(p.data(), 2, 3));
  EXPECT_NEAR(p[1] + p[3], 0.999, 1e-9);
  EXPECT_NEAR(p[1], p[3], 1e-9);
}

TEST(CoveredTest, WhatAllCellsHaveStays) {
  for (const char* id : {"nonohmic_shunt", "mismatch", "scatter", "collection"}) {
    EXPECT_EQ(FindEffect(id)->covered, nullptr) << id;
  }
}

}  // namespace
}  // namespace lyrefit
