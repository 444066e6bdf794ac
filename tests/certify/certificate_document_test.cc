#include "lyrefit/report/documents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <sstream>

#include "lyrefit/certify/certificate_documents.h"
#include "lyrefit/report/plots.h"
#include "lyrefit/report/text_layout.h"
#include "sample_certificate.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(CertificateText, TellsFloorProofAndModels) {
  const std::string text = CertificateText(RtcCertificate());
  EXPECT_THAT(text, HasSubstr("measured-current"));
  EXPECT_THAT(text, HasSubstr("reached       9.824848761e-04 A"));
  EXPECT_THAT(text, HasSubstr("nothing lies below 9.824848"));
  EXPECT_THAT(text, HasSubstr("1.451018"));
  EXPECT_THAT(text, HasSubstr("Duality gap"));
  EXPECT_THAT(text, HasSubstr("0.360 %  yes"));
  EXPECT_THAT(text, HasSubstr("attains it  yes"));
  EXPECT_THAT(text, HasSubstr("2 diodes attain the floor"));
  EXPECT_THAT(text, Not(HasSubstr("INTERRUPTED")));
}

TEST(CertificateText, SaysWhichBoundsHoldInSpiteOfRounding) {
  Certificate certificate = RtcCertificate();
  EXPECT_THAT(CertificateText(certificate), Not(HasSubstr("Rigorous")));
  certificate.options.rigorous = true;
  EXPECT_THAT(CertificateText(certificate),
              HasSubstr("Rigorous: every bound of the measured-current RMSE"));
}

TEST(CertificateText, FitsATerminalOf100Columns) {
  Certificate certificate = RtcCertificate();
  certificate.options.rigorous = true;
  std::istringstream lines(CertificateText(certificate));
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), static_cast<std::size_t>(kTextWidth)) << line;
  }
}

// With any Rs an exponent of 320 at a reading of RTC France is that of some n above 0.1.
TEST(CertificateText, SaysWhereSearchesBegin) {
  Certificate certificate = RtcCertificate();
  EXPECT_THAT(CertificateText(certificate), Not(HasSubstr("fit and compare begin n")));
  certificate.options.n_lower = 0.05;
  EXPECT_THAT(CertificateText(certificate), HasSubstr("fit and compare begin n at 0.1"));
}

TEST(CertificateText, SaysWhatIsNotCertified) {
  Certificate certificate = RtcCertificate();
  certificate.interrupted = true;
  certificate.models[1].certified = false;
  certificate.models[1].gap = 0.002;
  const std::string text = CertificateText(certificate);
  EXPECT_THAT(text, StartsWith("INTERRUPTED"));
  EXPECT_THAT(text, HasSubstr("dd: not certified, a lower RMSE by up to 0.2 %"));
  EXPECT_THAT(BriefCertificate(certificate), HasSubstr("NOT CERTIFIED"));
  certificate.floor.gap = 0.01;
  certificate.floor.certified = false;
  EXPECT_THAT(CertificateText(certificate), HasSubstr("1 % apart"));
}

TEST(CertificateText, RoundsNoProvedBoundUp) {
  Certificate certificate = RtcCertificate();
  certificate.floor.lower_bound_A = 9.8248487609e-4;
  certificate.models[0].lower_bound_A = 9.86021877888e-4;
  const std::string text = CertificateText(certificate);
  EXPECT_THAT(text, HasSubstr("nothing lies below 9.824848760e-04 A"));
  EXPECT_THAT(text, HasSubstr("9.860218779e-04   9.860218778e-04"));
}

TEST(CertificateText, TellsAnExactFit) {
  IvCurve line;
  line.name = "line";
  line.voltage_V = {0, 0.1, 0.2, 0.3};
  line.current_A = {1, 0.8, 0.6, 0.4};
  const std::string text = CertificateText(*Certify(line));
  EXPECT_THAT(text, HasSubstr("nothing can be lower: this is rounding"));
  EXPECT_THAT(text, HasSubstr("The floor is zero"));
  EXPECT_THAT(text, Not(HasSubstr("Duality gap")));
}

TEST(CertificateText, CountsNoDiode) {
  Certificate certificate = RtcCertificate();
  certificate.floor.diodes.clear();
  const std::string text = CertificateText(certificate);
  EXPECT_THAT(text, HasSubstr("and no diode\n"));
  EXPECT_THAT(text, HasSubstr("No diode is needed to attain the floor"));
}

TEST(BriefCertificate, IsOneLine) {
  const std::string text = BriefCertificate(RtcCertificate());
  EXPECT_THAT(text, StartsWith("rtc_france: floor 9.824848761e-04 A measured-current"));
  EXPECT_EQ(text.find('\n'), text.size() - 1);
}

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
