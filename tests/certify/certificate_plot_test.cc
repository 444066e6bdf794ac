#include "lyrefit/report/plots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "sample_certificate.h"
#include "temp_folder.h"

#include "lyrefit/certify/certificate_documents.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TEST(PlotCertificate, WritesAnSvgWithItsLabels) {
  const TempFolder folder;
  const std::string path = folder.Path("proof.svg");
  const auto drawn = PlotCertificate(RtcCertificate(), path);
  ASSERT_TRUE(drawn) << drawn.error().ToString();
  std::ifstream file(path, std::ios::binary);
  const std::string svg{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(svg, HasSubstr("</svg>"));
  EXPECT_THAT(svg, HasSubstr("rtc_france: floor 9.824848761e-04 A"));
  EXPECT_THAT(svg, HasSubstr("Ideality factor n"));
  EXPECT_THAT(svg, HasSubstr("diodes of the floor"));
}

TEST(PlotCertificate, RefusesOtherExtensions) {
  const TempFolder folder;
  const auto drawn = PlotCertificate(RtcCertificate(), folder.Path("proof.gif"));
  ASSERT_FALSE(drawn);
  EXPECT_THAT(drawn.error().ToString(), HasSubstr(".svg, .png or .pdf"));
}

}  // namespace
}  // namespace lyrefit
